//! What the levels of textures need that are no colours: cut-outs, whose alpha is tested against a
//! threshold, and normal maps, whose texels are directions.
//!
//! Both work on levels as [`Texture::level`](crate::Texture::level) gives them, and change no level
//! by what is in another.

mod coverage;
mod normals;

pub use coverage::{coverage, coverage_scale, scale_alpha};
pub use normals::{normalize, normalize_row};
