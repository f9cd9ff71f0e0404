//! Functions whose last bit is the same on every machine: only + − × ÷, floor and bits.

use std::f64::consts::{LN_2, LOG10_2, SQRT_2, TAU};

/// Sine and cosine of an angle in turns, to 2·10⁻¹⁶ for less than 10⁶ turns.
pub(crate) fn sin_cos_turns(turns: f64) -> (f64, f64) {
    // The nearest quarter, and what is left: at most an eighth of a turn.
    let quarter = (4.0 * turns + 0.5).floor();
    let x = (turns - quarter / 4.0) * TAU;
    let x2 = x * x;
    let (mut sin, mut cos) = (0.0, 0.0);
    // Taylor's series from its far end, so that the small terms are added first.
    for k in (0..10).rev() {
        let k = f64::from(k);
        sin = 1.0 - sin * x2 / ((2.0 * k + 2.0) * (2.0 * k + 3.0));
        cos = 1.0 - cos * x2 / ((2.0 * k + 1.0) * (2.0 * k + 2.0));
    }
    let sin = sin * x;
    match quarter.rem_euclid(4.0) as u8 {
        0 => (sin, cos),
        1 => (cos, -sin),
        2 => (-sin, -cos),
        _ => (-cos, sin),
    }
}

/// 2ˣ, to a few parts in 10¹⁶; 0 far below zero, infinity far above it.
pub(crate) fn exp2(x: f64) -> f64 {
    if x.is_nan() {
        return x;
    }
    let whole = (x + 0.5).floor().clamp(-1100.0, 1100.0);
    let t = (x - whole).clamp(-0.5, 0.5) * LN_2;
    let sum = (1..18).rev().fold(1.0, |sum, k| 1.0 + sum * t / f64::from(k));
    // In two steps, so that neither power leaves the range of the numbers.
    let half = (whole / 2.0).floor();
    sum * power_of_two(half) * power_of_two(whole - half)
}

/// eˣ, by [`exp2`].
pub(crate) fn exp(x: f64) -> f64 {
    exp2(x / LN_2)
}

/// The decimal logarithm, to a few parts in 10¹⁶; −∞ for 0, NaN for less.
pub(crate) fn log10(x: f64) -> f64 {
    if x == 0.0 {
        return f64::NEG_INFINITY;
    }
    if x.is_nan() || x < 0.0 {
        return f64::NAN;
    }
    if x.is_infinite() {
        return x;
    }
    // What is too small for a mantissa of its own gets one.
    let (x, shift) =
        if x < f64::MIN_POSITIVE { (x * power_of_two(200.0), -200.0) } else { (x, 0.0) };
    let bits = x.to_bits();
    let exponent = (bits >> 52) as f64 - 1023.0 + shift;
    let mantissa = f64::from_bits((bits & ((1 << 52) - 1)) | (1023 << 52));
    let (mantissa, exponent) =
        if mantissa > SQRT_2 { (mantissa / 2.0, exponent + 1.0) } else { (mantissa, exponent) };
    // ln m = 2 artanh((m − 1)/(m + 1)), the argument below 0.172.
    let z = (mantissa - 1.0) / (mantissa + 1.0);
    let z2 = z * z;
    let series = (0..12).rev().fold(0.0, |sum, k| 1.0 / (2.0 * f64::from(k) + 1.0) + sum * z2);
    exponent * LOG10_2 + 2.0 * z * series / LN_2 * LOG10_2
}

/// 2ⁿ for a whole n in −1000…1000.
fn power_of_two(n: f64) -> f64 {
    f64::from_bits(((n + 1023.0) as u64) << 52)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn they_follow_the_library() {
        for i in -3000..3000 {
            let x = f64::from(i) * 0.0371;
            let (sin, cos) = sin_cos_turns(x);
            let (expected_sin, expected_cos) = (x.rem_euclid(1.0) * TAU).sin_cos();
            assert!(
                (sin - expected_sin).abs() < 1e-15 && (cos - expected_cos).abs() < 1e-15,
                "{x}"
            );
            assert!((exp2(x) / x.exp2() - 1.0).abs() < 1e-15, "{x}");
            assert!((exp(x) / x.exp() - 1.0).abs() < 1e-13, "{x}");
            let y = x.exp2();
            assert!((log10(y) - y.log10()).abs() <= 1e-14, "{y}");
        }
        assert_eq!(sin_cos_turns(0.25), (1.0, 0.0));
        assert_eq!(sin_cos_turns(-0.5), (0.0, -1.0));
    }

    #[test]
    fn the_ends_are_what_they_should_be() {
        assert_eq!((exp2(-5000.0), exp2(f64::NEG_INFINITY), exp2(0.0)), (0.0, 0.0, 1.0));
        assert_eq!((exp2(5000.0), exp2(f64::INFINITY)), (f64::INFINITY, f64::INFINITY));
        assert_eq!((exp2(-1074.0), exp2(-1030.0)), (5e-324, (-1030_f64).exp2()));
        assert!(exp2(f64::NAN).is_nan() && log10(f64::NAN).is_nan() && log10(-1.0).is_nan());
        assert_eq!((log10(0.0), log10(1.0)), (f64::NEG_INFINITY, 0.0));
        assert_eq!(log10(f64::INFINITY), f64::INFINITY);
        assert!((log10(5e-324) - 5e-324_f64.log10()).abs() < 1e-12);
    }
}
