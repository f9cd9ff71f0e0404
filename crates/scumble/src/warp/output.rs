use crate::framebuffer::{encode_row, encode_row16};
use crate::pixel::{Premul, Straight, WorkingSpace, srgb};

/// A pixel of the output: red, green, blue and alpha, which is straight.
///
/// | type | numbers |
/// |---|---|
/// | `[u8; 4]` | sRGB-encoded, in eight bits, rounded to nearest |
/// | `[u16; 4]` | sRGB-encoded, in sixteen |
/// | `[f32; 4]` | proportional to light, neither rounded nor cut |
/// | [`Premul`] | as they were averaged: in the working space, multiplied by alpha |
pub trait OutputPixel: Copy + Default + Send + Sync + sealed::Sealed {
    #[doc(hidden)]
    fn encode(row: &[Premul], space: WorkingSpace, out: &mut [Self]);
    /// The numbers as codes of eight bits with their fractions, and alpha in 0…1.
    #[doc(hidden)]
    fn codes(self, space: WorkingSpace) -> [f64; 4];
}

impl OutputPixel for [u8; 4] {
    fn encode(row: &[Premul], space: WorkingSpace, out: &mut [Self]) {
        encode_row(row, space, out);
    }

    fn codes(self, _: WorkingSpace) -> [f64; 4] {
        let [r, g, b, a] = self.map(f64::from);
        [r, g, b, a / 255.0]
    }
}

impl OutputPixel for [u16; 4] {
    fn encode(row: &[Premul], space: WorkingSpace, out: &mut [Self]) {
        encode_row16(row, space, out);
    }

    fn codes(self, _: WorkingSpace) -> [f64; 4] {
        let [r, g, b, a] = self.map(|v| f64::from(v) / 257.0);
        [r, g, b, a / 255.0]
    }
}

impl OutputPixel for [f32; 4] {
    fn encode(row: &[Premul], space: WorkingSpace, out: &mut [Self]) {
        for (out, pixel) in out.iter_mut().zip(row) {
            let Straight([r, g, b, a]) = pixel.unpremultiply();
            *out = match space {
                WorkingSpace::Linear => [r, g, b, a],
                WorkingSpace::Srgb => [srgb::decode(r), srgb::decode(g), srgb::decode(b), a],
            };
        }
    }

    fn codes(self, _: WorkingSpace) -> [f64; 4] {
        let [r, g, b, a] = self;
        let [r, g, b] = [r, g, b].map(|v| f64::from(srgb::encode(v)) * 255.0);
        [r, g, b, a.into()]
    }
}

impl OutputPixel for Premul {
    fn encode(row: &[Premul], _: WorkingSpace, out: &mut [Self]) {
        out.copy_from_slice(row);
    }

    fn codes(self, space: WorkingSpace) -> [f64; 4] {
        let [r, g, b, a] = space.export_straight(self).0.map(f64::from);
        [r * 255.0, g * 255.0, b * 255.0, a]
    }
}

mod sealed {
    pub trait Sealed {}
    impl Sealed for [u8; 4] {}
    impl Sealed for [u16; 4] {}
    impl Sealed for [f32; 4] {}
    impl Sealed for crate::pixel::Premul {}
}
