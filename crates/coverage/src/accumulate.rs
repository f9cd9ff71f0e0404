//! Exact area: what part of each pixel of a row lies right of an edge, summed over edges.
//!
//! An edge that runs down from height y₁ to y₂ through a row leaves ∫ clamp(c + 1 − x(t), 0, 1) dt of
//! pixel c on its right. Inside the pixels that it touches this is a trapezoid; further right it is
//! y₂ − y₁, further left nothing. Each trapezoid is computed in f64 from the edge, the row and the
//! pixel alone, rounded to 2⁻³², and summed in whole numbers. So the sum depends neither on the order of
//! the edges nor on the clip, the two sides of a shared edge cancel, and what is full is exactly 1.

use crate::AreaSink;
use crate::fixed::{floor, low_bits};
use alloc::vec::Vec;

/// One whole pixel.
pub(crate) const ONE: i64 = 1 << 32;

/// An edge from top to bottom, in pixels.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Slope {
    x0: f64,
    y0: f64,
    /// Δx/Δy and its inverse (infinite for a vertical edge).
    run: f64,
    rise: f64,
}

impl Slope {
    /// From (x0, y0) down to (x1, y1) in 1/256 pixel, y0 < y1.
    pub(crate) fn new(x0: i32, y0: i32, x1: i32, y1: i32) -> Self {
        let dx = f64::from(x1) - f64::from(x0);
        let dy = f64::from(y1) - f64::from(y0);
        Self { x0: f64::from(x0) / 256.0, y0: f64::from(y0) / 256.0, run: dx / dy, rise: dy / dx }
    }

    /// x at a height in pixels.
    #[inline]
    pub(crate) fn at(&self, y: f64) -> f64 {
        self.x0 + (y - self.y0) * self.run
    }
}

/// One edge within one row of pixels.
///
/// It is kept so that it runs right: one that runs left is seen in the mirror (x → −x, so that pixel c
/// becomes pixel −c − 1).
#[derive(Debug, Clone, Copy)]
pub(crate) struct Piece {
    slope: Slope,
    mirrored: bool,
    /// |Δy/Δx|.
    rise: f64,
    /// Where it enters the row: the height, a multiple of 2⁻³², and (mirrored) x there.
    start: f64,
    x: f64,
}

/// A piece down to some height: the (mirrored) x there, the pixels there and at the start.
#[derive(Debug, Clone, Copy)]
struct Reach {
    height: f64,
    x: f64,
    first: f64,
    last: f64,
}

impl Piece {
    /// `start`: the height at which the edge enters the row (the row's top or its own).
    #[inline(always)]
    pub(crate) fn new(slope: Slope, start: f64) -> Self {
        let mirrored = slope.run < 0.0;
        let x = slope.at(start);
        Self {
            slope,
            mirrored,
            rise: if mirrored { -slope.rise } else { slope.rise },
            start,
            x: if mirrored { -x } else { x },
        }
    }

    /// The height at which the edge enters the row.
    pub(crate) fn start(&self) -> f64 {
        self.start
    }

    /// x at a height.
    #[inline]
    pub(crate) fn at(&self, y: f64) -> f64 {
        self.slope.at(y)
    }

    #[inline(always)]
    fn reach(&self, y: f64) -> Reach {
        let x = self.slope.at(y);
        let x = if self.mirrored { -x } else { x };
        Reach { height: y - self.start, x, first: floor(self.x), last: floor(x) }
    }

    /// ∫ clamp(c + 1 − x(t), 0, 1) dt from the start on, for a (mirrored) pixel c.
    ///
    /// A function of the edge, the row, the pixel and the height, which changes by whole units once the
    /// edge has left the pixel: so it does not matter at which heights a sum is cut.
    #[inline(always)]
    fn left_behind(&self, c: f64, to: &Reach) -> i64 {
        if c < to.first {
            return 0;
        }
        if c > to.last {
            return to_units(to.height);
        }
        let time = |x: f64| ((x - self.x) * self.rise).min(to.height);
        let (enter, from) = if c > to.first { (time(c), 0.0) } else { (0.0, self.x - c) };
        let (leave, until) = if c < to.last { (time(c + 1.0), 1.0) } else { (to.height, to.x - c) };
        to_units(enter + (leave - enter).max(0.0) * (1.0 - 0.5 * (from + until)))
    }
}

/// The nearest whole number of units, for |v| < 2¹⁹: exact for multiples of 2⁻³².
#[inline(always)]
fn to_units(v: f64) -> i64 {
    // 1.5 × 2²⁰ leaves 32 bits after the point, and the addition rounds to them.
    const ROUNDER: f64 = 1_572_864.0;
    (v + ROUNDER).to_bits() as i64 - ROUNDER.to_bits() as i64
}

/// Sums of one row of pixels within a clip.
#[derive(Debug, Clone, Default)]
pub(crate) struct AreaRow {
    x0: i32,
    x1: i32,
    /// Per pixel: the area within it. All zero between rows. (Not side by side with `onward`: a
    /// load of both would wait for the stores of each.)
    within: Vec<i64>,
    /// Per pixel: what it and all pixels right of it get. All zero between rows.
    onward: Vec<i64>,
    /// One bit per pixel: whether its cell was written.
    marked: Vec<u64>,
}

impl AreaRow {
    pub(crate) fn start(&mut self, x0: i32, x1: i32) {
        (self.x0, self.x1) = (x0, x1);
        let width = (x1 - x0) as usize;
        let room = self.within.len().max(width);
        self.within.resize(room, 0);
        self.onward.resize(room, 0);
        self.marked.resize(width.div_ceil(64), 0);
    }

    /// Adds `weight` times what lies right of the piece between the heights `top` and `bottom`.
    #[inline(always)]
    pub(crate) fn add(&mut self, piece: &Piece, top: f64, bottom: f64, weight: i64) {
        let high = piece.reach(bottom);
        let low = (top > piece.start).then(|| piece.reach(top));
        let height = to_units(bottom - top);
        let mirrored = piece.mirrored;
        let (x0, x1) = if mirrored { (-self.x1, -self.x0) } else { (self.x0, self.x1) };
        // Held to the clip's columns while still real: the numbers may be far outside.
        let column = |c: f64| low_bits(c.clamp(f64::from(x0) - 1.0, f64::from(x1)));
        let first = column(low.map_or(high.first, |low| low.last));
        let last = column(high.last);
        for c in first.max(x0)..(last + 1).min(x1) {
            let at = f64::from(c);
            let mut part = piece.left_behind(at, &high);
            if let Some(low) = &low {
                part -= piece.left_behind(at, low);
            }
            // What is left behind in the mirror lies left of the edge: the rest is right of it.
            let (x, right) = if mirrored { (-1 - c, height - part) } else { (c, part) };
            let column = self.mark(x);
            self.within[column] += weight * right;
        }
        self.add_from(if mirrored { -first } else { last + 1 }, weight * height);
    }

    /// Adds to all pixels from `x` on (which may be left or right of the clip).
    #[inline]
    pub(crate) fn add_from(&mut self, x: i32, area: i64) {
        if x < self.x1 {
            let column = self.mark(x.max(self.x0));
            self.onward[column] += area;
        }
    }

    #[inline]
    fn mark(&mut self, x: i32) -> usize {
        let column = (x - self.x0) as usize;
        self.marked[column / 64] |= 1 << (column % 64);
        column
    }

    /// Hands the sums of the row on, and empties it.
    pub(crate) fn sweep(&mut self, y: i32, sink: &mut impl AreaSink) {
        let mut out = Emitter { y, run: None, sink };
        let (mut from, mut sum) = (self.x0, 0);
        for word in 0..self.marked.len() {
            let mut bits = core::mem::take(&mut self.marked[word]);
            while bits != 0 {
                let column = word * 64 + bits.trailing_zeros() as usize;
                bits &= bits - 1;
                let x = self.x0 + column as i32;
                out.emit(from, x, sum);
                sum += core::mem::take(&mut self.onward[column]);
                out.emit(x, x + 1, sum + core::mem::take(&mut self.within[column]));
                from = x + 1;
            }
        }
        out.emit(from, self.x1, sum);
        out.flush();
    }
}

/// Hands stretches of equal area on, full ones joined into runs.
struct Emitter<'a, S> {
    y: i32,
    run: Option<(i32, i32)>,
    sink: &'a mut S,
}

impl<S: AreaSink> Emitter<'_, S> {
    #[inline]
    fn emit(&mut self, x0: i32, x1: i32, area: i64) {
        if x0 >= x1 {
            return;
        }
        if area >= ONE {
            let start = self.run.map_or(x0, |(start, _)| start);
            self.run = Some((start, x1));
            return;
        }
        self.flush();
        if area > 0 {
            self.sink.span(self.y, x0, x1, area as f32 * (1.0 / ONE as f32));
        }
    }

    #[inline]
    fn flush(&mut self) {
        if let Some((x0, x1)) = self.run.take() {
            self.sink.run(self.y, x0, x1);
        }
    }
}
