use crate::math::sqrt;
use crate::wrap::FAR;
use scumble_geometry::{DVec2, Homography, Matrix2};

/// What a pixel sees of a texture: a place and how the texture runs under the pixel there.
///
/// Texel (i, j) of level 0 covers [i, i+1) × [j, j+1), so its centre is at (i + ½, j + ½).
/// A triangle's affine map, a homography and any smooth warp all give footprints; every filter
/// takes one.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Footprint {
    /// Column of the pixel's centre, in texels of level 0.
    pub u: f64,
    /// Row of the pixel's centre, in texels of level 0.
    pub v: f64,
    /// ∂(u, v)/∂(x, y), in texels of level 0 per pixel.
    pub jacobian: Matrix2,
}

impl Footprint {
    /// The footprint at point `p` of the screen under a map from the screen to texels of level 0.
    ///
    /// Behind the eye and on the horizon (w ≤ 0) everything in it is NaN, which every filter
    /// takes for "infinitely far".
    #[must_use]
    #[inline(always)]
    pub fn at(map: &Homography, p: DVec2) -> Self {
        let h = map.project_homogeneous(p);
        let w = if h.z > 0.0 { 1.0 / h.z } else { f64::NAN };
        let (u, v) = (h.x * w, h.y * w);
        let [r0, r1, r2] = &map.m;
        let jacobian = Matrix2::new(
            (r0[0] - u * r2[0]) * w,
            (r0[1] - u * r2[1]) * w,
            (r1[0] - v * r2[0]) * w,
            (r1[1] - v * r2[1]) * w,
        );
        Self { u, v, jacobian }
    }

    /// A footprint that does not depend on the place: J = 0, a point.
    #[must_use]
    pub const fn point(u: f64, v: f64) -> Self {
        Self { u, v, jacobian: Matrix2::new(0.0, 0.0, 0.0, 0.0) }
    }

    /// Whether the centre is finite.
    #[inline(always)]
    pub(crate) fn is_finite(&self) -> bool {
        (self.u.abs() < f64::INFINITY) & (self.v.abs() < f64::INFINITY)
    }

    /// Whether the components of the Jacobian are within what the formulas hold, all together.
    #[inline(always)]
    pub(crate) fn is_bounded(&self) -> bool {
        let Matrix2 { a, b, c, d } = self.jacobian;
        let [a, b, c, d] = [a as f32, b as f32, c as f32, d as f32];
        // A comparison with NaN is false.
        (a.abs() + b.abs()) + (c.abs() + d.abs()) <= FAR as f32
    }

    /// The square of the major axis of the ellipse, s₁².
    #[inline(always)]
    pub(crate) fn major_squared(&self) -> f64 {
        let Matrix2 { a, b, c, d } = self.jacobian;
        let (p, r, q) = (a * a + b * b, c * c + d * d, a * c + b * d);
        let (x, y) = (p - r, 2.0 * q);
        0.5 * (p + r + sqrt(x * x + y * y))
    }
}
