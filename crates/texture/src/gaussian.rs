use crate::texel::ROUNDER;
use fearless_simd::{Simd, f32x16, i32x16, prelude::*};

/// The weight at the middle of an ellipse. Weights are rounded to whole numbers, which adds noise at
/// −90 dB and less; their products with texels are summed exactly.
pub(crate) const PEAK: f32 = 4096.0;

/// The largest argument of [`gaussian`]: a cut at 4σ.
#[cfg(test)]
pub(crate) const DOMAIN: f32 = 8.0;

/// e^(−x) for x in [0, 8], relative error below 1e−5, in ten multiplications and five
/// additions, seven deep.
///
/// e^(−x) = (e^(−x/8))⁸ and the inner one, on [0, 1], is the polynomial through the six Chebyshev
/// nodes of that interval (a test rebuilds it).
#[inline(always)]
fn gaussian(x: f32) -> f32 {
    let x2 = x * x;
    let p = (C[0] + x * C[1]) + x2 * ((C[2] + x * C[3]) + x2 * (C[4] + x * C[5]));
    let p2 = p * p;
    let p4 = p2 * p2;
    p4 * p4
}

/// The weight at an exponent in [0, 8].
#[inline(always)]
pub(crate) fn weight(x: f32) -> i32 {
    (gaussian(x) * PEAK + ROUNDER).to_bits() as i32 - ROUNDER.to_bits() as i32
}

/// [`weight`] at sixteen exponents, and 0 where they are above `cut`.
#[inline(always)]
pub(crate) fn weight_x16<S: Simd>(simd: S, x: f32x16<S>, cut: f32) -> i32x16<S> {
    let weight = x.simd_le(cut).select(gaussian_x16(x), f32x16::splat(simd, 0.0));
    (weight * PEAK + ROUNDER).bitcast::<i32x16<S>>() - ROUNDER.to_bits() as i32
}

/// [`gaussian`] of sixteen numbers, the same bits.
#[inline(always)]
fn gaussian_x16<S: Simd>(x: f32x16<S>) -> f32x16<S> {
    let x2 = x * x;
    let p = (x * C[1] + C[0]) + x2 * ((x * C[3] + C[2]) + x2 * (x * C[5] + C[4]));
    let p2 = p * p;
    let p4 = p2 * p2;
    p4 * p4
}

/// Coefficients of xᵏ, the eighths included.
const C: [f32; 6] = [
    0.999_999_6,
    -0.124_995_984,
    0.007_806_576_3,
    -0.000_322_290_46,
    9.360_088e-6,
    -1.556_313_4e-7,
];

#[cfg(test)]
mod tests {
    use super::*;

    /// Interpolates e^(−y) at the Chebyshev nodes of [0, 1] and rescales to x = 8y.
    fn fit() -> [f64; 6] {
        let nodes: [f64; 6] = core::array::from_fn(|k| {
            0.5 - 0.5 * ((2 * k + 1) as f64 * core::f64::consts::PI / 12.0).cos()
        });
        // Newton's divided differences, then expanded.
        let mut d = nodes.map(|y| (-y).exp());
        for order in 1..6 {
            for k in (order..6).rev() {
                d[k] = (d[k] - d[k - 1]) / (nodes[k] - nodes[k - order]);
            }
        }
        let mut c = [0.0; 6];
        for k in (0..6).rev() {
            for j in (1..6).rev() {
                c[j] = c[j - 1] - nodes[k] * c[j];
            }
            c[0] = d[k] - nodes[k] * c[0];
        }
        core::array::from_fn(|k| c[k] / 8f64.powi(k as i32))
    }

    #[test]
    fn the_table_is_the_fit() {
        let fit = fit();
        for (c, f) in C.iter().zip(fit) {
            assert!((f64::from(*c) / f - 1.0).abs() < 1e-6, "{fit:?}");
        }
    }

    #[test]
    fn the_error_is_as_stated() {
        let steps = 60_000u16;
        for i in 0..=steps {
            let x = DOMAIN * f32::from(i) / f32::from(steps);
            let truth = (-f64::from(x)).exp();
            assert!((f64::from(gaussian(x)) / truth - 1.0).abs() < 1e-5, "{x}");
            assert!((f64::from(weight(x)) - truth * 4096.0).abs() < 0.55, "{x}");
        }
    }
}
