use super::{ReadLimits, value};
use clap::{Args, ValueHint};
use std::path::PathBuf;

/// What to compare.
#[derive(Debug, Args)]
#[command(allow_negative_numbers = true)]
#[command(long_about = ABOUT, after_long_help = EXAMPLES, after_help = super::MORE)]
pub(crate) struct Diff {
    /// A picture; `-` is standard input
    #[arg(value_hint = ValueHint::FilePath)]
    pub(crate) a: PathBuf,

    /// Another, of the same size
    #[arg(value_hint = ValueHint::FilePath)]
    pub(crate) b: PathBuf,

    /// Write a PNG with A, the difference enlarged, and B side by side; `-` is standard output
    ///
    /// It is written whether they differ or not, unless their sizes do. Pictures with alpha lie on a
    /// checkerboard.
    #[arg(short, long = "output", value_name = "OUT", value_hint = ValueHint::FilePath)]
    pub(crate) output: Option<PathBuf>,

    /// Differences up to N of 255 are none; 0.5 is half a step of eight bits
    #[arg(long, value_name = "N", default_value_t = 0.0, value_parser = value::tolerance)]
    pub(crate) tolerance: f64,

    /// Replace what stands in OUT's place, whatever it is
    #[arg(long)]
    pub(crate) force: bool,

    /// Print one JSON object
    #[arg(long)]
    pub(crate) json: bool,

    /// Say nothing but errors: no warnings, no progress bar; the exit status tells
    #[arg(short, long, conflicts_with = "json")]
    pub(crate) quiet: bool,

    #[command(flatten)]
    pub(crate) limits: ReadLimits,
}

const ABOUT: &str = "\
Compare two pictures

Pixels are compared as they are seen: colours multiplied by alpha, and alpha, on the scale where \
white is 255. Pictures whose numbers mean the same are compared by their numbers; otherwise (a PNG \
with an OpenEXR file, other curves of their profiles) by what they are in sRGB. Primaries are not \
converted.";

const EXAMPLES: &str = "\
Examples:
  scumble diff expected.png actual.png
  scumble diff expected.png actual.png -o triptych.png --tolerance 1
  scumble diff a.exr b.exr --json | jq .psnr_db

Exit status:
  0 no pixel differs by more than the tolerance
  1 failure · 2 wrong arguments · 3 a limit was hit
  4 they differ, or their sizes do";
