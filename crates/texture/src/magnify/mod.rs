pub(crate) mod patch;
mod taps;

use crate::abreast::{Sheet, average_all};
use crate::level::Level;
use crate::number::Number;
use crate::run::ABREAST;
use crate::{Kernel, Separable, Wrap};
use fearless_simd::{Simd, f32x16, i32x16, prelude::*};
use patch::{Patch, Spot, Spotted};
use taps::Places;

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
    /// The Gaussian pixel over bilinear reconstruction, integrated by sixteen taps: up to 30 dB
    /// nearer to that integral than [`Magnify::None`] below half a texel per pixel. Joined to the ellipse
    /// where √(½(s₁² + s₂²)) is between 0.6 and 0.775. [`Kernel::Gaussian`] of the elliptical filter only; others take it for
    /// [`Magnify::None`].
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
const MAGNIFIED: f32 = 0.75;

/// And from which on it is minified.
pub(crate) const MINIFIED: f32 = 1.5;

/// How magnified a footprint is, from the square of its major axis: 1 up to [`MAGNIFIED`], 0 from
/// [`MINIFIED`] on.
#[inline(always)]
pub(crate) fn nearness(major_squared: f32) -> f32 {
    fall(major_squared, MAGNIFIED, MINIFIED)
}

/// A smoothstep of √x from 1 at `from` down to 0 at `to`; 0 for what is not a number.
#[inline(always)]
fn fall<N: Number>(x: N, from: f32, to: f32) -> N {
    let t = (x.all(to) - x.sqrt()) * (1.0 / (to - from));
    let t = t.if_positive(t.within_unit(), x.all(0.0));
    t * t * (x.all(3.0) - t * 2.0)
}

impl Magnify {
    /// The ways with a name, [`Magnify::Radial`] apart.
    pub const ALL: [Self; 6] =
        [Self::None, Self::Taps, Self::Bilinear, Self::CatmullRom, Self::Mitchell, Self::Lanczos2];

    /// Whether it is a result of its own, to be blended with the other.
    pub(crate) const fn is_apart(self) -> bool {
        !matches!(self, Self::None | Self::Radial(_))
    }

    /// The most texels that it reads.
    pub(crate) const fn texels(self) -> usize {
        match self {
            Self::None | Self::Radial(_) => 0,
            Self::Taps => taps::COLUMNS * taps::ROWS,
            Self::Bilinear => 4,
            Self::CatmullRom | Self::Mitchell | Self::Lanczos2 => 16,
        }
    }

    /// How much of the result is this, from the [products](crate::covariance::products) of the
    /// footprint's Jacobian.
    #[inline(always)]
    pub(crate) fn nearness<N: Number>(self, [p, q, r]: [N; 3]) -> N {
        match self {
            Self::None | Self::Radial(_) => p.all(0.0),
            Self::Taps => fall((p + r) * 0.5, taps::FROM, taps::TO),
            _ => {
                let (x, y) = (p - r, q * 2.0);
                fall((p + r + (x * x + y * y).sqrt()) * 0.5, MAGNIFIED, MINIFIED)
            }
        }
    }

    /// The magnified texture at a spot of a level.
    #[inline(always)]
    pub(crate) fn sample(self, level: &Level, wrap: Wrap, at: &Spotted) -> [f32; 4] {
        match self.kernel() {
            Some(kernel) => kernel.sample(level, wrap, at),
            None if self == Self::Taps => {
                Places::new(&at.spot).patch::<{ taps::ROWS }>().average(level, wrap, at.base)
            }
            None => bilinear(&at.spot).average(level, wrap, at.base),
        }
    }

    /// The same at sixteen spots, from the texels that they count from: of those whose bits are set, and
    /// whose texels can be read in place. Returns their bits.
    #[inline(always)]
    #[expect(clippy::too_many_arguments, reason = "what a batch of pixels has in hand")]
    pub(crate) fn average_all<S: Simd>(
        self,
        simd: S,
        level: &Level,
        spot: &Spot<f32x16<S>>,
        base: [i32x16<S>; 2],
        wanted: u64,
        sheet: &mut Sheet,
        out: &mut [[f32; 4]; ABREAST],
    ) -> u64 {
        match self.kernel() {
            Some(kernel) => {
                let patch = kernel.patch::<_, 4>(spot);
                average_all(simd, level, &patch, base, wanted, sheet, out)
            }
            None if self == Self::Taps => {
                let places = Places::new(spot);
                let few = places.last().simd_lt(taps::FEW).to_bitmask();
                if wanted & !few == 0 {
                    let patch = places.patch::<{ taps::FEW_ROWS }>();
                    return average_all(simd, level, &patch, base, wanted, sheet, out);
                }
                let patch = places.patch::<{ taps::ROWS }>();
                average_all(simd, level, &patch, base, wanted, sheet, out)
            }
            None => average_all(simd, level, &bilinear(spot), base, wanted, sheet, out),
        }
    }

    /// The kernel of those that have one along each axis.
    const fn kernel(self) -> Option<Separable> {
        match self {
            Self::None | Self::Radial(_) | Self::Bilinear | Self::Taps => None,
            Self::CatmullRom => Some(Separable::CatmullRom),
            Self::Mitchell => Some(Separable::Mitchell),
            Self::Lanczos2 => Some(Separable::Lanczos2),
        }
    }
}

/// The four texels about a spot.
#[inline(always)]
fn bilinear<N: Number>(spot: &Spot<N>) -> Patch<N, 2, 2> {
    let of = |t: N| [t.all(1.0) - t, t];
    Patch::product([spot.x.all(0.0); 2], of(spot.x), of(spot.y))
}
