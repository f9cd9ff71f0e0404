use super::{Said, line};
use crate::args::Info;
use crate::error::Failure;
use crate::input::Source;
use crate::report::{located, warning_json, warning_line};
use crate::resources::Folders;
use scumble::scene::{Command, Scene};
use scumble_svg::{Limits, Options, Profile};
use serde_json::{Map, Value, json};

/// What a scene is.
pub(super) fn describe(source: &Source, text: &[u8], options: &Info) -> Result<Said, Failure> {
    let mut limits = Limits::default();
    limits.max_image_pixels = options.limits.max_pixels;
    limits.max_image_bytes = options.limits.max_memory;
    let max_file = limits.max_file_bytes as u64;
    let folders = Folders::new(source.folder(), &options.resources, max_file)?;
    let how = Options::default().with_resources(&folders).with_limits(limits);
    let name = source.name();
    let parsed = scumble_svg::parse(text, &how).map_err(|e| {
        let line = located(&name, e.position(), &e.kind().to_string());
        if e.is_limit() { Failure::Limit(line) } else { Failure::Failed(line) }
    })?;

    let size = parsed.scene.view.size();
    let profile = match parsed.profile {
        Profile::Svg => "svg",
        Profile::Course => "course",
    };
    let counts = counts(&parsed.scene);
    let drawn: Vec<String> =
        counts.iter().filter(|(_, n)| *n > 0).map(|&(what, n)| counted(what, n)).collect();
    let images: Vec<(usize, usize)> =
        parsed.scene.images.iter().map(|i| (i.pixels.width(), i.pixels.height())).collect();
    let mut lines = vec![
        format!("{name}: scene, {} × {}, profile {profile}", size.x, size.y),
        line("file", format_args!("{} bytes", text.len())),
        line("draws", if drawn.is_empty() { "nothing".to_owned() } else { drawn.join(", ") }),
    ];
    lines.extend(images.iter().map(|(w, h)| line("image", format_args!("{w} × {h}"))));
    lines.extend(parsed.warnings.iter().map(|w| warning_line(&name, w)));
    let json = json!({
        "file": name,
        "kind": "scene",
        "bytes": text.len(),
        "width": size.x,
        "height": size.y,
        "profile": profile,
        "primitives": counts.iter().map(|&(k, n)| (k.to_owned(), n.into())).collect::<Map<String, Value>>(),
        "images": images.iter().map(|&(w, h)| json!({ "width": w, "height": h })).collect::<Vec<_>>(),
        "warnings": parsed.warnings.iter().map(warning_json).collect::<Vec<_>>(),
    });
    Ok(Said { lines, json })
}

/// A number of things, given their plural.
fn counted(things: &str, n: u64) -> String {
    let thing = if n == 1 { things.strip_suffix('s').unwrap_or(things) } else { things };
    format!("{n} {thing}")
}

/// How often each kind of command occurs.
fn counts(scene: &Scene) -> [(&'static str, u64); 8] {
    let mut counts = [
        ("fills", 0),
        ("strokes", 0),
        ("coloured triangles", 0),
        ("textured triangles", 0),
        ("pictures", 0),
        ("hairlines", 0),
        ("points", 0),
        ("groups", 0),
    ];
    for command in &scene.commands {
        let kind = match command {
            Command::Fill(_) => 0,
            Command::Stroke(_) => 1,
            Command::Gouraud(_) => 2,
            Command::Textured(_) => 3,
            Command::Image(_) => 4,
            Command::Hairline(_) => 5,
            Command::Point(_) => 6,
            Command::PushLayer { .. } => 7,
            Command::PopLayer => continue,
        };
        counts[kind].1 += 1;
    }
    counts
}
