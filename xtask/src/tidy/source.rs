//! Just enough of Rust's lexical grammar to tell code from comments, literals and tests.

/// The same text with every comment and every literal blanked out, line for line.
pub(super) fn code_only(text: &str) -> String {
    let chars: Vec<char> = text.chars().collect();
    let mut out = String::with_capacity(text.len());
    let mut at = 0;
    while at < chars.len() {
        let end = skipped(&chars, at);
        if end == at {
            out.push(chars[at]);
            at += 1;
        } else {
            out.extend(chars[at..end].iter().map(|&c| if c == '\n' { '\n' } else { ' ' }));
            at = end;
        }
    }
    out
}

/// One past the comment or literal that starts at `at`; `at` itself if none does.
fn skipped(chars: &[char], at: usize) -> usize {
    let next = |k: usize| chars.get(at + k).copied().unwrap_or('\0');
    let within_word = at > 0 && (chars[at - 1].is_alphanumeric() || chars[at - 1] == '_');
    match chars[at] {
        '/' if next(1) == '/' => line_end(chars, at),
        '/' if next(1) == '*' => block_comment_end(chars, at),
        '"' => quoted_end(chars, at, '"'),
        'r' if !within_word && matches!(next(1), '"' | '#') => raw_end(chars, at + 1, at),
        'b' if !within_word && next(1) == 'r' => raw_end(chars, at + 2, at),
        // 'a' and '\n' are characters, 'a without a closing quote is a lifetime.
        '\'' if next(1) == '\\' || next(2) == '\'' => quoted_end(chars, at, '\''),
        _ => at,
    }
}

fn line_end(chars: &[char], at: usize) -> usize {
    chars[at..].iter().position(|&c| c == '\n').map_or(chars.len(), |n| at + n)
}

fn block_comment_end(chars: &[char], mut at: usize) -> usize {
    let mut depth = 0;
    while at < chars.len() {
        match (chars[at], chars.get(at + 1)) {
            ('/', Some('*')) => (depth, at) = (depth + 1, at + 1),
            ('*', Some('/')) => (depth, at) = (depth - 1, at + 1),
            _ => {}
        }
        at += 1;
        if depth == 0 {
            return at;
        }
    }
    chars.len()
}

fn quoted_end(chars: &[char], mut at: usize, quote: char) -> usize {
    at += 1;
    while at < chars.len() && chars[at] != quote {
        at += if chars[at] == '\\' { 2 } else { 1 };
    }
    (at + 1).min(chars.len())
}

/// The end of a raw string whose hashes start at `hashes`; `start` if it is none (`r#type`).
fn raw_end(chars: &[char], hashes: usize, start: usize) -> usize {
    let count = chars[hashes..].iter().take_while(|&&c| c == '#').count();
    let open = hashes + count;
    if chars.get(open) != Some(&'"') {
        return start;
    }
    let mut at = open + 1;
    while at < chars.len() {
        let closing = chars[at + 1..].iter().take(count).filter(|&&c| c == '#').count();
        if chars[at] == '"' && closing == count {
            return at + 1 + count;
        }
        at += 1;
    }
    chars.len()
}

/// The lines of `code` (from [`code_only`]) that belong to `#[cfg(test)]` items: true for those.
pub(super) fn test_lines(code: &str) -> Vec<bool> {
    let lines: Vec<&str> = code.lines().collect();
    let mut marks = vec![false; lines.len()];
    let mut at = 0;
    while at < lines.len() {
        if lines[at].contains("#[cfg(test)]") {
            let end = item_end(&lines, at);
            marks[at..end].fill(true);
            at = end;
        } else {
            at += 1;
        }
    }
    marks
}

/// One past the last line of the item that starts at or after line `at`: up to its closing brace,
/// or its semicolon if that comes before any brace.
pub(super) fn item_end(lines: &[&str], at: usize) -> usize {
    let mut depth = 0_usize;
    for (index, line) in lines.iter().enumerate().skip(at) {
        for c in line.chars() {
            match c {
                '{' => depth += 1,
                '}' if depth <= 1 => return index + 1,
                '}' => depth -= 1,
                ';' if depth == 0 => return index + 1,
                _ => {}
            }
        }
    }
    lines.len()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn comments_and_literals_are_blanked() {
        let cases = [
            ("a // b\nc", "a     \nc"),
            ("a /* b /* c */ d */ e", "a                   e"),
            ("x(\"s\\\"t\") y", "x(      ) y"),
            ("f(r#\"a\"b\"#) z", "f(        ) z"),
            ("br\"x\" q", "      q"),
            ("'a' '\\'' &'a str", "         &'a str"),
            ("bar\"x\"", "bar   "),
            ("r#type", "r#type"),
        ];
        for (text, expected) in cases {
            assert_eq!(code_only(text), expected, "{text}");
        }
    }

    #[test]
    fn an_open_literal_ends_with_the_file() {
        for text in ["\"abc", "r#\"abc\"", "/* abc", "'\\"] {
            assert!(code_only(text).trim().is_empty(), "{text}");
        }
    }

    #[test]
    fn test_modules_are_marked_to_their_brace() {
        let code = "fn a() {}\n#[cfg(test)]\nmod tests {\n  fn b() { }\n}\nfn c() {}\n";
        assert_eq!(test_lines(code), [false, true, true, true, true, false]);
        let elsewhere = "#[cfg(test)]\nmod tests;\nfn c() {}\n";
        assert_eq!(test_lines(elsewhere), [true, true, false]);
    }
}
