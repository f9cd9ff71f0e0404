//! Tiled traversal: edge functions over blocks of 8 × 8 pixels. (With few samples there is less to
//! test than blocks save, and [`spans`] finds the ends of rows.)
//!
//! The blocks of one band of eight rows that a triangle touches lie side by side, and so do those
//! that it fills. Both ranges come from a division per edge, so the middle is handed on as one
//! rectangle and only the blocks on an edge are looked into.

use super::Triangle;
use super::narrow::Narrow;
use super::spans;
use super::squares;
use super::wide::Wide;
use crate::edge::Edge;
use crate::{SampleMask, SamplePattern, Sink};
use fearless_simd::{Level, Simd, dispatch};
use scumble_geometry::IntRect;

/// Pixels along the side of a block.
pub(super) const BLOCK: i32 = 8;

/// Beyond this |Δx| + |Δy| (in 1/256 pixel: 1792 pixels) an edge needs 64 bits inside a block.
///
/// Inside a block and a pixel beyond it E varies by at most this × 2304, which stays below 2³⁰ − 1.
const NARROW: i64 = 7 << 16;

/// Working memory of [`Triangle::rasterize`]: E at each sample relative to its pixel's corner.
#[derive(Debug, Clone)]
pub(crate) struct TriangleScratch {
    pub(super) narrow: [[i32; 64]; 3],
    pub(super) wide: [[i64; 64]; 3],
}

impl Default for TriangleScratch {
    fn default() -> Self {
        Self { narrow: [[0; 64]; 3], wide: [[0; 64]; 3] }
    }
}

/// Looks into at most 8 × 8 pixels.
pub(super) trait Block {
    fn block(&self, rect: IntRect, sink: &mut impl Sink);
}

impl Triangle {
    /// `region` lies within the bounds and is not empty.
    #[inline]
    pub(crate) fn rasterize(
        &self,
        region: IntRect,
        pattern: &SamplePattern,
        level: Level,
        scratch: &mut TriangleScratch,
        sink: &mut impl Sink,
    ) {
        dispatch!(level, simd => self.rasterize_at(simd, region, pattern, scratch, sink));
    }

    #[inline(always)]
    fn rasterize_at<S: Simd, K: Sink>(
        &self,
        simd: S,
        region: IntRect,
        pattern: &SamplePattern,
        scratch: &mut TriangleScratch,
        sink: &mut K,
    ) {
        let edges = self.edges();
        let narrow = edges.iter().all(|e| e.a.abs() + e.b.abs() <= NARROW);
        if K::SQUARES && narrow && squares::takes(pattern) {
            return squares::rasterize(simd, &edges, region, pattern, sink);
        }
        if pattern.len() <= spans::FEW {
            return spans::rasterize(simd, &edges, region, pattern, sink);
        }
        if narrow {
            walk(&Narrow::new(simd, &edges, pattern, &mut scratch.narrow), &edges, region, sink);
        } else {
            walk(&Wide::new(&edges, pattern, &mut scratch.wide), &edges, region, sink);
        }
    }
}

#[inline(always)]
fn walk(block: &impl Block, edges: &[Edge; 3], region: IntRect, sink: &mut impl Sink) {
    if region.x1 - region.x0 <= BLOCK && region.y1 - region.y0 <= BLOCK {
        block.block(region, sink);
        return;
    }
    let mut y = region.y0;
    while y < region.y1 {
        let end = ((y & !(BLOCK - 1)) + BLOCK).min(region.y1);
        band(block, edges, IntRect { y0: y, y1: end, ..region }, sink);
        y = end;
    }
}

/// At most eight rows, within one row of blocks.
#[inline(always)]
fn band(block: &impl Block, edges: &[Edge; 3], rows: IntRect, sink: &mut impl Sink) {
    let Some([outer, inner]) = ranges(edges, rows) else { return };
    let columns = |x0: i32, x1: i32| IntRect { x0: x0.max(rows.x0), x1: x1.min(rows.x1), ..rows };
    let filled = inner.0 < inner.1;
    let mut merged = Merged { y: rows.y0, spans: [(i32::MAX, i32::MIN); 8], sink };
    let mut x = outer.0;
    while x < outer.1 {
        if filled && x == inner.0 {
            merged.block(columns(inner.0, inner.1));
            x = inner.1;
        } else {
            block.block(columns(x, x + BLOCK), &mut merged);
            x += BLOCK;
        }
    }
    merged.flush();
}

/// From this width on (in pixels) the middle of a band is handed on as a block of its own. A
/// narrower one is joined with the stretches on its sides: what a sink pays per run outweighs that.
const WIDE_BLOCK: i32 = 64;

/// Joins the stretches of each row of a band: those of a triangle touch.
struct Merged<'a, K> {
    y: i32,
    spans: [(i32, i32); BLOCK as usize],
    sink: &'a mut K,
}

impl<K: Sink> Merged<'_, K> {
    #[inline(always)]
    fn flush(&mut self) {
        for (y, (x0, x1)) in (self.y..).zip(self.spans) {
            if x0 < x1 {
                self.sink.run(y, x0, x1);
            }
        }
    }
}

impl<K: Sink> Sink for Merged<'_, K> {
    #[inline(always)]
    fn block(&mut self, rect: IntRect) {
        if rect.x1 - rect.x0 < WIDE_BLOCK {
            for y in rect.y0..rect.y1 {
                self.run(y, rect.x0, rect.x1);
            }
        } else {
            // What comes left of it goes out first, what comes right of it is collected anew.
            self.flush();
            self.spans = [(i32::MAX, i32::MIN); BLOCK as usize];
            self.sink.block(rect);
        }
    }

    #[inline(always)]
    fn run(&mut self, y: i32, x0: i32, x1: i32) {
        let span = &mut self.spans[(y - self.y) as usize];
        *span = (span.0.min(x0), span.1.max(x1));
    }

    #[inline(always)]
    fn pixel(&mut self, x: i32, y: i32, mask: SampleMask) {
        self.sink.pixel(x, y, mask);
    }
}

/// The columns (multiples of [`BLOCK`], half-open) of the blocks that the edges do not reject,
/// and of those that all of them accept; `None` if there are none.
fn ranges(edges: &[Edge; 3], rows: IntRect) -> Option<[(i32, i32); 2]> {
    let lowest = rows.x0 & !(BLOCK - 1);
    let highest = ((rows.x1 - 1) & !(BLOCK - 1)) + BLOCK;
    let (mut outer, mut inner) = ((lowest, highest), (lowest, highest));
    // From a block's index to its column, held to the region.
    let column = |block: i64| {
        block.clamp(i64::from(lowest / BLOCK), i64::from(highest / BLOCK)) as i32 * BLOCK
    };
    let (y0, y1) = (i64::from(rows.y0) << 8, (i64::from(rows.y1) << 8) - 1);
    for e in edges {
        let (top, bottom) = (e.b * y0, e.b * y1);
        let (low, high) = (e.c + top.min(bottom), e.c + top.max(bottom));
        if e.a > 0 {
            // E ≥ 0 from x = ⌈−v / a⌉ on.
            outer.0 = outer.0.max(column(-high.div_euclid(e.a) >> 11));
            inner.0 = inner.0.max(column((-low.div_euclid(e.a) + 2047) >> 11));
        } else if e.a < 0 {
            // E ≥ 0 up to x = ⌊v / −a⌋.
            outer.1 = outer.1.min(column((high.div_euclid(-e.a) >> 11) + 1));
            inner.1 = inner.1.min(column((low.div_euclid(-e.a) + 1) >> 11));
        } else if high < 0 {
            return None;
        } else if low < 0 {
            inner.1 = lowest;
        }
    }
    Some([outer, (inner.0.max(outer.0), inner.1.min(outer.1))])
}
