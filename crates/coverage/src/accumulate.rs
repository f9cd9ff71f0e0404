//! Exact area: what part of each pixel of a row lies right of an edge, summed over edges.
//!
//! An edge that runs down from height y₁ to y₂ through a row leaves ∫ clamp(c + 1 − x(t), 0, 1) dt of
//! pixel c on its right. Inside the pixels that it touches this is a trapezoid; further right it is
//! y₂ − y₁, further left nothing. Each trapezoid is computed in f64 from the edge, the row and the
//! pixel alone, rounded to 2⁻³², and summed in whole numbers. So the sum depends neither on the order of
//! the edges nor on the clip, the two sides of a shared edge cancel, and what is full is exactly 1.

use crate::AreaSink;
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
#[derive(Debug, Clone, Copy)]
pub(crate) struct Piece {
    slope: Slope,
    /// Where it enters the row: the height, a multiple of 2⁻³², and x there.
    start: f64,
    x: f64,
}

impl Piece {
    /// `start`: the height at which the edge enters the row (the row's top or its own).
    pub(crate) fn new(slope: Slope, start: f64) -> Self {
        Self { slope, start, x: slope.at(start) }
    }

    /// The part of pixel `c` right of the edge, from where it enters the row to height `y`, where
    /// the edge is at `x`. Pixels already passed change by whole units of y from then on.
    #[inline]
    fn right_of(&self, c: f64, y: f64, x: f64) -> i64 {
        // Seen in the mirror, an edge that runs left runs right.
        if self.slope.run >= 0.0 {
            self.before_and_within(self.x - c, x - c, y, self.slope.rise)
        } else {
            to_units(y - self.start)
                - self.before_and_within(c + 1.0 - self.x, c + 1.0 - x, y, -self.slope.rise)
        }
    }

    /// ∫ clamp(1 − u, 0, 1) dt for u that grows from `from` to `to`.
    #[inline]
    fn before_and_within(&self, from: f64, to: f64, y: f64, rise: f64) -> i64 {
        let enter = if from < 0.0 { (self.start - from * rise).min(y) } else { self.start };
        let leave = if to > 1.0 { (self.start + (1.0 - from) * rise).min(y) } else { y };
        let mean = 1.0 - 0.5 * (from.max(0.0) + to.min(1.0));
        // An edge that is all left of the pixel, or all right of it, has no part within.
        let within = if to > 0.0 && from < 1.0 { (leave - enter).max(0.0) * mean } else { 0.0 };
        let before = if to <= 0.0 { y } else { enter };
        round_units(before - self.start + within)
    }
}

/// Exact for multiples of 2⁻³².
#[inline]
fn to_units(v: f64) -> i64 {
    (v * ONE as f64) as i64
}

/// The nearest whole number of units of a v ≥ 0.
#[inline]
fn round_units(v: f64) -> i64 {
    (v * ONE as f64 + 0.5) as i64
}

/// Sums of one row of pixels within a clip.
#[derive(Debug, Clone, Default)]
pub(crate) struct AreaRow {
    x0: i32,
    x1: i32,
    /// Per pixel: the area within it, and what all pixels from it on get. All zero between rows.
    cells: Vec<[i64; 2]>,
    /// One bit per pixel: whether its cell was written.
    marked: Vec<u64>,
}

impl AreaRow {
    pub(crate) fn start(&mut self, x0: i32, x1: i32) {
        (self.x0, self.x1) = (x0, x1);
        let width = (x1 - x0) as usize;
        self.cells.resize(self.cells.len().max(width), [0; 2]);
        self.marked.resize(width.div_ceil(64), 0);
    }

    /// Adds `weight` times what lies right of the piece between the heights `top` and `bottom`.
    #[inline]
    pub(crate) fn add(&mut self, piece: &Piece, top: f64, bottom: f64, weight: i64) {
        let from = if top > piece.start { piece.slope.at(top) } else { piece.x };
        let to = piece.slope.at(bottom);
        let (left, right) = if from < to { (from, to) } else { (to, from) };
        // Held to the clip's columns while still real: the numbers may be far outside.
        let (x0, x1) = (f64::from(self.x0), f64::from(self.x1));
        let first = floor(left.clamp(x0, x1)) as i32;
        let last = if right < x0 { self.x0 - 1 } else { floor(right.min(x1 - 0.5)) as i32 };
        for x in first..=last {
            let c = f64::from(x);
            let mut area = piece.right_of(c, bottom, to);
            if top > piece.start {
                area -= piece.right_of(c, top, from);
            }
            self.mark(x)[0] += weight * area;
        }
        let beyond = if right >= x1 { self.x1 } else { last + 1 };
        self.add_from(beyond, weight * to_units(bottom - top));
    }

    /// Adds to all pixels from `x` on (which may be left or right of the clip).
    #[inline]
    pub(crate) fn add_from(&mut self, x: i32, area: i64) {
        if x < self.x1 {
            self.mark(x.max(self.x0))[1] += area;
        }
    }

    #[inline]
    fn mark(&mut self, x: i32) -> &mut [i64; 2] {
        let column = (x - self.x0) as usize;
        self.marked[column / 64] |= 1 << (column % 64);
        &mut self.cells[column]
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
                let [within, onward] = core::mem::take(&mut self.cells[column]);
                sum += onward;
                out.emit(x, x + 1, sum + within);
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

#[inline]
fn floor(v: f64) -> f64 {
    crate::fixed::floor(v)
}
