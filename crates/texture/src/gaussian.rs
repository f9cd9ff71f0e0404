use crate::Sampler;
use crate::math::exp;
use crate::texel::ROUNDER;

/// What the Gaussian's variance is multiplied by, so that it is not much too narrow where it is cut at
/// `radius` σ.
///
/// Of a round Gaussian the cut takes the part t·e⁻ᵗ/(1 − e⁻ᵗ) of the variance, t = ½R²: 4 % at 3.08 σ, 17 %
/// at 2.4. Given back in full, what is left at the cut is too large, and aliases. Four tenths gain 1 to 4 dB
/// on a ground plane at the same texels, and lose nothing elsewhere.
pub(crate) fn widening(radius: f64) -> f64 {
    // An exponential for each run of a few pixels would cost as much as one of them.
    let known = KNOWN.iter().find(|(of, _)| *of == radius);
    known.map_or_else(|| widened(radius), |(_, widening)| *widening)
}

/// [`widening`] for the radii of the presets.
const KNOWN: [(f64, f64); 3] =
    [known(Sampler::FAST.radius), known(Sampler::DEFAULT.radius), known(Sampler::REFERENCE.radius)];

const fn known(radius: f32) -> (f64, f64) {
    (radius as f64, widened(radius as f64))
}

const fn widened(radius: f64) -> f64 {
    let t = 0.5 * radius * radius;
    let beyond = exp(-t);
    1.0 + 0.4 * t * beyond / (1.0 - beyond)
}

/// Exponents are given to [`weight`] in this unit, which makes the largest power's coefficient 1.
pub(crate) const UNIT: f32 = 0.089_536_875;

/// The largest argument of [`weight`]: a cut at 4σ.
#[cfg(test)]
const DOMAIN: f32 = 8.0 * UNIT;

/// Coefficients of z⁰, −z¹ and z².
const C: [f32; 3] = [2.828_409_7, 3.945_987, 2.703_458_5];

/// 4096·e^(−x) as a whole number, of z = [`UNIT`]·x with x in [0, 8].
///
/// e^(−x) = (e^(−x/8))⁸, and the inner one is a cubic polynomial, fitted so that the largest error of
/// the eighth power is least: 5e−5 of the peak. Rounding to a whole number adds at most 1.2e−4; it is
/// what makes the sums of an ellipse exact, and over its texels comes to noise at −90 dB.
#[inline(always)]
pub(crate) fn weight(z: f32) -> i32 {
    let p = C[0] - z * (C[1] - z * (C[2] - z));
    let p2 = p * p;
    let p4 = p2 * p2;
    (p4 * p4 + ROUNDER).to_bits() as i32 - ROUNDER.to_bits() as i32
}

/// The same in lanes.
pub(crate) mod lanes {
    use super::C;
    use crate::texel::ROUNDER;
    use fearless_simd::{Simd, f32x16, i16x16, i32x16, prelude::*};

    /// [`weight`](super::weight) before it is rounded, and 0 where z is above `cut`.
    #[inline(always)]
    pub(crate) fn weight<S: Simd>(simd: S, z: f32x16<S>, cut: f32x16<S>) -> f32x16<S> {
        let p = f32x16::splat(simd, C[2]) - z;
        let p = f32x16::splat(simd, C[1]) - z * p;
        let p = f32x16::splat(simd, C[0]) - z * p;
        let p2 = p * p;
        let p4 = p2 * p2;
        z.simd_le(cut).select(p4 * p4, f32x16::splat(simd, 0.0))
    }

    /// Sixteen weights, without those above `cut`.
    #[inline(always)]
    pub(crate) fn weights<S: Simd>(simd: S, z: f32x16<S>, cut: f32) -> i16x16<S> {
        let weight = weight(simd, z, f32x16::splat(simd, cut));
        // The rounder has nothing in the low half of its bits.
        let bits = (weight + ROUNDER).bitcast::<i32x16<S>>();
        let (low, _) = bits.narrow(bits).split();
        low
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_error_is_as_stated() {
        let steps = 60_000u16;
        let mut worst = 0.0f64;
        for i in 0..=steps {
            let z = DOMAIN * f32::from(i) / f32::from(steps);
            let truth = 4096.0 * (-f64::from(z) / f64::from(UNIT)).exp();
            worst = worst.max((f64::from(weight(z)) - truth).abs());
        }
        assert!(worst <= 0.5 + 5e-5 * 4096.0, "{worst}");
        assert_eq!(weight(0.0), 4096);
    }
}
