//! Sutherland–Hodgman clipping, written so that neighbours clip alike.
//!
//! An edge that crosses the boundary has exactly one end inside. Its crossing is computed from
//! that end to the other, whichever way the outline runs, so two shapes that share the edge get
//! the same crossing bit for bit.

use crate::{DVec2, DVec3, Rect};
use alloc::vec::Vec;
use glam::Vec2Swizzles;

/// Clips a closed polygon in homogeneous coordinates (X, Y, w) to the half-space w ≥ `min_w`.
///
/// `out` is cleared first. It holds the part of the polygon in front, in the same order, with w
/// exactly `min_w` at the new vertices; or nothing, if the whole polygon lies behind or a number
/// in it is NaN or infinite. As always with this algorithm, a concave polygon that falls apart
/// stays one outline, joined by edges along the line w = `min_w` that run there and back; under
/// both fill rules they enclose nothing.
///
/// Linear time; `min_w` should be positive (see [`Homography::near_w`](crate::Homography::near_w)),
/// so that the division that follows is possible. Sutherland & Hodgman 1974.
///
/// ```
/// use scumble_geometry::{DVec3, clip_polygon};
/// let triangle = [DVec3::new(0.0, 0.0, 1.0), DVec3::new(4.0, 0.0, 1.0), DVec3::new(0.0, 4.0, -1.0)];
/// let mut front = Vec::new();
/// clip_polygon(&triangle, 0.5, &mut front);
/// assert_eq!(front[0], DVec3::new(0.0, 1.0, 0.5));
/// assert_eq!(front[1..3], triangle[..2]);
/// assert_eq!(front[3], DVec3::new(3.0, 1.0, 0.5));
/// ```
pub fn clip_polygon(polygon: &[DVec3], min_w: f64, out: &mut Vec<DVec3>) {
    out.clear();
    if polygon.iter().any(|p| !p.is_finite()) {
        return;
    }
    clip(polygon, |p| p.z >= min_w, |inside, outside| crossing(inside, outside, min_w), out);
    if out.iter().any(|p| !p.is_finite()) {
        out.clear();
    }
}

/// The part of a segment in homogeneous coordinates (X, Y, w) that lies in the half-space
/// w ≥ `min_w`, its ends in their order; `None` if there is none or a number is not finite.
#[must_use]
pub fn clip_segment([a, b]: [DVec3; 2], min_w: f64) -> Option<[DVec3; 2]> {
    let ends = match (a.z >= min_w, b.z >= min_w) {
        (true, true) => [a, b],
        (true, false) => [a, crossing(a, b, min_w)],
        (false, true) => [crossing(b, a, min_w), b],
        (false, false) => return None,
    };
    [a, b, ends[0], ends[1]].iter().all(|p| p.is_finite()).then_some(ends)
}

/// Where the segment from a point with w ≥ `min_w` to one with less meets w = `min_w`.
fn crossing(inside: DVec3, outside: DVec3, min_w: f64) -> DVec3 {
    let t = (inside.z - min_w) / (inside.z - outside.z);
    let p = inside + (outside - inside) * t;
    DVec3::new(p.x, p.y, min_w)
}

/// Clips a closed polygon of the plane to a rectangle, in place; `scratch` is working space.
///
/// The coordinate that is clipped is exact at the new vertices. The result is empty if nothing
/// remains, if a coordinate is NaN or infinite, or if the rectangle is empty. Used to bring
/// far-away geometry into the range of an integer rasterizer: what is filled inside the rectangle
/// stays the same under both fill rules.
pub fn clip_polygon_to_rect(polygon: &mut Vec<DVec2>, rect: Rect, scratch: &mut Vec<DVec2>) {
    if rect.is_empty() || polygon.iter().any(|p| !p.is_finite()) {
        polygon.clear();
        return;
    }
    let cut_x = |a: DVec2, b: DVec2, x: f64| {
        let t = (x - a.x) / (b.x - a.x);
        DVec2::new(x, between(a.y, b.y, t))
    };
    let cut_y = |a: DVec2, b: DVec2, y: f64| cut_x(a.yx(), b.yx(), y).yx();
    clip(polygon, |p| p.x >= rect.x0, |a, b| cut_x(a, b, rect.x0), scratch);
    clip(scratch, |p| p.x <= rect.x1, |a, b| cut_x(a, b, rect.x1), polygon);
    clip(polygon, |p| p.y >= rect.y0, |a, b| cut_y(a, b, rect.y0), scratch);
    clip(scratch, |p| p.y <= rect.y1, |a, b| cut_y(a, b, rect.y1), polygon);
    // Only near the largest number that there is.
    if polygon.iter().any(|p| !p.is_finite()) {
        polygon.clear();
    }
}

/// a + (b − a)·t, but never outside [a, b], and without overflow in b − a.
fn between(a: f64, b: f64, t: f64) -> f64 {
    (a * (1.0 - t) + b * t).clamp(a.min(b), a.max(b))
}

/// One pass of the algorithm, over any kind of point.
fn clip<P: Copy>(
    polygon: &[P],
    inside: impl Fn(P) -> bool,
    crossing: impl Fn(P, P) -> P,
    out: &mut Vec<P>,
) {
    out.clear();
    let Some(&last) = polygon.last() else { return };
    let (mut from, mut from_inside) = (last, inside(last));
    for &to in polygon {
        let to_inside = inside(to);
        match (from_inside, to_inside) {
            (true, false) => out.push(crossing(from, to)),
            (false, true) => out.push(crossing(to, from)),
            _ => {}
        }
        if to_inside {
            out.push(to);
        }
        (from, from_inside) = (to, to_inside);
    }
}
