//! What trying the selectors of a style sheet may cost.
//!
//! A descendant selector is tried by walking up the ancestors, and once more from each that
//! matches: for k spaces and elements d deep, up to (d choose k) steps.

use super::css;

/// Most combinators in one selector; each costs a level of recursion.
const MAX_COMBINATORS: u64 = 100;

/// An upper bound of the steps that trying all selectors of a sheet on one element takes, for
/// elements inside at most `depth` others.
pub(super) fn steps(sheet: &str, depth: u64) -> u64 {
    let sheet = css::without_comments(sheet);
    let preludes = sheet.split('{').map(|part| part.rsplit(['}', ';']).next().unwrap_or(part));
    // What stands behind the last brace is no selector, and costs at most one step too many.
    preludes
        .flat_map(|list| list.split(','))
        .fold(0_u64, |sum, selector| sum.saturating_add(selector_steps(selector, depth)))
}

fn selector_steps(selector: &str, depth: u64) -> u64 {
    let spaced = selector.replace('>', " > ").replace('+', " + ").replace('~', " ~ ");
    let (mut descendants, mut combinators) = (0, 0);
    let mut after_combinator = true;
    for word in spaced.split_whitespace() {
        let is_combinator = matches!(word, ">" | "+" | "~");
        if is_combinator {
            combinators += 1;
        } else if !after_combinator {
            descendants += 1;
        }
        after_combinator = is_combinator;
    }
    if descendants + combinators > MAX_COMBINATORS {
        return u64::MAX;
    }
    choose(depth, descendants)
}

/// The number of ways to choose `k` of `n`, but at least 1, and at most what fits.
fn choose(n: u64, k: u64) -> u64 {
    let mut product = 1_u64;
    for i in 0..k.min(n / 2) {
        let Some(next) = product.checked_mul(n - i) else { return u64::MAX };
        product = next / (i + 1);
    }
    product
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn steps_of_selectors() {
        assert_eq!(steps("", 10), 1);
        assert_eq!(steps("a{}", 10), 2);
        assert_eq!(steps("a, b{}", 10), 3);
        assert_eq!(steps("a b{x:y;z:w} c > d{}", 10), 10 + 1 + 1);
        assert_eq!(steps("a b/* */c{}", 10), 45 + 1);
        assert_eq!(steps("* * * * * * * * * * *{}", 250), choose(250, 10) + 1);
        assert_eq!(steps(&"*+".repeat(200), 3), u64::MAX);
        assert_eq!(choose(3, 50), 3);
    }
}
