//! What a pixel is: formats, premultiplied alpha in the type, sRGB and linear light, images.
//!
//! # Conventions
//!
//! - Colours are red, green, blue, alpha in 0…1 as `f32`; [`Premul`] has the alpha multiplied in,
//!   [`Straight`] has not. Nothing converts silently.
//! - A [`WorkingSpace`] is the space in which a run averages: sRGB-encoded values, as SVG and the
//!   browsers composite, or linear light, as light adds.
#![cfg_attr(not(feature = "std"), no_std)]

extern crate alloc;

mod color;
mod image;
mod space;
pub mod srgb;
mod unorm;

pub use color::{Premul, Straight};
pub use image::{Image, ImageError, ImageView};
pub use space::WorkingSpace;
pub use unorm::{unorm8, unorm16};
