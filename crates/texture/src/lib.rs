//! Texture filtering: mip pyramids and filters, from nearest to elliptical weighted averages.
//!
//! A pixel sees an area of a texture, not a point. A [`Footprint`] says which: a centre and a
//! Jacobian. A [`Texture`] holds the image and its pyramid, and [`Texture::sample`] gives the
//! average that a [`Sampler`] asks for.
//!
//! # Conventions
//!
//! - Texel (i, j) of a level covers [i, i+1) × [j, j+1); its centre is at (i + ½, j + ½). Positions
//!   and Jacobians are in texels of level 0, y down.
//! - Level 0 is the image. Level l is ⌊w/2ˡ⌋ × ⌊h/2ˡ⌋ and at least 1×1: coarser is a larger number.
//! - Texels are premultiplied, in the working space that the texture was made in, and so are samples.
//! - Every result is the same, bit for bit, on every machine.
//! - Nothing panics, whatever the numbers are; work for each sample is bounded (below).
//!
//! # The elliptical filter
//!
//! The pixel is a Gaussian, σ = ½ pixel. Under the Jacobian it becomes an elliptical Gaussian in the
//! texture, to which the reconstruction between texels adds a variance of 1/6. The ellipse is read
//! in the level of the pyramid where its minor axis has a σ of [`Sampler::least_sigma`] to twice that
//! in texels, so a sample costs about as many texels whatever the distance; only its axis ratio
//! counts, and [`Sampler::max_eccentricity`] bounds that. After Heckbert (1989), with the variance of
//! the pyramid's own blur subtracted.
//!
//! An ellipse holds at most π·R²·4s²·a texels (R the radius, s the least σ, a the largest axis ratio)
//! or 16,384, whichever is more. Its rows are read in quads of texels, so count up to five times that for the
//! thinnest, and the same again where two levels blend. Where no coarser level can bring an ellipse
//! within that (level zero asked for; no pyramid), it is shrunk to it, and aliases.
//!
//! # Which sampler
//!
//! | sampler | worst of four images, dB | texels read |
//! |---|---|---|
//! | bilinear, two levels (trilinear) | 24 / 29 / 29 | 5 |
//! | [`Sampler::CLASSIC`]: the method of 2009, for comparison | 26 / 31 / 29 | |
//! | [`PixelFilter::Probes`], as hardware does it but along the true axis | 40 / 33 / 29 | |
//! | [`Sampler::FAST`]: previews, video | 45 / 40 / 41 | 36 |
//! | [`Sampler::DEFAULT`]: everything | 48 / 40 / 49 | 63 |
//! | [`Sampler::HIGH`]: print, masters | 48 / 51 / 49 | 64 |
//! | [`Sampler::REFERENCE`]: truth for tests | 46 / 74 / 81 | 150 |
//!
//! PSNR against a brute-force Gaussian pixel on a checkerboard, a zone plate, strokes like text and
//! noise like photographs: on a ground plane to its horizon / a keystone 3 times down / a turn of 30°,
//! 4 times down. Texels are the mean over the ground plane, those of weight 0 included; time goes with
//! them. A test holds the presets to these figures. Over the near half of the
//! ground plane a pixel sees less than a texel: all presets integrate the bilinear surface there
//! ([`Magnify::Taps`]), which is worth 6 to 17 dB over an ellipse. A preset is
//! as good as its worst scale, just where the ellipse falls on a level's boundary: on text, 33, 33, 42
//! and 66 dB.
//!
//! # Beside the presets
//!
//! - [`Sampler::kernel`]: another pixel filter than the Gaussian, one's own included ([`RadialFilter`]).
//!   All but the Gaussian are read texel by texel in scalar code.
//! - [`Sampler::magnify`]: what is made of a texture that is magnified, from soft to sharp, without a
//!   seam where it begins to be minified.
//! - [`PixelFilter::Separable`]: plain interpolation, for what is only ever magnified.
//! - [`Probes`]: anisotropic filtering of anything that can average a round spot; [`procedural`] has
//!   sources that are functions, and the ground grid of 3-D viewports.
//! - [`maps`]: levels of cut-outs and of normal maps.
//! - [`Texels`]: images of one to four channels, in 8 and 16 bits, half floats and floats, in foreign
//!   memory, with the alpha's kind in the type.
//! - [`compare`] and [`Sampler::CLASSIC`]: what others do.
//!
//! # Cost
//!
//! - Memory: 8 bytes a texel, four numbers of 16 bits in steps of 1/16,320 (64 to a code of eight bits),
//!   and a third more for the pyramid. Rounding to a step is noise at −95 dB. Level 0 of an opaque image of
//!   bytes that is averaged as it is encoded takes 4, with the same results. Images in more than eight
//!   bits and in floats are stored as floats, 16 bytes a texel, as bright as they are ([`Storage`]).
//! - Only what is asked for is made and kept: [`Levels`] says which levels, [`TextureOptions::window`]
//!   which part of the image, [`TextureOptions::outlines`] which parts of the finest levels, and
//!   [`TextureBuilder`] takes rows as a decoder yields them.
//! - A pixel of the ground plane (`cargo bench`, one core of a server with 512-bit vectors) by
//!   [`Texture::sample_row`]: nearest 5 ns, bilinear 8, trilinear 9, [`Sampler::FAST`] 34 and
//!   [`Sampler::DEFAULT`] 53 on the average. Magnified five times, bilinear takes 8, Catmull and Rom's cubic
//!   10 and the taps 18. [`Texture::sample`] sets up one pixel at a time and is slower; runs of four and
//!   more pixels are worth a row.
//! - A pyramid takes about as long to make as fresh memory from the system does: [`Texture::renewed`]
//!   makes one in the memory of another, and the feature `huge-pages` asks for memory in large pages.
//!
//! # Example
//!
//! ```
//! use scumble_geometry::Matrix2;
//! use scumble_pixel::Image;
//! use scumble_texture::{Footprint, Sampler, Texture, TextureOptions};
//!
//! // A checkerboard of single texels, seen from so far that a pixel covers 16×16 of them.
//! let texels = (0..64 * 64).map(|i| if (i + i / 64) % 2 == 0 { [255; 4] } else { [0, 0, 0, 255] });
//! let image = Image::from_vec(64, 64, texels.collect())?;
//! let texture = Texture::new(image.view(), &TextureOptions::default())?;
//! let pixel = Footprint { u: 31.2, v: 30.7, jacobian: Matrix2::new(16.0, 0.0, 0.0, 16.0) };
//! let [r, _, _, alpha] = texture.sample(&pixel, &Sampler::default()).0;
//! assert!((r - 0.5).abs() < 0.01 && alpha == 1.0);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! # Features
//!
//! - `std` (default): instruction sets are chosen at run time.
//! - `libm`: floating point without the standard library; the crate is `no_std` with `alloc` then, and
//!   gives the same bits by the instructions that it is compiled for.
//! - `parallel`: builds pyramids on several threads, with the same bits.
//! - `huge-pages`: asks the system for large pages for levels from 4 MB on, where it has them.
//! - `image`: textures from the crate `image`'s decoded images.
//! - `glam`: footprints from its vectors and matrices.
#![cfg_attr(not(feature = "std"), no_std)]

extern crate alloc;

mod abreast;
mod batch;
mod builder;
mod classic;
pub mod compare;
mod covariance;
mod decimate;
mod decode;
mod engine;
mod error;
mod ewa;
mod extra;
mod footprint;
mod format;
mod gaussian;
#[cfg(any(feature = "glam", feature = "image"))]
mod interop;
mod kernel;
mod level;
mod lod;
mod magnify;
pub mod maps;
mod math;
mod memory;
mod mixture;
mod names;
mod number;
mod options;
mod outline;
mod place;
mod point;
mod points;
mod probes;
pub mod procedural;
mod pyramid;
mod radial;
mod reach;
pub mod reference;
mod run;
mod sampler;
mod separable;
mod simd;
mod square;
mod store;
mod texel;
mod texture;
mod walk;
mod walk_float;
mod walk_simd;
mod wrap;

pub use builder::TextureBuilder;
pub use error::TextureError;
pub use footprint::Footprint;
pub use format::{
    Alpha, Channel, Channels, PremultipliedAlpha, StraightAlpha, TexelFormat, Texels,
};
pub use kernel::{Kernel, RadialFilter};
pub use magnify::Magnify;
pub use names::UnknownName;
pub use options::{Decimation, Levels, Storage, TextureOptions};
pub use outline::Outline;
pub use probes::Probes;
pub use sampler::{LevelMode, PixelFilter, Sampler};
pub use separable::Separable;
pub use simd::Simd;
pub use texture::Texture;
pub use wrap::Wrap;
