//! The walk over an ellipse in vectors: four rows by four texels of weights at once, and then the
//! products of two rows' texels, in pairs. The same whole numbers as in [`crate::walk`].

use crate::engine::Job;
use crate::gaussian;
use crate::level::Level;
use crate::texel::Texel;
use crate::walk::{LANES, Walk};
use crate::{Texture, Wrap};
use fearless_simd::{Simd, f32x16, i16x16, i16x32, i32x4, i32x8, i32x16, prelude::*};

/// The row of each lane of the weights, and the texel in it.
const ROWS: [f32; 16] = [0., 1., 2., 3., 0., 1., 2., 3., 0., 1., 2., 3., 0., 1., 2., 3.];
const COLUMNS: [f32; 16] = [0., 0., 0., 0., 1., 1., 1., 1., 2., 2., 2., 2., 3., 3., 3., 3.];

/// Pieces that a batch weighs before it reads a texel: more than the largest ellipse of the default
/// has, and half of a small first-level cache.
const PIECES: usize = 128;

/// The weights of four rows by four texels, as lanes have them, and where each row's four texels begin.
#[derive(Debug, Clone, Copy, Default)]
struct Piece {
    weights: [i16; 16],
    offsets: [i32; 4],
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
                    gather(simd, level, t.wrap, &job.walk, own)
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
    let row = i32x4::load_array(simd, [0, 1, 2, 3]) + w.y0;
    let mut pieces = pieces.iter_mut();
    for block in 0..w.blocks {
        let j = w.row_of(block);
        let block = Block::new(simd, w, j);
        let mut starts = block.columns(w);
        let mut columns = f32x16::load_array(simd, COLUMNS);
        let rows = ((row + j) & mask_y) * stride - level.base;
        for (_, piece) in (0..w.groups).zip(&mut pieces) {
            piece.weights = block.weights(simd, w, columns).to_array();
            piece.offsets = (rows + (starts & mask_x)).to_array();
            columns += LANES as f32;
            starts += LANES as i32;
        }
    }
}

/// The texels of a piece's row.
#[inline(always)]
fn fetch<S: Simd>(simd: S, level: &Level, piece: &Piece, row: usize) -> i16x16<S> {
    let i = piece.offsets[row] as u32 as usize;
    let run = level.texels.get(i..i + LANES).unwrap_or(&[[0; 4]; LANES]);
    i16x16::from_slice(simd, run.as_flattened())
}

/// The weighted average over the pieces of a walk.
#[inline(always)]
fn gather<S: Simd>(simd: S, level: &Level, wrap: Wrap, walk: &Walk, pieces: &[Piece]) -> [f32; 4] {
    let mut sums = Sums::new(simd);
    if walk.small != 0 {
        for piece in pieces {
            let weights = i16x16::load_array_ref(simd, &piece.weights);
            sums.add(simd, weights, |r| fetch(simd, level, piece, r));
        }
        return sums.finish_small(level, wrap, walk);
    }
    for pieces in pieces.chunks(Sums::<S>::ROOM) {
        for piece in pieces {
            let weights = i16x16::load_array_ref(simd, &piece.weights);
            sums.add(simd, weights, |r| fetch(simd, level, piece, r));
        }
        sums.settle(simd);
    }
    sums.finish(level, wrap, walk)
}

/// The weighted average of the texels in the ellipse.
#[inline(always)]
pub(crate) fn walk<S: Simd>(simd: S, level: &Level, wrap: Wrap, w: &Walk) -> [f32; 4] {
    let mut sums = Sums::new(simd);
    for block in 0..w.blocks {
        let j = w.row_of(block);
        let block = Block::new(simd, w, j);
        let starts = block.columns(w).to_array();
        let mut columns = f32x16::load_array(simd, COLUMNS);
        for k in (0..w.groups).map(|k| k * LANES as i32) {
            let weights = block.weights(simd, w, columns);
            columns += LANES as f32;
            sums.add(simd, weights, |r| {
                let row = w.row(j + r as i32, level, wrap);
                let run = |run: &[Texel; LANES]| i16x16::from_slice(simd, run.as_flattened());
                row.with_run(starts[r] + k, run)
            });
            sums.settle(simd);
        }
    }
    sums.finish(level, wrap, w)
}

/// What the weights of four rows have in common: sixteen lanes, each row in every fourth.
struct Block<S: Simd> {
    /// The exponent's part from the row.
    e: f32x16<S>,
    /// The texel before the first, from x0.
    before: f32x16<S>,
    /// From the ellipse's middle to the first texel of the next group.
    offset: f32x16<S>,
}

impl<S: Simd> Block<S> {
    /// Rows `j` to `j + 3`.
    #[inline(always)]
    fn new(simd: S, w: &Walk, j: i32) -> Self {
        let dv = f32x16::load_array(simd, ROWS) + (j as f32 - w.fy);
        let e = (dv * dv) * w.row_scale;
        let low = dv * w.slope + (w.fx - w.run);
        let before = low.floor();
        let offset = f32x16::splat(simd, 1.0 - w.run) - (low - before);
        Self { e, before, offset }
    }

    /// The first texel of each row.
    #[inline(always)]
    fn columns(&self, w: &Walk) -> i32x4<S> {
        let (before, _) = self.before.split();
        let (before, _) = before.split();
        before.to_int::<i32x4<S>>() + (w.x0 + 1)
    }

    /// The weights of four texels of each row: `columns` are their numbers.
    #[inline(always)]
    fn weights(&self, simd: S, w: &Walk, columns: f32x16<S>) -> i16x16<S> {
        let dx = columns + self.offset;
        gaussian::weights(simd, self.e + (dx * dx) * w.run_scale, w.cut)
    }
}

/// Σ w·t and Σ w, in lanes.
struct Sums<S: Simd> {
    /// Of at most [`Sums::ROOM`] pieces.
    texels: i32x16<S>,
    /// What came before them: the bits from 12 on, and those below.
    high: i32x16<S>,
    low: i32x16<S>,
    weights: i32x8<S>,
}

impl<S: Simd> Sums<S> {
    /// Pieces whose sums are sure to fit 31 bits: in each lane four weights of at most 2¹² times
    /// texels below 2¹⁴·⁴ each.
    const ROOM: usize = 6;

    #[inline(always)]
    fn new(simd: S) -> Self {
        let zero = i32x16::splat(simd, 0);
        Self { texels: zero, high: zero, low: zero, weights: i32x8::splat(simd, 0) }
    }

    /// Adds four rows of four texels; `fetch` gives a row's.
    #[inline(always)]
    fn add(&mut self, simd: S, weights: i16x16<S>, fetch: impl Fn(usize) -> i16x16<S>) {
        self.weights += weights.pairwise_dot_product(i16x16::splat(simd, 1));
        // The weights of two rows' texels are a pair; so are, after the zip, the texels.
        let weights = weights.bitcast::<i32x8<S>>();
        let (pairs, _) = weights.unzip_low(weights).split();
        self.add_rows(pairs, fetch(0), fetch(1));
        let (pairs, _) = weights.unzip_high(weights).split();
        self.add_rows(pairs, fetch(2), fetch(3));
    }

    #[inline(always)]
    fn add_rows(&mut self, weights: i32x4<S>, row: i16x16<S>, next: i16x16<S>) {
        let texels = row.zip_low(next).combine(row.zip_high(next));
        self.texels += texels.pairwise_dot_product(expand(weights).bitcast::<i16x32<S>>());
    }

    /// Makes room for as many pieces again.
    #[inline(always)]
    fn settle(&mut self, simd: S) {
        self.high += self.texels >> 12;
        self.low += self.texels & 0xfff;
        self.texels = i32x16::splat(simd, 0);
    }

    #[inline(always)]
    fn finish(self, level: &Level, wrap: Wrap, walk: &Walk) -> [f32; 4] {
        let (high, low) = (fold(self.high).to_array(), fold(self.low).to_array());
        let sums = core::array::from_fn(|c| f64::from(high[c]) * 4096.0 + f64::from(low[c]));
        walk.mean(sums, self.total(), level, wrap)
    }

    /// The same without [`Sums::settle`], for sums that fit 31 bits in all.
    #[inline(always)]
    fn finish_small(self, level: &Level, wrap: Wrap, walk: &Walk) -> [f32; 4] {
        let sums = fold(self.texels).to_array().map(f64::from);
        walk.mean(sums, self.total(), level, wrap)
    }

    #[inline(always)]
    fn total(&self) -> i32 {
        let (even, odd) = self.weights.split();
        let w = (even + odd).to_array();
        (w[0] + w[2]) + (w[1] + w[3])
    }
}

/// The sum of the four blocks of four.
#[inline(always)]
fn fold<S: Simd>(v: i32x16<S>) -> i32x4<S> {
    let (low, high) = v.split();
    let (even, odd) = (low + high).split();
    even + odd
}

/// Each of four pairs of weights four times: one for each channel of its texel.
#[inline(always)]
fn expand<S: Simd>(w: i32x4<S>) -> i32x16<S> {
    let (low, high) = (w.zip_low(w), w.zip_high(w));
    let first = low.zip_low(low).combine(low.zip_high(low));
    let second = high.zip_low(high).combine(high.zip_high(high));
    first.combine(second)
}
