use crate::{Border, Frequency, SignalError, Spectrum, Tiling, Window, math};
use scumble_pixel::{Image, ImageView};

/// Which frequencies a filter keeps, by their [`radius`](Frequency::radius) in cycles per pixel.
///
/// `LowPass(a)`, `BandPass(a, b)` and `HighPass(b)` share out the frequencies: in either shape the three
/// results add up to the image.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Band {
    /// Up to this.
    LowPass(f64),
    /// Above the first, up to the second.
    BandPass(f64, f64),
    /// Above this.
    HighPass(f64),
}

/// How a band ends.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default)]
pub enum Shape {
    /// At once: 1 within, 0 outside. It rings at edges.
    #[default]
    Ideal,
    /// As Gaussians do: a low-pass of cutoff c is 2^−(f/c)², ½ at c. No ringing. The blur has
    /// σ = √(½ ln 2)/(πc) ≈ 0.187/c pixels.
    Gaussian,
}

impl Shape {
    /// The gain of a low-pass; a cutoff of 0 keeps zero alone.
    fn low_pass(self, cutoff: f64, radius: f64) -> f64 {
        match self {
            Self::Ideal => f64::from(u8::from(radius <= cutoff)),
            Self::Gaussian if radius == 0.0 => 1.0,
            Self::Gaussian => math::exp2(-(radius / cutoff) * (radius / cutoff)),
        }
    }
}

impl Band {
    /// What the filter of this band multiplies a frequency by.
    #[must_use]
    pub fn gain(self, shape: Shape, frequency: Frequency) -> f64 {
        let low_pass = |cutoff: f64| shape.low_pass(cutoff, frequency.radius());
        match self {
            Self::LowPass(cutoff) => low_pass(cutoff),
            Self::BandPass(low, high) => low_pass(high) - low_pass(low),
            Self::HighPass(cutoff) => 1.0 - low_pass(cutoff),
        }
    }

    fn check(self) -> Result<(), SignalError> {
        let (low, high) = match self {
            Self::LowPass(high) => (0.0, high),
            Self::BandPass(low, high) => (low, high),
            Self::HighPass(low) => (low, f64::INFINITY),
        };
        // NaN is in no order.
        if low >= 0.0 && high >= low { Ok(()) } else { Err(SignalError::Band { low, high }) }
    }
}

/// The plane with the frequencies of a band alone.
///
/// What is not a low-pass has no mean: its values lie about 0.
///
/// # Errors
/// [`SignalError::Band`] for cutoffs that are negative, out of order, or no numbers.
pub fn band_filter(
    plane: ImageView<'_, f64>,
    band: Band,
    shape: Shape,
    tiling: Tiling,
) -> Result<Image<f64>, SignalError> {
    band.check()?;
    let filtered = |plane: ImageView<'_, f64>| {
        let mut spectrum = Spectrum::new(plane, Window::None);
        spectrum.scale(|f| band.gain(shape, f));
        spectrum.inverse()
    };
    Ok(match tiling {
        Tiling::Repeat => filtered(plane),
        Tiling::Mirror => {
            let whole = filtered(doubled(plane).view());
            whole.view().crop(0, 0, plane.width(), plane.height()).to_image()
        }
    })
}

/// The plane and its mirror images to the right and below: as a period, it has no jump.
fn doubled(plane: ImageView<'_, f64>) -> Image<f64> {
    let (width, height) = (plane.width(), plane.height());
    let mirrored = |i: usize, n: usize| Border::Mirror.resolve(i as i64, n);
    let at = |x: usize, y: usize| plane.row(mirrored(y, height))[mirrored(x, width)];
    Image::from_fn(2 * width, 2 * height, at).unwrap_or_default()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Kernel, convolve_separable};
    use proptest::prelude::*;
    use std::f64::consts::{LN_2, PI, TAU};

    fn noise(w: usize, h: usize) -> Image<f64> {
        let hash = |i: usize| (i.wrapping_mul(0x9e37_79b9_7f4a_7c15) >> 40) & 0xff;
        Image::from_fn(w, h, |x, y| hash(1 + x + 977 * y) as f64 / 255.0).unwrap()
    }

    fn close(a: &Image<f64>, b: &Image<f64>, most: f64) {
        assert_eq!((a.width(), a.height()), (b.width(), b.height()));
        for (a, b) in a.pixels().iter().zip(b.pixels()) {
            assert!((a - b).abs() <= most, "{a} {b}");
        }
    }

    proptest! {
        #[test]
        fn bands_share_out_an_image(
            (w, h) in (1..20_usize, 1..20_usize),
            (a, b) in (0.0..0.8_f64, 0.0..0.8_f64),
            gaussian: bool,
            repeat: bool,
        ) {
            let shape = if gaussian { Shape::Gaussian } else { Shape::Ideal };
            let tiling = if repeat { Tiling::Repeat } else { Tiling::Mirror };
            let (a, b) = (a.min(b), a.max(b));
            let image = noise(w, h);
            let bands = [Band::LowPass(a), Band::BandPass(a, b), Band::HighPass(b)]
                .map(|band| band_filter(image.view(), band, shape, tiling).unwrap());
            for (i, v) in image.pixels().iter().enumerate() {
                let sum: f64 = bands.iter().map(|band| band.pixels()[i]).sum();
                prop_assert!((sum - v).abs() < 1e-12);
            }
        }
    }

    #[test]
    fn sinusoids_pass_or_do_not() {
        let wave = |k: f64| {
            Image::from_fn(60, 45, move |x, y| {
                (TAU * k * (x as f64 / 60.0 + y as f64 / 45.0)).sin()
            })
            .unwrap()
        };
        let f = |k: f64| k * ((1.0 / 3600.0) + (1.0 / 2025.0_f64)).sqrt();
        let filtered =
            |k: f64, band, shape| band_filter(wave(k).view(), band, shape, Tiling::Repeat).unwrap();
        let nothing = Image::filled(60, 45, 0.0).unwrap();
        close(&filtered(3.0, Band::LowPass(f(4.0)), Shape::Ideal), &wave(3.0), 1e-13);
        close(&filtered(5.0, Band::LowPass(f(4.0)), Shape::Ideal), &nothing, 1e-13);
        close(&filtered(5.0, Band::HighPass(f(4.0)), Shape::Ideal), &wave(5.0), 1e-13);
        close(&filtered(5.0, Band::BandPass(f(4.0), f(6.0)), Shape::Ideal), &wave(5.0), 1e-13);
        // At its cutoff a Gaussian filter's gain is ½.
        let half = wave(5.0).map(|v| v / 2.0);
        close(&filtered(5.0, Band::LowPass(f(5.0)), Shape::Gaussian), &half, 1e-13);
    }

    #[test]
    fn a_gaussian_filter_is_a_gaussian_blur() {
        let image = noise(40, 31);
        let cutoff = 0.125;
        let sigma = (LN_2 / 2.0).sqrt() / (PI * cutoff);
        let kernel = Kernel::gaussian(sigma).unwrap();
        for (tiling, border) in [(Tiling::Repeat, Border::Repeat), (Tiling::Mirror, Border::Mirror)]
        {
            let by_spectrum =
                band_filter(image.view(), Band::LowPass(cutoff), Shape::Gaussian, tiling).unwrap();
            let by_kernel = convolve_separable(image.view(), &kernel, &kernel, border);
            close(&by_spectrum, &by_kernel, 1e-4);
        }
    }

    #[test]
    fn what_is_no_band_is_refused() {
        let image = noise(4, 4);
        let wrong = [
            Band::LowPass(-0.1),
            Band::LowPass(f64::NAN),
            Band::HighPass(f64::NAN),
            Band::BandPass(0.3, 0.2),
        ];
        for band in wrong {
            assert!(band_filter(image.view(), band, Shape::Ideal, Tiling::Repeat).is_err());
        }
        let constant = Image::filled(5, 4, 0.7).unwrap();
        for shape in [Shape::Ideal, Shape::Gaussian] {
            let filtered =
                band_filter(constant.view(), Band::LowPass(0.0), shape, Tiling::Mirror).unwrap();
            close(&filtered, &constant, 1e-14);
        }
        let none = Image::<f64>::default();
        assert!(band_filter(none.view(), Band::LowPass(0.1), Shape::Ideal, Tiling::Mirror).is_ok());
    }
}
