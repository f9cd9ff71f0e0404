//! What no compiler checks. Every rule is a function from text to violations, so that its tests
//! need no files.

mod budget;
mod edges;
mod links;
mod manifest;
mod rust;
mod source;
mod text;

use crate::Outcome;
use crate::commands::metadata;
use std::fmt;
use std::path::Path;
use std::process::Command;

/// A rule broken at a line of a file.
#[derive(Debug, PartialEq, Eq, PartialOrd, Ord)]
struct Violation {
    /// Relative to the root, with forward slashes.
    file: String,
    /// From 1; 0 where the file as a whole is meant.
    line: usize,
    message: String,
}

impl Violation {
    fn new(file: &str, line: usize, message: impl Into<String>) -> Self {
        Self { file: file.to_owned(), line, message: message.into() }
    }
}

impl fmt::Display for Violation {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}:{}: {}", self.file, self.line, self.message)
    }
}

/// Checks the whole tree and prints every violation.
pub(crate) fn run(root: &Path) -> Outcome {
    let files = tracked(root)?;
    let mut found = edges::check(&metadata()?);
    found.extend(budget::check(root, &files));
    found.extend(budget::licences(&files));
    for file in &files {
        let bytes = std::fs::read(root.join(file)).map_err(|e| format!("{file}: {e}"))?;
        found.extend(check_file(root, file, &bytes));
    }
    found.extend(rust::driver_size(root, &files));
    found.sort();
    for violation in &found {
        println!("{violation}");
    }
    match found.len() {
        0 => {
            println!("tidy: {} files, nothing to mend", files.len());
            Ok(())
        }
        n => Err(format!("tidy: {n} to mend")),
    }
}

fn check_file(root: &Path, file: &str, bytes: &[u8]) -> Vec<Violation> {
    let extension = file.rsplit('.').next().unwrap_or_default();
    if matches!(extension, "png" | "jpg" | "jpeg" | "gif" | "webp") {
        return Vec::new();
    }
    let Ok(content) = std::str::from_utf8(bytes) else {
        return vec![Violation::new(file, 0, "is not UTF-8")];
    };
    let mut found = text::check(file, content);
    match extension {
        "rs" => found.extend(rust::check(file, content)),
        "md" => found.extend(links::check(file, content, &|path| root.join(path).exists())),
        "toml" if file.ends_with("Cargo.toml") && file != "Cargo.toml" => {
            found.extend(manifest::check(file, content));
        }
        _ => {}
    }
    found
}

/// Every file that git tracks or would: what is new counts, what is ignored does not.
fn tracked(root: &Path) -> Result<Vec<String>, String> {
    let output = Command::new("git")
        .args(["ls-files", "-z", "--cached", "--others", "--exclude-standard"])
        .current_dir(root)
        .output()
        .map_err(|e| format!("git could not be started: {e}"))?;
    if !output.status.success() {
        return Err("tidy reads the list of files from git, and this is no checkout".to_owned());
    }
    let names = String::from_utf8(output.stdout).map_err(|_| "a file name is not UTF-8")?;
    let mut files: Vec<String> = names
        .split('\0')
        .filter(|name| !name.is_empty() && root.join(name).is_file())
        .map(str::to_owned)
        .collect();
    files.sort();
    files.dedup();
    Ok(files)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bytes_that_are_no_text_are_found() {
        let found = check_file(Path::new("."), "notes.txt", b"caf\xe9\n");
        assert_eq!(found, [Violation::new("notes.txt", 0, "is not UTF-8")]);
        assert!(check_file(Path::new("."), "a.png", b"\x89PNG\xff").is_empty());
    }

    #[test]
    fn a_violation_reads_as_a_compiler_message() {
        assert_eq!(Violation::new("a/b.rs", 7, "tab").to_string(), "a/b.rs:7: tab");
    }
}
