//! What a run says of itself: warnings for people, one JSON object for programs.

use crate::args::choice_name;
use crate::error::{Failure, say};
use crate::settings::Choices;
use crate::size::Canvas;
use scumble_svg::{Position, Profile, Warning};
use serde_json::{Value, json};
use std::io::Write;
use std::time::Duration;

/// Warnings that are printed one by one; the report has them all.
const SHOWN_WARNINGS: usize = 20;

/// `name:line:column: message`, without what is not known.
pub(crate) fn located(name: &str, position: Option<Position>, message: &str) -> String {
    match position {
        Some(Position { line, column, .. }) => format!("{name}:{line}:{column}: {message}"),
        None => format!("{name}: {message}"),
    }
}

/// Prints the warnings about the scene called `name`.
pub(crate) fn warn(name: &str, warnings: &[Warning]) {
    for warning in warnings.iter().take(SHOWN_WARNINGS) {
        say(&warning_line(name, warning));
    }
    let hidden = warnings.len().saturating_sub(SHOWN_WARNINGS);
    if hidden > 0 {
        say(&format!("{name}: warning: and {hidden} more kinds (--json lists them)"));
    }
}

/// A warning on a line.
pub(crate) fn warning_line(name: &str, warning: &Warning) -> String {
    let times =
        if warning.count > 1 { format!(" ({} times)", warning.count) } else { String::new() };
    located(name, warning.position, &format!("warning: {}{times}", warning.message))
}

/// Prints a text and the end of its line on standard output.
pub(crate) fn print(text: &str) -> Result<(), Failure> {
    let mut out = std::io::stdout().lock();
    writeln!(out, "{text}")
        .and_then(|()| out.flush())
        .map_err(|e| Failure::io("standard output", &e))
}

/// Everything that a finished run can tell.
#[derive(Debug)]
pub(crate) struct Report<'a> {
    pub(crate) scene: &'a str,
    pub(crate) output: &'a str,
    pub(crate) profile: Profile,
    pub(crate) canvas: Canvas,
    pub(crate) choices: Choices,
    pub(crate) max_eccentricity: f32,
    pub(crate) threads: usize,
    pub(crate) times: Times,
    pub(crate) warnings: &'a [Warning],
}

/// Where the time went.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Times {
    /// Reading the scene and its images.
    pub(crate) parse: Duration,
    /// Drawing, the encoder's time apart.
    pub(crate) render: Duration,
    /// Compressing and writing.
    pub(crate) encode: Duration,
}

impl Report<'_> {
    /// Prints the report on standard output, on a line of its own.
    pub(crate) fn print(&self) -> Result<(), Failure> {
        print(&self.json().to_string())
    }

    fn json(&self) -> Value {
        let (width, height) = self.canvas.picture();
        let profile = match self.profile {
            Profile::Svg => "svg",
            Profile::Course => "course",
        };
        json!({
            "scene": self.scene,
            "output": self.output,
            "profile": profile,
            "width": width,
            "height": height,
            "canvas": { "width": self.canvas.width, "height": self.canvas.height },
            "crop": self.canvas.crop.map(|c| {
                json!({ "x": c.x, "y": c.y, "width": c.width, "height": c.height })
            }),
            "aa": choice_name(self.choices.aa),
            "samples": self.choices.samples,
            "pattern": choice_name(self.choices.pattern),
            "shade": choice_name(self.choices.shade),
            "quality": self.choices.quality,
            "pixel": choice_name(self.choices.pixel),
            "level": choice_name(self.choices.level),
            "max_eccentricity": self.max_eccentricity,
            "space": choice_name(self.choices.space),
            "interpolate": choice_name(self.choices.interpolate),
            "threads": self.threads,
            "parse_ms": milliseconds(self.times.parse),
            "render_ms": milliseconds(self.times.render),
            "encode_ms": milliseconds(self.times.encode),
            "warnings": self.warnings.iter().map(warning_json).collect::<Vec<_>>(),
        })
    }
}

/// A warning for programs.
pub(crate) fn warning_json(warning: &Warning) -> Value {
    json!({
        "message": warning.message,
        "line": warning.position.map(|p| p.line),
        "column": warning.position.map(|p| p.column),
        "count": warning.count,
    })
}

/// Milliseconds to the microsecond: more digits would only be noise.
pub(crate) fn milliseconds(time: Duration) -> f64 {
    time.as_micros() as f64 / 1000.0
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::args::{Antialias, Crop, Interpolate, Level, Pattern, Pixel, Shade, Space};

    #[test]
    fn a_place_is_said_as_compilers_say_it() {
        let position = Some(Position { line: 3, column: 14 });
        assert_eq!(located("a.svg", position, "no"), "a.svg:3:14: no");
        assert_eq!(located("a.svg", None, "no"), "a.svg: no");
    }

    #[test]
    fn the_report_holds_what_a_program_wants_to_know() {
        let report = Report {
            scene: "a \"quoted\".svg",
            output: "a.png",
            profile: Profile::Course,
            canvas: Canvas {
                width: 30,
                height: 20,
                crop: Some(Crop { x: 1, y: 2, width: 3, height: 4 }),
            },
            choices: Choices {
                aa: Antialias::Samples,
                samples: 4,
                pattern: Pattern::Grid,
                shade: Shade::Pixel,
                quality: "default",
                pixel: Pixel::Ewa,
                level: Level::Auto,
                space: Space::Srgb,
                interpolate: Interpolate::Perspective,
            },
            max_eccentricity: 16.0,
            threads: 2,
            times: Times {
                parse: Duration::from_micros(1500),
                render: Duration::ZERO,
                encode: Duration::from_secs(1),
            },
            warnings: &[],
        };
        let text = report.json().to_string();
        assert!(!text.contains('\n'));
        let value: Value = serde_json::from_str(&text).unwrap();
        assert_eq!(value["scene"], "a \"quoted\".svg");
        assert_eq!(
            (value["width"].as_u64(), value["canvas"]["width"].as_u64()),
            (Some(3), Some(30))
        );
        assert_eq!(value["pixel"], "ewa");
        assert_eq!(value["quality"], "default");
        assert_eq!(value["parse_ms"], 1.5);
        assert_eq!(value["encode_ms"], 1000.0);
    }
}
