//! Images in the formats that others keep them in.

use crate::TextureOptions;
use crate::decode::half;
use crate::pyramid::plan;
use core::marker::PhantomData;
use scumble_pixel::ImageView;

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
pub trait Channel: sealed::Sealed + Copy + Sync + Sized {
    #[doc(hidden)]
    const LIGHT: bool;
    /// How many different ones there are, if that is a number for a table, else 0.
    #[doc(hidden)]
    const CODES: usize;
    #[doc(hidden)]
    fn value(self) -> f32;
    /// Its place in such a table.
    #[doc(hidden)]
    fn code(self) -> usize;
    /// The one at a place.
    #[doc(hidden)]
    fn of_code(code: usize) -> Self;
    /// Bytes as they are; of others none.
    #[doc(hidden)]
    fn bytes(channels: &[Self]) -> &[u8];
}

impl Channel for u8 {
    const LIGHT: bool = false;
    const CODES: usize = 256;

    #[inline(always)]
    fn value(self) -> f32 {
        f32::from(self) / 255.0
    }

    #[inline(always)]
    fn code(self) -> usize {
        usize::from(self)
    }

    fn of_code(code: usize) -> Self {
        code as u8
    }

    #[inline(always)]
    fn bytes(channels: &[Self]) -> &[u8] {
        channels
    }
}

impl Channel for u16 {
    const LIGHT: bool = false;
    const CODES: usize = 65536;

    #[inline(always)]
    fn value(self) -> f32 {
        f32::from(self) / 65535.0
    }

    #[inline(always)]
    fn code(self) -> usize {
        usize::from(self)
    }

    fn of_code(code: usize) -> Self {
        code as u16
    }

    fn bytes(_: &[Self]) -> &[u8] {
        &[]
    }
}

impl Channel for f32 {
    const LIGHT: bool = true;
    const CODES: usize = 0;

    #[inline(always)]
    fn value(self) -> f32 {
        self
    }

    #[inline(always)]
    fn code(self) -> usize {
        0
    }

    fn of_code(_: usize) -> Self {
        0.0
    }

    fn bytes(_: &[Self]) -> &[u8] {
        &[]
    }
}

/// A pixel of one to four channels: grey; grey and alpha; red, green, blue; and with alpha.
pub trait Channels: sealed::Sealed + Copy + Sync + Sized {
    /// The type of each.
    type Channel: Channel;
    /// Whether the last of them is alpha.
    #[doc(hidden)]
    const ALPHA: bool;
    #[doc(hidden)]
    fn spread(
        self,
        color: impl Fn(Self::Channel) -> f32,
        alpha: impl Fn(Self::Channel) -> f32,
    ) -> [f32; 4];
    /// Red, green and blue.
    #[doc(hidden)]
    fn color(self) -> [Self::Channel; 3];
    /// The last channel.
    #[doc(hidden)]
    fn alpha(self) -> Self::Channel;
    #[doc(hidden)]
    fn flat(pixels: &[Self]) -> &[Self::Channel];
}

impl<C: Channel> Channels for [C; 1] {
    type Channel = C;
    const ALPHA: bool = false;

    #[inline(always)]
    fn spread(self, color: impl Fn(C) -> f32, _: impl Fn(C) -> f32) -> [f32; 4] {
        let y = color(self[0]);
        [y, y, y, 1.0]
    }

    #[inline(always)]
    fn color(self) -> [C; 3] {
        [self[0]; 3]
    }

    #[inline(always)]
    fn alpha(self) -> C {
        self[0]
    }

    #[inline(always)]
    fn flat(pixels: &[Self]) -> &[C] {
        pixels.as_flattened()
    }
}

impl<C: Channel> Channels for [C; 2] {
    type Channel = C;
    const ALPHA: bool = true;

    #[inline(always)]
    fn spread(self, color: impl Fn(C) -> f32, alpha: impl Fn(C) -> f32) -> [f32; 4] {
        let y = color(self[0]);
        [y, y, y, alpha(self[1])]
    }

    #[inline(always)]
    fn color(self) -> [C; 3] {
        [self[0]; 3]
    }

    #[inline(always)]
    fn alpha(self) -> C {
        self[1]
    }

    #[inline(always)]
    fn flat(pixels: &[Self]) -> &[C] {
        pixels.as_flattened()
    }
}

impl<C: Channel> Channels for [C; 3] {
    type Channel = C;
    const ALPHA: bool = false;

    #[inline(always)]
    fn spread(self, color: impl Fn(C) -> f32, _: impl Fn(C) -> f32) -> [f32; 4] {
        let [r, g, b] = self.map(color);
        [r, g, b, 1.0]
    }

    #[inline(always)]
    fn color(self) -> [C; 3] {
        [self[0], self[1], self[2]]
    }

    #[inline(always)]
    fn alpha(self) -> C {
        self[2]
    }

    #[inline(always)]
    fn flat(pixels: &[Self]) -> &[C] {
        pixels.as_flattened()
    }
}

impl<C: Channel> Channels for [C; 4] {
    type Channel = C;
    const ALPHA: bool = true;

    #[inline(always)]
    fn spread(self, color: impl Fn(C) -> f32, alpha: impl Fn(C) -> f32) -> [f32; 4] {
        let [r, g, b, a] = self;
        [color(r), color(g), color(b), alpha(a)]
    }

    #[inline(always)]
    fn color(self) -> [C; 3] {
        [self[0], self[1], self[2]]
    }

    #[inline(always)]
    fn alpha(self) -> C {
        self[3]
    }

    #[inline(always)]
    fn flat(pixels: &[Self]) -> &[C] {
        pixels.as_flattened()
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

/// What the numbers of an image mean: for a [`Texels`] or a [`TextureBuilder`](crate::TextureBuilder).
///
/// Whole numbers are taken for sRGB-encoded, floats for linear light, unless
/// [`TexelFormat::encoded`] or [`TexelFormat::in_light`] says otherwise. Alpha is never encoded.
#[derive(Debug)]
pub struct TexelFormat<P, A> {
    pub(crate) light: bool,
    pub(crate) halves: bool,
    pixel: PhantomData<fn() -> (P, A)>,
}

impl<P, A> Clone for TexelFormat<P, A> {
    fn clone(&self) -> Self {
        *self
    }
}

impl<P, A> Copy for TexelFormat<P, A> {}

impl<P: Channels> TexelFormat<P, StraightAlpha> {
    /// Colour apart from alpha, or no alpha at all.
    #[must_use]
    pub fn straight() -> Self {
        Self { light: P::Channel::LIGHT, halves: false, pixel: PhantomData }
    }
}

impl<P: Channels> TexelFormat<P, PremultipliedAlpha> {
    /// Colour multiplied by alpha.
    #[must_use]
    pub fn premultiplied() -> Self {
        Self { light: P::Channel::LIGHT, halves: false, pixel: PhantomData }
    }
}

impl<P: Channels, A: Alpha> TexelFormat<P, A> {
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

    pub(crate) fn is_of_bytes(&self) -> bool {
        P::Channel::CODES == 256
    }

    /// Whether no colour can be negative or above its alpha.
    pub(crate) fn is_bounded(&self) -> bool {
        P::Channel::CODES > 0 && !self.halves
    }
}

impl<P: Channels<Channel = u16>, A: Alpha> TexelFormat<P, A> {
    /// The numbers are the bits of half floats (IEEE 754 binary16), in linear light.
    #[must_use]
    pub fn half_floats(self) -> Self {
        Self { halves: true, light: true, ..self }
    }
}

/// A borrowed image and what its numbers mean, to make a [`Texture`](crate::Texture) of.
///
/// The view may be of foreign memory and have a stride. Whole numbers are taken for sRGB-encoded,
/// floats for linear light, unless [`Texels::encoded`] or [`Texels::in_light`] says otherwise. Alpha is
/// never encoded, and is brought to 0…1. Colours are kept as they are, whatever their brightness, if
/// they are stored as floats ([`Storage`](crate::Storage)), else brought to 0…1; a NaN is 0.
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
    pub(crate) view: ImageView<'a, P>,
    pub(crate) format: TexelFormat<P, A>,
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
        Self { view, format: TexelFormat::straight() }
    }
}

impl<'a, P: Channels> Texels<'a, P, PremultipliedAlpha> {
    /// Colour multiplied by alpha.
    #[must_use]
    pub fn premultiplied(view: ImageView<'a, P>) -> Self {
        Self { view, format: TexelFormat::premultiplied() }
    }
}

impl<P: Channels, A: Alpha> Texels<'_, P, A> {
    /// The numbers are sRGB-encoded.
    #[must_use]
    pub fn encoded(self) -> Self {
        Self { format: self.format.encoded(), ..self }
    }

    /// The numbers are proportional to light.
    #[must_use]
    pub fn in_light(self) -> Self {
        Self { format: self.format.in_light(), ..self }
    }

    /// Columns and rows.
    #[must_use]
    pub fn size(&self) -> [usize; 2] {
        [self.view.width(), self.view.height()]
    }

    /// What of it a texture keeps as its level 0.
    pub(crate) fn part(&self, options: &TextureOptions) -> Self {
        let [columns, rows] = plan::kept_part(self.size(), 0, options);
        let view = self.view.crop(columns.start, rows.start, columns.len(), rows.len());
        Self { view, ..*self }
    }

    /// Whether every pixel is opaque.
    #[must_use]
    pub fn is_opaque(&self) -> bool {
        let one = |c: P::Channel| if self.format.halves { half(c.code()) } else { c.value() };
        let opaque = |p: &P| p.spread(|_| 0.0, one)[3] >= 1.0;
        let all = |row: &[P]| match P::Channel::bytes(P::flat(row)) {
            [] => row.iter().all(opaque),
            bytes => every_alpha_is_full(bytes, size_of::<P>()),
        };
        !P::ALPHA || self.view.rows().all(all)
    }
}

/// Whether the last byte of every pixel of two or four is 255.
fn every_alpha_is_full(bytes: &[u8], pixel: usize) -> bool {
    let mut all = [255; 16];
    let (blocks, rest) = bytes.as_chunks::<16>();
    // What is set in all of them: a block at a time, and without a branch.
    for block in blocks {
        for (all, byte) in all.iter_mut().zip(block) {
            *all &= byte;
        }
    }
    for (all, byte) in all.iter_mut().zip(rest) {
        *all &= byte;
    }
    all.chunks_exact(pixel).all(|pixel| pixel.last() == Some(&255))
}

impl<P: Channels<Channel = u16>, A: Alpha> Texels<'_, P, A> {
    /// The numbers are the bits of half floats (IEEE 754 binary16), in linear light.
    #[must_use]
    pub fn half_floats(self) -> Self {
        Self { format: self.format.half_floats(), ..self }
    }
}
