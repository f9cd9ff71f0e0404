//! Nearest and bilinear: filters of a place in one level, or in two that are blended. Here as a
//! definition, in scalar code; `points` is the same sixteen abreast.

use crate::level::Level;
use crate::lod::{self, Pick};
use crate::math::{floor, whole};
use crate::{Footprint, LevelMode, Texture, Wrap};
use scumble_pixel::Premul;

/// a + (b − a)·t for each channel; equal ends give themselves.
#[inline(always)]
pub(crate) fn lerp(a: [f32; 4], b: [f32; 4], t: f32) -> [f32; 4] {
    core::array::from_fn(|c| a[c] + (b[c] - a[c]) * t)
}

/// A filter of a place in a level.
pub(crate) trait Point: Copy {
    /// Texels along a side of the square that it reads.
    const SIDE: i32;

    /// From the corner of the first of them to where it counts from.
    const SHIFT: f64;

    /// The colour, in the level's unit, at a rest in [0, 1) from the first texel.
    fn color(self, level: &Level, wrap: Wrap, first: [i32; 2], rest: [f32; 2]) -> [f32; 4];
}

/// The texel that the place lies in.
#[derive(Clone, Copy)]
pub(crate) struct Nearest;

/// The four texels whose centres surround the place.
#[derive(Clone, Copy)]
pub(crate) struct Bilinear;

impl Point for Nearest {
    const SIDE: i32 = 1;
    const SHIFT: f64 = 0.0;

    fn color(self, level: &Level, wrap: Wrap, [x, y]: [i32; 2], _: [f32; 2]) -> [f32; 4] {
        level.numbers(x, y, wrap)
    }
}

impl Point for Bilinear {
    const SIDE: i32 = 2;
    const SHIFT: f64 = 0.5;

    /// First down, then along.
    fn color(self, level: &Level, wrap: Wrap, [x, y]: [i32; 2], rest: [f32; 2]) -> [f32; 4] {
        let column = |x| lerp(level.numbers(x, y, wrap), level.numbers(x, y + 1, wrap), rest[1]);
        lerp(column(x), column(x + 1), rest[0])
    }
}

/// The colour of a footprint.
pub(crate) fn sample(t: &Texture, f: &Footprint, mode: LevelMode, filter: impl Point) -> Premul {
    let f = t.nearer(f);
    if !f.is_finite() {
        return t.average();
    }
    let Pick { level, coarser } = lod::pick(&f, mode, t.range());
    let fine = in_level(&t.levels[level], t.wrap, &f, filter);
    let color = match t.levels.get(level + 1) {
        Some(next) if coarser > 0.0 => lerp(fine, in_level(next, t.wrap, &f, filter), coarser),
        _ => fine,
    };
    let unit = t.levels[level].unit();
    t.within_range(color.map(|v| v * unit))
}

/// The same in one level.
fn in_level<P: Point>(level: &Level, wrap: Wrap, f: &Footprint, filter: P) -> [f32; 4] {
    let [su, sv] = level.frame.scale;
    let (u, v) = (f.u * su - P::SHIFT, f.v * sv - P::SHIFT);
    let (x, y) = (floor(u), floor(v));
    filter.color(level, wrap, [whole(x), whole(y)], [(u - x) as f32, (v - y) as f32])
}
