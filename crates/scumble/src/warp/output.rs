use crate::framebuffer::{encode_row, encode_row16};
use crate::pixel::{Premul, Straight, WorkingSpace, srgb};

/// A pixel of the output: red, green, blue and straight alpha.
///
/// | type | numbers |
/// |---|---|
/// | `[u8; 4]` | sRGB-encoded, in eight bits, rounded to nearest |
/// | `[u16; 4]` | sRGB-encoded, in sixteen |
/// | `[f32; 4]` | proportional to light, neither rounded nor cut |
pub trait OutputPixel: Copy + Default + Send + Sync + sealed::Sealed {
    #[doc(hidden)]
    fn encode(row: &[Premul], space: WorkingSpace, out: &mut [Self]);
}

impl OutputPixel for [u8; 4] {
    fn encode(row: &[Premul], space: WorkingSpace, out: &mut [Self]) {
        encode_row(row, space, out);
    }
}

impl OutputPixel for [u16; 4] {
    fn encode(row: &[Premul], space: WorkingSpace, out: &mut [Self]) {
        encode_row16(row, space, out);
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
}

mod sealed {
    pub trait Sealed {}
    impl Sealed for [u8; 4] {}
    impl Sealed for [u16; 4] {}
    impl Sealed for [f32; 4] {}
}
