use super::edge::{self, OVERSAMPLING};
use crate::{SignalError, math};
use scumble_pixel::ImageView;
use std::f64::consts::TAU;

/// Highest frequency of an [`Mtf`], in cycles per pixel: twice Nyquist's limit.
const HIGHEST: f64 = 1.0;

/// Steps of an [`Mtf`] from 0 to [`HIGHEST`].
const STEPS: usize = 100;

/// Modulation transfer: what is left of the contrast of a pattern, by its frequency.
#[derive(Debug, Clone, PartialEq)]
pub struct Mtf {
    /// How far the edge moves from one row of pixels to the next (one column, if it lies rather across
    /// than upright): the tangent of its angle.
    pub slope: f64,
    /// Contrast at 0, 0.01, 0.02, … 1 cycles per pixel; the first is 1.
    pub contrast: Vec<f64>,
}

impl Mtf {
    /// Contrast at a frequency in cycles per pixel, between the steps along a line; `None` beyond them.
    #[must_use]
    pub fn at(&self, frequency: f64) -> Option<f64> {
        let place = frequency / HIGHEST * STEPS as f64;
        if !(0.0..=STEPS as f64).contains(&place) {
            return None;
        }
        let index = (place.floor() as usize).min(STEPS - 1);
        let (a, b) = (self.contrast.get(index)?, self.contrast.get(index + 1)?);
        Some(a + (b - a) * (place - index as f64))
    }

    /// The lowest frequency at which half of the contrast is left, the usual measure of sharpness;
    /// `None` if more is left up to the highest.
    #[must_use]
    pub fn half(&self) -> Option<f64> {
        let index = self.contrast.windows(2).position(|pair| pair[1] < 0.5)?;
        let (a, b) = (self.contrast[index], self.contrast[index + 1]);
        let part = ((a - 0.5) / (a - b)).clamp(0.0, 1.0);
        Some((index as f64 + part) * HIGHEST / STEPS as f64)
    }
}

/// The modulation transfer of whatever made an image, from one slanted edge between two even parts of
/// it (after ISO 12233).
///
/// The edge should cross the image from side to side, somewhere about its middle, at some 2° to 10°
/// against the rows or the columns. A line is fitted to it; the pixels' distances from the line give a
/// profile of four samples a pixel; its derivative, under a window that is flat in the middle half,
/// has the transfer as its spectrum, from which the response of the difference is divided out. Beside
/// the standard, the values are brought to the places of the samples instead of averaged about them,
/// which makes it good to 10⁻⁴ for blurs of half a pixel and more.
///
/// # Errors
/// [`SignalError::NoEdge`] for an image with no clear edge, with less than 4 pixels to either side of
/// it, or of less than 16×16; [`SignalError::Unslanted`] if the edge does not meet the pixels at enough
/// different places.
pub fn slanted_edge(plane: ImageView<'_, f64>) -> Result<Mtf, SignalError> {
    let (image, line) = edge::find(plane)?;
    let profile = edge::profile(&image, line)?;
    let spread: Vec<f64> = profile.windows(3).map(|w| (w[2] - w[0]) / 2.0).collect();
    let whole = transfer(&spread, 0.0);
    // A profile of NaN, or of two equal sides.
    if whole.is_nan() || whole <= f64::EPSILON {
        return Err(SignalError::NoEdge);
    }
    let step = HIGHEST / STEPS as f64;
    let contrast = (0..=STEPS).map(|i| {
        let f = i as f64 * step;
        transfer(&spread, f) / whole / difference(f)
    });
    Ok(Mtf { slope: line.slope, contrast: contrast.collect() })
}

/// The height of the line spread's spectrum at a frequency in cycles per pixel.
fn transfer(spread: &[f64], frequency: f64) -> f64 {
    let middle = (spread.len() as f64 - 1.0) / 2.0;
    let (mut re, mut im) = (0.0, 0.0);
    for (i, value) in spread.iter().enumerate() {
        let place = i as f64 - middle;
        let value = value * flat(place / (middle + 1.0));
        let (sin, cos) = math::sin_cos_turns(frequency * place / OVERSAMPLING as f64);
        re += value * cos;
        im += value * sin;
    }
    (re * re + im * im).sqrt()
}

/// A window: 1 in the middle half of −1…1, and down to 0 as a cosine does.
fn flat(t: f64) -> f64 {
    let t = t.abs();
    if t <= 0.5 { 1.0 } else { 0.5 + 0.5 * math::sin_cos_turns(t - 0.5).1 }
}

/// What a difference over two samples leaves of a derivative.
fn difference(frequency: f64) -> f64 {
    let turns = frequency / OVERSAMPLING as f64;
    if turns == 0.0 { 1.0 } else { math::sin_cos_turns(turns).0 / (TAU * turns) }
}

#[cfg(test)]
mod tests {
    use super::*;
    use scumble_pixel::Image;
    use std::f64::consts::PI;

    /// The normal distribution's own function, by Simpson's rule.
    fn phi(x: f64) -> f64 {
        let n = 200;
        let h = x / f64::from(n);
        let density = |t: f64| (-0.5 * t * t).exp() / TAU.sqrt();
        let sum: f64 = (0..n)
            .map(|i| {
                let t = f64::from(i) * h;
                density(t) + 4.0 * density(t + h / 2.0) + density(t + h)
            })
            .sum();
        0.5 + sum * h / 6.0
    }

    /// A step blurred by σ, at `degrees` against the columns, sampled at the pixels' centres.
    fn blurred(sigma: f64, degrees: f64, turned: bool) -> Image<f64> {
        let (sin, cos) = degrees.to_radians().sin_cos();
        Image::from_fn(64, 80, |x, y| {
            let (x, y) = if turned { (y, x) } else { (x, y) };
            let d = (x as f64 - 31.3) * cos - (y as f64 - 38.6) * sin;
            0.2 + 0.6 * phi((d / sigma).clamp(-9.0, 9.0))
        })
        .unwrap()
    }

    #[test]
    fn a_gaussian_blur_is_found_to_a_ten_thousandth() {
        for (sigma, degrees, turned) in
            [(0.5, 5.0, false), (0.7, -3.7, false), (1.2, 8.0, false), (0.8, 5.3, true)]
        {
            let mtf = slanted_edge(blurred(sigma, degrees, turned).view()).unwrap();
            let angle = mtf.slope.atan().to_degrees();
            assert!((angle - degrees).abs() < 0.01, "{angle}");
            for i in 0..=50 {
                let f = f64::from(i) / 100.0;
                let expected = (-2.0 * PI * PI * sigma * sigma * f * f).exp();
                let found = mtf.at(f).unwrap();
                assert!((found - expected).abs() < 1e-4, "σ {sigma} f {f}: {found} {expected}");
            }
            let half = (std::f64::consts::LN_2 / 2.0).sqrt() / (PI * sigma);
            assert!((mtf.half().unwrap() - half).abs() < 1e-3);
        }
    }

    #[test]
    fn a_box_pixel_is_a_sinc() {
        // The area of each pixel beyond a slanted line: a box one pixel wide, for a small slope.
        let slope = 0.0873;
        let image = Image::from_fn(64, 160, |x, y| {
            let n = 200;
            let covered = |k: i32| {
                let y = y as f64 - 80.0 + (f64::from(k) + 0.5) / f64::from(n) - 0.5;
                (x as f64 + 0.5 - 32.2 - slope * y).clamp(0.0, 1.0)
            };
            (0..n).map(covered).sum::<f64>() / f64::from(n)
        });
        let mtf = slanted_edge(image.unwrap().view()).unwrap();
        for i in 1..=50 {
            let f = f64::from(i) / 100.0;
            // Across the line the pixel is a box of cos θ convolved with one of sin θ.
            let cos = 1.0 / (1.0 + slope * slope).sqrt();
            let sinc = |t: f64| t.sin() / t;
            let expected = sinc(PI * f * cos) * sinc(PI * f * slope * cos);
            let found = mtf.at(f).unwrap();
            assert!((found - expected).abs() < 3e-3, "{f}: {found} {expected}");
        }
    }

    #[test]
    fn noise_disturbs_little() {
        let clean = blurred(0.8, 5.0, false);
        let hash = |i: usize| (i.wrapping_mul(0x9e37_79b9_7f4a_7c15) >> 40) & 0xff;
        let noisy = Image::from_fn(64, 80, |x, y| {
            clean.row(y)[x] + 0.02 * (hash(x + 977 * y) as f64 / 255.0 - 0.5)
        });
        let mtf = slanted_edge(noisy.unwrap().view()).unwrap();
        assert!((mtf.half().unwrap() - 0.2342).abs() < 0.01, "{:?}", mtf.half());
    }

    #[test]
    fn what_has_no_edge_is_refused() {
        let refused = |image: Image<f64>| slanted_edge(image.view()).unwrap_err();
        assert_eq!(refused(Image::filled(64, 64, 0.5).unwrap()), SignalError::NoEdge);
        assert_eq!(refused(Image::filled(64, 64, f64::NAN).unwrap()), SignalError::NoEdge);
        assert_eq!(refused(Image::default()), SignalError::NoEdge);
        assert_eq!(
            refused(Image::from_fn(40, 40, |x, _| (x % 2) as f64).unwrap()),
            SignalError::NoEdge
        );
        let upright = Image::from_fn(40, 40, |x, _| f64::from(u8::from(x > 19))).unwrap();
        assert_eq!(refused(upright), SignalError::Unslanted);
    }

    #[test]
    fn beyond_the_steps_there_is_nothing() {
        let mtf = Mtf { slope: 0.0, contrast: vec![1.0; STEPS + 1] };
        assert_eq!((mtf.at(1.0), mtf.at(-0.1), mtf.at(1.1)), (Some(1.0), None, None));
        assert_eq!((mtf.at(f64::NAN), mtf.half()), (None, None));
    }
}
