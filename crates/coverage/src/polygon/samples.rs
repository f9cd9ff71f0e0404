//! Sampled polygons: exact crossings of the edges with every row of samples.
//!
//! A sample has an edge on its left if it stands at or right of the crossing with its row. Each
//! edge adds its ±1 to the first pixel of each sample where that is so, the pixels that got
//! anything are marked, and one sweep over the marked pixels sums the winding numbers of all
//! samples side by side. Between marked pixels nothing changes, so whole runs are handed on at
//! once, and nothing is ever sorted along x.
//!
//! With one sample the crossing is a division, x = ⌈x₀ + (Y − y₀)·Δx/Δy⌉. With more, the few
//! pixels that the edge passes through in a row test all their samples side by side instead.

use super::rows::{PolygonScratch, Rows};
use super::{Polygon, PolygonEdge};
use crate::traversal::emit;
use crate::{SampleMask, SamplePattern, Sink};
use alloc::vec::Vec;
use fearless_simd::{Level, Simd, dispatch, i32x16, prelude::*};
use scumble_geometry::{FillRule, IntRect};

/// Cells (pixels × samples) of a row's winding buffer: what comfortably stays in the cache.
const ROW_CELLS: i32 = 1 << 16;

/// Beyond this |Δx| + |Δy| (in 1/256 pixel) an edge needs 64 bits inside a pixel and is crossed by
/// division.
const NARROW: i64 = 1 << 22;

/// Edge values beyond this keep their sign over the whole pixel, so they can be cut to it.
const LIMIT: i64 = (1 << 30) - 1;

/// One row of pixels: changes of the winding number.
#[derive(Debug, Clone, Default)]
pub(super) struct RowWinding {
    /// Per pixel and sample, the samples filled up to the stride. All zero between rows.
    change: Vec<i32>,
    /// One bit per pixel: whether any of its changes was written.
    marked: Vec<u64>,
    /// Per sample: the winding number at the current pixel.
    winding: Vec<i32>,
}

impl RowWinding {
    fn resize(&mut self, width: usize, stride: usize) {
        // Everything is zero between calls, so only growth needs filling.
        self.change.resize(self.change.len().max(width * stride), 0);
        self.marked.resize(width.div_ceil(64), 0);
        self.winding.clear();
        self.winding.resize(stride, 0);
    }

    #[inline(always)]
    fn mark(&mut self, column: usize) {
        self.marked[column / 64] |= 1 << (column % 64);
    }
}

impl Polygon {
    /// `region` lies within the bounds and is not empty.
    pub(crate) fn rasterize(
        &self,
        region: IntRect,
        pattern: &SamplePattern,
        level: Level,
        scratch: &mut PolygonScratch,
        sink: &mut impl Sink,
    ) {
        let stride = if pattern.len() == 1 { 1 } else { pattern.len().next_multiple_of(16) };
        let width = ROW_CELLS / stride as i32;
        let mut x = region.x0;
        while x < region.x1 {
            let end = region.x1.min(x + width);
            let rect = IntRect { x0: x, x1: end, ..region };
            let strip = Strip { polygon: self, rect, pattern, stride };
            dispatch!(level, simd => strip.rasterize(simd, scratch, sink));
            x = end;
        }
    }

    /// The definition: the winding number of every sample by itself, from all edges.
    pub(crate) fn test_each(&self, region: IntRect, pattern: &SamplePattern, sink: &mut impl Sink) {
        for y in region.y0..region.y1 {
            for x in region.x0..region.x1 {
                let mut mask = 0;
                for (s, o) in pattern.offsets().iter().enumerate() {
                    let (sx, sy) = (x * 256 + i32::from(o[0]), y * 256 + i32::from(o[1]));
                    let mut winding = 0;
                    self.bands.each_in(sy, sy + 1, |e| {
                        winding += if e.crossing(sy) <= sx { e.winding } else { 0 };
                        true
                    });
                    mask |= u64::from(self.is_inside(winding)) << s;
                }
                emit(sink, pattern, (x, y), SampleMask(mask));
            }
        }
    }
}

/// A part of a polygon narrow enough for the row buffer.
struct Strip<'a> {
    polygon: &'a Polygon,
    rect: IntRect,
    pattern: &'a SamplePattern,
    stride: usize,
}

impl Strip<'_> {
    #[inline(always)]
    fn rasterize<S: Simd>(&self, simd: S, scratch: &mut PolygonScratch, sink: &mut impl Sink) {
        let PolygonScratch { rows, winding, .. } = scratch;
        let rect = self.rect;
        winding.resize((rect.x1 - rect.x0) as usize, self.stride);
        rows.start(self.polygon, rect);
        let mut y = rect.y0;
        while y < rect.y1 {
            rows.advance(y);
            let calm = rows.calm_until(y, rect.y1);
            if calm > y {
                if self.polygon.is_inside(rows.left) {
                    sink.block(IntRect { y0: y, y1: calm, ..rect });
                }
                y = calm;
                continue;
            }
            self.start_row(y, rows, &mut winding.winding);
            for edge in &rows.active {
                let run = i64::from(edge.x1) - i64::from(edge.x0);
                let rise = i64::from(edge.y1) - i64::from(edge.y0);
                if self.stride == 1 || run.abs() + rise > NARROW {
                    self.add_crossings(edge, y, winding);
                } else {
                    self.add_tests(simd, edge, y, winding);
                }
            }
            self.sweep(simd, y, winding, sink);
            y += 1;
        }
    }

    /// The winding number of each sample at the left side of the clip.
    fn start_row(&self, y: i32, rows: &Rows, winding: &mut [i32]) {
        winding.fill(rows.left);
        for &(height, change) in rows.steps() {
            for (w, o) in winding.iter_mut().zip(&self.pattern.lanes()[1]) {
                if y * 256 + o >= height {
                    *w += change;
                }
            }
        }
    }

    /// Adds one edge to row `y`: a division per row of samples.
    fn add_crossings(&self, edge: &PolygonEdge, y: i32, row: &mut RowWinding) {
        for level in self.pattern.rows() {
            let height = y * 256 + i32::from(level.y);
            if height < edge.y0 || height >= edge.y1 {
                continue;
            }
            let x = edge.crossing(height);
            for &s in self.pattern.samples_of(level) {
                let s = usize::from(s);
                // The first pixel whose sample s lies at x or beyond.
                let pixel = (x - i32::from(self.pattern.offsets()[s][0]) + 255) >> 8;
                if pixel < self.rect.x1 {
                    let column = (pixel - self.rect.x0).max(0) as usize;
                    row.change[column * self.stride + s] += edge.winding;
                    row.mark(column);
                }
            }
        }
    }

    /// Adds one edge to row `y`: a test of all samples in each pixel that it can pass through.
    #[inline(always)]
    fn add_tests<S: Simd>(&self, simd: S, edge: &PolygonEdge, y: i32, row: &mut RowWinding) {
        let (run, rise) = (edge.x1 - edge.x0, edge.y1 - edge.y0);
        let (first, last) = self.columns(edge, y);
        let start = i64::from(rise) * (i64::from(first) * 256 - i64::from(edge.x0))
            - i64::from(run) * (i64::from(y) * 256 - i64::from(edge.y0));
        let zero = i32x16::splat(simd, 0);
        for chunk in (0..self.stride).step_by(16) {
            let xs = i32x16::from_slice(simd, &self.pattern.lanes()[0][chunk..chunk + 16]);
            let ys = i32x16::from_slice(simd, &self.pattern.lanes()[1][chunk..chunk + 16]);
            // Half-open in y, as ever.
            let top = ys.simd_ge(i32x16::splat(simd, edge.y0.saturating_sub(y * 256)));
            let bottom = ys.simd_lt(i32x16::splat(simd, edge.y1.saturating_sub(y * 256)));
            let all = top.select(bottom.select(i32x16::splat(simd, edge.winding), zero), zero);
            let offsets = xs * i32x16::splat(simd, rise) - ys * i32x16::splat(simd, run);
            let mut before = zero;
            let mut value = start;
            for pixel in first..=last + 1 {
                if pixel >= self.rect.x1 {
                    break;
                }
                let corner = i32x16::splat(simd, value.clamp(-LIMIT, LIMIT) as i32);
                let now = if pixel > last {
                    all
                } else {
                    (offsets + corner).simd_ge(zero).select(all, zero)
                };
                let column = (pixel - self.rect.x0) as usize;
                let change = now - before;
                if change.simd_ne(zero).any_true() {
                    let at = column * self.stride + chunk;
                    let cells = &mut row.change[at..at + 16];
                    (i32x16::from_slice(simd, cells) + change).store_slice(cells);
                    row.mark(column);
                }
                before = now;
                value += i64::from(rise) * 256;
            }
        }
    }

    /// The pixels of row `y` that the edge can pass through: the first, held to the clip's left
    /// side, and the last, no further left than one before it.
    #[inline(always)]
    fn columns(&self, edge: &PolygonEdge, y: i32) -> (i32, i32) {
        let slope =
            (f64::from(edge.x1) - f64::from(edge.x0)) / (f64::from(edge.y1) - f64::from(edge.y0));
        let top = edge.y0.max(y * 256) - edge.y0;
        let bottom = edge.y1.min(y * 256 + 255) - edge.y0;
        let (a, b) = (f64::from(top) * slope, f64::from(bottom) * slope);
        // A unit to either side is more than the rounding.
        let low = edge.x0 + a.min(b) as i32 - 2;
        let high = edge.x0 + a.max(b) as i32 + 2;
        ((low >> 8).max(self.rect.x0), (high >> 8).clamp(self.rect.x0 - 1, self.rect.x1))
    }

    /// Sums the changes from left to right, and empties them.
    #[inline(always)]
    fn sweep<S: Simd>(&self, simd: S, y: i32, row: &mut RowWinding, sink: &mut impl Sink) {
        let full = self.pattern.full_mask();
        let mut out = Emitter { y, full, run: None, sink };
        let mut from = self.rect.x0;
        // The samples at the left side, before any change.
        let mut mask = SampleMask(self.take(simd, 0, row, false) & full.0);
        for word in 0..row.marked.len() {
            let mut bits = core::mem::take(&mut row.marked[word]);
            while bits != 0 {
                let column = word * 64 + bits.trailing_zeros() as usize;
                bits &= bits - 1;
                let x = self.rect.x0 + column as i32;
                out.emit(from, x, mask);
                mask = SampleMask(self.take(simd, column, row, true) & full.0);
                from = x;
            }
        }
        out.emit(from, self.rect.x1, mask);
        out.flush();
    }

    /// Adds the changes of a pixel to the winding numbers and empties them (if `change`), and tells
    /// which samples are inside.
    #[inline(always)]
    fn take<S: Simd>(&self, simd: S, column: usize, row: &mut RowWinding, change: bool) -> u64 {
        if self.stride == 1 {
            if change {
                row.winding[0] += core::mem::take(&mut row.change[column]);
            }
            return u64::from(self.polygon.is_inside(row.winding[0]));
        }
        let zero = i32x16::splat(simd, 0);
        // All bits tell whether a number is zero, the lowest one whether it is odd.
        let relevant = i32x16::splat(
            simd,
            match self.polygon.rule {
                FillRule::NonZero => -1,
                FillRule::EvenOdd => 1,
            },
        );
        let mut mask = 0;
        for chunk in (0..self.stride).step_by(16) {
            let numbers = &mut row.winding[chunk..chunk + 16];
            let mut winding = i32x16::from_slice(simd, numbers);
            if change {
                let at = column * self.stride + chunk;
                let cells = &mut row.change[at..at + 16];
                winding += i32x16::from_slice(simd, cells);
                winding.store_slice(numbers);
                zero.store_slice(cells);
            }
            mask |= (winding & relevant).simd_ne(zero).to_bitmask() << chunk;
        }
        mask
    }
}

/// Hands stretches of equal pixels on, full ones joined into runs.
struct Emitter<'a, S> {
    y: i32,
    full: SampleMask,
    run: Option<(i32, i32)>,
    sink: &'a mut S,
}

impl<S: Sink> Emitter<'_, S> {
    fn emit(&mut self, x0: i32, x1: i32, mask: SampleMask) {
        if x0 >= x1 {
            return;
        }
        if mask == self.full {
            let start = self.run.map_or(x0, |(start, _)| start);
            self.run = Some((start, x1));
            return;
        }
        self.flush();
        if !mask.is_empty() {
            for x in x0..x1 {
                self.sink.pixel(x, self.y, mask);
            }
        }
    }

    fn flush(&mut self) {
        if let Some((x0, x1)) = self.run.take() {
            self.sink.run(self.y, x0, x1);
        }
    }
}
