//! Edges within rows, eight side by side.
//!
//! Most edges touch one or two pixels of a row. What they change there is little to compute and much to
//! get ready for, so it is done for eight edges at a time, of whatever rows.

use super::sums::RowSums;
use crate::area::{Reach, rounded_parts};
use crate::fixed::low_bits;
use fearless_simd::{Simd, f64x8, prelude::*};

/// As many edges are kept until they are added.
const MOST: usize = 64;

/// An edge ends in the pixel of its end even if that was computed a little too far left: edges that
/// follow each other touch a common pixel.
pub(super) const A_LITTLE: f64 = 1.0 / (1 << 26) as f64;

/// Edges within rows, on their way into the sums of these rows.
#[derive(Debug, Clone)]
pub(super) struct Eights {
    len: usize,
    /// See [`Reach`]; the heights carry the sign and the winding number.
    from: [f64; MOST],
    to: [f64; MOST],
    sign: [f64; MOST],
    height: [f64; MOST],
    half_rise: [f64; MOST],
    rows: [u32; MOST],
}

impl Default for Eights {
    fn default() -> Self {
        let none = [0.0; MOST];
        let (from, to, sign, height, half_rise) = (none, none, none, none, none);
        Self { len: 0, from, to, sign, height, half_rise, rows: [0; MOST] }
    }
}

/// What an edge adds to its first two pixels and to the one after them, beyond what it adds to the
/// pixel before.
#[derive(Debug, Clone, Copy)]
struct Steps {
    first: [f64; 8],
    last: [f64; 8],
    rises: [[f64; 8]; 3],
}

impl Eights {
    /// Keeps an edge of row `row` that winds by `winding`; `rows` are those of all edges that are kept.
    #[inline(always)]
    pub(super) fn push<S: Simd>(
        &mut self,
        simd: S,
        row: usize,
        (reach, winding): (&Reach, i32),
        rows: &mut [RowSums],
    ) {
        if self.len == MOST {
            self.flush(simd, rows);
        }
        // Below it anyhow; so that nobody checks.
        let at = self.len % MOST;
        let weighted = reach.sign * f64::from(winding);
        self.from[at] = reach.from;
        self.to[at] = reach.to;
        self.sign[at] = reach.sign;
        self.height[at] = weighted * reach.height;
        self.half_rise[at] = weighted * reach.half_rise;
        self.rows[at] = row as u32;
        self.len += 1;
    }

    /// Adds what is kept.
    #[inline(always)]
    pub(super) fn flush<S: Simd>(&mut self, simd: S, rows: &mut [RowSums]) {
        for at in (0..self.len).step_by(8) {
            let steps = self.steps(simd, at);
            for lane in 0..8.min(self.len - at) {
                let rises = [steps.rises[0][lane], steps.rises[1][lane], steps.rises[2][lane]];
                let [first, last] = [steps.first[lane], steps.last[lane]].map(low_bits);
                let row = &mut rows[self.rows[at + lane] as usize];
                if !row.add_short((first, last), rises) {
                    row.add_known(simd, (first, last), &self.reach(at + lane));
                }
            }
        }
        self.len = 0;
    }

    /// An edge that is kept, as one that runs down: its heights carry its winding number.
    fn reach(&self, at: usize) -> Reach {
        let sign = self.sign[at];
        let (height, half_rise) = (sign * self.height[at], sign * self.half_rise[at]);
        Reach { sign, from: self.from[at], to: self.to[at], height, half_rise }
    }

    #[inline(always)]
    fn steps<S: Simd>(&self, simd: S, at: usize) -> Steps {
        let load = |values: &[f64; MOST]| f64x8::from_slice(simd, &values[at..at + 8]);
        let (from, to, sign) = (load(&self.from), load(&self.to), load(&self.sign));
        let (height, half_rise) = (load(&self.height), load(&self.half_rise));
        let (a, b) = (sign * from, sign * to);
        let first = a.min(b).floor();
        let last = (a.max(b) + A_LITTLE).floor();
        let is_mirrored = 0.5 - 0.5 * sign;
        let c = sign * first - is_mirrored;
        let full = sign * height;
        let all = is_mirrored * full;
        let here = all + rounded_parts(simd, c, [from, to], height, half_rise);
        let next = all + rounded_parts(simd, c + sign, [from, to], height, half_rise);
        let mut steps = Steps { first: [0.0; 8], last: [0.0; 8], rises: [[0.0; 8]; 3] };
        first.store_slice(&mut steps.first);
        last.store_slice(&mut steps.last);
        here.store_slice(&mut steps.rises[0]);
        (next - here).store_slice(&mut steps.rises[1]);
        (full - next).store_slice(&mut steps.rises[2]);
        steps
    }
}
