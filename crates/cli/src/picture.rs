//! Picture files: what is in one, read and written with the depth, channels and profile that it has.
//!
//! [`read`] gives a [`Picture`], turned upright, its numbers as the file has them; [`Picture::texture`]
//! makes of it what the filters take; [`Encoder`] turns their rows into numbers for a file again,
//! and [`Writer`] writes those.
//!
//! # Colour
//!
//! A picture's numbers are related to light by a [`Tone`]: the curve of its ICC profile, or without one
//! sRGB's for whole numbers and none for floats. Only that curve is ever undone and done again. The
//! primaries stay those of the profile, which therefore goes into the output as it came: averages of
//! light need no particular primaries, and nothing is clipped to a smaller gamut.

mod colors;
mod curve;
mod encode;
mod format;
mod orientation;
mod profile;
mod read;
mod show;
mod texture;
mod write;

pub(crate) use encode::Encoder;
pub(crate) use format::{Depth, Format};
pub(crate) use profile::Tone;
pub(crate) use read::{Limits, read, read_bytes};
pub(crate) use show::on_checkerboard;
pub(crate) use write::{Form, Writer, out_of_turn};

/// A decoded picture, upright.
#[derive(Debug, Clone)]
pub(crate) struct Picture {
    pub(crate) width: u32,
    pub(crate) height: u32,
    pub(crate) channels: Channels,
    /// Rows from top to bottom, the channels of a pixel side by side.
    pub(crate) pixels: Pixels,
    /// Whether colour is multiplied by alpha, as OpenEXR has it.
    pub(crate) premultiplied: bool,
    /// How the numbers are related to light.
    pub(crate) tone: Tone,
    /// The ICC profile, if there is one that fits the channels.
    pub(crate) icc: Option<Vec<u8>>,
    /// What the file was.
    pub(crate) origin: Origin,
}

/// What a file was that a picture came from.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct Origin {
    pub(crate) format: Format,
    /// What the file stores, which [`Pixels`] hold without loss.
    pub(crate) depth: Depth,
    /// The EXIF orientation, 1 to 8, that has been applied.
    pub(crate) orientation: u8,
    /// What the reader left out or assumed, each a sentence.
    pub(crate) notes: Vec<String>,
}

/// What a pixel is made of.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Channels {
    Gray,
    GrayAlpha,
    Rgb,
    Rgba,
}

impl Channels {
    /// So many numbers a pixel.
    pub(crate) fn of_count(count: usize) -> Option<Self> {
        [Self::Gray, Self::GrayAlpha, Self::Rgb, Self::Rgba].get(count.checked_sub(1)?).copied()
    }

    /// Numbers a pixel.
    pub(crate) fn count(self) -> usize {
        match self {
            Self::Gray => 1,
            Self::GrayAlpha => 2,
            Self::Rgb => 3,
            Self::Rgba => 4,
        }
    }

    /// Whether the last number is alpha.
    pub(crate) fn has_alpha(self) -> bool {
        matches!(self, Self::GrayAlpha | Self::Rgba)
    }

    /// Whether all colours are greys.
    pub(crate) fn is_gray(self) -> bool {
        matches!(self, Self::Gray | Self::GrayAlpha)
    }

    /// The same with alpha.
    pub(crate) fn with_alpha(self) -> Self {
        if self.is_gray() { Self::GrayAlpha } else { Self::Rgba }
    }

    /// The same without alpha.
    pub(crate) fn without_alpha(self) -> Self {
        if self.is_gray() { Self::Gray } else { Self::Rgb }
    }

    /// What reports call it.
    pub(crate) fn name(self) -> &'static str {
        match self {
            Self::Gray => "gray",
            Self::GrayAlpha => "gray+alpha",
            Self::Rgb => "rgb",
            Self::Rgba => "rgba",
        }
    }
}

/// The numbers of a picture: whole numbers from 0 to the largest of their type, or floats. Half floats
/// are held as floats.
#[derive(Debug, Clone, PartialEq)]
pub(crate) enum Pixels {
    U8(Vec<u8>),
    U16(Vec<u16>),
    F32(Vec<f32>),
}

impl Pixels {
    /// None yet, of the type that holds `depth`.
    pub(crate) fn empty(depth: Depth) -> Self {
        match depth {
            Depth::Eight => Self::U8(Vec::new()),
            Depth::Sixteen => Self::U16(Vec::new()),
            Depth::Half | Depth::Float => Self::F32(Vec::new()),
        }
    }

    /// How many numbers.
    pub(crate) fn len(&self) -> usize {
        match self {
            Self::U8(v) => v.len(),
            Self::U16(v) => v.len(),
            Self::F32(v) => v.len(),
        }
    }

    /// Bytes that they take.
    pub(crate) fn bytes(&self) -> u64 {
        let each = match self {
            Self::U8(_) => 1,
            Self::U16(_) => 2,
            Self::F32(_) => 4,
        };
        self.len() as u64 * each
    }

    /// Forgets all of them and keeps the memory.
    pub(crate) fn clear(&mut self) {
        match self {
            Self::U8(v) => v.clear(),
            Self::U16(v) => v.clear(),
            Self::F32(v) => v.clear(),
        }
    }

    /// Number `i` on the scale where white is 1; 0 beyond the end.
    pub(crate) fn at(&self, i: usize) -> f32 {
        match self {
            Self::U8(v) => v.get(i).map_or(0.0, |&v| f32::from(v) / 255.0),
            Self::U16(v) => v.get(i).map_or(0.0, |&v| f32::from(v) / 65535.0),
            Self::F32(v) => v.get(i).copied().unwrap_or_default(),
        }
    }
}

impl Picture {
    /// What writes this picture's like: the same size, channels and profile, in a format and a depth
    /// of it.
    pub(crate) fn form(&self, format: Format, depth: Depth) -> Form {
        let icc = self.icc.clone().filter(|_| format.carries_icc());
        let (width, height, channels) = (self.width, self.height, self.channels);
        Form { width, height, channels, depth, format, icc }
    }
}

#[cfg(test)]
mod tests;
