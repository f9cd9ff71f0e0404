//! Which levels are read when the level does not come from the ellipse.

use crate::math::log2;
use crate::{Footprint, LevelMode};

/// One or two neighbouring levels.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(crate) struct Pick {
    /// The finer level.
    pub(crate) level: usize,
    /// The weight of level + 1, in [0, 1); the finer level has the rest.
    pub(crate) coarser: f32,
}

/// The levels for a footprint, of `count` that there are. D = log₂ of the longest step, clamped;
/// a step that is not finite goes to the coarsest level. [`LevelMode::Auto`] does not come here.
#[inline(always)]
pub(crate) fn pick(f: &Footprint, mode: LevelMode, count: usize) -> Pick {
    let last = count - 1;
    let only = |level| Pick { level, coarser: 0.0 };
    if mode == LevelMode::Zero {
        return only(0);
    }
    let step = f.longest_step_squared();
    if !step.is_finite() {
        return only(last);
    }
    match mode {
        // D ≥ k + ½ means that the squared step is at least 2·4ᵏ: exact, without a logarithm.
        LevelMode::Nearest => only(half_octaves(2.0 * step).min(last)),
        _ if step <= 1.0 => only(0),
        _ => {
            let d = 0.5 * log2(step);
            let level = d as usize;
            if level >= last {
                return only(last);
            }
            Pick { level, coarser: (d - level as f64) as f32 }
        }
    }
}

/// max(0, ⌊log₄ x⌋) of a finite x ≥ 0, from the exponent's bits.
#[inline(always)]
pub(crate) fn half_octaves(x: f64) -> usize {
    (((x.to_bits() >> 52) as usize).saturating_sub(1023)) / 2
}

#[cfg(test)]
mod tests {
    use super::*;
    use scumble_geometry::Matrix2;

    fn step(length: f64) -> Footprint {
        let jacobian = Matrix2::new(0.0, length, 0.1, 0.0);
        Footprint { u: 0.0, v: 0.0, jacobian }
    }

    #[test]
    fn levels_follow_the_longest_step() {
        let near = |length| pick(&step(length), LevelMode::Nearest, 6).level;
        assert_eq!([0.0, 1.0, 1.41, 1.42, 2.0, 2.82, 2.83].map(near), [0, 0, 0, 1, 1, 1, 2]);
        assert_eq!([1e30, f64::INFINITY, f64::NAN].map(near), [5, 5, 5]);
        let linear = |length| pick(&step(length), LevelMode::Linear, 6);
        assert_eq!(linear(0.5), Pick { level: 0, coarser: 0.0 });
        assert_eq!(linear(4.0), Pick { level: 2, coarser: 0.0 });
        assert_eq!(linear(6.0).level, 2);
        assert!((linear(6.0).coarser - 0.584_962_5).abs() < 1e-6);
        assert_eq!(linear(1e9), Pick { level: 5, coarser: 0.0 });
        assert_eq!(linear(f64::NAN), Pick { level: 5, coarser: 0.0 });
        assert_eq!(pick(&step(1e9), LevelMode::Zero, 6), Pick { level: 0, coarser: 0.0 });
    }
}
