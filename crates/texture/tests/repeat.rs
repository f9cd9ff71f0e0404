//! Textures that repeat, seen from afar at a slant.

#![allow(clippy::unwrap_used, reason = "a test helper may fail its test")]

use scumble_geometry::Matrix2;
use scumble_pixel::Image;
use scumble_texture::{Footprint, Sampler, Texture, TextureOptions, Wrap};

/// Two by two squares of eight texels, which repeat to a checkerboard without end.
fn checker() -> Texture {
    let texel =
        |i: usize| if (i / 8 + i / 128).is_multiple_of(2) { [255; 4] } else { [0, 0, 0, 255] };
    let image = Image::from_vec(16, 16, (0..256).map(texel).collect()).unwrap();
    let options = TextureOptions { wrap: Wrap::Repeat, ..TextureOptions::default() };
    Texture::new(image.view(), &options).unwrap()
}

/// A ground plane towards its horizon, off to the side: the ellipse is thin, crosses many squares,
/// and lies along neither axis.
#[test]
fn a_long_slanted_ellipse_averages_all_that_it_crosses() {
    let texture = checker();
    for (dx, dy) in [(0.6, 0.8), (0.8, 0.6), (-0.28, 0.96), (0.96, -0.28)] {
        let (long, wide) = (320.0, 10.0);
        let jacobian = Matrix2::new(long * dx, -wide * dy, long * dy, wide * dx);
        for i in 0..64 {
            let (u, v) = (f64::from(i % 8) * 2.1, f64::from(i / 8) * 2.1);
            let footprint = Footprint { u, v, jacobian };
            let [r, ..] = texture.sample(&footprint, &Sampler::default()).0;
            assert!((r - 0.5).abs() < 0.02, "{r} at ({u}, {v}) along ({dx}, {dy})");
            assert!(texture.cost(&footprint, &Sampler::default()) < 32_768);
        }
    }
}
