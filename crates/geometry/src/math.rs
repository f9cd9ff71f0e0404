//! The few floating-point functions that `core` lacks. All of them are correctly rounded or exact,
//! so that they give the same bits with `std` and with `libm`, everywhere.

use crate::DVec2;

/// √v, correctly rounded; NaN for a negative number.
pub(crate) fn sqrt(v: f64) -> f64 {
    DVec2::new(v, 0.0).sqrt().x
}

/// ⌊v⌋.
pub(crate) fn floor(v: f64) -> f64 {
    DVec2::new(v, 0.0).floor().x
}

/// The largest power of two that is not greater than `v`, for positive normal `v`: dividing by it
/// is exact.
pub(crate) fn power_of_two_below(v: f64) -> f64 {
    const EXPONENT: u64 = 0x7ff0_0000_0000_0000;
    f64::from_bits(v.to_bits() & EXPONENT)
}
