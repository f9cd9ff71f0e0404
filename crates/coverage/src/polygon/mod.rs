//! Polygons: contours as edges, sorted by height and boxed, so that a tile finds its own quickly.

mod area;
mod rows;
mod samples;
mod strips;

pub(crate) use rows::PolygonScratch;

use crate::edge::Edge;
use crate::triangle::owning_pixels;
use crate::{Cover, FixedPoint};
use alloc::vec::Vec;
use scumble_geometry::{FillRule, IntRect};

/// Edges under one bounding box of the index. Smaller: fewer edges looked at per tile, more boxes.
const CHUNK: usize = 64;

/// An edge that crosses rows, from the top (y0 < y1).
#[derive(Debug, Clone, Copy)]
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

/// The box of [`CHUNK`] edges that follow each other.
#[derive(Debug, Clone, Copy)]
struct Chunk {
    left: i32,
    top: i32,
    bottom: i32,
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
    /// By rising y0.
    edges: Vec<PolygonEdge>,
    chunks: Vec<Chunk>,
    /// The level edges, by rising y: no row of samples crosses one, but the winding number changes
    /// there.
    levels: Vec<Level>,
    bounds: IntRect,
    rule: FillRule,
}

/// Collects contours point by point.
#[derive(Debug, Default)]
pub(crate) struct PolygonBuilder {
    contour: Vec<FixedPoint>,
    edges: Vec<PolygonEdge>,
    levels: Vec<Level>,
}

impl PolygonBuilder {
    pub(crate) fn push(&mut self, p: FixedPoint) {
        if self.contour.last() != Some(&p) {
            self.contour.push(p);
        }
    }

    /// Ends the contour and joins its last point to its first.
    pub(crate) fn close(&mut self) {
        // What goes to and fro on one line winds around nothing.
        if !is_flat(&self.contour) {
            for (i, &p) in self.contour.iter().enumerate() {
                let q = self.contour[if i + 1 < self.contour.len() { i + 1 } else { 0 }];
                if p.y == q.y {
                    self.levels.push(Level { y: p.y, left: p.x.min(q.x), right: p.x.max(q.x) });
                    continue;
                }
                let (top, bottom, winding) = if p.y < q.y { (p, q, 1) } else { (q, p, -1) };
                let (x0, y0, x1, y1) = (top.x, top.y, bottom.x, bottom.y);
                self.edges.push(PolygonEdge { x0, y0, x1, y1, winding });
            }
        }
        self.contour.clear();
    }

    pub(crate) fn finish(mut self, rule: FillRule) -> Option<Polygon> {
        self.edges.sort_by_key(|e| (e.y0, e.x0));
        self.levels.sort_by_key(|l| l.y);
        let (mut x0, mut x1) = (i32::MAX, i32::MIN);
        let (mut y0, mut y1) = (i32::MAX, i32::MIN);
        for e in &self.edges {
            (x0, x1) = (x0.min(e.left()), x1.max(e.right()));
            (y0, y1) = (y0.min(e.y0), y1.max(e.y1));
        }
        if self.edges.is_empty() {
            return None;
        }
        let chunk = |edges: &[PolygonEdge]| Chunk {
            left: edges.iter().map(PolygonEdge::left).min().unwrap_or(0),
            top: edges[0].y0,
            bottom: edges.iter().map(|e| e.y1).max().unwrap_or(0),
        };
        let chunks = self.edges.chunks(CHUNK).map(chunk).collect();
        let bounds = owning_pixels(x0, y0, x1, y1);
        Some(Polygon { edges: self.edges, chunks, levels: self.levels, bounds, rule })
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
        PolygonBuilder::default()
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

    /// The edges that meet rows `top..bottom` (1/256 pixel) and do not lie wholly beyond `right`.
    fn edges_in(&self, top: i32, bottom: i32, right: i32) -> impl Iterator<Item = &PolygonEdge> {
        self.chunks
            .iter()
            .zip(self.edges.chunks(CHUNK))
            .take_while(move |(c, _)| c.top < bottom)
            .filter(move |(c, _)| c.bottom > top && c.left <= right)
            .flat_map(|(_, edges)| edges)
            .filter(move |e| e.y0 < bottom && e.y1 > top && e.left() <= right)
    }

    /// `rect` lies within the bounds and is not empty.
    pub(crate) fn covers(&self, rect: IntRect) -> Cover {
        let (left, right) = (rect.x0 * 256, rect.x1 * 256 - 1);
        let (top, bottom) = (rect.y0 * 256, rect.y1 * 256);
        let first = self.levels.partition_point(|l| l.y <= top);
        let mut levels = self.levels[first..].iter().take_while(|l| l.y < bottom);
        if levels.any(|l| l.left <= right && l.right > left) {
            return Cover::Partial;
        }
        let mut winding = 0;
        for e in self.edges_in(top, bottom, right) {
            if e.right() > left && crosses(e, rect) {
                return Cover::Partial;
            }
            // No edge crosses the rectangle, so the winding number is that of its corner.
            if e.y0 <= top && top < e.y1 && e.crossing(top) <= left {
                winding += e.winding;
            }
        }
        if self.is_inside(winding) { Cover::Full } else { Cover::None }
    }
}

/// Whether the edge passes between the sample positions of the rectangle.
fn crosses(e: &PolygonEdge, rect: IntRect) -> bool {
    let (low, high) =
        Edge::new(FixedPoint { x: e.x0, y: e.y0 }, FixedPoint { x: e.x1, y: e.y1 }).extremes(rect);
    low < 0 && high >= 0
}
