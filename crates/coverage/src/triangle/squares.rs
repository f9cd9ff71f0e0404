//! Squares of 8 × 8 pixels at once, for sinks that take them: no search for the ends of rows, whose
//! lengths no processor can guess.
//!
//! With one sample a vector holds two rows of pixels, with four it holds four pixels. Where a
//! triangle is larger than a square, tests of eight squares at a time leave out those that it does
//! not touch and hand on whole those that it fills.

use crate::edge::Edge;
use crate::{SamplePattern, Sink};
use fearless_simd::{Simd, f64x8, i32x16, prelude::*};
use scumble_geometry::IntRect;

/// Pixels along the side of a square.
const SIDE: i32 = 8;

/// Squares that are tested at a time.
const ROW: i32 = 8;

/// Where the squares of a row begin, in 1/256 pixel.
const SQUARES: [f64; ROW as usize] =
    [0.0, 2048.0, 4096.0, 6144.0, 8192.0, 10240.0, 12288.0, 14336.0];

/// Edge values beyond this keep their sign over the whole square, so they can be cut to it.
const LIMIT: i64 = (1 << 30) - 1;

/// Finds the covered samples of a square.
trait Square {
    /// `first` is the value of each edge at the corner of `rect`, which is at most a square.
    fn find(&self, rect: IntRect, first: [i32; 3], sink: &mut impl Sink);
}

/// Whether [`rasterize`] knows the pattern.
pub(super) fn takes(pattern: &SamplePattern) -> bool {
    matches!(pattern.len(), 1 | 4)
}

/// Hands on the samples of a triangle in a region, squares by [`Sink::whole`] or [`Sink::parts`].
///
/// No edge may change by more than 2³⁰ over a square and a pixel, as for blocks in 32 bits.
#[inline(always)]
pub(super) fn rasterize<S: Simd>(
    simd: S,
    edges: &[Edge; 3],
    region: IntRect,
    pattern: &SamplePattern,
    sink: &mut impl Sink,
) {
    if pattern.len() == 1 {
        walk(simd, &Whole::new(simd, edges, pattern), edges, region, pattern, sink);
    } else {
        walk(simd, &Parts::new(simd, edges, pattern), edges, region, pattern, sink);
    }
}

#[inline(always)]
fn walk<S: Simd>(
    simd: S,
    square: &impl Square,
    edges: &[Edge; 3],
    region: IntRect,
    pattern: &SamplePattern,
    sink: &mut impl Sink,
) {
    if region.x1 - region.x0 <= SIDE && region.y1 - region.y0 <= SIDE {
        return square.find(region, first(&corners(edges, region.x0, region.y0)), sink);
    }
    let mut x0 = region.x0;
    while x0 < region.x1 {
        let x1 = region.x1.min(x0 + ROW * SIDE);
        let region = IntRect { x0, x1, ..region };
        let mut corner = corners(edges, region.x0, region.y0);
        let mut tests = [
            Test::new(simd, &edges[0], corner[0], pattern),
            Test::new(simd, &edges[1], corner[1], pattern),
            Test::new(simd, &edges[2], corner[2], pattern),
        ];
        let within = (1u32 << ((region.x1 - region.x0 + SIDE - 1) / SIDE)) - 1;
        let mut y0 = region.y0;
        while y0 < region.y1 {
            let row = IntRect { y0, y1: region.y1.min(y0 + SIDE), ..region };
            let (some, all) = squares(simd, &tests);
            let (mut some, all) = (some & !all & within, all & within);
            while some != 0 {
                let place = some.trailing_zeros() as i32;
                some &= some - 1;
                let x = row.x0 + place * SIDE;
                let along = |k: usize| corner[k] + edges[k].a * i64::from(place * SIDE * 256);
                let part = IntRect { x0: x, x1: row.x1.min(x + SIDE), ..row };
                square.find(part, first(&[along(0), along(1), along(2)]), sink);
            }
            if all != 0 {
                // Those of a row are one stretch: a triangle has no holes.
                let from = row.x0 + all.trailing_zeros() as i32 * SIDE;
                let to = row.x0 + (32 - all.leading_zeros()) as i32 * SIDE;
                sink.block(IntRect { x0: from, x1: to.min(row.x1), ..row });
            }
            for ((corner, test), edge) in corner.iter_mut().zip(&mut tests).zip(edges) {
                *corner += edge.b * i64::from(SIDE * 256);
                test.step(simd);
            }
            y0 += SIDE;
        }
        x0 = x1;
    }
}

/// Each edge at the top left of a pixel.
#[inline(always)]
fn corners(edges: &[Edge; 3], x: i32, y: i32) -> [i64; 3] {
    let (x, y) = (i64::from(x) << 8, i64::from(y) << 8);
    [edges[0].at(x, y), edges[1].at(x, y), edges[2].at(x, y)]
}

/// Each edge at the corner of a square, cut to what keeps its sign.
#[inline(always)]
fn first(corner: &[i64; 3]) -> [i32; 3] {
    let cut = |v: i64| v.clamp(-LIMIT, LIMIT) as i32;
    [cut(corner[0]), cut(corner[1]), cut(corner[2])]
}

/// An edge over eight squares side by side, in f64: whole numbers below 2⁵³.
struct Test<S: Simd> {
    /// The most and the least of it over the samples of each square.
    high: f64x8<S>,
    low: f64x8<S>,
    /// From a row of squares to the next.
    down: f64,
}

impl<S: Simd> Test<S> {
    /// `corner` is the edge's value at the corner of the first square.
    #[inline(always)]
    fn new(simd: S, edge: &Edge, corner: i64, pattern: &SamplePattern) -> Self {
        let [first, last] = pattern.extent().map(|p| p.map(i64::from));
        let along = |step: i64, axis: usize| {
            let ends = (step * first[axis], step * (last[axis] + i64::from(SIDE - 1) * 256));
            (ends.0.min(ends.1), ends.0.max(ends.1))
        };
        let (x, y) = (along(edge.a, 0), along(edge.b, 1));
        let starts = f64x8::load_array(simd, SQUARES) * (edge.a as f64);
        let high = starts + (corner + x.1 + y.1) as f64;
        let low = starts + (corner + x.0 + y.0) as f64;
        Self { high, low, down: (edge.b * i64::from(SIDE * 256)) as f64 }
    }

    /// Goes on to the next row of squares.
    #[inline(always)]
    fn step(&mut self, simd: S) {
        let down = f64x8::splat(simd, self.down);
        (self.high, self.low) = (self.high + down, self.low + down);
    }
}

/// Of the squares of a row, those that may hold a sample, and those that are covered whole.
#[inline(always)]
fn squares<S: Simd>(simd: S, [a, b, c]: &[Test<S>; 3]) -> (u32, u32) {
    let zero = f64x8::splat(simd, 0.0);
    let set = |v: f64x8<S>| v.simd_ge(zero).to_bitmask() as u32;
    (set(a.high.min(b.high).min(c.high)), set(a.low.min(b.low).min(c.low)))
}

/// One sample a pixel.
struct Whole<S: Simd> {
    simd: S,
    /// Each edge over two rows of eight pixels, from the corner of the square.
    ramp: [i32x16<S>; 3],
    /// From two rows to the next two.
    down: [i32; 3],
}

impl<S: Simd> Whole<S> {
    #[inline(always)]
    fn new(simd: S, edges: &[Edge; 3], pattern: &SamplePattern) -> Self {
        let [xs, ys] = pattern.square_lanes();
        let ramp = |edge: &Edge| {
            i32x16::from_slice(simd, &xs[..16]) * (edge.a as i32)
                + i32x16::from_slice(simd, &ys[..16]) * (edge.b as i32)
        };
        let ramp = [ramp(&edges[0]), ramp(&edges[1]), ramp(&edges[2])];
        let down = |edge: &Edge| edge.b as i32 * 512;
        Self { simd, ramp, down: [down(&edges[0]), down(&edges[1]), down(&edges[2])] }
    }
}

impl<S: Simd> Square for Whole<S> {
    #[inline(always)]
    fn find(&self, rect: IntRect, first: [i32; 3], sink: &mut impl Sink) {
        let (zero, down) = (i32x16::splat(self.simd, 0), self.down);
        let mut v = [self.ramp[0] + first[0], self.ramp[1] + first[1], self.ramp[2] + first[2]];
        let mut outside = 0;
        for pair in 0..4 {
            // Negative as soon as one of them is.
            let any = v[0] | v[1] | v[2];
            outside |= any.simd_lt(zero).to_bitmask() << (16 * pair);
            v = [v[0] + down[0], v[1] + down[1], v[2] + down[2]];
        }
        let columns = (0xff >> (SIDE - rect.x1 + rect.x0)) as u64 * 0x0101_0101_0101_0101;
        let rows = u64::MAX >> (8 * (SIDE - rect.y1 + rect.y0));
        let covered = !outside & columns & rows;
        if covered != 0 {
            sink.whole(rect.x0, rect.y0, covered);
        }
    }
}

/// Four samples a pixel.
struct Parts<S: Simd> {
    simd: S,
    /// Each edge at the samples of a row of eight pixels, from the corner of the square.
    ramp: [[i32x16<S>; 2]; 3],
    /// From a row to the next.
    down: [i32; 3],
}

impl<S: Simd> Parts<S> {
    #[inline(always)]
    fn new(simd: S, edges: &[Edge; 3], pattern: &SamplePattern) -> Self {
        let [xs, ys] = pattern.square_lanes();
        let half = |edge: &Edge, i: usize| {
            i32x16::from_slice(simd, &xs[i..i + 16]) * (edge.a as i32)
                + i32x16::from_slice(simd, &ys[i..i + 16]) * (edge.b as i32)
        };
        let ramp = |edge: &Edge| [half(edge, 0), half(edge, 16)];
        let ramp = [ramp(&edges[0]), ramp(&edges[1]), ramp(&edges[2])];
        let down = |edge: &Edge| edge.b as i32 * 256;
        Self { simd, ramp, down: [down(&edges[0]), down(&edges[1]), down(&edges[2])] }
    }
}

impl<S: Simd> Square for Parts<S> {
    #[inline(always)]
    fn find(&self, rect: IntRect, first: [i32; 3], sink: &mut impl Sink) {
        let (zero, down) = (i32x16::splat(self.simd, 0), self.down);
        let columns = u32::MAX >> (4 * (SIDE - rect.x1 + rect.x0));
        let [e0, e1, e2] = &self.ramp;
        let mut left = [e0[0] + first[0], e1[0] + first[1], e2[0] + first[2]];
        let mut right = [e0[1] + first[0], e1[1] + first[1], e2[1] + first[2]];
        // Twice as many as there can be: of eight, the compiler would make eight pieces of code, and keep
        // for each what it adds to the first. There are not enough registers for that.
        let (mut rows, mut some) = ([0; 2 * SIDE as usize], 0);
        for row in rows.iter_mut().take((rect.y1 - rect.y0) as usize) {
            // Negative as soon as one of them is.
            let (l, r) = (left[0] | left[1] | left[2], right[0] | right[1] | right[2]);
            let (l, r) = (l.simd_lt(zero).to_bitmask() as u32, r.simd_lt(zero).to_bitmask() as u32);
            *row = !(l | r << 16) & columns;
            some |= *row;
            left = [left[0] + down[0], left[1] + down[1], left[2] + down[2]];
            right = [right[0] + down[0], right[1] + down[1], right[2] + down[2]];
        }
        if some != 0
            && let Some(rows) = rows.first_chunk()
        {
            sink.parts(rect.x0, rect.y0, rows);
        }
    }
}
