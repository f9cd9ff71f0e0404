//! Going over CSS declarations without understanding the rest.

/// What becomes of a declaration.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) enum Verdict {
    Keep,
    Drop,
    /// A new value; `!important` stays as it was.
    Replace(String),
    /// The same value without `!important`.
    Weaken,
}

/// Copies declarations (of a `style` attribute, or of a style sheet with its blocks) and asks
/// `judge` about each, by its name in lower case and its value without `!important`.
///
/// Comments go. Braces, quotes and parentheses are respected; text that makes no sense is copied
/// as it stands.
pub(super) fn rewrite(
    css: &str,
    in_block: bool,
    mut judge: impl FnMut(&str, &str) -> Verdict,
) -> String {
    let css = without_comments(css);
    let mut out = String::with_capacity(css.len());
    let mut rest = css.as_str();
    let mut depth = usize::from(in_block);
    while !rest.is_empty() {
        let end = item_end(rest);
        let (item, tail) = rest.split_at(end);
        let mut tail_chars = tail.chars();
        let delimiter = tail_chars.next();
        rest = tail_chars.as_str();
        if depth > 0 && matches!(delimiter, None | Some(';' | '}')) {
            let kept = declaration(item, &mut judge, &mut out);
            // Empty declarations are allowed, but not every parser knows.
            if !kept && delimiter == Some(';') {
                continue;
            }
        } else {
            out.push_str(item);
        }
        match delimiter {
            Some('{') => depth += 1,
            Some('}') => depth = depth.saturating_sub(1),
            _ => {}
        }
        out.extend(delimiter);
    }
    out
}

/// Copies a declaration as it is judged; `false` if nothing is left of it.
fn declaration(
    item: &str,
    judge: &mut impl FnMut(&str, &str) -> Verdict,
    out: &mut String,
) -> bool {
    let Some((name, value)) = item.split_once(':') else {
        out.push_str(item);
        return !item.trim().is_empty();
    };
    let (plain, important) = split_important(value);
    match judge(&name.trim().to_ascii_lowercase(), plain.trim()) {
        Verdict::Keep => out.push_str(item),
        Verdict::Replace(value) => out.extend([name, ":", &value, important]),
        Verdict::Weaken => out.extend([name, ":", plain]),
        Verdict::Drop => return false,
    }
    true
}

/// Puts declarations in front of others, where they are read even if those make no sense.
pub(super) fn prepend(css: &mut String, declarations: &str) {
    css.insert_str(0, declarations);
    css.insert(declarations.len(), ';');
}

/// A value, and the `!important` behind it.
fn split_important(value: &str) -> (&str, &str) {
    match value.rfind('!') {
        Some(i) if value[i + 1..].trim().eq_ignore_ascii_case("important") => value.split_at(i),
        _ => (value, ""),
    }
}

/// Where the next `;`, `{` or `}` stands that is not in quotes or parentheses; else the end.
fn item_end(css: &str) -> usize {
    let (mut quote, mut parentheses) = (None, 0_usize);
    for (i, c) in css.char_indices() {
        match (quote, c) {
            (Some(q), c) if c == q => quote = None,
            (Some(_), _) => {}
            (None, '"' | '\'') => quote = Some(c),
            (None, '(') => parentheses += 1,
            (None, ')') => parentheses = parentheses.saturating_sub(1),
            (None, '{' | '}') => return i,
            (None, ';') if parentheses == 0 => return i,
            (None, _) => {}
        }
    }
    css.len()
}

/// The text without `/* … */`, each of which leaves a space.
pub(super) fn without_comments(css: &str) -> String {
    let mut out = String::with_capacity(css.len());
    let mut rest = css;
    while let Some(start) = rest.find("/*") {
        out.push_str(&rest[..start]);
        out.push(' ');
        rest = rest[start..].find("*/").map_or("", |end| &rest[start + end + 2..]);
    }
    out.push_str(rest);
    out
}

#[cfg(test)]
mod tests {
    use super::*;

    fn upper(css: &str, in_block: bool) -> String {
        rewrite(css, in_block, |name, value| match name {
            "x" => Verdict::Replace(value.to_uppercase()),
            "y" => Verdict::Drop,
            _ => Verdict::Keep,
        })
    }

    #[test]
    fn declarations_are_found_and_nothing_else() {
        assert_eq!(upper("x:a; y:b; z:c", true), "x:A; z:c");
        assert_eq!(upper(";x:a;;y:b", true), "x:A;");
        assert_eq!(upper("X : a !important", true), "X :A!important");
        assert_eq!(upper("a:hover{x:b}", false), "a:hover{x:B}");
        assert_eq!(upper("@media (x:1){ p{x:url(a;b)} }", false), "@media (x:1){ p{x:URL(A;B)} }");
        assert_eq!(upper("p{/*x:c*/z:'x:d;'}", false), "p{ z:'x:d;'}");
        for odd in
            ["", "{", "}", "}}{", "x", "x:", ":", ";;", "p{x:a", "p{x:'a", "/*", "p{(", "é{ü:ö"]
        {
            upper(odd, false);
            upper(odd, true);
        }
    }
}
