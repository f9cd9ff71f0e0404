//! The walk over an ellipse in vectors: the starts of sixteen rows at once, then the weights of four
//! quads at once, then the products of two quads' texels in pairs. The same whole numbers as in
//! [`crate::walk`].

use crate::Wrap;
use crate::abreast::NOTHING;
use crate::gaussian;
use crate::level::Level;
use crate::walk::{LANES, Rows, Walk};
use fearless_simd::{
    Simd, f32x4, f32x16, i16x8, i16x16, i16x32, i32x4, i32x8, i32x16, prelude::*, u8x64,
};

/// Rows whose starts are found together.
const ROWS: usize = 16;

/// Their numbers.
const ROW: [f32; ROWS] = [0., 1., 2., 3., 4., 5., 6., 7., 8., 9., 10., 11., 12., 13., 14., 15.];

/// Quads whose weights are found together: a piece.
const QUADS: usize = 4;

/// The texels of four quads, each in its own.
const COLUMN: [f32; 16] = [0., 1., 2., 3., 0., 1., 2., 3., 0., 1., 2., 3., 0., 1., 2., 3.];

/// Takes the four numbers of 32 bits in a block of sixteen bytes, block by block four times each.
const EXPAND: [u8; 64] = {
    let mut bytes = [0; 64];
    let mut i = 0;
    while i < 64 {
        bytes[i] = (i / 16 * 4 + i % 4) as u8;
        i += 1;
    }
    bytes
};

/// Makes pairs of the channels of two texels, in every block of sixteen bytes.
pub(crate) const PAIR: [u8; 64] = {
    let mut bytes = [0; 64];
    let mut i = 0;
    while i < 64 {
        bytes[i] = (i % 16 / 4 * 2 + i % 4 / 2 * 8 + i % 2) as u8;
        i += 1;
    }
    bytes
};

/// The weights of four quads.
#[inline(always)]
fn piece<S: Simd>(
    simd: S,
    e: [f32; QUADS],
    offset: [f32; QUADS],
    scale: f32,
    cut: f32,
) -> i16x16<S> {
    let dx = expand(simd, offset) + f32x16::load_array(simd, COLUMN);
    gaussian::lanes::weights(simd, expand(simd, e) + (dx * dx) * scale, cut)
}

/// Four numbers, four times each.
#[inline(always)]
pub(crate) fn expand<S: Simd>(simd: S, numbers: [f32; QUADS]) -> f32x16<S> {
    four_times(simd, f32x4::load_array(simd, numbers).bitcast()).bitcast()
}

/// Four numbers of 32 bits, whatever they are, four times each.
#[inline(always)]
pub(crate) fn four_times<S: Simd>(simd: S, numbers: i32x4<S>) -> i32x16<S> {
    let four = i32x16::block_splat(numbers);
    four.swizzle_dyn_within_blocks(u8x64::load_array(simd, EXPAND))
}

/// The weighted average of the texels in the ellipse.
#[inline(always)]
pub(crate) fn walk<S: Simd>(simd: S, level: &Level, wrap: Wrap, w: &Walk) -> [f32; 4] {
    let mut sums = Sums::new(simd);
    for group in 0..w.groups {
        let Rows { first, mut count } = w.rows(group);
        let mut j = first;
        while count > 0 {
            let starts = Starts::new(simd, w, group, j);
            let listed = starts.row.simd_lt(count as f32);
            let e = listed.select(starts.e, f32x16::splat(simd, NOTHING)).to_array();
            let (offset, x) = (starts.offset.to_array(), starts.x.to_array());
            let quads = e.as_chunks().0.iter().zip(offset.as_chunks().0);
            let pieces = (count as usize).div_ceil(QUADS).min(ROWS / QUADS);
            for (p, (e, offset)) in quads.enumerate().take(pieces) {
                let weights = piece(simd, *e, *offset, w.run_scale, w.cut).to_array();
                sums.add(
                    simd,
                    &weights,
                    #[inline(always)]
                    |q| {
                        let i = p * QUADS + q;
                        let row = w.row(j + i as i32, level, wrap);
                        i16x16::from_slice(simd, row.run(x[i]).as_flattened())
                    },
                );
                sums.settle(simd);
            }
            count -= ROWS as i32;
            j += ROWS as i32;
        }
    }
    sums.finish(level, wrap, w)
}

/// Where sixteen rows begin.
struct Starts<S: Simd> {
    /// 0, 1, 2 and so on.
    row: f32x16<S>,
    /// The exponent's part from the row.
    e: f32x16<S>,
    /// From the ellipse's middle to the first texel of the quad.
    offset: f32x16<S>,
    /// The column of that texel.
    x: i32x16<S>,
}

impl<S: Simd> Starts<S> {
    /// Of the quads of a number in rows `j` to `j + 15`.
    #[inline(always)]
    fn new(simd: S, w: &Walk, group: i32, j: i32) -> Self {
        let row = f32x16::load_array(simd, ROW);
        let dv = (row + j as f32) - w.fy;
        let e = (dv * dv) * w.row_scale;
        let zero = f32x16::splat(simd, 0.0);
        let half = ((f32x16::splat(simd, w.cut) - e).max(zero) * w.run_width).sqrt();
        let low = (dv * w.slope + w.fx) - half;
        let before = low.floor();
        let shift = LANES as i32 * group;
        let offset = (f32x16::splat(simd, shift as f32 + 1.0) - half) - (low - before);
        let x = before.to_int::<i32x16<S>>() + (w.x0 + 1 + shift);
        Self { row, e, offset, x }
    }
}

/// Σ w·t and Σ w, in lanes.
struct Sums<S: Simd> {
    /// Of one piece: in each lane four weights of at most 2¹² times texels below 2¹⁴·⁴ each.
    texels: i32x16<S>,
    /// What came before them: the bits from 12 on, and those below.
    high: i32x16<S>,
    low: i32x16<S>,
    weights: i32x8<S>,
}

impl<S: Simd> Sums<S> {
    #[inline(always)]
    fn new(simd: S) -> Self {
        let zero = i32x16::splat(simd, 0);
        Self { texels: zero, high: zero, low: zero, weights: i32x8::splat(simd, 0) }
    }

    /// Adds four quads; `fetch` gives the texels of each.
    #[inline(always)]
    fn add(&mut self, simd: S, weights: &[i16; 16], fetch: impl Fn(usize) -> i16x16<S>) {
        let all = i16x16::load_array_ref(simd, weights);
        self.weights += all.pairwise_dot_product(i16x16::splat(simd, 1));
        for (q, weights) in [0, 2].into_iter().zip(weights.as_chunks::<8>().0) {
            // The weights of two texels side by side are a pair; so are, after this, their channels.
            let expand = u8x64::load_array(simd, EXPAND);
            let weights = i16x32::block_splat(i16x8::load_array_ref(simd, weights));
            let weights = weights.swizzle_dyn_within_blocks(expand);
            let texels = fetch(q).combine(fetch(q + 1));
            let texels = texels.swizzle_dyn_within_blocks(u8x64::load_array(simd, PAIR));
            self.texels += texels.pairwise_dot_product(weights);
        }
    }

    /// Makes room for another piece.
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
