use crate::{Window, fft, math};
use rustfft::FftDirection;
use rustfft::num_complex::Complex;
use scumble_pixel::{Image, ImageView};

/// A frequency in two dimensions, in cycles per pixel.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Frequency {
    /// Across, −½…½.
    pub x: f64,
    /// Down, −½…½.
    pub y: f64,
}

impl Frequency {
    /// Distance from zero: how fine the pattern is, whichever way it runs.
    #[must_use]
    pub fn radius(self) -> f64 {
        (self.x * self.x + self.y * self.y).sqrt()
    }
}

/// The discrete Fourier transform of a plane: one complex number for each frequency.
#[derive(Debug, Clone, PartialEq)]
pub struct Spectrum {
    width: usize,
    height: usize,
    /// Row by row, frequency zero first, negative ones in the second half.
    bins: Vec<Complex<f64>>,
}

impl Spectrum {
    /// The transform of a plane, X(k, l) = Σ x(i, j)·e^(−2πi(ki/w + lj/h)), under a window.
    #[must_use]
    pub fn new(plane: ImageView<'_, f64>, window: Window) -> Self {
        let (width, height) = (plane.width(), plane.height());
        let (across, down) = (window.weights(width), window.weights(height));
        let mut bins = Vec::with_capacity(width * height);
        for (row, wy) in plane.rows().zip(&down) {
            bins.extend(row.iter().zip(&across).map(|(v, wx)| Complex::new(v * wx * wy, 0.0)));
        }
        fft::transform(&mut bins, width, height, FftDirection::Forward);
        Self { width, height, bins }
    }

    /// Columns, as many as the plane's.
    #[must_use]
    pub fn width(&self) -> usize {
        self.width
    }

    /// Rows, as many as the plane's.
    #[must_use]
    pub fn height(&self) -> usize {
        self.height
    }

    /// The bin of `k` whole cycles across and `l` down the plane, each taken modulo the plane's size;
    /// zero if there are no pixels.
    #[must_use]
    pub fn bin(&self, k: isize, l: isize) -> Complex<f64> {
        let index = |k: isize, n: usize| k.checked_rem_euclid(isize::try_from(n).unwrap_or(0));
        match (index(k, self.width), index(l, self.height)) {
            (Some(x), Some(y)) => self.bins[y as usize * self.width + x as usize],
            _ => Complex::new(0.0, 0.0),
        }
    }

    /// Every bin with its frequency, in a fixed order.
    pub fn bins(&self) -> impl Iterator<Item = (Frequency, Complex<f64>)> + '_ {
        self.bins.iter().enumerate().map(|(i, &bin)| (self.frequency(i), bin))
    }

    /// Multiplies every bin by a real gain.
    ///
    /// A gain that is the same for a frequency and its opposite keeps the plane real.
    pub fn scale(&mut self, mut gain: impl FnMut(Frequency) -> f64) {
        for i in 0..self.bins.len() {
            self.bins[i] = self.bins[i].scale(gain(self.frequency(i)));
        }
    }

    /// The plane whose transform this is: the real part of it.
    #[must_use]
    pub fn inverse(&self) -> Image<f64> {
        let mut bins = self.bins.clone();
        fft::transform(&mut bins, self.width, self.height, FftDirection::Inverse);
        let n = bins.len() as f64;
        let values = bins.iter().map(|bin| bin.re / n).collect();
        Image::from_vec(self.width, self.height, values).unwrap_or_default()
    }

    /// The sum of the squares of the plane's pixels that is due to the frequencies chosen: all of them
    /// give the whole sum (Parseval).
    #[must_use]
    pub fn energy(&self, mut chosen: impl FnMut(Frequency) -> bool) -> f64 {
        let power = self.bins().filter(|(f, _)| chosen(*f)).map(|(_, bin)| bin.norm_sqr());
        power.sum::<f64>() / (self.bins.len().max(1)) as f64
    }

    /// |X| divided by the number of pixels, frequency zero in the middle: at column ⌊w/2⌋ and row ⌊h/2⌋,
    /// frequencies growing to the right and downwards.
    ///
    /// A cosine of amplitude a and whole cycles is two points of a/2; a constant is one point of its
    /// value.
    #[must_use]
    pub fn amplitudes(&self) -> Image<f64> {
        let n = self.bins.len() as f64;
        let (half_x, half_y) = (self.width / 2, self.height / 2);
        let mut values = Vec::with_capacity(self.bins.len());
        for row in 0..self.height {
            let y = (row + self.height - half_y) % self.height;
            for column in 0..self.width {
                let x = (column + self.width - half_x) % self.width;
                values.push(self.bins[y * self.width + x].norm() / n);
            }
        }
        Image::from_vec(self.width, self.height, values).unwrap_or_default()
    }

    /// The spectrum to look at: [`amplitudes`](Self::amplitudes) on a logarithmic scale, 1 for
    /// `reference` and more, 0 for `range` decibels less and below.
    ///
    /// 20 dB are a factor of ten in amplitude. A range of 0 or less shows what is not below the
    /// reference.
    #[must_use]
    pub fn decibels(&self, reference: f64, range: f64) -> Image<f64> {
        self.amplitudes().map(|amplitude| {
            let level = 20.0 * math::log10(amplitude / reference);
            let height = if range > 0.0 { 1.0 + level / range } else { level + 1.0 };
            // 0 over 0 has no height.
            if height.is_nan() { 0.0 } else { height.clamp(0.0, 1.0) }
        })
    }

    /// The largest of the [`amplitudes`](Self::amplitudes): the mean's own, for most pictures.
    #[must_use]
    pub fn peak(&self) -> f64 {
        let n = self.bins.len().max(1) as f64;
        self.bins.iter().map(|bin| bin.norm()).fold(0.0, f64::max) / n
    }

    fn frequency(&self, index: usize) -> Frequency {
        let of = |i: usize, n: usize| {
            // Nyquist's own frequency, which an even size has, counts as negative.
            let k = if i < n.div_ceil(2) { i as f64 } else { i as f64 - n as f64 };
            k / n as f64
        };
        Frequency { x: of(index % self.width, self.width), y: of(index / self.width, self.height) }
    }
}

#[cfg(test)]
mod tests;
