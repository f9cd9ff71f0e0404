//! Images as signals: spectra, band filters, convolution, and measures of aliasing and sharpness.
//!
//! # Conventions
//!
//! - A *plane* is an `Image<f64>`: one channel, pixel (x, y) a sample at that place, in any unit.
//!   [`plane()`] takes one out of a picture, and [`map_channels`] does the same to each of the four.
//! - Frequencies are in cycles per pixel, −½ to ½ along each axis; [`Frequency::radius`] is the distance
//!   from zero, up to √½ in the corners. ½ is Nyquist's limit.
//! - Transforms are not normalised forwards: the bin at zero is the *sum* of the plane. Backwards they
//!   are divided by the number of pixels. Parseval's theorem then reads Σ|X|² = N·Σx².
//! - The Fourier transform takes an image for one period of a pattern without end. What that does at
//!   the borders is chosen with a [`Window`] (for looking) or a [`Tiling`] (for filtering).
//! - A cutoff is where the gain of a Gaussian filter is ½, which is −6 dB, and where an ideal one ends.
//! - Sizes are any: odd, even, prime. An image without pixels has a spectrum without bins.
//!
//! # Determinism
//!
//! On one machine the same input gives the same bits: the transform is always the scalar one, and sums
//! are in a fixed order. Its factors are sines and cosines of the platform's mathematical library (all else
//! is + − × ÷ √ of ours), so between platforms results may be some 10⁻¹⁵ of the largest value apart. In eight bits that is not to be
//! seen but by an unlikely accident; see *Determinism* in the project's page on numerics.
//!
//! # Example
//!
//! ```
//! use scumble_pixel::Image;
//! use scumble_signal::{Band, Frequency, Shape, Spectrum, Tiling, Window, band_filter};
//! use std::f64::consts::TAU;
//!
//! // Stripes: 4 cycles and 20 cycles across 64 pixels.
//! let wave = |x: usize, k: f64| (TAU * k * x as f64 / 64.0).cos();
//! let both = Image::from_fn(64, 64, |x, _| wave(x, 4.0) + wave(x, 20.0))?;
//!
//! // Each cosine of amplitude 1 is two bins of ½.
//! let spectrum = Spectrum::new(both.view(), Window::None);
//! assert!((spectrum.bin(4, 0).re / 4096.0 - 0.5).abs() < 1e-12);
//! assert!((spectrum.bin(-20, 0).re / 4096.0 - 0.5).abs() < 1e-12);
//!
//! // A cutoff between the two keeps the slower one.
//! let slow = band_filter(both.view(), Band::LowPass(0.2), Shape::Ideal, Tiling::Repeat)?;
//! assert!((slow.row(9)[5] - wave(5, 4.0)).abs() < 1e-12);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod band;
mod border;
mod convolve;
mod error;
mod fft;
mod kernel;
mod math;
pub mod measure;
mod plane;
mod spectrum;
mod window;

pub use band::{Band, Shape, band_filter};
pub use border::{Border, Tiling};
pub use convolve::{convolve, convolve_separable};
pub use error::SignalError;
pub use kernel::{Kernel, Kernel2};
pub use plane::{Channel, map_channels, plane};
pub use rustfft::num_complex::Complex;
pub use spectrum::{Frequency, Spectrum};
pub use window::Window;
