//! Sine and cosine with the same bits on every platform, which the system's own do not promise.

use core::f64::consts::PI;

/// (sin, cos) of an angle in degrees; multiples of 90° are exact. A non-finite angle gives NaN.
///
/// The angle is reduced exactly (`%` is) to within 45° of a multiple of 90°, where the Taylor
/// series up to x¹⁸ is right to the last bit or two.
pub(crate) fn sin_cos_degrees(degrees: f64) -> (f64, f64) {
    let turn = degrees % 360.0;
    let quarter = (turn / 90.0 + 0.5).floor();
    let (s, c) = taylor((turn - quarter * 90.0) * (PI / 180.0));
    // −4 … 4, because |turn| < 360.
    match quarter as i32 & 3 {
        0 => (s, c),
        1 => (c, -s),
        2 => (-s, -c),
        _ => (-c, s),
    }
}

/// tan of an angle in degrees; huge or infinite near 90°.
pub(crate) fn tan_degrees(degrees: f64) -> f64 {
    let (s, c) = sin_cos_degrees(degrees);
    s / c
}

/// (sin, cos) for |x| ≤ π/4, by Horner's rule.
fn taylor(x: f64) -> (f64, f64) {
    let xx = x * x;
    let (mut s, mut c) = (1.0, 1.0);
    for k in (1..=9).rev() {
        let n = 2.0 * f64::from(k);
        s = 1.0 - s * xx / (n * (n + 1.0));
        c = 1.0 - c * xx / ((n - 1.0) * n);
    }
    (x * s, c)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn agrees_with_the_library_function() {
        for i in -20_000..20_000 {
            let degrees = f64::from(i) * 0.037;
            let (s, c) = sin_cos_degrees(degrees);
            let (es, ec) = (degrees * (PI / 180.0)).sin_cos();
            assert!((s - es).abs() < 1e-14 && (c - ec).abs() < 1e-14, "{degrees}");
        }
    }

    #[test]
    fn right_angles_are_exact() {
        let expected = [(0.0, 1.0), (1.0, 0.0), (0.0, -1.0), (-1.0, 0.0)];
        for i in -12..12_i32 {
            let (s, c) = sin_cos_degrees(f64::from(i) * 90.0);
            assert_eq!((s, c), expected[(i & 3) as usize], "{i}");
        }
        assert!(sin_cos_degrees(f64::INFINITY).0.is_nan());
        assert!(sin_cos_degrees(1e300).0.abs() <= 1.0);
    }
}
