//! Polygon triangulation on the 1/256 pixel grid, in exact integer arithmetic.
//!
//! Three methods, from the cheapest on:
//! - a single convex contour is cut into triangles of every other vertex, again and again;
//! - contours that neither cross nor touch are cut into monotone pieces by a sweep;
//! - everything else is cut into horizontal beams, and those into trapezoids.

mod beams;
mod grid;
mod monotone;
mod rings;
mod sweep;

use crate::{DVec2, FillRule};
use alloc::vec::Vec;
use grid::GridPoint;
use rings::Rings;

/// Cuts what a set of closed contours encloses into triangles.
///
/// Vertices are first snapped to the nearest point of the 1/256 pixel grid, floor(256·v + ½); the
/// corners of the triangles are points of that grid, exactly representable, so that a rasterizer
/// with 24.8 coordinates takes them as they are. All triangles have positive area in the sense of
/// y down: they turn clockwise to the eye. Never fails, and never panics.
///
/// - Contours that neither cross nor touch one another (nor themselves), nested as they may be,
///   are cut along diagonals between their own vertices, so that their neighbours meet no new
///   vertex on a shared edge. The areas of the triangles sum exactly to that of the snapped shape, and
///   under a half-open fill rule on an exact rasterizer every sample is in as many triangles as
///   the snapped shape asks for: one inside, none outside. Duplicate points, straight runs and
///   spikes without area are taken out first, which changes neither. O(n log n) in practice; a
///   sweep line that crosses `a` edges costs O(a) moves per vertex at worst.
/// - Anything else is cut into trapezoids between the heights of its vertices and crossings, and
///   their corners rounded to the grid. No sample is in two triangles, and those further than
///   1/256 pixel from the outline are as the fill rule says. A crossing costs a row 1/256 pixel
///   high. O(a) trapezoids for each height; once crossings have cost 2²² of them, those of a beam
///   that would exceed it are not cut out, so that hostile input ends: at most n² + 2²² in all.
///   [`triangulate_with`] does not keep them.
///
/// Coordinates beyond ±2²¹ pixels are clipped off. A contour with a NaN or an infinity is left
/// out, as is one with fewer than three points.
///
/// ```
/// use scumble_geometry::{DVec2, FillRule, Triangle, triangulate};
/// let points = [(0.0, 0.0), (8.0, 0.0), (8.0, 8.0), (4.0, 2.0), (0.0, 8.0)];
/// let arrow = points.map(|(x, y)| DVec2::new(x, y));
/// let triangles = triangulate([&arrow[..]], FillRule::NonZero);
/// assert_eq!(triangles.len(), 3);
/// let area: f64 = triangles.iter().map(|&t| Triangle::new(t).signed_area()).sum();
/// assert_eq!(area, 40.0);
/// ```
#[must_use]
pub fn triangulate<'a>(
    contours: impl IntoIterator<Item = &'a [DVec2]>,
    rule: FillRule,
) -> Vec<[DVec2; 3]> {
    let mut out = Vec::new();
    triangulate_with(contours, rule, |triangle| out.push(triangle));
    out
}

/// As [`triangulate`], one triangle after the other: contours that meet take O(n) memory, however
/// many triangles they become.
pub fn triangulate_with<'a>(
    contours: impl IntoIterator<Item = &'a [DVec2]>,
    rule: FillRule,
    mut emit: impl FnMut([DVec2; 3]),
) {
    let rings = Rings::snap(contours);
    let mut emit = |t: [GridPoint; 3]| emit(t.map(GridPoint::to_pixels));
    if let Some(ring) = rings.single_convex() {
        convex(ring, emit);
        return;
    }
    match sweep::visible_rings(&rings, rule).and_then(|visible| monotone::triangulate(&visible)) {
        Some(triangles) => triangles.into_iter().for_each(emit),
        None => beams::triangulate(&rings, rule, &mut emit),
    }
}

/// Triangles of every other vertex of a convex ring, then the same with the ring that is left:
/// their edges are far shorter in sum than those of a fan.
fn convex(ring: &[GridPoint], mut emit: impl FnMut([GridPoint; 3])) {
    let mut ring = ring.to_vec();
    if grid::orient(ring[0], ring[1], ring[2]) < 0 {
        ring.reverse();
    }
    while ring.len() >= 3 {
        for corner in ring.windows(3).step_by(2) {
            emit([corner[0], corner[1], corner[2]]);
        }
        if ring.len().is_multiple_of(2) {
            emit_closing(&ring, &mut emit);
        }
        ring = ring.into_iter().step_by(2).collect();
    }
}

/// The triangle that joins the end of an even ring with its start.
fn emit_closing(ring: &[GridPoint], emit: &mut impl FnMut([GridPoint; 3])) {
    let n = ring.len();
    emit([ring[n - 2], ring[n - 1], ring[0]]);
}
