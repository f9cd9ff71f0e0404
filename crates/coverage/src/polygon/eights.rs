//! Edges on their way into the sums of rows, eight side by side.
//!
//! Most edges meet two or three rows, and touch one or two pixels of each. What they change there is
//! little to compute and much to get ready for, so it is done for eight edges at a time, down the rows
//! that each of them meets.

use super::PolygonEdge;
use super::sums::RowSums;
use crate::area::{Reach, mirrored_eight, rounded_parts, splat};
use crate::fixed::{WHOLE, whole_bits};
use fearless_simd::{Simd, f64x8, prelude::*};

/// As many edges are kept until they are added.
const MOST: usize = 64;

/// An edge ends in the pixel of its end even if that was computed a little too far left: edges that
/// follow each other touch a common pixel.
pub(super) const A_LITTLE: f64 = 1.0 / (1 << 26) as f64;

/// Edges of a few rows.
#[derive(Debug, Clone)]
pub(super) struct Eights {
    len: usize,
    /// Their ends, in 1/256 pixel, and how they wind.
    x0: [f64; MOST],
    y0: [f64; MOST],
    x1: [f64; MOST],
    y1: [f64; MOST],
    winding: [f64; MOST],
}

impl Default for Eights {
    fn default() -> Self {
        let none = [0.0; MOST];
        Self { len: 0, x0: none, y0: none, x1: none, y1: none, winding: none }
    }
}

/// Rows that edges are added to, of the same pixels, the first of them row `y0`.
pub(super) struct Rows<'a> {
    pub(super) y0: i32,
    pub(super) sums: &'a mut [RowSums],
}

/// The same number for each of eight edges.
type Eight = [f64; 8];

/// Where eight edges begin, and how they go on: [`Slope`](crate::area::Slope)s.
#[derive(Clone, Copy)]
struct Slopes<S: Simd> {
    sign: f64x8<S>,
    x0: f64x8<S>,
    y0: f64x8<S>,
    run: f64x8<S>,
    half_rise: f64x8<S>,
}

impl<S: Simd> Slopes<S> {
    #[inline(always)]
    fn along(&self, y: f64x8<S>) -> f64x8<S> {
        self.x0 + (y - self.y0) * self.run
    }
}

/// What eight edges add to their first two pixels of a row and to the one after them, beyond what they
/// add to the pixel before.
struct Rises {
    /// The first pixel and how many follow it, as [`whole_bits`] reads them.
    first: Eight,
    more: Eight,
    rises: [Eight; 3],
}

impl Eights {
    /// Keeps an edge that meets one of the rows at least.
    #[inline(always)]
    pub(super) fn push<S: Simd>(&mut self, simd: S, e: &PolygonEdge, rows: &mut Rows<'_>) {
        if self.len == MOST {
            self.flush(simd, rows);
        }
        // Below it anyhow; so that nobody checks.
        let at = self.len % MOST;
        self.x0[at] = f64::from(e.x0);
        self.y0[at] = f64::from(e.y0);
        self.x1[at] = f64::from(e.x1);
        self.y1[at] = f64::from(e.y1);
        self.winding[at] = f64::from(e.winding);
        self.len += 1;
    }

    /// Adds what is kept to the rows of which all is known.
    #[inline(always)]
    pub(super) fn flush<S: Simd>(&mut self, simd: S, rows: &mut Rows<'_>) {
        for at in (0..self.len).step_by(8) {
            let lanes = u64::MAX >> (64 - (self.len - at).min(8));
            self.add(simd, at, lanes, rows);
        }
        self.len = 0;
    }

    /// The edges from `at` on as they run down.
    #[inline(always)]
    fn slopes<S: Simd>(&self, simd: S, at: usize) -> Slopes<S> {
        let (zero, one, unit) = (splat(simd, 0.0), splat(simd, 1.0), splat(simd, 1.0 / 256.0));
        let [x0, y0, x1, y1] = self.ends(simd, at);
        let sign = x1.simd_lt(x0).select(-one, one);
        let (dx, dy) = ((x1 - x0).abs(), y1 - y0);
        Slopes {
            sign,
            x0: sign * (x0 * unit),
            y0: y0 * unit,
            run: dx / dy,
            half_rise: dx.simd_eq(zero).select(zero, splat(simd, 0.5) * dy / dx),
        }
    }

    #[inline(always)]
    fn ends<S: Simd>(&self, simd: S, at: usize) -> [f64x8<S>; 4] {
        [
            f64x8::from_slice(simd, &self.x0[at..at + 8]),
            f64x8::from_slice(simd, &self.y0[at..at + 8]),
            f64x8::from_slice(simd, &self.x1[at..at + 8]),
            f64x8::from_slice(simd, &self.y1[at..at + 8]),
        ]
    }

    /// Adds the edges from `at` on of which `lanes` has a bit.
    #[inline(always)]
    fn add<S: Simd>(&self, simd: S, at: usize, lanes: u64, rows: &mut Rows<'_>) {
        let slopes = self.slopes(simd, at);
        let [_, top, _, bottom] = self.ends(simd, at);
        let weight = slopes.sign * f64x8::from_slice(simd, &self.winding[at..at + 8]);
        let unit = splat(simd, 1.0 / 256.0);
        let from_row = f64::from(rows.y0);
        let to_row = from_row + rows.sums.len() as f64;
        let mut start = (top * unit).max(splat(simd, from_row));
        let bottom = (bottom * unit).min(splat(simd, to_row));
        let mut from = slopes.along(start);
        let mut active = start.simd_lt(bottom).to_bitmask() & lanes;
        while active != 0 {
            let row = start.floor();
            let end = (row + splat(simd, 1.0)).min(bottom);
            let to = slopes.along(end);
            let height = weight * (end - start);
            let reach = Reaches { from, to, height, half_rise: weight * slopes.half_rise };
            let places = row - splat(simd, from_row);
            self.add_to_rows(simd, (slopes.sign, &reach), places, active, rows);
            (start, from) = (end, to);
            active &= start.simd_lt(bottom).to_bitmask();
        }
    }

    /// Adds edges to a row each.
    #[inline(always)]
    fn add_to_rows<S: Simd>(
        &self,
        simd: S,
        (sign, reach): (f64x8<S>, &Reaches<S>),
        places: f64x8<S>,
        lanes: u64,
        rows: &mut Rows<'_>,
    ) {
        let Rises { first, more, rises } = reach.rises(simd, sign);
        let mut numbers = [0.0; 8];
        (places + splat(simd, WHOLE)).store_slice(&mut numbers);
        let mut left = lanes;
        while left != 0 {
            let lane = left.trailing_zeros() as usize % 8;
            left &= left - 1;
            let Some(row) = rows.sums.get_mut(whole_bits(numbers[lane]) as usize) else { continue };
            if !row.proven {
                continue;
            }
            let rises = [rises[0][lane], rises[1][lane], rises[2][lane]];
            let (first, more) = (whole_bits(first[lane]), whole_bits(more[lane]));
            if !row.add_short((first, more), rises) {
                row.add_known(simd, (first, first + more), &reach.lane(sign, lane));
            }
        }
    }
}

/// Eight [`Reach`]es; their heights carry the sign and the winding number.
struct Reaches<S: Simd> {
    from: f64x8<S>,
    to: f64x8<S>,
    height: f64x8<S>,
    half_rise: f64x8<S>,
}

impl<S: Simd> Reaches<S> {
    #[inline(always)]
    fn rises(&self, simd: S, sign: f64x8<S>) -> Rises {
        let Self { from, to, height, half_rise } = *self;
        let (a, b) = (sign * from, sign * to);
        let first = a.min(b).floor();
        let last = (a.max(b) + splat(simd, A_LITTLE)).floor();
        let full = sign * height;
        let (c, all) = mirrored_eight(simd, sign, first, full);
        let here = all + rounded_parts(simd, c, [from, to], height, half_rise);
        let next = all + rounded_parts(simd, c + sign, [from, to], height, half_rise);
        let whole = splat(simd, WHOLE);
        let mut out = Rises { first: [0.0; 8], more: [0.0; 8], rises: [[0.0; 8]; 3] };
        (first + whole).store_slice(&mut out.first);
        (last - first + whole).store_slice(&mut out.more);
        here.store_slice(&mut out.rises[0]);
        (next - here).store_slice(&mut out.rises[1]);
        (full - next).store_slice(&mut out.rises[2]);
        out
    }

    /// One of them, as an edge that runs down: its heights carry its winding number.
    #[inline(always)]
    fn lane(&self, signs: f64x8<S>, lane: usize) -> Reach {
        let sign = signs[lane];
        let (height, half_rise) = (sign * self.height[lane], sign * self.half_rise[lane]);
        Reach { sign, from: self.from[lane], to: self.to[lane], height, half_rise }
    }
}
