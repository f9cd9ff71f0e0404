//! The `scumble` command. `scumble render SCENE` draws a scene into a PNG,
//! `scumble warp IN` a picture as it is seen another way.
//!
//! Exit status: 0 done, 1 failure, 2 wrong arguments, 3 a limit was hit, 128 + n ended by signal n.
//! Errors are one line each on standard error, `scumble: FILE:LINE:COLUMN: what is wrong`.

mod args;
mod error;
mod input;
mod interrupt;
mod output;
#[allow(dead_code, unused_imports)]
mod picture;
mod png_sink;
mod progress;
mod render;
mod report;
mod resources;
mod settings;
mod size;
mod warp;

use args::{Cli, Command};
use clap::{CommandFactory, Parser};
use error::Failure;
use std::io::Write;
use std::process::ExitCode;

fn main() -> ExitCode {
    let result = match Cli::parse().command {
        Command::Render(options) => render::run(&options),
        Command::Warp(options) => warp::run(&options),
        Command::Completions { shell } => completions(shell),
    };
    match result {
        Ok(()) => ExitCode::SUCCESS,
        Err(failure) => {
            error::say(&failure);
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
