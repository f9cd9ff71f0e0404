//! Scenes in the two plain formats that the rasterizers of a comparison read, so that all of them
//! draw the same thing.
//!
//! # Triangles: `NAME.json` and `NAME.f32`
//!
//! The JSON object has `width`, `height`, `clear` (four numbers in 0…255), `vertices` (the name of
//! the other file, beside it), `count` (of vertices), `texture` (a PNG beside it, or null) and
//! `wrap` (`"repeat"`, the default, or `"clamp"`). The other file is little-endian `f32`, ten a
//! vertex: clip-space x y z w, red green blue alpha in 0…1, u v; three vertices a triangle, painted
//! in order. z is not looked at: no depth, no near plane. Textured triangles ignore their colours.
//!
//! # Outlines: `NAME.dl`
//!
//! Text, in pixels, one step a line: `size W H`; `bg R G B A`; then paths, each of them begun by
//! `f R G B A nz|eo` or `s R G B A WIDTH CAP JOIN MITER` (caps 0 butt, 1 round, 2 square; joins
//! 0 miter, 1 round, 2 bevel), continued by `M x y`, `L x y`, `C x1 y1 x2 y2 x y` and `Z`, and ended
//! by `.`. Colours are straight, in 0…255.

mod display_list;
mod mesh;

pub use display_list::parse as parse_display_list;
pub use mesh::read as read_mesh;

use scumble_scene::Scene;
use std::path::{Path, PathBuf};

/// The largest side of a picture: a frame of a comparison has a screen's size.
const MAX_SIDE: u32 = 16_384;

/// A scene and the canvas that it is made for.
#[derive(Debug, Clone, PartialEq)]
pub struct Frame {
    /// Columns.
    pub width: u32,
    /// Rows.
    pub height: u32,
    /// What to draw; a unit of it is a pixel.
    pub scene: Scene,
}

/// Why a scene could not be read.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum ReadError {
    /// The file could not be read.
    #[error("{}: {source}", path.display())]
    Io {
        /// Which.
        path: PathBuf,
        /// Why.
        source: std::io::Error,
    },
    /// The texture is not a picture.
    #[error("{}: {source}", path.display())]
    Picture {
        /// Which.
        path: PathBuf,
        /// Why.
        source: image::ImageError,
    },
    /// The file does not say what its format asks for.
    #[error("{}: {message}", path.display())]
    Malformed {
        /// Which.
        path: PathBuf,
        /// What is wrong, with the line if there are lines.
        message: String,
    },
}

impl ReadError {
    fn malformed(path: &Path, message: impl Into<String>) -> Self {
        Self::Malformed { path: path.to_owned(), message: message.into() }
    }
}

/// Reads a scene; the ending of the name, `.json` or `.dl`, tells the format.
///
/// # Errors
/// [`ReadError`] names the file and what is wrong with it.
pub fn read(path: &Path) -> Result<Frame, ReadError> {
    match path.extension().and_then(|ending| ending.to_str()) {
        Some("json") => read_mesh(path),
        Some("dl") => {
            let text = String::from_utf8(bytes(path)?)
                .map_err(|_| ReadError::malformed(path, "not UTF-8 text"))?;
            parse_display_list(&text).map_err(|message| ReadError::malformed(path, message))
        }
        _ => Err(ReadError::malformed(path, "not a scene: its name should end in .json or .dl")),
    }
}

fn bytes(path: &Path) -> Result<Vec<u8>, ReadError> {
    std::fs::read(path).map_err(|source| ReadError::Io { path: path.to_owned(), source })
}

/// Checks the sides of a picture.
fn side(value: f64, name: &str) -> Result<u32, String> {
    if value.fract() == 0.0 && (1.0..=f64::from(MAX_SIDE)).contains(&value) {
        Ok(value as u32)
    } else {
        Err(format!("{name} is {value}: whole numbers from 1 to {MAX_SIDE} are"))
    }
}

/// Checks a component of a colour.
fn component(value: f64) -> Result<f32, String> {
    if (0.0..=255.0).contains(&value) {
        Ok((value / 255.0) as f32)
    } else {
        Err(format!("{value} is no component of a colour: 0 to 255 are"))
    }
}
