//! Rows of few samples: where each edge crosses the rows, eight rows at a time.
//!
//! Along a row of samples a triangle owns one stretch. Its ends come from a division per edge and
//! row, in f64 but exact: every quantity is a whole number below 2⁵², the quotient from a reciprocal
//! is off by one at the most, and its remainder, which is exact too, tells.

use crate::edge::Edge;
use crate::fixed::{WHOLE, whole_bits};
use crate::{SampleMask, SamplePattern, Sink};
use core::ops::Range;
use fearless_simd::{Simd, f64x8, prelude::*};
use scumble_geometry::IntRect;

/// Up to so many samples, stretches of each are quicker than tests of blocks.
pub(super) const FEW: usize = 4;

/// The largest side of a region. An edge's value varies in it by less than 2⁵⁰.
const SIDE: i32 = 1 << 11;

/// Values beyond this keep their sign in the region, so they can be cut to it.
const LIMIT: i64 = 1 << 51;

const ROWS: [f64; 8] = [0.0, 1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0];

/// What an edge bounds.
#[derive(Clone, Copy)]
enum Side {
    Left,
    Right,
    /// All of a row or nothing: it is level.
    Row,
}

/// An edge as the rows of a region meet it.
#[derive(Clone, Copy)]
struct Crossing<const N: usize> {
    side: Side,
    /// How E changes from pixel to pixel, without its sign; and the inverse.
    step: f64,
    inverse: f64,
    /// How E changes from row to row.
    down: f64,
    /// E at each sample of the first pixel.
    at: [f64; N],
}

impl<const N: usize> Crossing<N> {
    #[inline(always)]
    fn new(e: &Edge, region: IntRect, pattern: &SamplePattern) -> Self {
        let side = match e.a {
            1.. => Side::Left,
            0 => Side::Row,
            _ => Side::Right,
        };
        let corner = e.at(i64::from(region.x0) << 8, i64::from(region.y0) << 8);
        let corner = corner.clamp(-LIMIT, LIMIT) as f64;
        let (a, b) = (e.a as f64, e.b as f64);
        let offsets = pattern.offsets();
        let mut at = [corner; N];
        for (at, o) in at.iter_mut().zip(offsets) {
            *at += a * f64::from(o[0]) + b * f64::from(o[1]);
        }
        let step = a.abs() * 256.0;
        Self { side, step, inverse: 1.0 / step, down: b * 256.0, at }
    }

    /// ⌊v / step⌋.
    #[inline(always)]
    fn steps<S: Simd>(&self, simd: S, v: f64x8<S>) -> f64x8<S> {
        let (zero, one) = (f64x8::splat(simd, 0.0), f64x8::splat(simd, 1.0));
        let q = (v * self.inverse).floor();
        let rest = v - q * self.step;
        let q = rest.simd_lt(zero).select(q - one, q);
        rest.simd_ge(f64x8::splat(simd, self.step)).select(q + one, q)
    }
}

/// Hands on the samples of a triangle in a region, for a pattern of at most [`FEW`].
#[inline(always)]
pub(super) fn rasterize<S: Simd>(
    simd: S,
    edges: &[Edge; 3],
    region: IntRect,
    pattern: &SamplePattern,
    sink: &mut impl Sink,
) {
    for y0 in (region.y0..region.y1).step_by(SIDE as usize) {
        for x0 in (region.x0..region.x1).step_by(SIDE as usize) {
            let (x1, y1) = (region.x1.min(x0 + SIDE), region.y1.min(y0 + SIDE));
            let part = IntRect { x0, y0, x1, y1 };
            match pattern.len() {
                1 => walk::<S, 1>(simd, edges, part, pattern, sink),
                2 => walk::<S, 2>(simd, edges, part, pattern, sink),
                3 => walk::<S, 3>(simd, edges, part, pattern, sink),
                _ => walk::<S, FEW>(simd, edges, part, pattern, sink),
            }
        }
    }
}

/// [`rasterize`] in at most [`SIDE`] pixels each way, with N samples.
#[inline(always)]
fn walk<S: Simd, const N: usize>(
    simd: S,
    edges: &[Edge; 3],
    region: IntRect,
    pattern: &SamplePattern,
    sink: &mut impl Sink,
) {
    let crossings = [
        Crossing::<N>::new(&edges[0], region, pattern),
        Crossing::<N>::new(&edges[1], region, pattern),
        Crossing::<N>::new(&edges[2], region, pattern),
    ];
    let nothing = IntRect { x0: 0, y0: region.y0, x1: 0, y1: region.y0 };
    let mut out = Runs { pending: nothing, sink };
    let width = f64::from(region.x1 - region.x0);
    let mut y = region.y0;
    while y < region.y1 {
        let rows = f64x8::load_array(simd, ROWS) + f64::from(y - region.y0);
        let count = (region.y1 - y).min(8) as usize;
        let ends = ends_of_rows(simd, &crossings, rows, f64x8::splat(simd, width));
        if N == 1 {
            let (from, to) = (Lanes::new(simd, ends[0][0]), Lanes::new(simd, ends[0][1]));
            for (i, y) in (0..count).zip(y..) {
                let (from, to) = (from.get(i), to.get(i));
                if from < to {
                    out.run(y, region.x0 + from, region.x0 + to);
                }
            }
        } else {
            let stretches = Stretches::<N>::new(simd, ends, width);
            if region.x1 - region.x0 <= 8 {
                stretches.emit_narrow(region.x0, y, count, &mut out);
            } else {
                stretches.emit(region.x0, y, count, &mut out);
            }
        }
        y += 8;
    }
    out.flush();
}

/// The first pixel and the one past the last, of each sample in eight rows, from the region's left.
#[inline(always)]
fn ends_of_rows<S: Simd, const N: usize>(
    simd: S,
    crossings: &[Crossing<N>; 3],
    rows: f64x8<S>,
    width: f64x8<S>,
) -> [[f64x8<S>; 2]; N] {
    let (zero, one) = (f64x8::splat(simd, 0.0), f64x8::splat(simd, 1.0));
    let mut ends = [[zero, width]; N];
    for e in crossings {
        let down = rows * e.down;
        for ([from, to], &at) in ends.iter_mut().zip(&e.at) {
            let v = down + at;
            match e.side {
                Side::Left => *from = from.max(-e.steps(simd, v)),
                Side::Right => *to = to.min(e.steps(simd, v) + one),
                Side::Row => *to = v.simd_lt(zero).select(zero, *to),
            }
        }
    }
    ends
}

/// The stretches of several samples in eight rows.
struct Stretches<const N: usize> {
    starts: [Lanes; N],
    lengths: [Lanes; N],
    /// First and past the last: what all samples own, and what any does.
    all: [Lanes; 2],
    any: [Lanes; 2],
}

impl<const N: usize> Stretches<N> {
    #[inline(always)]
    fn new<S: Simd>(simd: S, of_samples: [[f64x8<S>; 2]; N], width: f64) -> Self {
        let (zero, width) = (f64x8::splat(simd, 0.0), f64x8::splat(simd, width));
        let (mut all, mut any) = ([zero, width], [width, zero]);
        let (mut starts, mut lengths) = ([const { Lanes::ZERO }; N], [const { Lanes::ZERO }; N]);
        for (s, [from, to]) in of_samples.into_iter().enumerate() {
            // A sample that owns nothing in a row must not widen what the others own.
            let none = from.simd_ge(to);
            let (from, to) = (none.select(width, from), none.select(zero, to));
            all = [all[0].max(from), all[1].min(to)];
            any = [any[0].min(from), any[1].max(to)];
            starts[s] = Lanes::new(simd, from);
            lengths[s] = Lanes::new(simd, (to - from).max(zero));
        }
        let all = [Lanes::new(simd, all[0]), Lanes::new(simd, all[1])];
        let any = [Lanes::new(simd, any[0]), Lanes::new(simd, any[1])];
        Self { starts, lengths, all, any }
    }

    #[inline(always)]
    fn emit(&self, left: i32, top: i32, count: usize, out: &mut Runs<'_, impl Sink>) {
        for (i, y) in (0..count).zip(top..) {
            let (from, to) = (self.all[0].get(i), self.all[1].get(i));
            let full = from < to;
            if full {
                out.run(y, left + from, left + to);
            }
            let (first, last) = (self.any[0].get(i), self.any[1].get(i));
            let (from, to) = if full { (from, to) } else { (last, last) };
            self.partial(i, first..from, [left, y], out);
            self.partial(i, to..last, [left, y], out);
        }
    }

    /// [`Self::emit`] for at most eight columns: all pixels are bits of one word, and those that are
    /// covered in part are found without a loop for each row, whose length nothing could guess.
    #[inline(always)]
    fn emit_narrow(&self, left: i32, top: i32, count: usize, out: &mut Runs<'_, impl Sink>) {
        let mut owned = [0u64; N];
        for i in 0..count {
            for (s, owned) in owned.iter_mut().enumerate() {
                let stretch = (1u64 << self.lengths[s].get(i)) - 1;
                *owned |= (stretch << self.starts[s].get(i)) << (8 * i);
            }
        }
        let all = owned.iter().fold(u64::MAX, |all, owned| all & owned);
        let any = owned.iter().fold(0, |any, owned| any | owned);
        for (row, y) in all.to_le_bytes().into_iter().zip(top..) {
            if row != 0 {
                let (from, to) = (row.trailing_zeros(), 8 - row.leading_zeros());
                out.run(y, left + from as i32, left + to as i32);
            }
        }
        let mut partial = any & !all;
        while partial != 0 {
            let i = partial.trailing_zeros();
            partial &= partial - 1;
            let mut mask = 0;
            for (s, owned) in owned.iter().enumerate() {
                mask |= (owned >> i & 1) << s;
            }
            let (x, y) = ((i & 7) as i32, (i >> 3) as i32);
            out.sink.pixel(left + x, top + y, SampleMask(mask));
        }
    }

    /// The pixels of a row that are covered in part.
    #[inline(always)]
    fn partial(
        &self,
        i: usize,
        columns: Range<i32>,
        [left, y]: [i32; 2],
        out: &mut Runs<'_, impl Sink>,
    ) {
        for x in columns {
            let mut mask = 0;
            for s in 0..N {
                // Left of the start, the difference wraps around to something huge.
                let along = x.wrapping_sub(self.starts[s].get(i)) as u32;
                mask |= u64::from(along < self.lengths[s].get(i) as u32) << s;
            }
            if mask != 0 {
                out.sink.pixel(left + x, y, SampleMask(mask));
            }
        }
    }
}

/// Eight whole numbers of a size that fits 32 bits, as they come out of a register: with [`WHOLE`]
/// added.
struct Lanes([f64; 8]);

impl Lanes {
    const ZERO: Self = Self([0.0; 8]);

    #[inline(always)]
    fn new<S: Simd>(simd: S, v: f64x8<S>) -> Self {
        Self((v + f64x8::splat(simd, WHOLE)).to_array())
    }

    #[inline(always)]
    fn get(&self, i: usize) -> i32 {
        whole_bits(self.0[i])
    }
}

/// Joins equal runs of rows that follow each other.
struct Runs<'a, K> {
    pending: IntRect,
    sink: &'a mut K,
}

impl<K: Sink> Runs<'_, K> {
    #[inline(always)]
    fn run(&mut self, y: i32, x0: i32, x1: i32) {
        let p = &mut self.pending;
        if p.y1 == y && (p.x0, p.x1) == (x0, x1) {
            p.y1 += 1;
        } else {
            self.flush();
            self.pending = IntRect { x0, y0: y, x1, y1: y + 1 };
        }
    }

    #[inline(always)]
    fn flush(&mut self) {
        let IntRect { x0, y0, x1, y1 } = self.pending;
        match y1 - y0 {
            0 => {}
            1 => self.sink.run(y0, x0, x1),
            _ => self.sink.block(self.pending),
        }
    }
}
