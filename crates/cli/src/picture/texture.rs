//! A picture as the filters take it.

use super::{Channels, Picture, Pixels, Tone};
use scumble::pixel::{ImageView, WorkingSpace};
use scumble::texture::{Channels as TexelChannels, Texels, Texture, TextureError, TextureOptions};
use std::ops::Range;

impl Picture {
    /// The texture of the picture.
    ///
    /// In linear light the picture's own curve is undone. In sRGB's space, where the numbers are
    /// averaged as they are, those of a profile stay as they are too.
    pub(crate) fn texture(&self, options: &TextureOptions) -> Result<Texture, TextureError> {
        let curves = matches!(self.tone, Tone::Curves(_));
        if curves && options.space == WorkingSpace::Linear {
            return self.floats(&self.to_linear(), true, options);
        }
        let light = self.tone == Tone::Linear;
        match (&self.pixels, self.channels) {
            (Pixels::U8(v), _) if light || self.premultiplied => {
                self.floats(&scaled(v, 255.0), light, options)
            }
            (Pixels::U8(v), Channels::Gray) => self.codes(v.as_chunks::<1>().0, options),
            (Pixels::U8(v), Channels::GrayAlpha) => self.codes(v.as_chunks::<2>().0, options),
            (Pixels::U8(v), Channels::Rgb) => self.codes(v.as_chunks::<3>().0, options),
            (Pixels::U8(v), Channels::Rgba) => self.codes(v.as_chunks::<4>().0, options),
            (Pixels::U16(v), _) => self.floats(&scaled(v, 65535.0), light, options),
            (Pixels::F32(v), _) => self.floats(v, light, options),
        }
    }

    /// The numbers as light on the scale where white is 1, in the primaries that the picture has;
    /// nothing is clipped. Alpha stays, and stays multiplied in if it was.
    pub(crate) fn to_linear(&self) -> Vec<f32> {
        let n = self.channels.count();
        let colors = if self.channels.has_alpha() { n - 1 } else { n };
        let mut values: Vec<f32> = (0..self.pixels.len()).map(|i| self.pixels.at(i)).collect();
        for pixel in values.chunks_exact_mut(n) {
            let (color, alpha) = pixel.split_at_mut(colors);
            let divisor = match alpha {
                [a] if self.premultiplied && *a > 0.0 => *a,
                _ => 1.0,
            };
            for (channel, v) in color.iter_mut().enumerate() {
                *v = self.tone.decode(channel, *v / divisor) * divisor;
            }
        }
        values
    }

    /// Some of the channels as a picture of their own, whose numbers are taken for sRGB's.
    pub(crate) fn part(&self, channels: Range<usize>) -> Self {
        let n = self.channels.count();
        fn taken<T: Copy>(v: &[T], n: usize, channels: Range<usize>) -> Vec<T> {
            v.chunks_exact(n).flat_map(|pixel| &pixel[channels.clone()]).copied().collect()
        }
        let chosen = Channels::of_count(channels.len().min(n)).unwrap_or(self.channels);
        let pixels = match &self.pixels {
            Pixels::U8(v) => Pixels::U8(taken(v, n, channels)),
            Pixels::U16(v) => Pixels::U16(taken(v, n, channels)),
            Pixels::F32(v) => Pixels::F32(taken(v, n, channels)),
        };
        let (width, height, origin) = (self.width, self.height, self.origin.clone());
        let (tone, premultiplied, icc) = (Tone::Srgb, false, None);
        Self { width, height, channels: chosen, pixels, premultiplied, tone, icc, origin }
    }

    /// The texture of straight encoded codes, the common case.
    fn codes<P: TexelChannels>(
        &self,
        pixels: &[P],
        options: &TextureOptions,
    ) -> Result<Texture, TextureError> {
        Texture::from_texels(&Texels::straight(self.view(pixels)?).encoded(), options)
    }

    /// The texture of floats of this picture's channels, which become four.
    fn floats(
        &self,
        values: &[f32],
        light: bool,
        options: &TextureOptions,
    ) -> Result<Texture, TextureError> {
        let pixels: Vec<[f32; 4]> = match self.channels {
            Channels::Gray => values.iter().map(|&y| [y, y, y, 1.0]).collect(),
            Channels::GrayAlpha => {
                values.as_chunks().0.iter().map(|&[y, a]| [y, y, y, a]).collect()
            }
            Channels::Rgb => values.as_chunks().0.iter().map(|&[r, g, b]| [r, g, b, 1.0]).collect(),
            Channels::Rgba => values.as_chunks().0.to_vec(),
        };
        let view = self.view(&pixels)?;
        if self.premultiplied {
            let texels = Texels::premultiplied(view);
            Texture::from_texels(&if light { texels } else { texels.encoded() }, options)
        } else {
            let texels = Texels::straight(view);
            Texture::from_texels(&if light { texels } else { texels.encoded() }, options)
        }
    }

    fn view<'a, P>(&self, pixels: &'a [P]) -> Result<ImageView<'a, P>, TextureError> {
        let (width, height) = (self.width as usize, self.height as usize);
        ImageView::new(width, height, width, pixels).map_err(|_| TextureError::Empty)
    }
}

/// Codes on the scale where the largest is 1.
fn scaled<T: Copy + Into<f32>>(codes: &[T], largest: f32) -> Vec<f32> {
    codes.iter().map(|&v| v.into() / largest).collect()
}
