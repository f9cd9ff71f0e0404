//! `cargo xtask golden`: runs the picture tests, accepts their pictures, or shows them all.

use crate::commands::{cargo, finish};
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
    let mut command = cargo(["test", "--quiet", "-p", "scumble-tests", "--test", "golden", "--"]);
    command.args(filter);
    if mode == "bless" {
        command.env("SCUMBLE_GOLDEN", "bless");
    }
    let outcome = finish(&mut command, "the picture tests");
    if mode != "report" {
        return outcome;
    }
    let folder = target()?.join(RESULTS);
    let page = report(&folder)?;
    println!("{}", page.display());
    outcome
}

/// The target folder, wherever the configuration puts it.
fn target() -> Result<PathBuf, String> {
    let output = cargo(["metadata", "--format-version", "1", "--no-deps"])
        .output()
        .map_err(|e| format!("cargo metadata could not be started: {e}"))?;
    let metadata: Value =
        serde_json::from_slice(&output.stdout).map_err(|e| format!("cargo metadata: {e}"))?;
    let folder = metadata["target_directory"].as_str().ok_or("cargo metadata names no target")?;
    Ok(PathBuf::from(folder))
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
            let text = format!(
                "<p>{}: {} pixels differ, by up to {} levels (expected, difference, actual)</p>",
                escaped(report["status"].as_str().unwrap_or_default()),
                report["count"],
                report["max_difference"]
            );
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
            ],
            Path::new("refs"),
        );
        assert!(page.contains("2 pictures, 1 to look at"));
        let (failed, passed) = (page.find("z&lt;"), page.find("<h2>a</h2>"));
        assert!(failed.is_some() && failed < passed);
        assert!(page.contains("3 pixels differ, by up to 9 levels"));
        assert!(!page.contains("z<"));
    }
}
