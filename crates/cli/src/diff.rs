//! `scumble diff`: two pictures compared.

mod measure;
mod triptych;

use crate::args::{Diff, STANDARD_STREAM};
use crate::error::{Failure, say, warn};
use crate::input::Source;
use crate::interrupt::Interrupt;
use crate::output::{Request, Target};
use crate::picture::{Format, Limits, Picture, read};
use crate::progress::Steps;
use crate::report;
use measure::{Comparison, Seen};
use serde_json::json;
use std::path::Path;

/// Does what the arguments say. Pictures that differ end it with [`Failure::Different`].
pub(crate) fn run(options: &Diff) -> Result<(), Failure> {
    let interrupt = Interrupt::install()?;
    let limits =
        Limits { pixels: options.limits.max_pixels, memory: options.limits.max_memory / 2 };
    let sources = [Source::new(&options.a), Source::new(&options.b)];
    if sources == [Source::Stdin, Source::Stdin] {
        return Err(Failure::Usage("only one of the pictures can be standard input".to_owned()));
    }
    let target = target(options, &sources)?;
    let [a, b] = [read(&sources[0], limits)?, read(&sources[1], limits)?];
    let names = sources.map(|s| s.name());
    if !options.quiet {
        warn(&names[0], &a.origin.notes);
        warn(&names[1], &b.origin.notes);
    }
    if (a.width, a.height) != (b.width, b.height) {
        return sizes_differ(options, &names, [&a, &b]);
    }
    let seen = Seen::pair(&a, &b);
    let passes = if target.is_some() { 2 } else { 1 };
    let steps = Steps::new(options.quiet || options.json, passes * u64::from(a.height));
    let comparison = Comparison::new(&seen, options.tolerance, &steps);
    if let Some(target) = &target {
        triptych::write(&seen, &comparison, target, &interrupt, &steps)?;
        interrupt.release();
    }
    steps.clear();
    let to_stdout = matches!(target, Some(Target::Stdout));
    if options.json {
        report::print(&comparison.json(&names).to_string())?;
    } else if !to_stdout && !options.quiet {
        report::print(&comparison.to_string())?;
    }
    if comparison.beyond == 0 { Ok(()) } else { Err(Failure::Different) }
}

/// Where the triptych goes.
fn target(options: &Diff, sources: &[Source; 2]) -> Result<Option<Target>, Failure> {
    let Some(out) = options.output.as_deref() else { return Ok(None) };
    if out != Path::new(STANDARD_STREAM) && Format::of_name(out).is_some_and(|f| f != Format::Png) {
        return Err(Failure::Usage(format!("{}: the triptych is a PNG", out.display())));
    }
    let (force, json) = (options.force, options.json);
    let request = Request { out: Some(out), force, json };
    let target = Target::new(&request, &sources[0])?;
    target.check_apart(&sources[1], force)?;
    Ok(Some(target))
}

fn sizes_differ(options: &Diff, names: &[String; 2], [a, b]: [&Picture; 2]) -> Result<(), Failure> {
    let text = if options.json {
        let size = |p: &Picture| json!({ "width": p.width, "height": p.height });
        json!({
            "a": names[0], "b": names[1], "same": false, "why": "size",
            "size_a": size(a), "size_b": size(b),
        })
        .to_string()
    } else {
        format!("sizes differ: {} × {} and {} × {}", a.width, a.height, b.width, b.height)
    };
    // Nothing but a triptych goes to standard output where that goes there.
    if options.output.as_deref() == Some(Path::new(STANDARD_STREAM)) {
        say(&text);
    } else if !options.quiet {
        report::print(&text)?;
    }
    Err(Failure::Different)
}
