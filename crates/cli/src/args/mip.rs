use super::{ReadLimits, Space, value};
use clap::{Args, ValueEnum, ValueHint};
use std::path::PathBuf;

/// What to make levels of, and how.
#[derive(Debug, Args)]
#[command(allow_negative_numbers = true)]
#[command(long_about = ABOUT, after_long_help = EXAMPLES, after_help = super::MORE)]
pub(crate) struct Mip {
    /// The picture; `-` is standard input
    #[arg(value_name = "IN", value_hint = ValueHint::FilePath)]
    pub(crate) input: PathBuf,

    /// A file that ends in .ktx2 or .dds, or a folder for one PNG a level, level_00.png and so on
    ///
    /// Levels of floats are OpenEXR files, level_00.exr and so on. The folder is made if it is not
    /// there. A file that is named is replaced if it is one of its kind.
    #[arg(value_hint = ValueHint::AnyPath)]
    pub(crate) out: PathBuf,

    /// The filter from level to level
    #[arg(long, value_enum, default_value_t = LevelFilter::Kaiser)]
    pub(crate) filter: LevelFilter,

    /// The space in which colours are averaged [default: linear; srgb: the numbers as they are]
    #[arg(long, value_enum)]
    pub(crate) space: Option<Space>,

    /// What lies beyond the edges
    #[arg(long, value_enum, default_value_t = Edge::Clamp)]
    pub(crate) wrap: Edge,

    /// Levels at most, the picture itself included [default: all, down to 1 by 1]
    #[arg(long, value_name = "N", value_parser = value::levels)]
    pub(crate) levels: Option<usize>,

    /// Keep the part of each level whose alpha is at least T, in 0…1, as large as in the picture
    ///
    /// For foliage and fences that are drawn where alpha passes a test: averages of alpha would fall
    /// below T and thin them out. The alpha of each level is scaled by one factor.
    #[arg(long, value_name = "T", value_parser = value::threshold, conflicts_with = "normal_map")]
    pub(crate) alpha_coverage: Option<f32>,

    /// The picture is a normal map: red, green, blue are x, y, z from -1 to 1
    ///
    /// Texels are averaged as vectors, whatever --space would be, and given the length 1. Alpha is
    /// averaged by itself.
    #[arg(long, conflicts_with = "space")]
    pub(crate) normal_map: bool,

    /// What a number is stored as [default: as in the picture]
    #[arg(long, value_enum)]
    pub(crate) depth: Option<StoredAs>,

    /// Also write a PNG with all levels side by side
    #[arg(long, value_name = "SHEET", value_hint = ValueHint::FilePath)]
    pub(crate) sheet: Option<PathBuf>,

    /// Replace what stands in the way, whatever it is
    #[arg(long)]
    pub(crate) force: bool,

    /// Print one JSON object: sizes, coverage, times in milliseconds
    #[arg(long)]
    pub(crate) json: bool,

    /// Say nothing but errors: no warnings, no progress bar
    #[arg(short, long)]
    pub(crate) quiet: bool,

    #[command(flatten)]
    pub(crate) limits: ReadLimits,
}

/// The filter from level to level.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub(crate) enum LevelFilter {
    /// Sharp, with little aliasing: a windowed sinc of 8 taps
    Kaiser,
    /// The mean of the texels that a texel covers
    Box,
}

/// What lies beyond the edges.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub(crate) enum Edge {
    /// The texel at the edge, for ever
    Clamp,
    /// The picture again: tiles
    Repeat,
    /// The picture mirrored
    Mirror,
}

/// What a number is stored as.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub(crate) enum StoredAs {
    /// Eight bits
    #[value(name = "8")]
    Eight,
    /// Sixteen bits
    #[value(name = "16")]
    Sixteen,
    /// Floats of 16 bits, linear light
    Half,
    /// Floats of 32 bits, linear light
    Float,
}

const ABOUT: &str = "\
Make the mip levels of a picture

Level l is ⌊width/2ˡ⌋ by ⌊height/2ˡ⌋ texels and at least 1 by 1. Colours are averaged multiplied by \
alpha. Level 0 is the picture, number by number, unless another --depth or a container, which has no \
profile, asks for other numbers.";

const EXAMPLES: &str = "\
Examples:
  scumble mip bricks.png bricks.ktx2 --wrap repeat
  scumble mip leaves.png leaves.dds --alpha-coverage 0.5
  scumble mip normals.png normals.ktx2 --normal-map --wrap repeat
  scumble mip sky.exr levels --levels 5 --sheet sheet.png

A container has four channels: R8G8B8A8 (sRGB; not for normal maps), R16G16B16A16 or floats of 16 or
32 bits, uncompressed. Eight and sixteen bits are the numbers of the PNG levels; floats are light.

Exit status: 0 done · 1 failure · 2 wrong arguments · 3 a limit was hit · 130 interrupted";
