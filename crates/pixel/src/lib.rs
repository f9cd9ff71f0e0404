//! What a pixel is: formats, premultiplied alpha in the type, sRGB and linear light, images.
//!
//! # Conventions
//!
//! - Colours are red, green, blue, alpha in 0…1 as `f32`; [`Premul`] has the alpha multiplied in,
//!   [`Straight`] has not. Nothing converts silently. Only premultiplied colours are averaged and
//!   blended, because only their average means anything.
//! - A [`WorkingSpace`] is the space in which a run averages: sRGB-encoded values, as SVG and the
//!   browsers composite, or linear light, as light adds. [`WorkingSpace::import`] leads into it
//!   and [`WorkingSpace::export`] out of it; every 8-bit colour that is not wholly transparent
//!   comes back from the two as it was.
//! - An 8-bit code k stands for the `f32` nearest to k/255, and a value is rounded to the nearest
//!   code, never truncated ([`unorm8`], [`srgb::encode8`]).
//! - The same input gives the same bits on every machine: no function of the platform's
//!   mathematical library is called.
//! - An [`Image`] owns rows of pixels from top to bottom; an [`ImageView`] borrows them, with a
//!   stride.
//!
//! # Example
//!
//! ```
//! use scumble_pixel::{Premul, WorkingSpace};
//!
//! // Half-transparent white over black: what "half" looks like depends on the space.
//! let mix = |space: WorkingSpace| {
//!     let white = space.import([255, 255, 255, 255]).scaled(0.5);
//!     space.export(white.over(space.import([0, 0, 0, 255])))
//! };
//! assert_eq!(mix(WorkingSpace::Srgb), [128, 128, 128, 255]);
//! assert_eq!(mix(WorkingSpace::Linear), [188, 188, 188, 255]);
//! ```
//!
//! # Features
//!
//! - `std` (default): links the standard library. Nothing here needs it: without it the crate is
//!   `no_std` with `alloc`, and the same in every other way.
#![cfg_attr(not(any(feature = "std", test)), no_std)]

extern crate alloc;

mod color;
mod image;
mod porter_duff;
mod space;
pub mod srgb;
mod unorm;

pub use color::{Premul, Straight};
pub use image::{Image, ImageError, ImageView};
pub use porter_duff::PorterDuff;
pub use space::WorkingSpace;
pub use unorm::{unorm8, unorm16};
