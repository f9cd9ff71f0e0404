use super::{Said, line};
use crate::picture::{Picture, Tone};
use serde_json::json;

/// What a picture is.
pub(super) fn describe(name: &str, picture: &Picture, bytes: usize) -> Said {
    let Picture { width, height, channels, premultiplied, origin, .. } = picture;
    let depth = origin.depth.name();
    let alpha = match (channels.has_alpha(), premultiplied, picture.is_opaque()) {
        (false, ..) => "none",
        (true, _, true) => "opaque everywhere",
        (true, true, _) => "premultiplied",
        (true, false, _) => "straight",
    };
    let profile = picture.profile_name();
    let numbers = match picture.tone {
        Tone::Srgb => "encoded by the curve of sRGB",
        Tone::Linear => "proportional to light",
        Tone::Curves(_) => "encoded by the profile's curves",
    };
    let mut lines = vec![
        format!(
            "{name}: {}, {width} × {height}, {depth} {}",
            origin.format.name(),
            channels.name()
        ),
        line("file", format_args!("{bytes} bytes")),
        line("alpha", alpha),
        line("profile", profile.as_deref().unwrap_or("none")),
        line("numbers", numbers),
    ];
    if origin.orientation != 1 {
        let text = format!("{}, applied: the size above is upright", origin.orientation);
        lines.push(line("orientation", text));
    }
    lines.extend(origin.notes.iter().map(|note| line("note", note)));
    let tone = match picture.tone {
        Tone::Srgb => "srgb",
        Tone::Linear => "linear",
        Tone::Curves(_) => "profile",
    };
    let json = json!({
        "file": name,
        "kind": "picture",
        "format": origin.format.name(),
        "bytes": bytes,
        "width": width,
        "height": height,
        "channels": channels.name(),
        "bits": origin.depth.bits(),
        "float": origin.depth.is_float(),
        "alpha": alpha,
        "profile": profile,
        "profile_bytes": picture.icc.as_ref().map(Vec::len),
        "tone": tone,
        "orientation": origin.orientation,
        "notes": origin.notes,
    });
    Said { lines, json }
}
