//! A formula written once, for one number and for sixteen in lanes: what the lanes give is the definition
//! by construction.

use crate::math::{floor32, sqrt32};
use core::ops::{Add, Div, Mul, Sub};
use fearless_simd::{Simd, SimdBase, SimdFloat, f32x16, i32x16, prelude::*};

/// Bits of a float's mantissa, what is added to its exponent, and the bits of 1.
const MANTISSA: u32 = 23;
const BIAS: i32 = 127;
const ONE: u32 = 0x3f80_0000;

/// A float, or a vector of floats. Every operation rounds as IEEE 754 says.
pub(crate) trait Number:
    Copy
    + Add<Output = Self>
    + Sub<Output = Self>
    + Mul<Output = Self>
    + Div<Output = Self>
    + Add<f32, Output = Self>
    + Sub<f32, Output = Self>
    + Mul<f32, Output = Self>
{
    /// A number wherever this one stands.
    fn all(self, value: f32) -> Self;
    fn floor(self) -> Self;
    fn sqrt(self) -> Self;
    fn abs(self) -> Self;
    /// Brought within 0…1; of a NaN something in it.
    fn within_unit(self) -> Self;
    /// The larger of two numbers, and the smaller; no NaN among them.
    fn at_least(self, other: Self) -> Self;
    fn at_most(self, other: Self) -> Self;
    /// A positive number as 2ᵉ·m with a whole number e, of which 128 stands for what is not finite, and
    /// m in [1, 2).
    fn parts(self) -> [Self; 2];
    /// One number where this is above 0, and another where it is not.
    fn if_positive(self, then: Self, otherwise: Self) -> Self;
    /// Whether it, or one of them, is above 0.
    fn any_positive(self) -> bool;
    /// A function of each number that has no other form.
    fn each(self, f: impl Fn(f32) -> f32) -> Self;
}

impl Number for f32 {
    #[inline(always)]
    fn all(self, value: f32) -> Self {
        value
    }

    #[inline(always)]
    fn floor(self) -> Self {
        floor32(self)
    }

    #[inline(always)]
    fn sqrt(self) -> Self {
        sqrt32(self)
    }

    #[inline(always)]
    fn abs(self) -> Self {
        Self::abs(self)
    }

    #[inline(always)]
    fn within_unit(self) -> Self {
        // Comparisons in this form are one instruction each.
        let v = if self > 0.0 { self } else { 0.0 };
        if v < 1.0 { v } else { 1.0 }
    }

    #[inline(always)]
    fn at_least(self, other: Self) -> Self {
        if self > other { self } else { other }
    }

    #[inline(always)]
    fn at_most(self, other: Self) -> Self {
        if self < other { self } else { other }
    }

    #[inline(always)]
    fn parts(self) -> [Self; 2] {
        let bits = self.to_bits();
        let exponent = (bits >> MANTISSA & 0xff) as i32 - BIAS;
        [exponent as Self, Self::from_bits(bits & ((1 << MANTISSA) - 1) | ONE)]
    }

    #[inline(always)]
    fn if_positive(self, then: Self, otherwise: Self) -> Self {
        if self > 0.0 { then } else { otherwise }
    }

    #[inline(always)]
    fn any_positive(self) -> bool {
        self > 0.0
    }

    #[inline(always)]
    fn each(self, f: impl Fn(f32) -> f32) -> Self {
        f(self)
    }
}

impl<S: Simd> Number for f32x16<S> {
    #[inline(always)]
    fn all(self, value: f32) -> Self {
        Self::splat(self.simd, value)
    }

    #[inline(always)]
    fn floor(self) -> Self {
        SimdFloat::floor(self)
    }

    #[inline(always)]
    fn sqrt(self) -> Self {
        SimdFloat::sqrt(self)
    }

    #[inline(always)]
    fn abs(self) -> Self {
        SimdBase::abs(self)
    }

    #[inline(always)]
    fn within_unit(self) -> Self {
        self.max(self.all(0.0)).min(self.all(1.0))
    }

    #[inline(always)]
    fn at_least(self, other: Self) -> Self {
        self.max(other)
    }

    #[inline(always)]
    fn at_most(self, other: Self) -> Self {
        self.min(other)
    }

    #[inline(always)]
    fn parts(self) -> [Self; 2] {
        let bits = self.bitcast::<i32x16<S>>();
        let exponent = (bits >> MANTISSA & 0xff) - BIAS;
        let mantissa = bits & ((1 << MANTISSA) - 1) | ONE as i32;
        [exponent.to_float(), mantissa.bitcast()]
    }

    #[inline(always)]
    fn if_positive(self, then: Self, otherwise: Self) -> Self {
        self.simd_gt(0.0).select(then, otherwise)
    }

    #[inline(always)]
    fn any_positive(self) -> bool {
        self.simd_gt(0.0).any_true()
    }

    #[inline(always)]
    fn each(self, f: impl Fn(f32) -> f32) -> Self {
        let mut lanes = self.to_array();
        for lane in &mut lanes {
            *lane = f(*lane);
        }
        Self::load_array(self.simd, lanes)
    }
}
