//! Warping: a picture through a homography, an affine map or any other, each pixel of the result an
//! average over what it sees.
//!
//! A [`Warp`] says how: the map **from the output to the source**, the size of the output, the filter,
//! what lies beyond the edge. [`Warp::prepare`] makes a texture of the source, of the part and the levels
//! that will be read; [`Prepared::draw`] sends the rows to a [`Sink`](crate::Sink), band by band, so that
//! memory does not grow with the height of the output; [`Prepared::verify`] says how far the result is from
//! brute force.
//!
//! # Conventions
//!
//! - Positions are continuous on both sides: pixel (i, j) covers [i, i+1) × [j, j+1). (For maps between
//!   centres, as OpenCV has them, put `Affine::translate(0.5, 0.5)` before and its inverse behind.)
//! - Where a homography has w ≤ 0, behind the horizon, the output is transparent; a pixel that the horizon
//!   cuts is as opaque as its share before it. Near the horizon the work for a pixel stays bounded, as
//!   the texture's documentation has it.
//! - Everything is averaged in one space, [`Warp::space`], linear light unless another is asked for, with
//!   alpha premultiplied. Rows come out with straight alpha ([`OutputPixel`]).
//! - The bytes depend on the source and the warp alone: not on threads, not on the crop, which is that
//!   part of the whole, and not on the machine.
//!
//! # Example
//!
//! ```
//! use scumble::geometry::{DVec2, Homography, Rect};
//! use scumble::pixel::Image;
//! use scumble::warp::Warp;
//!
//! let photo = Image::from_fn(300, 200, |x, y| [x as u8, y as u8, 128, 255])?;
//! // The whole of it onto four points of a picture of 160 by 120 pixels.
//! let to = [(20.0, 10.0), (150.0, 30.0), (140.0, 100.0), (10.0, 115.0)].map(|(x, y)| DVec2::new(x, y));
//! let map = Homography::from_points(to, Rect::new(0.0, 0.0, 300.0, 200.0).corners())?;
//! let picture = Warp::new(map, 160, 120).image(&photo.view())?;
//! assert_eq!(picture.row(0)[0], [0; 4]);
//! assert_eq!(picture.row(60)[80][3], 255);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod border;
mod error;
mod extent;
mod lookup;
mod map;
mod output;
mod painter;
mod run;
mod source;
mod verify;
mod view;

#[cfg(test)]
mod tests;

pub use border::Border;
pub use error::WarpError;
pub use lookup::Lookup;
pub use map::Map;
pub use output::OutputPixel;
pub use run::{Prepared, Stats};
pub use source::Source;
pub use verify::{Distance, Score, Verification};

use crate::DEFAULT_MAX_MEMORY;
use crate::geometry::IntRect;
use crate::pixel::WorkingSpace;
use crate::texture::Sampler;

/// How to warp a picture.
#[derive(Debug, Clone)]
pub struct Warp<M> {
    /// From positions of the output to texels of the source.
    pub map: M,
    /// Columns of the output.
    pub width: u32,
    /// Rows of the output.
    pub height: u32,
    /// The part of the output to make, in its pixels; `None` is all of it. The bytes are those of that
    /// part of the whole.
    pub crop: Option<IntRect>,
    /// How the source is filtered.
    pub sampler: Sampler,
    /// What lies beyond the edge of the source.
    pub border: Border,
    /// The space in which everything is averaged.
    pub space: WorkingSpace,
    /// How many threads to use; 0 is one for each processor. Without the feature `parallel`, one.
    pub threads: usize,
    /// The most bytes that the texture and the rows together may take. The source, which is the
    /// caller's, does not count.
    pub max_memory: u64,
}

impl<M: Map> Warp<M> {
    /// The defaults for an output of the given size: [`Sampler::DEFAULT`], linear light, nothing
    /// beyond the edge, all processors.
    #[must_use]
    pub fn new(map: M, width: u32, height: u32) -> Self {
        Self {
            map,
            width,
            height,
            crop: None,
            sampler: Sampler::default(),
            border: Border::default(),
            space: WorkingSpace::Linear,
            threads: 0,
            max_memory: DEFAULT_MAX_MEMORY,
        }
    }
}
