//! Sampled polygons: exact crossings of the edges with every row of samples.
//!
//! A row of samples at height Y meets an edge at the real x = x₀ + (Y − y₀)·Δx/Δy; the samples at
//! ⌈x⌉ and beyond have it on their left. Each crossing adds its ±1 to the first such pixel of each
//! sample, the pixels that got anything are marked, and one sweep over the marked pixels sums the
//! winding numbers of all samples side by side. Between marked pixels nothing changes, so whole runs
//! are handed on at once, and nothing is ever sorted along x.

use super::rows::{PolygonScratch, Rows};
use super::{Polygon, PolygonEdge};
use crate::traversal::emit;
use crate::{SampleMask, SamplePattern, Sink};
use alloc::vec::Vec;
use scumble_geometry::IntRect;

/// Cells (pixels × samples) of a row's winding buffer: what comfortably stays in the cache.
const ROW_CELLS: i32 = 1 << 16;

/// One row of pixels: changes of the winding number.
#[derive(Debug, Clone, Default)]
pub(super) struct RowWinding {
    /// Per pixel and sample. All zero between rows.
    change: Vec<i32>,
    /// One bit per pixel: whether any of its changes was written.
    marked: Vec<u64>,
    /// Per sample: the winding number at the current pixel.
    winding: Vec<i32>,
}

impl RowWinding {
    fn resize(&mut self, width: usize, samples: usize) {
        // Everything is zero between calls, so only growth needs filling.
        self.change.resize(self.change.len().max(width * samples), 0);
        self.marked.resize(width.div_ceil(64), 0);
        self.winding.clear();
        self.winding.resize(samples, 0);
    }
}

impl Polygon {
    /// `region` lies within the bounds and is not empty.
    pub(crate) fn rasterize(
        &self,
        region: IntRect,
        pattern: &SamplePattern,
        scratch: &mut PolygonScratch,
        sink: &mut impl Sink,
    ) {
        let width = (ROW_CELLS / pattern.len() as i32).max(64);
        let mut x = region.x0;
        while x < region.x1 {
            let end = region.x1.min(x + width);
            let strip = IntRect { x0: x, x1: end, ..region };
            Strip { polygon: self, rect: strip, pattern }.rasterize(scratch, sink);
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
                    let left = |e: &&PolygonEdge| e.y0 <= sy && sy < e.y1 && e.crossing(sy) <= sx;
                    let winding = self.edges.iter().filter(left).map(|e| e.winding).sum();
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
}

impl Strip<'_> {
    fn rasterize(&self, scratch: &mut PolygonScratch, sink: &mut impl Sink) {
        let PolygonScratch { rows, winding, .. } = scratch;
        let rect = self.rect;
        winding.resize((rect.x1 - rect.x0) as usize, self.pattern.len());
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
                self.add(edge, y, winding);
            }
            self.sweep(y, winding, sink);
            y += 1;
        }
    }

    /// The winding number of each sample at the left side of the clip.
    fn start_row(&self, y: i32, rows: &Rows, winding: &mut [i32]) {
        winding.fill(rows.left);
        for &(height, change) in rows.steps() {
            for (w, o) in winding.iter_mut().zip(self.pattern.offsets()) {
                if y * 256 + i32::from(o[1]) >= height {
                    *w += change;
                }
            }
        }
    }

    /// Adds the crossings of one edge with the samples of row `y`.
    fn add(&self, edge: &PolygonEdge, y: i32, row: &mut RowWinding) {
        let samples = self.pattern.len();
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
                let column = pixel - self.rect.x0;
                if column <= 0 {
                    row.winding[s] += edge.winding;
                } else if pixel < self.rect.x1 {
                    let column = column as usize;
                    row.change[column * samples + s] += edge.winding;
                    row.marked[column / 64] |= 1 << (column % 64);
                }
            }
        }
    }

    /// Sums the changes from left to right, and empties them.
    fn sweep(&self, y: i32, row: &mut RowWinding, sink: &mut impl Sink) {
        let samples = self.pattern.len();
        let mut out = Emitter { y, full: self.pattern.full_mask(), run: None, sink };
        let mut from = self.rect.x0;
        let mut mask = self.mask(&row.winding);
        for word in 0..row.marked.len() {
            let mut bits = core::mem::take(&mut row.marked[word]);
            while bits != 0 {
                let column = word * 64 + bits.trailing_zeros() as usize;
                bits &= bits - 1;
                let x = self.rect.x0 + column as i32;
                out.emit(from, x, mask);
                let change = &mut row.change[column * samples..][..samples];
                for (w, c) in row.winding.iter_mut().zip(change) {
                    *w += core::mem::take(c);
                }
                mask = self.mask(&row.winding);
                from = x;
            }
        }
        out.emit(from, self.rect.x1, mask);
        out.flush();
    }

    fn mask(&self, winding: &[i32]) -> SampleMask {
        let bit = |(s, &w): (usize, &i32)| u64::from(self.polygon.is_inside(w)) << s;
        SampleMask(winding.iter().enumerate().map(bit).fold(0, |m, b| m | b))
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
