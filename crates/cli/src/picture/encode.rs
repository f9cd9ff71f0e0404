//! Rows of colours into numbers for a file.

use super::{Channels, Form, Pixels, Tone};
use scumble::pixel::{Premul, WorkingSpace, unorm8, unorm16};

/// Turns premultiplied colours of a working space into the numbers of a file.
#[derive(Debug, Clone)]
pub(crate) struct Encoder {
    space: WorkingSpace,
    /// What the working numbers are to light.
    working: Tone,
    /// What the file's numbers are to light.
    written: Tone,
    /// Whether the two are one.
    same: bool,
    channels: Channels,
    /// Whether the file's colours are multiplied by alpha.
    premultiplied: bool,
}

impl Encoder {
    /// One for files of a form, out of a picture whose tone was `tone` and that was worked upon in
    /// `space`.
    ///
    /// A file with a profile has the numbers that the profile means. Without one, whole numbers are
    /// sRGB's and floats are light.
    pub(crate) fn new(space: WorkingSpace, tone: &Tone, form: &Form) -> Self {
        let written = match form.icc {
            Some(_) => tone.clone(),
            None if form.depth.is_float() => Tone::Linear,
            None => Tone::Srgb,
        };
        Self::into_numbers(space, tone, written, form.channels, form.format.premultiplies())
    }

    /// One for numbers whose tone is `written`.
    pub(crate) fn into_numbers(
        space: WorkingSpace,
        tone: &Tone,
        written: Tone,
        channels: Channels,
        premultiplied: bool,
    ) -> Self {
        let working = tone.working(space);
        let same = working == written;
        Self { space, working, written, same, channels, premultiplied }
    }

    /// Appends the numbers of a row to `out`, which [`Pixels::empty`] made for the form's depth.
    pub(crate) fn row(&self, colors: &[Premul], out: &mut Pixels) {
        match out {
            Pixels::U8(out) if self.is_plain() => {
                for &color in colors {
                    put(self.channels, self.space.export(color), out);
                }
            }
            Pixels::U8(out) => self.append(colors, out, unorm8),
            Pixels::U16(out) => self.append(colors, out, unorm16),
            Pixels::F32(out) => self.append(colors, out, |v| v),
        }
    }

    /// Appends numbers that are no colours, straight and on the scale where the largest is 1.
    pub(crate) fn data(channels: Channels, texels: &[[f32; 4]], out: &mut Pixels) {
        match out {
            Pixels::U8(out) => texels.iter().for_each(|t| put(channels, t.map(unorm8), out)),
            Pixels::U16(out) => texels.iter().for_each(|t| put(channels, t.map(unorm16), out)),
            Pixels::F32(out) => texels.iter().for_each(|t| put(channels, *t, out)),
        }
    }

    /// Whether the way out is from sRGB or light to sRGB, which is the working space's own.
    fn is_plain(&self) -> bool {
        let known = !matches!(self.working, Tone::Curves(_));
        known && self.written == Tone::Srgb && !self.premultiplied
    }

    fn append<T: Copy>(&self, colors: &[Premul], out: &mut Vec<T>, to: impl Fn(f32) -> T) {
        for &color in colors {
            put(self.channels, self.numbers(color).map(&to), out);
        }
    }

    /// A colour on the scale where white is 1.
    fn numbers(&self, color: Premul) -> [f32; 4] {
        if self.premultiplied && self.same {
            return color.0;
        }
        let Premul([.., alpha]) = color;
        // Light that comes without alpha stays as it is where there can be such.
        let glow = self.premultiplied && alpha <= 0.0;
        let [r, g, b, _] = if glow { color.0 } else { color.unpremultiply().0 };
        let mut color = [r, g, b];
        if !self.same {
            for (channel, v) in color.iter_mut().enumerate() {
                *v = self.written.encode(channel, self.working.decode(channel, *v));
            }
        }
        let factor = if self.premultiplied && !glow { alpha } else { 1.0 };
        let [r, g, b] = color.map(|v| v * factor);
        [r, g, b, alpha]
    }
}

/// Appends the numbers of a pixel that there are channels for.
fn put<T: Copy>(channels: Channels, [r, g, b, a]: [T; 4], out: &mut Vec<T>) {
    match channels {
        Channels::Gray => out.push(r),
        Channels::GrayAlpha => out.extend([r, a]),
        Channels::Rgb => out.extend([r, g, b]),
        Channels::Rgba => out.extend([r, g, b, a]),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::picture::{Depth, Format, Origin, Picture};
    use proptest::prelude::*;
    use scumble::texture::{Levels, TextureOptions};

    fn picture(channels: Channels, pixels: Pixels, tone: Tone) -> Picture {
        let count = pixels.len() / channels.count();
        let origin =
            Origin { format: Format::Png, depth: Depth::Eight, orientation: 1, notes: Vec::new() };
        Picture {
            width: count as u32,
            height: 1,
            channels,
            pixels,
            premultiplied: false,
            tone,
            icc: None,
            origin,
        }
    }

    /// The picture through a texture and back.
    fn round_trip(picture: &Picture, space: WorkingSpace, depth: Depth) -> Pixels {
        let options = TextureOptions { space, levels: Levels::BaseOnly, ..Default::default() };
        let texture = picture.texture(&options).unwrap();
        let colors: Vec<Premul> =
            texture.level(0).unwrap().row(0).iter().map(|&c| Premul(c)).collect();
        let form = picture.form(Format::Tiff, depth);
        let mut out = Pixels::empty(depth);
        Encoder::new(space, &picture.tone, &form).row(&colors, &mut out);
        out
    }

    proptest! {
        #[test]
        fn eight_bits_come_back(codes in proptest::collection::vec(any::<u8>(), 4..64)) {
            let codes = codes[..codes.len() / 4 * 4].to_vec();
            // A texture's steps hold 8 bits of encoded numbers; light takes more of them.
            for channels in [Channels::Gray, Channels::Rgba] {
                let mut codes = codes.clone();
                if channels.has_alpha() {
                    codes.chunks_exact_mut(4).for_each(|p| p[3] = 255);
                }
                let picture = picture(channels, Pixels::U8(codes.clone()), Tone::Srgb);
                let back = round_trip(&picture, WorkingSpace::Srgb, Depth::Eight);
                prop_assert_eq!(back, Pixels::U8(codes));
            }
        }
    }

    #[test]
    fn light_goes_out_as_light_and_as_srgb() {
        let picture = picture(Channels::Gray, Pixels::F32(vec![0.0, 0.5, 1.0]), Tone::Linear);
        for space in [WorkingSpace::Srgb, WorkingSpace::Linear] {
            let Pixels::F32(light) = round_trip(&picture, space, Depth::Float) else { panic!() };
            assert!((light[1] - 0.5).abs() < 1e-4 && light[2] == 1.0);
            let codes = round_trip(&picture, space, Depth::Eight);
            assert_eq!(codes, Pixels::U8(vec![0, 188, 255]));
        }
    }
}
