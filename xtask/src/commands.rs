//! Commands that only call others.

use crate::{Outcome, root, tidy};
use serde_json::Value;
use std::process::Command;
use std::time::Instant;

/// A step of [`ci`]: its name, the arguments to cargo, and environment variables to set.
struct Step {
    name: &'static str,
    args: &'static str,
    envs: &'static [(&'static str, &'static str)],
}

const fn step(name: &'static str, args: &'static str) -> Step {
    Step { name, args, envs: &[] }
}

/// Quick ones first. The last is the README's first command.
const STEPS: [Step; 11] = [
    step("format", "fmt --all -- --check"),
    step("clippy", "clippy --workspace --all-targets --all-features -- -D warnings"),
    Step {
        name: "documentation",
        args: "doc --workspace --no-deps --all-features",
        envs: &[("RUSTDOCFLAGS", "-D warnings")],
    },
    step(
        "geometry without std",
        "check -p scumble-geometry --no-default-features --features libm,paths",
    ),
    step("pixel without std", "check -p scumble-pixel --no-default-features"),
    step("coverage without std", "check -p scumble-coverage --no-default-features --features libm"),
    step("framebuffer without std", "check -p scumble-framebuffer --no-default-features"),
    step("texture without std", "check -p scumble-texture --no-default-features --features libm"),
    step("tests", "test --workspace"),
    // By the build of the tests, so that nothing is compiled for it.
    step("gallery", "run --quiet -p lab --bin lab -- gallery docs/gallery --check"),
    step(
        "a picture",
        "run --release -- render assets/scenes/ground.svg -o target/ground.png --force",
    ),
];

/// `cargo` with the given arguments, in the root of the workspace.
pub(crate) fn cargo<'a>(args: impl IntoIterator<Item = &'a str>) -> Command {
    let mut command = Command::new(std::env::var_os("CARGO").unwrap_or_else(|| "cargo".into()));
    command.args(args).current_dir(root());
    command
}

/// The workspace as cargo sees it.
pub(crate) fn metadata() -> Result<Value, String> {
    let output = cargo(["metadata", "--format-version", "1", "--no-deps"])
        .output()
        .map_err(|e| format!("cargo metadata could not be started: {e}"))?;
    serde_json::from_slice(&output.stdout).map_err(|e| format!("cargo metadata: {e}"))
}

/// Runs a command to its end; a failure is an error that names it.
pub(crate) fn finish(command: &mut Command, name: &str) -> Outcome {
    match command.status() {
        Ok(status) if status.success() => Ok(()),
        Ok(status) => Err(format!("{name} failed ({status})")),
        Err(e) => Err(format!("{name} could not be started: {e}")),
    }
}

/// Tidy, then every step in turn; stops at the first that fails.
pub(crate) fn ci() -> Outcome {
    let start = Instant::now();
    println!("== tidy");
    tidy::run(&root())?;
    for Step { name, args, envs } in STEPS {
        println!("== {name}: cargo {args}");
        let began = Instant::now();
        finish(cargo(args.split(' ')).envs(envs.iter().copied()), name)?;
        println!("== {name}: done in {} s", began.elapsed().as_secs());
    }
    println!("== all done in {} s", start.elapsed().as_secs());
    Ok(())
}

/// Has the lab draw the assets, or compare them.
pub(crate) fn assets(check: bool) -> Outcome {
    let mut command = cargo(["run", "--quiet", "-p", "lab", "--", "assets", "assets"]);
    if check {
        command.arg("--check");
    }
    finish(&mut command, "lab assets")
}

/// Has the lab judge the texture filters and write the page, or compare it.
pub(crate) fn quality(args: &[&str]) -> Outcome {
    let run = ["run", "--release", "--quiet", "-p", "lab", "--bin", "quality", "--", "docs"];
    finish(cargo(run).args(args), "quality")
}

/// Has the lab draw the gallery, or compare it (`--check`), or draw a part of it.
pub(crate) fn gallery(how: Option<&str>) -> Outcome {
    let run = ["run", "--release", "--quiet", "-p", "lab", "--bin", "lab", "--", "gallery"];
    finish(cargo(run).arg("docs/gallery").args(how), "lab gallery")
}

/// `cargo bench` over the workspace with the given arguments; after `--peers`, the comparison with
/// other programs, with arguments for it.
pub(crate) fn bench(args: &[&str]) -> Outcome {
    if let ["--peers", rest @ ..] = args {
        finish(&mut cargo(["build", "--release", "-p", "scumble-cli"]), "the build of scumble")?;
        let run = ["run", "--release", "--quiet", "-p", "lab", "--bin", "peers", "--"];
        return finish(cargo(run).args(rest), "the comparison");
    }
    finish(cargo(["bench", "--workspace"]).args(args), "cargo bench")
}
