use crate::math::sqrt32;
use crate::number::Number;

/// A filter's weight as a function of the distance from its centre alone, up to a scale.
///
/// Distances are in pixels where the texture is minified and in texels where it is magnified:
/// whichever is larger on the spot. The elliptical filter stretches that circle into the ellipse
/// that the pixel covers.
///
/// [`Kernel::Gaussian`] and [`Kernel::Smooth`] have a variance, to which that of bilinear
/// reconstruction is added (1/6 squared texels), as Heckbert's resampling filter does it. The others
/// are made for a grid whose step is the larger of pixel and texel, so for them each axis of the
/// ellipse is widened to at least a texel, and nothing is added.
///
/// | kernel | radius | for |
/// |---|---|---|
/// | [`Gaussian`](Kernel::Gaussian) | [`Sampler::radius`](crate::Sampler::radius)/2 | everything; by far the quickest |
/// | [`Smooth`](Kernel::Smooth) | 1.37 | the least aliasing at the same sharpness |
/// | [`Triangle`](Kernel::Triangle) | 1 | cheap and a little sharper |
/// | [`Mitchell`](Kernel::Mitchell) | 2 | sharper, with faint halos |
/// | [`Lanczos2`](Kernel::Lanczos2), [`Lanczos3`](Kernel::Lanczos3) | 2, 3 | the sharpest, with halos |
/// | [`Box`](Kernel::Box) | – | the mean over the pixel's square, to compare with area averaging |
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub enum Kernel {
    /// e^(−2r²): σ = ½.
    #[default]
    Gaussian,
    /// A quartic in y = 1 − r²/1.37², y(0.2178 − 0.1088y + 0.5573y² + 0.3338y³), σ = 0.472: as sharp
    /// as the Gaussian at the limit of sampling, with a seventh of its energy beyond.
    Smooth,
    /// 1 − r.
    Triangle,
    /// The cubic of Mitchell and Netravali (1988) with B = C = ⅓.
    Mitchell,
    /// sinc r under the main lobe of sinc(r/2) (Duchon 1979).
    Lanczos2,
    /// sinc r under the main lobe of sinc(r/3).
    Lanczos3,
    /// The mean of the bilinear surface over the pixel's square, a parallelogram in the texture: each texel by
    /// how much of its tent lies inside, to what 8 bits show. A level is read that is one finer than the
    /// Gaussian's, so it takes up to twice as long; and it aliases as squares do. Where a radial weight is
    /// asked for ([`Magnify::Radial`](crate::Magnify::Radial), the classic filter), 1 within
    /// r = √½, the least circle that always holds the centre of a texel.
    Box,
    /// One's own.
    Own(&'static RadialFilter),
}

/// Cells of a table.
const CELLS: usize = 1024;

/// A kernel of one's own, as a table over the squared distance: no root is taken to read it.
///
/// ```
/// use scumble_texture::{Kernel, RadialFilter, Sampler};
/// use std::sync::LazyLock;
///
/// // Welch's parabola.
/// static WELCH: LazyLock<RadialFilter> = LazyLock::new(|| RadialFilter::new(1.2, |r2| 1.0 - r2 / 1.44));
/// let sampler = Sampler { kernel: Kernel::Own(&WELCH), ..Sampler::DEFAULT };
/// assert_eq!(sampler.kernel.weight(0.0), 1.0);
/// assert_eq!(sampler.kernel.weight(1.5), 0.0);
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct RadialFilter {
    radius: f32,
    /// Cells of the table per unit of r².
    density: f32,
    /// The integral over the plane.
    integral: f32,
    /// The weight at every [`CELLS`]th of the squared radius, and 0 beyond it.
    table: [f32; CELLS + 2],
}

impl RadialFilter {
    /// A filter from its radius and its weight as a function of r².
    ///
    /// The radius is brought within √½ (or an ellipse might hold no texel) and 8. Weights may be
    /// negative; one that is not finite counts as 0. Between 1025 places even in r² the weight is
    /// interpolated, so that a kernel with a cusp in the middle has it rounded by a few thousandths.
    #[must_use]
    pub fn new(radius: f32, weight: impl Fn(f32) -> f32) -> Self {
        // In this order a NaN becomes the lower bound.
        let radius = radius.max(core::f32::consts::FRAC_1_SQRT_2);
        let radius = radius.min(8.0);
        let squared = radius * radius;
        let mut table = [0.0; CELLS + 2];
        for (i, entry) in table[..=CELLS].iter_mut().enumerate() {
            let w = weight(squared * (i as f32 / CELLS as f32));
            *entry = if w.is_finite() { w } else { 0.0 };
        }
        Self::over(radius, table)
    }

    const fn over(radius: f32, table: [f32; CELLS + 2]) -> Self {
        // ∫ k(r)·2πr dr = π ∫ k d(r²), by the trapezoidal rule.
        let mut sum = 0.5 * (table[0] + table[CELLS]) as f64;
        let mut i = 1;
        while i < CELLS {
            sum += table[i] as f64;
            i += 1;
        }
        let squared = radius as f64 * radius as f64;
        let integral = core::f64::consts::PI * squared / CELLS as f64 * sum;
        let density = (CELLS as f64 / squared) as f32;
        Self { radius, density, integral: integral as f32, table }
    }

    /// Where the filter ends.
    #[must_use]
    pub const fn radius(&self) -> f32 {
        self.radius
    }

    /// The weight at a squared distance r² ≥ 0: nothing beyond the radius.
    #[must_use]
    #[inline(always)]
    pub fn weight(&self, r2: f32) -> f32 {
        let x = r2 * self.density;
        // A cast takes NaN for 0 and keeps to the range of the type.
        let cell = (x as usize).min(CELLS);
        let (a, b) = (self.table[cell], self.table[cell + 1]);
        if x <= CELLS as f32 { a + (b - a) * (x - cell as f32) } else { 0.0 }
    }
}

/// Weights that are found together.
pub(crate) const TOGETHER: usize = 8;

/// How a kernel meets the texels' own reconstruction.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Footing {
    /// Its variance in squared pixels, to which the reconstruction's is added.
    Variance(f64),
    /// Each axis of the ellipse is at least a texel.
    Grid,
}

impl Kernel {
    /// The kernels with a name.
    pub const ALL: [Self; 7] = [
        Self::Gaussian,
        Self::Smooth,
        Self::Triangle,
        Self::Mitchell,
        Self::Lanczos2,
        Self::Lanczos3,
        Self::Box,
    ];

    /// The weight at a squared distance r² ≥ 0: nothing beyond the radius (for the Gaussian, which
    /// a sampler cuts, beyond 2).
    #[must_use]
    #[inline(always)]
    pub fn weight(self, r2: f32) -> f32 {
        match self {
            Self::Gaussian => {
                if r2 <= 4.0 {
                    gaussian(2.0 * r2)
                } else {
                    0.0
                }
            }
            Self::Smooth => smooth(r2),
            Self::Triangle => (1.0 - sqrt32(r2)).max(0.0),
            Self::Mitchell => cubic(sqrt32(r2), THIRD, THIRD),
            Self::Lanczos2 => lanczos::TWO.weight(r2),
            Self::Lanczos3 => lanczos::THREE.weight(r2),
            Self::Box => f32::from(u8::from(r2 <= 0.5)),
            Self::Own(filter) => filter.weight(r2),
        }
    }

    /// Makes [weights](Kernel::weight) of squared distances: one question which kernel it is, and a loop
    /// of which the compiler can make vectors.
    #[inline(always)]
    pub(crate) fn weigh(self, r2: &mut [f32; TOGETHER]) {
        match self {
            Self::Gaussian => Self::Gaussian.weigh_each(r2),
            Self::Smooth => Self::Smooth.weigh_each(r2),
            Self::Triangle => Self::Triangle.weigh_each(r2),
            Self::Mitchell => Self::Mitchell.weigh_each(r2),
            Self::Lanczos2 => Self::Lanczos2.weigh_each(r2),
            Self::Lanczos3 => Self::Lanczos3.weigh_each(r2),
            Self::Box | Self::Own(_) => self.weigh_each(r2),
        }
    }

    #[inline(always)]
    fn weigh_each(self, r2: &mut [f32; TOGETHER]) {
        for r2 in r2 {
            *r2 = self.weight(*r2);
        }
    }

    /// Where the kernel ends; for the Gaussian, where it may end at most.
    #[must_use]
    pub const fn radius(self) -> f32 {
        match self {
            Self::Smooth => SMOOTH_RADIUS,
            Self::Triangle => 1.0,
            Self::Gaussian | Self::Mitchell | Self::Lanczos2 => 2.0,
            Self::Lanczos3 => 3.0,
            Self::Box => core::f32::consts::FRAC_1_SQRT_2,
            Self::Own(filter) => filter.radius,
        }
    }

    /// The integral over the plane.
    pub(crate) fn integral(self) -> f32 {
        use core::f32::consts::{FRAC_PI_2, FRAC_PI_3, PI};
        match self {
            Self::Gaussian | Self::Box => FRAC_PI_2,
            // The quartic's over y in 0…1, times π·1.37².
            Self::Smooth => 0.278_718_34 * PI * SMOOTH_RADIUS * SMOOTH_RADIUS,
            Self::Triangle => FRAC_PI_3,
            Self::Mitchell => 14.0 / 45.0 * PI,
            Self::Lanczos2 => lanczos::TWO.integral,
            Self::Lanczos3 => lanczos::THREE.integral,
            Self::Own(filter) => filter.integral,
        }
    }

    pub(crate) const fn footing(self) -> Footing {
        match self {
            Self::Gaussian => Footing::Variance(0.25),
            Self::Smooth => Footing::Variance(0.472 * 0.472),
            _ => Footing::Grid,
        }
    }
}

/// e^(−x) for x in [0, 8], relative error below 1e−5: the eighth power of e^(−x/8), which is a
/// polynomial through the six Chebyshev nodes of that range.
#[inline(always)]
pub(crate) fn gaussian(x: f32) -> f32 {
    const C: [f32; 6] = [
        0.999_999_6,
        -0.124_995_984,
        0.007_806_576_3,
        -0.000_322_290_46,
        9.360_088e-6,
        -1.556_313_4e-7,
    ];
    let x2 = x * x;
    let p = (C[0] + x * C[1]) + x2 * ((C[2] + x * C[3]) + x2 * (C[4] + x * C[5]));
    let p2 = p * p;
    let p4 = p2 * p2;
    p4 * p4
}

/// Where [`Kernel::Smooth`] ends.
const SMOOTH_RADIUS: f32 = 1.37;

/// [`Kernel::Smooth`].
#[inline(always)]
fn smooth(r2: f32) -> f32 {
    let y = (1.0 - r2 * (1.0 / (SMOOTH_RADIUS * SMOOTH_RADIUS))).max(0.0);
    y * (0.2178 + y * (-0.1088 + y * (0.5573 + 0.3338 * y)))
}

/// The cubics of Mitchell and Netravali ("Reconstruction filters in computer graphics", 1988,
/// equation 8) at a distance r ≥ 0: B = C = ⅓ is theirs, B = 0 and C = ½ is Catmull and Rom's.
#[inline(always)]
pub(crate) fn cubic(r: f32, b: f32, c: f32) -> f32 {
    let value = if r < 1.0 { cubic_within(r, b, c) } else { cubic_beyond(r, b, c) };
    if r < 2.0 { value } else { 0.0 }
}

/// [`cubic`] where r ≤ 1.
#[inline(always)]
pub(crate) fn cubic_within<N: Number>(r: N, b: f32, c: f32) -> N {
    let slope = r * (12.0 - 9.0 * b - 6.0 * c) + (-18.0 + 12.0 * b + 6.0 * c);
    (slope * (r * r) + (6.0 - 2.0 * b)) * (1.0 / 6.0)
}

/// [`cubic`] where 1 ≤ r ≤ 2.
#[inline(always)]
pub(crate) fn cubic_beyond<N: Number>(r: N, b: f32, c: f32) -> N {
    let slope = (r * (-b - 6.0 * c) + (6.0 * b + 30.0 * c)) * r + (-12.0 * b - 48.0 * c);
    (slope * r + (8.0 * b + 24.0 * c)) * (1.0 / 6.0)
}

/// ⅓, for [`cubic`].
pub(crate) const THIRD: f32 = 1.0 / 3.0;

/// Windowed sincs, tabulated at compile time.
pub(crate) mod lanczos {
    use super::{CELLS, RadialFilter};

    /// Radius 2.
    pub(crate) static TWO: RadialFilter = RadialFilter::over(2.0, table(2));
    /// Radius 3.
    pub(crate) static THREE: RadialFilter = RadialFilter::over(3.0, table(3));

    /// sinc(r)·sinc(r/n) over r².
    const fn table(n: u32) -> [f32; CELLS + 2] {
        let n2 = (n * n) as f64;
        let mut table = [0.0; CELLS + 2];
        let mut i = 0;
        // The last entry inside, at the radius, is a zero of both.
        while i < CELLS {
            let r2 = n2 * i as f64 / CELLS as f64;
            table[i] = (sinc_of_squared(r2) * sinc_of_squared(r2 / n2)) as f32;
            i += 1;
        }
        table
    }

    /// sin(πr)/(πr) from r² ≤ 9, by its series: the absolute error is below 1e−11.
    const fn sinc_of_squared(r2: f64) -> f64 {
        let x2 = core::f64::consts::PI * core::f64::consts::PI * r2;
        let mut sum = 1.0;
        let mut k = 26.0;
        while k > 0.5 {
            sum = 1.0 - sum * x2 / (2.0 * k * (2.0 * k + 1.0));
            k -= 1.0;
        }
        sum
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The integral over the plane by brute force.
    fn integral(k: Kernel) -> f64 {
        let steps = 40_000;
        let h = f64::from(k.radius()) / f64::from(steps);
        let ring = |i: i32| {
            let r = (f64::from(i) + 0.5) * h;
            core::f64::consts::TAU * r * f64::from(k.weight((r * r) as f32)) * h
        };
        (0..steps).map(ring).sum()
    }

    #[test]
    fn integrals_and_radii_are_those_of_the_weights() {
        static OWN: std::sync::LazyLock<RadialFilter> =
            std::sync::LazyLock::new(|| RadialFilter::new(1.5, |r2| 2.25 - r2));
        for k in Kernel::ALL.into_iter().chain([Kernel::Own(&OWN)]) {
            let found = integral(k);
            let stated = f64::from(k.integral());
            assert!((found / stated - 1.0).abs() < 1e-3, "{k:?}: {found} {stated}");
            let r = k.radius();
            assert_eq!(k.weight(r * r * 1.001), 0.0, "{k:?}");
            assert!(k.weight(0.0) > 0.0);
        }
    }

    #[test]
    fn the_gaussian_is_as_exact_as_stated() {
        for i in 0..=60_000u16 {
            let x = 8.0 * f32::from(i) / 60_000.0;
            let truth = (-f64::from(x)).exp();
            assert!((f64::from(gaussian(x)) / truth - 1.0).abs() < 1e-5, "{x}");
        }
    }

    #[test]
    fn weights_are_the_formulas() {
        let lanczos = |r: f64, n: f64| {
            let sinc = |x: f64| {
                if x == 0.0 {
                    1.0
                } else {
                    (core::f64::consts::PI * x).sin() / core::f64::consts::PI / x
                }
            };
            sinc(r) * sinc(r / n)
        };
        for i in 0..3000 {
            let r = f64::from(i) * 1e-3;
            let r2 = (r * r) as f32;
            let two = if r < 2.0 { lanczos(r, 2.0) } else { 0.0 };
            assert!((f64::from(Kernel::Lanczos2.weight(r2)) - two).abs() < 2e-5, "{r}");
            assert!((f64::from(Kernel::Lanczos3.weight(r2)) - lanczos(r, 3.0)).abs() < 4e-5, "{r}");
        }
        assert!((Kernel::Mitchell.weight(0.0) - 8.0 / 9.0).abs() < 1e-6);
        assert!((Kernel::Mitchell.weight(1.0) - 1.0 / 18.0).abs() < 1e-6);
        assert_eq!(Kernel::Triangle.weight(0.25), 0.5);
        assert!((Kernel::Smooth.weight(0.0) - 1.0001).abs() < 1e-4);
        // A partition of unity along a line, and interpolating where it says so.
        for i in 0..10 {
            let f = i as f32 * 0.1;
            for (b, c) in [(THIRD, THIRD), (0.0, 0.5)] {
                let sum: f32 = (-2..=2).map(|k| cubic((f + k as f32).abs(), b, c)).sum();
                assert!((sum - 1.0).abs() < 1e-6);
            }
        }
        assert_eq!((cubic(0.0, 0.0, 0.5), cubic(1.0, 0.0, 0.5)), (1.0, 0.0));
    }

    #[test]
    fn a_filter_of_ones_own_is_safe_whatever_it_says() {
        let wild = RadialFilter::new(f32::NAN, |r2| if r2 > 0.2 { f32::NAN } else { 1.0 });
        assert_eq!(wild.radius(), core::f32::consts::FRAC_1_SQRT_2);
        assert!(RadialFilter::new(1e9, |_| 1.0).radius() == 8.0);
        for r2 in [0.0, 0.3, 0.5, 1.0, 1e30, f32::INFINITY, f32::NAN] {
            assert!(wild.weight(r2).is_finite(), "{r2}");
        }
    }
}
