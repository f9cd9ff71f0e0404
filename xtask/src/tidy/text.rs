//! Rules for every text file.

use super::Violation;

/// Marks of unfinished work, spelled so that this file does not carry them.
const MARKS: [&str; 3] = [concat!("TO", "DO"), concat!("FIX", "ME"), concat!("XX", "X")];

/// Paths that mean something on one machine only, or lie outside the project.
const FOREIGN_PATHS: [&str; 7] = [
    concat!("/wo", "rk/"),
    concat!("/ho", "me/"),
    concat!("/Us", "ers/"),
    concat!("/ro", "ot/"),
    concat!("/tm", "p/"),
    concat!("C:", "\\"),
    concat!("../sha", "red"),
];

pub(super) fn check(file: &str, content: &str) -> Vec<Violation> {
    let mut found = Vec::new();
    for (index, line) in content.lines().enumerate() {
        let mut report = |message: String| found.push(Violation::new(file, index + 1, message));
        if line.contains('\t') {
            report("a tab".to_owned());
        }
        if line.ends_with([' ', '\r']) {
            report("white space at the end of the line".to_owned());
        }
        for mark in MARKS.iter().filter(|mark| has_word(line, mark)) {
            report(format!("{mark}: finish it, or open an issue"));
        }
        for path in FOREIGN_PATHS.iter().filter(|path| has_path(line, path)) {
            report(format!("{path} means nothing on another machine"));
        }
    }
    if !content.is_empty() && !content.ends_with('\n') {
        let last = content.lines().count();
        found.push(Violation::new(file, last, "the last line does not end"));
    }
    found
}

/// Whether `word` stands in `line` with nothing of a word on either side.
pub(super) fn has_word(line: &str, word: &str) -> bool {
    let of_word = |c: char| c.is_alphanumeric() || c == '_';
    line.match_indices(word).any(|(at, _)| {
        let before = line[..at].chars().next_back();
        let after = line[at + word.len()..].chars().next();
        !before.is_some_and(of_word) && !after.is_some_and(of_word)
    })
}

/// Whether `path` stands in `line` at the start of a path, not amid another one or an address.
fn has_path(line: &str, path: &str) -> bool {
    let inside = |c: char| c.is_alphanumeric() || matches!(c, '_' | '-' | '.' | '}' | '/');
    line.match_indices(path).any(|(at, _)| !line[..at].chars().next_back().is_some_and(inside))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn messages(content: &str) -> Vec<String> {
        check("f", content).iter().map(Violation::to_string).collect()
    }

    #[test]
    fn clean_text_passes() {
        assert!(messages("one\n  two\n\nthree\n").is_empty());
        assert!(messages("").is_empty());
    }

    #[test]
    fn white_space_is_found() {
        assert_eq!(messages("a\tb\n"), ["f:1: a tab"]);
        assert_eq!(messages("a\nb \n"), ["f:2: white space at the end of the line"]);
        assert_eq!(messages("a\r\n"), Vec::<String>::new(), "lines() takes the whole ending");
        assert_eq!(messages("a\nb"), ["f:2: the last line does not end"]);
    }

    #[test]
    fn marks_are_found_as_words() {
        for mark in MARKS {
            assert_eq!(messages(&format!("// {mark}: later\n")).len(), 1);
            assert!(messages(&format!("{mark}S {mark}_LIST\n")).is_empty());
        }
    }

    #[test]
    fn foreign_paths_are_found_at_their_start() {
        for path in FOREIGN_PATHS {
            assert_eq!(messages(&format!("see \"{path}x\"\n")).len(), 1, "{path}");
        }
        let inside = format!("see https://example.org{}x\n", FOREIGN_PATHS[1]);
        assert!(messages(&inside).is_empty());
    }
}
