use fearless_simd::{Simd, f64x8, prelude::*};
use scumble_pixel::Premul;

/// What lies beyond the edge of a texture.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub enum Wrap {
    /// The texel at the edge, for ever.
    #[default]
    Clamp,
    /// The texture again: tiles.
    Repeat,
    /// The texture mirrored, then again: tiles whose edges meet.
    Mirror,
    /// One colour, in the working space.
    Constant(Premul),
}

/// Positions farther out than this many texels are brought back to it (clamp and constant), and a
/// Jacobian with a larger component counts as infinite. Twice the side of the largest texture.
pub(crate) const FAR: f64 = 1_073_741_824.0;

impl Wrap {
    /// The texel that stands at index `i` of an axis with `n` texels; `None` for the constant.
    #[inline(always)]
    pub(crate) fn resolve(self, i: i32, n: usize) -> Option<usize> {
        let size = n as i32;
        if (0..size).contains(&i) {
            return Some(i as usize);
        }
        match self {
            Self::Clamp => Some(i.clamp(0, size - 1) as usize),
            Self::Repeat => Some(i.rem_euclid(size) as usize),
            Self::Mirror => {
                // Sizes are below 2²⁹.
                let k = i.rem_euclid(2 * size);
                Some(k.min(2 * size - 1 - k) as usize)
            }
            Self::Constant(_) => None,
        }
    }

    /// The colour outside, for the wrap that has one.
    pub(crate) fn border(self) -> [f32; 4] {
        match self {
            Self::Constant(c) => c.0,
            _ => [0.0; 4],
        }
    }
}

/// Brings positions along one axis so near that an index fits an integer: by whole periods where the
/// wrap has one, else to within [`FAR`]. Prepared once, and without a branch on the position.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Nearer {
    periodic: bool,
    period: f64,
    inverse: f64,
    /// Where the mirror stands, whose far side ends with the period.
    mirror: Option<f64>,
}

impl Nearer {
    /// For an axis of `n` texels.
    pub(crate) fn new(wrap: Wrap, n: usize) -> Self {
        let period = match wrap {
            Wrap::Clamp | Wrap::Constant(_) => 1.0,
            Wrap::Repeat => n as f64,
            Wrap::Mirror => 2.0 * n as f64,
        };
        let periodic = matches!(wrap, Wrap::Repeat | Wrap::Mirror);
        let mirror = (wrap == Wrap::Mirror).then_some(n as f64);
        Self { periodic, period, inverse: 1.0 / period, mirror }
    }

    /// The same place on the axis; anything at all for a position that is not finite.
    #[inline(always)]
    pub(crate) fn bring(&self, u: f64) -> f64 {
        if self.periodic {
            // The bounds catch the last bit of the product, and positions of 2⁵² periods and more.
            (u - self.period * crate::math::floor(u * self.inverse)).max(0.0).min(self.period)
        } else {
            u.clamp(-FAR, FAR)
        }
    }

    /// What stands in the texture itself for a place that was brought near, and the sign of a step there:
    /// a place in the mirror is seen in front of it, where one goes the other way.
    #[inline(always)]
    pub(crate) fn before_mirror(&self, u: f64) -> (f64, f64) {
        match self.mirror {
            Some(mirror) if u > mirror => (self.period - u, -1.0),
            _ => (u, 1.0),
        }
    }

    /// [`Nearer::before_mirror`] of eight, if there is a mirror.
    #[inline(always)]
    pub(crate) fn before_mirror_lanes<S: Simd>(
        &self,
        simd: S,
        u: f64x8<S>,
    ) -> Option<(f64x8<S>, f64x8<S>)> {
        let behind = u.simd_gt(self.mirror?);
        let one = f64x8::splat(simd, 1.0);
        let place = behind.select(f64x8::splat(simd, self.period) - u, u);
        Some((place, behind.select(-one, one)))
    }

    /// [`Nearer::bring`] of eight; anything at all for those that are not finite.
    #[inline(always)]
    pub(crate) fn bring_lanes<S: Simd>(&self, simd: S, u: f64x8<S>) -> f64x8<S> {
        let (at, low, high) = if self.periodic {
            (u - (u * self.inverse).floor() * self.period, 0.0, self.period)
        } else {
            (u, -FAR, FAR)
        };
        at.max(f64x8::splat(simd, low)).min(f64x8::splat(simd, high))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_wrap_on_three_texels() {
        let row = |w: Wrap| -> Vec<Option<usize>> { (-5..8).map(|i| w.resolve(i, 3)).collect() };
        let some = |v: [usize; 13]| v.map(Some).to_vec();
        assert_eq!(row(Wrap::Clamp), some([0, 0, 0, 0, 0, 0, 1, 2, 2, 2, 2, 2, 2]));
        assert_eq!(row(Wrap::Repeat), some([1, 2, 0, 1, 2, 0, 1, 2, 0, 1, 2, 0, 1]));
        assert_eq!(row(Wrap::Mirror), some([1, 2, 2, 1, 0, 0, 1, 2, 2, 1, 0, 0, 1]));
        let outside = row(Wrap::Constant(Premul::TRANSPARENT));
        assert_eq!(outside.iter().flatten().count(), 3);
    }

    #[test]
    fn far_positions_come_near_and_near_ones_stay() {
        for wrap in [Wrap::Clamp, Wrap::Repeat, Wrap::Mirror] {
            let near = Nearer::new(wrap, 3);
            assert_eq!(near.bring(1.25), 1.25);
            for far in [1e18, -1e18, 1e300, -1e300] {
                assert!(near.bring(far).abs() <= FAR);
            }
        }
        assert_eq!(Nearer::new(Wrap::Repeat, 3).bring(-0.75), 2.25);
        assert_eq!(Nearer::new(Wrap::Mirror, 3).bring(-0.75), 5.25);
    }
}
