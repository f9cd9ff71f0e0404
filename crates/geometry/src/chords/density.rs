//! How many chords a curve takes, and where.

use super::span::Cubic;
use super::wide::{LANES, lanes, larger, splat, spread};
use alloc::vec::Vec;
use fearless_simd::{Simd, f64x8, prelude::*};

/// How long a step of the parameter is at either end of a curve, where a vertex lies on it, against
/// the others, h: (2 + √2)/4.
///
/// Curve and chord are 4S·x·(1 − x) − D·x apart in a step with the sagitta S and vertices 0 and D off
/// the curve, x being 0 to 1 along it; at most (4S − D)²/(16·S). D is half the sagitta of a step h, so
/// that the largest distance is D as elsewhere if S = (3/4 + 1/√2)·D, and S goes with the square.
pub(super) const END_STEP: f64 = 0.25 * (2.0 + core::f64::consts::SQRT_2);

/// How much finer steps are than estimated: so few more chords save most second attempts.
pub(super) const MARGIN: f64 = 1.08;

/// Ranges of the parameter in which the density is taken to change evenly.
pub(super) const RANGES: usize = 12;

/// The ends of the ranges, and as many more as fill vectors.
const ENDS: [f64; 2 * LANES] = {
    let mut ends = [0.0; 2 * LANES];
    let mut i = 0;
    while i < ends.len() {
        ends[i] = i as f64 / RANGES as f64;
        i += 1;
    }
    ends
};

/// More turn per unit of the parameter is not made even finer steps for: half a turn in a range.
pub(super) const MOST_TURN: f64 = core::f64::consts::PI * RANGES as f64;

/// How many chords do for `steps` steps, of which those at the ends are shorter.
pub(super) fn count(steps: f64) -> u32 {
    // One chord has both its ends on the curve, and all of its sagitta on one side.
    if steps <= core::f64::consts::FRAC_1_SQRT_2 {
        return 1;
    }
    let count = steps + (2.0 - 2.0 * END_STEP);
    let whole = count as u32;
    whole.saturating_add(u32::from(f64::from(whole) < count)).max(2)
}

/// How many steps there are per unit of the parameter, all along a curve.
pub(super) struct Density {
    /// For each range: where it begins, the integral up to there, the density there, and by how much
    /// that rises per unit.
    ranges: [[f64; 4]; RANGES],
    /// The integral over all of the curve.
    steps: f64,
}

impl Density {
    /// For a stroke of the given half-width too: where two of its sides meet they are r/8 times the
    /// square of the turn off their arc, more than the middle line is. The turn is the second
    /// derivative across over the speed.
    #[inline(always)]
    pub(super) fn new<S: Simd>(simd: S, cubic: &Cubic, tolerance: f64, radius: f64) -> Self {
        let mut values = [0.0; 2 * LANES];
        let scale = MARGIN * MARGIN / (16.0 * tolerance);
        for (values, ends) in values.chunks_exact_mut(LANES).zip(ENDS.chunks_exact(LANES)) {
            let (across, turn) = cubic.bend(simd, f64x8::from_slice(simd, ends));
            let most = splat(simd, MOST_TURN);
            let turn = turn.simd_lt(most).select(turn, most);
            let across = across + splat(simd, 2.0 * radius) * turn * turn;
            (across * splat(simd, scale)).sqrt().store_slice(values);
        }
        let (mut ranges, mut sum) = ([[0.0; 4]; RANGES], 0.0);
        for (i, range) in ranges.iter_mut().enumerate() {
            let [value, next] = [values[i], values[i + 1]];
            *range = [ENDS[i], sum, value, (next - value) * RANGES as f64];
            sum += (value + next) * (0.5 / RANGES as f64);
        }
        Self { ranges, steps: sum }
    }

    pub(super) fn steps(&self) -> f64 {
        self.steps
    }

    /// The parameters between `count` chords; and one before them and one after, as if the curve
    /// went on with a step like the others. There may be more after that, which mean nothing.
    #[inline(always)]
    pub(super) fn places<S: Simd>(&self, simd: S, count: u32, out: &mut Vec<f64>) {
        let step = self.steps / (f64::from(count) - 2.0 + 2.0 * END_STEP);
        let inner = count as usize - 1;
        out.resize(2 + (count as usize).next_multiple_of(LANES), 0.0);
        out[0] = 0.0;
        for first in (0..inner).step_by(LANES) {
            let i = lanes(simd) + splat(simd, first as f64);
            let sums = (i + splat(simd, END_STEP)) * splat(simd, step);
            self.place(simd, sums).store_slice(&mut out[first + 1..first + 1 + LANES]);
        }
        let last = out[inner];
        out[inner + 1] = last + (1.0 - last) / END_STEP;
        if inner > 0 {
            let first = out[1];
            out[0] = first - first / END_STEP;
        }
    }

    /// Where the integral comes to `sums`.
    #[inline(always)]
    fn place<S: Simd>(&self, simd: S, sums: f64x8<S>) -> f64x8<S> {
        let [mut start, mut sum, mut value, mut slope] = spread(simd, self.ranges[0]);
        for range in &self.ranges[1..] {
            let next = spread(simd, *range);
            let is_beyond = next[1].simd_lt(sums);
            start = is_beyond.select(next[0], start);
            sum = is_beyond.select(next[1], sum);
            value = is_beyond.select(next[2], value);
            slope = is_beyond.select(next[3], slope);
        }
        // Where v·x + s·x²/2 comes to the rest, in the form that does not cancel.
        let rest = sums - sum;
        let two = splat(simd, 2.0);
        let squared = larger(value * value + two * slope * rest, splat(simd, 0.0));
        start + two * rest / (value + squared.sqrt())
    }
}
