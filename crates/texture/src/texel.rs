//! How a level keeps its texels: 16 bits a channel.
//!
//! A texture is read far more often than its numbers need the digits of a float, and what a sample
//! costs is above all the memory that it touches. So a channel is a whole number of steps of 1/16,320,
//! sixty-four to each code of eight bits: codes are exact, and so are the sums of up to 64 of them that
//! the box filter divides. Rounding to a step is noise at −95 dB.

use crate::pyramid::{Lanes, halve};
use crate::store::{self, Code, Stored};

/// Premultiplied RGBA in the working space, in steps.
pub(crate) type Texel = [i16; 4];

/// A texel as pyramids are made of: in steps, or in floats.
pub(crate) trait Cell: Stored {
    /// A channel.
    type Number: Copy + Into<f32>;
    /// Whether it is rounded to a step, after which sums of constants are the constant again.
    const ROUNDS: bool;
    /// The channels of a row.
    fn flat(row: &[Self]) -> &[Self::Number];
    /// The mean of four.
    fn mean(four: [Self; 4]) -> Self;
    /// Its numbers, in the unit that they are stored in.
    fn numbers(self) -> [f32; 4];
    /// The texel nearest to such numbers.
    fn of_numbers(numbers: [f32; 4]) -> Self;
    /// The texels nearest to such numbers: many at a time, which is quicker.
    fn put(numbers: &[[f32; 4]], out: &mut [Self]);
    /// Its codes, of a level that keeps texels as such.
    fn code(self) -> Code;
    /// The texel of a colour in parts of 255².
    fn of_products(products: [f32; 4]) -> Self;
    /// The texel of numbers in steps.
    fn of_steps(steps: Texel) -> Self;
    /// The texels of opaque, encoded pixels of three bytes, as many as it likes from the first on;
    /// returns how many.
    #[inline(always)]
    fn of_rgb(_: impl Lanes, _: &[u8], _: &mut [Self]) -> usize {
        0
    }
    /// The means of two by two texels of two rows.
    #[inline(always)]
    fn halve(_: impl Lanes, above: &[Self], below: &[Self], out: &mut [Self]) {
        halve(above, below, out);
    }
}

impl Cell for Texel {
    type Number = i16;
    const ROUNDS: bool = true;

    #[inline(always)]
    fn flat(row: &[Self]) -> &[i16] {
        row.as_flattened()
    }

    #[inline(always)]
    fn mean(four: [Self; 4]) -> Self {
        core::array::from_fn(|c| {
            let sum: i32 = four.iter().map(|t| i32::from(t[c])).sum();
            // Halves to even, as everywhere.
            ((sum + 1 + (sum >> 2 & 1)) >> 2) as i16
        })
    }

    #[inline(always)]
    fn numbers(self) -> [f32; 4] {
        steps(self)
    }

    #[inline(always)]
    fn of_numbers(numbers: [f32; 4]) -> Self {
        numbers.map(round)
    }

    #[inline(always)]
    fn put(numbers: &[[f32; 4]], out: &mut [Self]) {
        let out = out.as_flattened_mut();
        for (out, v) in out.iter_mut().zip(numbers.as_flattened()) {
            *out = round(*v);
        }
    }

    #[inline(always)]
    fn code(self) -> Code {
        store::code(self)
    }

    #[inline(always)]
    fn of_products(products: [f32; 4]) -> Self {
        // Off by less than a thousandth and a half, and no product lies within one and nine tenths of
        // the middle between two steps: the nearest step is that of the exact product.
        products.map(|v| round(v * (64.0 / 255.0)))
    }

    #[inline(always)]
    fn of_steps(steps: Texel) -> Self {
        steps
    }

    #[inline(always)]
    fn of_rgb(lanes: impl Lanes, bytes: &[u8], out: &mut [Self]) -> usize {
        lanes.of_rgb(bytes, out)
    }

    #[inline(always)]
    fn halve(lanes: impl Lanes, above: &[Self], below: &[Self], out: &mut [Self]) {
        lanes.halve(above, below, out);
    }
}

impl Cell for [f32; 4] {
    type Number = f32;
    const ROUNDS: bool = false;

    #[inline(always)]
    fn flat(row: &[Self]) -> &[f32] {
        row.as_flattened()
    }

    #[inline(always)]
    fn mean([a, b, c, d]: [Self; 4]) -> Self {
        // About one of them: equal ones are their mean.
        core::array::from_fn(|i| a[i] + ((b[i] - a[i]) + (c[i] - a[i]) + (d[i] - a[i])) * 0.25)
    }

    #[inline(always)]
    fn numbers(self) -> [f32; 4] {
        self
    }

    #[inline(always)]
    fn of_numbers(numbers: [f32; 4]) -> Self {
        numbers
    }

    #[inline(always)]
    fn put(numbers: &[[f32; 4]], out: &mut [Self]) {
        for (out, numbers) in out.iter_mut().zip(numbers) {
            *out = *numbers;
        }
    }

    #[inline(always)]
    fn code(self) -> Code {
        Code::of_color(self)
    }

    #[inline(always)]
    fn of_products(products: [f32; 4]) -> Self {
        products.map(|v| v / (255.0 * 255.0))
    }

    #[inline(always)]
    fn of_steps(steps: Texel) -> Self {
        color(steps)
    }
}

/// 1.0, in steps.
pub(crate) const ONE: f32 = 16_320.0;

/// One step. [`ONE`] of them are 1 to the last bit.
pub(crate) const STEP: f32 = 1.0 / ONE;

/// The least and the largest that is kept. No single step of the sharp pyramid leaves −0.246…1.246.
const LEAST: f32 = -0.25 * ONE;
const MOST: f32 = 1.25 * ONE;

/// 1.5·2²³: a float of this size holds whole numbers only, so a sum with it is rounded to one, halves
/// to even, which then stands in its low bits.
pub(crate) const ROUNDER: f32 = 12_582_912.0;

/// The whole number of steps nearest to a channel in steps.
#[inline(always)]
pub(crate) fn round(v: f32) -> i16 {
    // Comparisons in this form are one instruction each, and take a NaN to the bound.
    let v = if v > LEAST { v } else { LEAST };
    let v = if v < MOST { v } else { MOST };
    (v + ROUNDER).to_bits() as i16
}

/// The colour in steps of a texel.
#[inline(always)]
pub(crate) fn steps(t: Texel) -> [f32; 4] {
    t.map(f32::from)
}

/// The colour of a texel.
#[inline(always)]
pub(crate) fn color(t: Texel) -> [f32; 4] {
    t.map(|v| f32::from(v) * STEP)
}

/// The texel nearest to a colour.
#[inline(always)]
pub(crate) fn of_color(color: [f32; 4]) -> Texel {
    color.map(|v| round(v * ONE))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn codes_and_halves_are_exact() {
        assert_eq!(ONE * STEP, 1.0);
        for code in 0..=255u8 {
            let value = f32::from(code) / 255.0;
            let texel = of_color([value; 4]);
            assert_eq!(texel, [i16::from(code) * 64; 4]);
            assert!((color(texel)[0] - value).abs() < 1e-7);
        }
        assert_eq!(color(of_color([0.5, 0.25, 0.125, 1.0])), [0.5, 0.25, 0.125, 1.0]);
    }

    #[test]
    fn rounding_is_to_the_nearest_and_stays_within() {
        assert_eq!([0.4, 0.6, -0.6, 2.5].map(round), [0, 1, -1, 2]);
        assert_eq!([-1e9, 1e9, f32::NAN, -0.0].map(round), [-4080, 20_400, -4080, 0]);
    }
}
