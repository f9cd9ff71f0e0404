use crate::ewa::Limits;
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
    pub(crate) fn at_level(self, scale: [f64; 2], blurred: [f64; 2]) -> Self {
        let ([su, sv], [mu, mv]) = (scale, blurred);
        Self {
            uu: (self.uu - mu) * su * su,
            uv: self.uv * su * sv,
            vv: (self.vv - mv) * sv * sv,
            det: (self.det - mu * self.vv - mv * self.uu + mu * mv) * su * su * sv * sv,
        }
    }

    /// Whether [`Covariance::mend`] has anything to do, or might.
    #[inline(always)]
    pub(crate) fn needs_mending(&self, most: [f64; 2], limits: &Limits) -> bool {
        // The minor variance lies between det/(uu + vv) and twice that.
        let sum = self.uu + self.vv;
        let most = most[0].max(most[1]);
        (self.det < LEAST_VARIANCE * sum)
            | (self.det > limits.most_det)
            | (2.0 * limits.radius_squared * self.det > most * most * sum)
    }

    /// Brings the rare ellipse within bounds: not thinner than a texel, not larger than the budget,
    /// its minor axis not reaching farther than `most` of the level.
    pub(crate) fn mend(self, most: [f64; 2], limits: &Limits) -> Self {
        self.floored().within_area(limits).within_level(most, limits)
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
        if self.det <= limits.most_det {
            return self;
        }
        let k = sqrt(limits.most_det / self.det);
        Self { uu: self.uu * k, uv: self.uv * k, vv: self.vv * k, det: limits.most_det }
    }

    /// Shrinks, keeping the shape, so that half the minor axis is at most the larger `most`: what
    /// spans a level in every direction averages all of it, however much farther it reaches. A long
    /// thin ellipse keeps its length: where a texture repeats, it crosses it again and again at
    /// other places, and cut to one crossing it would alias.
    fn within_level(self, most: [f64; 2], limits: &Limits) -> Self {
        let (x, y) = (self.uu - self.vv, 2.0 * self.uv);
        let major = 0.5 * (self.uu + self.vv + sqrt(x * x + y * y));
        let reach = limits.radius_squared * self.det / major;
        let most = most[0].max(most[1]);
        if reach <= most * most {
            return self;
        }
        let k = most * most / reach;
        Self { uu: self.uu * k, uv: self.uv * k, vv: self.vv * k, det: self.det * k * k }
    }
}
