/// The nearest of 256 codes to `value` in 0…1, exactly: 255·value is rounded half up, in `f64`,
/// where the product has no error. Out of range is clamped and NaN is 0.
#[must_use]
#[inline]
pub fn unorm8(value: f32) -> u8 {
    // The cast truncates and saturates, and makes 0 of NaN.
    (f64::from(value) * 255.0 + 0.5) as u8
}

/// The nearest of 65536 codes to `value` in 0…1, like [`unorm8`].
#[must_use]
#[inline]
pub fn unorm16(value: f32) -> u16 {
    (f64::from(value) * 65535.0 + 0.5) as u16
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    #[test]
    fn codes_survive_and_rounding_is_half_up() {
        for code in 0..=255_u8 {
            assert_eq!(unorm8(f32::from(code) / 255.0), code);
        }
        for code in 0..=65535_u16 {
            assert_eq!(unorm16(f32::from(code) / 65535.0), code);
        }
        assert_eq!((unorm8(0.5), unorm8(0.5_f32.next_down())), (128, 127));
        assert_eq!((unorm8(f32::NAN), unorm8(-1.0), unorm8(7.0)), (0, 0, 255));
    }

    proptest! {
        #[test]
        fn nearest(value in 0.0_f32..=1.0) {
            let v = f64::from(value);
            prop_assert!((f64::from(unorm8(value)) - v * 255.0).abs() <= 0.5);
            prop_assert!((f64::from(unorm16(value)) - v * 65535.0).abs() <= 0.5);
        }
    }
}
