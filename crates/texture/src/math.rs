//! The few functions that are not + − × ÷, written so that every machine gives the same bits.
//!
//! The square root and the floor are correctly rounded (exact) by IEEE 754; the series below use
//! nothing else, so tables made of them are the same everywhere, which libm does not promise.

/// √x, correctly rounded.
#[inline(always)]
pub(crate) fn sqrt(x: f64) -> f64 {
    #[cfg(feature = "std")]
    return x.sqrt();
    #[cfg(all(not(feature = "std"), feature = "libm"))]
    return libm::sqrt(x);
    #[cfg(not(any(feature = "std", feature = "libm")))]
    compile_error!("scumble-texture needs the feature `std` or `libm`");
}

/// √x, correctly rounded.
#[inline(always)]
pub(crate) fn sqrt32(x: f32) -> f32 {
    #[cfg(feature = "std")]
    return x.sqrt();
    #[cfg(all(not(feature = "std"), feature = "libm"))]
    return libm::sqrtf(x);
}

/// The largest whole number that is not above x.
#[inline(always)]
pub(crate) fn floor(x: f64) -> f64 {
    #[cfg(feature = "std")]
    return x.floor();
    #[cfg(all(not(feature = "std"), feature = "libm"))]
    return libm::floor(x);
}

/// The largest whole number that is not above x.
#[inline(always)]
pub(crate) fn floor32(x: f32) -> f32 {
    #[cfg(feature = "std")]
    return x.floor();
    #[cfg(all(not(feature = "std"), feature = "libm"))]
    return libm::floorf(x);
}

/// The least whole number that is not below x.
#[inline(always)]
pub(crate) fn ceil(x: f64) -> f64 {
    -floor(-x)
}

/// A whole number of at most 2³¹ as an integer; anything at all for other numbers.
///
/// Where `as` saturates, which takes a branch for each number, this is one addition.
#[inline(always)]
pub(crate) fn whole(x: f64) -> i32 {
    (x + WHOLE).to_bits() as i32
}

/// 1.5·2⁵²: floats of this size hold whole numbers only.
pub(crate) const WHOLE: f64 = 6_755_399_441_055_744.0;

/// log₂ x of a normal positive x; the absolute error is below 1e−10.
///
/// The exponent is read from the bits; the mantissa m, brought to [√½, √2), goes through
/// ln m = 2·artanh((m − 1)/(m + 1)), whose series in z² ≤ 0.0295 is cut at z¹¹.
#[inline(always)]
pub(crate) fn log2(x: f64) -> f64 {
    let bits = x.to_bits();
    let mut exponent = f64::from(((bits >> 52) & 0x7ff) as u16) - 1023.0;
    let mut mantissa = f64::from_bits((bits & 0x000f_ffff_ffff_ffff) | 0x3ff0_0000_0000_0000);
    if mantissa > core::f64::consts::SQRT_2 {
        mantissa *= 0.5;
        exponent += 1.0;
    }
    let z = (mantissa - 1.0) / (mantissa + 1.0);
    let z2 = z * z;
    let series = (0..6).rev().fold(0.0, |sum, k| sum * z2 + 1.0 / f64::from(2 * k + 1));
    exponent + 2.0 * core::f64::consts::LOG2_E * z * series
}

/// e^x for x in [−700, 0], relative error below 1e−14; 0 below that.
pub(crate) const fn exp(x: f64) -> f64 {
    if x < -700.0 {
        return 0.0;
    }
    // e^x = (e^(x/1024))^1024: the argument of the series is below 0.7.
    let small = x / 1024.0;
    let (mut value, mut k) = (1.0, 19);
    while k > 0 {
        value = 1.0 + value * small / k as f64;
        k -= 1;
    }
    while k < 10 {
        value *= value;
        k += 1;
    }
    value
}

/// sin(x)/x for |x| ≤ 2π, absolute error below 1e−12.
pub(crate) fn sinc(x: f64) -> f64 {
    let x2 = x * x;
    (1..24).rev().fold(1.0, |sum, k| {
        let k = f64::from(k);
        1.0 - sum * x2 / ((2.0 * k) * (2.0 * k + 1.0))
    })
}

/// The modified Bessel function I₀(2√q) = Σ qᵏ/(k!)², for q in [0, 100].
pub(crate) fn bessel_i0(q: f64) -> f64 {
    // What follows is nothing beside the first terms: below 10⁻³⁰ of the sum, whose every bit is the same.
    let terms = if q <= 4.0 { 28 } else { 60 };
    (1..terms).rev().fold(1.0, |sum, k| {
        let k = f64::from(k);
        1.0 + sum * q / (k * k)
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_series_agree_with_the_library() {
        for i in 1..4000 {
            let x = f64::from(i) * 0.37e-2;
            assert!((log2(x) - x.log2()).abs() < 1e-10, "log2 {x}");
            assert!((exp(-x) / (-x).exp() - 1.0).abs() < 1e-12, "exp {x}");
            if x < 6.2 {
                assert!((sinc(x) - x.sin() / x).abs() < 1e-12, "sinc {x}");
            }
        }
        assert_eq!([0.0, -1.0, 77.0, -1e9].map(whole), [0, -1, 77, -1_000_000_000]);
        assert_eq!(log2(8.0), 3.0);
        assert_eq!(exp(0.0), 1.0);
        assert_eq!(exp(-1e9), 0.0);
        assert_eq!(sinc(0.0), 1.0);
        for i in 0..4000 {
            let q = f64::from(i) * 1e-3;
            let all = (1..60).rev().fold(1.0, |sum, k| 1.0 + sum * q / f64::from(k * k));
            assert_eq!(bessel_i0(q).to_bits(), f64::to_bits(all), "{q}");
        }
        // I0(4), Abramowitz and Stegun, table 9.8.
        assert!((bessel_i0(4.0) - 11.301_921_952_136_33).abs() < 1e-12);
    }
}
