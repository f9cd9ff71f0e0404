//! Nearest and bilinear: filters of a place in one level, blind to the footprint.

use crate::Wrap;
use crate::level::Level;
use crate::math::floor;

/// a + (b − a)·t for each channel; equal ends give themselves.
#[inline(always)]
pub(crate) fn lerp(a: [f32; 4], b: [f32; 4], t: f32) -> [f32; 4] {
    core::array::from_fn(|c| a[c] + (b[c] - a[c]) * t)
}

/// The texel that (u, v), in texels of this level, lies in.
#[inline(always)]
pub(crate) fn nearest(level: &Level, wrap: Wrap, u: f64, v: f64) -> [f32; 4] {
    level.texel(floor(u) as i64, floor(v) as i64, wrap)
}

/// The four texels whose centres surround (u, v), in texels of this level.
#[inline(always)]
pub(crate) fn bilinear(level: &Level, wrap: Wrap, u: f64, v: f64) -> [f32; 4] {
    let (x, y) = (u - 0.5, v - 0.5);
    let (x0, y0) = (floor(x), floor(y));
    let (fx, fy) = ((x - x0) as f32, (y - y0) as f32);
    let (x0, y0) = (x0 as i64, y0 as i64);
    let row = |y| lerp(level.texel(x0, y, wrap), level.texel(x0 + 1, y, wrap), fx);
    lerp(row(y0), row(y0 + 1), fy)
}
