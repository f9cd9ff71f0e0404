//! Numbers and lists of them, in SVG's grammar. All that come out are finite.

use scumble_geometry::DVec2;

/// Reads a text from left to right.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Cursor<'a> {
    pub(crate) rest: &'a str,
}

impl<'a> Cursor<'a> {
    pub(crate) fn new(text: &'a str) -> Self {
        Self { rest: text }
    }

    /// Skips white space.
    pub(crate) fn skip_spaces(&mut self) {
        self.rest = self.rest.trim_ascii_start();
    }

    /// Skips white space and commas.
    pub(crate) fn skip_separators(&mut self) {
        self.rest = self.rest.trim_start_matches(|c: char| c.is_ascii_whitespace() || c == ',');
    }

    /// Skips `token` if it comes next, and says whether it did.
    pub(crate) fn eat(&mut self, token: &str) -> bool {
        let rest = self.rest.strip_prefix(token);
        self.rest = rest.unwrap_or(self.rest);
        rest.is_some()
    }

    /// Takes characters as long as they please.
    pub(crate) fn take_while(&mut self, pleases: impl Fn(char) -> bool) -> &'a str {
        let end = self.rest.find(|c| !pleases(c)).unwrap_or(self.rest.len());
        let (taken, rest) = self.rest.split_at(end);
        self.rest = rest;
        taken
    }

    /// Takes a number: sign, digits, fraction, exponent. `2em` and `2ex` are the number 2 with a
    /// unit. `None`, and nothing taken, for what is no number or not finite.
    pub(crate) fn number(&mut self) -> Option<f64> {
        let length = number_length(self.rest.as_bytes());
        let value: f64 = self.rest.get(..length)?.parse().ok()?;
        if !value.is_finite() {
            return None;
        }
        self.rest = &self.rest[length..];
        Some(value)
    }
}

/// How many bytes at the start look like a number.
fn number_length(bytes: &[u8]) -> usize {
    let digits = |from: usize| bytes[from..].iter().take_while(|c| c.is_ascii_digit()).count();
    let at = |i: usize| bytes.get(i).copied().unwrap_or(0);
    let mut end = usize::from(matches!(at(0), b'+' | b'-'));
    end += digits(end);
    if at(end) == b'.' {
        end += 1 + digits(end + 1);
    }
    if matches!(at(end), b'e' | b'E') {
        let sign = usize::from(matches!(at(end + 1), b'+' | b'-'));
        let exponent = digits((end + 1 + sign).min(bytes.len()));
        if exponent > 0 {
            end += 1 + sign + exponent;
        }
    }
    end
}

/// The numbers of a list up to the first thing that is none, and whether that was the end.
pub(crate) fn list(text: &str) -> (Vec<f64>, bool) {
    let mut cursor = Cursor::new(text);
    let mut out = Vec::new();
    loop {
        cursor.skip_separators();
        match cursor.number() {
            Some(n) => out.push(n),
            None => return (out, cursor.rest.is_empty()),
        }
    }
}

/// Exactly N numbers, and nothing else.
pub(crate) fn exactly<const N: usize>(text: &str) -> Option<[f64; N]> {
    match list(text) {
        (numbers, true) => numbers.try_into().ok(),
        _ => None,
    }
}

/// N points from 2·N numbers; `M` must be `2 * N`.
pub(crate) fn points<const N: usize, const M: usize>(text: &str) -> Option<[DVec2; N]> {
    let numbers = exactly::<M>(text)?;
    Some(core::array::from_fn(|i| DVec2::new(numbers[2 * i], numbers[2 * i + 1])))
}

/// A number; whatever follows it, such as a unit, is ignored.
pub(crate) fn leading(text: &str) -> Option<f64> {
    let mut cursor = Cursor::new(text);
    cursor.skip_spaces();
    cursor.number()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lists_in_any_spacing() {
        assert_eq!(list(""), (vec![], true));
        assert_eq!(list(" 1,2 \n3\t,4 "), (vec![1.0, 2.0, 3.0, 4.0], true));
        assert_eq!(list("1-2+3.5.5-.5e1"), (vec![1.0, -2.0, 3.5, 0.5, -5.0], true));
        assert_eq!(list("1e3 1E-3 7.1054273576e-15"), (vec![1e3, 1e-3, 7.105_427_357_6e-15], true));
        assert_eq!(list("1 2 x 3"), (vec![1.0, 2.0], false));
        assert_eq!(list("1 nan"), (vec![1.0], false));
        assert_eq!(list("1 inf"), (vec![1.0], false));
        assert_eq!(list("1e999"), (vec![], false));
        assert_eq!(list("- 1"), (vec![], false));
        assert_eq!(list("."), (vec![], false));
        assert_eq!(list("1e 2"), (vec![1.0], false));
        assert_eq!(list("1é"), (vec![1.0], false));
    }

    #[test]
    fn units_are_left_alone() {
        assert_eq!(leading(" 10px"), Some(10.0));
        assert_eq!(leading("2em"), Some(2.0));
        assert_eq!(leading("2ex"), Some(2.0));
        assert_eq!(leading("50%"), Some(50.0));
        assert_eq!(leading("px"), None);
        assert_eq!(leading(""), None);
    }
}
