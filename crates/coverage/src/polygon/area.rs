//! Exact area of polygons under a fill rule.
//!
//! Row by row, the edges are added to sums ([`super::sums`]), and from these follows the area of
//! most pixels: of all in rows in which the outline is known not to cross itself ([`super::simple`]).
//! What is left are knots: eight pixels with edges that run both ways, or that lie
//! over one another, or that begin and end in the row. They are untied one by one
//! ([`super::strips`]), from the edges that touch them and the winding number left of these.
//!
//! The eight pixels begin at a multiple of eight, wherever the clip does, and edges are looked at as
//! far as they reach. So each knot is the same in every clip, and what follows from the sums is to
//! the bit what would come of untying it.

use super::calm::is_calm;
use super::gather::{Gathered, ROWS};
use super::strips::{AreaEdge, Place, Strips, sort};
use super::sums::{Met, RowSums, Stretches};
use super::{Polygon, PolygonScratch, steps::Steps};
use crate::AreaSink;
use crate::area::{CHUNK, ROW_CELLS};
use alloc::vec::Vec;
use fearless_simd::{Level, Simd, dispatch};
use scumble_geometry::IntRect;

/// A polygon within a clip that is narrow enough for the sums of a row.
struct Clipped<'a> {
    polygon: &'a Polygon,
    rect: IntRect,
}

/// Working memory for the knots of a row.
#[derive(Debug, Clone, Default)]
pub(super) struct Knots {
    strips: Strips,
    /// The edges of the row by their first chunk, which is in the upper half.
    order: Vec<u64>,
    /// Those that touch the current chunk (places in [`RowSums::met`]).
    here: Vec<u32>,
    edges: Vec<AreaEdge>,
}

impl Polygon {
    /// `region` lies within the bounds and is not empty.
    pub(crate) fn rasterize_area(
        &self,
        region: IntRect,
        level: Level,
        scratch: &mut PolygonScratch,
        sink: &mut impl AreaSink,
    ) {
        let mut x = region.x0;
        while x < region.x1 {
            let end = region.x1.min((x & -CHUNK) + ROW_CELLS);
            let clipped = Clipped { polygon: self, rect: IntRect { x0: x, x1: end, ..region } };
            dispatch!(level, simd => clipped.rasterize::<_, true>(simd, scratch, sink));
            x = end;
        }
    }
}

impl Clipped<'_> {
    /// With `PLAIN`, plain groups of edges take the short way; without it all are untied, which
    /// gives the same to the bit.
    #[inline(always)]
    fn rasterize<S: Simd, const PLAIN: bool>(
        &self,
        simd: S,
        scratch: &mut PolygonScratch,
        sink: &mut impl AreaSink,
    ) {
        let rect = self.rect;
        let columns = (rect.x0 & -CHUNK, (rect.x1 + CHUNK - 1) & -CHUNK);
        scratch.sums.resize_with(ROWS, RowSums::default);
        for sums in &mut scratch.sums {
            sums.start(columns.0, columns.1);
        }
        // Rows that are wholly inside are handed on together.
        let mut inside_from = None;
        let mut y = rect.y0;
        while y < rect.y1 {
            // The bands of the index begin at multiples of their height.
            let end = ((y | (ROWS as i32 - 1)) + 1).min(rect.y1);
            let rows = &mut scratch.sums[..(end - y) as usize];
            for (row, sums) in (y..).zip(&mut *rows) {
                sums.clear();
                sums.proven = PLAIN && self.polygon.is_proven(row);
            }
            scratch.gathered.start(simd, self.polygon, columns, (y, rows));
            let mut left = 0;
            for row in 0..(end - y) as usize {
                let steps = &mut scratch.left;
                steps.reset(left);
                scratch.gathered.left_side(row, steps);
                left = steps.bottom();
                let calm = scratch.sums[row].is_empty() && steps.is_constant();
                let inside = calm && self.polygon.is_inside(left);
                let y = y + row as i32;
                if inside {
                    inside_from.get_or_insert(y);
                } else if let Some(from) = inside_from.take() {
                    sink.block(IntRect { y0: from, y1: y, ..rect });
                }
                if !calm {
                    self.row::<S, PLAIN>(simd, y, row, scratch, sink);
                }
            }
            y = end;
        }
        if let Some(from) = inside_from {
            sink.block(IntRect { y0: from, ..rect });
        }
    }

    /// Hands on row `y`.
    #[inline(always)]
    fn row<S: Simd, const PLAIN: bool>(
        &self,
        simd: S,
        y: i32,
        row: usize,
        scratch: &mut PolygonScratch,
        sink: &mut impl AreaSink,
    ) {
        let PolygonScratch { gathered, left, sums, knots, areas, .. } = scratch;
        let sums = &mut sums[row];
        sums.pass(left);
        for level in self.polygon.levels_between(y * 256, y * 256 + 256) {
            sums.add_level(level.left >> 8, level.right >> 8);
        }
        let base = left.mean() + sums.before;
        if sums.find_knots::<PLAIN>(left) {
            knots.untie(simd, self.polygon, y, gathered, (sums, left));
        }
        sums.sweep(self.polygon, base, (areas, &mut Row { y, rect: self.rect, sink }));
    }
}

impl Knots {
    /// Finds the areas of all knots of row `y`.
    #[inline(always)]
    fn untie<S: Simd>(
        &mut self,
        simd: S,
        polygon: &Polygon,
        y: i32,
        gathered: &Gathered,
        (sums, left): (&mut RowSums, &mut Steps),
    ) {
        self.order.clear();
        // By chunks that do not begin at the clip, so that the order is the same in every clip.
        let key = |(i, met): (u64, &Met)| chunk_key(met.first) << 32 | i;
        self.order.extend((0..).zip(&sums.met).map(key));
        sort(&mut self.order, Ord::cmp);
        self.here.clear();
        let mut taken = 0;
        let mut next = sums.next_knot(0);
        while let Some(chunk) = next {
            let x = sums.first_pixel(chunk);
            // What lies left of the chunk is left behind.
            let mut kept = 0;
            for at in 0..self.here.len() {
                let i = self.here[at];
                if self.stays(i, x, y, gathered, (sums, left)) {
                    self.here[kept] = i;
                    kept += 1;
                }
            }
            self.here.truncate(kept);
            while let Some(&key) = self.order.get(taken)
                && key >> 32 <= chunk_key(x)
            {
                let i = key as u32;
                if self.stays(i, x, y, gathered, (sums, left)) {
                    self.here.push(i);
                }
                taken += 1;
            }
            self.edges.clear();
            for &i in &self.here {
                let source = &gathered.edges[sums.met[i as usize].edge as usize];
                self.edges.push(source.area_edge(y));
            }
            if is_calm((x, y), left, &self.edges) {
                sums.calm(chunk);
            } else {
                let place = Place { polygon, x, y, left };
                sums.untie(chunk, self.strips.areas(simd, place, &self.edges));
            }
            next = sums.next_knot(chunk + 1);
        }
    }

    /// Whether an edge reaches the pixels from `x` on. One that does not is added to what is left of them.
    #[inline(always)]
    fn stays(
        &self,
        i: u32,
        x: i32,
        y: i32,
        gathered: &Gathered,
        (sums, left): (&RowSums, &mut Steps),
    ) -> bool {
        let met = &sums.met[i as usize];
        if met.last >= x {
            return true;
        }
        let edge = &gathered.edges[met.edge as usize];
        let (from, to) = edge.within(y);
        left.add(from, edge.winding);
        left.add(to, -edge.winding);
        false
    }
}

/// The chunk of a pixel, in 32 bits that rise with it.
fn chunk_key(x: i32) -> u64 {
    u64::from((x.div_euclid(CHUNK) as u32) ^ 1 << 31)
}

/// A row of a clip, on its way to a sink.
struct Row<'a, S> {
    y: i32,
    rect: IntRect,
    sink: &'a mut S,
}

impl<S: AreaSink> Stretches for Row<'_, S> {
    #[inline(always)]
    fn full(&mut self, x0: i32, x1: i32) {
        let (x0, x1) = (x0.max(self.rect.x0), x1.min(self.rect.x1));
        if x0 < x1 {
            self.sink.run(self.y, x0, x1);
        }
    }

    #[inline(always)]
    fn areas(&mut self, x0: i32, areas: &[f32]) {
        let end = x0 + areas.len() as i32;
        let (from, to) = (x0.max(self.rect.x0), end.min(self.rect.x1));
        if from < to {
            self.sink.row(self.y, from, &areas[(from - x0) as usize..(to - x0) as usize]);
        }
    }
}

#[cfg(test)]
mod tests;
