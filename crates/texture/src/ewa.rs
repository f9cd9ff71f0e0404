//! The elliptical weighted average: from a footprint to an ellipse, a level and a walk.

use crate::level::Level;
use crate::lod::{self, Pick, half_octaves};
use crate::math::{floor, sqrt};
use crate::point::lerp;
use crate::walk::{Walk, walk};
use crate::wrap::FAR;
use crate::{Footprint, LevelMode, Sampler, Texture};
use scumble_geometry::Matrix2;

/// Variance of the pixel's Gaussian along each axis, in squared pixels: σ = ½ pixel.
const PIXEL_VARIANCE: f64 = 0.25;

/// Variance of the reconstruction between texels, in squared texels: bilinear interpolation's.
const RECONSTRUCTION: f64 = 1.0 / 6.0;

/// The least variance left after subtracting what the pyramid has blurred already, in squared
/// texels of the level that is read.
const LEAST_VARIANCE: f64 = 0.15;

/// The area of an ellipse, in texels of the level that is read, that is always allowed. A larger
/// one, where no coarser level takes it, is shrunk to this area, which aliases: level zero of a
/// texture minified more than 46 times, or a texture without its pyramid.
pub(crate) const BUDGET: f64 = 16_384.0;

/// The least ratio of V₂/s² to the switch of level at which two levels blend: 4^¾, so that the
/// last quarter of the octave in σ blends.
const BAND_START: f64 = 2.828_427_124_746_190_3;

/// The numbers of a sampler that the ellipse needs, brought into their ranges.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Limits {
    /// 1/a²: the least ratio of the variances.
    inverse_ratio: f64,
    /// R.
    radius: f64,
    /// 1/s².
    inverse_least: f64,
    /// The largest area of an ellipse, in texels of the level.
    area: f64,
    blend: bool,
}

impl Limits {
    pub(crate) fn new(s: &Sampler) -> Self {
        // `max` and `min` in this order turn a NaN into the lower bound.
        let within = |x: f32, low: f64, high: f64| f64::from(x).max(low).min(high);
        let ratio = within(s.max_eccentricity, 1.0, 1024.0);
        let radius = within(s.radius, 2.0, 4.0);
        let least = within(s.least_sigma, 0.4, 4.0);
        let natural = core::f64::consts::PI * radius * radius * 4.0 * least * least * ratio;
        Self {
            inverse_ratio: 1.0 / (ratio * ratio),
            radius,
            inverse_least: 1.0 / (least * least),
            area: natural.max(BUDGET),
            blend: s.blend,
        }
    }
}

/// A Gaussian's covariance in a plane of texels. Positive definite.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Covariance {
    pub(crate) uu: f64,
    pub(crate) uv: f64,
    pub(crate) vv: f64,
    /// Its determinant, kept apart because uu·vv − uv² cancels for thin ellipses.
    pub(crate) det: f64,
}

impl Covariance {
    /// Pixel and reconstruction together, for a Jacobian in texels per pixel, with the minor axis
    /// widened to the largest ratio; and the variance V₂ along the minor axis.
    ///
    /// With p, q, r the entries of JJᵀ and h = hypot(p − r, 2q), the squared singular values are
    /// s₁² = (p + r + h)/2 and s₂² = det²J/s₁² (the quadratic formula would lose s₂ to
    /// cancellation), and the projector onto the minor axis is ½(I − [[p−r, 2q], [2q, r−p]]/h): no
    /// angle and no direction is needed.
    fn of(j: &Matrix2, inverse_ratio: f64) -> (Self, f64) {
        let p = j.a * j.a + j.b * j.b;
        let r = j.c * j.c + j.d * j.d;
        let q = j.a * j.c + j.b * j.d;
        let (x, y) = (p - r, 2.0 * q);
        let h = sqrt(x * x + y * y);
        let s1 = 0.5 * (p + r + h);
        let determinant = j.determinant();
        // s₁² = 0 only where everything under it has vanished.
        let s2 = if s1 > 0.0 { determinant * determinant / s1 } else { 0.0 };
        let v1 = PIXEL_VARIANCE * s1 + RECONSTRUCTION;
        let v2 = PIXEL_VARIANCE * s2 + RECONSTRUCTION;
        let wide = v2.max(v1 * inverse_ratio);
        let k = if wide > v2 && h > 0.0 { 0.5 * (wide - v2) / h } else { 0.0 };
        let sigma = Self {
            uu: PIXEL_VARIANCE * p + RECONSTRUCTION + k * (h - x),
            uv: PIXEL_VARIANCE * q - k * y,
            vv: PIXEL_VARIANCE * r + RECONSTRUCTION + k * (h + x),
            det: v1 * wide,
        };
        (sigma, wide)
    }

    /// S(Σ − M)S: in texels of a level of the given scale, without what the pyramid has blurred.
    fn at_level(self, scale: [f64; 2], step_variance: f64) -> Self {
        let [su, sv] = scale;
        // m = v_t·(4^l − 1)/3 per axis, with 2^l the true ratio of the sizes.
        let blurred = |s: f64| step_variance * (1.0 / (s * s) - 1.0) / 3.0;
        let (mu, mv) = (blurred(su), blurred(sv));
        let uu = (self.uu - mu) * su * su;
        let vv = (self.vv - mv) * sv * sv;
        let uv = self.uv * su * sv;
        let det = (self.det - mu * self.vv - mv * self.uu + mu * mv) * su * su * sv * sv;
        Self { uu, uv, vv, det }.floored()
    }

    /// The same with no variance along any axis below [`LEAST_VARIANCE`].
    fn floored(self) -> Self {
        let (x, y) = (self.uu - self.vv, 2.0 * self.uv);
        let h = sqrt(x * x + y * y);
        let v1 = 0.5 * (self.uu + self.vv + h);
        if v1 < LEAST_VARIANCE {
            let v = LEAST_VARIANCE;
            return Self { uu: v, uv: 0.0, vv: v, det: v * v };
        }
        let v2 = self.det / v1;
        if v2 >= LEAST_VARIANCE {
            return self;
        }
        let k = if h > 0.0 { 0.5 * (LEAST_VARIANCE - v2) / h } else { 0.0 };
        Self {
            uu: self.uu + k * (h - x),
            uv: self.uv - k * y,
            vv: self.vv + k * (h + x),
            det: v1 * LEAST_VARIANCE,
        }
    }

    /// Shrinks to the largest area, πR²√det, keeping the shape.
    fn within_area(self, limits: &Limits) -> Self {
        let area = core::f64::consts::PI * limits.radius * limits.radius * sqrt(self.det);
        if area <= limits.area {
            return self;
        }
        let k = limits.area / area;
        Self { uu: self.uu * k, uv: self.uv * k, vv: self.vv * k, det: self.det * k * k }
    }

    /// Squeezes along each axis so that the ellipse reaches at most one wrap of the level beyond
    /// its own half: one and a half times the size, and a texel.
    fn within_level(self, level: &Level, radius: f64) -> Self {
        let squeeze = |variance: f64, size: usize| {
            let most = 1.5 * size as f64 + 1.0;
            let reach = radius * radius * variance;
            if reach > most * most { most / sqrt(reach) } else { 1.0 }
        };
        let (ku, kv) = (squeeze(self.uu, level.width), squeeze(self.vv, level.height));
        Self {
            uu: self.uu * ku * ku,
            uv: self.uv * ku * kv,
            vv: self.vv * kv * kv,
            det: self.det * ku * ku * kv * kv,
        }
    }
}

/// Whether every component is within what the formulas hold.
pub(crate) fn is_usable(j: &Matrix2) -> bool {
    // A comparison with NaN is false.
    [j.a, j.b, j.c, j.d].iter().all(|v| v.abs() <= FAR)
}

/// What to read for one sample: an ellipse in a level, and perhaps the same in the next coarser one.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Plan {
    level: usize,
    fine: Walk,
    /// The ellipse in level + 1 and its weight.
    coarse: Option<(Walk, f32)>,
}

impl Plan {
    /// The plan for a footprint whose centre has been reduced and whose Jacobian is usable.
    pub(crate) fn new(t: &Texture, f: &Footprint, mode: LevelMode, limits: &Limits) -> Self {
        if mode == LevelMode::Auto {
            return Self::auto(t, f, limits);
        }
        let pick = lod::pick(f, mode, t.levels.len());
        Self::of(t, f, limits, pick, |level| {
            // The footprint rescaled, as if that level were the texture.
            let [su, sv] = t.scale(level);
            let Matrix2 { a, b, c, d } = f.jacobian;
            let jacobian = Matrix2::new(a * su, b * su, c * sv, d * sv);
            Covariance::of(&jacobian, limits.inverse_ratio).0
        })
    }

    /// The level from V₂, with the next one in the last part of the octave.
    fn auto(t: &Texture, f: &Footprint, limits: &Limits) -> Self {
        let (sigma, minor) = Covariance::of(&f.jacobian, limits.inverse_ratio);
        let pick = auto_pick(minor * limits.inverse_least, t.levels.len() - 1, limits.blend);
        Self::of(t, f, limits, pick, |level| match level {
            0 => sigma,
            _ => sigma.at_level(t.scale(level), t.decimation.variance()),
        })
    }

    fn of(
        t: &Texture,
        f: &Footprint,
        limits: &Limits,
        pick: Pick,
        sigma: impl Fn(usize) -> Covariance,
    ) -> Self {
        let walk = |index: usize| {
            let [su, sv] = t.scale(index);
            let sigma = sigma(index).within_area(limits);
            let sigma = sigma.within_level(&t.levels[index], limits.radius);
            Walk::new(f.u * su - 0.5, f.v * sv - 0.5, &sigma, limits.radius)
        };
        let coarse = (pick.coarser > 0.0).then(|| (walk(pick.level + 1), pick.coarser));
        Self { level: pick.level, fine: walk(pick.level), coarse }
    }

    /// The colour.
    pub(crate) fn run(&self, t: &Texture) -> [f32; 4] {
        let fine = walk(&t.levels[self.level], t.wrap, &self.fine);
        match &self.coarse {
            None => fine,
            Some((w, weight)) => lerp(fine, walk(&t.levels[self.level + 1], t.wrap, w), *weight),
        }
    }

    /// Texels that [`Plan::run`] reads.
    pub(crate) fn texels(&self) -> usize {
        self.fine.texels() + self.coarse.map_or(0, |(w, _)| w.texels())
    }
}

/// The level where σ of the minor axis is between s and 2s, from V₂/s², and how much of the next.
fn auto_pick(minor: f64, last: usize, blend: bool) -> Pick {
    let level = half_octaves(minor).min(last);
    // Dividing by 4^l is exact; l is below 32.
    let ratio = minor / (1u64 << (2 * level.min(31))) as f64;
    if !blend || level == last || ratio <= BAND_START {
        return Pick { level, coarser: 0.0 };
    }
    let x = (ratio - BAND_START) / (4.0 - BAND_START);
    Pick { level, coarser: (x * x * (3.0 - 2.0 * x)) as f32 }
}

impl Walk {
    /// The walk over an ellipse about (u, v), in index space (texel centres at whole numbers).
    fn new(u: f64, v: f64, sigma: &Covariance, radius: f64) -> Self {
        let inverse_vv = 1.0 / sigma.vv;
        // Half-widths: R√Σvv over the rows, R√(det/Σvv) along any one row.
        let rows = radius * sqrt(sigma.vv);
        let run = radius * sqrt(sigma.det * inverse_vv);
        let (u0, v0) = (floor(u), floor(v));
        Self {
            x0: u0 as i64,
            y0: v0 as i64,
            fx: (u - u0) as f32,
            fy: (v - v0) as f32,
            first: -floor(rows - (v - v0)) as i32,
            last: floor(rows + (v - v0)) as i32,
            run: run as f32,
            slope: (sigma.uv * inverse_vv) as f32,
            row_scale: (0.5 * inverse_vv) as f32,
            run_scale: (0.5 * sigma.vv / sigma.det) as f32,
            cut: (0.5 * radius * radius) as f32,
        }
    }
}
