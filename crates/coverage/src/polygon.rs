//! Polygons: exact crossings of the edges with every row of samples.
//!
//! A row of samples at height Y meets an edge at the real x = x₀ + (Y − y₀)·Δx/Δy; the samples at
//! ⌈x⌉ and beyond have it on their left. Each crossing adds its ±1 to the first such pixel of each
//! sample, the pixels that got anything are marked, and one sweep over the marked pixels sums the
//! winding numbers of all samples side by side. Between marked pixels nothing changes, so whole runs
//! are handed on at once, and nothing is ever sorted along x.

use crate::edge::Edge;
use crate::triangle::owning_pixels;
use crate::{Cover, FixedPoint, SampleMask, SamplePattern, Sink};
use alloc::vec::Vec;
use scumble_geometry::{FillRule, IntRect};

/// Edges under one bounding box of the index. Smaller: fewer edges looked at per tile, more boxes.
const CHUNK: usize = 64;

/// Cells (pixels × samples) of a row's winding buffer: what comfortably stays in the cache.
const ROW_CELLS: i32 = 1 << 16;

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
    /// The level edges, by rising y: no row of samples crosses one, but the winding number changes there.
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

/// Working memory of [`Polygon::rasterize`].
#[derive(Debug, Clone, Default)]
pub(crate) struct PolygonScratch {
    /// The edges that meet the clip's rows and do not lie right of it, by rising y0.
    edges: Vec<PolygonEdge>,
    /// Those that meet the current row of pixels.
    active: Vec<PolygonEdge>,
    row: RowWinding,
}

/// One row of pixels: changes of the winding number.
#[derive(Debug, Clone, Default)]
struct RowWinding {
    /// Per pixel and sample. All zero between rows.
    change: Vec<i32>,
    /// One bit per pixel: whether any of its changes was written.
    marked: Vec<u64>,
    /// Per sample: the winding number at the current pixel.
    winding: Vec<i32>,
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
}

/// Whether the edge passes between the sample positions of the rectangle.
fn crosses(e: &PolygonEdge, rect: IntRect) -> bool {
    let (low, high) =
        Edge::new(FixedPoint { x: e.x0, y: e.y0 }, FixedPoint { x: e.x1, y: e.y1 }).extremes(rect);
    low < 0 && high >= 0
}

/// A part of a polygon narrow enough for the row buffer.
struct Strip<'a> {
    polygon: &'a Polygon,
    rect: IntRect,
    pattern: &'a SamplePattern,
}

impl Strip<'_> {
    fn rasterize(&self, scratch: &mut PolygonScratch, sink: &mut impl Sink) {
        let PolygonScratch { edges, active, row } = scratch;
        let rect = self.rect;
        row.resize((rect.x1 - rect.x0) as usize, self.pattern.len());
        edges.clear();
        active.clear();
        edges.extend(self.polygon.edges_in(rect.y0 * 256, rect.y1 * 256, rect.x1 * 256 - 1));
        let mut next = 0;
        for y in rect.y0..rect.y1 {
            let (top, bottom) = (y * 256, y * 256 + 256);
            active.retain(|e| e.y1 > top);
            while next < edges.len() && edges[next].y0 < bottom {
                if edges[next].y1 > top {
                    active.push(edges[next]);
                }
                next += 1;
            }
            row.winding.fill(0);
            for edge in active.iter() {
                self.add(edge, y, row);
            }
            self.sweep(y, row, sink);
        }
    }

    /// Adds the crossings of one edge with the samples of row `y`.
    fn add(&self, edge: &PolygonEdge, y: i32, row: &mut RowWinding) {
        let samples = self.pattern.len();
        let start = self.rect.x0 * 256;
        for level in self.pattern.rows() {
            let height = y * 256 + i32::from(level.y);
            if height < edge.y0 || height >= edge.y1 {
                continue;
            }
            let x = if edge.right() <= start { start } else { edge.crossing(height) };
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

impl RowWinding {
    fn resize(&mut self, width: usize, samples: usize) {
        // Everything is zero between calls, so only growth needs filling.
        self.change.resize(self.change.len().max(width * samples), 0);
        self.marked.resize(width.div_ceil(64), 0);
        self.winding.clear();
        self.winding.resize(samples, 0);
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
