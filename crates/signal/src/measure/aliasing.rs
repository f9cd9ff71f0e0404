//! Energy that should not be there.

use crate::{SignalError, Spectrum, Window};
use scumble_pixel::ImageView;

/// The mean square of what lies above `cutoff` cycles per pixel in a plane.
///
/// Of an image that was sampled from something known to have no such frequencies, that is error. With
/// a cutoff of 0 it is the variance.
#[must_use]
pub fn energy_above(plane: ImageView<'_, f64>, cutoff: f64) -> f64 {
    let pixels = (plane.width() * plane.height()).max(1) as f64;
    Spectrum::new(plane, Window::None).energy(|f| f.radius() > cutoff) / pixels
}

/// An image taken apart into what a filtered reference explains and the rest.
#[derive(Debug, Clone, PartialEq)]
pub struct Fit {
    /// Mean square of the image, its mean taken away.
    pub total: f64,
    /// Mean square of what no filter of the reference explains: false patterns, and noise.
    pub unexplained: f64,
    /// The filter's gain, from low frequencies to high, by rings of equal width up to √½ cycles per
    /// pixel: below 1 the image is blurred there, above 1 sharpened. 0 where the reference has nothing.
    pub gains: [f64; RINGS],
}

/// Rings of a [`Fit`]: enough to follow a filter, few enough that each has many frequencies of an
/// image of 64 pixels and more.
pub const RINGS: usize = 24;

/// Part of the reference's energy below which a ring's is taken for the transform's rounding.
const ROUNDING: f64 = 1e-24;

impl Fit {
    /// The part that is unexplained: 0 for a filtered reference, 1 for something else. 0 for a
    /// constant image.
    #[must_use]
    pub fn ratio(&self) -> f64 {
        if self.total > 0.0 { self.unexplained / self.total } else { 0.0 }
    }
}

/// How much of an image is not the reference, however blurred or sharpened.
///
/// In every ring of frequencies the gain is chosen that brings the reference nearest to the image; what
/// still differs cannot come from a filter that is the same in all directions and symmetric. So
/// aliasing, which puts energy where the reference has other, is told from blur, which takes energy
/// away: two things that a PSNR adds up. A shift counts as unexplained. The mean is left out.
///
/// # Errors
/// [`SignalError::Sizes`] unless both have the same size, and pixels.
pub fn unexplained(
    image: ImageView<'_, f64>,
    reference: ImageView<'_, f64>,
) -> Result<Fit, SignalError> {
    let size = (image.width(), image.height());
    if size != (reference.width(), reference.height()) || size.0 * size.1 == 0 {
        let (w, h) = (reference.width(), reference.height());
        return Err(SignalError::Sizes(size.0, size.1, w, h));
    }
    let (found, truth) =
        (Spectrum::new(image, Window::None), Spectrum::new(reference, Window::None));
    // Of each ring: the image's energy, the reference's, and what they share.
    let mut rings = [[0.0_f64; 3]; RINGS];
    for ((f, y), (_, x)) in found.bins().zip(truth.bins()) {
        if f.radius() == 0.0 {
            continue;
        }
        let ring = ((f.radius() * std::f64::consts::SQRT_2 * RINGS as f64) as usize).min(RINGS - 1);
        let sums = &mut rings[ring];
        sums[0] += y.norm_sqr();
        sums[1] += x.norm_sqr();
        sums[2] += x.re * y.re + x.im * y.im;
    }
    // A mean square is a bin's energy over the number of pixels, twice.
    let pixels = (size.0 * size.1) as f64;
    let unit = pixels * pixels;
    let least = ROUNDING * rings.iter().map(|[_, xx, _]| xx).sum::<f64>();
    let gains = rings.map(|[_, xx, xy]| if xx > least { xy / xx } else { 0.0 });
    let left = rings.iter().zip(&gains).map(|([yy, _, xy], gain)| (yy - gain * xy).max(0.0));
    Ok(Fit {
        total: rings.iter().map(|[yy, ..]| yy).sum::<f64>() / unit,
        unexplained: left.sum::<f64>() / unit,
        gains,
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Band, Border, Kernel, Shape, Tiling, band_filter, convolve_separable};
    use scumble_pixel::Image;
    use std::f64::consts::TAU;

    fn noise(n: usize, seed: usize) -> Image<f64> {
        let hash = |i: usize| (i.wrapping_mul(0x9e37_79b9_7f4a_7c15) >> 40) & 0xff;
        Image::from_fn(n, n, |x, y| hash(seed + x + 977 * y) as f64 / 255.0).unwrap()
    }

    fn wave(n: usize, k: f64, amplitude: f64) -> Image<f64> {
        let at = |x: usize, _| 0.5 + amplitude * (TAU * k * x as f64 / n as f64).sin();
        Image::from_fn(n, n, at).unwrap()
    }

    #[test]
    fn a_wave_has_half_the_square_of_its_amplitude() {
        let wave = wave(64, 20.0, 0.3);
        assert!((energy_above(wave.view(), 0.3) - 0.045).abs() < 1e-12);
        assert!(energy_above(wave.view(), 0.32) < 1e-12);
        assert!((energy_above(wave.view(), 0.0) - 0.045).abs() < 1e-12);
        assert_eq!(energy_above(Image::default().view(), 0.0), 0.0);
    }

    #[test]
    fn a_blurred_reference_is_explained() {
        let truth = noise(64, 3);
        let same = unexplained(truth.view(), truth.view()).unwrap();
        assert!(same.ratio() < 1e-12);
        assert!(same.gains.iter().all(|g| (g - 1.0).abs() < 1e-12));
        let low = band_filter(truth.view(), Band::LowPass(0.2), Shape::Gaussian, Tiling::Repeat);
        let blurred = unexplained(low.unwrap().view(), truth.view()).unwrap();
        // The gain varies a little within a ring.
        assert!(blurred.ratio() < 0.01, "{}", blurred.ratio());
        let half = blurred.gains[(0.2 * 2.0_f64.sqrt() * RINGS as f64) as usize];
        assert!((half - 0.5).abs() < 0.08, "{half}");
    }

    #[test]
    fn an_alias_is_not_explained() {
        // A wave of 40 cycles on 64 pixels is one of 24: the truth has nothing there.
        let truth = wave(64, 3.0, 0.3);
        let with_alias = Image::from_fn(64, 64, |x, _| {
            truth.row(0)[x] + 0.1 * (TAU * 40.0 * x as f64 / 64.0).sin()
        });
        let fit = unexplained(with_alias.unwrap().view(), truth.view()).unwrap();
        assert!((fit.unexplained - 0.005).abs() < 1e-12);
        assert!((fit.total - 0.05).abs() < 1e-12);
    }

    #[test]
    fn prefiltering_leaves_less_unexplained_than_blurring_after() {
        // Rings finer and finer, four times down: with and without a box before.
        let n = 512;
        let rings = Image::from_fn(n, n, |x, y| {
            let (x, y) = (x as f64 / n as f64, y as f64 / n as f64);
            0.5 + 0.5 * (TAU * 96.0 * (x * x + y * y)).cos()
        })
        .unwrap();
        let every =
            |image: &Image<f64>| Image::from_fn(n / 4, n / 4, |x, y| image.row(4 * y)[4 * x]);
        let filtered = |cutoff| {
            band_filter(rings.view(), Band::LowPass(cutoff), Shape::Ideal, Tiling::Mirror).unwrap()
        };
        let truth = every(&filtered(0.125)).unwrap();
        let kernel = Kernel::gaussian(2.0).unwrap();
        let before = convolve_separable(rings.view(), &kernel, &kernel, Border::Mirror);
        let small = Kernel::gaussian(0.5).unwrap();
        let point = every(&rings).unwrap();
        let after = convolve_separable(point.view(), &small, &small, Border::Mirror);
        let ratio = |image: &Image<f64>| unexplained(image.view(), truth.view()).unwrap().ratio();
        let [point, after, before] =
            [ratio(&point), ratio(&after), ratio(&every(&before).unwrap())];
        assert!(before < 0.1 * after && after < point, "{point} {after} {before}");
    }

    #[test]
    fn sizes_must_agree() {
        assert!(unexplained(noise(8, 0).view(), noise(9, 0).view()).is_err());
        assert!(unexplained(Image::default().view(), Image::default().view()).is_err());
        let flat = Image::filled(8, 8, 0.5).unwrap();
        assert!(unexplained(flat.view(), noise(8, 0).view()).unwrap().ratio() < 1e-9);
    }
}
