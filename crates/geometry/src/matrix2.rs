use crate::math::sqrt;
use crate::{DVec2, GeometryError};
use core::ops::Mul;

/// A 2×2 matrix by rows; as a Jacobian, `[[∂u/∂x, ∂u/∂y], [∂v/∂x, ∂v/∂y]]`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Matrix2 {
    /// Row 0, column 0: ∂u/∂x.
    pub a: f64,
    /// Row 0, column 1: ∂u/∂y.
    pub b: f64,
    /// Row 1, column 0: ∂v/∂x.
    pub c: f64,
    /// Row 1, column 1: ∂v/∂y.
    pub d: f64,
}

/// The ellipse that a matrix makes of the unit circle: its singular values and the direction of
/// the longer axis.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Axes {
    /// The larger singular value: the major half-axis.
    pub major: f64,
    /// The smaller singular value: the minor half-axis.
    pub minor: f64,
    /// Unit direction of the major axis in the image; (1, 0) for a circle.
    pub direction: [f64; 2],
}

impl Matrix2 {
    /// `[[a, b], [c, d]]`, row by row.
    #[must_use]
    pub const fn new(a: f64, b: f64, c: f64, d: f64) -> Self {
        Self { a, b, c, d }
    }

    /// a·d − b·c.
    #[must_use]
    pub fn determinant(&self) -> f64 {
        self.a * self.d - self.b * self.c
    }

    /// `[[a, c], [b, d]]`: the same matrix by columns.
    #[must_use]
    pub const fn transpose(&self) -> Self {
        Self::new(self.a, self.c, self.b, self.d)
    }

    /// The matrix times a column vector.
    #[must_use]
    pub fn apply(&self, v: DVec2) -> DVec2 {
        DVec2::new(self.a * v.x + self.b * v.y, self.c * v.x + self.d * v.y)
    }

    /// Whether all four numbers are finite.
    #[must_use]
    pub fn is_finite(&self) -> bool {
        [self.a, self.b, self.c, self.d].iter().all(|v| v.is_finite())
    }

    /// The inverse matrix.
    ///
    /// # Errors
    /// [`GeometryError::Singular`] if the determinant is zero, subnormal or not finite.
    pub fn inverse(&self) -> Result<Self, GeometryError> {
        let det = self.determinant();
        let inv = 1.0 / det;
        if !det.is_normal() || !inv.is_finite() {
            return Err(GeometryError::Singular);
        }
        Ok(Self::new(self.d * inv, -self.b * inv, -self.c * inv, self.a * inv))
    }

    /// The image of the unit circle: the singular values and the left singular vector of the
    /// larger one.
    ///
    /// `(major, minor)` are *half*-axes (radii), and the direction's sign is arbitrary. The minor
    /// axis is |det| / major: the quadratic formula for it cancels, and is 40 % off at an axis
    /// ratio of 3000. The direction comes from the half-angle of (p − r, 2q) without
    /// trigonometry, where `[[p, q], [q, r]]` = M·Mᵀ. Only + − × ÷ √ are used, so that every
    /// machine gives the same bits.
    ///
    /// Any finite matrix gives a finite answer as long as the major axis itself is representable;
    /// a matrix with a NaN or an infinity gives infinite axes in the direction (1, 0).
    ///
    /// ```
    /// use scumble_geometry::Matrix2;
    /// let axes = Matrix2::new(0.0, 3.0, 2.0, 0.0).axes();
    /// assert_eq!((axes.major, axes.minor), (3.0, 2.0));
    /// assert_eq!(axes.direction, [1.0, 0.0]);
    /// ```
    #[must_use]
    pub fn axes(&self) -> Axes {
        if !self.is_finite() {
            let major = f64::INFINITY;
            return Axes { major, minor: major, direction: [1.0, 0.0] };
        }
        let scale = self.a.abs().max(self.b.abs()).max(self.c.abs()).max(self.d.abs());
        if scale == 0.0 {
            return Axes { major: 0.0, minor: 0.0, direction: [1.0, 0.0] };
        }
        let (a, b, c, d) = (self.a / scale, self.b / scale, self.c / scale, self.d / scale);
        let p = a * a + b * b;
        let r = c * c + d * d;
        let x = p - r;
        let y = 2.0 * (a * c + b * d);
        let h = sqrt(x * x + y * y);
        // At least √½, because one component is 1: the division is safe.
        let major = sqrt((p + r + h) * 0.5);
        let minor = ((a * d - b * c).abs() / major).min(major);
        Axes { major: major * scale, minor: minor * scale, direction: half_angle(x, y, h) }
    }
}

/// The unit vector at half the angle of (x, y), where h = √(x² + y²).
fn half_angle(x: f64, y: f64, h: f64) -> [f64; 2] {
    // Of the two equivalent forms, the one whose sum does not cancel.
    let (u, v) = if x >= 0.0 { (h + x, y) } else { (y.abs(), (h - x).copysign(y)) };
    let length = sqrt(u * u + v * v);
    if length > 0.0 { [u / length, v / length] } else { [1.0, 0.0] }
}

impl Mul for Matrix2 {
    type Output = Self;

    fn mul(self, rhs: Self) -> Self {
        Self {
            a: self.a * rhs.a + self.b * rhs.c,
            b: self.a * rhs.b + self.b * rhs.d,
            c: self.c * rhs.a + self.d * rhs.c,
            d: self.c * rhs.b + self.d * rhs.d,
        }
    }
}
