//! Geometry for a rasterizer: points, rectangles, affine and projective maps.
//!
//! # Conventions
//!
//! - Two-dimensional, **y down**: (0, 0) is the top left corner of the canvas, a positive angle
//!   turns clockwise to the eye.
//! - Pixel (i, j) covers the half-open square [i, i+1) × [j, j+1); its centre is (i+½, j+½).
//! - Everything that positions something is `f64`. glam's [`DVec2`] is scalar and gives the same
//!   bits on every processor.
//! - Maps act on column points from the left: `(a * b).apply(p)` is `a.apply(b.apply(p))`.
#![cfg_attr(not(feature = "std"), no_std)]

extern crate alloc;

mod affine;
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
mod rect;
#[cfg(feature = "paths")]
mod stroke;

pub use affine::Affine;
pub use clip::{clip_polygon, clip_polygon_to_rect};
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
pub use rect::{IntRect, Rect};
#[cfg(feature = "paths")]
pub use stroke::{Cap, Join, StrokeStyle};
