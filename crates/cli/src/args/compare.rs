//! The arguments of `compare`, and the settings that it can vary.

use super::{Color, Files, Limits, Quality, Render, Report, Size};
use clap::{Args, Parser, ValueHint};
use scumble::texture::{Kernel, Magnify, Sampler};
use std::path::PathBuf;

/// A scene, and what to vary.
#[derive(Debug, Args)]
#[command(allow_negative_numbers = true, after_long_help = EXAMPLES)]
pub(crate) struct Compare {
    /// The scene, an SVG file; `-` is standard input
    #[arg(value_hint = ValueHint::FilePath)]
    pub(crate) scene: PathBuf,

    /// The sheet, a PNG file; `-` is standard output
    #[arg(short, long, value_name = "SHEET", value_hint = ValueHint::FilePath)]
    pub(crate) output: PathBuf,

    /// What to vary: options of `render` about quality or --space, several of them by commas, each with
    /// its values or without for the usual ones: pixel, or samples=1/16,level
    ///
    /// Of several, every combination is drawn, the last one from left to right.
    #[arg(long, value_name = "SETTINGS", default_value = "pixel", value_parser = axes)]
    pub(crate) vary: Axes,

    /// Pictures in a row [default: as many as the last setting has values; at most 4 of one alone]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..))]
    pub(crate) columns: Option<u16>,

    /// Show each pixel as a square of so many
    #[arg(long, value_name = "N", default_value_t = 1,
          value_parser = clap::value_parser!(u32).range(1..=64))]
    pub(crate) scale: u32,

    /// Leave the times out: the same sheet on every run
    #[arg(long)]
    pub(crate) no_time: bool,

    #[command(flatten)]
    pub(crate) files: Files,
    #[command(flatten)]
    pub(crate) size: Size,
    #[command(flatten)]
    pub(crate) quality: Quality,
    #[command(flatten)]
    pub(crate) color: Color,
    #[command(flatten)]
    pub(crate) limits: Limits,

    /// Say nothing but errors: no warnings
    #[arg(short, long)]
    pub(crate) quiet: bool,
}

const EXAMPLES: &str = "\
Under each picture: what it was drawn with; how near it is to the scene drawn with 64 samples and the \
quality `reference`, as PSNR of the encoded values, on white where something shows through; and the time \
for drawing it, the best of three, its textures built before.

Examples:
  scumble compare ground.svg -o sheet.png
  scumble compare ground.svg -o sheet.png --vary samples=1/4/16,pixel=nearest/ewa
  scumble compare thin.svg -o sheet.png --vary samples --crop 40,40,48,36 --scale 4
  scumble compare ground.svg -o sheet.png --vary max-eccentricity=4/16/64 --quality high";

/// Most pictures on a sheet.
const MOST: usize = 256;

/// A setting and its values, as words.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct Axis {
    pub(crate) name: &'static str,
    pub(crate) values: Vec<String>,
}

/// What is varied.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct Axes(pub(crate) Vec<Axis>);

impl Axes {
    /// Every combination of values, the last setting's changing fastest.
    pub(crate) fn combinations(&self) -> Vec<Vec<(&'static str, &str)>> {
        self.0.iter().fold(vec![Vec::new()], |before, axis| {
            let with = |value, list: &Vec<_>| {
                let mut list = list.clone();
                list.push((axis.name, value));
                list
            };
            before
                .iter()
                .flat_map(|list| axis.values.iter().map(move |v| with(v.as_str(), list)))
                .collect()
        })
    }
}

/// The settings that can be varied, and their usual values.
fn usual(name: &str) -> Option<(&'static str, Vec<&'static str>)> {
    let few = |values: &[&'static str]| values.to_vec();
    Some(match name {
        "aa" => ("aa", few(&["samples", "area"])),
        "samples" => ("samples", few(&["1", "4", "16", "64"])),
        "pattern" => ("pattern", few(&["standard", "grid"])),
        "shade" => ("shade", few(&["pixel", "sample"])),
        "quality" => ("quality", Sampler::PRESETS.map(|(name, _)| name).to_vec()),
        "pixel" => ("pixel", few(&["nearest", "bilinear", "trilinear", "probes", "ewa"])),
        "kernel" => ("kernel", Kernel::ALL.map(Kernel::name).to_vec()),
        "magnify" => ("magnify", Magnify::ALL.map(Magnify::name).to_vec()),
        "level" => ("level", few(&["zero", "nearest", "linear", "auto"])),
        "max-eccentricity" => ("max-eccentricity", few(&["2", "8", "32", "128"])),
        "interpolate" => ("interpolate", few(&["affine", "perspective"])),
        "space" => ("space", few(&["srgb", "linear"])),
        _ => return None,
    })
}

/// `name[=value/value…],…`
fn axes(text: &str) -> Result<Axes, String> {
    let mut axes: Vec<Axis> = Vec::new();
    for part in text.split(',').map(str::trim) {
        let (word, values) = part.split_once('=').unwrap_or((part, ""));
        let (name, usual) =
            usual(word).ok_or_else(|| format!("`{word}` is no setting that can be varied"))?;
        let mut axis = Axis { name, values: usual.into_iter().map(str::to_owned).collect() };
        if part.contains('=') {
            axis.values = values.split('/').map(|v| v.trim().to_owned()).collect();
        }
        if axes.iter().any(|other| other.name == name) {
            return Err(format!("`{name}` is named twice"));
        }
        axes.push(axis);
    }
    let count = axes.iter().fold(1, |n: usize, axis| n.saturating_mul(axis.values.len()));
    if count > MOST {
        return Err(format!("{count} pictures are too many for a sheet; at most {MOST}"));
    }
    let axes = Axes(axes);
    for combination in axes.combinations() {
        Variation::parse(&combination)?;
    }
    Ok(axes)
}

/// Options of `render` by themselves.
#[derive(Debug, Parser)]
struct Variation {
    #[command(flatten)]
    quality: Quality,
    #[command(flatten)]
    color: Color,
}

impl Variation {
    fn parse(settings: &[(&'static str, &str)]) -> Result<Self, String> {
        let words = settings.iter().flat_map(|(name, v)| [format!("--{name}"), (*v).to_owned()]);
        Self::try_parse_from(std::iter::once("compare".to_owned()).chain(words)).map_err(|e| {
            let text = e.to_string();
            let line = text.lines().next().unwrap_or_default();
            line.trim_start_matches("error: ").to_owned()
        })
    }
}

impl Compare {
    /// The options of `render` that draw the scene with these settings in place of the given ones.
    pub(crate) fn render_with(&self, settings: &[(&'static str, &str)]) -> Result<Render, String> {
        let Variation { quality: q, color: c } = Variation::parse(settings)?;
        let (quality, color) = (&self.quality, &self.color);
        Ok(Render {
            scene: self.scene.clone(),
            out: None,
            output: Some(self.output.clone()),
            files: self.files.clone(),
            size: self.size.clone(),
            quality: Quality {
                aa: q.aa.or(quality.aa),
                samples: q.samples.or(quality.samples),
                pattern: q.pattern.or(quality.pattern),
                shade: q.shade.or(quality.shade),
                quality: q.quality.or(quality.quality),
                pixel: q.pixel.or(quality.pixel),
                kernel: q.kernel.or(quality.kernel),
                magnify: q.magnify.or(quality.magnify),
                level: q.level.or(quality.level),
                max_eccentricity: q.max_eccentricity.or(quality.max_eccentricity),
                interpolate: q.interpolate.or(quality.interpolate),
            },
            color: Color {
                space: c.space.or(color.space),
                background: c.background.or(color.background),
            },
            limits: self.limits.clone(),
            report: Report { quiet: self.quiet, json: false },
        })
    }

    /// The options that draw the truth: nothing of what was chosen for quality stays but how attributes
    /// are interpolated.
    pub(crate) fn reference(&self) -> Result<Render, String> {
        let best = [
            ("samples", "64"),
            ("pattern", "grid"),
            ("quality", "reference"),
            ("pixel", "ewa"),
            ("level", "auto"),
        ];
        let mut render = self.render_with(&[])?;
        let Variation { quality, .. } = Variation::parse(&best)?;
        render.quality = Quality { interpolate: self.quality.interpolate, ..quality };
        Ok(render)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn settings_come_with_values_or_without() {
        let axes =
            axes("samples = 1/16, level").unwrap_or_else(|_| axes("samples=1/16,level").unwrap());
        assert_eq!(axes.0[0], Axis { name: "samples", values: vec!["1".into(), "16".into()] });
        let combinations = axes.combinations();
        assert_eq!(combinations.len(), 8);
        assert_eq!(combinations[1], [("samples", "1"), ("level", "nearest")]);
        assert_eq!(combinations[4], [("samples", "16"), ("level", "zero")]);
    }

    #[test]
    fn every_setting_has_usual_values_that_can_be_drawn() {
        let names = [
            "aa",
            "samples",
            "pattern",
            "shade",
            "quality",
            "pixel",
            "kernel",
            "magnify",
            "level",
            "max-eccentricity",
            "interpolate",
            "space",
        ];
        for name in names {
            assert!(axes(name).unwrap().0[0].values.len() >= 2, "{name}");
        }
    }

    #[test]
    fn what_cannot_be_varied_is_refused() {
        for text in ["", "width", "pixel,pixel", "pixel=cubic", "samples=3", "samples=", "pixel,,"]
        {
            assert!(axes(text).is_err(), "{text}");
        }
        let many = "samples,pattern,shade,quality,pixel,level";
        assert!(axes(many).is_err_and(|e| e.contains("too many")));
        assert!(axes("pixel=cubic").is_err_and(|e| e.contains("cubic")));
    }
}
