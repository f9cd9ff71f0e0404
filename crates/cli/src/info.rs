//! `scumble info`: what a file holds.

mod picture;
mod scene;

use crate::args::Info;
use crate::error::Failure;
use crate::input::Source;
use crate::picture::{Format, Limits, read_bytes};
use crate::report;
use serde_json::Value;

/// What is said of a file: lines for people, an object for programs.
struct Said {
    lines: Vec<String>,
    json: Value,
}

/// Does what the arguments say.
pub(crate) fn run(options: &Info) -> Result<(), Failure> {
    let source = Source::new(&options.file);
    source.check()?;
    let data = source.read(options.limits.max_memory)?;
    let name = source.name();
    let limits = Limits { pixels: options.limits.max_pixels, memory: options.limits.max_memory };
    let said = if Format::of_content(&data).is_none() && looks_like_text(&data) {
        scene::describe(&source, &data, options)?
    } else {
        picture::describe(&name, &read_bytes(&name, &data, limits)?, data.len())
    };
    if options.json {
        report::print(&said.json.to_string())
    } else {
        report::print(&said.lines.join("\n"))
    }
}

/// Whether a file could be a document: something other than blanks comes first, and it is `<`.
fn looks_like_text(data: &[u8]) -> bool {
    let data = data.strip_prefix(b"\xef\xbb\xbf").unwrap_or(data);
    data.trim_ascii_start().first() == Some(&b'<')
}

/// A line of a name and what it is.
fn line(name: &str, what: impl std::fmt::Display) -> String {
    format!("  {name:<12} {what}")
}
