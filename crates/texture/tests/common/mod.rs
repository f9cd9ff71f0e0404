//! Images and maps that several tests share.
#![allow(dead_code, reason = "each test binary uses some of it")]
#![allow(clippy::unwrap_used, reason = "a test helper may fail its test")]

use scumble_geometry::Homography;
use scumble_pixel::Image;

/// A small generator of numbers, the same everywhere (xorshift64*).
pub(crate) struct Random(u64);

impl Random {
    pub(crate) fn new(seed: u64) -> Self {
        Self(seed.wrapping_mul(0x9e37_79b9_7f4a_7c15) | 1)
    }

    pub(crate) fn next(&mut self) -> u64 {
        self.0 ^= self.0 >> 12;
        self.0 ^= self.0 << 25;
        self.0 ^= self.0 >> 27;
        self.0.wrapping_mul(0x2545_f491_4f6c_dd1d)
    }

    /// In [0, 1).
    pub(crate) fn unit(&mut self) -> f64 {
        (self.next() >> 11) as f64 / (1u64 << 53) as f64
    }

    pub(crate) fn range(&mut self, from: f64, to: f64) -> f64 {
        from + (to - from) * self.unit()
    }
}

/// An opaque grey image from a function of the texel.
pub(crate) fn grey(
    width: usize,
    height: usize,
    mut f: impl FnMut(usize, usize) -> u8,
) -> Image<[u8; 4]> {
    let texel = |i| {
        let v = f(i % width, i / width);
        [v, v, v, 255]
    };
    Image::from_vec(width, height, (0..width * height).map(texel).collect()).unwrap()
}

/// A checkerboard with squares of `size` texels.
pub(crate) fn checker(n: usize, size: usize) -> Image<[u8; 4]> {
    grey(n, n, |x, y| if (x / size + y / size).is_multiple_of(2) { 0 } else { 255 })
}

/// White noise in all four channels.
pub(crate) fn noise(width: usize, height: usize, seed: u64) -> Image<[u8; 4]> {
    let mut random = Random::new(seed);
    let texel = |_| random.next().to_le_bytes()[..4].try_into().unwrap();
    Image::from_vec(width, height, (0..width * height).map(texel).collect()).unwrap()
}

/// One colour everywhere.
pub(crate) fn constant(width: usize, height: usize, texel: [u8; 4]) -> Image<[u8; 4]> {
    Image::filled(width, height, texel).unwrap()
}

/// A ground plane seen along its diagonal up to the horizon: 1280×720 onto n×n texels.
pub(crate) fn ground(n: usize) -> Homography {
    let (f, h, horizon, behind) = (1100.0, 70.0, -14.0, 60.0);
    let scale = n as f64 / 2048.0 * core::f64::consts::FRAC_1_SQRT_2;
    let depth = [0.0, 0.0, h * f];
    let side = [h, 0.0, -h * 640.0];
    let w = [0.0, 1.0, -horizon];
    let row =
        |sign: f64| core::array::from_fn(|i| scale * (depth[i] + sign * side[i] - behind * w[i]));
    Homography::new([row(-1.0), row(1.0), w])
}
