//! Eight pixels in which edges begin, end or cross each other in an intricate way.
//!
//! The row is cut at the heights where that happens. Inside such a strip the edges have an order
//! from left to right, the winding number follows, and so does which of them bound the inside. An
//! edge is handed to the sums only when that changes.
//!
//! What is looked at are all edges that touch the eight pixels, and the winding number left of them:
//! the same whatever the clip.

use super::Polygon;
use super::crowd;
use super::steps::Steps;
use crate::area::{Slope, eight_right};
use alloc::vec::Vec;
use core::cmp::Ordering;
use fearless_simd::{Simd, f64x8, prelude::*};

/// How often, beyond what edges that do not cross can need, an edge is looked at in a strip before
/// it is held that there are too many crossings to follow. Twice that takes up to twice the time on
/// scribbles, which sampling is quick at.
const PATIENCE: usize = 256;

/// As many edges of plain groups lie side by side at the most: each has a pixel of its own.
const SIDE_BY_SIDE: usize = 8;

/// No more edges than this are a crowd.
const FEW: usize = 16;

/// Two edges have crossed if they are out of order by more than this (in pixels). Less is rounding,
/// and as an area it is far below that of an f32.
const OUT_OF_ORDER: f64 = 1.0 / (1 << 26) as f64;

/// An edge within a row.
#[derive(Debug, Clone, Copy)]
pub(super) struct AreaEdge {
    pub(super) slope: Slope,
    pub(super) winding: i32,
    /// In 1/256 pixel from the top of the row, `from` < `to`.
    pub(super) from: i32,
    pub(super) to: i32,
}

/// Where the eight pixels are, and the winding number left of them and of the edges in them.
#[derive(Debug, Clone, Copy)]
pub(super) struct Place<'a> {
    pub(super) polygon: &'a Polygon,
    pub(super) x: i32,
    pub(super) y: i32,
    pub(super) left: &'a Steps,
}

/// Working memory.
#[derive(Debug, Clone, Default)]
pub(super) struct Strips {
    /// The edges that have not begun, by falling start.
    waiting: Vec<Live>,
    /// Those in the current strip, from left to right.
    live: Vec<Live>,
    /// Whether the left side is inside, and since which height.
    left_inside: bool,
    left_since: f64,
    sums: [f64; 8],
}

/// An edge on its way down.
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
    /// The areas of the eight pixels.
    #[inline(always)]
    pub(super) fn areas<S: Simd>(
        &mut self,
        simd: S,
        place: Place<'_>,
        edges: &[AreaEdge],
    ) -> [f64; 8] {
        let steps = place.left.marks().iter().map(|bits| bits.count_ones() as usize).sum::<usize>();
        let patience = PATIENCE + SIDE_BY_SIDE * (2 * edges.len() + steps + 1);
        // In a crowd one crossing is taken for many.
        let crowded = edges.len() > FEW && is_crowded(edges, place.left);
        match self.follow(simd, place, edges, (patience, crowded)) {
            Some(()) => self.sums,
            None => crowd::areas(place, edges),
        }
    }

    /// Sums strip by strip; gives up when it has lost patience, or at the first crossing in a crowd.
    #[inline(always)]
    fn follow<S: Simd>(
        &mut self,
        simd: S,
        place: Place<'_>,
        edges: &[AreaEdge],
        (mut patience, crowded): (usize, bool),
    ) -> Option<()> {
        let (row_top, row_bottom) = (f64::from(place.y), f64::from(place.y) + 1.0);
        self.start(place.y, edges);
        let height = |within: i32| row_top + f64::from(within) * (1.0 / 256.0);
        let mut steps = place.left.iter().peekable();
        let mut winding = place.left.top;
        let mut top = row_top;
        while top < row_bottom {
            while let Some(step) = steps.next_if(|s| height(s.0) <= top) {
                winding += step.1;
            }
            self.retire_and_admit(simd, top, place.x);
            let step = steps.peek().map_or(row_bottom, |s| height(s.0));
            let mut bottom = self.next_event(step.min(row_bottom));
            self.order(top, bottom);
            if let Some(crossing) = self.first_crossing(top, bottom) {
                if crowded {
                    return None;
                }
                bottom = crossing;
            }
            self.set_left(place.polygon.is_inside(winding), top);
            self.weigh(simd, place, winding, top);
            top = bottom;
            patience = patience.checked_sub(self.live.len())?;
        }
        for i in 0..self.live.len() {
            let edge = self.live[i];
            edge.flush(simd, row_bottom, place.x, &mut self.sums);
        }
        self.set_left(false, row_bottom);
        Some(())
    }

    /// Which edges bound the inside, from `top` on.
    #[inline(always)]
    fn weigh<S: Simd>(&mut self, simd: S, place: Place<'_>, left: i32, top: f64) {
        let mut winding = left;
        let mut inside = place.polygon.is_inside(winding);
        for edge in &mut self.live {
            winding += edge.winding;
            let now = place.polygon.is_inside(winding);
            let weight = i32::from(now) - i32::from(inside);
            if weight != edge.weight {
                edge.flush(simd, top, place.x, &mut self.sums);
                (edge.weight, edge.since) = (weight, top);
            }
            inside = now;
        }
    }

    #[inline(always)]
    fn start(&mut self, y: i32, edges: &[AreaEdge]) {
        self.live.clear();
        self.waiting.clear();
        self.left_inside = false;
        self.sums = [0.0; 8];
        for edge in edges {
            self.waiting.push(Live::new(edge, y));
        }
        sort(&mut self.waiting, |a, b| b.start.total_cmp(&a.start));
    }

    /// Drops the edges that end at `top` and takes in those that begin there.
    #[inline(always)]
    fn retire_and_admit<S: Simd>(&mut self, simd: S, top: f64, x: i32) {
        // Not by a closure, which would not be compiled for the instruction set.
        let mut kept = 0;
        for i in 0..self.live.len() {
            let edge = self.live[i];
            if edge.end <= top {
                edge.flush(simd, edge.end, x, &mut self.sums);
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
    #[inline(always)]
    fn next_event(&self, limit: f64) -> f64 {
        let begin = self.waiting.last().map_or(limit, |e| e.start);
        self.live.iter().fold(limit.min(begin), |y, e| y.min(e.end))
    }

    /// Sorts the edges from left to right at `top`, those that meet there as they go on.
    #[inline(always)]
    fn order(&mut self, top: f64, bottom: f64) {
        for e in &mut self.live {
            e.x = e.slope.at(top);
            e.next_x = e.slope.at(bottom);
        }
        sort(&mut self.live, |a, b| a.x.total_cmp(&b.x).then(a.next_x.total_cmp(&b.next_x)));
    }

    /// The first height strictly inside the strip at which two neighbours have met.
    #[inline(always)]
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

    #[inline(always)]
    fn set_left(&mut self, inside: bool, y: f64) {
        if inside != self.left_inside {
            if self.left_inside {
                // A multiple of 2⁻²⁴: exact.
                let height = y - self.left_since;
                self.sums.iter_mut().for_each(|sum| *sum += height);
            }
            self.left_inside = inside;
            self.left_since = y;
        }
    }
}

impl Live {
    #[inline(always)]
    fn new(edge: &AreaEdge, y: i32) -> Self {
        let height = |within: i32| f64::from(y) + f64::from(within) * (1.0 / 256.0);
        let (start, end) = (height(edge.from), height(edge.to));
        Self {
            slope: edge.slope,
            start,
            end,
            winding: edge.winding,
            weight: 0,
            since: start,
            x: 0.0,
            next_x: 0.0,
        }
    }

    /// What lies right of the edge down to `y`, less what does so down to where the weight began. They
    /// differ by the whole height or not at all, save in the pixels that the edge touches in between.
    #[inline(always)]
    fn flush<S: Simd>(&self, simd: S, y: f64, x: i32, sums: &mut [f64; 8]) {
        if self.weight == 0 || self.since >= y {
            return;
        }
        let weight = f64::from(self.weight);
        let below = self.slope.reach(self.start, y);
        let mut sum = f64x8::from_slice(simd, &*sums) + eight_right(simd, x, &below, weight);
        if self.since > self.start {
            let above = self.slope.reach(self.start, self.since);
            sum += eight_right(simd, x, &above, -weight);
        }
        sum.store_slice(sums);
    }
}

/// Whether more edges than [`SIDE_BY_SIDE`] are beside each other at most heights where anything
/// happens.
fn is_crowded(edges: &[AreaEdge], left: &Steps) -> bool {
    let mut events = left.marks();
    for height in edges.iter().flat_map(|e| [e.from, e.to]).filter(|&h| h < 256) {
        events[height as usize / 64] |= 1 << (height % 64);
    }
    // How many events there are above a height.
    let above = |height: i32| {
        let (word, bits) = (height as usize / 64, height % 64);
        let whole: u32 = events[..word].iter().map(|bits| bits.count_ones()).sum();
        whole + events.get(word).map_or(0, |w| (w & ((1 << bits) - 1)).count_ones())
    };
    let beside: u32 = edges.iter().map(|e| above(e.to) - above(e.from)).sum();
    beside as usize > SIDE_BY_SIDE * above(256) as usize
}

/// Sorts what is nearly sorted.
#[inline(always)]
pub(super) fn sort<T: Copy>(values: &mut [T], order: impl Fn(&T, &T) -> Ordering) {
    // Few, or hardly any out of place: insertion. Otherwise not.
    if values.len() > 32 {
        if !values.is_sorted_by(|a, b| order(a, b).is_le()) {
            values.sort_unstable_by(order);
        }
        return;
    }
    for i in 1..values.len() {
        let value = values[i];
        let mut j = i;
        while j > 0 && order(&values[j - 1], &value).is_gt() {
            values[j] = values[j - 1];
            j -= 1;
        }
        values[j] = value;
    }
}
