//! Which samples of which pixels does a shape cover? Exact, seamless, tiled.
//!
//! A [`Shape`] is a triangle or a polygon, snapped to 1/256 pixel once. [`Shape::rasterize`] names
//! every sample it owns to a [`Sink`]: whole blocks and runs where all samples of a pixel are
//! covered, a [`SampleMask`] per pixel along the edges.
//!
//! ```
//! use scumble_coverage::{DVec2, IntRect, SampleMask, SamplePattern, Scratch, Shape, Sink};
//!
//! struct Count(u32);
//! impl Sink for Count {
//!     fn run(&mut self, _y: i32, x0: i32, x1: i32) {
//!         self.0 += 4 * x0.abs_diff(x1);
//!     }
//!     fn pixel(&mut self, _x: i32, _y: i32, mask: SampleMask) {
//!         self.0 += mask.count();
//!     }
//! }
//!
//! let corners = [DVec2::new(1.0, 1.0), DVec2::new(9.0, 1.0), DVec2::new(1.0, 9.0)];
//! let Some(shape) = Shape::triangle(corners)? else { return Ok(()) };
//! let mut count = Count(0);
//! let canvas = IntRect::new(0, 0, 16, 16);
//! shape.rasterize(canvas, &SamplePattern::standard(4)?, &mut Scratch::new(), &mut count);
//! assert_eq!(count.0, 128); // 32 square pixels, 4 samples each
//! # Ok::<(), scumble_coverage::CoverageError>(())
//! ```
//!
//! # Conventions
//!
//! - y points down. Pixel (i, j) is the square [i, i+1) × [j, j+1); rectangles are half-open.
//! - Coordinates are snapped to floor(256 v + ½) / 256 and kept within ±2²¹ pixels. What lies beyond is
//!   clipped, each segment in a way that depends on that segment alone, so neighbours still meet.
//! - Samples stand at whole 1/256 of a pixel ([`SamplePattern`]), and every test is made in whole
//!   numbers of 64 bits: no rounding decides what is covered.
//!
//! # Guarantees
//!
//! - **Each sample once.** A sample exactly on an edge belongs to the side whose left or top edge it
//!   is, as if it stood (ε, ε²) further. So the triangles of a mesh share out the samples
//!   inside it without gap or overlap, and a polygon owns the same samples as all triangles of any
//!   triangulation of it on the 1/256 grid.
//! - **Clips do not matter.** The samples found in a tile are those of the whole picture there.
//! - **Any finite input.** Degenerate, huge, self-crossing: right, in a time that depends on the part
//!   within the clip. What is not finite is refused.
#![cfg_attr(not(feature = "std"), no_std)]

extern crate alloc;

mod accumulate;
mod conservative;
mod edge;
mod error;
mod fixed;
mod guard;
mod hairline;
mod interpolate;
mod mask;
mod pattern;
mod polygon;
mod scratch;
mod shape;
mod sink;
mod traversal;
mod triangle;
mod wide;

pub use error::CoverageError;
pub use fearless_simd::Level;
pub use fixed::FixedPoint;
pub use hairline::hairline;
pub use interpolate::{Barycentric, BarycentricRow, Perspective, PerspectiveWeights};
pub use mask::SampleMask;
pub use pattern::SamplePattern;
pub use scratch::Scratch;
pub use scumble_geometry::{DVec2, FillRule, IntRect};
pub use shape::{Cover, Shape};
pub use sink::{AreaSink, Sink};
pub use traversal::{Order, Traversal};
