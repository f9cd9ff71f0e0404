//! Filters of a place in one level or two, beside the fast ones: texel by texel, in scalar code.

use crate::level::Level;
use crate::lod::{self, Pick};
use crate::magnify::patch::Spotted;
use crate::math::floor;
use crate::point::lerp;
use crate::{Footprint, LevelMode, Separable, Texture, Wrap};

/// The four texels whose centres surround (u, v), in texels of this level.
#[inline(always)]
pub(crate) fn bilinear(level: &Level, wrap: Wrap, u: f64, v: f64) -> [f32; 4] {
    let (x, y) = (u - 0.5, v - 0.5);
    let (x0, y0) = (floor(x), floor(y));
    let (fx, fy) = ((x - x0) as f32, (y - y0) as f32);
    let (x0, y0) = (x0 as i32, y0 as i32);
    let row = |y| lerp(level.texel(x0, y, wrap), level.texel(x0 + 1, y, wrap), fx);
    lerp(row(y0), row(y0 + 1), fy)
}

/// Interpolation by a sharper kernel. The centre is finite and has been brought near.
#[inline(always)]
pub(crate) fn sample(t: &Texture, f: &Footprint, mode: LevelMode, kernel: Separable) -> [f32; 4] {
    let in_level = |index: usize| {
        let level = &t.levels[index];
        kernel.sample(level, t.wrap, &Spotted::new(level, f.u, f.v, &f.jacobian))
    };
    let Pick { level, coarser } = lod::pick(f, mode, t.range());
    let fine = in_level(level);
    if coarser > 0.0 { lerp(fine, in_level(level + 1), coarser) } else { fine }
}

/// Texels that [`sample`] reads.
pub(crate) fn cost(t: &Texture, f: &Footprint, mode: LevelMode, kernel: Separable) -> usize {
    let levels = if lod::pick(f, mode, t.range()).coarser > 0.0 { 2 } else { 1 };
    levels * kernel.texels()
}
