use crate::ewa::Limits;
use crate::level::Frame;
use crate::math::sqrt;
use scumble_geometry::Matrix2;

/// Variance of the pixel's Gaussian along each axis, in squared pixels: σ = ½ pixel.
const PIXEL_VARIANCE: f64 = 0.25;

/// Variance of the reconstruction between texels, in squared texels: bilinear interpolation's.
const RECONSTRUCTION: f64 = 1.0 / 6.0;

/// The least variance left after subtracting what the pyramid has blurred already, in squared
/// texels of the level that is read.
const LEAST_VARIANCE: f64 = 0.15;

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
    #[inline(always)]
    pub(crate) fn of(j: &Matrix2, inverse_ratio: f64) -> (Self, f64) {
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

    /// S(Σ − M)S: in texels of a level, without what the pyramid has blurred.
    #[inline(always)]
    pub(crate) fn at_level(self, frame: &Frame) -> Self {
        let ([su, sv], [mu, mv]) = (frame.scale, frame.blurred);
        Self {
            uu: (self.uu - mu) * su * su,
            uv: self.uv * su * sv,
            vv: (self.vv - mv) * sv * sv,
            det: (self.det - mu * self.vv - mv * self.uu + mu * mv) * su * su * sv * sv,
        }
    }

    /// Whether [`Covariance::mend`] has anything to do, or might.
    #[inline(always)]
    pub(crate) fn needs_mending(&self, frame: &Frame, limits: &Limits) -> bool {
        // (V₁ − L)(V₂ − L), which is negative where L lies between them.
        let least = self.det - LEAST_VARIANCE * (self.uu + self.vv - LEAST_VARIANCE);
        let [u, v] = frame.most;
        (least < 0.0)
            | (self.uu + self.vv < 2.0 * LEAST_VARIANCE)
            | (self.det > limits.most_det)
            | (self.uu * limits.radius_squared > u * u)
            | (self.vv * limits.radius_squared > v * v)
    }

    /// Brings the rare ellipse within bounds: not reaching too far along an axis of one texel, not
    /// larger than the budget, and above all not thinner than a texel.
    pub(crate) fn mend(self, frame: &Frame, limits: &Limits) -> Self {
        let s = self.within_level(frame, limits);
        let (x, y) = (s.uu - s.vv, 2.0 * s.uv);
        let h = sqrt(x * x + y * y);
        let v1 = (0.5 * (s.uu + s.vv + h)).max(LEAST_VARIANCE);
        let v2 = (s.det / v1).max(LEAST_VARIANCE);
        let k = sqrt((limits.most_det / (v1 * v2)).min(1.0));
        let v2 = (v2 * k).max(LEAST_VARIANCE);
        let v1 = v1.min(limits.most_det / v2);
        // The same axes: [[x, y], [y, −x]]/h is the difference of the projectors onto them.
        let (sum, part) = (0.5 * (v1 + v2), if h > 0.0 { 0.5 * (v1 - v2) / h } else { 0.0 });
        Self { uu: sum + part * x, uv: part * y, vv: sum - part * x, det: v1 * v2 }
    }

    /// Squeezes along each axis so that the ellipse's half-width there is what the level allows.
    fn within_level(self, frame: &Frame, limits: &Limits) -> Self {
        let squeeze = |variance: f64, most: f64| {
            let reach = limits.radius_squared * variance;
            if reach > most * most { most / sqrt(reach) } else { 1.0 }
        };
        let (ku, kv) = (squeeze(self.uu, frame.most[0]), squeeze(self.vv, frame.most[1]));
        Self {
            uu: self.uu * ku * ku,
            uv: self.uv * ku * kv,
            vv: self.vv * kv * kv,
            det: self.det * ku * ku * kv * kv,
        }
    }
}
