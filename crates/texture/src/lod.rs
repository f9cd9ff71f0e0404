//! Which levels are read when the level does not come from the ellipse.

use crate::covariance::single;
use crate::number::Number;
use crate::{Footprint, LevelMode};
use core::f32::consts::{LOG2_E, SQRT_2};

/// One or two neighbouring levels.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(crate) struct Pick {
    /// The finer level, counted from the first that is kept.
    pub(crate) level: usize,
    /// The weight of level + 1, in [0, 1); the finer level has the rest.
    pub(crate) coarser: f32,
}

/// The square of the longer column of a Jacobian by rows: how far, in texels, a step of one pixel along x
/// or y goes. Not finite where it is not.
#[inline(always)]
pub(crate) fn longest_step_squared<N: Number>([a, b, c, d]: [N; 4]) -> N {
    let (x, y) = (a * a + c * c, b * b + d * d);
    (x - y).if_positive(x, y) + (x + y) * 0.0
}

/// The levels for a footprint, of those from the first to the last that are kept; a Jacobian that is not
/// finite goes to the last. [`LevelMode::Auto`] does not come here.
#[inline(always)]
pub(crate) fn pick(f: &Footprint, mode: LevelMode, range: [usize; 2]) -> Pick {
    let step = longest_step_squared(single(&f.jacobian));
    let [level, coarser] = levels(step, mode, range.map(|level| level as f32));
    // No pyramid has so many levels that this is not exact.
    Pick { level: level as usize, coarser }
}

/// The two numbers of a [`Pick`], for a squared step.
#[inline(always)]
pub(crate) fn levels<N: Number>(step: N, mode: LevelMode, [first, last]: [f32; 2]) -> [N; 2] {
    let (zero, last) = (step.all(0.0), step.all(last));
    let level = match mode {
        LevelMode::Zero => return [zero; 2],
        // D ≥ k + ½ means that the squared step is at least 2·4ᵏ: exact, without a logarithm.
        LevelMode::Nearest => half_octaves(step * 2.0),
        _ => half_octaves(step),
    };
    let level = level.at_least(step.all(first)).at_most(last);
    if mode == LevelMode::Nearest {
        return [level - first, zero];
    }
    // Rounding may put D a last bit outside the level.
    let coarser = (detail(step) - level).at_least(zero).at_most(step.all(MOST));
    [level - first, (last - level).if_positive(coarser, zero)]
}

/// The largest weight below 1.
const MOST: f32 = 1.0 - 0.5 * f32::EPSILON;

/// D = log₂ of the longest step, from its square; 0 for a step of at most one texel, and for one that is
/// not a number.
#[inline(always)]
fn detail<N: Number>(step: N) -> N {
    (step - 1.0).if_positive(log2(step) * 0.5, step.all(0.0))
}

/// ⌊log₄ x⌋ of an x ≥ 0, 0 and below for an x below 4; more than any level for one that is not finite.
#[inline(always)]
fn half_octaves<N: Number>(x: N) -> N {
    let [exponent, _] = x.parts();
    (exponent * 0.5).floor()
}

/// log₂ x of a normal positive x; the absolute error is below 2e−6. A large number for ∞.
///
/// The mantissa m, brought to [√½, √2), goes through ln m = 2·artanh((m − 1)/(m + 1)), whose series in
/// z² ≤ 0.0295 is cut at z⁷.
#[inline(always)]
fn log2<N: Number>(x: N) -> N {
    let [exponent, mantissa] = x.parts();
    let above = mantissa - SQRT_2;
    let exponent = above.if_positive(exponent + 1.0, exponent);
    let mantissa = above.if_positive(mantissa * 0.5, mantissa);
    let z = (mantissa - 1.0) / (mantissa + 1.0);
    let z2 = z * z;
    let series = z2 * (1.0 / 7.0) + 1.0 / 5.0;
    let series = (series * z2 + 1.0 / 3.0) * z2 + 1.0;
    exponent + z * (2.0 * LOG2_E) * series
}

#[cfg(test)]
mod tests {
    use super::*;
    use scumble_geometry::Matrix2;

    #[test]
    fn levels_follow_the_longest_step() {
        let pick = |length: f64, mode| {
            let jacobian = Matrix2::new(length, 0.0, 0.0, 0.0);
            pick(&Footprint { jacobian, ..Footprint::point(0.0, 0.0) }, mode, [0, 5])
        };
        let near = |length| pick(length, LevelMode::Nearest).level;
        assert_eq!([0.0, 1.0, 1.41, 1.42, 2.0, 2.82, 2.83].map(near), [0, 0, 0, 1, 1, 1, 2]);
        assert_eq!([1e30, f64::INFINITY, f64::NAN].map(near), [5, 5, 5]);
        let linear = |length| pick(length, LevelMode::Linear);
        assert_eq!(linear(0.5), Pick { level: 0, coarser: 0.0 });
        assert_eq!(linear(4.0), Pick { level: 2, coarser: 0.0 });
        assert_eq!(linear(6.0).level, 2);
        assert!((linear(6.0).coarser - 0.584_962_5).abs() < 1e-6);
        assert_eq!(linear(1e9), Pick { level: 5, coarser: 0.0 });
        assert_eq!(linear(f64::NAN), Pick { level: 5, coarser: 0.0 });
        assert_eq!(pick(1e9, LevelMode::Zero), Pick { level: 0, coarser: 0.0 });
    }

    #[test]
    fn logarithms_are_as_near_as_stated() {
        for i in 1..40_000u16 {
            for x in [f32::from(i) * 0.37e-3, f32::from(i) * 1e7] {
                let truth = f64::from(x).log2();
                assert!((f64::from(log2(x)) - truth).abs() < 2e-6, "{x}");
            }
        }
        assert_eq!([0.25, 1.0, 8.0].map(log2), [-2.0, 0.0, 3.0]);
    }

    #[test]
    fn a_step_that_is_not_finite_stays_so() {
        let step = |j: [f32; 4]| longest_step_squared(j);
        assert_eq!(step([3.0, 1.0, 4.0, 2.0]), 25.0);
        assert_eq!(step([1.0, 3.0, 2.0, 4.0]), 25.0);
        for lost in [f32::NAN, f32::INFINITY] {
            for i in 0..4 {
                let mut j = [1.0; 4];
                j[i] = lost;
                assert!(!step(j).is_finite(), "{lost} {i}");
            }
        }
    }
}
