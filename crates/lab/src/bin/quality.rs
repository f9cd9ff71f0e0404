//! The page on the quality of the texture filters: `quality DOCS [--check] [--times]` measures, prints
//! the tables, and writes the page and its pictures below DOCS, or compares them.

use std::error::Error;
use std::path::Path;
use std::process::ExitCode;

fn main() -> ExitCode {
    let args: Vec<String> = std::env::args().skip(1).collect();
    let (flags, folders): (Vec<&str>, Vec<&str>) =
        args.iter().map(String::as_str).partition(|a| a.starts_with("--"));
    let known = flags.iter().all(|f| ["--check", "--times"].contains(f));
    let ([folder], true) = (folders.as_slice(), known) else {
        eprintln!("usage: quality DOCS [--check] [--times]");
        return ExitCode::from(2);
    };
    match run(Path::new(folder), &flags) {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("error: {error}");
            ExitCode::FAILURE
        }
    }
}

fn run(folder: &Path, flags: &[&str]) -> Result<(), Box<dyn Error>> {
    let report = lab::quality::measure(lab::quality::FULL)?;
    println!("{}\n\n{}\n", report.tables(), report.sweep());
    let files = lab::quality::files(&report)?;
    if flags.contains(&"--check") {
        lab::check_files(folder, &files)?;
    } else {
        lab::write(folder, &files)?;
    }
    if flags.contains(&"--times") {
        println!("{}", lab::quality::times()?);
    }
    Ok(())
}
