//! `cargo xtask golden`: runs the picture tests, accepts their pictures, or shows them all.

use crate::commands::{cargo, finish, metadata};
use crate::{Outcome, root};
use serde_json::Value;
use std::fmt::Write as _;
use std::path::{Path, PathBuf};

/// Where the harness leaves its pictures and reports, below the target folder.
const RESULTS: &str = "tmp/golden";

pub(crate) fn run(args: &[&str]) -> Outcome {
    let (mode, filter) = match args {
        [] => ("run", None),
        [mode @ ("run" | "bless" | "report")] => (*mode, None),
        [mode @ ("run" | "bless" | "report"), filter] => (*mode, Some(*filter)),
        [filter] => ("run", Some(*filter)),
        _ => return Err("usage: golden [run|bless|report] [FILTER]".to_owned()),
    };
    let metadata = metadata()?;
    let target = metadata["target_directory"].as_str().ok_or("cargo metadata names no target")?;
    let folder = Path::new(target).join(RESULTS);
    if filter.is_none() && folder.exists() {
        // Reports of cases that are gone would look like failures.
        std::fs::remove_dir_all(&folder).map_err(|e| format!("{}: {e}", folder.display()))?;
    }
    let mut command = cargo(["test", "--quiet", "-p", "scumble-tests", "--test", "golden", "--"]);
    command.args(filter);
    if mode == "bless" {
        command.env("SCUMBLE_GOLDEN", "bless");
    }
    let outcome = finish(&mut command, "the picture tests");
    if mode != "report" {
        return outcome;
    }
    let page = report(&folder)?;
    println!("{}", page.display());
    outcome
}

/// Writes `index.html` over the harness's reports and gives its path.
fn report(folder: &Path) -> Result<PathBuf, String> {
    let at = |e: std::io::Error| format!("{}: {e}", folder.display());
    let mut reports = Vec::new();
    for entry in std::fs::read_dir(folder).map_err(at)? {
        let path = entry.map_err(at)?.path();
        if path.extension().is_some_and(|e| e == "json") {
            let text = std::fs::read(&path).map_err(at)?;
            let value = serde_json::from_slice(&text).map_err(|e| format!("{path:?}: {e}"))?;
            reports.push(value);
        }
    }
    let page = folder.join("index.html");
    std::fs::write(&page, html(reports, &root().join("tests/golden"))).map_err(at)?;
    Ok(page)
}

const HEAD: &str = "<!doctype html>\n<meta charset=\"utf-8\">\n<title>Goldens</title>\n<style>\n\
    body { font: 14px/1.5 sans-serif; margin: 2em; background: #e8e8e8; color: #222 }\n\
    section { display: inline-block; vertical-align: top; margin: 0 1em 1.5em 0 }\n\
    img { display: block; background: #fff; max-width: 100% }\n\
    .failed h2 { color: #b00020 } h2 { font-size: 1em; margin: 0 }\n</style>\n";

/// One page: what failed first, as triptychs, then every reference.
fn html(mut reports: Vec<Value>, references: &Path) -> String {
    let name = |r: &Value| r["name"].as_str().unwrap_or_default().to_owned();
    let passed = |r: &Value| r["status"] == "equal";
    reports.sort_by_key(|r| (passed(r), name(r)));
    let failures = reports.iter().filter(|r| !passed(r)).count();
    let mut page = format!("{HEAD}<h1>{} pictures, {failures} to look at</h1>\n", reports.len());
    for report in &reports {
        let name = escaped(&name(report));
        let (class, text, picture) = if passed(report) {
            ("passed", String::new(), references.join(format!("{name}.png")).display().to_string())
        } else {
            let text = match (report["count"].as_u64(), report["max_difference"].as_u64()) {
                (Some(count), Some(most)) => format!(
                    "<p>{count} pixels differ, by up to {most} levels (expected, difference, \
                     actual)</p>"
                ),
                _ if report["status"] == "missing" => "<p>There is no reference.</p>".to_owned(),
                _ => "<p>The size differs.</p>".to_owned(),
            };
            let picture = report["picture"].as_str().unwrap_or_default();
            ("failed", text, picture.to_owned())
        };
        // Writing to a string does not fail.
        let _ = writeln!(
            page,
            "<section class=\"{class}\"><h2>{name}</h2>{text}<img src=\"{}\" alt=\"{name}\"></section>",
            escaped(&picture)
        );
    }
    page
}

fn escaped(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('"', "&quot;")
}

#[cfg(test)]
mod tests {
    use super::*;
    use serde_json::json;

    #[test]
    fn failures_come_first_and_names_are_escaped() {
        let page = html(
            vec![
                json!({ "name": "a", "status": "equal" }),
                json!({ "name": "z<", "status": "different", "count": 3, "max_difference": 9,
                        "picture": "z.png" }),
                json!({ "name": "y", "status": "missing", "picture": "y.png" }),
            ],
            Path::new("refs"),
        );
        assert!(page.contains("3 pictures, 2 to look at"));
        let (failed, passed) = (page.find("z&lt;"), page.find("<h2>a</h2>"));
        assert!(failed.is_some() && failed < passed);
        assert!(page.contains("3 pixels differ, by up to 9 levels"));
        assert!(page.contains("There is no reference"));
        assert!(!page.contains("z<"));
    }
}
