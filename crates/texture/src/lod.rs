//! Which levels are read when the level does not come from the ellipse.

use crate::LevelMode;
use crate::math::log2;

/// One or two neighbouring levels.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(crate) struct Pick {
    /// The finer level, counted from the first that is kept.
    pub(crate) level: usize,
    /// The weight of level + 1, in [0, 1); the finer level has the rest.
    pub(crate) coarser: f32,
}

/// D = log₂ of the longest step, from its square; 0 for a step of at most one texel, and anything for
/// one that is not finite. No branch: a loop over many is one of vectors.
#[inline(always)]
pub(crate) fn detail(step: f64) -> f64 {
    let d = 0.5 * log2(step);
    // At most what no pyramid has: it must not become a NaN.
    if step > 1.0 { if step < 1e30 { d } else { 50.0 } } else { 0.0 }
}

/// The levels for a squared step and its [`detail`] (for [`LevelMode::Linear`] alone), of those from
/// `first` to `last` that are kept; a step that is not finite goes to the last. [`LevelMode::Auto`] does not come here.
#[inline(always)]
pub(crate) fn pick(step: f64, detail: f64, mode: LevelMode, [first, last]: [usize; 2]) -> Pick {
    let level = match mode {
        LevelMode::Zero => first,
        // D ≥ k + ½ means that the squared step is at least 2·4ᵏ: exact, without a logarithm.
        LevelMode::Nearest => half_octaves(2.0 * step).max(first).min(last),
        _ => half_octaves(step).max(first).min(last),
    };
    let blends = mode == LevelMode::Linear && level < last;
    // Rounding may put D a last bit outside the level.
    let coarser = (detail - level as f64).max(0.0) as f32;
    Pick { level: level - first, coarser: if blends { coarser.min(MOST) } else { 0.0 } }
}

/// The largest weight below 1.
const MOST: f32 = 1.0 - 0.5 * f32::EPSILON;

/// max(0, ⌊log₄ x⌋) of an x ≥ 0, from the exponent's bits; more than any level for one that is not
/// finite.
#[inline(always)]
fn half_octaves(x: f64) -> usize {
    ((x.to_bits() >> 52) as u32).saturating_sub(1023) as usize / 2
}

#[cfg(test)]
mod tests {
    use super::*;
    #[test]
    fn levels_follow_the_longest_step() {
        let pick = |length: f64, mode| pick(length * length, detail(length * length), mode, [0, 5]);
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
}
