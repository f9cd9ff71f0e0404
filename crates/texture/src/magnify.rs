use crate::level::Level;
use crate::math::sqrt;
use crate::{Footprint, Kernel, Separable, Wrap, place, taps};

/// What is made of a texture where a pixel sees less than about a texel of it.
///
/// Elliptical filters and probes ask this. But for [`Magnify::Taps`], the change from one way to the other goes by the *major*
/// axis of the footprint, s₁ in texels per pixel: wholly magnified where s₁ ≤ 0.75, wholly minified
/// from 1.5 on, and a smoothstep of the two results between. Going by the minor axis would take a
/// long thin footprint for a magnified one, and alias along it.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub enum Magnify {
    /// Nothing of its own: the Gaussian pixel over a Gaussian reconstruction between texels. Soft
    /// and free of halos.
    #[default]
    None,
    /// The Gaussian pixel over bilinear reconstruction, integrated by sixteen taps: 10 to 30 dB
    /// nearer to that integral than [`Magnify::None`] below a texel per pixel. Joined to the ellipse
    /// between s₁ = 0.9 and 1.4.
    Taps,
    /// Straight lines between texels: their grid shows.
    Bilinear,
    /// [`Separable::CatmullRom`]: sharp.
    CatmullRom,
    /// [`Separable::Mitchell`]: between soft and sharp.
    Mitchell,
    /// [`Separable::Lanczos2`]: sharp.
    Lanczos2,
    /// As Rutanen's "Enhanced EWA filtering" (2009) has it: the *weights* of this kernel and of
    /// [`Sampler::kernel`](crate::Sampler::kernel), each with an integral of 1, are blended inside
    /// one ellipse, whose axes are at least a texel. Elliptical filter only; others take it for
    /// [`Magnify::None`].
    Radial(Kernel),
}

/// Texels per pixel along the major axis up to which a footprint is magnified.
const MAGNIFIED: f64 = 0.75;

/// And from which on it is minified.
pub(crate) const MINIFIED: f64 = 1.5;

/// How magnified a footprint is, from the square of its major axis: 1 up to [`MAGNIFIED`], 0 from
/// [`MINIFIED`] on.
#[inline(always)]
pub(crate) fn nearness(major_squared: f64) -> f32 {
    fall(major_squared, MAGNIFIED, MINIFIED)
}

/// A smoothstep of √x from 1 at `from` down to 0 at `to`; 0 for what is not a number.
#[inline(always)]
pub(crate) fn fall(x: f64, from: f64, to: f64) -> f32 {
    let t = (to - sqrt(x)) * (1.0 / (to - from));
    let t = if t > 0.0 { t.min(1.0) } else { 0.0 };
    (t * t * (3.0 - 2.0 * t)) as f32
}

impl Magnify {
    /// The ways with a name, [`Magnify::Radial`] apart.
    pub const ALL: [Self; 6] =
        [Self::None, Self::Taps, Self::Bilinear, Self::CatmullRom, Self::Mitchell, Self::Lanczos2];

    /// Whether it is a result of its own, to be blended with the other.
    pub(crate) const fn is_apart(self) -> bool {
        !matches!(self, Self::None | Self::Radial(_))
    }

    /// Texels that it reads.
    pub(crate) const fn texels(self) -> usize {
        match self {
            Self::None | Self::Radial(_) => 0,
            Self::Taps => taps::TEXELS,
            Self::Bilinear => 4,
            Self::CatmullRom | Self::Mitchell | Self::Lanczos2 => 16,
        }
    }

    /// How much of the result is this, from the square of the footprint's major axis.
    #[inline(always)]
    pub(crate) fn nearness(self, major_squared: f64) -> f32 {
        match self {
            Self::None | Self::Radial(_) => 0.0,
            Self::Taps => taps::nearness(major_squared),
            _ => nearness(major_squared),
        }
    }

    /// The magnified texture under a footprint in texels of `level`, its centre finite.
    #[inline(always)]
    pub(crate) fn sample(self, level: &Level, wrap: Wrap, f: &Footprint) -> [f32; 4] {
        let kernel = match self {
            Self::Taps => return taps::sample(level, wrap, f),
            Self::None | Self::Radial(_) | Self::Bilinear => {
                return place::bilinear(level, wrap, f.u, f.v);
            }
            Self::CatmullRom => Separable::CatmullRom,
            Self::Mitchell => Separable::Mitchell,
            Self::Lanczos2 => Separable::Lanczos2,
        };
        kernel.sample(level, wrap, f.u, f.v)
    }
}
