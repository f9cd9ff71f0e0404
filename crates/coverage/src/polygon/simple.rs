//! Rows of pixels in which an outline does not cross itself, proved once for all of it.
//!
//! Where the winding number is 0 or 1 all over a row of pixels, or 0 or −1, its mean over a pixel tells
//! the area by either fill rule, however many edges the pixel has. To prove that, the outline is taken
//! apart into chains, each of which runs down or up all along. Between two heights at which a chain
//! begins or ends the same chains lie beside each other; if each keeps left of the next, none cross,
//! and the winding number between two of them follows from their directions.
//!
//! Comparisons are exact, in whole numbers. The sums that tell where to look are not; but a row of
//! which the proof fails is merely drawn with more care.

use super::PolygonEdge;
use super::strips::sort;
use alloc::vec::Vec;
use core::cmp::{Ordering, Reverse};
use core::ops::Range;

/// Edges of one contour that follow each other and run the same way, up or down.
#[derive(Debug, Clone, Copy)]
pub(super) struct Chain {
    /// Their places, in the order of the contour.
    pub(super) first: u32,
    pub(super) last: u32,
}

/// How often an edge may be looked at, in the mean, before the proof is given up: outlines that people
/// draw take about four looks.
const PATIENCE: usize = 16;

/// Small outlines may have this many looks more.
const SLACK: usize = 256;

/// Chains beside each other for which there is room at once.
const ROOM: usize = 32;

/// A chain on its way down.
#[derive(Debug, Clone, Copy)]
struct Walk {
    /// The edge that meets the current height.
    at: u32,
    winding: i32,
    top: i32,
    bottom: i32,
    /// Where the edge is at the current height, and how it goes on.
    x: f64,
    run: f64,
}

impl Walk {
    fn new(edges: &[PolygonEdge], chain: Chain) -> Self {
        let winding = edges[chain.first as usize].winding;
        let (at, last) =
            if winding > 0 { (chain.first, chain.last) } else { (chain.last, chain.first) };
        let (top, bottom) = (edges[at as usize].y0, edges[last as usize].y1);
        let mut walk = Self { at, winding, top, bottom, x: 0.0, run: 0.0 };
        walk.aim(edges);
        walk
    }

    /// Looks along the current edge.
    fn aim(&mut self, edges: &[PolygonEdge]) {
        let e = &edges[self.at as usize];
        self.run = (f64::from(e.x1) - f64::from(e.x0)) / (f64::from(e.y1) - f64::from(e.y0));
    }

    /// The edge below `at`.
    #[inline(always)]
    fn below(&self, at: u32) -> u32 {
        at.wrapping_add_signed(self.winding)
    }

    /// Goes on to the edge that meets what lies right below `y`; `false` if there is none.
    #[inline(always)]
    fn advance(&mut self, edges: &[PolygonEdge], y: i32) -> bool {
        if self.bottom <= y {
            return false;
        }
        if edges[self.at as usize].y1 <= y {
            while edges[self.at as usize].y1 <= y {
                self.at = self.below(self.at);
            }
            self.aim(edges);
        }
        let e = &edges[self.at as usize];
        self.x = f64::from(e.x0) + (f64::from(y) - f64::from(e.y0)) * self.run;
        true
    }

    /// From left to right, those that meet as they go on.
    fn order(&self, other: &Self) -> Ordering {
        self.x.total_cmp(&other.x).then(self.run.total_cmp(&other.run))
    }
}

/// The rows of which it is not known that the winding number is 0 or 1 all over them, or 0 or −1; by
/// rising row, apart from each other. `edges` lie in the order of contours.
pub(super) fn unproven_rows(edges: &[PolygonEdge], chains: &[Chain]) -> Vec<Range<i32>> {
    let mut unproven = Vec::new();
    let mut waiting: Vec<Walk> = chains.iter().map(|&chain| Walk::new(edges, chain)).collect();
    waiting.sort_unstable_by_key(|walk| Reverse(walk.top));
    let mut live: Vec<Walk> = Vec::with_capacity(chains.len().min(ROOM));
    let mut patience = PATIENCE * edges.len() + SLACK;
    let mut y = i32::MIN;
    // The row in which the last strip ends, and the winding number there.
    let mut before = (i32::MIN, 0);
    loop {
        live.retain_mut(|walk| walk.advance(edges, y));
        if live.is_empty() {
            let Some(walk) = waiting.last() else { return unproven };
            y = walk.top;
        }
        while let Some(mut walk) = waiting.pop_if(|walk| walk.top <= y) {
            walk.advance(edges, y);
            live.push(walk);
        }
        sort(&mut live, Walk::order);
        let begins = waiting.last().map_or(i32::MAX, |walk| walk.top);
        let next = live.iter().fold(begins, |y, walk| y.min(walk.bottom));
        patience = patience.saturating_sub(live.len());
        let mut strip = Strip { edges, y, next, patience, proven: true, sign: 0 };
        strip.look(&live);
        patience = strip.patience;
        if patience == 0 {
            let bottom = edges.iter().fold(y, |y, e| y.max(e.y1));
            push(&mut unproven, y, bottom);
            return unproven;
        }
        if !strip.proven {
            push(&mut unproven, y, strip.next);
        }
        if strip.sign != 0 {
            // Where 1 and −1 meet in a row, they cancel in the mean.
            if (y >> 8, -strip.sign) == before {
                push(&mut unproven, y, y + 1);
            }
            before = ((strip.next - 1) >> 8, strip.sign);
        }
        y = strip.next;
    }
}

/// Adds the rows that the heights `top..bottom` meet.
fn push(rows: &mut Vec<Range<i32>>, top: i32, bottom: i32) {
    let (from, end) = (top >> 8, ((bottom - 1) >> 8) + 1);
    match rows.last_mut() {
        Some(last) if from <= last.end => last.end = last.end.max(end),
        _ => rows.push(from..end),
    }
}

/// The heights from `y` to `next`, between which no chain begins or ends.
struct Strip<'a> {
    edges: &'a [PolygonEdge],
    y: i32,
    next: i32,
    patience: usize,
    proven: bool,
    /// The winding number where it is not 0, if it is proven; 0 if it is 0 all over.
    sign: i32,
}

impl Strip<'_> {
    /// Looks whether chains, sorted at the top, keep their order and wind by one at the most. Where
    /// two do not keep it, the strip ends.
    fn look(&mut self, live: &[Walk]) {
        let (mut winding, mut least, mut most) = (0, 0, 0);
        for walk in live {
            winding += walk.winding;
            least = winding.min(least);
            most = winding.max(most);
        }
        self.proven = most - least <= 1;
        self.sign = least + most;
        for pair in live.windows(2) {
            if let Some((from, to)) = self.meet(&pair[0], &pair[1]) {
                if from > self.y {
                    self.next = self.next.min(from);
                } else {
                    self.next = self.next.min(to);
                    self.proven = false;
                }
            }
        }
    }

    /// The heights between which the left of two chains first may not be left of the other.
    #[inline(always)]
    fn meet(&mut self, left: &Walk, right: &Walk) -> Option<(i32, i32)> {
        let (mut at, mut other) = (left.at, right.at);
        while self.patience > 0 {
            self.patience -= 1;
            let (a, b) = (&self.edges[at as usize], &self.edges[other as usize]);
            let bottom = a.y1.min(b.y1);
            if a.right() > b.left() && !keeps_left(a, b) {
                return Some((a.y0.max(b.y0), bottom));
            }
            if bottom >= self.next {
                break;
            }
            if a.y1 == bottom {
                at = left.below(at);
            }
            if b.y1 == bottom {
                other = right.below(other);
            }
        }
        None
    }
}

/// Whether `a` is nowhere right of `b`, at the heights that both meet.
#[inline(always)]
fn keeps_left(a: &PolygonEdge, b: &PolygonEdge) -> bool {
    let top = if a.y0 >= b.y0 { side(b, a.x0, a.y0) <= 0 } else { side(a, b.x0, b.y0) >= 0 };
    top && if a.y1 <= b.y1 { side(b, a.x1, a.y1) <= 0 } else { side(a, b.x1, b.y1) >= 0 }
}

/// Positive right of an edge, negative left of it.
#[inline(always)]
fn side(e: &PolygonEdge, x: i32, y: i32) -> i64 {
    let [x, y, x0, y0, x1, y1] = [x, y, e.x0, e.y0, e.x1, e.y1].map(i64::from);
    (x - x0) * (y1 - y0) - (y - y0) * (x1 - x0)
}

#[cfg(test)]
mod tests {
    use crate::FixedPoint;
    use crate::polygon::{Polygon, PolygonBuilder};
    use alloc::vec::Vec;
    use proptest::prelude::*;
    use scumble_geometry::FillRule;

    /// From where to where rows are not proven.
    fn rows(builder: PolygonBuilder) -> Vec<[i32; 2]> {
        let polygon = builder.finish(FillRule::NonZero).unwrap();
        polygon.unproven.iter().map(|rows| [rows.start, rows.end]).collect()
    }

    /// The same of contours in pixels.
    fn unproven(contours: &[&[[i32; 2]]]) -> Vec<[i32; 2]> {
        let mut builder = Polygon::builder();
        for contour in contours {
            for [x, y] in *contour {
                builder.push(FixedPoint { x: x * 256, y: y * 256 });
            }
            builder.close();
        }
        rows(builder)
    }

    const SQUARE: [[i32; 2]; 4] = [[0, 0], [90, 0], [90, 90], [0, 90]];
    const HOLE: [[i32; 2]; 4] = [[30, 30], [30, 60], [60, 60], [60, 30]];

    #[test]
    fn what_does_not_cross_itself_is_proven() {
        assert!(unproven(&[&SQUARE]).is_empty());
        assert!(unproven(&[&SQUARE, &HOLE]).is_empty());
        // A step in a side, and one that only touches the other side.
        assert!(unproven(&[&[[0, 0], [9, 0], [9, 4], [7, 4], [7, 9], [0, 9]]]).is_empty());
        assert!(unproven(&[&[[0, 0], [9, 0], [0, 5], [9, 9], [0, 9]]]).is_empty());
    }

    #[test]
    fn what_winds_twice_is_not() {
        let turned: Vec<[i32; 2]> = HOLE.iter().rev().copied().collect();
        assert_eq!(unproven(&[&SQUARE, &turned]), [[30, 60]]);
    }

    #[test]
    fn rows_around_a_crossing_are_not() {
        // Two triangles that wind in opposite directions, from one vertex to the next.
        let crossed = unproven(&[&[[0, 0], [90, 0], [0, 90], [90, 90]]]);
        assert_eq!(crossed, [[0, 90]]);
        let sides = [[0, 0], [90, 0], [90, 40], [40, 50], [40, 90], [50, 90], [50, 50], [0, 40]];
        assert_eq!(unproven(&[&sides]), [[40, 50]]);
    }

    #[test]
    fn opposite_directions_in_one_row_are_not() {
        // One above the other, in the same row of pixels.
        let mut builder = Polygon::builder();
        for (top, winding) in [(0, 1), (100, -1)] {
            let mut push = |x, y| builder.push(FixedPoint { x, y });
            push(0, top);
            push(9000, top + 40 * (1 - winding));
            push(9000, top + 40 * (1 + winding));
            builder.close();
        }
        assert_eq!(rows(builder), [[0, 1]]);
    }

    #[test]
    fn a_scribble_is_given_up() {
        let corner = |i: i32| [i * 7919 % 1000, i * 104_729 % 1009];
        let scribble: Vec<[i32; 2]> = (0..3000).map(corner).collect();
        let rows = unproven(&[&scribble]);
        assert!(rows.last().is_some_and(|rows| rows[1] > 1000), "{rows:?}");
    }

    /// Corners around a point, by rising angle: a contour that does not cross itself.
    fn star(radii: &[f64]) -> PolygonBuilder {
        let mut builder = Polygon::builder();
        for (i, r) in radii.iter().enumerate() {
            let (sin, cos) = (i as f64 * core::f64::consts::TAU / radii.len() as f64).sin_cos();
            builder.push(FixedPoint { x: (r * cos) as i32, y: (r * sin) as i32 });
        }
        builder.close();
        builder
    }

    proptest! {
        #[test]
        fn stars_are_proven(radii in prop::collection::vec(20_000.0..90_000.0f64, 3..80)) {
            prop_assert!(rows(star(&radii)).is_empty());
        }
    }
}
