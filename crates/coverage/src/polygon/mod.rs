//! Polygons: contours as edges, listed by bands of rows, so that a tile finds its own quickly.

mod area;
mod bands;
mod calm;
mod crowd;
mod eights;
mod gather;
mod rows;
mod samples;
mod simple;
mod steps;
mod strips;
mod sums;

pub(crate) use rows::PolygonScratch;

use crate::edge::Edge;
use crate::triangle::owning_pixels;
use crate::{Cover, FixedPoint};
use alloc::vec::Vec;
use bands::Bands;
use core::ops::Range;
use scumble_geometry::{DVec2, FillRule, IntRect};
use simple::{Chain, unproven_rows};

/// An edge that crosses rows, from the top (y0 < y1).
#[derive(Debug, Clone, Copy, Default)]
struct PolygonEdge {
    x0: i32,
    y0: i32,
    x1: i32,
    y1: i32,
    /// +1 if the contour runs down here, −1 if up.
    winding: i32,
}

impl PolygonEdge {
    fn left(&self) -> i32 {
        self.x0.min(self.x1)
    }

    fn right(&self) -> i32 {
        self.x0.max(self.x1)
    }

    /// The smallest whole x at or right of the edge at height `y`: ⌈x₀ + (y − y₀)·Δx/Δy⌉.
    fn crossing(&self, y: i32) -> i32 {
        let run = i64::from(self.x1) - i64::from(self.x0);
        let rise = i64::from(self.y1) - i64::from(self.y0);
        let numerator = run * (i64::from(y) - i64::from(self.y0));
        let ceil = -(-numerator).div_euclid(rise);
        (i64::from(self.x0) + ceil) as i32
    }
}

/// A level edge from `left` to `right`.
#[derive(Debug, Clone, Copy)]
struct Level {
    y: i32,
    left: i32,
    right: i32,
}

/// Contours as edges, ready to be crossed by rows of samples.
#[derive(Debug, Clone)]
pub(crate) struct Polygon {
    bands: Bands,
    edge_count: usize,
    /// The level edges, by rising y: no row of samples crosses one, but the winding number changes
    /// there.
    levels: Vec<Level>,
    /// The rows in which the outline may cross itself, by rising row.
    unproven: Vec<Range<i32>>,
    bounds: IntRect,
    rule: FillRule,
}

/// Few outlines have more: there is room for as many at once.
const FEW_CHAINS: usize = 16;

/// Collects contours point by point.
#[derive(Debug, Default)]
pub(crate) struct PolygonBuilder {
    contour: Vec<FixedPoint>,
    edges: Vec<PolygonEdge>,
    chains: Vec<Chain>,
    levels: Vec<Level>,
    /// How many contours enclose anything, and the corners of the last one if it has three.
    contours: usize,
    corners: Option<[FixedPoint; 3]>,
}

impl PolygonBuilder {
    pub(crate) fn push(&mut self, p: FixedPoint) {
        if self.contour.last() != Some(&p) {
            self.contour.push(p);
        }
    }

    /// Pushes all points of a contour, if all lie inside the guard band; else none.
    pub(crate) fn push_snapped(&mut self, contour: &[DVec2]) -> bool {
        self.contour.reserve(contour.len());
        self.edges.reserve(contour.len());
        for &p in contour {
            let Some(p) = FixedPoint::snap(p) else {
                self.contour.clear();
                return false;
            };
            self.push(p);
        }
        true
    }

    /// Ends the contour and joins its last point to its first.
    pub(crate) fn close(&mut self) {
        if self.contour.len() > 1 && self.contour.first() == self.contour.last() {
            self.contour.pop();
        }
        // What goes to and fro on one line winds around nothing.
        if !is_flat(&self.contour) {
            self.contours += 1;
            self.corners = self.contour[..].try_into().ok();
            let mut before = 0;
            for (i, &p) in self.contour.iter().enumerate() {
                let q = self.contour[if i + 1 < self.contour.len() { i + 1 } else { 0 }];
                if p.y == q.y {
                    self.levels.push(Level { y: p.y, left: p.x.min(q.x), right: p.x.max(q.x) });
                    continue;
                }
                let (top, bottom, winding) = if p.y < q.y { (p, q, 1) } else { (q, p, -1) };
                let (x0, y0, x1, y1) = (top.x, top.y, bottom.x, bottom.y);
                let place = self.edges.len() as u32;
                match self.chains.last_mut() {
                    Some(chain) if winding == before => chain.last = place,
                    _ => self.chains.push(Chain { first: place, last: place }),
                }
                before = winding;
                self.edges.push(PolygonEdge { x0, y0, x1, y1, winding });
            }
        }
        self.contour.clear();
    }

    /// The corners, if a triangle is all there is.
    pub(crate) fn triangle(&self) -> Option<[FixedPoint; 3]> {
        self.corners.filter(|_| self.contours == 1)
    }

    pub(crate) fn finish(mut self, rule: FillRule) -> Option<Polygon> {
        if self.edges.is_empty() {
            return None;
        }
        self.levels.sort_unstable_by_key(|l| l.y);
        let (mut x0, mut x1) = (i32::MAX, i32::MIN);
        let (mut y0, mut y1) = (i32::MAX, i32::MIN);
        for e in &self.edges {
            (x0, x1) = (x0.min(e.left()), x1.max(e.right()));
            (y0, y1) = (y0.min(e.y0), y1.max(e.y1));
        }
        let bounds = owning_pixels(x0, y0, x1, y1);
        let edge_count = self.edges.len();
        let unproven = unproven_rows(&self.edges, &self.chains);
        let bands = Bands::new(self.edges, bounds);
        Some(Polygon { bands, edge_count, levels: self.levels, unproven, bounds, rule })
    }
}

/// Whether all points lie on one line.
fn is_flat(points: &[FixedPoint]) -> bool {
    let Some((&p, rest)) = points.split_first() else { return true };
    let Some(&q) = rest.iter().find(|&&q| q != p) else { return true };
    let difference =
        |v: FixedPoint| (i64::from(v.x) - i64::from(p.x), i64::from(v.y) - i64::from(p.y));
    let (dx, dy) = difference(q);
    rest.iter().all(|&r| {
        let (ex, ey) = difference(r);
        dx * ey == dy * ex
    })
}

impl Polygon {
    pub(crate) fn builder() -> PolygonBuilder {
        PolygonBuilder { chains: Vec::with_capacity(FEW_CHAINS), ..PolygonBuilder::default() }
    }

    pub(crate) fn bounds(&self) -> IntRect {
        self.bounds
    }

    fn is_inside(&self, winding: i32) -> bool {
        match self.rule {
            FillRule::NonZero => winding != 0,
            FillRule::EvenOdd => winding & 1 != 0,
        }
    }

    /// Whether the winding number is known to be 0 or 1 all over row `y`, or 0 or −1.
    fn is_proven(&self, y: i32) -> bool {
        let at = self.unproven.partition_point(|rows| rows.end <= y);
        self.unproven.get(at).is_none_or(|rows| y < rows.start)
    }

    /// `rect` lies within the bounds and is not empty.
    pub(crate) fn covers(&self, rect: IntRect) -> Cover {
        let (left, right) = (rect.x0 * 256, rect.x1 * 256 - 1);
        let (top, bottom) = (rect.y0 * 256, rect.y1 * 256);
        if self.levels_between(top, bottom).any(|l| l.left <= right && l.right > left) {
            return Cover::Partial;
        }
        let (mut winding, mut crossed) = (0, false);
        self.bands.each_in(top, bottom, |e| {
            if e.left() > right {
                return true;
            }
            let side = if e.right() <= left { Some(Side::Left) } else { side(e, rect) };
            crossed = side.is_none();
            // No edge crosses the rectangle, so the winding number is that of its corner.
            if side == Some(Side::Left) && e.y0 <= top && top < e.y1 {
                winding += e.winding;
            }
            !crossed
        });
        if crossed {
            return Cover::Partial;
        }
        if self.is_inside(winding) { Cover::Full } else { Cover::None }
    }

    /// The level edges strictly between two heights (1/256 pixel).
    fn levels_between(&self, top: i32, bottom: i32) -> impl Iterator<Item = &Level> {
        let first = self.levels.partition_point(|l| l.y <= top);
        self.levels[first..].iter().take_while(move |l| l.y < bottom)
    }

    /// How many edges cross rows.
    pub(crate) fn edge_count(&self) -> usize {
        self.edge_count
    }
}

/// Where an edge lies, seen from the sample positions of a rectangle.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Side {
    Left,
    Right,
}

/// On which side of the rectangle the edge lies, or rather its line; none if it passes between the
/// sample positions.
fn side(e: &PolygonEdge, rect: IntRect) -> Option<Side> {
    let (low, high) =
        Edge::new(FixedPoint { x: e.x0, y: e.y0 }, FixedPoint { x: e.x1, y: e.y1 }).extremes(rect);
    // Downwards, so that what is not negative lies left of the edge.
    if high < 0 {
        Some(Side::Left)
    } else if low >= 0 {
        Some(Side::Right)
    } else {
        None
    }
}
