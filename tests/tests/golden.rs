//! Every picture is its reference, to the byte: one test for each file under `cases/`.
//!
//! `cargo xtask golden` runs this, `cargo xtask golden bless NAME` accepts what was rendered.

use libtest_mimic::{Arguments, Failed, Trial};
use scumble_tests::{Case, Golden, Mode, picture, scene_names};
use std::path::{Path, PathBuf};
use std::process::ExitCode;

fn main() -> ExitCode {
    let args = Arguments::from_args();
    let mode = match std::env::var("SCUMBLE_GOLDEN").as_deref() {
        Ok("bless") => Mode::Bless,
        _ => Mode::Compare,
    };
    let cases = match cases() {
        Ok(cases) => cases,
        Err(error) => {
            eprintln!("{error}");
            return ExitCode::FAILURE;
        }
    };
    let names: Vec<String> = cases.iter().map(|path| name_of(path)).collect();
    let mut trials: Vec<Trial> = cases
        .into_iter()
        .map(|path| Trial::test(name_of(&path), move || run(&path, mode).map_err(Failed::from)))
        .collect();
    trials.push(Trial::test("every_scene_has_a_case", every_scene_has_a_case));
    trials.push(Trial::test("every_reference_has_a_case", move || orphans(&names)));
    libtest_mimic::run(&args, trials).exit_code()
}

fn here() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

fn name_of(path: &Path) -> String {
    path.file_stem().unwrap_or_default().to_string_lossy().into_owned()
}

/// Every file of a folder with the given extension, sorted.
fn files(folder: &Path, extension: &str) -> Result<Vec<PathBuf>, String> {
    let at = |e: std::io::Error| format!("{}: {e}", folder.display());
    let mut found = Vec::new();
    for entry in std::fs::read_dir(folder).map_err(at)? {
        let path = entry.map_err(at)?.path();
        if path.extension().is_some_and(|e| e == extension) {
            found.push(path);
        }
    }
    found.sort();
    Ok(found)
}

fn cases() -> Result<Vec<PathBuf>, String> {
    files(&here().join("cases"), "case")
}

fn read(path: &Path) -> Result<Case, String> {
    let text = std::fs::read_to_string(path).map_err(|e| format!("{}: {e}", path.display()))?;
    Case::parse(&text).map_err(|e| format!("{}: {e}", path.display()))
}

fn run(path: &Path, mode: Mode) -> Result<(), String> {
    let golden = Golden {
        name: name_of(path),
        references: here().join("golden"),
        results: Path::new(env!("CARGO_TARGET_TMPDIR")).join("golden"),
    };
    golden.judge(&picture(&read(path)?)?, mode)
}

fn every_scene_has_a_case() -> Result<(), Failed> {
    let drawn: Vec<String> =
        cases()?.iter().map(|path| Ok(read(path)?.scene)).collect::<Result<_, String>>()?;
    let missing: Vec<String> =
        scene_names()?.into_iter().filter(|name| !drawn.contains(name)).collect();
    if missing.is_empty() { Ok(()) } else { Err(format!("no case for {missing:?}").into()) }
}

fn orphans(names: &[String]) -> Result<(), Failed> {
    let references = files(&here().join("golden"), "png")?;
    let orphans: Vec<String> =
        references.iter().map(|path| name_of(path)).filter(|name| !names.contains(name)).collect();
    if orphans.is_empty() { Ok(()) } else { Err(format!("no case for {orphans:?}").into()) }
}
