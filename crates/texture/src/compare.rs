//! What others do, for comparison: not for use.
//!
//! [`PixelFilter::Classic`] is another of them.

#[cfg(doc)]
use crate::Probes;
use crate::math::{ceil, sqrt};
use crate::{Footprint, LevelMode, PixelFilter, Sampler, Texture};
use scumble_geometry::Matrix2;
use scumble_pixel::Premul;

/// Trilinear: four texels of each of two levels, the level by the longer column of the Jacobian.
#[must_use]
pub fn trilinear(t: &Texture, f: &Footprint) -> Premul {
    t.sample(f, &TRILINEAR)
}

/// Anisotropic filtering as graphics hardware has it, by the formulas that the Vulkan specification
/// (§ "Texel anisotropic filtering") recommends: N = ⌈min(ρmax/ρmin, `most`)⌉ trilinear samples,
/// evenly spaced over the pixel along the longer *column* of the Jacobian, with equal weights, at the
/// level log₂(ρmax/N). `most` is usually 16.
///
/// The columns are not the ellipse's axes unless they are orthogonal, and equal weights over one pixel
/// are a box: both show beside [`Probes`].
#[must_use]
pub fn vulkan_anisotropic(t: &Texture, f: &Footprint, most: u32) -> Premul {
    let Matrix2 { a, b, c, d } = f.jacobian;
    let (x, y) = (sqrt(a * a + c * c), sqrt(b * b + d * d));
    let (longer, direction) = if x > y { (x, [a, c]) } else { (y, [b, d]) };
    if !longer.is_finite() || longer == 0.0 {
        return trilinear(t, f);
    }
    let ratio = (longer / x.min(y)).min(f64::from(most.clamp(1, 64)));
    let samples = ceil(ratio) as u32;
    let spot = longer / ratio;
    let jacobian = Matrix2::new(spot, 0.0, 0.0, spot);
    let mut sum = [0.0; 4];
    for i in 1..=samples {
        let k = f64::from(i) / f64::from(samples + 1) - 0.5;
        let at = Footprint { u: f.u + k * direction[0], v: f.v + k * direction[1], jacobian };
        let color = t.sample(&at, &TRILINEAR).0;
        for (sum, v) in sum.iter_mut().zip(color) {
            *sum += v;
        }
    }
    Premul(sum.map(|v| v / samples as f32))
}

const TRILINEAR: Sampler = Sampler::DEFAULT.with(PixelFilter::Bilinear, LevelMode::Linear);
