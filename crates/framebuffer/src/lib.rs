//! Tile-local sample storage: blend into samples, resolve samples into pixels, encode pixels.
//!
//! A renderer cuts its frame into tiles and, for each one, [resets](Tile::reset) a [`Tile`],
//! blends the primitives into it in drawing order, resolves it row by row into premultiplied
//! pixels and encodes those to 8-bit sRGB. The frame buffer knows no geometry: which samples a
//! primitive covers comes as a mask, and what colour it has there comes as a [`Premul`](scumble_pixel::Premul).
//!
//! # Conventions
//!
//! - Coordinates are pixels from the tile's top left corner. What lies outside is ignored.
//! - Bit i of a mask is sample i of the pixel. Where the samples lie is the affair of whoever
//!   made the mask; here they are only counted and averaged with equal weights.
//! - Colours are premultiplied and in the working space of the run. Every blend is source-over.
//! - Values depend on the order of the calls for a pixel and on nothing else: not on the tile's
//!   size, nor on what its other pixels hold.
//!
//! Where all that is drawn is opaque, [`Visibility`] keeps what is seen instead of its colour: four
//! bytes a sample in place of sixteen, and each colour is asked for once, at the end. [`Inlay`] does as
//! much for shapes of one colour that are antialiased one by one.
//!
//! [`Exposure`] averages whole frames, row by row: motion blur.
//!
//! # Memory
//!
//! A pixel whose samples are all alike is stored once: 20 bytes a pixel, 80 KiB for a tile of
//! 64×64. It gets storage for its n samples, 16·n + 12 bytes, when a partial mask first tells them
//! apart, and gives it back when an opaque colour covers it whole. [`Tile::max_bytes`] is the worst
//! case; for 64×64 at 16 samples, every pixel split, 1.1 MiB. What a tile has allocated it keeps
//! for the next.
//!
//! # Example
//!
//! ```
//! use scumble_framebuffer::{Tile, encode_row};
//! use scumble_pixel::{Premul, WorkingSpace};
//!
//! let space = WorkingSpace::Srgb;
//! let mut tile = Tile::new();
//! tile.reset(4, 1, 4, space.import([255, 255, 255, 255]));
//! tile.fill_block(0, 0, 2, 1, space.import([255, 0, 0, 255]));
//! tile.blend_masked(2, 0, 0b0011, space.import([0, 0, 0, 255]));
//!
//! let mut pixels = [Premul::TRANSPARENT; 4];
//! tile.resolve_row(0, &mut pixels);
//! let mut codes = [[0; 4]; 4];
//! encode_row(&pixels, space, &mut codes);
//! assert_eq!(codes[0], [255, 0, 0, 255]);
//! assert_eq!(codes[2], [128, 128, 128, 255]);
//! assert_eq!(codes[3], [255, 255, 255, 255]);
//! ```
//!
//! # Features
//!
//! - `std` (default): [`encode_row`] chooses its instructions at run time. Without it the crate is
//!   `no_std` with `alloc`, has no dependency but `scumble-pixel`, and gives the same bytes.
#![cfg_attr(not(any(feature = "std", test)), no_std)]

extern crate alloc;

mod encode;
mod exposure;
mod gradient;
mod inlay;
mod level;
mod palette;
mod samples;
mod stretch;
mod tile;
mod visibility;

pub use encode::{encode_row, encode_row_dithered, encode_row16};
pub use exposure::Exposure;
pub use gradient::Gradient;
pub use inlay::Inlay;
pub use palette::Palette;
pub use tile::Tile;
pub use visibility::{Seen, Visibility};
