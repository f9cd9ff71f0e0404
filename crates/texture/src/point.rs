//! Nearest and bilinear: filters of a place in one level, or in two that are blended.

use crate::level::Level;
use crate::lod::{self, Pick};
use crate::math::floor;
use crate::texel::color;
use crate::texture::into_range;
use crate::{Footprint, LevelMode, Texture, Wrap};
use scumble_pixel::Premul;

/// a + (b − a)·t for each channel; equal ends give themselves.
#[inline(always)]
pub(crate) fn lerp(a: [f32; 4], b: [f32; 4], t: f32) -> [f32; 4] {
    core::array::from_fn(|c| a[c] + (b[c] - a[c]) * t)
}

/// The texel that (u, v), in texels of this level, lies in.
#[inline(always)]
pub(crate) fn nearest(level: &Level, wrap: Wrap, u: f64, v: f64) -> [f32; 4] {
    level.texel(floor(u) as i32, floor(v) as i32, wrap)
}

/// The four texels whose centres surround (u, v), in texels of this level.
#[inline(always)]
pub(crate) fn bilinear(level: &Level, wrap: Wrap, u: f64, v: f64) -> [f32; 4] {
    let (x, y) = (u - 0.5, v - 0.5);
    let (x0, y0) = (floor(x), floor(y));
    let (fx, fy) = ((x - x0) as f32, (y - y0) as f32);
    let (x0, y0) = (x0 as i32, y0 as i32);
    if (x0 >= 0) & (y0 >= 0) & (x0 + 1 < level.width as i32) & (y0 + 1 < level.height as i32) {
        let i = y0 as usize * level.stride + x0 as usize;
        let j = i + level.stride;
        let t = |i: usize| color(level.texels[i]);
        return lerp(lerp(t(i), t(i + 1), fx), lerp(t(j), t(j + 1), fx), fy);
    }
    across_the_edge(level, wrap, [x0, y0], [fx, fy])
}

/// [`bilinear`] where a texel lies outside.
#[cold]
#[inline(never)]
fn across_the_edge(level: &Level, wrap: Wrap, [x, y]: [i32; 2], [fx, fy]: [f32; 2]) -> [f32; 4] {
    let row = |y| lerp(level.texel(x, y, wrap), level.texel(x + 1, y, wrap), fx);
    lerp(row(y), row(y + 1), fy)
}

/// Pixels set up together.
const BATCH: usize = 16;

/// Samples a run of footprints: sixteen places at a time, in loops without a branch, and then their
/// texels.
#[inline(always)]
pub(crate) fn fill(
    t: &Texture,
    at: impl Fn(usize) -> Footprint,
    mode: LevelMode,
    filter: impl Fn(&Level, Wrap, f64, f64) -> [f32; 4],
    out: &mut [Premul],
) {
    let last = t.levels.len() - 1;
    for (chunk, out) in out.chunks_mut(BATCH).enumerate() {
        let (mut u, mut v) = ([0.0; BATCH], [0.0; BATCH]);
        let (mut step, mut detail) = ([0.0; BATCH], [0.0; BATCH]);
        // A lone sample is not set up sixteen times.
        let many = if out.len() == 1 { 1 } else { BATCH };
        for i in 0..many {
            let f = t.nearer(&at(chunk * BATCH + i));
            u[i] = f.u;
            v[i] = f.v;
            step[i] = f.longest_step_squared();
        }
        if mode == LevelMode::Linear {
            for i in 0..many {
                detail[i] = lod::detail(step[i]);
            }
        }
        for (i, out) in out.iter_mut().enumerate() {
            let pick = lod::pick(step[i], detail[i], mode, last);
            *out = if (u[i] + v[i]).is_finite() {
                into_range(blend(t, &pick, u[i], v[i], &filter))
            } else {
                t.average()
            };
        }
    }
}

/// One level, or two of them.
#[inline(always)]
fn blend(
    t: &Texture,
    pick: &Pick,
    u: f64,
    v: f64,
    filter: impl Fn(&Level, Wrap, f64, f64) -> [f32; 4],
) -> [f32; 4] {
    let level = &t.levels[pick.level];
    let [su, sv] = level.frame.scale;
    let fine = filter(level, t.wrap, u * su, v * sv);
    if pick.coarser == 0.0 {
        return fine;
    }
    let level = &t.levels[pick.level + 1];
    let [su, sv] = level.frame.scale;
    lerp(fine, filter(level, t.wrap, u * su, v * sv), pick.coarser)
}
