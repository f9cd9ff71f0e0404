//! The walk over an ellipse in vectors: four rows by four texels of weights at once, and then each
//! row's four texels as sixteen floats. The same sums in the same order as [`crate::walk`].

use crate::Wrap;
use crate::gaussian::gaussian_x16;
use crate::level::Level;
use crate::walk::{LANES, Walk};
use fearless_simd::{Simd, f32x4, f32x16, i32x16, prelude::*};

/// The row of each lane of the weights, and the texel in it.
const ROWS: [f32; 16] = [0., 0., 0., 0., 1., 1., 1., 1., 2., 2., 2., 2., 3., 3., 3., 3.];
const COLUMNS: [f32; 16] = [0., 1., 2., 3., 0., 1., 2., 3., 0., 1., 2., 3., 0., 1., 2., 3.];

/// The weighted average of the texels in the ellipse.
#[inline(always)]
pub(crate) fn walk<S: Simd>(simd: S, level: &Level, wrap: Wrap, w: &Walk) -> [f32; 4] {
    let centre = w.centre(level, wrap);
    if w.is_inside(level) {
        let base = w.y0 * level.width as i64 + w.x0;
        let texels = level.texels.as_flattened();
        let fetch = |j: i32, x: i32| {
            // Inside, so this is an index of a texel.
            let i = (base + i64::from(j) * level.width as i64 + i64::from(x)) as usize;
            texels.get(4 * i..4 * i + 16).map(|run| f32x16::from_slice(simd, run))
        };
        return sum(simd, w, centre, fetch);
    }
    simd.vectorize(
        #[inline(always)]
        || {
            sum(simd, w, centre, |j, x| {
                let row = w.row(j, level, wrap);
                let run = |run: &[_; LANES]| f32x16::from_slice(simd, run.as_flattened());
                Some(row.with_run(w.x0 + i64::from(x), run))
            })
        },
    )
}

/// The sums of [`walk`]; `fetch` gets four texels from a row and a column relative to the centre's.
#[inline(always)]
fn sum<S: Simd>(
    simd: S,
    w: &Walk,
    centre: [f32; 4],
    fetch: impl Fn(i32, i32) -> Option<f32x16<S>>,
) -> [f32; 4] {
    let rows = f32x16::load_array(simd, ROWS);
    let columns = f32x16::load_array(simd, COLUMNS);
    let centre = f32x4::load_array(simd, centre);
    let centres = f32x16::block_splat(centre);
    let mut sums = f32x16::splat(simd, 0.0);
    let mut weights = sums;
    let groups = w.groups();
    for block in 0..w.blocks() {
        let j = w.first + (block * LANES) as i32;
        let dv = (rows + j as f32) - w.fy;
        let e = (dv * dv) * w.row_scale;
        let middle = dv * w.slope + w.fx;
        let start = (middle - w.run).floor() + 1.0;
        let starts = start.to_int::<i32x16<S>>().to_array();
        for k in 0..groups as i32 {
            let dx = (start + (columns + (k * LANES as i32) as f32)) - middle;
            let e = e + (dx * dx) * w.run_scale;
            let weight = e.simd_le(w.cut).select(gaussian_x16(e), f32x16::splat(simd, 0.0));
            weights = weights + weight;
            let (ab, cd) = weight.split();
            let ((a, b), (c, d)) = (ab.split(), cd.split());
            for (r, weight) in (0..LANES as i32).zip([a, b, c, d]) {
                let x = starts[r as usize * LANES] + k * LANES as i32;
                if let Some(run) = fetch(j + r, x) {
                    sums = sums + expand(weight) * (run - centres);
                }
            }
        }
    }
    let total = fold(weights).to_array();
    let total = (total[0] + total[2]) + (total[1] + total[3]);
    if total <= 0.0 {
        return centre.to_array();
    }
    (centre + fold(sums) / total).to_array()
}

/// (b0 + b2) + (b1 + b3) of the four blocks of four.
#[inline(always)]
fn fold<S: Simd>(v: f32x16<S>) -> f32x4<S> {
    let (low, high) = v.split();
    let (even, odd) = (low + high).split();
    even + odd
}

/// Each of four weights four times: one for each channel of its texel.
#[inline(always)]
fn expand<S: Simd>(w: f32x4<S>) -> f32x16<S> {
    let (low, high) = (w.zip_low(w), w.zip_high(w));
    let first = low.zip_low(low).combine(low.zip_high(low));
    let second = high.zip_low(high).combine(high.zip_high(high));
    first.combine(second)
}
