//! The development commands: `cargo xtask help` lists them.
//!
//! This crate depends on none of ours, so that it builds in moments and works while they do not;
//! what needs them it spawns through cargo.

mod commands;
mod golden;
mod tidy;

use std::path::PathBuf;
use std::process::ExitCode;

const HELP: &str = "\
cargo xtask COMMAND

  ci                                  everything that must hold before a change lands
  tidy                                what no compiler checks: edges between crates, file sizes,
                                      links, stray marks
  assets [--check]                    draw assets/ anew, or compare it with what the code draws
  golden [run|bless|report] [FILTER]  compare pictures with their references; accept what was
                                      rendered; write one page that shows them all
  quality [--check] [--times]         judge the texture filters against brute force and write
                                      docs/quality.md, or compare it; say what they take
  gallery [--check | PAGE[/NAME]]     draw docs/gallery/ anew, or compare it; or the pictures of one
                                      page, or one picture
  bench [ARGS]                        cargo bench over the workspace
  bench --peers [ARGS]                scumble warp beside OpenCV and ImageMagick, where they are
                                      installed (--help lists the arguments)
  help                                this text
";

/// What a command comes to: the reason, if it failed.
type Outcome = Result<(), String>;

fn main() -> ExitCode {
    let args: Vec<String> = std::env::args().skip(1).collect();
    let args: Vec<&str> = args.iter().map(String::as_str).collect();
    let outcome = match args.as_slice() {
        ["ci"] => commands::ci(),
        ["tidy"] => tidy::run(&root()),
        ["assets"] => commands::assets(false),
        ["assets", "--check"] => commands::assets(true),
        ["golden", rest @ ..] => golden::run(rest),
        ["quality", rest @ ..] => commands::quality(rest),
        ["gallery"] => commands::gallery(None),
        ["gallery", one] => commands::gallery(Some(one)),
        ["bench", rest @ ..] => commands::bench(rest),
        [] | ["help" | "--help" | "-h"] => {
            print!("{HELP}");
            Ok(())
        }
        _ => {
            eprint!("{HELP}");
            return ExitCode::from(2);
        }
    };
    match outcome {
        Ok(()) => ExitCode::SUCCESS,
        Err(reason) => {
            eprintln!("error: {reason}");
            ExitCode::FAILURE
        }
    }
}

/// The root of the workspace: the folder above this crate.
fn root() -> PathBuf {
    let mut path = PathBuf::from(env!("CARGO_MANIFEST_DIR"));
    path.pop();
    path
}
