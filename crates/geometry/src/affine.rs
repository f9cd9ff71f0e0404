use crate::{DVec2, GeometryError, Matrix2, Rect};
use core::ops::Mul;

/// An affine map of the plane, the six numbers of SVG's `matrix(a b c d e f)`:
///
/// ```text
/// | a c e |   | x |
/// | b d f | · | y |
/// | 0 0 1 |   | 1 |
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Affine {
    /// ∂x'/∂x.
    pub a: f64,
    /// ∂y'/∂x.
    pub b: f64,
    /// ∂x'/∂y.
    pub c: f64,
    /// ∂y'/∂y.
    pub d: f64,
    /// Translation in x.
    pub e: f64,
    /// Translation in y.
    pub f: f64,
}

impl Affine {
    /// The map that moves nothing.
    pub const IDENTITY: Self = Self::new(1.0, 0.0, 0.0, 1.0, 0.0, 0.0);

    /// `matrix(a b c d e f)` as SVG writes it: two columns, then the translation.
    #[must_use]
    pub const fn new(a: f64, b: f64, c: f64, d: f64, e: f64, f: f64) -> Self {
        Self { a, b, c, d, e, f }
    }

    /// Moves by (x, y).
    #[must_use]
    pub const fn translate(x: f64, y: f64) -> Self {
        Self::new(1.0, 0.0, 0.0, 1.0, x, y)
    }

    /// Scales about the origin.
    #[must_use]
    pub const fn scale(x: f64, y: f64) -> Self {
        Self::new(x, 0.0, 0.0, y, 0.0, 0.0)
    }

    /// The map that takes `from` to `to`, edge to edge. An empty `from` gives non-finite numbers.
    #[must_use]
    pub fn rect_to_rect(from: Rect, to: Rect) -> Self {
        let x = to.width() / from.width();
        let y = to.height() / from.height();
        Self::new(x, 0.0, 0.0, y, to.x0 - from.x0 * x, to.y0 - from.y0 * y)
    }

    /// The image of a point.
    #[must_use]
    pub fn apply(&self, p: DVec2) -> DVec2 {
        DVec2::new(self.a * p.x + self.c * p.y + self.e, self.b * p.x + self.d * p.y + self.f)
    }

    /// The linear part: the Jacobian, the same everywhere.
    #[must_use]
    pub fn linear(&self) -> Matrix2 {
        Matrix2::new(self.a, self.c, self.b, self.d)
    }

    /// a·d − b·c: the signed area of the unit square's image.
    #[must_use]
    pub fn determinant(&self) -> f64 {
        self.a * self.d - self.b * self.c
    }

    /// The map back.
    ///
    /// # Errors
    /// [`GeometryError::Singular`] if the determinant is zero or not finite.
    pub fn inverse(&self) -> Result<Self, GeometryError> {
        let det = self.determinant();
        let inv = 1.0 / det;
        if !det.is_normal() || !inv.is_finite() {
            return Err(GeometryError::Singular);
        }
        Ok(Self {
            a: self.d * inv,
            b: -self.b * inv,
            c: -self.c * inv,
            d: self.a * inv,
            e: (self.c * self.f - self.d * self.e) * inv,
            f: (self.b * self.e - self.a * self.f) * inv,
        })
    }

    /// Whether all six numbers are finite.
    #[must_use]
    pub fn is_finite(&self) -> bool {
        [self.a, self.b, self.c, self.d, self.e, self.f].iter().all(|v| v.is_finite())
    }
}

impl Mul for Affine {
    type Output = Self;

    fn mul(self, rhs: Self) -> Self {
        Self {
            a: self.a * rhs.a + self.c * rhs.b,
            b: self.b * rhs.a + self.d * rhs.b,
            c: self.a * rhs.c + self.c * rhs.d,
            d: self.b * rhs.c + self.d * rhs.d,
            e: self.a * rhs.e + self.c * rhs.f + self.e,
            f: self.b * rhs.e + self.d * rhs.f + self.f,
        }
    }
}
