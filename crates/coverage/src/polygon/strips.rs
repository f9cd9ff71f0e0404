//! Clusters of edges that begin, end or cross each other within a row of pixels.
//!
//! The row is cut at the heights where that happens. Inside such a strip the edges have an order
//! from left to right, the winding number follows, and so does which of them bound the inside. An
//! edge is handed to the sums only when that changes.

use super::Polygon;
use super::area::{AreaEdge, sort};
use crate::area::{AreaRow, Slope, extent};
use alloc::vec::Vec;
use fearless_simd::Simd;

/// Strips per row that crossings may add, times edges. Beyond it edges that cross inside a strip
/// count as if they did so at its end.
const CROSSING_WORK: usize = 1 << 16;

/// Two edges have crossed if they are out of order by more than this (in pixels). Less is rounding,
/// and as an area it is far below that of an f32.
const OUT_OF_ORDER: f64 = 1.0 / (1 << 26) as f64;

/// Working memory of a cluster.
#[derive(Debug, Clone, Default)]
pub(super) struct Strips {
    /// The edges that have not begun, by falling start.
    waiting: Vec<Live>,
    /// Those in the current strip, from left to right.
    live: Vec<Live>,
    /// Whether the clip's left side is inside, and since which height.
    left_inside: bool,
    left_since: f64,
}

/// An edge within the row.
#[derive(Debug, Clone, Copy)]
struct Live {
    slope: Slope,
    start: f64,
    end: f64,
    winding: i32,
    /// What it bounds, and since which height.
    weight: i32,
    since: f64,
    /// x at the top and at the bottom of the strip.
    x: f64,
    next_x: f64,
}

impl Strips {
    /// Adds a cluster of row `y`. Left of it is the winding number `left` at the top of the row,
    /// which changes by the `steps` (height in 1/256 pixel from the top of the row, change) on the way
    /// down.
    #[inline(always)]
    pub(super) fn add<S: Simd>(
        &mut self,
        simd: S,
        polygon: &Polygon,
        y: i32,
        (cluster, left, steps): (&[AreaEdge], i32, &[(i32, i32)]),
        area: &mut AreaRow,
    ) {
        let (row_top, row_bottom) = (f64::from(y), f64::from(y) + 1.0);
        self.start(y, cluster);
        let mut budget = CROSSING_WORK / (cluster.len() + 1);
        let at_left = !steps.is_empty();
        let height = |within: i32| row_top + f64::from(within) / 256.0;
        let mut steps = steps.iter().peekable();
        let mut winding = left;
        let mut top = row_top;
        while top < row_bottom {
            while let Some(step) = steps.next_if(|s| height(s.0) <= top) {
                winding += step.1;
            }
            self.retire_and_admit(simd, top, area);
            let step = steps.peek().map_or(row_bottom, |s| height(s.0));
            let mut bottom = self.next_event(step.min(row_bottom));
            self.order(top, bottom);
            if budget > 0
                && let Some(crossing) = self.first_crossing(top, bottom)
            {
                budget -= 1;
                bottom = crossing;
            }
            if at_left {
                self.set_left(polygon.is_inside(winding), top, area);
            }
            self.weigh(simd, polygon, winding, top, area);
            top = bottom;
        }
        for e in &self.live {
            e.flush(simd, row_bottom, area);
        }
        if at_left {
            self.set_left(false, row_bottom, area);
        }
    }

    /// Which edges bound the inside, from `top` on.
    #[inline(always)]
    fn weigh<S: Simd>(
        &mut self,
        simd: S,
        polygon: &Polygon,
        left: i32,
        top: f64,
        area: &mut AreaRow,
    ) {
        let mut winding = left;
        let mut inside = polygon.is_inside(winding);
        for edge in &mut self.live {
            winding += edge.winding;
            let now = polygon.is_inside(winding);
            edge.set_weight(simd, i32::from(now) - i32::from(inside), top, area);
            inside = now;
        }
    }

    fn start(&mut self, y: i32, cluster: &[AreaEdge]) {
        self.live.clear();
        self.waiting.clear();
        self.left_inside = false;
        self.waiting.extend(cluster.iter().filter_map(|e| Live::new(e, y)));
        sort(&mut self.waiting, |a, b| b.start.total_cmp(&a.start));
    }

    /// Drops the edges that end at `top` and takes in those that begin there.
    #[inline(always)]
    fn retire_and_admit<S: Simd>(&mut self, simd: S, top: f64, area: &mut AreaRow) {
        // Not by a closure, which would not be compiled for the instruction set.
        let mut kept = 0;
        for i in 0..self.live.len() {
            let edge = self.live[i];
            if edge.end <= top {
                edge.flush(simd, edge.end, area);
            } else {
                self.live[kept] = edge;
                kept += 1;
            }
        }
        self.live.truncate(kept);
        while let Some(edge) = self.waiting.pop_if(|e| e.start <= top) {
            self.live.push(edge);
        }
    }

    /// The next height at which an edge begins or ends, at most `limit`.
    fn next_event(&self, limit: f64) -> f64 {
        let begin = self.waiting.last().map_or(limit, |e| e.start);
        self.live.iter().fold(limit.min(begin), |y, e| y.min(e.end))
    }

    /// Sorts the edges from left to right at `top`, those that meet there as they go on.
    fn order(&mut self, top: f64, bottom: f64) {
        for e in &mut self.live {
            e.x = e.slope.at(top);
            e.next_x = e.slope.at(bottom);
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

    fn set_left(&mut self, inside: bool, y: f64, area: &mut AreaRow) {
        if inside != self.left_inside {
            if self.left_inside {
                // A multiple of 2⁻²⁴: exact.
                area.add_left(y - self.left_since);
            }
            self.left_inside = inside;
            self.left_since = y;
        }
    }
}

impl Live {
    fn new(edge: &AreaEdge, y: i32) -> Option<Self> {
        let (start, end) = edge.heights(y);
        (start < end).then_some(Self {
            slope: edge.slope,
            start,
            end,
            winding: edge.winding,
            weight: 0,
            since: start,
            x: 0.0,
            next_x: 0.0,
        })
    }

    #[inline(always)]
    fn set_weight<S: Simd>(&mut self, simd: S, weight: i32, y: f64, area: &mut AreaRow) {
        if weight != self.weight {
            self.flush(simd, y, area);
            self.weight = weight;
            self.since = y;
        }
    }

    /// What lies right of the edge down to `y`, less what does so down to where the weight began. They
    /// differ by the whole height or not at all, save in the pixels that the edge touches in between.
    #[inline(always)]
    fn flush<S: Simd>(&self, simd: S, y: f64, area: &mut AreaRow) {
        if self.weight == 0 || self.since >= y {
            return;
        }
        let weight = f64::from(self.weight);
        let (above, below) =
            (self.slope.reach(self.start, self.since), self.slope.reach(self.start, y));
        let pixels = area.touched(extent(below.sign, above.to, below.to));
        area.add(simd, &below, pixels, weight);
        if self.since > self.start {
            area.add(simd, &above, pixels, -weight);
        }
    }
}
