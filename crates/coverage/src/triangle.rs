//! Triangles: edge functions over blocks of 8 × 8 pixels.
//!
//! The blocks of one band of eight rows that a triangle touches lie side by side, and so do those that
//! it fills. Both ranges come from a division per edge, so the middle is handed on as
//! one rectangle and only the blocks on an edge are looked into.

use crate::edge::Edge;
use crate::{Cover, FixedPoint, SampleMask, SamplePattern, Sink};
use scumble_geometry::{DVec2, IntRect};

/// Pixels along the side of a block.
const BLOCK: i32 = 8;

/// Beyond this |Δx| + |Δy| (in 1/256 pixel) an edge needs 64 bits inside a block.
const NARROW: i64 = 7 << 16;

/// A triangle with area, snapped, clockwise to the eye.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Triangle {
    corners: [FixedPoint; 3],
}

/// Per-call tables of a triangle: E at each sample relative to its pixel's corner.
#[derive(Debug, Clone)]
pub(crate) struct TriangleScratch {
    narrow: Offsets<i32>,
    wide: Offsets<i64>,
}

impl Default for TriangleScratch {
    fn default() -> Self {
        Self { narrow: Offsets::zero(), wide: Offsets::zero() }
    }
}

#[derive(Debug, Clone)]
struct Offsets<T> {
    /// Per edge and sample.
    sample: [[T; 64]; 3],
    /// Per edge: the smallest and the largest of them.
    low: [T; 3],
    high: [T; 3],
}

impl<T: Lane> Offsets<T> {
    fn zero() -> Self {
        Self {
            sample: [[T::from_i64(0); 64]; 3],
            low: [T::from_i64(0); 3],
            high: [T::from_i64(0); 3],
        }
    }

    fn fill(&mut self, edges: &[Edge; 3], pattern: &SamplePattern) {
        for (k, e) in edges.iter().enumerate() {
            let (a, b) = (T::from_i64(e.a), T::from_i64(e.b));
            let mut low = T::from_i64(i64::MAX);
            let mut high = T::from_i64(i64::MIN);
            for (out, o) in self.sample[k].iter_mut().zip(pattern.offsets()) {
                let v = a.by_u8(o[0]).plus(b.by_u8(o[1]));
                low = low.min(v);
                high = high.max(v);
                *out = v;
            }
            self.low[k] = low;
            self.high[k] = high;
        }
    }
}

/// The number type of edge values inside one block.
trait Lane: Copy + Ord {
    /// Clamped to what keeps the sign through the sums inside a block.
    fn from_i64(v: i64) -> Self;
    fn by_u8(self, v: u8) -> Self;
    fn plus(self, other: Self) -> Self;
    fn or(self, other: Self) -> Self;
    fn is_inside(self) -> bool;
}

impl Lane for i32 {
    // Inside a block and a pixel beyond it E varies by at most NARROW × 2304 < 2³⁰ − 1: a value
    // beyond that keeps its sign, so does the clamped one, and no sum overflows.
    fn from_i64(v: i64) -> Self {
        const LIMIT: i64 = (1 << 30) - 1;
        v.clamp(-LIMIT, LIMIT) as i32
    }
    fn by_u8(self, v: u8) -> Self {
        self * Self::from(v)
    }
    fn plus(self, other: Self) -> Self {
        self + other
    }
    fn or(self, other: Self) -> Self {
        self | other
    }
    fn is_inside(self) -> bool {
        self >= 0
    }
}

impl Lane for i64 {
    fn from_i64(v: i64) -> Self {
        v
    }
    fn by_u8(self, v: u8) -> Self {
        self * Self::from(v)
    }
    fn plus(self, other: Self) -> Self {
        self + other
    }
    fn or(self, other: Self) -> Self {
        self | other
    }
    fn is_inside(self) -> bool {
        self >= 0
    }
}

impl Triangle {
    /// The corners on the grid, if all lie inside the guard band.
    pub(crate) fn snap(p: [DVec2; 3]) -> Option<[FixedPoint; 3]> {
        Some([FixedPoint::snap(p[0])?, FixedPoint::snap(p[1])?, FixedPoint::snap(p[2])?])
    }

    /// Turns the corners clockwise; `None` without area.
    pub(crate) fn new([p, q, r]: [FixedPoint; 3]) -> Option<Self> {
        let (px, py) = (i64::from(p.x), i64::from(p.y));
        let twice_area = (i64::from(q.x) - px) * (i64::from(r.y) - py)
            - (i64::from(q.y) - py) * (i64::from(r.x) - px);
        match twice_area {
            0 => None,
            1.. => Some(Self { corners: [p, q, r] }),
            _ => Some(Self { corners: [p, r, q] }),
        }
    }

    pub(crate) fn corners(&self) -> [FixedPoint; 3] {
        self.corners
    }

    pub(crate) fn edges(&self) -> [Edge; 3] {
        let [p, q, r] = self.corners;
        [Edge::new(p, q), Edge::new(q, r), Edge::new(r, p)]
    }

    pub(crate) fn bounds(&self) -> IntRect {
        let [p, q, r] = self.corners;
        let (x0, x1) = (p.x.min(q.x).min(r.x), p.x.max(q.x).max(r.x));
        let (y0, y1) = (p.y.min(q.y).min(r.y), p.y.max(q.y).max(r.y));
        owning_pixels(x0, y0, x1, y1)
    }

    /// `rect` lies within the bounds and is not empty.
    pub(crate) fn covers(&self, rect: IntRect) -> Cover {
        let mut full = true;
        for edge in self.edges() {
            let (low, high) = edge.extremes(rect);
            if high < 0 {
                return Cover::None;
            }
            full &= low >= 0;
        }
        if full { Cover::Full } else { Cover::Partial }
    }

    /// `region` lies within the bounds and is not empty.
    pub(crate) fn rasterize(
        &self,
        region: IntRect,
        pattern: &SamplePattern,
        scratch: &mut TriangleScratch,
        sink: &mut impl Sink,
    ) {
        let edges = self.edges();
        if edges.iter().all(|e| e.a.abs() + e.b.abs() <= NARROW) {
            Walk::new(&edges, pattern, &mut scratch.narrow).walk(region, sink);
        } else {
            Walk::new(&edges, pattern, &mut scratch.wide).walk(region, sink);
        }
    }
}

/// The pixels that can own a sample of a shape that spans the given coordinates. The right and
/// bottom borders are not owned.
pub(crate) fn owning_pixels(x0: i32, y0: i32, x1: i32, y1: i32) -> IntRect {
    IntRect::new(x0 >> 8, y0 >> 8, ((x1 - 1) >> 8) + 1, ((y1 - 1) >> 8) + 1)
}

/// One triangle and one pattern, ready to be walked.
struct Walk<'a, T> {
    edges: &'a [Edge; 3],
    offsets: &'a Offsets<T>,
    samples: usize,
    /// E one pixel to the right, and one pixel down.
    step_x: [T; 3],
    step_y: [T; 3],
}

impl<'a, T: Lane> Walk<'a, T> {
    fn new(edges: &'a [Edge; 3], pattern: &SamplePattern, offsets: &'a mut Offsets<T>) -> Self {
        offsets.fill(edges, pattern);
        Self {
            edges,
            offsets,
            samples: pattern.len(),
            step_x: edges.map(|e| T::from_i64(e.a * 256)),
            step_y: edges.map(|e| T::from_i64(e.b * 256)),
        }
    }

    fn walk(&self, region: IntRect, sink: &mut impl Sink) {
        if region.x1 - region.x0 <= BLOCK && region.y1 - region.y0 <= BLOCK {
            self.block(region, sink);
            return;
        }
        let mut y = region.y0;
        while y < region.y1 {
            let end = ((y & !(BLOCK - 1)) + BLOCK).min(region.y1);
            self.band(IntRect { y0: y, y1: end, ..region }, sink);
            y = end;
        }
    }

    /// At most eight rows, within one row of blocks.
    fn band(&self, rows: IntRect, sink: &mut impl Sink) {
        let Some([outer, inner]) = self.ranges(rows) else { return };
        let columns =
            |x0: i32, x1: i32| IntRect { x0: x0.max(rows.x0), x1: x1.min(rows.x1), ..rows };
        let (left, right) = if inner.0 < inner.1 { (inner.0, inner.1) } else { (outer.1, outer.1) };
        let mut x = outer.0;
        while x < outer.1 {
            if x == left && left < right {
                sink.block(columns(left, right));
                x = right;
                continue;
            }
            self.block(columns(x, x + BLOCK), sink);
            x += BLOCK;
        }
    }

    /// The columns (multiples of [`BLOCK`], half-open) of the blocks that the edges do not reject,
    /// and of those that all of them accept.
    fn ranges(&self, rows: IntRect) -> Option<[(i32, i32); 2]> {
        let lowest = rows.x0 & !(BLOCK - 1);
        let highest = ((rows.x1 - 1) & !(BLOCK - 1)) + BLOCK;
        let (mut outer, mut inner) = ((lowest, highest), (lowest, highest));
        for e in self.edges {
            let (top, bottom) =
                (e.b * (i64::from(rows.y0) << 8), e.b * ((i64::from(rows.y1) << 8) - 1));
            let (low, high) = (e.c + top.min(bottom), e.c + top.max(bottom));
            // Block indices, before they are held to the region.
            let column = |block: i64| {
                block.clamp(i64::from(lowest >> 3), i64::from(highest >> 3)) as i32 * BLOCK
            };
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
        let inner = (inner.0.max(outer.0), inner.1.min(outer.1));
        Some([outer, inner])
    }

    /// Looks into at most 8 × 8 pixels.
    fn block(&self, rect: IntRect, sink: &mut impl Sink) {
        let (x, y) = (i64::from(rect.x0) << 8, i64::from(rect.y0) << 8);
        let mut row = self.edges.map(|e| T::from_i64(e.at(x, y)));
        let width = rect.x1 - rect.x0;
        let columns = (1u32 << width) - 1;
        for y in rect.y0..rect.y1 {
            let full = self.row_bits(&row, &self.offsets.low) & columns;
            if self.samples > 1 {
                let any = self.row_bits(&row, &self.offsets.high) & columns;
                self.pixels(&row, (rect.x0, y), any & !full, sink);
            }
            runs(full, |from, to| sink.run(y, rect.x0 + from, rect.x0 + to));
            for (v, &step) in row.iter_mut().zip(&self.step_y) {
                *v = v.plus(step);
            }
        }
    }

    /// Bit i: whether all edges have E + offset ≥ 0 at pixel i of the row.
    #[inline(always)]
    fn row_bits(&self, row: &[T; 3], offset: &[T; 3]) -> u32 {
        let mut bits = 0;
        let mut v = [row[0].plus(offset[0]), row[1].plus(offset[1]), row[2].plus(offset[2])];
        for i in 0..BLOCK {
            bits |= u32::from(v[0].or(v[1]).or(v[2]).is_inside()) << i;
            for (v, &step) in v.iter_mut().zip(&self.step_x) {
                *v = v.plus(step);
            }
        }
        bits
    }

    /// Tests the samples of the pixels whose bit is set.
    fn pixels(&self, row: &[T; 3], at: (i32, i32), mut bits: u32, sink: &mut impl Sink) {
        while bits != 0 {
            let i = bits.trailing_zeros();
            bits &= bits - 1;
            let mut v = *row;
            for (v, &step) in v.iter_mut().zip(&self.step_x) {
                *v = v.plus(step.by_u8(i as u8));
            }
            let mask = self.mask(&v);
            if !mask.is_empty() {
                sink.pixel(at.0 + i as i32, at.1, mask);
            }
        }
    }

    fn mask(&self, v: &[T; 3]) -> SampleMask {
        let [o0, o1, o2] = &self.offsets.sample;
        let mut mask = 0;
        for s in 0..self.samples {
            let all = v[0].plus(o0[s]).or(v[1].plus(o1[s])).or(v[2].plus(o2[s]));
            mask |= u64::from(all.is_inside()) << s;
        }
        SampleMask(mask)
    }
}

/// Calls `emit` with each run of ones, half-open.
fn runs(mut bits: u32, mut emit: impl FnMut(i32, i32)) {
    while bits != 0 {
        let from = bits.trailing_zeros();
        let to = from + (bits >> from).trailing_ones();
        emit(from as i32, to as i32);
        bits &= !((1 << to) - 1);
    }
}
