use crate::ewa::Limits;
use crate::level::Frame;
use crate::math::{sqrt, sqrt32};
use crate::number::Number;
use scumble_geometry::Matrix2;

/// Variance of the pixel's Gaussian along each axis, in squared pixels: σ = ½ pixel.
pub(crate) const PIXEL_VARIANCE: f32 = 0.25;

/// Variance of the reconstruction between texels, in squared texels: bilinear interpolation's.
pub(crate) const RECONSTRUCTION: f32 = 1.0 / 6.0;

/// The least variance left after subtracting what the pyramid has blurred already, in squared
/// texels of the level that is read.
pub(crate) const LEAST_VARIANCE: f32 = 0.15;

/// A Gaussian's covariance in a plane of texels. Positive definite.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Covariance {
    pub(crate) uu: f32,
    pub(crate) uv: f32,
    pub(crate) vv: f32,
    /// Its determinant, kept apart because uu·vv − uv² cancels for thin ellipses.
    pub(crate) det: f32,
}

/// A Jacobian by rows, in single precision.
#[inline(always)]
pub(crate) fn single(j: &Matrix2) -> [f32; 4] {
    [j.a, j.b, j.c, j.d].map(|v| v as f32)
}

/// The entries p, q, r of JJᵀ = [[p, q], [q, r]], of a Jacobian by rows.
#[inline(always)]
pub(crate) fn products<N: Number>([a, b, c, d]: [N; 4]) -> [N; 3] {
    [a * a + b * b, a * c + b * d, c * c + d * d]
}

/// The square of the minor axis of a footprint from the [`products`] and the determinant of its Jacobian:
/// no less than the largest ratio allows.
#[inline(always)]
pub(crate) fn minor_squared<N: Number>([p, q, r]: [N; 3], determinant: N, inverse_ratio: f32) -> N {
    let (x, y) = (p - r, q * 2.0);
    let major = ((p + r) + (x * x + y * y).sqrt()) * 0.5;
    // 0 only where everything under it has vanished.
    let minor = major.if_positive(determinant * determinant / major, major.all(0.0));
    minor.at_least(major * inverse_ratio)
}

impl Covariance {
    /// Pixel and reconstruction together, for a Jacobian in texels per pixel, with the minor axis
    /// widened to the largest ratio; and the variance V₂ along the minor axis.
    ///
    /// With p, q, r the entries of JJᵀ and h = hypot(p − r, 2q), the squared singular values are
    /// s₁² = (p + r + h)/2 and s₂² = det²J/s₁² (the quadratic formula would lose s₂ to
    /// cancellation), and the projector onto the minor axis is ½(I − [[p−r, 2q], [2q, r−p]]/h): no
    /// angle and no direction is needed. Only det J cancels, so it is found in double precision; all
    /// else are sums of what is positive, or of what does not count where it cancels.
    #[inline(always)]
    pub(crate) fn of(j: &Matrix2, inverse_ratio: f32) -> (Self, f32) {
        let determinant = j.determinant() as f32;
        let [p, q, r] = products(single(j));
        let (x, y) = (p - r, 2.0 * q);
        let h = sqrt32(x * x + y * y);
        let s1 = 0.5 * (p + r + h);
        // s₁² = 0 only where everything under it has vanished.
        let s2 = if s1 > 0.0 { determinant * determinant / s1 } else { 0.0 };
        let v1 = PIXEL_VARIANCE * s1 + RECONSTRUCTION;
        let v2 = PIXEL_VARIANCE * s2 + RECONSTRUCTION;
        let least = v1 * inverse_ratio;
        let wide = if v2 > least { v2 } else { least };
        let k = if h > 0.0 { 0.5 * (wide - v2) / h } else { 0.0 };
        let sigma = Self {
            uu: (PIXEL_VARIANCE * p + RECONSTRUCTION) + k * (h - x),
            uv: PIXEL_VARIANCE * q - k * y,
            vv: (PIXEL_VARIANCE * r + RECONSTRUCTION) + k * (h + x),
            det: v1 * wide,
        };
        (sigma, wide)
    }

    /// S(Σ − M)S: in texels of a level, without what the pyramid has blurred.
    #[inline(always)]
    pub(crate) fn at_level(self, frame: &Frame) -> Self {
        let ([ss_u, ss_uv, ss_v, all], [mu, mv]) = (frame.products, frame.blurred);
        Self {
            uu: (self.uu - mu) * ss_u,
            uv: self.uv * ss_uv,
            vv: (self.vv - mv) * ss_v,
            det: ((self.det - mu * self.vv) - (self.uu - mu) * mv) * all,
        }
    }

    /// Whether [`Covariance::mend`] has anything to do, or might.
    #[inline(always)]
    pub(crate) fn needs_mending(&self, frame: &Frame, limits: &Limits) -> bool {
        // (V₁ − L)(V₂ − L), which is negative where L lies between them.
        let sum = self.uu + self.vv;
        let least = self.det - LEAST_VARIANCE * (sum - LEAST_VARIANCE);
        (least < 0.0) | (sum < 2.0 * LEAST_VARIANCE) | self.is_too_large(frame, limits)
    }

    /// Whether it is larger than the budget, or reaches too far along an axis of one texel.
    #[inline(always)]
    pub(crate) fn is_too_large(&self, frame: &Frame, limits: &Limits) -> bool {
        let [u, v] = frame.most;
        (self.det > limits.most_det)
            | (self.uu * limits.radius_squared > u * u)
            | (self.vv * limits.radius_squared > v * v)
    }

    /// Brings the rare ellipse within bounds: not reaching too far along an axis of one texel, not
    /// larger than the budget, and above all not thinner than a texel.
    pub(crate) fn mend(self, frame: &Frame, limits: &Limits) -> Self {
        let [uu, uv, vv, det] = self.within_level(frame, limits);
        let (least, most_det) = (f64::from(LEAST_VARIANCE), f64::from(limits.most_det));
        let (x, y) = (uu - vv, 2.0 * uv);
        let h = sqrt(x * x + y * y);
        let v1 = (0.5 * (uu + vv + h)).max(least);
        let v2 = (det / v1).max(least);
        let k = sqrt((most_det / (v1 * v2)).min(1.0));
        let v2 = (v2 * k).max(least);
        let v1 = v1.min(most_det / v2);
        // The same axes: [[x, y], [y, −x]]/h is the difference of the projectors onto them.
        let (sum, part) = (0.5 * (v1 + v2), if h > 0.0 { 0.5 * (v1 - v2) / h } else { 0.0 });
        Self {
            uu: (sum + part * x) as f32,
            uv: (part * y) as f32,
            vv: (sum - part * x) as f32,
            det: (v1 * v2) as f32,
        }
    }

    /// Squeezes along each axis so that the ellipse's half-width there is what the level allows.
    fn within_level(self, frame: &Frame, limits: &Limits) -> [f64; 4] {
        let squeeze = |variance: f32, most: f32| {
            let reach = f64::from(limits.radius_squared) * f64::from(variance);
            let most = f64::from(most);
            if reach > most * most { most / sqrt(reach) } else { 1.0 }
        };
        let (ku, kv) = (squeeze(self.uu, frame.most[0]), squeeze(self.vv, frame.most[1]));
        [
            f64::from(self.uu) * ku * ku,
            f64::from(self.uv) * ku * kv,
            f64::from(self.vv) * kv * kv,
            f64::from(self.det) * ku * ku * kv * kv,
        ]
    }
}
