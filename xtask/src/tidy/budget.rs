//! What is checked in stays small, and says under which terms.

use super::Violation;
use std::path::Path;

/// Folders and the bytes that all their files together may take.
const BUDGETS: [(&str, u64); 3] =
    [("assets/", 3 << 20), ("docs/gallery/", 12 << 20), ("tests/golden/", 4 << 20)];

/// Bytes that a single file may take anywhere.
const MAX_FILE: u64 = 1 << 20;

const LICENCES: [&str; 2] = ["LICENSE-APACHE", "LICENSE-MIT"];

/// Checks the size of every folder with a budget, and of every file.
pub(super) fn check(root: &Path, files: &[String]) -> Vec<Violation> {
    let size = |file: &String| std::fs::metadata(root.join(file)).map_or(0, |m| m.len());
    let sizes: Vec<(&str, u64)> = files.iter().map(|f| (f.as_str(), size(f))).collect();
    over_budget(&sizes)
}

fn over_budget(sizes: &[(&str, u64)]) -> Vec<Violation> {
    let mut found = Vec::new();
    for (folder, budget) in BUDGETS {
        let total: u64 = sizes.iter().filter(|(f, _)| f.starts_with(folder)).map(|(_, n)| n).sum();
        if total > budget {
            let message = format!("{} KiB; the budget is {} KiB", total >> 10, budget >> 10);
            found.push(Violation::new(folder, 0, message));
        }
    }
    for (file, size) in sizes.iter().filter(|(_, size)| *size > MAX_FILE) {
        found.push(Violation::new(file, 0, format!("{} KiB is too much for one file", size >> 10)));
    }
    found
}

/// Checks that the texts of both licences are there.
pub(super) fn licences(files: &[String]) -> Vec<Violation> {
    let missing = LICENCES.iter().filter(|name| !files.iter().any(|f| f == *name));
    missing.map(|name| Violation::new(name, 0, "the text of the licence is missing")).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn too_much_is_found_and_enough_is_not() {
        assert_eq!(over_budget(&[("assets/a", MAX_FILE), ("src/b", MAX_FILE)]), []);
        assert_eq!(over_budget(&[("src/b", MAX_FILE + 1)]).len(), 1);
        let four = ["assets/a", "assets/b", "assets/c", "assets/d"].map(|f| (f, MAX_FILE));
        assert_eq!(over_budget(&four).len(), 1);
    }

    #[test]
    fn a_missing_licence_is_found() {
        let both = LICENCES.map(str::to_owned);
        assert_eq!(licences(&both), []);
        assert_eq!(licences(&both[..1]).len(), 1);
    }
}
