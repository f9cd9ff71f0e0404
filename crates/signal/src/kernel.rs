use crate::{Complex, SignalError, math};

/// The weights of a filter along one axis: an odd number of them, the middle one for the pixel itself.
#[derive(Debug, Clone, PartialEq)]
pub struct Kernel {
    weights: Vec<f64>,
}

/// The weights of a small filter in two dimensions: odd numbers of columns and rows.
#[derive(Debug, Clone, PartialEq)]
pub struct Kernel2 {
    width: usize,
    height: usize,
    weights: Vec<f64>,
}

/// How many standard deviations of a Gaussian are kept: what is left out weighs 6·10⁻⁷.
const GAUSSIAN_RADIUS: f64 = 5.0;

impl Kernel {
    /// The largest radius of the kernels made here, in pixels; a wider filter is better taken by
    /// [`band_filter`](crate::band_filter).
    pub const MAX_RADIUS: f64 = 16_384.0;

    /// Weights as they are given; the middle one is for the pixel itself.
    ///
    /// As in any convolution, the weight to the *right* of the middle is for the pixel to the *left*.
    ///
    /// # Errors
    /// [`SignalError::Weights`] for an even number of them.
    pub fn new(weights: Vec<f64>) -> Result<Self, SignalError> {
        let found = weights.len();
        if found % 2 == 1 {
            Ok(Self { weights })
        } else {
            Err(SignalError::Weights { width: found, height: 1, found })
        }
    }

    /// The mean over `width` pixels, any number above 0: a pixel that is partly within the width counts
    /// by that part, so that even widths keep the middle, too.
    ///
    /// # Errors
    /// [`SignalError::Size`].
    pub fn rectangle(width: f64) -> Result<Self, SignalError> {
        let half = checked(width / 2.0)?;
        let overlap = |x: f64| ((x + 0.5).min(half) - (x - 0.5).max(-half)).max(0.0);
        Self::sampled((half - 0.5).max(0.0), overlap)
    }

    /// A triangle that falls to 0 at `radius` pixels: linear interpolation, for a radius of 1 and an image
    /// magnified.
    ///
    /// # Errors
    /// [`SignalError::Size`].
    pub fn triangle(radius: f64) -> Result<Self, SignalError> {
        let radius = checked(radius)?;
        Self::sampled(radius, |x| (1.0 - x.abs() / radius).max(0.0))
    }

    /// A Gaussian of standard deviation `sigma` pixels, at the pixels' centres, out to 5σ.
    ///
    /// From σ = 0.8 on, its response is exp(−2π²σ²f²) to 10⁻⁴.
    ///
    /// # Errors
    /// [`SignalError::Size`].
    pub fn gaussian(sigma: f64) -> Result<Self, SignalError> {
        let radius = checked(GAUSSIAN_RADIUS * sigma)?;
        Self::sampled(radius, |x| math::exp(-0.5 * (x / sigma) * (x / sigma)))
    }

    /// Mitchell and Netravali's cubic (1988), B = C = ⅓, stretched to `scale` pixels for its unit: it is
    /// 2·`scale` to either side. At 1 it is the reconstruction filter at the pixels, [1, 16, 1]/18.
    ///
    /// # Errors
    /// [`SignalError::Size`].
    pub fn mitchell(scale: f64) -> Result<Self, SignalError> {
        let radius = checked(2.0 * scale)?;
        Self::sampled(radius, |x| mitchell(x.abs() / scale))
    }

    /// The weights, from the one for the pixel farthest to the right to the one farthest to the left.
    #[must_use]
    pub fn weights(&self) -> &[f64] {
        &self.weights
    }

    /// Pixels to either side of the middle.
    #[must_use]
    pub fn radius(&self) -> usize {
        self.weights.len() / 2
    }

    /// What the filter does to a wave of `frequency` cycles per pixel: the factor of its amplitude and
    /// phase.
    #[must_use]
    pub fn response(&self, frequency: f64) -> Complex<f64> {
        let middle = self.radius() as f64;
        let terms = self.weights.iter().enumerate();
        terms
            .map(|(i, w)| {
                let (sin, cos) = math::sin_cos_turns(frequency * (middle - i as f64));
                Complex::new(w * cos, w * sin)
            })
            .sum()
    }

    /// A function at the whole numbers up to `radius`, its sum made one.
    fn sampled(radius: f64, weight: impl Fn(f64) -> f64) -> Result<Self, SignalError> {
        let reach = radius.ceil() as i32;
        let weights: Vec<f64> = (-reach..=reach).map(|i| weight(f64::from(i))).collect();
        Ok(Self { weights: normalized(weights)? })
    }
}

impl Kernel2 {
    /// Weights as they are given, row by row; the middle one is for the pixel itself.
    ///
    /// # Errors
    /// [`SignalError::Weights`] unless width and height are odd and there are as many weights as both
    /// say.
    pub fn new(width: usize, height: usize, weights: Vec<f64>) -> Result<Self, SignalError> {
        let found = weights.len();
        if width % 2 == 1 && height % 2 == 1 && width.checked_mul(height) == Some(found) {
            Ok(Self { width, height, weights })
        } else {
            Err(SignalError::Weights { width, height, found })
        }
    }

    /// The same, with the weights' sum made one.
    ///
    /// # Errors
    /// Those of [`new`](Self::new), and [`SignalError::Sum`] for weights that cancel.
    pub fn normalized(width: usize, height: usize, weights: Vec<f64>) -> Result<Self, SignalError> {
        let Self { weights, .. } = Self::new(width, height, weights)?;
        Self::new(width, height, normalized(weights)?)
    }

    /// Columns.
    #[must_use]
    pub fn width(&self) -> usize {
        self.width
    }

    /// Rows.
    #[must_use]
    pub fn height(&self) -> usize {
        self.height
    }

    /// The weights, row by row.
    #[must_use]
    pub fn weights(&self) -> &[f64] {
        &self.weights
    }
}

fn checked(radius: f64) -> Result<f64, SignalError> {
    if radius > 0.0 && radius <= Kernel::MAX_RADIUS {
        Ok(radius)
    } else {
        Err(SignalError::Size(radius))
    }
}

fn normalized(mut weights: Vec<f64>) -> Result<Vec<f64>, SignalError> {
    let sum: f64 = weights.iter().sum();
    if sum == 0.0 || !sum.is_finite() {
        return Err(SignalError::Sum(sum));
    }
    for weight in &mut weights {
        *weight /= sum;
    }
    Ok(weights)
}

/// The cubic of B = C = ⅓ at a distance.
fn mitchell(x: f64) -> f64 {
    if x < 1.0 {
        ((7.0 * x - 12.0) * x * x + 16.0 / 3.0) / 6.0
    } else if x < 2.0 {
        (((-7.0 / 3.0 * x + 12.0) * x - 20.0) * x + 32.0 / 3.0) / 6.0
    } else {
        0.0
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::PI;

    fn weights(kernel: Result<Kernel, SignalError>) -> Vec<f64> {
        kernel.unwrap().weights().to_vec()
    }

    #[test]
    fn small_kernels_are_what_the_books_say() {
        let close = |a: Vec<f64>, b: &[f64]| {
            assert_eq!(a.len(), b.len(), "{a:?}");
            assert!(a.iter().zip(b).all(|(a, b)| (a - b).abs() < 1e-15), "{a:?} {b:?}");
        };
        close(weights(Kernel::rectangle(1.0)), &[1.0]);
        close(weights(Kernel::rectangle(0.25)), &[1.0]);
        close(weights(Kernel::rectangle(3.0)), &[1.0 / 3.0; 3]);
        close(weights(Kernel::rectangle(2.0)), &[0.25, 0.5, 0.25]);
        close(weights(Kernel::triangle(2.0)), &[0.0, 0.25, 0.5, 0.25, 0.0]);
        let ends = [0.0, 1.0 / 18.0, 16.0 / 18.0, 1.0 / 18.0, 0.0];
        close(weights(Kernel::mitchell(1.0)), &ends);
    }

    #[test]
    fn every_kernel_sums_to_one_and_is_symmetric() {
        for size in [0.01, 0.3, 0.5, 1.0, 2.7, 8.0, 40.5] {
            let kernels = [
                Kernel::rectangle(size),
                Kernel::triangle(size),
                Kernel::gaussian(size),
                Kernel::mitchell(size),
            ];
            for kernel in kernels {
                let kernel = kernel.unwrap();
                assert!((kernel.response(0.0) - 1.0).norm() < 1e-13);
                assert!(kernel.response(0.31).im.abs() < 1e-13);
            }
        }
    }

    #[test]
    fn responses_follow_their_closed_forms() {
        let gaussian = Kernel::gaussian(1.5).unwrap();
        let nine = Kernel::rectangle(9.0).unwrap();
        let tent = Kernel::triangle(4.0).unwrap();
        for i in 1..50 {
            let f = f64::from(i) / 100.0;
            let expected = (-2.0 * PI * PI * 2.25 * f * f).exp();
            assert!((gaussian.response(f).re - expected).abs() < 1e-4);
            // Dirichlet's kernel, and its square for two boxes that make a tent.
            let dirichlet = |n: f64| (n * PI * f).sin() / (n * (PI * f).sin());
            assert!((nine.response(f).re - dirichlet(9.0)).abs() < 1e-12);
            assert!((tent.response(f).re - dirichlet(4.0).powi(2)).abs() < 1e-12);
        }
    }

    #[test]
    fn what_is_no_kernel_is_refused() {
        for size in [0.0, -1.0, f64::NAN, f64::INFINITY, 1e9] {
            assert!(Kernel::rectangle(size).is_err());
            assert!(Kernel::triangle(size).is_err());
            assert!(Kernel::gaussian(size).is_err());
            assert!(Kernel::mitchell(size).is_err());
        }
        assert!(Kernel::new(vec![]).is_err() && Kernel::new(vec![1.0; 2]).is_err());
        assert!(Kernel2::new(3, 3, vec![1.0; 8]).is_err());
        assert!(Kernel2::new(usize::MAX, 3, vec![1.0; 9]).is_err());
        assert!(Kernel2::normalized(3, 1, vec![-1.0, 0.0, 1.0]).is_err());
        assert_eq!(Kernel2::normalized(3, 1, vec![1.0; 3]).unwrap().weights(), [1.0 / 3.0; 3]);
    }
}
