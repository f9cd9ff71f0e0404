//! A picture as colours, for what works on whole planes of numbers.

use super::{Picture, Tone};
use scumble::pixel::{Image, Premul, WorkingSpace};

impl Tone {
    /// What numbers that are worked upon in a space are to light, where those of the picture have this
    /// tone: in sRGB's space, where numbers are averaged as they are, those of a profile stay as they are.
    pub(crate) fn working(&self, space: WorkingSpace) -> Self {
        match (space, self) {
            (WorkingSpace::Linear, _) => Self::Linear,
            (WorkingSpace::Srgb, Self::Curves(_)) => self.clone(),
            (WorkingSpace::Srgb, _) => Self::Srgb,
        }
    }
}

impl Picture {
    /// The colours in a space, nothing clipped.
    pub(crate) fn colors(&self, space: WorkingSpace) -> Image<Premul> {
        let working = self.tone.working(space);
        let same = working == self.tone;
        let n = self.channels.count();
        let (gray, has_alpha) = (self.channels.is_gray(), self.channels.has_alpha());
        let color = |i: usize| {
            let at = |c: usize| self.pixels.at(i * n + c);
            let alpha = if has_alpha { at(n - 1) } else { 1.0 };
            let stored = if gray { [at(0); 3] } else { [at(0), at(1), at(2)] };
            // Light that comes without alpha stays as it is.
            let divisor = if self.premultiplied && alpha > 0.0 { alpha } else { 1.0 };
            let factor = if self.premultiplied { divisor } else { alpha };
            let mut out = [alpha; 4];
            for (channel, (out, v)) in out.iter_mut().zip(stored).enumerate() {
                *out = if same {
                    v * (factor / divisor)
                } else {
                    working.encode(channel, self.tone.decode(channel, v / divisor)) * factor
                };
            }
            Premul(out)
        };
        let (width, height) = (self.width as usize, self.height as usize);
        Image::from_fn(width, height, |x, y| color(y * width + x)).unwrap_or_default()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::picture::{Channels, Depth, Format, Origin, Pixels};

    fn picture(channels: Channels, pixels: Pixels, tone: Tone, premultiplied: bool) -> Picture {
        let (format, depth) = (Format::Tiff, Depth::Eight);
        let origin = Origin { format, depth, orientation: 1, notes: Vec::new() };
        let width = (pixels.len() / channels.count()) as u32;
        Picture { width, height: 1, channels, pixels, premultiplied, tone, icc: None, origin }
    }

    #[test]
    fn codes_are_what_a_space_takes_them_for() {
        let codes = [[255, 128, 0, 51], [1, 2, 3, 255], [9, 9, 9, 0]];
        let rgba = picture(Channels::Rgba, Pixels::U8(codes.concat()), Tone::Srgb, false);
        for space in [WorkingSpace::Srgb, WorkingSpace::Linear] {
            let expected = codes.map(|c| space.import8(c));
            assert_eq!(rgba.colors(space).pixels(), expected);
        }
    }

    #[test]
    fn light_keeps_its_numbers_and_its_glow() {
        // A colour, one twice as bright as white, and one that only adds.
        let light = vec![0.25, 0.5, 2.0, 0.5, 0.5, 0.0];
        let glow = picture(Channels::GrayAlpha, Pixels::F32(light), Tone::Linear, true);
        let grays: Vec<[f32; 2]> =
            glow.colors(WorkingSpace::Linear).pixels().iter().map(|c| [c.0[0], c.0[3]]).collect();
        assert_eq!(grays, [[0.25, 0.5], [2.0, 0.5], [0.5, 0.0]]);
        let encoded = glow.colors(WorkingSpace::Srgb);
        let half = Tone::Srgb.encode(0, 0.5);
        assert_eq!([encoded.pixels()[0].0[0], encoded.pixels()[2].0[0]], [half * 0.5, half]);
    }
}
