//! `scumble warp` beside other programs: `peers --help`. `cargo xtask bench --peers` builds what it
//! needs and runs it.

use clap::Parser;
use lab::peers::{Effort, Programs, compare};
use std::error::Error;
use std::path::{Path, PathBuf};
use std::process::ExitCode;

/// Compares `scumble warp` with OpenCV and ImageMagick, as far as they are installed: errors against
/// brute force, and times in turns
#[derive(Debug, Parser)]
struct Options {
    /// A Python that has the packages numpy and opencv-python-headless
    #[arg(long, default_value = "python3")]
    python: PathBuf,
    /// ImageMagick's command
    #[arg(long, default_value = "convert")]
    magick: PathBuf,
    /// Our own command
    #[arg(long, default_value = "target/release/scumble")]
    scumble: PathBuf,
    /// How often each is timed
    #[arg(long, default_value_t = 5)]
    rounds: usize,
    /// One place in every square of so many pixels a side is compared with brute force
    #[arg(long, default_value_t = 12)]
    cell: usize,
    /// A folder for the files that the programs hand one another
    #[arg(long, default_value = "target/peers")]
    scratch: PathBuf,
    /// A page whose part between the marks of the comparison is written anew
    #[arg(long, value_name = "PAGE")]
    write: Option<PathBuf>,
}

fn main() -> ExitCode {
    match run(&Options::parse()) {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("error: {error}");
            ExitCode::FAILURE
        }
    }
}

fn run(options: &Options) -> Result<(), Box<dyn Error>> {
    let programs = Programs {
        scumble: options.scumble.clone(),
        python: options.python.clone(),
        magick: options.magick.clone(),
    };
    let effort = Effort { rounds: options.rounds, cell: options.cell.max(1) };
    let tables = compare(&programs, &options.scratch, effort)?;
    println!("{tables}");
    match &options.write {
        Some(page) => write(page, &tables),
        None => Ok(()),
    }
}

/// What stands around the tables in a page.
const MARKS: [&str; 2] = ["<!-- peers -->\n", "<!-- /peers -->"];

fn write(page: &Path, tables: &str) -> Result<(), Box<dyn Error>> {
    let text = std::fs::read_to_string(page)?;
    let found = text
        .split_once(MARKS[0])
        .and_then(|(before, rest)| rest.split_once(MARKS[1]).map(|(_, after)| (before, after)));
    let Some((before, after)) = found else {
        return Err(format!("{}: no {}", page.display(), MARKS[0].trim_end()).into());
    };
    let text = [before, MARKS[0], "\n", tables, "\n", MARKS[1], after].concat();
    Ok(std::fs::write(page, text)?)
}
