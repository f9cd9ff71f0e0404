//! The images that filters are judged on.

use crate::canvas::Canvas;
use crate::math::{cos, fract, hash, octaves, random, turns};
use crate::textures::inked;
use scumble::texture::{Texture, TextureError, TextureOptions};
use scumble_pixel::Image;
use std::f64::consts::{PI, TAU};

/// Texels along each side.
pub(crate) const SIZE: usize = 2048;

const SIDE: u32 = SIZE as u32;

/// An image by its name in the tables.
pub(crate) struct Source {
    pub(crate) name: &'static str,
    draw: fn() -> Canvas,
}

/// All of them, in the order of the tables' columns.
pub(crate) const SOURCES: [Source; 6] = [
    Source { name: "photo", draw: photo },
    Source { name: "checker", draw: checker },
    Source { name: "text", draw: text },
    Source { name: "zone plate", draw: zone_plate },
    Source { name: "star", draw: star },
    Source { name: "white noise", draw: white_noise },
];

impl Source {
    /// The image, to be written.
    pub(crate) fn canvas(&self) -> Canvas {
        (self.draw)()
    }

    /// The image.
    pub(crate) fn image(&self) -> Image<[u8; 4]> {
        self.canvas().into_image()
    }

    /// The image as a texture whose numbers are the encoded values.
    pub(crate) fn texture(&self) -> Result<Texture, TextureError> {
        Texture::new(self.image().view(), &TextureOptions::default())
    }
}

/// Noise of eight octaves, each three quarters as high as the one twice its size: contrast at every
/// scale and a little less at the finest, as photographs have it.
fn photo() -> Canvas {
    Canvas::paint(SIDE, SIDE, 1, |x, y| {
        [3, 4, 5].map(|seed| {
            let shared = octaves(x / 256.0, y / 256.0, 8, 8, 0.75, 90);
            let own = octaves(x / 256.0, y / 256.0, 8, 8, 0.75, 100 * seed);
            0.5 + 2.5 * (0.7 * shared + 0.3 * own - 0.5)
        })
    })
}

/// Squares of 24 texels.
fn checker() -> Canvas {
    Canvas::paint(SIDE, SIDE, 1, |x, y| {
        [if ((x / 24.0).floor() + (y / 24.0).floor()) % 2.0 == 0.0 { 0.0 } else { 1.0 }; 3]
    })
}

/// Lines of letters whose strokes are one to four texels wide.
fn text() -> Canvas {
    const LETTERS: &[u8] = b"ABCDEFGHILMNOPRSTUVXY  ";
    let mut lines = Vec::new();
    while lines.len() < SIZE {
        let (top, stroke) = (lines.len(), 1 + hash(lines.len() as i64, 0, 7) as usize % 4);
        lines.resize(top + 10 * stroke, (top, stroke));
    }
    Canvas::paint(SIDE, SIDE, 1, |x, y| {
        let (top, stroke) = lines[y as usize];
        let (column, row) = (x as usize / stroke, (y as usize - top) / stroke);
        let letter = hash((column / 6) as i64, top as i64, 8) as usize % LETTERS.len();
        let ink = inked(char::from(LETTERS[letter]), column % 6, row);
        [if ink { 20.0 / 255.0 } else { 1.0 }; 3]
    })
}

/// Three phases of a zone plate that reaches the limit of sampling in the middle of the edges.
fn zone_plate() -> Canvas {
    let half = SIZE as f64 / 2.0;
    Canvas::paint(SIDE, SIDE, 1, |x, y| {
        let (x, y) = (x - half, y - half);
        let phase = PI * (x * x + y * y) / (2.0 * half);
        [0.0, 1.0, 2.0].map(|k| 0.5 + 0.5 * cos(phase + k * TAU / 3.0))
    })
}

/// A Siemens star of 180 pairs of spokes.
fn star() -> Canvas {
    let half = SIZE as f64 / 2.0;
    Canvas::paint(SIDE, SIDE, 2, |x, y| {
        [if fract(turns(x - half, y - half) * 180.0) < 0.5 { 0.0 } else { 1.0 }; 3]
    })
}

/// Each channel of each texel by chance.
fn white_noise() -> Canvas {
    Canvas::paint(SIDE, SIDE, 1, |x, y| [21, 22, 23].map(|seed| random(x as i64, y as i64, seed)))
}
