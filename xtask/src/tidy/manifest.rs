//! Every crate takes its version, edition, licence, lints and dependencies from the workspace.

use super::Violation;

const INHERITED: [&str; 4] = ["version", "edition", "rust-version", "license"];

/// Checks the manifest of a member.
pub(super) fn check(file: &str, content: &str) -> Vec<Violation> {
    let mut found = Vec::new();
    let has = |line: &str| content.lines().any(|l| l.trim() == line);
    for key in INHERITED {
        if !has(&format!("{key}.workspace = true")) {
            found.push(Violation::new(file, 1, format!("`{key}.workspace = true` is missing")));
        }
    }
    if !content.contains("[lints]\nworkspace = true\n") {
        found.push(Violation::new(file, 1, "`[lints] workspace = true` is missing"));
    }
    if !content.lines().any(|l| l.starts_with("description = \"")) {
        found.push(Violation::new(file, 1, "a crate says what it is: `description`"));
    }
    let mut dependencies = false;
    for (index, line) in content.lines().enumerate() {
        let line = line.trim();
        if line.starts_with('[') {
            dependencies = line.ends_with("dependencies]");
        } else if dependencies && line.contains('=') && !line.starts_with('#') {
            let inherits = line.contains(".workspace = true") || line.contains("workspace = true");
            if !inherits {
                let message = "the version of a dependency stands in the workspace's manifest";
                found.push(Violation::new(file, index + 1, message));
            }
        }
    }
    found
}

#[cfg(test)]
mod tests {
    use super::*;

    const GOOD: &str = "[package]\nname = \"x\"\ndescription = \"X\"\nversion.workspace = true\n\
        edition.workspace = true\nrust-version.workspace = true\nlicense.workspace = true\n\n\
        [lints]\nworkspace = true\n\n[dependencies]\n# why\na.workspace = true\n\
        b = { workspace = true, optional = true }\n";

    #[test]
    fn a_manifest_that_inherits_passes() {
        assert_eq!(check("Cargo.toml", GOOD), []);
    }

    #[test]
    fn whatever_is_taken_away_is_missed() {
        for line in [
            "description = \"X\"\n",
            "[lints]\n",
            "license.workspace = true\n",
            "edition.workspace = true\n",
        ] {
            let found = check("Cargo.toml", &GOOD.replace(line, ""));
            assert_eq!(found.len(), 1, "{line}");
        }
    }

    #[test]
    fn a_version_of_its_own_is_found() {
        let found = check("Cargo.toml", &format!("{GOOD}c = \"1.0\"\n"));
        assert_eq!(found.len(), 1);
        assert_eq!(found[0].line, 16);
    }
}
