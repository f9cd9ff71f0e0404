use image::codecs::png::{CompressionType, FilterType, PngEncoder};
use image::{ExtendedColorType, ImageEncoder, ImageError};
use scumble_pixel::Image;

/// A colour: red, green, blue in 0…1.
pub(crate) type Rgb = [f64; 3];

/// A picture under construction: opaque sRGB-encoded pixels of 8 bits.
pub(crate) struct Canvas {
    width: u32,
    height: u32,
    bytes: Vec<u8>,
}

/// `#rrggbb` as a number, to a colour.
pub(crate) fn hex(rgb: u32) -> Rgb {
    [16, 8, 0].map(|shift| f64::from((rgb >> shift) & 0xff) / 255.0)
}

/// `a` at t = 0, `b` at t = 1.
pub(crate) fn mix(a: Rgb, b: Rgb, t: f64) -> Rgb {
    std::array::from_fn(|i| a[i] + (b[i] - a[i]) * t)
}

/// A colour made lighter or darker by a factor.
pub(crate) fn shade(c: Rgb, factor: f64) -> Rgb {
    c.map(|v| (v * factor).clamp(0.0, 1.0))
}

impl Canvas {
    /// Evaluates `colour` at n×n points of every pixel and stores the mean. Coordinates are in
    /// pixels, (0, 0) is the top left corner.
    pub(crate) fn paint(width: u32, height: u32, n: u32, colour: impl Fn(f64, f64) -> Rgb) -> Self {
        let mut bytes = Vec::with_capacity(width as usize * height as usize * 3);
        let step = 1.0 / f64::from(n);
        for y in 0..height {
            for x in 0..width {
                let mut sum = [0.0; 3];
                for k in 0..n * n {
                    let px = f64::from(x) + (f64::from(k % n) + 0.5) * step;
                    let py = f64::from(y) + (f64::from(k / n) + 0.5) * step;
                    let c = colour(px, py);
                    sum = std::array::from_fn(|i| sum[i] + c[i]);
                }
                let mean = sum.map(|v| v / f64::from(n * n));
                bytes.extend(mean.map(|v| (v.clamp(0.0, 1.0) * 255.0 + 0.5).floor() as u8));
            }
        }
        Self { width, height, bytes }
    }

    /// The picture as an opaque image.
    pub(crate) fn into_image(self) -> Image<[u8; 4]> {
        let texels = self.bytes.as_chunks::<3>().0.iter().map(|&[r, g, b]| [r, g, b, 255]);
        let (width, height) = (self.width as usize, self.height as usize);
        Image::from_vec(width, height, texels.collect()).unwrap_or_default()
    }

    /// The picture as a PNG file: grey if every pixel is, RGB otherwise.
    ///
    /// # Errors
    /// Those of the encoder, which does not fail on a picture in memory.
    pub(crate) fn to_png(&self) -> Result<Vec<u8>, ImageError> {
        let mut out = Vec::new();
        let encoder =
            PngEncoder::new_with_quality(&mut out, CompressionType::Best, FilterType::Adaptive);
        let grey = self.bytes.chunks_exact(3).all(|p| p[0] == p[1] && p[1] == p[2]);
        if grey {
            let luma: Vec<u8> = self.bytes.iter().step_by(3).copied().collect();
            encoder.write_image(&luma, self.width, self.height, ExtendedColorType::L8)?;
        } else {
            encoder.write_image(&self.bytes, self.width, self.height, ExtendedColorType::Rgb8)?;
        }
        Ok(out)
    }
}
