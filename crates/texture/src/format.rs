//! Images in the formats that others keep them in.

use crate::pyramid::Rows;
use crate::texel::{ONE, whole};
use core::marker::PhantomData;
use scumble_pixel::{ImageView, Premul, Straight, WorkingSpace, srgb};

/// The type of [`Texels`] whose colour stands apart from the alpha.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct StraightAlpha;

/// The type of [`Texels`] whose colour has been multiplied by the alpha: the stored number, encoded or
/// not.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct PremultipliedAlpha;

/// Kinds of alpha.
pub trait Alpha: sealed::Sealed + Copy + Sync {
    #[doc(hidden)]
    const PREMULTIPLIED: bool;
}

impl Alpha for StraightAlpha {
    const PREMULTIPLIED: bool = false;
}

impl Alpha for PremultipliedAlpha {
    const PREMULTIPLIED: bool = true;
}

/// A channel as it is stored: `u8` and `u16` are parts of 255 and 65535, `f32` is itself.
pub trait Channel: sealed::Sealed + Copy + Sync {
    #[doc(hidden)]
    const LIGHT: bool;
    #[doc(hidden)]
    fn value(self) -> f32;
}

impl Channel for u8 {
    const LIGHT: bool = false;

    #[inline(always)]
    fn value(self) -> f32 {
        f32::from(self) / 255.0
    }
}

impl Channel for u16 {
    const LIGHT: bool = false;

    #[inline(always)]
    fn value(self) -> f32 {
        f32::from(self) / 65535.0
    }
}

impl Channel for f32 {
    const LIGHT: bool = true;

    #[inline(always)]
    fn value(self) -> f32 {
        self
    }
}

/// A pixel of one to four channels: grey; grey and alpha; red, green, blue; and with alpha.
pub trait Channels: sealed::Sealed + Copy + Sync {
    /// The type of each.
    type Channel: Channel;
    #[doc(hidden)]
    fn spread(self, value: impl Fn(Self::Channel) -> f32) -> [f32; 4];
}

impl<C: Channel> Channels for [C; 1] {
    type Channel = C;

    #[inline(always)]
    fn spread(self, value: impl Fn(C) -> f32) -> [f32; 4] {
        let [y] = self.map(value);
        [y, y, y, 1.0]
    }
}

impl<C: Channel> Channels for [C; 2] {
    type Channel = C;

    #[inline(always)]
    fn spread(self, value: impl Fn(C) -> f32) -> [f32; 4] {
        let [y, a] = self.map(value);
        [y, y, y, a]
    }
}

impl<C: Channel> Channels for [C; 3] {
    type Channel = C;

    #[inline(always)]
    fn spread(self, value: impl Fn(C) -> f32) -> [f32; 4] {
        let [r, g, b] = self.map(value);
        [r, g, b, 1.0]
    }
}

impl<C: Channel> Channels for [C; 4] {
    type Channel = C;

    #[inline(always)]
    fn spread(self, value: impl Fn(C) -> f32) -> [f32; 4] {
        self.map(value)
    }
}

mod sealed {
    pub trait Sealed {}
    impl Sealed for super::StraightAlpha {}
    impl Sealed for super::PremultipliedAlpha {}
    impl Sealed for u8 {}
    impl Sealed for u16 {}
    impl Sealed for f32 {}
    impl<C: Sealed, const N: usize> Sealed for [C; N] {}
}

/// A borrowed image and what its numbers mean, to make a [`Texture`](crate::Texture) of.
///
/// The view may be of foreign memory and have a stride. Whole numbers are taken for sRGB-encoded,
/// floats for linear light, unless [`Texels::encoded`] or [`Texels::in_light`] says otherwise. Alpha is
/// never encoded. Numbers outside 0…1 are brought back to it, and a NaN is 0: a texture's samples lie
/// in 0…1, so what is brighter is not kept.
///
/// ```
/// use scumble_pixel::ImageView;
/// use scumble_texture::{Texels, Texture, TextureOptions};
///
/// // The middle of a larger RGB image in half floats, without a copy.
/// let memory = [[0x3800_u16, 0x3c00, 0x0000]; 100];
/// let view = ImageView::new(6, 8, 10, &memory[12..])?;
/// let texture = Texture::from_texels(&Texels::straight(view).half_floats(), &TextureOptions::default())?;
/// assert_eq!((texture.width(), texture.height()), (6, 8));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug)]
pub struct Texels<'a, P, A> {
    view: ImageView<'a, P>,
    light: bool,
    halves: bool,
    alpha: PhantomData<A>,
}

impl<P, A> Clone for Texels<'_, P, A> {
    fn clone(&self) -> Self {
        *self
    }
}

impl<P, A> Copy for Texels<'_, P, A> {}

impl<'a, P: Channels> Texels<'a, P, StraightAlpha> {
    /// Colour apart from alpha, or no alpha at all.
    #[must_use]
    pub fn straight(view: ImageView<'a, P>) -> Self {
        Self { view, light: P::Channel::LIGHT, halves: false, alpha: PhantomData }
    }
}

impl<'a, P: Channels> Texels<'a, P, PremultipliedAlpha> {
    /// Colour multiplied by alpha.
    #[must_use]
    pub fn premultiplied(view: ImageView<'a, P>) -> Self {
        Self { view, light: P::Channel::LIGHT, halves: false, alpha: PhantomData }
    }
}

impl<P: Channels, A: Alpha> Texels<'_, P, A> {
    /// The numbers are sRGB-encoded.
    #[must_use]
    pub fn encoded(self) -> Self {
        Self { light: false, ..self }
    }

    /// The numbers are proportional to light.
    #[must_use]
    pub fn in_light(self) -> Self {
        Self { light: true, ..self }
    }

    /// Columns and rows.
    #[must_use]
    pub fn size(&self) -> [usize; 2] {
        [self.view.width(), self.view.height()]
    }

    /// Whether every pixel is opaque.
    #[must_use]
    pub fn is_opaque(&self) -> bool {
        let value = |c: P::Channel| if self.halves { half(c.value()) } else { c.value() };
        self.view.rows().all(|row| row.iter().all(|p| p.spread(value)[3] >= 1.0))
    }

    /// A pixel in a working space.
    #[inline(always)]
    fn import(&self, pixel: P, space: WorkingSpace) -> Premul {
        let value = |c: P::Channel| {
            let v = c.value();
            let v = if self.halves { half(v) } else { v };
            // Written so that a NaN is 0.
            if v > 0.0 { v.min(1.0) } else { 0.0 }
        };
        let color = pixel.spread(value);
        let curve: fn(f32) -> f32 = match (self.light, space) {
            (false, WorkingSpace::Linear) => srgb::decode,
            (true, WorkingSpace::Srgb) => srgb::encode,
            _ => {
                return if A::PREMULTIPLIED {
                    let [r, g, b, a] = color;
                    Premul([r.min(a), g.min(a), b.min(a), a])
                } else {
                    Straight(color).premultiply()
                };
            }
        };
        let Straight([r, g, b, a]) =
            if A::PREMULTIPLIED { Premul(color).unpremultiply() } else { Straight(color) };
        let [r, g, b] = [r, g, b].map(|v| curve(v.min(1.0)));
        Straight([r, g, b, a]).premultiply()
    }
}

impl<P: Channels<Channel = u16>, A: Alpha> Texels<'_, P, A> {
    /// The numbers are the bits of half floats (IEEE 754 binary16), in linear light.
    #[must_use]
    pub fn half_floats(self) -> Self {
        Self { halves: true, light: true, ..self }
    }
}

/// A half float whose bits, as a part of 65535, are this; the product is exact enough to give them
/// back.
#[inline(always)]
fn half(part: f32) -> f32 {
    // The quotient that made it was within half an ulp, and 65535 parts are far wider than that.
    let bits = (part * 65535.0 + 0.5) as u32;
    let (sign, magnitude) = (bits & 0x8000, bits & 0x7fff);
    // As a float with the exponent still off by 112, which a product mends; infinities and NaNs are
    // those of the larger type.
    let value = if magnitude < 0x7c00 {
        f32::from_bits(magnitude << 13) * f32::from_bits(0x7780_0000)
    } else {
        f32::from_bits(0x7f80_0000 | (magnitude & 0x3ff) << 13)
    };
    if sign == 0 { value } else { -value }
}

/// Texels on their way into a space.
pub(crate) struct Imported<'a, P, A> {
    pub(crate) texels: &'a Texels<'a, P, A>,
    pub(crate) space: WorkingSpace,
}

impl<P: Channels, A: Alpha> Rows for Imported<'_, P, A> {
    fn width(&self) -> usize {
        self.texels.view.width()
    }

    fn height(&self) -> usize {
        self.texels.view.height()
    }

    #[inline(always)]
    fn read(&self, y: usize, out: &mut [[f32; 4]]) {
        for (out, pixel) in out.iter_mut().zip(self.texels.view.row(y)) {
            *out = self.texels.import(*pixel, self.space).0.map(|v| whole(v * ONE));
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_half_float_is_itself() {
        for bits in 0..=u16::MAX {
            let found = half(bits.value());
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
