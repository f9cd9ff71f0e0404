#[cfg(doc)]
use crate::Probes;
use crate::math::sqrt;
use crate::{Footprint, Kernel, Magnify, Separable};

/// How texels of one level make a colour.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default)]
pub enum PixelFilter {
    /// The texel that the centre lies in.
    Nearest,
    /// The four nearest texels, weighted by nearness. With [`LevelMode::Linear`] it is trilinear.
    Bilinear,
    /// Interpolation by a sharper kernel: a filter of a place, like bilinear.
    Separable(Separable),
    /// Trilinear probes in a row along the ellipse's major axis ([`Probes`]): at most ⌈2a − 1⌉ for
    /// [`Sampler::max_eccentricity`] a, which counts up to 512 here. Far better than hardware's
    /// anisotropic filter; across the row it blurs and aliases as trilinear does, and in scalar code it
    /// is slower than the ellipse.
    Probes,
    /// The elliptical weighted average: [`Sampler::kernel`] projected into the texture.
    #[default]
    Ewa,
    /// Enhanced EWA as Rutanen published it (2009), slower and less good than the other:
    /// [`Sampler::CLASSIC`], for comparison.
    Classic,
}

/// Which levels of the pyramid are read.
///
/// Apart from [`LevelMode::Auto`] with the elliptical filter, the level comes from
/// D = log₂ max(‖∂P/∂x‖, ‖∂P/∂y‖), P in texels of level 0, clamped to the levels that there are.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default)]
pub enum LevelMode {
    /// The best that the filter can do: nearest takes the nearest level, bilinear blends two, and
    /// the elliptical filter takes the level that leaves its minor axis
    /// [`Sampler::least_sigma`] texels, blending only just before a switch.
    #[default]
    Auto,
    /// Level 0, whatever the footprint.
    Zero,
    /// Level round(D).
    Nearest,
    /// Levels ⌊D⌋ and ⌊D⌋ + 1, blended by the fraction of D.
    Linear,
}

/// How to sample a texture. The default is [`Sampler::DEFAULT`].
///
/// A radius or σ here is never a variance or a diameter: σ is the standard deviation along one axis
/// of the ellipse, and a kernel is cut at `radius`·σ.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Sampler {
    /// How texels of one level make a colour.
    pub pixel: PixelFilter,
    /// Which levels are read.
    pub level: LevelMode,
    /// The pixel's filter. Elliptical filter only.
    pub kernel: Kernel,
    /// What is made of the texture where a pixel sees less than about a texel. Elliptical filter
    /// and probes only.
    pub magnify: Magnify,
    /// The largest ratio of the ellipse's axes; beyond it the *minor* axis is widened, which blurs
    /// but never aliases. In 1…1024; what lies outside is clamped. Elliptical filter and probes only.
    ///
    /// (The literature's word: it is the axis ratio, not the eccentricity of a conic.)
    pub max_eccentricity: f32,
    /// Where the Gaussian is cut, in σ. In 2…4; what lies outside is clamped. Texels read grow as
    /// its square; below 3 the cut shows as a slight ringing in fine texture. What is left is widened by
    /// four tenths of the variance that the cut takes.
    pub radius: f32,
    /// The least σ of the minor axis, in texels of the level that is read ([`LevelMode::Auto`]);
    /// in 0.4…4. Texels read grow as its square; accuracy too.
    pub least_sigma: f32,
    /// Whether [`LevelMode::Auto`] blends two levels in the last part of an octave, so that a
    /// switch of level does not show as a line. Costs 8–10 % more texels.
    pub blend: bool,
}

impl Sampler {
    /// For previews and video: about half the texels of the default. Of pictures that are shrunk exactly four
    /// or eight times it reads the level where their ellipses have a σ of about one texel, and not that of half
    /// a texel.
    pub const FAST: Self = Self {
        pixel: PixelFilter::Ewa,
        level: LevelMode::Auto,
        kernel: Kernel::Gaussian,
        magnify: Magnify::Taps,
        max_eccentricity: 16.0,
        radius: 2.4,
        least_sigma: 0.52,
        blend: false,
    };
    /// For everything.
    pub const DEFAULT: Self =
        Self { max_eccentricity: 32.0, radius: 3.08, least_sigma: 0.6, blend: true, ..Self::FAST };
    /// For print and masters.
    pub const HIGH: Self = Self { max_eccentricity: 64.0, least_sigma: 0.8, ..Self::DEFAULT };
    /// Truth for tests: up to ten times the texels of the default, where the texture is far away. Over
    /// a texture in steps of 16 bits their rounding is what is left of the error; where that counts, ask
    /// for [`Storage::Float`](crate::Storage::Float).
    pub const REFERENCE: Self = Self {
        max_eccentricity: 1024.0,
        radius: 4.0,
        least_sigma: 1.5,
        blend: false,
        ..Self::HIGH
    };

    /// Rutanen's enhanced EWA (2009) as published, for comparison: a triangle for what is minified and
    /// Lanczos 2 for what is magnified, an axis ratio of 30, two levels everywhere.
    ///
    /// Heckbert's own (1989) is this with [`Kernel::Gaussian`], here cut at the pixel's radius of 1, and
    /// [`Magnify::None`].
    pub const CLASSIC: Self = Self {
        pixel: PixelFilter::Classic,
        kernel: Kernel::Triangle,
        magnify: Magnify::Radial(Kernel::Lanczos2),
        max_eccentricity: 30.0,
        radius: 2.0,
        least_sigma: 0.5,
        ..Self::DEFAULT
    };

    /// This sampler with another filter and level mode.
    #[must_use]
    pub const fn with(self, pixel: PixelFilter, level: LevelMode) -> Self {
        Self { pixel, level, ..self }
    }

    /// How far to either side of its centre, in columns and in rows of the image, a footprint is read
    /// at most, apart from the eight texels around that
    /// [`TextureOptions::window`](crate::TextureOptions::window) adds in each level. A bound, not the
    /// least one; ∞ for what is not finite.
    #[must_use]
    pub fn reach(&self, f: &Footprint) -> [f64; 2] {
        if !f.is_finite() || !f.is_bounded() {
            return [f64::INFINITY; 2];
        }
        let magnified = match self.magnify {
            Magnify::Radial(kernel) => kernel.radius(),
            _ => 0.0,
        };
        // The unit circle is the pixel's, whose σ is one half.
        let kernel = match (self.pixel, self.kernel) {
            (PixelFilter::Ewa, Kernel::Gaussian) => 0.5 * self.radius.clamp(2.0, 4.0),
            (_, kernel) => kernel.radius().max(2.0),
        };
        let radius = kernel.max(magnified);
        // The least axis that the texels and the largest axis ratio leave.
        let ratio = f64::from(self.max_eccentricity.clamp(1.0, 1024.0));
        let least = 2.0 + f.major_squared() / (ratio * ratio);
        let j = &f.jacobian;
        let side = |squares: f64| f64::from(radius) * sqrt(squares + least);
        [side(j.a * j.a + j.b * j.b), side(j.c * j.c + j.d * j.d)]
    }
}

impl Default for Sampler {
    fn default() -> Self {
        Self::DEFAULT
    }
}
