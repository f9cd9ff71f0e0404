//! The `scumble` command. `scumble render SCENE` draws a scene into a PNG, `scumble compare` draws one by
//! several settings; `warp`, `mip`, `diff`, `spectrum` and `filter` are for pictures, `info` for both.
//!
//! Exit status: 0 done, 1 failure, 2 wrong arguments, 3 a limit was hit, 4 pictures differ, 128 + n ended
//! by signal n.
//! Errors are one line each on standard error, `scumble: FILE:LINE:COLUMN: what is wrong`.

mod args;
mod compare;
mod diff;
mod error;
mod filter;
mod info;
mod input;
mod interrupt;
mod mip;
mod output;
mod picture;
mod png_sink;
mod progress;
mod render;
mod report;
mod resources;
mod settings;
mod signal;
mod size;
mod spectrum;
mod warp;

use args::{Cli, Command};
use clap::{CommandFactory, Parser};
use error::Failure;
use std::io::Write;
use std::process::ExitCode;

fn main() -> ExitCode {
    let result = match Cli::parse().command {
        Command::Render(options) => render::run(&options),
        Command::Mip(options) => mip::run(&options),
        Command::Diff(options) => diff::run(&options),
        Command::Info(options) => info::run(&options),
        Command::Compare(options) => compare::run(&options),
        Command::Spectrum(options) => spectrum::run(&options),
        Command::Filter(options) => filter::run(&options),
        Command::Warp(options) => warp::run(&options),
        Command::Completions { shell } => completions(shell),
    };
    match result {
        Ok(()) => ExitCode::SUCCESS,
        Err(failure) => {
            // That pictures differ is no error, and is said already.
            if !matches!(failure, Failure::Different) {
                error::say(&failure);
            }
            failure.exit_code()
        }
    }
}

/// Prints the completion script for `shell`.
fn completions(shell: clap_complete::Shell) -> Result<(), Failure> {
    let mut script = Vec::new();
    clap_complete::generate(shell, &mut Cli::command(), "scumble", &mut script);
    let mut out = std::io::stdout().lock();
    out.write_all(&script)
        .and_then(|()| out.flush())
        .map_err(|e| Failure::io("standard output", &e))
}
