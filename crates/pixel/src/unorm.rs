/// 2⁵²: from here on the `f64`s are the integers, so that adding it rounds to nearest and leaves
/// the integer in the low bits. One addition, where a cast would be a comparison or three.
const ROUND: f64 = 4_503_599_627_370_496.0;

/// The nearest of 256 codes to `value` in 0…1, exactly: 255·value has no error in `f64`, and the
/// only tie, one half, goes up to 128. Out of range is clamped and NaN is 0.
#[must_use]
#[inline(always)]
pub fn unorm8(value: f32) -> u8 {
    (clamp(value) * 255.0 + ROUND).to_bits() as u8
}

/// The nearest of 65536 codes to `value` in 0…1, like [`unorm8`]; one half is 32768.
#[must_use]
#[inline]
pub fn unorm16(value: f32) -> u16 {
    (clamp(value) * 65535.0 + ROUND).to_bits() as u16
}

/// `value` in 0…1; NaN fails the first comparison and is 0.
#[inline(always)]
fn clamp(value: f32) -> f64 {
    let above = if value > 0.0 { value } else { 0.0 };
    f64::from(if above < 1.0 { above } else { 1.0 })
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    #[test]
    fn codes_survive_and_one_half_goes_up() {
        for code in 0..=255_u8 {
            assert_eq!(unorm8(f32::from(code) / 255.0), code);
        }
        for code in 0..=65535_u16 {
            assert_eq!(unorm16(f32::from(code) / 65535.0), code);
        }
        assert_eq!((unorm8(0.5), unorm8(0.5_f32.next_down())), (128, 127));
        assert_eq!((unorm16(0.5), unorm16(0.5_f32.next_down())), (32768, 32767));
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
