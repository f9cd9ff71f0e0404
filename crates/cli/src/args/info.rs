use super::value;
use clap::{Args, ValueHint};
use std::path::PathBuf;

/// What to look into.
#[derive(Debug, Args)]
#[command(long_about = ABOUT, after_long_help = EXAMPLES, after_help = super::MORE)]
pub(crate) struct Info {
    /// A scene or a picture; `-` is standard input
    #[arg(value_hint = ValueHint::FilePath)]
    pub(crate) file: PathBuf,

    /// Also allow a scene's images to come from DIR and below; may be repeated
    #[arg(long, value_name = "DIR", value_hint = ValueHint::DirPath)]
    pub(crate) resources: Vec<PathBuf>,

    /// Print one JSON object
    #[arg(long)]
    pub(crate) json: bool,

    #[command(flatten)]
    pub(crate) limits: ReadLimits,
}

/// What reading may use.
#[derive(Debug, Args)]
#[command(next_help_heading = "Limits")]
pub(crate) struct ReadLimits {
    /// Memory, in bytes; K, M, G are powers of 1024
    #[arg(long, value_name = "BYTES", default_value = "4G", value_parser = value::bytes)]
    pub(crate) max_memory: u64,

    /// Pixels of a picture; K, M, G are powers of 1000
    #[arg(long, value_name = "PIXELS", default_value = "1G", value_parser = value::count)]
    pub(crate) max_pixels: u64,
}

const ABOUT: &str = "\
Say what a scene or a picture holds

What the file is follows from its content, not from its name. All of it is read, so a damaged file is \
an error.";

const EXAMPLES: &str = "\
Examples:
  scumble info photo.jpg             format, size, depth, channels, profile, orientation
  scumble info drawing.svg           size, profile, what is drawn, images, warnings
  scumble info --json render.exr | jq .width

Exit status: 0 done · 1 failure · 2 wrong arguments · 3 a limit was hit";
