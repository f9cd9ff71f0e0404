//! From an image's numbers to texels of the working space.

use crate::format::{Alpha, Channel, Channels, TexelFormat};
use crate::pyramid::Lanes;
use crate::texel::{Cell, ONE, of_color};
use alloc::vec::Vec;
use scumble_pixel::{WorkingSpace, srgb};

/// The largest magnitude of a float that is kept: the sums over as many texels as there can be stay
/// finite.
const LARGEST: f32 = 1e30;

/// Pixels of an image from which on a table of 16-bit codes is worth its making.
const WORTH_A_TABLE: usize = 1 << 17;

/// Pixels that are looked at together, whether they are opaque.
const BLOCK: usize = 64;

/// Bytes as parts of 255.
const PARTS: [f32; 256] = {
    let mut parts = [0.0; 256];
    let mut code = 0;
    while code < 256 {
        parts[code] = code as f32 / 255.0;
        code += 1;
    }
    parts
};

/// Alpha of 1, in steps.
const OPAQUE: u64 = ONE as u64;

/// The curve from an image's numbers to those of a space; none if they are the same.
type Curve = fn(f32) -> f32;

/// From pixels to texels.
#[derive(Debug, Clone)]
pub(crate) struct Decoder<P, A> {
    format: TexelFormat<P, A>,
    curve: Option<Curve>,
    /// What each code stands for, if there are not too many.
    codes: Option<Codes>,
}

/// The colours of all codes of a channel.
#[derive(Debug, Clone)]
struct Codes {
    colors: Vec<f32>,
    /// Of bytes, in steps.
    steps: [u16; 256],
}

impl<P: Channels, A: Alpha> Decoder<P, A> {
    /// For an image of so many pixels.
    pub(crate) fn new(format: TexelFormat<P, A>, space: WorkingSpace, pixels: usize) -> Self {
        let curve: Option<Curve> = match (format.light, space) {
            (false, WorkingSpace::Linear) => Some(srgb::decode),
            (true, WorkingSpace::Srgb) => Some(srgb::encode),
            _ => None,
        };
        let mut decoder = Self { format, curve, codes: None };
        let codes = P::Channel::CODES;
        if !A::PREMULTIPLIED && (codes == 256 || (codes > 0 && pixels >= WORTH_A_TABLE)) {
            let color = |code| {
                let value = decoder.value(P::Channel::of_code(code));
                curve.map_or(value, |curve| curve(value))
            };
            let colors: Vec<f32> = (0..codes).map(color).collect();
            let mut steps = [0; 256];
            for (step, color) in steps.iter_mut().zip(&colors) {
                let [whole, ..] = of_color([*color; 4]);
                *step = whole as u16;
            }
            decoder.codes = Some(Codes { colors, steps });
        }
        decoder
    }

    /// Whether no colour can be negative or above its alpha.
    pub(crate) fn is_bounded(&self) -> bool {
        self.format.is_bounded()
    }

    /// Whether every texel has codes; `opaque` tells whether all pixels are opaque.
    pub(crate) fn has_codes(&self, opaque: impl FnOnce() -> bool) -> bool {
        let coded = self.format.is_of_bytes() && self.curve.is_none();
        coded && (A::PREMULTIPLIED || opaque())
    }

    /// The texels of pixels.
    #[inline(always)]
    pub(crate) fn row<T: Cell>(&self, lanes: impl Lanes, pixels: &[P], out: &mut [T]) {
        let Some(codes) = &self.codes else {
            for (out, pixel) in out.iter_mut().zip(pixels) {
                *out = self.texel(pixel.spread(|c| self.value(c), |c| self.value(c)));
            }
            return;
        };
        if !T::ROUNDS || P::Channel::CODES != 256 {
            return self.by_table(&codes.colors, pixels, out);
        }
        // Opaque bytes are the most there are: no product and no rounding.
        if !P::ALPHA {
            return self.opaque(lanes, codes, pixels, out);
        }
        for (out, pixels) in out.chunks_mut(BLOCK).zip(pixels.chunks(BLOCK)) {
            let least = pixels.iter().map(|p| p.alpha().code()).fold(255, usize::min);
            if least == 255 {
                self.opaque(lanes, codes, pixels, out);
            } else if pixels.iter().all(|p| p.alpha().code() == 0) {
                out.fill(T::default());
            } else {
                self.by_table(&codes.colors, pixels, out);
            }
        }
    }

    /// Straight pixels of which each code stands in a table.
    #[inline(always)]
    fn by_table<T: Cell>(&self, table: &[f32], pixels: &[P], out: &mut [T]) {
        if P::Channel::CODES == 256 && self.curve.is_none() {
            // Products of codes are exact, and so are those of opaque pixels in steps.
            let code = |c: P::Channel| c.code() as f32;
            for (out, pixel) in out.iter_mut().zip(pixels) {
                let [r, g, b, a] = pixel.spread(code, code);
                let a = if P::ALPHA { a } else { 255.0 };
                *out = T::of_products([r * a, g * a, b * a, 255.0 * a]);
            }
            return;
        }
        // A slice of a size that is known holds every code.
        let table = &table[..P::Channel::CODES];
        if T::ROUNDS && P::Channel::CODES == 256 {
            for (out, pixels) in out.chunks_mut(BLOCK).zip(pixels.chunks(BLOCK)) {
                let mut steps = [[0.0; 4]; BLOCK];
                for (steps, pixel) in steps.iter_mut().zip(pixels) {
                    let [r, g, b, a] = pixel.spread(|c| table[c.code()], |c| PARTS[c.code() & 255]);
                    *steps = [r * a, g * a, b * a, a].map(|v| v * ONE);
                }
                T::put(&steps, out);
            }
            return;
        }
        for (out, pixel) in out.iter_mut().zip(pixels) {
            let [r, g, b, a] = pixel.spread(|c| table[c.code()], |c| self.value(c));
            *out = straight([r, g, b], unit(a));
        }
    }

    /// Opaque bytes.
    #[inline(always)]
    fn opaque<T: Cell>(&self, lanes: impl Lanes, codes: &Codes, pixels: &[P], out: &mut [T]) {
        if self.curve.is_some() {
            let steps = &codes.steps;
            for (out, pixel) in out.iter_mut().zip(pixels) {
                let [r, g, b] = pixel.color().map(|c| u64::from(steps[c.code() & 255]));
                // In one piece: four stores of 16 bits would take as long again.
                let texel = r | g << 16 | b << 32 | OPAQUE << 48;
                *out = T::of_steps([0, 16, 32, 48].map(|k| (texel >> k) as i16));
            }
            return;
        }
        let (mut done, bytes) = (0, P::Channel::bytes(P::flat(pixels)));
        if pixels.len() == out.len() && size_of::<P>() == 3 {
            done = T::of_rgb(lanes, bytes, out);
        }
        for (out, pixel) in out.iter_mut().zip(pixels).skip(done) {
            let [r, g, b] = pixel.color().map(|c| (c.code() << 6) as i16);
            *out = T::of_steps([r, g, b, OPAQUE as i16]);
        }
    }

    /// What a channel says, finite.
    #[inline(always)]
    fn value(&self, c: P::Channel) -> f32 {
        finite(if self.format.halves { half(c.code()) } else { c.value() })
    }

    /// The texel of a pixel's values.
    #[inline(always)]
    fn texel<T: Cell>(&self, [r, g, b, a]: [f32; 4]) -> T {
        let a = unit(a);
        let color = [r, g, b];
        let bounded = self.format.is_bounded();
        match self.curve {
            None if A::PREMULTIPLIED => premultiplied(color, a, bounded),
            Some(curve) if A::PREMULTIPLIED => {
                // What has no alpha is light that is added, and stands for itself.
                let share = if a > 0.0 { a } else { 1.0 };
                let color = color.map(|v| limited::<T>(curve(limited::<T>(v / share))) * share);
                premultiplied(color, a, bounded)
            }
            None => straight(color, a),
            Some(curve) => straight(color.map(|v| curve(limited::<T>(v))), a),
        }
    }
}

/// A number brought to 0…1 where no other is kept, else to what is finite.
#[inline(always)]
fn limited<T: Cell>(v: f32) -> f32 {
    if T::ROUNDS { unit(v) } else { finite(v) }
}

/// A number brought to within [`LARGEST`]; 0 for a NaN.
#[inline(always)]
fn finite(v: f32) -> f32 {
    if v > 0.0 {
        v.min(LARGEST)
    } else if v < 0.0 {
        v.max(-LARGEST)
    } else {
        0.0
    }
}

/// A number brought to 0…1.
#[inline(always)]
fn unit(v: f32) -> f32 {
    // Comparisons in this form are one instruction each.
    let v = if v > 0.0 { v } else { 0.0 };
    if v < 1.0 { v } else { 1.0 }
}

/// The texel of a straight colour.
#[inline(always)]
fn straight<T: Cell>(color: [f32; 3], a: f32) -> T {
    let [r, g, b] = color.map(|v| limited::<T>(v) * a);
    T::of_color([r, g, b, a])
}

/// The texel of a premultiplied colour.
#[inline(always)]
fn premultiplied<T: Cell>(color: [f32; 3], a: f32, bounded: bool) -> T {
    let bounded = T::ROUNDS || bounded;
    let [r, g, b] = color.map(|v| if bounded { v.max(0.0).min(a) } else { v });
    T::of_color([r, g, b, a])
}

/// The half float of these bits.
#[inline(always)]
pub(crate) fn half(bits: usize) -> f32 {
    let (sign, magnitude) = (bits & 0x8000, bits as u32 & 0x7fff);
    // As a float with the exponent still off by 112, which a product mends; infinities and NaNs are
    // those of the larger type.
    let value = if magnitude < 0x7c00 {
        f32::from_bits(magnitude << 13) * f32::from_bits(0x7780_0000)
    } else {
        f32::from_bits(0x7f80_0000 | (magnitude & 0x3ff) << 13)
    };
    if sign == 0 { value } else { -value }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_half_float_is_itself() {
        for bits in 0..=u16::MAX {
            let found = half(usize::from(bits));
            let (exponent, fraction) =
                (i32::from(bits >> 10 & 31), f64::from(bits & 0x3ff) / 1024.0);
            let sign = if bits & 0x8000 == 0 { 1.0 } else { -1.0 };
            match (exponent, fraction) {
                (31, 0.0) => assert_eq!(f64::from(found), sign * f64::INFINITY),
                (31, _) => assert!(found.is_nan()),
                (0, f) => assert_eq!(f64::from(found), sign * f * 2f64.powi(-14)),
                (e, f) => assert_eq!(f64::from(found), sign * (1.0 + f) * 2f64.powi(e - 15)),
            }
        }
    }
}
