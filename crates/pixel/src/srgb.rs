//! The sRGB transfer function (IEC 61966-2-1:1999), the same bits on every machine.
//!
//! Encoded values are what an 8-bit file stores divided by 255; linear values are proportional to
//! light. With e encoded and l linear,
//!
//! ```text
//! l = e / 12.92                        e ≤ 0.04045
//! l = ((e + 0.055) / 1.055)^2.4        otherwise
//! ```
//!
//! and the inverse switches at l ≤ 0.0031308. Those are the standard's own constants, rounded as it
//! rounds them, so the branches do not quite meet: [`encode`] steps down by 3·10⁻⁸ at its knee, two
//! thousandths of a 16-bit code.
//!
//! No `powf` is called, because its last bit differs between platforms. Both powers come from
//! Newton's iteration for an inverse root in `f64` ([`decode`] from x^(−1/5), [`encode`] from
//! x^(−1/12)), which takes products and differences only, so that it is also what fills the
//! `const` tables. The `f32` result is within 0.51 ulp of the formula.
//!
//! ```
//! use scumble_pixel::srgb;
//!
//! assert_eq!(srgb::encode8(srgb::decode8(200)), 200);
//! assert!((srgb::decode(0.5) - 0.214_041_14).abs() < 1e-7);
//! ```

/// The encoded value up to which the curve is a straight line.
const ENCODED_KNEE: f32 = 0.04045;
/// The linear value up to which the curve is a straight line.
const LINEAR_KNEE: f32 = 0.003_130_8;
/// Slope of the straight part.
const SLOPE: f64 = 12.92;

/// First guess for x^(−1/n) from the bits of x, which are nearly its logarithm: within 4 %.
///
/// 0x3f7a3bea is 1.0 less the mean error of taking the mantissa for its own logarithm.
const fn guess<const N: u32>(x: f32) -> f64 {
    const ONE: u32 = 0x3f7a_3bea;
    f32::from_bits(ONE + ONE / N - x.to_bits() / N) as f64
}

/// x^2.4 = x³·(x^(−1/5))³ for a normal positive x.
const fn pow_2_4(x: f64) -> f64 {
    let mut z = guess::<5>(x as f32);
    let mut i = 0;
    // The error squares each time: 4e-2, 4e-3, 5e-5, 7e-9, 2e-16.
    while i < 4 {
        let z2 = z * z;
        z *= 1.2 - 0.2 * x * (z2 * z2 * z);
        i += 1;
    }
    let xz = x * z;
    xz * xz * xz
}

/// x^(1/2.4) = x·(x^(−1/12))⁷ for a normal positive x.
const fn pow_1_2_4(x: f64) -> f64 {
    let mut z = guess::<12>(x as f32);
    let mut i = 0;
    while i < 5 {
        let z2 = z * z;
        let z4 = z2 * z2;
        z *= 13.0 / 12.0 - x / 12.0 * (z4 * z4 * z4);
        i += 1;
    }
    let z2 = z * z;
    x * (z2 * z2 * z2 * z)
}

/// The curved part of the decoding, in `f64`.
const fn decode_power(e: f64) -> f64 {
    pow_2_4((e + 0.055) * (1.0 / 1.055))
}

/// Encoded to linear, any `f32`.
///
/// Below zero the straight part goes on, above one the curve does; NaN and the infinities come
/// back as they are. `decode(0.0)` is 0 and `decode(1.0)` is 1.
#[must_use]
#[inline]
pub const fn decode(encoded: f32) -> f32 {
    // Both branches always, then a choice: that is what lets a row of them fill vectors.
    let line = (encoded as f64 / SLOPE) as f32;
    let curve = decode_power(encoded as f64) as f32;
    if encoded <= ENCODED_KNEE {
        line
    } else if encoded < f32::INFINITY {
        curve
    } else {
        encoded
    }
}

/// Linear to encoded, any `f32`.
///
/// Below zero the straight part goes on, above one the curve does; NaN and the infinities come
/// back as they are. `encode(0.0)` is 0 and `encode(1.0)` is 1.
#[must_use]
#[inline]
pub const fn encode(linear: f32) -> f32 {
    let line = (linear as f64 * SLOPE) as f32;
    let curve = (1.055 * pow_1_2_4(linear as f64) - 0.055) as f32;
    if linear <= LINEAR_KNEE {
        line
    } else if linear < f32::INFINITY {
        curve
    } else {
        linear
    }
}

/// [`decode`] of the `f32` nearest to `code / 255`, from a table.
#[must_use]
#[inline]
pub const fn decode8(code: u8) -> f32 {
    DECODED[code as usize]
}

/// Linear to the nearest 8-bit code, exactly: the code whose interval [k − ½, k + ½)/255 of
/// encoded values holds the encoding of `linear`. Out of range is clamped and NaN is 0.
#[must_use]
#[inline]
pub fn encode8(linear: f32) -> u8 {
    // NaN fails the comparison.
    let x = if linear > FIRST_CELL { linear.min(BELOW_ONE) } else { FIRST_CELL };
    let start = CELLS[((x.to_bits() - FIRST_CELL.to_bits()) >> CELL_SHIFT) as usize];
    start + u8::from(x >= THRESHOLDS[start as usize])
}

/// [`decode`] of every value in place.
pub fn decode_slice(values: &mut [f32]) {
    for v in values {
        *v = decode(*v);
    }
}

/// [`encode`] of every value in place.
pub fn encode_slice(values: &mut [f32]) {
    for v in values {
        *v = encode(*v);
    }
}

/// [`decode8`] of every code; the shorter slice ends it.
pub fn decode8_slice(codes: &[u8], linear: &mut [f32]) {
    for (out, &code) in linear.iter_mut().zip(codes) {
        *out = decode8(code);
    }
}

/// [`encode8`] of every value; the shorter slice ends it.
pub fn encode8_slice(linear: &[f32], codes: &mut [u8]) {
    for (out, &v) in codes.iter_mut().zip(linear) {
        *out = encode8(v);
    }
}

/// `decode(code / 255)`.
static DECODED: [f32; 256] = {
    let mut table = [0.0; 256];
    let mut code = 0;
    while code < 256 {
        table[code] = decode(code as f32 / 255.0);
        code += 1;
    }
    table
};

/// `THRESHOLDS[k]` is the least `f32` whose code is above k: (k + ½)/255 decoded, rounded up.
/// The last, which nothing reaches, is +∞.
static THRESHOLDS: [f32; 256] = {
    let mut table = [f32::INFINITY; 256];
    let mut code = 0;
    while code < 255 {
        let encoded = (code as f64 + 0.5) / 255.0;
        let linear = if encoded <= 0.04045 { encoded / SLOPE } else { decode_power(encoded) };
        let nearest = linear as f32;
        table[code] = if (nearest as f64) < linear { nearest.next_up() } else { nearest };
        code += 1;
    }
    table
};

/// 2⁻¹³, where the cells start; the first threshold is 1.5·10⁻⁴.
const FIRST_CELL: f32 = 1.0 / 8192.0;
/// The greatest `f32` below one; its code is 255.
const BELOW_ONE: f32 = 1.0 - f32::EPSILON / 2.0;
/// 23 − 7: a cell is one value of the exponent and of the top seven bits of the mantissa. With
/// 128 to the octave no cell holds more than one threshold, so that one comparison decides.
const CELL_SHIFT: u32 = 16;

/// The code at the lower edge of each cell.
static CELLS: [u8; 13 * 128] = {
    let mut table = [0; 13 * 128];
    let mut cell = 0;
    let mut code = 0;
    while cell < table.len() {
        let edge = f32::from_bits(FIRST_CELL.to_bits() + ((cell as u32) << CELL_SHIFT));
        while edge >= THRESHOLDS[code] {
            code += 1;
        }
        table[cell] = code as u8;
        cell += 1;
    }
    table
};

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn decode_f64(e: f64) -> f64 {
        if e <= 0.04045 { e / 12.92 } else { ((e + 0.055) / 1.055).powf(2.4) }
    }

    fn encode_f64(l: f64) -> f64 {
        if l <= 0.003_130_8 { l * 12.92 } else { 1.055 * l.powf(1.0 / 2.4) - 0.055 }
    }

    /// The distance from the exact value in units of the last place of the result.
    fn ulps(found: f32, exact: f64) -> f64 {
        let ulp = f64::from(found.next_up()) - f64::from(found);
        (f64::from(found) - exact).abs() / ulp
    }

    #[test]
    fn codes_survive_the_round_trip() {
        for code in 0..=255 {
            assert_eq!(encode8(decode8(code)), code);
            assert_eq!(decode8(code), decode(f32::from(code) / 255.0));
        }
        assert_eq!((decode8(0), decode8(255)), (0.0, 1.0));
        assert_eq!((decode(1.0), encode(1.0)), (1.0, 1.0));
    }

    #[test]
    fn thresholds_are_the_halves() {
        for code in 0..255_u8 {
            let threshold = THRESHOLDS[usize::from(code)];
            let half = f64::from(code) + 0.5;
            assert!(encode_f64(f64::from(threshold)) * 255.0 >= half - 1e-9, "{code}");
            assert!(encode_f64(f64::from(threshold.next_down())) * 255.0 < half + 1e-9, "{code}");
            assert_eq!(encode8(threshold), code + 1);
            assert_eq!(encode8(threshold.next_down()), code);
        }
    }

    #[test]
    fn no_cell_holds_two_thresholds() {
        for (cell, pair) in CELLS.windows(2).enumerate() {
            assert!(pair[1] - pair[0] <= 1, "cell {cell}");
        }
        assert_eq!(CELLS[0], 0);
        assert_eq!(CELLS[CELLS.len() - 1], 255);
    }

    #[test]
    fn out_of_range_is_clamped() {
        for (linear, code) in [
            (f32::NAN, 0),
            (f32::NEG_INFINITY, 0),
            (-1.0, 0),
            (-0.0, 0),
            (1e-30, 0),
            (1.0, 255),
            (2.0, 255),
            (f32::INFINITY, 255),
        ] {
            assert_eq!(encode8(linear), code, "{linear}");
        }
        assert!(decode(f32::NAN).is_nan() && encode(f32::NAN).is_nan());
        assert_eq!(decode(f32::INFINITY), f32::INFINITY);
        assert_eq!(encode(f32::MAX), encode_f64(f64::from(f32::MAX)) as f32);
    }

    #[test]
    fn slices_are_the_scalars() {
        let codes: Vec<u8> = (0..=255).collect();
        let mut linear = vec![0.0; 256];
        decode8_slice(&codes, &mut linear);
        assert!(linear.iter().zip(&codes).all(|(&l, &c)| l == decode8(c)));
        let mut back = vec![0; 256];
        encode8_slice(&linear, &mut back);
        assert_eq!(back, codes);
        let mut curve = linear.clone();
        encode_slice(&mut curve);
        assert!(curve.iter().zip(&linear).all(|(&e, &l)| e == encode(l)));
        decode_slice(&mut curve);
        assert!(curve.iter().zip(&linear).all(|(a, b)| (a - b).abs() <= 3e-7 * b));
    }

    proptest! {
        #[test]
        fn both_ways_are_the_formula(x in 0.0_f32..1.5) {
            prop_assert!(ulps(decode(x), decode_f64(f64::from(x))) <= 0.51);
            prop_assert!(ulps(encode(x), encode_f64(f64::from(x))) <= 0.51);
        }

        #[test]
        fn encode8_rounds_to_nearest(x in 0.0_f32..1.0) {
            let exact = encode_f64(f64::from(x)) * 255.0;
            prop_assert!((f64::from(encode8(x)) - exact).abs() <= 0.5 + 1e-9);
        }

        #[test]
        fn monotone(a in 0.0_f32..1.0, b in 0.0_f32..1.0) {
            let (low, high) = (a.min(b), a.max(b));
            prop_assert!(encode8(low) <= encode8(high));
            prop_assert!(decode(low) <= decode(high));
        }
    }
}
