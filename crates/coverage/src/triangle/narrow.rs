//! Blocks in 32 bits, sixteen lanes at a time.
//!
//! Two rows of eight pixels make one vector. The pixels that an edge can cross are found first, and
//! each of them tests its samples side by side.

use super::tiled::Block;
use crate::edge::Edge;
use crate::{SampleMask, SamplePattern, Sink};
use fearless_simd::{Simd, i32x16, prelude::*};
use scumble_geometry::IntRect;

/// Edge values beyond this keep their sign over the whole block, so they can be cut to it.
const LIMIT: i64 = (1 << 30) - 1;

const COLUMNS: [i32; 16] = [0, 1, 2, 3, 4, 5, 6, 7, 0, 1, 2, 3, 4, 5, 6, 7];
const ROWS: [i32; 16] = [0, 0, 0, 0, 0, 0, 0, 0, 1, 1, 1, 1, 1, 1, 1, 1];

/// A triangle whose edges fit 32 bits inside a block.
pub(super) struct Narrow<'a, S: Simd> {
    simd: S,
    edges: &'a [Edge; 3],
    pattern: &'a SamplePattern,
    /// E at each sample relative to its pixel's corner.
    offsets: &'a [[i32; 64]; 3],
    /// What E + offset can be at most and at least above E, over the box of the samples.
    low: [i32; 3],
    high: [i32; 3],
    step_x: [i32; 3],
    step_y: [i32; 3],
    /// E over two rows of eight pixels, relative to the first.
    ramp: [i32x16<S>; 3],
}

impl<'a, S: Simd> Narrow<'a, S> {
    #[inline(always)]
    pub(super) fn new(
        simd: S,
        edges: &'a [Edge; 3],
        pattern: &'a SamplePattern,
        offsets: &'a mut [[i32; 64]; 3],
    ) -> Self {
        let a = edges.map(|e| e.a as i32);
        let b = edges.map(|e| e.b as i32);
        let (columns, rows) = (lanes(simd, &COLUMNS), lanes(simd, &ROWS));
        let (step_x, step_y) = (a.map(|a| a * 256), b.map(|b| b * 256));
        let ramp = |k: usize| {
            columns * i32x16::splat(simd, step_x[k]) + rows * i32x16::splat(simd, step_y[k])
        };
        let ramp = [ramp(0), ramp(1), ramp(2)];
        let [mut low, mut high] = [[0; 3]; 2];
        let [xs, ys] = pattern.lanes();
        for k in 0..3 {
            let (a, b) = (i32x16::splat(simd, a[k]), i32x16::splat(simd, b[k]));
            for i in (0..pattern.len()).step_by(16) {
                let v = lanes(simd, &xs[i..]) * a + lanes(simd, &ys[i..]) * b;
                v.store_slice(&mut offsets[k][i..i + 16]);
            }
        }
        let [first, last] = pattern.extent().map(|p| p.map(i32::from));
        for k in 0..3 {
            let (left, right) = (a[k] * first[0], a[k] * last[0]);
            let (top, bottom) = (b[k] * first[1], b[k] * last[1]);
            low[k] = left.min(right) + top.min(bottom);
            high[k] = left.max(right) + top.max(bottom);
        }
        Self { simd, edges, pattern, offsets, low, high, step_x, step_y, ramp }
    }

    /// Bit i: whether all three edges have E ≥ 0 at pixel i of the two rows, moved by `by`.
    #[inline(always)]
    fn test(&self, v: &[i32x16<S>; 3], by: [i32; 3]) -> u32 {
        // Negative as soon as one of them is.
        let mut all = i32x16::splat(self.simd, 0);
        for (v, by) in v.iter().zip(by) {
            all |= *v + i32x16::splat(self.simd, by);
        }
        all.simd_ge(i32x16::splat(self.simd, 0)).to_bitmask() as u32
    }

    /// The samples of the pixel whose corner has the values `v`.
    #[inline(always)]
    fn mask(&self, v: [i32; 3]) -> SampleMask {
        let simd = self.simd;
        let mut mask = 0;
        for i in (0..self.pattern.len()).step_by(16) {
            let mut all = i32x16::splat(simd, 0);
            for (v, offsets) in v.into_iter().zip(self.offsets) {
                all |= i32x16::splat(simd, v) + lanes(simd, &offsets[i..]);
            }
            mask |= all.simd_ge(i32x16::splat(simd, 0)).to_bitmask() << i;
        }
        SampleMask(mask & self.pattern.full_mask().0)
    }

    /// Two rows: a test of the pixels, then one for each pixel on an edge.
    #[inline(always)]
    fn rows(&self, v: &[i32x16<S>; 3], first: [i32; 3], at: Rows, sink: &mut impl Sink) {
        let all = self.pattern.full_mask();
        let any = self.test(v, self.high) & at.valid;
        if any == 0 {
            return;
        }
        let mut full = self.test(v, self.low) & at.valid;
        let mut partial = any & !full;
        while let Some((i, x, y)) = at.next_pixel(&mut partial) {
            let (column, row) = ((i & 7) as i32, (i >> 3) as i32);
            let v = |k: usize| first[k] + column * self.step_x[k] + row * self.step_y[k];
            let mask = self.mask([v(0), v(1), v(2)]);
            if mask == all {
                full |= 1 << i;
            } else if !mask.is_empty() {
                sink.pixel(x, y, mask);
            }
        }
        at.runs(full, sink);
    }
}

impl<S: Simd> Block for Narrow<'_, S> {
    #[inline(always)]
    fn block(&self, rect: IntRect, sink: &mut impl Sink) {
        let (x, y) = (i64::from(rect.x0) << 8, i64::from(rect.y0) << 8);
        let mut first = self.edges.map(|e| e.at(x, y).clamp(-LIMIT, LIMIT) as i32);
        let columns = (1u32 << (rect.x1 - rect.x0)) - 1;
        let mut y = rect.y0;
        while y < rect.y1 {
            let valid = if y + 1 < rect.y1 { columns | columns << 8 } else { columns };
            let at = Rows { x: rect.x0, y, valid };
            let v = |k: usize| self.ramp[k] + i32x16::splat(self.simd, first[k]);
            let v = [v(0), v(1), v(2)];
            self.rows(&v, first, at, sink);
            first = [0, 1, 2].map(|k| first[k] + 2 * self.step_y[k]);
            y += 2;
        }
    }
}

/// Two rows of up to eight pixels, the first sixteen bits of a mask.
#[derive(Clone, Copy)]
struct Rows {
    x: i32,
    y: i32,
    /// The pixels within the clip.
    valid: u32,
}

impl Rows {
    /// The pixels of a triangle's row that are full are one stretch.
    #[inline(always)]
    fn runs(self, full: u32, sink: &mut impl Sink) {
        for (bits, y) in [(full & 0xff, self.y), (full >> 8, self.y + 1)] {
            if bits != 0 {
                let end = 32 - bits.leading_zeros() as i32;
                sink.run(y, self.x + bits.trailing_zeros() as i32, self.x + end);
            }
        }
    }

    /// Takes the first pixel out of `bits`: its bit, and where it lies.
    // A loop over this stays in the kernel's instruction set; a closure might not.
    #[inline(always)]
    fn next_pixel(self, bits: &mut u32) -> Option<(u32, i32, i32)> {
        if *bits == 0 {
            return None;
        }
        let i = bits.trailing_zeros();
        *bits &= *bits - 1;
        Some((i, self.x + (i & 7) as i32, self.y + (i >> 3) as i32))
    }
}

#[inline(always)]
fn lanes<S: Simd>(simd: S, values: &[i32]) -> i32x16<S> {
    i32x16::from_slice(simd, &values[..16])
}
