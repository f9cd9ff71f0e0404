//! Which levels a sampler reads, from how large its footprints are.

use crate::covariance::Covariance;
use crate::ewa::{Limits, auto_pick};
use crate::magnify::MINIFIED;
use crate::square;
use crate::{Kernel, LevelMode, Levels, Magnify, PixelFilter, Sampler};
use scumble_geometry::Matrix2;

/// What single precision may take an axis to be too long or too short, and more.
const ROUNDING: f64 = 1e-6;

/// More than any pyramid has.
const FARTHEST: usize = 63;

impl Sampler {
    /// The levels to build for footprints whose axes have bounds: for a picture of which it is known
    /// beforehand how near the texture is.
    ///
    /// `least` and `most` are lower and upper bounds of the axes (s₁, s₂) of
    /// [`Matrix2::axes`](scumble_geometry::Matrix2::axes), the major first, in texels of the image per
    /// pixel. No other level than those of the result is read, so samples are those of the whole
    /// pyramid. Lower bounds that are not known are 0.
    ///
    /// ```
    /// use scumble_texture::{Levels, Sampler};
    ///
    /// // Magnified, no pyramid is read; at an eighth of the size only level 2, where a pixel is two texels
    /// // wide.
    /// let levels = |s| Sampler::FAST.levels_for([s, s], [s, s]);
    /// assert_eq!(levels(0.3), Levels::BaseOnly);
    /// assert_eq!(levels(8.0), Levels::Range { first: 2, last: 2 });
    /// ```
    #[must_use]
    pub fn levels_for(&self, least: [f64; 2], most: [f64; 2]) -> Levels {
        if self.level == LevelMode::Zero {
            return Levels::BaseOnly;
        }
        let by_area = self.pixel == PixelFilter::Ewa
            && self.level == LevelMode::Auto
            && matches!(self.kernel, Kernel::Gaussian | Kernel::Box)
            && !matches!(self.magnify, Magnify::Radial(_));
        let last = if by_area && most.iter().all(|s| s.is_finite()) {
            let (last, blends) = self.level_of(most.map(|s| s * (1.0 + ROUNDING)));
            last + usize::from(blends)
        } else if self.pixel != PixelFilter::Classic && most[0] <= 1.0 {
            0
        } else {
            FARTHEST
        };
        // What is magnified on its own reads the image.
        let apart = self.magnify.is_apart() && !self.takes_squares();
        let minified = !apart || least[0] >= f64::from(MINIFIED);
        let first = if by_area && minified {
            self.level_of(least.map(|s| s * (1.0 - ROUNDING))).0.min(last)
        } else {
            0
        };
        match (first, last) {
            (_, 0) => Levels::BaseOnly,
            (0, FARTHEST..) => Levels::All,
            (first, last) => Levels::Range { first, last },
        }
    }

    /// The level of an ellipse or a square with these axes, and whether it blends with the next.
    fn level_of(&self, [major, minor]: [f64; 2]) -> (usize, bool) {
        let limits = Limits::new(self);
        let jacobian = Matrix2::new(major.max(0.0), 0.0, 0.0, minor.max(0.0));
        let pick = if self.kernel == Kernel::Box {
            square::level_of(&jacobian, &limits, [0, FARTHEST])
        } else {
            let (_, variance) = Covariance::of(&jacobian, limits.inverse_ratio);
            auto_pick(variance * limits.inverse_least, [0, FARTHEST], limits.blend)
        };
        (pick.level, pick.coarser > 0.0)
    }

    /// Whether all that an area is averaged by is the pixel's square: sixteen taps are of the Gaussian.
    pub(crate) fn takes_squares(&self) -> bool {
        self.kernel == Kernel::Box && matches!(self.magnify, Magnify::None | Magnify::Taps)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn magnified_is_level_zero_and_the_horizon_is_all() {
        let far = [f64::INFINITY; 2];
        for s in [Sampler::FAST, Sampler::DEFAULT, Sampler::HIGH, Sampler::REFERENCE] {
            assert_eq!(s.levels_for([0.0; 2], [0.2, 0.2]), Levels::BaseOnly);
            for endless in [far, [f64::INFINITY, 0.1], [f64::NAN; 2]] {
                assert_eq!(s.levels_for([0.0; 2], endless), Levels::All);
            }
        }
        let bilinear = Sampler::DEFAULT.with(PixelFilter::Bilinear, LevelMode::Auto);
        assert_eq!(bilinear.levels_for([1.0; 2], [1.0; 2]), Levels::BaseOnly);
        assert_eq!(bilinear.levels_for([1.0; 2], [1.1, 1.0]), Levels::All);
        let square = Sampler { kernel: Kernel::Box, ..Sampler::DEFAULT };
        assert_eq!(square.levels_for([4.0; 2], [4.0; 2]), Levels::BaseOnly);
        assert_eq!(square.levels_for([10.0; 2], [12.0; 2]), Levels::Range { first: 1, last: 1 });
        assert_eq!(square.levels_for([0.0; 2], far), Levels::All);
        let zero = Sampler { level: LevelMode::Zero, ..Sampler::DEFAULT };
        assert_eq!(zero.levels_for(far, far), Levels::BaseOnly);
    }

    #[test]
    fn levels_that_are_finer_than_all_footprints_are_left_out() {
        let of = |s: Sampler, least: f64| s.levels_for([least; 2], [20.0; 2]);
        assert_eq!(of(Sampler::FAST, 20.0), Levels::Range { first: 4, last: 4 });
        assert_eq!(of(Sampler::FAST, 1.0), Levels::Range { first: 0, last: 4 });
        // What is magnified on its own reads the image.
        let sharp = Sampler { magnify: Magnify::CatmullRom, ..Sampler::FAST };
        assert_eq!(of(sharp, 1.4), Levels::Range { first: 0, last: 4 });
        assert_eq!(of(sharp, 5.0), of(Sampler::FAST, 5.0));
        let unknown = Sampler::FAST.levels_for([f64::NAN; 2], [20.0; 2]);
        assert_eq!(unknown, Levels::Range { first: 0, last: 4 });
    }

    #[test]
    fn the_clamp_on_the_axis_ratio_counts() {
        // 64 by 1 is widened to 64 by 4 by a ratio of 16.
        let of = |axes| Sampler::FAST.levels_for([0.0; 2], axes);
        assert_eq!(of([64.0, 1.0]), of([64.0, 4.0]));
        assert_ne!(of([64.0, 1.0]), of([64.0, 64.0]));
    }
}
