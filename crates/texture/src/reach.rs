//! Which levels a sampler reads, from how large its footprints are.

use crate::covariance::Covariance;
use crate::ewa::{Limits, auto_pick};
use crate::{Kernel, LevelMode, Levels, Magnify, PixelFilter, Sampler};
use scumble_geometry::Matrix2;

/// More than any pyramid has.
const FARTHEST: usize = 63;

impl Sampler {
    /// The levels to build for footprints whose axes have bounds: for a picture of which it is known
    /// beforehand how near the texture is.
    ///
    /// `most` are upper bounds of the axes (s₁, s₂) of
    /// [`Matrix2::axes`](scumble_geometry::Matrix2::axes), the major first, in texels of the image per
    /// pixel. No coarser level than those of the result is read. Finer ones than are read are among them:
    /// a texture without its level 0 takes its first level for the image, which is not the same.
    ///
    /// ```
    /// use scumble_texture::{Levels, Sampler};
    ///
    /// // Magnified, no pyramid is read; at an eighth of the size, two levels beside the image.
    /// assert_eq!(Sampler::DEFAULT.levels_for([0.3, 0.3]), Levels::BaseOnly);
    /// assert_eq!(Sampler::DEFAULT.levels_for([8.0, 8.0]), Levels::Range { first: 0, last: 2 });
    /// ```
    #[must_use]
    pub fn levels_for(&self, most: [f64; 2]) -> Levels {
        if self.level == LevelMode::Zero {
            return Levels::BaseOnly;
        }
        let by_ellipse = self.pixel == PixelFilter::Ewa
            && self.level == LevelMode::Auto
            && self.kernel == Kernel::Gaussian
            && !matches!(self.magnify, Magnify::Radial(_));
        let last = if by_ellipse && most.iter().all(|s| s.is_finite()) {
            let (last, blends) = self.level_of(most);
            last + usize::from(blends)
        } else if self.pixel != PixelFilter::Classic && most[0] <= 1.0 {
            0
        } else {
            FARTHEST
        };
        match last {
            0 => Levels::BaseOnly,
            FARTHEST.. => Levels::All,
            last => Levels::Range { first: 0, last },
        }
    }

    /// The level of an ellipse with these axes, and whether it blends with the next.
    fn level_of(&self, [major, minor]: [f64; 2]) -> (usize, bool) {
        let limits = Limits::new(self);
        let jacobian = Matrix2::new(major.max(0.0), 0.0, 0.0, minor.max(0.0));
        let (_, variance) = Covariance::of(&jacobian, limits.inverse_ratio);
        let pick = auto_pick(variance * limits.inverse_least, FARTHEST, limits.blend);
        (pick.level, pick.coarser > 0.0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn magnified_is_level_zero_and_the_horizon_is_all() {
        let far = [f64::INFINITY; 2];
        for s in [Sampler::FAST, Sampler::DEFAULT, Sampler::HIGH, Sampler::REFERENCE] {
            assert_eq!(s.levels_for([0.2, 0.2]), Levels::BaseOnly);
            for endless in [far, [f64::INFINITY, 0.1], [f64::NAN; 2]] {
                assert_eq!(s.levels_for(endless), Levels::All);
            }
        }
        let bilinear = Sampler::DEFAULT.with(PixelFilter::Bilinear, LevelMode::Auto);
        assert_eq!(bilinear.levels_for([1.0, 1.0]), Levels::BaseOnly);
        assert_eq!(bilinear.levels_for([1.1, 1.0]), Levels::All);
        let zero = Sampler { level: LevelMode::Zero, ..Sampler::DEFAULT };
        assert_eq!(zero.levels_for(far), Levels::BaseOnly);
    }

    #[test]
    fn the_clamp_on_the_axis_ratio_counts() {
        // 64 by 1 is widened to 64 by 4 by a ratio of 16.
        let thin = Sampler::FAST.levels_for([64.0, 1.0]);
        assert_eq!(thin, Sampler::FAST.levels_for([64.0, 4.0]));
        assert_ne!(thin, Sampler::FAST.levels_for([64.0, 64.0]));
    }
}
