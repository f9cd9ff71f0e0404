//! Weights of one kernel, or of two blended, and the sums that they make.

use crate::gaussian::widening;
use crate::kernel::TOGETHER;
use crate::math::sqrt;
use crate::{Kernel, Magnify, PixelFilter, Sampler};

/// The weights of one footprint.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Mixture {
    kernel: Kernel,
    /// The factor of its weights.
    far: f32,
    /// What its r² is multiplied by: the Gaussian of the ellipses is wider, for it is cut.
    narrowing: f32,
    /// Beyond this r² its weights are 0: the Gaussian is cut where the sampler says.
    cut: f32,
    /// The kernel for magnification, and the factor of its weights.
    magnified: Option<(Kernel, f32)>,
}

impl Mixture {
    /// For a footprint that is so much magnified, in 0…1.
    #[inline(always)]
    pub(crate) fn new(s: &Sampler, nearness: f32) -> Self {
        // In this order a NaN becomes the lower bound.
        let sigmas = s.radius.max(2.0);
        let cut = match s.kernel {
            Kernel::Gaussian => 0.25 * sigmas.min(4.0) * sigmas.min(4.0),
            other => other.radius() * other.radius(),
        };
        let narrowing = match (s.kernel, s.pixel) {
            (_, PixelFilter::Classic) => 1.0,
            (Kernel::Gaussian, _) => 1.0 / widening(f64::from(sigmas.min(4.0))) as f32,
            _ => 1.0,
        };
        let one = Self { kernel: s.kernel, far: 1.0, narrowing, cut, magnified: None };
        match s.magnify {
            Magnify::Radial(kernel) if nearness > 0.0 => Self {
                far: (1.0 - nearness) / s.kernel.integral(),
                magnified: Some((kernel, nearness / kernel.integral())),
                ..one
            },
            _ => one,
        }
    }

    /// Where the weights end.
    #[inline(always)]
    pub(crate) fn radius(&self) -> f64 {
        let other = self.magnified.map_or(0.0, |(kernel, _)| f64::from(kernel.radius()));
        sqrt(f64::from(self.cut)).max(other)
    }

    /// The weights at squared distances, in their place: [`Mixture::weight`].
    #[inline(always)]
    pub(crate) fn weigh(&self, r2: &mut [f32; TOGETHER]) {
        let squares = *r2;
        for r2 in r2.iter_mut() {
            *r2 *= self.narrowing;
        }
        self.kernel.weigh(r2);
        for (weight, square) in r2.iter_mut().zip(squares) {
            *weight = if square <= self.cut { *weight } else { 0.0 };
        }
        if let Some((kernel, near)) = self.magnified {
            let mut others = squares;
            kernel.weigh(&mut others);
            for (far, other) in r2.iter_mut().zip(others) {
                *far = near * other + self.far * *far;
            }
        }
    }

    /// The weight at a squared distance.
    #[inline(always)]
    pub(crate) fn weight(&self, r2: f32) -> f32 {
        let far = if r2 <= self.cut { self.kernel.weight(r2 * self.narrowing) } else { 0.0 };
        match self.magnified {
            Some((kernel, near)) => near * kernel.weight(r2) + self.far * far,
            None => far,
        }
    }
}

/// Below this part of the sum of the weights' magnitudes, their sum says nothing, and the texel in
/// the middle is taken.
const LEAST_SUM: f32 = 0.05;

/// Σ w·(t − centre), Σ w and Σ |w|.
pub(crate) struct Sums {
    centre: [f32; 4],
    texels: [f32; 4],
    total: f32,
    magnitude: f32,
}

impl Sums {
    /// About a texel.
    #[inline(always)]
    pub(crate) fn new(centre: [f32; 4]) -> Self {
        Self { centre, texels: [0.0; 4], total: 0.0, magnitude: 0.0 }
    }

    #[inline(always)]
    pub(crate) fn add(&mut self, weight: f32, texel: [f32; 4]) {
        self.total += weight;
        self.magnitude += weight.abs();
        for ((sum, texel), centre) in self.texels.iter_mut().zip(texel).zip(self.centre) {
            *sum += weight * (texel - centre);
        }
    }

    #[inline(always)]
    pub(crate) fn finish(self) -> [f32; 4] {
        // Written so that two zeros, and a NaN, take the middle.
        if self.total > LEAST_SUM * self.magnitude {
            core::array::from_fn(|c| self.centre[c] + self.texels[c] / self.total)
        } else {
            self.centre
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn weights_found_together_are_those_found_alone(
            kernel in prop::sample::select(&Kernel::ALL),
            magnified in prop::option::of(prop::sample::select(&Kernel::ALL)),
            nearness in 0.0..=1.0f32,
            radius in 2.0..4.0f32,
            squares in prop::array::uniform8(0.0..12.0f32),
        ) {
            let magnify = magnified.map_or(Magnify::None, Magnify::Radial);
            let sampler = Sampler { kernel, magnify, radius, ..Sampler::DEFAULT };
            let mixture = Mixture::new(&sampler, nearness);
            let mut found = squares;
            mixture.weigh(&mut found);
            let expected = squares.map(|r2| mixture.weight(r2));
            prop_assert_eq!(found.map(f32::to_bits), expected.map(f32::to_bits));
        }
    }
}
