//! Which levels a sampler reads, from how large its footprints are.

use crate::covariance::Covariance;
use crate::ewa::{Limits, auto_pick};
use crate::{Kernel, LevelMode, Levels, Magnify, PixelFilter, Sampler};
use scumble_geometry::Matrix2;

/// Texels per pixel along the major axis below which something of a footprint may count as magnified,
/// with a margin.
const MAGNIFIED: f64 = 2.0;

/// More than any pyramid has.
const FARTHEST: usize = 63;

impl Sampler {
    /// The levels to build for footprints whose axes lie between bounds: for a picture of which it is
    /// known beforehand how far the texture is away.
    ///
    /// `least` and `most` are lower and upper bounds of the axes (s₁, s₂) of
    /// [`Matrix2::axes`](scumble_geometry::Matrix2::axes), the major first, in texels of the image per
    /// pixel. The elliptical filter with the Gaussian, its level chosen by the ellipse, reads the levels of
    /// the result and no others, so that its samples are those of the whole pyramid but for the last bit.
    /// For other filters the result may hold finer levels than are read.
    ///
    /// ```
    /// use scumble_texture::{Levels, Sampler};
    ///
    /// // Magnified, no pyramid is read; an eighth of the size, no fine level.
    /// assert_eq!(Sampler::DEFAULT.levels_for([0.2, 0.2], [0.3, 0.3]), Levels::BaseOnly);
    /// let small = Sampler::DEFAULT.levels_for([8.0, 8.0], [8.0, 8.0]);
    /// assert_eq!(small, Levels::Range { first: 2, last: 3 });
    /// ```
    #[must_use]
    pub fn levels_for(&self, least: [f64; 2], most: [f64; 2]) -> Levels {
        if self.level == LevelMode::Zero {
            return Levels::BaseOnly;
        }
        let by_ellipse = self.pixel == PixelFilter::Ewa
            && self.level == LevelMode::Auto
            && self.kernel == Kernel::Gaussian
            && !matches!(self.magnify, Magnify::Radial(_));
        let (first, last) = if by_ellipse {
            // A NaN is magnified, too.
            let magnifies = self.magnify != Magnify::None && least[0].max(0.0) < MAGNIFIED;
            let first = if magnifies { 0 } else { self.level_of(least).0 };
            let bounded = most.iter().all(|s| s.is_finite());
            let (last, blends) = if bounded { self.level_of(most) } else { (FARTHEST, false) };
            (first, last + usize::from(blends))
        } else if self.pixel != PixelFilter::Classic && most[0] <= 1.0 {
            (0, 0)
        } else {
            (0, FARTHEST)
        };
        match (first, last) {
            (_, 0) => Levels::BaseOnly,
            (0, FARTHEST..) => Levels::All,
            _ => Levels::Range { first, last },
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
            assert_eq!(s.levels_for([0.1, 0.1], [0.2, 0.2]), Levels::BaseOnly);
            assert_eq!(s.levels_for([0.1, 0.1], far), Levels::All);
            assert_eq!(s.levels_for([f64::NAN; 2], far), Levels::All);
        }
        let bilinear = Sampler::DEFAULT.with(PixelFilter::Bilinear, LevelMode::Auto);
        assert_eq!(bilinear.levels_for([0.5, 0.5], [1.0, 1.0]), Levels::BaseOnly);
        assert_eq!(bilinear.levels_for([0.5, 0.5], [1.1, 1.0]), Levels::All);
        let zero = Sampler { level: LevelMode::Zero, ..Sampler::DEFAULT };
        assert_eq!(zero.levels_for([9.0, 9.0], far), Levels::BaseOnly);
    }

    #[test]
    fn the_clamp_on_the_axis_ratio_counts() {
        // 64 by 1 is widened to 64 by 4 by a ratio of 16.
        let thin = Sampler::FAST.levels_for([64.0, 1.0], [64.0, 1.0]);
        let wide = Sampler::FAST.levels_for([64.0, 4.0], [64.0, 4.0]);
        assert_eq!(thin, wide);
        assert_ne!(thin, Levels::All);
    }
}
