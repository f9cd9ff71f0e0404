//! The command line: what can be said, and the help that explains it.

mod choice;
mod compare;
mod diff;
mod info;
mod mip;
mod signal;
mod value;
mod warp;

pub(crate) use choice::{
    Antialias, Interpolate, Level, Pattern, Pixel, Profile, Shade, Space, name as choice_name,
};
pub(crate) use compare::Compare;
pub(crate) use diff::Diff;
pub(crate) use info::{Info, ReadLimits};
pub(crate) use mip::{Edge, LevelFilter, Mip, StoredAs};
pub(crate) use signal::{Border, Convolution, Filter, InOut, Of, Spectrum, Window};
pub(crate) use value::{Background, Crop};
pub(crate) use warp::{Depth, PixelOrigin, Quad, Size as WarpSize, Warp, Way};

use clap::{Args, Parser, Subcommand, ValueHint};
use clap_complete::Shell;
use scumble::texture::{Kernel, Magnify};
use std::path::PathBuf;

/// The name that means standard input or standard output.
pub(crate) const STANDARD_STREAM: &str = "-";

/// Everything that the process was told.
#[derive(Debug, Parser)]
#[command(
    name = "scumble",
    version,
    about = "Pictures whose every pixel is an honest average: scenes rendered, mip levels made",
    arg_required_else_help = true,
    max_term_width = 100,
    after_help = AFTER_HELP
)]
pub(crate) struct Cli {
    #[command(subcommand)]
    pub(crate) command: Command,
}

const AFTER_HELP: &str = "\
Exit status:
  0 done · 1 failure · 2 wrong arguments · 3 a limit was hit · 4 pictures differ · 130 interrupted

`scumble render --help` explains every option, and so for the other commands.";

/// What to do.
#[derive(Debug, Subcommand)]
pub(crate) enum Command {
    /// Draw a scene into a PNG
    Render(Box<Render>),
    /// Warp a picture: perspective, rectification, any map
    Warp(Box<Warp>),
    /// Make the mip levels of a picture
    Mip(Box<Mip>),
    /// Compare two pictures
    Diff(Diff),
    /// Say what a scene or a picture holds
    Info(Info),
    /// Draw a scene by several settings, side by side on a sheet with labels
    Compare(Box<Compare>),
    /// Show the frequencies of a picture
    Spectrum(Box<Spectrum>),
    /// Keep some of the frequencies of a picture, or convolve it
    Filter(Box<Filter>),
    /// Print a completion script for a shell
    #[command(after_help = COMPLETIONS_HELP)]
    Completions {
        /// The shell to write for
        shell: Shell,
    },
}

const COMPLETIONS_HELP: &str = "\
Examples:
  scumble completions bash > ~/.local/share/bash-completion/completions/scumble
  scumble completions zsh  > ~/.zfunc/_scumble
  scumble completions fish > ~/.config/fish/completions/scumble.fish";

/// What to render, and how.
#[derive(Debug, Args)]
#[command(allow_negative_numbers = true)]
#[command(long_about = RENDER_ABOUT, after_long_help = RENDER_EXAMPLES, after_help = MORE)]
pub(crate) struct Render {
    /// The scene, an SVG file; `-` is standard input
    #[arg(value_hint = ValueHint::FilePath)]
    pub(crate) scene: PathBuf,

    /// The picture, a PNG file; `-` is standard output
    ///
    /// Left out, it is the scene's name with the ending .png in the current directory, and an
    /// existing file of that name stays unless --force is given. A picture that is named is
    /// replaced, as compilers do; but only if it is a picture: see --force. For a scene from
    /// standard input it is standard output.
    #[arg(value_hint = ValueHint::FilePath, conflicts_with = "output")]
    pub(crate) out: Option<PathBuf>,

    /// The picture, the same as OUT
    #[arg(short, long = "output", value_name = "OUT", value_hint = ValueHint::FilePath)]
    pub(crate) output: Option<PathBuf>,

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
    #[command(flatten)]
    pub(crate) report: Report,
}

const RENDER_ABOUT: &str = "\
Draw a scene into a PNG

The picture is as large as the scene says (a course scene: 800 by 600 pixels) unless -w, -H or -z \
say otherwise. The same scene and options give the same bytes on every machine and any number \
of threads.";

/// What the short help ends with.
const MORE: &str = "`--help` says more, with examples.";

const RENDER_EXAMPLES: &str = "\
Examples:
  scumble render drawing.svg                       writes drawing.png here
  scumble render drawing.svg -o big.png -w 3000    3000 pixels wide, the aspect kept
  scumble render drawing.svg -o 2x.png -z 2        twice the size
  scumble render map.svg tile.png --crop 512,0,256,256
                                                   one part, the same bytes as in the whole
  scumble render drawing.svg - --background white | display
  scumble render course/test1.svg -o test1.png --profile course --resources course

Exit status:
  0 done · 1 failure · 2 wrong arguments · 3 a limit was hit · 130 interrupted
  A picture appears whole or not at all: it is written beside its place and renamed.";

/// Where things come from and whether they may be replaced.
#[derive(Debug, Clone, Args)]
#[command(next_help_heading = "Files")]
pub(crate) struct Files {
    /// How to read the scene
    #[arg(long, value_enum, default_value_t = Profile::Auto)]
    pub(crate) profile: Profile,

    /// Also allow the scene's images to come from DIR and below; may be repeated
    ///
    /// A scene may use files of its own folder (for standard input: of the current directory) and
    /// below. Any other path is refused, links and `..` seen through.
    #[arg(long, value_name = "DIR", value_hint = ValueHint::DirPath)]
    pub(crate) resources: Vec<PathBuf>,

    /// Replace what stands in the picture's place, whatever it is
    ///
    /// Needed when OUT was not named and the file exists; when the file is no picture; when it is
    /// the scene or one of its images; and for a device or a pipe, which is written to as it is.
    #[arg(long)]
    pub(crate) force: bool,
}

/// How large the canvas is, and which part of it to draw.
#[derive(Debug, Clone, Args)]
#[command(next_help_heading = "Size")]
pub(crate) struct Size {
    /// Width of the canvas in pixels; without -H the aspect is kept
    #[arg(short, long, value_name = "PIXELS", value_parser = value::length)]
    pub(crate) width: Option<u32>,

    /// Height of the canvas in pixels; without -w the aspect is kept
    ///
    /// With both, the canvas has exactly that size and the scene is fitted into it, centred.
    #[arg(short = 'H', long, value_name = "PIXELS", value_parser = value::length)]
    pub(crate) height: Option<u32>,

    /// Multiply the size, whether the scene's own or that of -w and -H [default: 1]
    #[arg(short, long, value_name = "FACTOR", value_parser = value::zoom)]
    pub(crate) zoom: Option<f64>,

    /// Draw only this part of the canvas, in pixels from its top left corner
    #[arg(long, value_name = "X,Y,W,H", value_parser = value::crop)]
    pub(crate) crop: Option<Crop>,
}

/// What a pixel is made of.
#[derive(Debug, Clone, Args)]
#[command(next_help_heading = "Quality")]
pub(crate) struct Quality {
    /// How edges are made smooth: all primitives together by samples, without seams, or each for
    /// itself by its exact area [default: samples]
    #[arg(long, value_enum)]
    pub(crate) aa: Option<Antialias>,

    /// Samples a pixel along edges: 1, 2, 4, 8, 9, 16, 25, 36, 49 or 64 [default: 16; course: 1]
    #[arg(long, value_name = "N", value_parser = value::samples)]
    pub(crate) samples: Option<u32>,

    /// Where the samples lie in a pixel [default: standard; course: grid]
    #[arg(long, value_enum)]
    pub(crate) pattern: Option<Pattern>,

    /// How often textures and gradients are evaluated [default: pixel]
    #[arg(long, value_enum)]
    pub(crate) shade: Option<Shade>,

    /// How well textures are filtered: `fast` for previews, `high` for print, `reference` for tests
    /// and `classic`, the enhanced EWA of 2009, for comparison [default: default]
    #[arg(long, value_name = "PRESET", value_parser = value::preset())]
    pub(crate) quality: Option<&'static str>,

    /// How a texture is averaged within a level [default: ewa; course: nearest]
    #[arg(long, value_enum)]
    pub(crate) pixel: Option<Pixel>,

    /// What EWA weighs texels by [default: the quality's; gaussian, and triangle for classic]
    ///
    /// All but the Gaussian are slower. `box` is the mean over the pixel's square, to compare with area
    /// averaging.
    #[arg(long, value_parser = value::kernel())]
    pub(crate) kernel: Option<Kernel>,

    /// What EWA and probes make of a texture that is magnified: `taps` is what a pixel sees of bilinear
    /// interpolation (of the Gaussian kernel only), `none` is softer, the others are sharper [default: the
    /// quality's: taps]
    #[arg(long, value_name = "WAY", value_parser = value::magnify())]
    pub(crate) magnify: Option<Magnify>,

    /// Which level of a texture's pyramid is read [default: auto; course: zero; trilinear: linear]
    #[arg(long, value_enum)]
    pub(crate) level: Option<Level>,

    /// Ratio of a footprint's axes beyond which EWA blurs its shorter one: 1 to 1024, sharper and
    /// slower as it grows [default: the quality's; 32]
    #[arg(long, value_name = "RATIO", value_parser = value::ratio)]
    pub(crate) max_eccentricity: Option<f32>,

    /// How attributes are interpolated across a triangle in perspective [default: perspective]
    #[arg(long, value_enum)]
    pub(crate) interpolate: Option<Interpolate>,
}

/// Colours.
#[derive(Debug, Clone, Args)]
#[command(next_help_heading = "Colour")]
pub(crate) struct Color {
    /// The space in which colours are averaged and blended [default: srgb]
    #[arg(long, value_enum)]
    pub(crate) space: Option<Space>,

    /// What lies under the scene: a CSS colour (`white`, `#08f`, `rgb(0 0 0 / 50%)`) or `none`
    /// for transparent [default: the scene's own]
    #[arg(long, value_name = "COLOR", value_parser = value::background)]
    pub(crate) background: Option<Background>,
}

/// What a run may use.
#[derive(Debug, Clone, Args)]
#[command(next_help_heading = "Limits")]
pub(crate) struct Limits {
    /// Threads to draw with; 0 is one for every core
    #[arg(short = 'j', long, value_name = "N", default_value_t = 0, value_parser = value::threads)]
    pub(crate) threads: usize,

    /// Memory for what is read and what is drawn, in bytes; K, M, G are powers of 1024
    #[arg(long, value_name = "BYTES", default_value = "4G", value_parser = value::bytes)]
    pub(crate) max_memory: u64,

    /// Pixels of the picture and of each image that is read; K, M, G are powers of 1000
    #[arg(long, value_name = "PIXELS", default_value = "1G", value_parser = value::count)]
    pub(crate) max_pixels: u64,
}

/// What to say.
#[derive(Debug, Clone, Args)]
#[command(next_help_heading = "Report")]
pub(crate) struct Report {
    /// Say nothing but errors: no warnings, no progress bar
    #[arg(short, long)]
    pub(crate) quiet: bool,

    /// Print one JSON object on standard output: size, settings, times in milliseconds, warnings; no
    /// progress bar
    #[arg(long)]
    pub(crate) json: bool,
}

#[cfg(test)]
mod tests;
