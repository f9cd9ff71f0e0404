//! Anisotropic filtering by a row of round probes along the footprint's major axis.

use crate::kernel::gaussian;
use crate::lod::{self, Pick};
use crate::math::{ceil, sqrt};
use crate::place;
use crate::procedural::Source;
use crate::{Footprint, LevelMode, Texture, point};
use scumble_geometry::Matrix2;
use scumble_pixel::Premul;

/// A row of probes: Feline (McCormack, Perry, Farkas and Jouppi, "Feline: fast elliptical lines for
/// anisotropic texture mapping", 1999), with the ellipse's true axes.
///
/// Each probe asks the source for a round spot as wide as the minor axis; the spots lie along the
/// major axis, weighted by a Gaussian whose variance, with the spot's own, is that of the pixel
/// (σ = ½) along the axis. The columns of the Jacobian are not the axes unless they are orthogonal,
/// and their lengths understate the axis ratio, by 0.58 in the median over random Jacobians.
///
/// Where the ellipse is longer than the probes reach, the spots grow: that blurs, and never aliases.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Probes {
    most: u32,
}

/// Half the length of the row, in σ of the row. With Feline's two probes for each unit of the axis
/// ratio, neighbours lie two σ of the spot apart, where Gaussians still add up to a line that is even
/// to 1.4 %.
const REACH: f32 = 2.0;

impl Probes {
    /// A filter of at most `most` probes, in 1…1024; what lies outside is clamped.
    #[must_use]
    pub fn new(most: u32) -> Self {
        Self { most: most.clamp(1, 1024) }
    }

    /// The colour of a footprint.
    ///
    /// A footprint that is not finite is handed to the source as it is.
    #[must_use]
    pub fn sample(&self, f: &Footprint, source: &impl Source) -> Premul {
        let row = Row::new(f, self.most);
        if row.count == 1 {
            return source.color(&row.spot(0));
        }
        Premul(row.average(|f| source.color(f).0))
    }
}

/// The spots of one footprint.
pub(crate) struct Row {
    centre: [f64; 2],
    jacobian: Matrix2,
    /// Spots, at least 1.
    pub(crate) count: u32,
    /// From one spot to the next.
    step: [f64; 2],
}

impl Row {
    #[inline(always)]
    pub(crate) fn new(f: &Footprint, most: u32) -> Self {
        let axes = f.jacobian.axes();
        let (major, minor) = (axes.major, axes.minor);
        let one = Self { centre: [f.u, f.v], jacobian: f.jacobian, count: 1, step: [0.0; 2] };
        if !major.is_finite() || major == 0.0 {
            return one;
        }
        // ⌈2a − 1⌉ for an axis ratio a; a cast takes ∞ for the largest.
        let count = (ceil(2.0 * (major / minor) - 1.0) as u32).clamp(1, most.max(1));
        // As wide as so many spots take for the whole length.
        let spot = minor.max(2.0 * major / f64::from(count + 1));
        let jacobian = Matrix2::new(spot, 0.0, 0.0, spot);
        if count == 1 {
            return Self { jacobian, ..one };
        }
        // What the spot leaves of the pixel's variance along the axis, σ = ½ of its length.
        let rest = 0.5 * sqrt((major * major - spot * spot).max(0.0));
        let (mut sum, mut total) = (0.0, 0.0);
        for k in 0..count {
            let (x, weight) = place(k, count);
            sum += weight * x * x;
            total += weight;
        }
        let step =
            rest * sqrt(f64::from(total / sum)) * f64::from(2.0 * REACH) / f64::from(count - 1);
        Self { jacobian, count, step: axes.direction.map(|d| d * step), ..one }
    }

    /// Spot `k`.
    #[inline(always)]
    pub(crate) fn spot(&self, k: u32) -> Footprint {
        let k = f64::from(k) - 0.5 * f64::from(self.count - 1);
        let [u, v] = self.centre;
        Footprint { u: u + k * self.step[0], v: v + k * self.step[1], jacobian: self.jacobian }
    }

    /// The weighted mean over the spots, about the first, so that a constant stays what it is.
    #[inline(always)]
    pub(crate) fn average(&self, color: impl Fn(&Footprint) -> [f32; 4]) -> [f32; 4] {
        let first = color(&self.spot(0));
        let (mut sum, mut total) = ([0.0; 4], place(0, self.count).1);
        for k in 1..self.count {
            let (_, weight) = place(k, self.count);
            let next = color(&self.spot(k));
            total += weight;
            for c in 0..4 {
                sum[c] += weight * (next[c] - first[c]);
            }
        }
        core::array::from_fn(|c| first[c] + sum[c] / total)
    }
}

/// Where spot `k` of several lies, in σ, before the row is stretched to its variance; and its weight.
#[inline(always)]
fn place(k: u32, count: u32) -> (f32, f32) {
    if count == 1 {
        return (0.0, 1.0);
    }
    let x = REACH * (2.0 * (k as f32 / (count - 1) as f32) - 1.0);
    (x, gaussian(0.5 * x * x))
}

/// The colour of a footprint that is finite and bounded: trilinear probes.
#[inline(always)]
pub(crate) fn sample(t: &Texture, f: &Footprint, mode: LevelMode, most: u32) -> [f32; 4] {
    let row = Row::new(f, most);
    let Pick { level, coarser } = lod::pick(&row.spot(0), mode, t.range());
    let in_level = |index: usize| {
        let level = &t.levels[index];
        let [su, sv] = level.frame.scale;
        row.average(|spot| {
            let f = t.nearer(spot);
            place::bilinear(level, t.wrap, f.u * su, f.v * sv)
        })
    };
    let fine = in_level(level);
    if coarser > 0.0 { point::lerp(fine, in_level(level + 1), coarser) } else { fine }
}

/// Texels that [`sample`] reads.
pub(crate) fn cost(t: &Texture, f: &Footprint, mode: LevelMode, most: u32) -> usize {
    let row = Row::new(f, most);
    let levels = if lod::pick(&row.spot(0), mode, t.range()).coarser > 0.0 { 2 } else { 1 };
    4 * levels * row.count as usize
}
