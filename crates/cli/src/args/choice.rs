//! Options that are one word out of a few.

use clap::ValueEnum;
use scumble::pixel::WorkingSpace;

/// How to read the scene.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub(crate) enum Profile {
    /// Course if the scene says so (sc:profile="course" on the root), else SVG
    Auto,
    /// What a person means by SVG, with the extension elements
    Svg,
    /// As the course's rasterizer draws its scenes: its view, frame and conventions
    Course,
}

/// Where the samples lie in a pixel.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub(crate) enum Pattern {
    /// The positions of graphics hardware for 2, 4, 8 and 16; a grid for 9
    Standard,
    /// A regular grid, for the square numbers
    Grid,
}

/// How edges are made smooth.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub(crate) enum Antialias {
    /// By samples that belong to one primitive each: no seams
    Samples,
    /// By the exact area of each primitive for itself: 256 grey levels, and seams where two meet
    Area,
}

/// How often textures and gradients are evaluated.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub(crate) enum Shade {
    /// Once a pixel, whatever the number of samples
    Pixel,
    /// At every sample: supersampling
    Sample,
}

/// How a texture is averaged within a level.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub(crate) enum Pixel {
    /// Over the ellipse that the pixel covers
    Ewa,
    /// By spots in a row along that ellipse
    Probes,
    /// Between the four nearest texels of each of two levels: bilinear with --level linear
    Trilinear,
    /// Between the four nearest texels
    Bilinear,
    /// The nearest texel as it is
    Nearest,
}

/// Which level of a texture's pyramid is read.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub(crate) enum Level {
    /// What suits the filter
    Auto,
    /// The texture itself, always
    Zero,
    /// The level nearest to the footprint's size
    Nearest,
    /// Between the two nearest levels
    Linear,
}

/// The space in which colours are averaged and blended.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub(crate) enum Space {
    /// Encoded values, as SVG and browsers do
    Srgb,
    /// Light
    Linear,
}

/// How attributes are interpolated across a triangle in perspective.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub(crate) enum Interpolate {
    /// As they lie in the scene
    Perspective,
    /// As they lie on the screen: wrong, and instructive
    Affine,
}

impl Space {
    /// The library's name for it.
    pub(crate) fn working(self) -> WorkingSpace {
        match self {
            Self::Srgb => WorkingSpace::Srgb,
            Self::Linear => WorkingSpace::Linear,
        }
    }
}

/// The word that chooses `value` on the command line.
pub(crate) fn name<T: ValueEnum>(value: T) -> String {
    value.to_possible_value().map_or_else(String::new, |v| v.get_name().to_owned())
}
