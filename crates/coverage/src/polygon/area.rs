//! Exact area of polygons under a fill rule.
//!
//! Summing signed areas is only right where the winding number is 0 or 1. So each row of pixels is
//! cut at the heights where an edge begins, ends or crosses another. Inside such a strip the edges have an
//! order from left to right, the winding number follows, and so does which of them bound the
//! inside: +1 where it begins, −1 where it ends, 0 for an edge between inside and inside. An edge
//! is handed to the sums only when that changes.

use super::rows::{PolygonScratch, Rows};
use super::{Polygon, PolygonEdge};
use crate::AreaSink;
use crate::accumulate::{AreaRow, ONE, Piece, Slope};
use alloc::vec::Vec;
use core::cmp::Ordering;
use scumble_geometry::IntRect;

/// Columns of a row's sums: what comfortably stays in the cache.
const ROW_CELLS: i32 = 1 << 15;

/// With more edges than this in one row of pixels, the heights where they begin and end are rounded to a
/// power of two times 1/256 pixel, so that the work in a row stays within edges × log(edges).
/// The area of such a crowded row is then off by no more than the shapes' width times that.
const CROWD: usize = 4096;

/// Strips per row that crossings may add, times edges. Beyond it edges that cross inside a strip
/// count as if they did so at its end.
const CROSSING_WORK: usize = 1 << 16;

/// Two edges have crossed if they are out of order by more than this (in pixels). Less is rounding, and as an area
/// it is far below that of an f32.
const OUT_OF_ORDER: f64 = 1.0 / (1 << 26) as f64;

/// Working memory of a row.
#[derive(Debug, Clone, Default)]
pub(super) struct Sweep {
    /// The edges of the row that have not begun, by falling start.
    waiting: Vec<Live>,
    /// Those in the current strip, from left to right.
    live: Vec<Live>,
    /// The inside at the clip's left: +1 or 0, and since which height.
    left_inside: i64,
    left_since: f64,
}

/// An edge within the row.
#[derive(Debug, Clone, Copy)]
struct Live {
    piece: Piece,
    end: f64,
    winding: i32,
    /// What it bounds, and since which height.
    weight: i64,
    since: f64,
    /// x at the top and at the bottom of the strip.
    x: f64,
    next_x: f64,
}

impl Polygon {
    /// `region` lies within the bounds and is not empty.
    pub(crate) fn rasterize_area(
        &self,
        region: IntRect,
        scratch: &mut PolygonScratch,
        sink: &mut impl AreaSink,
    ) {
        let mut x = region.x0;
        while x < region.x1 {
            let end = region.x1.min(x + ROW_CELLS);
            self.area_strip(IntRect { x0: x, x1: end, ..region }, scratch, sink);
            x = end;
        }
    }

    fn area_strip(&self, rect: IntRect, scratch: &mut PolygonScratch, sink: &mut impl AreaSink) {
        let PolygonScratch { rows, area, sweep, .. } = scratch;
        area.start(rect.x0, rect.x1);
        rows.start(self, rect);
        let mut y = rect.y0;
        while y < rect.y1 {
            rows.advance(y);
            let calm = rows.calm_until(y, rect.y1);
            if calm > y {
                if self.is_inside(rows.left) {
                    sink.block(IntRect { y0: y, y1: calm, ..rect });
                }
                y = calm;
                continue;
            }
            self.area_row(y, rect.x0, rows, sweep, area);
            area.sweep(y, sink);
            y += 1;
        }
    }

    /// Adds one row of pixels to the sums.
    fn area_row(&self, y: i32, left: i32, rows: &Rows, sweep: &mut Sweep, area: &mut AreaRow) {
        let (row_top, row_bottom) = (f64::from(y), f64::from(y) + 1.0);
        sweep.start(y, &rows.active);
        let crossings = CROSSING_WORK / (rows.active.len() + 1);
        let mut budget = crossings;
        let mut steps = rows.steps().iter().peekable();
        let mut winding = rows.left;
        let mut top = row_top;
        while top < row_bottom {
            while let Some(step) = steps.next_if(|s| f64::from(s.0) / 256.0 <= top) {
                winding += step.1;
            }
            sweep.retire_and_admit(top, area);
            let step = steps.peek().map_or(row_bottom, |s| f64::from(s.0) / 256.0);
            let mut bottom = sweep.next_event(step.min(row_bottom));
            sweep.order(top, bottom);
            if budget > 0
                && let Some(crossing) = sweep.first_crossing(top, bottom)
            {
                budget -= 1;
                bottom = crossing;
            }
            self.weigh(winding, top, left, sweep, area);
            top = bottom;
        }
        sweep.finish(row_bottom, left, area);
    }

    /// Which edges bound the inside, from `top` on.
    fn weigh(&self, left: i32, top: f64, x: i32, sweep: &mut Sweep, area: &mut AreaRow) {
        let mut winding = left;
        let mut inside = self.is_inside(winding);
        sweep.set_left(i64::from(inside), top, x, area);
        for edge in &mut sweep.live {
            winding += edge.winding;
            let now = self.is_inside(winding);
            edge.set_weight(i64::from(now) - i64::from(inside), top, area);
            inside = now;
        }
    }
}

impl Live {
    fn new(edge: &PolygonEdge, y: i32, grain: i32) -> Option<Self> {
        let rounded = |height: i32| {
            let within = (height - y * 256).clamp(0, 256);
            y * 256 + (within + grain / 2) / grain * grain
        };
        let (start, end) = (rounded(edge.y0), rounded(edge.y1));
        let slope = Slope::new(edge.x0, edge.y0, edge.x1, edge.y1);
        let (start, end) = (f64::from(start) / 256.0, f64::from(end) / 256.0);
        (start < end).then(|| Self {
            piece: Piece::new(slope, start),
            end,
            winding: edge.winding,
            weight: 0,
            since: start,
            x: 0.0,
            next_x: 0.0,
        })
    }

    #[inline]
    fn set_weight(&mut self, weight: i64, y: f64, area: &mut AreaRow) {
        if weight != self.weight {
            self.flush(y, area);
            self.weight = weight;
            self.since = y;
        }
    }

    #[inline]
    fn flush(&self, y: f64, area: &mut AreaRow) {
        if self.weight != 0 && self.since < y {
            area.add(&self.piece, self.since, y, self.weight);
        }
    }
}

impl Sweep {
    fn start(&mut self, y: i32, active: &[PolygonEdge]) {
        self.live.clear();
        self.waiting.clear();
        self.left_inside = 0;
        self.left_since = f64::from(y);
        let grain = (active.len() / CROWD).max(1).next_power_of_two().min(256) as i32;
        self.waiting.extend(active.iter().filter_map(|e| Live::new(e, y, grain)));
        self.waiting.sort_unstable_by(|a, b| b.piece.start().total_cmp(&a.piece.start()));
    }

    /// Drops the edges that end at `top` and takes in those that begin there.
    fn retire_and_admit(&mut self, top: f64, area: &mut AreaRow) {
        self.live.retain(|e| {
            if e.end <= top {
                e.flush(e.end, area);
            }
            e.end > top
        });
        while let Some(edge) = self.waiting.pop_if(|e| e.piece.start() <= top) {
            self.live.push(edge);
        }
    }

    /// The next height at which an edge begins or ends, at most `limit`.
    fn next_event(&self, limit: f64) -> f64 {
        let begin = self.waiting.last().map_or(limit, |e| e.piece.start());
        self.live.iter().fold(limit.min(begin), |y, e| y.min(e.end))
    }

    /// Sorts the edges from left to right at `top`, those that meet there as they go on.
    fn order(&mut self, top: f64, bottom: f64) {
        for e in &mut self.live {
            e.x = e.piece.at(top);
            e.next_x = e.piece.at(bottom);
        }
        sort(&mut self.live, |a, b| a.x.total_cmp(&b.x).then(a.next_x.total_cmp(&b.next_x)));
    }

    /// The first height strictly inside the strip at which two neighbours have met.
    fn first_crossing(&self, top: f64, bottom: f64) -> Option<f64> {
        let mut part = 1.0;
        for pair in self.live.windows(2) {
            let (before, after) = (pair[1].x - pair[0].x, pair[0].next_x - pair[1].next_x);
            if after > OUT_OF_ORDER {
                part = f64::min(part, before / (before + after));
            }
        }
        if part >= 1.0 {
            return None;
        }
        // Up to the next 2⁻²⁴ of a pixel: heights are whole units, and each crossing is progress.
        const GRID: f64 = (1 << 24) as f64;
        let units = (top + (bottom - top) * part) * GRID;
        let height = (crate::fixed::floor(units) + 1.0) / GRID;
        (height < bottom).then_some(height)
    }

    fn set_left(&mut self, inside: i64, y: f64, x: i32, area: &mut AreaRow) {
        if inside != self.left_inside {
            self.flush_left(y, x, area);
            self.left_inside = inside;
            self.left_since = y;
        }
    }

    fn flush_left(&self, y: f64, x: i32, area: &mut AreaRow) {
        if self.left_inside != 0 {
            // A multiple of 2⁻²⁴: exact.
            area.add_from(x, ((y - self.left_since) * ONE as f64) as i64);
        }
    }

    fn finish(&mut self, bottom: f64, x: i32, area: &mut AreaRow) {
        for e in &self.live {
            e.flush(bottom, area);
        }
        self.flush_left(bottom, x, area);
    }
}

/// Sorts what is nearly sorted.
fn sort(live: &mut [Live], order: impl Fn(&Live, &Live) -> Ordering) {
    // Few edges, or hardly any out of place: insertion. Otherwise not.
    if live.len() > 32 {
        if !live.is_sorted_by(|a, b| order(a, b).is_le()) {
            live.sort_unstable_by(order);
        }
        return;
    }
    for i in 1..live.len() {
        let mut j = i;
        while j > 0 && order(&live[j - 1], &live[j]).is_gt() {
            live.swap(j - 1, j);
            j -= 1;
        }
    }
}
