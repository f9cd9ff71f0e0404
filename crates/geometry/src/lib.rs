//! Geometry for a rasterizer: points, maps, triangles, polygons and paths.
//!
//! What shapes are before they become pixels: affine and projective maps with exact Jacobians,
//! perspective-correct interpolation, clipping, curves and strokes as polygons, polygons as
//! triangles. Knows nothing of pixels' colours or of how shapes are drawn.
//!
//! # Conventions
//!
//! - Two-dimensional, **y down**: (0, 0) is the top left corner of the canvas, a positive angle
//!   turns clockwise to the eye, and so does a polygon of positive area.
//! - Pixel (i, j) covers the half-open square [i, i+1) × [j, j+1); its centre is (i+½, j+½).
//! - Everything that positions something is `f64`. glam's [`DVec2`] is scalar and gives the same
//!   bits on every processor.
//! - Maps act on column points from the left: `(a * b).apply(p)` is `a.apply(b.apply(p))`.
//! - w > 0 is in front of the eye. Homogeneous points are [`DVec3`] (X, Y, w), before the division.
//! - No input makes a function panic or run on: NaN, infinities and huge numbers give an error, an
//!   empty shape or a non-finite number, as each function says.
//! - Values come from + − × ÷ √ ⌊⌋ and comparisons in a fixed order, so the same input gives the
//!   same bits on every machine.
//!
//! # From a path in perspective to triangles
//!
//! ```
//! # #[cfg(feature = "paths")] {
//! use scumble_geometry::{DVec2, FillRule, Homography, Path, Rect, Triangle, triangulate};
//!
//! // A floor, seen in perspective: the far edge is half as wide on the screen.
//! let floor = Rect::new(0.0, 0.0, 10.0, 10.0);
//! let screen = [(50.0, 20.0), (100.0, 20.0), (125.0, 90.0), (25.0, 90.0)];
//! let map = Homography::from_points(floor.corners(), screen.map(|(x, y)| DVec2::new(x, y)))?;
//!
//! // A disc on it, flattened so that the chords are right to 1/10 pixel on the screen …
//! let disc = Path::ellipse(DVec2::new(5.0, 5.0), DVec2::new(5.0, 5.0));
//! let outline = disc.flatten(&map, 0.1);
//! // … and cut into triangles that an exact rasterizer takes as they are.
//! let triangles = triangulate(outline.iter(), FillRule::NonZero);
//! let area: f64 = triangles.iter().map(|&t| Triangle::new(t).signed_area()).sum();
//! assert!((3000.0..5250.0).contains(&area));
//!
//! // What a pixel of the floor shows: a point and the Jacobian there, for a texture filter.
//! let back = map.inverse()?;
//! let pixel = DVec2::new(75.5, 60.5);
//! let footprint = back.jacobian(pixel).axes();
//! assert!(back.project(pixel).is_some() && footprint.major >= footprint.minor);
//! # }
//! # Ok::<(), scumble_geometry::GeometryError>(())
//! ```
//!
//! # Features
//!
//! - `std` (default): floating point from the standard library.
//! - `libm`: floating point without it; the crate is `no_std` with `alloc` then, and gives the
//!   same bits.
//! - `paths`: `Path`, its flattening and stroking.
#![cfg_attr(not(feature = "std"), no_std)]

extern crate alloc;

mod affine;
#[cfg(feature = "paths")]
mod chords;
mod clip;
mod contours;
mod error;
mod fill_rule;
#[cfg(feature = "paths")]
mod flatten;
mod homography;
mod interpolator;
mod line;
mod math;
mod matrix2;
#[cfg(feature = "paths")]
mod path;
mod plane;
mod ramp;
mod rect;
mod rectify;
#[cfg(feature = "paths")]
mod stroke;
mod tiles;
mod triangle;
mod triangulate;

pub use affine::Affine;
pub use clip::{clip_polygon, clip_polygon_to_rect, clip_segment};
pub use contours::Contours;
pub use error::GeometryError;
pub use fill_rule::FillRule;
pub use glam::{DVec2, DVec3};
pub use homography::Homography;
pub use interpolator::Interpolator;
pub use line::{line_quad, line_quad_square};
pub use matrix2::{Axes, Matrix2};
#[cfg(feature = "paths")]
pub use path::{Path, PathElement};
pub use plane::Plane;
pub use ramp::Ramp;
pub use rect::{IntRect, Rect};
pub use rectify::{Rectified, Winding};
#[cfg(feature = "paths")]
pub use stroke::{Cap, Join, StrokeStyle};
pub use tiles::{BandStarts, TileBins, TileGrid};
pub use triangle::{EdgeFunction, Triangle};
pub use triangulate::{triangulate, triangulate_with};
