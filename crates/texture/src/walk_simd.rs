//! The walk over an ellipse in vectors: four rows by four texels of weights at once, and then each
//! row's four texels as sixteen floats. The same sums in the same order as [`crate::walk`].

use crate::engine::Job;
use crate::gaussian::gaussian_x16;
use crate::level::Level;
use crate::walk::{LANES, Walk};
use crate::{Texture, Wrap};
use fearless_simd::{Simd, f32x4, f32x16, i32x16, prelude::*};

/// The row of each lane of the weights, and the texel in it.
const ROWS: [f32; 16] = [0., 0., 0., 0., 1., 1., 1., 1., 2., 2., 2., 2., 3., 3., 3., 3.];
const COLUMNS: [f32; 16] = [0., 1., 2., 3., 0., 1., 2., 3., 0., 1., 2., 3., 0., 1., 2., 3.];

/// Pieces that a batch weighs before it reads a texel: more than the largest ellipse of the default
/// has, and half of a small first-level cache.
const PIECES: usize = 128;

/// The weights of four rows by four texels, and where each row's four texels begin: in lanes 0, 4, 8
/// and 12.
#[derive(Debug, Clone, Copy, Default)]
struct Piece {
    weights: [f32; 16],
    offsets: [i32; 16],
}

/// Memory for [`walk_all`], made once for a run of pixels.
#[derive(Debug)]
pub(crate) struct Scratch([Piece; PIECES]);

impl Default for Scratch {
    fn default() -> Self {
        Self([Piece::default(); PIECES])
    }
}

/// Many walks, each in its level.
///
/// First the weights of all, then the texels of all: within each phase little waits for what came
/// just before, so the processor works on several pixels at once. The chain from an ellipse to its
/// colour, pixel after pixel, is longer than what it can look ahead.
#[inline(always)]
pub(crate) fn walk_all<S: Simd>(
    simd: S,
    t: &Texture,
    jobs: &[Job],
    scratch: &mut Scratch,
    out: &mut [[f32; 4]],
) {
    let mut from = 0;
    while from < jobs.len() {
        let mut used = 0;
        let mut to = from;
        while let Some(job) = jobs.get(to)
            && let Some(pieces) = scratch.0.get_mut(used..used + job.walk.pieces())
        {
            weigh(simd, &t.levels[job.level], &job.walk, pieces);
            used += pieces.len();
            to += 1;
        }
        // A walk too large for the scratch, or one across the edge, goes alone.
        to = to.max(from + 1);
        let mut rest = &scratch.0[..used];
        for (job, out) in jobs[from..to].iter().zip(&mut out[from..to]) {
            let level = &t.levels[job.level];
            let count = job.walk.pieces();
            *out = match rest.split_at_checked(count) {
                Some((own, others)) if count > 0 => {
                    rest = others;
                    gather(simd, level, job.walk.centre(level, t.wrap), own)
                }
                _ => simd.vectorize(
                    #[inline(always)]
                    || walk(simd, level, t.wrap, &job.walk),
                ),
            };
        }
        from = to;
    }
}

/// The pieces of a walk inside a level, or over tiles of it.
#[inline(always)]
fn weigh<S: Simd>(simd: S, level: &Level, w: &Walk, pieces: &mut [Piece]) {
    // After the masks, every sum here is an index of a texel, and fits 31 bits.
    let (stride, [mask_x, mask_y]) = (level.stride as i32, level.mask);
    let row = i32x16::load_array(simd, ROWS.map(|r| r as i32)) + w.y0;
    let mut pieces = pieces.iter_mut();
    for j in (0..w.blocks).map(|block| w.first + block * LANES as i32) {
        let block = Block::new(simd, w, j);
        let starts: i32x16<S> = block.start.to_int::<i32x16<S>>() + w.x0;
        let rows = ((row + j) & mask_y) * stride;
        for (k, piece) in (0..w.groups).zip(&mut pieces) {
            piece.weights = block.weights(simd, w, k).to_array();
            piece.offsets = (rows + ((starts + k * LANES as i32) & mask_x)).to_array();
        }
    }
}

/// The weighted average over the pieces of a walk.
#[inline(always)]
fn gather<S: Simd>(simd: S, level: &Level, centre: [f32; 4], pieces: &[Piece]) -> [f32; 4] {
    let mut sums = Sums::new(simd, centre);
    for piece in pieces {
        sums.add(f32x16::load_array_ref(simd, &piece.weights), |r| {
            let i = piece.offsets[r * LANES] as u32 as usize;
            let run = level.texels.get(i..i + LANES)?;
            Some(f32x16::from_slice(simd, run.as_flattened()))
        });
    }
    sums.finish()
}

/// The weighted average of the texels in the ellipse.
#[inline(always)]
pub(crate) fn walk<S: Simd>(simd: S, level: &Level, wrap: Wrap, w: &Walk) -> [f32; 4] {
    let mut sums = Sums::new(simd, w.centre(level, wrap));
    for j in (0..w.blocks).map(|block| w.first + block * LANES as i32) {
        let block = Block::new(simd, w, j);
        let starts: [i32; 16] = (block.start.to_int::<i32x16<S>>() + w.x0).to_array();
        for k in 0..w.groups {
            sums.add(block.weights(simd, w, k), |r| {
                let row = w.row(j + r as i32, level, wrap);
                let run = |run: &[_; LANES]| f32x16::from_slice(simd, run.as_flattened());
                Some(row.with_run(starts[r * LANES] + k * LANES as i32, run))
            });
        }
    }
    sums.finish()
}

/// What the weights of four rows have in common: sixteen lanes, four for each row.
struct Block<S: Simd> {
    /// The exponent's part from the row.
    e: f32x16<S>,
    /// The ellipse's middle in the row, and the first texel, from x0.
    middle: f32x16<S>,
    start: f32x16<S>,
}

impl<S: Simd> Block<S> {
    /// Rows `j` to `j + 3`.
    #[inline(always)]
    fn new(simd: S, w: &Walk, j: i32) -> Self {
        let dv = (f32x16::load_array(simd, ROWS) + j as f32) - w.fy;
        let e = (dv * dv) * w.row_scale;
        let middle = dv * w.slope + w.fx;
        let start = (middle - w.run).floor() + 1.0;
        Self { e, middle, start }
    }

    /// The weights of group `k` of each row.
    #[inline(always)]
    fn weights(&self, simd: S, w: &Walk, k: i32) -> f32x16<S> {
        let columns = f32x16::load_array(simd, COLUMNS) + (k * LANES as i32) as f32;
        let dx = (self.start + columns) - self.middle;
        let e = self.e + (dx * dx) * w.run_scale;
        e.simd_le(w.cut).select(gaussian_x16(e), f32x16::splat(simd, 0.0))
    }
}

/// Σ w·(t − centre) and Σ w, in lanes.
struct Sums<S: Simd> {
    centre: f32x4<S>,
    texels: f32x16<S>,
    weights: f32x16<S>,
}

impl<S: Simd> Sums<S> {
    #[inline(always)]
    fn new(simd: S, centre: [f32; 4]) -> Self {
        let zero = f32x16::splat(simd, 0.0);
        Self { centre: f32x4::load_array(simd, centre), texels: zero, weights: zero }
    }

    /// Adds four rows of four texels; `fetch` gives a row's.
    #[inline(always)]
    fn add(&mut self, weights: f32x16<S>, fetch: impl Fn(usize) -> Option<f32x16<S>>) {
        let centres = f32x16::block_splat(self.centre);
        self.weights += weights;
        let (ab, cd) = weights.split();
        let ((a, b), (c, d)) = (ab.split(), cd.split());
        for (r, weight) in [a, b, c, d].into_iter().enumerate() {
            if let Some(run) = fetch(r) {
                self.texels += expand(weight) * (run - centres);
            }
        }
    }

    #[inline(always)]
    fn finish(self) -> [f32; 4] {
        let total = fold(self.weights).to_array();
        let total = (total[0] + total[2]) + (total[1] + total[3]);
        if total <= 0.0 {
            return self.centre.to_array();
        }
        (self.centre + fold(self.texels) / total).to_array()
    }
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
