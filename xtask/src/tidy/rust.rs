//! Rules for Rust source.

use super::Violation;
use super::source::{code_only, item_end, test_lines};
use super::text::has_word;
use std::path::Path;

/// Lines of a file without its tests.
const MAX_FILE: usize = 600;
/// Lines of a function.
const MAX_FUNCTION: usize = 80;
/// Lines of code of the driver, all files without their tests: it composes, it has no logic of its
/// own. Comments and empty lines do not count: what is explained does not get fatter by it.
const MAX_DRIVER: usize = 1500;
const DRIVER: &str = "crates/scumble/src/";
/// Parts that are counted apart, each against the same limit: a driver of its own, with textures and no
/// triangles, and what both share.
const APART: [(&str, &str); 2] =
    [("warp", "crates/scumble/src/warp/"), ("traffic of rows", "crates/scumble/src/rows/")];

/// Crates that talk to the outside world; all others are libraries, which do not.
const OUTSIDE_CRATES: [&str; 4] = ["crates/cli/", "crates/lab/", "tests/", "xtask/"];

/// What a library has no business with, and why.
const NOT_IN_LIBRARIES: [(&str, &str); 8] = [
    ("std::fs", "libraries do no file IO"),
    ("std::net", "libraries do no IO"),
    ("std::env", "libraries read no environment"),
    ("std::process", "libraries start nothing"),
    ("println!", "libraries print nothing"),
    ("eprintln!", "libraries print nothing"),
    ("print!", "libraries print nothing"),
    ("eprint!", "libraries print nothing"),
];

/// Methods of floats whose last bit differs between platforms. What a library computes reaches the
/// bytes of a picture sooner or later; ours have their own series.
const INEXACT: [&str; 18] = [
    "sin", "cos", "tan", "sin_cos", "asin", "acos", "atan", "atan2", "exp", "exp2", "exp_m1", "ln",
    "ln_1p", "log", "log2", "log10", "powf", "hypot",
];

/// What stands in no crate's finished code.
const NOWHERE: [&str; 4] = ["unsafe", "dbg!", "todo!", "unimplemented!"];

pub(super) fn check(file: &str, content: &str) -> Vec<Violation> {
    let mut found = Vec::new();
    if is_crate_root(file) && !content.starts_with("//!") {
        found.push(Violation::new(file, 1, "a crate starts with its documentation (//!)"));
    }
    let code = code_only(content);
    let lines: Vec<&str> = code.lines().collect();
    let in_tests = if is_test_file(file) { vec![true; lines.len()] } else { test_lines(&code) };
    let library = file.contains("/src/") && !OUTSIDE_CRATES.iter().any(|c| file.starts_with(c));
    for (index, line) in lines.iter().enumerate() {
        for word in NOWHERE.iter().filter(|word| has_macro_or_word(line, word)) {
            found.push(Violation::new(file, index + 1, format!("`{word}` is not used here")));
        }
        if !library || in_tests[index] {
            continue;
        }
        for method in INEXACT.iter().filter(|m| line.contains(&format!(".{m}("))) {
            let message = format!("`{method}` is not the same on every platform");
            found.push(Violation::new(file, index + 1, message));
        }
        for (word, why) in NOT_IN_LIBRARIES.iter().filter(|(w, _)| has_macro_or_word(line, w)) {
            found.push(Violation::new(file, index + 1, format!("`{word}`: {why}")));
        }
    }
    found.extend(sizes(file, &lines, &in_tests));
    found
}

/// [`has_word`] for names that may end in `!`.
fn has_macro_or_word(line: &str, word: &str) -> bool {
    match word.strip_suffix('!') {
        Some(name) => line.contains(word) && has_word(line, name),
        None => has_word(line, word),
    }
}

fn is_crate_root(file: &str) -> bool {
    ["src/lib.rs", "src/main.rs"].iter().any(|root| file.ends_with(root))
}

fn is_test_file(file: &str) -> bool {
    file.ends_with("tests.rs") || file.contains("/tests/") || file.starts_with("tests/")
}

fn sizes(file: &str, lines: &[&str], in_tests: &[bool]) -> Vec<Violation> {
    let mut found = Vec::new();
    let length = in_tests.iter().filter(|&&test| !test).count();
    if length > MAX_FILE {
        let message = format!("{length} lines without tests; {MAX_FILE} are enough, make a folder");
        found.push(Violation::new(file, 1, message));
    }
    for (index, line) in lines.iter().enumerate() {
        if in_tests[index] || !starts_function(line) {
            continue;
        }
        let length = item_end(lines, index) - index;
        if length > MAX_FUNCTION {
            let message = format!("a function of {length} lines; {MAX_FUNCTION} are enough");
            found.push(Violation::new(file, index + 1, message));
        }
    }
    found
}

fn starts_function(line: &str) -> bool {
    let line = line.trim_start();
    let Some(at) = line.find("fn ") else { return false };
    line[..at].split_whitespace().all(|word| {
        word.starts_with("pub")
            || matches!(word, "const" | "async" | "extern" | "crate)" | "super)")
    })
}

/// Checks that the driver as a whole stays small, and so the one that warps.
pub(super) fn driver_size(root: &Path, files: &[String]) -> Vec<Violation> {
    let source = |f: &&String| f.starts_with(DRIVER) && f.ends_with(".rs") && !is_test_file(f);
    let apart = |f: &str| APART.iter().map(|(_, folder)| *folder).find(|part| f.starts_with(part));
    let parts = [("driver", DRIVER)].into_iter().chain(APART);
    let over = parts.filter_map(|(name, folder)| {
        let own = files.iter().filter(source).filter(|f| apart(f).unwrap_or(DRIVER) == folder);
        let total: usize = own.map(|file| code_lines(root, file)).sum();
        let message =
            format!("the {name} has {total} lines of code without tests; {MAX_DRIVER} are enough");
        (total > MAX_DRIVER).then(|| Violation::new(folder, 0, message))
    });
    over.collect()
}

/// Lines of a file that are neither tests nor comments nor empty.
fn code_lines(root: &Path, file: &str) -> usize {
    let Ok(content) = std::fs::read_to_string(root.join(file)) else { return 0 };
    let code = code_only(&content);
    let lines = code.lines().zip(test_lines(&code));
    lines.filter(|(line, test)| !test && !line.trim().is_empty()).count()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn messages(file: &str, content: &str) -> Vec<String> {
        check(file, content).iter().map(Violation::to_string).collect()
    }

    #[test]
    fn a_decent_crate_passes() {
        let text = "//! A crate.\n\n/// Never `dbg!`, not even \"unsafe\".\npub fn f() {}\n";
        assert!(messages("crates/x/src/lib.rs", text).is_empty());
    }

    #[test]
    fn a_crate_without_documentation_is_found() {
        let found = messages("crates/x/src/lib.rs", "pub fn f() {}\n");
        assert_eq!(found.len(), 1);
        assert!(found[0].starts_with("crates/x/src/lib.rs:1: "), "{found:?}");
    }

    #[test]
    fn forbidden_words_are_found_in_code_and_tests_alike() {
        for word in NOWHERE {
            let text = format!("//! X.\nfn f() {{\n    {word}();\n}}\n");
            assert_eq!(messages("crates/x/src/lib.rs", &text).len(), 1, "{word}");
            assert_eq!(messages("tests/tests/a.rs", &text).len(), 1, "{word}");
        }
        assert!(messages("crates/x/src/a.rs", "#![forbid(unsafe_code)]\n").is_empty());
    }

    #[test]
    fn libraries_keep_to_themselves_and_tools_need_not() {
        for (word, _) in NOT_IN_LIBRARIES {
            let text = format!("fn f() {{ {word}(x) }}\n");
            assert_eq!(messages("crates/x/src/a.rs", &text).len(), 1, "{word}");
            assert!(messages("crates/cli/src/a.rs", &text).is_empty(), "{word}");
            assert!(messages("crates/x/examples/a.rs", &text).is_empty(), "{word}");
            let tested = format!("#[cfg(test)]\nmod tests {{\n{text}}}\n");
            assert!(messages("crates/x/src/a.rs", &tested).is_empty(), "{word}");
        }
    }

    #[test]
    fn functions_that_differ_between_platforms_are_found_in_libraries() {
        for method in INEXACT {
            let text = format!("fn f(x: f64) -> f64 {{ x.{method}(1.0) }}\n");
            assert_eq!(messages("crates/x/src/a.rs", &text).len(), 1, "{method}");
            assert!(messages("crates/x/src/tests.rs", &text).is_empty(), "{method}");
        }
        assert!(messages("crates/x/src/a.rs", "fn f(x: u32) { x.ilog2(); }\n").is_empty());
    }

    #[test]
    fn long_files_and_functions_are_found_tests_apart() {
        let lines = |n: usize| "// x\n".repeat(n);
        assert_eq!(messages("crates/x/src/a.rs", &lines(MAX_FILE + 1)).len(), 1);
        assert!(messages("crates/x/src/a.rs", &lines(MAX_FILE)).is_empty());
        let tested = format!("{}#[cfg(test)]\nmod tests {{\n{}}}\n", lines(10), lines(MAX_FILE));
        assert!(messages("crates/x/src/a.rs", &tested).is_empty());

        let function = |n| format!("pub(crate) const fn f() {{\n{}}}\n", lines(n));
        assert_eq!(messages("crates/x/src/a.rs", &function(MAX_FUNCTION - 1)).len(), 1);
        assert!(messages("crates/x/src/a.rs", &function(MAX_FUNCTION - 2)).is_empty());
    }
}
