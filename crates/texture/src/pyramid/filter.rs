//! One row of a level from the rows of the finer one: first across them, then along.

use crate::decimate::Taps;
use crate::engine::{Scalar, Vector};
use crate::pyramid::plan::{LevelPlan, Span};
use crate::pyramid::rung::Rung;
use crate::texel::{Cell, Texel};
use alloc::vec::Vec;
use fearless_simd::{f32x8, i16x8, i16x32, i64x8, prelude::*, u8x16, u16x32};

/// A row of colours in the unit of what is stored, with what lies beyond its ends.
#[derive(Debug, Clone)]
pub(crate) struct Line(pub(crate) Vec<[f32; 4]>);

impl Line {
    /// Texels that a level needs.
    pub(crate) fn length(level: &LevelPlan) -> usize {
        // A few beyond either end.
        level.made[0].len() + 2 * level.taps.as_ref().map_or(0, |[columns, _]| columns.count)
    }
}

/// Row `output` of the next level, of which the columns `to` are made.
#[inline(always)]
pub(crate) fn make<T: Cell>(
    lanes: impl Lanes,
    fine: &Rung<T>,
    [columns, rows]: [&Taps; 2],
    output: i32,
    line: &mut Line,
    to: Span,
    out: &mut [T],
) {
    let from = fine.columns();
    let [first, end] = columns.reach(to);
    if [columns, rows].iter().all(|taps| taps.is_even() && taps.count == 2) {
        // The mean of two by two; nothing lies over an end.
        let first = (first - from.start as i32) as usize;
        let row = |k| {
            let row = fine.row(rows.first(output) + k, rows);
            row.get(first..first + 2 * out.len()).unwrap_or(&[])
        };
        let (above, below) = (row(0), row(1));
        return T::halve(lanes, above, below, out);
    }
    let line = &mut line.0[..(end - first) as usize];
    let (low, high) = (first.max(from.start as i32), end.min(from.end as i32));
    let inside = (low - first) as usize..(high - first) as usize;
    let skipped = low as usize - from.start;
    let taps = Tapped { fine, rows, output, skipped };
    taps.across(&mut line[inside.clone()]);
    for k in (0..inside.start).chain(inside.end..line.len()) {
        let column = columns.resolve(first + k as i32) as i32;
        line[k] = line.get((column - first) as usize).copied().unwrap_or_default();
    }
    along(lanes, columns, to, line, out);
}

/// The rows that an output is made of.
struct Tapped<'a, T> {
    fine: &'a Rung<T>,
    rows: &'a Taps,
    output: i32,
    /// Texels of each row before the first that is needed.
    skipped: usize,
}

impl<T: Cell> Tapped<'_, T> {
    /// Row `k` of them.
    #[inline(always)]
    fn row(&self, k: usize) -> &[T] {
        let row = self.fine.row(self.rows.first(self.output) + k as i32, self.rows);
        row.get(self.skipped..).unwrap_or(&[])
    }

    /// Σ wₖ·tₖ over the rows, about the one in the middle where rounding would show.
    #[inline(always)]
    fn across(&self, out: &mut [[f32; 4]]) {
        let weights = self.rows.weights_of(self.output);
        if T::ROUNDS
            && self.rows.is_even()
            && let Ok(weights) = weights.try_into()
        {
            return self.across_eight(weights, out.as_flattened_mut());
        }
        out.fill([0.0; 4]);
        let middle = self.row(weights.len() / 2);
        for (k, w) in weights.iter().enumerate() {
            if T::ROUNDS {
                for (out, t) in out.iter_mut().zip(self.row(k)) {
                    add(out, *w, t.numbers());
                }
            } else {
                for ((out, t), m) in out.iter_mut().zip(self.row(k)).zip(middle) {
                    add(out, *w, minus(t.numbers(), m.numbers()));
                }
            }
        }
        if !T::ROUNDS {
            for (out, m) in out.iter_mut().zip(middle) {
                add(out, 1.0, m.numbers());
            }
        }
    }
}

impl<T: Cell> Tapped<'_, T> {
    /// The sum over eight rows whose weights are the same from either side.
    #[inline(always)]
    fn across_eight(&self, weights: &[f32; 8], out: &mut [f32]) {
        let mut rows = [&[][..]; 8];
        for (k, row) in rows.iter_mut().enumerate() {
            *row = T::flat(self.row(k)).get(..out.len()).unwrap_or(&[]);
        }
        let [a, b, c, d, e, f, g, h] = rows;
        if [a, b, c, d, e, f, g, h].iter().any(|row| row.len() != out.len()) {
            return;
        }
        for (x, out) in out.iter_mut().enumerate() {
            // Sums of two channels in steps are exact.
            let two = |near: &[T::Number], far: &[T::Number]| near[x].into() + far[x].into();
            *out = weights[3] * two(d, e)
                + weights[2] * two(c, f)
                + weights[1] * two(b, g)
                + weights[0] * two(a, h);
        }
    }
}

#[inline(always)]
fn add(sum: &mut [f32; 4], w: f32, t: [f32; 4]) {
    for (sum, t) in sum.iter_mut().zip(t) {
        *sum += w * t;
    }
}

#[inline(always)]
fn minus(a: [f32; 4], b: [f32; 4]) -> [f32; 4] {
    core::array::from_fn(|c| a[c] - b[c])
}

/// Σ wₖ·tₖ along a line that begins with the first tap of the first output of `to`.
#[inline(always)]
fn along<T: Cell>(lanes: impl Lanes, taps: &Taps, to: Span, line: &[[f32; 4]], out: &mut [T]) {
    if T::ROUNDS && taps.is_even() {
        // One set of weights, two texels from output to output.
        let weights = taps.weights(0);
        if let Ok(weights) = weights.try_into() {
            return along_pairs(lanes, &pairs::<8, 4>(weights), line, out);
        }
        if let Ok(weights) = weights.try_into() {
            return along_pairs(lanes, &pairs::<2, 1>(weights), line, out);
        }
    }
    let begin = taps.first(to.start as i32);
    for (i, out) in out.iter_mut().enumerate() {
        let output = to.start + i;
        let first = (taps.first(output as i32) - begin) as usize;
        let run = &line[first..first + taps.count];
        let middle = if T::ROUNDS { [0.0; 4] } else { run[taps.count / 2] };
        let mut sum = [0.0; 4];
        for (w, t) in taps.weights(output).iter().zip(run) {
            add(&mut sum, *w, minus(*t, middle));
        }
        add(&mut sum, 1.0, middle);
        *out = T::of_numbers(sum);
    }
}

/// The weights of pairs of texels, each four times.
#[inline(always)]
fn pairs<const N: usize, const PAIRS: usize>(weights: &[f32; N]) -> [[f32; 8]; PAIRS] {
    let mut pairs = [[0.0; 8]; PAIRS];
    for (k, weight) in pairs.as_flattened_mut().iter_mut().enumerate() {
        *weight = weights[k / 4];
    }
    pairs
}

/// Two texels at a time.
#[inline(always)]
fn along_pairs<T: Cell, const PAIRS: usize>(
    lanes: impl Lanes,
    weights: &[[f32; 8]; PAIRS],
    line: &[[f32; 4]],
    out: &mut [T],
) {
    const BLOCK: usize = 16;
    let (line, _) = line.as_chunks::<2>();
    let mut runs = line.windows(PAIRS);
    for out in out.chunks_mut(BLOCK) {
        let mut sums = [[0.0; 4]; BLOCK];
        for (sum, run) in sums[..out.len()].iter_mut().zip(&mut runs) {
            *sum = lanes.sum(weights, run);
        }
        T::put(&sums, out);
    }
}

/// The inner loops, in scalar code or in vectors: the same bits from each.
pub(crate) trait Lanes: Copy {
    /// The means of two by two texels of two rows.
    fn halve(self, above: &[Texel], below: &[Texel], out: &mut [Texel]);

    /// The texels of opaque pixels of three bytes, sixty-four steps to a code: some of them, from the
    /// first on; returns how many.
    fn of_rgb(self, bytes: &[u8], out: &mut [Texel]) -> usize;

    /// Σ wₖ·tₖ, odd and even texels apart and then together.
    fn sum<const PAIRS: usize>(
        self,
        weights: &[[f32; 8]; PAIRS],
        run: &[[[f32; 4]; 2]],
    ) -> [f32; 4];
}

/// [`Lanes::halve`] as it is defined.
#[inline(always)]
pub(crate) fn halve<T: Cell>(above: &[T], below: &[T], out: &mut [T]) {
    let (above, below) = (above.as_chunks::<2>().0, below.as_chunks::<2>().0);
    for ((out, [a, b]), [c, d]) in out.iter_mut().zip(above).zip(below) {
        *out = T::mean([*a, *b, *c, *d]);
    }
}

impl Lanes for Scalar {
    #[inline(always)]
    fn halve(self, above: &[Texel], below: &[Texel], out: &mut [Texel]) {
        halve(above, below, out);
    }

    fn of_rgb(self, _: &[u8], _: &mut [Texel]) -> usize {
        0
    }

    #[inline(always)]
    fn sum<const PAIRS: usize>(
        self,
        weights: &[[f32; 8]; PAIRS],
        run: &[[[f32; 4]; 2]],
    ) -> [f32; 4] {
        let mut sum = [0.0; 8];
        for (w, pair) in weights.iter().zip(run) {
            for ((sum, w), t) in sum.iter_mut().zip(w).zip(pair.as_flattened()) {
                *sum += w * t;
            }
        }
        core::array::from_fn(|c| sum[c] + sum[c + 4])
    }
}

impl<S: fearless_simd::Simd> Lanes for Vector<S> {
    #[inline(always)]
    fn halve(self, above: &[Texel], below: &[Texel], out: &mut [Texel]) {
        let (above, above_rest) = above.as_chunks::<16>();
        let (below, below_rest) = below.as_chunks::<16>();
        let (out, out_rest) = out.as_chunks_mut::<8>();
        for ((out, above), below) in out.iter_mut().zip(above).zip(below) {
            // Sixteen texels, in halves; four numbers of 0…16,320 sum to less than 2¹⁶.
            let two = |i: usize| {
                let [above, below] = [above, below].map(|row| &row.as_flattened()[i..i + 32]);
                let sum = i16x32::from_slice(self.0, above) + i16x32::from_slice(self.0, below);
                sum.bitcast::<i64x8<S>>()
            };
            let (left, right) = (two(0), two(32));
            let even = left.unzip_low(right).bitcast::<u16x32<S>>();
            let odd = left.unzip_high(right).bitcast::<u16x32<S>>();
            let sum = even + odd;
            let mean = (sum + 1 + ((sum >> 2) & 1)) >> 2;
            mean.bitcast::<i16x32<S>>().store_slice(out.as_flattened_mut());
        }
        halve(above_rest, below_rest, out_rest);
    }

    #[inline(always)]
    fn of_rgb(self, bytes: &[u8], out: &mut [Texel]) -> usize {
        let places = u8x16::load_array(self.0, [0, 1, 2, 3, 3, 4, 5, 6, 6, 7, 8, 9, 9, 10, 11, 12]);
        let opaque =
            u8x16::load_array(self.0, [0, 0, 0, 255, 0, 0, 0, 255, 0, 0, 0, 255, 0, 0, 0, 255]);
        let mut done = 0;
        let mut rest = bytes;
        // Four pixels are twelve bytes, of sixteen that are read.
        while let Some(sixteen) = rest.first_chunk::<16>()
            && let Some(texels) = out.get_mut(done..done + 4)
        {
            let pixels = u8x16::load_array_ref(self.0, sixteen);
            let (left, right) = (pixels.swizzle_dyn_within_blocks(places) | opaque).widen();
            let texels = texels.as_flattened_mut();
            (left << 6).bitcast::<i16x8<S>>().store_slice(&mut texels[..8]);
            (right << 6).bitcast::<i16x8<S>>().store_slice(&mut texels[8..]);
            rest = &rest[12..];
            done += 4;
        }
        done
    }

    #[inline(always)]
    fn sum<const PAIRS: usize>(
        self,
        weights: &[[f32; 8]; PAIRS],
        run: &[[[f32; 4]; 2]],
    ) -> [f32; 4] {
        let mut sum = f32x8::splat(self.0, 0.0);
        for (w, pair) in weights.iter().zip(run) {
            let pair = f32x8::from_slice(self.0, pair.as_flattened());
            sum += f32x8::load_array_ref(self.0, w) * pair;
        }
        let (even, odd) = sum.split();
        (even + odd).to_array()
    }
}
