//! The walk over an ellipse in a level of floats.
//!
//! The ellipse and the weights are those of [`crate::walk`]; the sums are of floats, so their order is a
//! part of the definition: sixteen of them, one for each channel of each of four neighbouring texels, row
//! by row, and in the end together. Texels are taken about the one in the middle, so that a constant
//! stays what it is. Written over arrays that the compiler makes vectors of, whatever their width, this
//! is the scalar code and the fast one.

use crate::Wrap;
use crate::gaussian::weight;
use crate::level::Level;
use crate::math::{floor32, sqrt32};
use crate::walk::Walk;

/// Texels of a run.
const RUN: usize = 4;

/// Channels of a run.
const WIDE: usize = 4 * RUN;

/// The weighted average of the texels in the ellipse.
#[inline(always)]
pub(crate) fn walk(level: &Level, wrap: Wrap, w: &Walk) -> [f32; 4] {
    let [right, below] = [w.fx, w.fy].map(|f| i32::from(f >= 0.5));
    let centre = level.texel(w.x0 + right, w.y0 + below, wrap);
    let about: [f32; WIDE] = core::array::from_fn(|i| centre[i % 4]);
    let mut sums = [0.0; WIDE];
    let mut total = 0;
    let rise = sqrt32(w.cut / w.row_scale);
    let (first, last) = (-floor32(rise - w.fy) as i32, floor32(rise + w.fy) as i32);
    for j in first..=last {
        let dv = j as f32 - w.fy;
        let e = w.row_scale * (dv * dv);
        let half = sqrt32((w.cut - e).max(0.0) / w.run_scale);
        // The ellipse's middle in this row, from x0.
        let middle = w.slope * dv + w.fx;
        let (start, end) = (floor32(middle - half) as i32 + 1, floor32(middle + half) as i32);
        let mut row = [0.0; WIDE];
        let mut i = start;
        while i <= end {
            let weights: [i32; RUN] = core::array::from_fn(|k| {
                let dx = (i + k as i32) as f32 - middle;
                let e = e + w.run_scale * (dx * dx);
                if e <= w.cut { weight(e) } else { 0 }
            });
            total += weights.iter().sum::<i32>();
            let run = run(level, wrap, w.x0 + i, w.y0 + j);
            add(&mut row, &weights, &run, &about);
            i += RUN as i32;
        }
        for (sum, row) in sums.iter_mut().zip(row) {
            *sum += row;
        }
    }
    if total == 0 {
        return centre;
    }
    let share = 1.0 / f64::from(total);
    core::array::from_fn(|c| {
        let sum = (sums[c] + sums[c + 8]) + (sums[c + 4] + sums[c + 12]);
        (f64::from(centre[c]) + f64::from(sum) * share) as f32
    })
}

/// Σ w·(t − centre).
#[inline(always)]
fn add(sums: &mut [f32; WIDE], weights: &[i32; RUN], run: &[[f32; 4]; RUN], about: &[f32; WIDE]) {
    let run = run.as_flattened();
    for i in 0..WIDE {
        sums[i] += weights[i / 4] as f32 * (run[i] - about[i]);
    }
}

/// The [`RUN`] texels from (x, y): in place where they are kept or in the apron, collected where they are not.
#[inline(always)]
fn run(level: &Level, wrap: Wrap, x: i32, y: i32) -> [[f32; 4]; RUN] {
    let inside = level.holds([x, y], [x + RUN as i32 - 1, y]);
    match level.texels.floats().and_then(|f| f.get(level.index(x, y)..)?.first_chunk()) {
        Some(run) if inside => *run,
        _ => collect(level, wrap, x, y),
    }
}

#[cold]
#[inline(never)]
fn collect(level: &Level, wrap: Wrap, x: i32, y: i32) -> [[f32; 4]; RUN] {
    core::array::from_fn(|i| level.texel(x + i as i32, y, wrap))
}
