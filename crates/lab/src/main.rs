//! `lab assets DIR` draws the assets into a folder, `lab gallery DIR` the gallery; with `--check` they
//! compare instead. `lab gallery DIR PAGE/NAME` draws one picture.

use std::error::Error;
use std::path::Path;
use std::process::ExitCode;

fn main() -> ExitCode {
    let args: Vec<String> = std::env::args().skip(1).collect();
    let args: Vec<&str> = args.iter().map(String::as_str).collect();
    let done = match args.as_slice() {
        ["assets", folder] => assets(Path::new(folder), false),
        ["assets", folder, "--check"] => assets(Path::new(folder), true),
        ["gallery", folder] => gallery(Path::new(folder), false),
        ["gallery", folder, "--check"] => gallery(Path::new(folder), true),
        ["gallery", folder, begin] => pictures(Path::new(folder), begin),
        _ => {
            eprintln!(
                "usage: lab assets|gallery DIR [--check]\n       lab gallery DIR PAGE[/NAME]"
            );
            return ExitCode::from(2);
        }
    };
    match done {
        Ok(report) => {
            println!("{report}");
            ExitCode::SUCCESS
        }
        Err(error) => {
            eprintln!("error: {error}");
            ExitCode::FAILURE
        }
    }
}

fn assets(folder: &Path, check: bool) -> Result<String, Box<dyn Error>> {
    keep(folder, check, &lab::assets()?)
}

fn gallery(folder: &Path, check: bool) -> Result<String, Box<dyn Error>> {
    keep(folder, check, &lab::gallery::files()?)
}

fn pictures(folder: &Path, begin: &str) -> Result<String, Box<dyn Error>> {
    keep(folder, false, &lab::gallery::pictures(begin)?)
}

/// Writes the files, or compares them with what stands there.
fn keep(folder: &Path, check: bool, files: &[lab::Asset]) -> Result<String, Box<dyn Error>> {
    if check {
        lab::check(folder, files)?;
    } else {
        lab::write(folder, files)?;
    }
    let total: usize = files.iter().map(|f| f.bytes.len()).sum();
    let verb = if check { "match" } else { "written" };
    Ok(format!("{} files, {} KiB: {verb}", files.len(), total / 1024))
}
