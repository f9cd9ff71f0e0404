//! How many chords a curve takes, and where.

use super::span::Cubic;
use crate::math::sqrt;
use alloc::vec::Vec;

/// How long a step of the parameter is at either end of a curve, where a vertex lies on it, against
/// the others, h: (2 + √2)/4.
///
/// Curve and chord are 4S·x·(1 − x) − D·x apart in a step with the sagitta S and vertices 0 and D off
/// the curve, x being 0 to 1 along it; at most (4S − D)²/(16·S). D is half the sagitta of a step h, so
/// that the largest distance is D as elsewhere if S = (3/4 + 1/√2)·D, and S goes with the square.
pub(super) const END_STEP: f64 = 0.25 * (2.0 + core::f64::consts::SQRT_2);

/// How much finer steps are than estimated: so few more chords save most second attempts.
const MARGIN: f64 = 1.08;

/// Ranges of the parameter in which the density is taken to change evenly.
const RANGES: usize = 12;

/// More turn per unit of the parameter is not made even finer steps for: half a turn in a range.
const MOST_TURN: f64 = core::f64::consts::PI * RANGES as f64;

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
    /// At the ends of the ranges.
    values: [f64; RANGES + 1],
    /// Their integral up to there.
    sums: [f64; RANGES + 1],
}

impl Density {
    /// For a stroke of the given half-width too: where two of its sides meet they are r/8 times the
    /// square of the turn off their arc, more than the middle line is. The turn is the second
    /// derivative across over the speed.
    pub(super) fn new(cubic: &Cubic, tolerance: f64, radius: f64) -> Self {
        let scale = MARGIN * MARGIN / (16.0 * tolerance);
        let value = |i| {
            let (across, turn) = cubic.bend(i as f64 / RANGES as f64);
            let turn = turn.min(MOST_TURN);
            sqrt((across + 2.0 * radius * turn * turn) * scale)
        };
        let values: [f64; RANGES + 1] = core::array::from_fn(value);
        let mut sums = [0.0; RANGES + 1];
        for i in 0..RANGES {
            sums[i + 1] = sums[i] + (values[i] + values[i + 1]) * (0.5 / RANGES as f64);
        }
        Self { values, sums }
    }

    pub(super) fn steps(&self) -> f64 {
        self.sums[RANGES]
    }

    /// Pushes the parameters between `count` chords; and one before them and one after, as if the curve
    /// went on with a step like the others.
    pub(super) fn places(&self, count: u32, out: &mut Vec<f64>) {
        let step = self.steps() / (f64::from(count) - 2.0 + 2.0 * END_STEP);
        let begin = out.len();
        out.push(0.0);
        let mut range = 0;
        out.extend((1..count).map(|i| {
            let sum = (f64::from(i - 1) + END_STEP) * step;
            while range < RANGES - 1 && self.sums[range + 1] < sum {
                range += 1;
            }
            let (rest, value) = (sum - self.sums[range], self.values[range]);
            let slope = (self.values[range + 1] - value) * RANGES as f64;
            // Where v·x + s·x²/2 comes to the rest, in the form that does not cancel.
            let root = sqrt((value * value + 2.0 * slope * rest).max(0.0));
            range as f64 / RANGES as f64 + 2.0 * rest / (value + root)
        }));
        let last = out[out.len() - 1];
        out.push(last + (1.0 - last) / END_STEP);
        if count > 1 {
            let first = out[begin + 1];
            out[begin] = first - first / END_STEP;
        }
    }
}
