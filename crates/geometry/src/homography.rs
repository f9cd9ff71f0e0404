use crate::{Affine, DVec2, DVec3, GeometryError, Matrix2};
use core::ops::Mul;

/// A projective map of the plane: a 3×3 matrix by rows, acting on (x, y, 1).
///
/// ```text
/// | m00 m01 m02 |   | x |   | X |
/// | m10 m11 m12 | · | y | = | Y |      (x, y) ↦ (X / w, Y / w)
/// | m20 m21 m22 |   | 1 |   | w |
/// ```
///
/// Points with w ≤ 0 lie behind the eye and have no image. The scale of the matrix is kept as it
/// was made, because the sign of w carries that meaning.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Homography {
    /// The matrix, row by row.
    pub m: [[f64; 3]; 3],
}

impl Homography {
    /// The map that moves nothing.
    pub const IDENTITY: Self = Self::new([[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]]);

    /// The map with the given matrix, row by row.
    #[must_use]
    pub const fn new(m: [[f64; 3]; 3]) -> Self {
        Self { m }
    }

    /// (X, Y, w) before the division.
    #[must_use]
    pub fn project_homogeneous(&self, p: DVec2) -> DVec3 {
        let row = |r: &[f64; 3]| r[0] * p.x + r[1] * p.y + r[2];
        DVec3::new(row(&self.m[0]), row(&self.m[1]), row(&self.m[2]))
    }

    /// The image of a point; `None` behind the eye (w ≤ 0) or where it is not finite.
    #[must_use]
    pub fn project(&self, p: DVec2) -> Option<DVec2> {
        let h = self.project_homogeneous(p);
        let image = DVec2::new(h.x / h.z, h.y / h.z);
        (h.z > 0.0 && image.is_finite()).then_some(image)
    }

    /// The exact Jacobian ∂(x', y')/∂(x, y) at a point; non-finite where w = 0.
    #[must_use]
    pub fn jacobian(&self, p: DVec2) -> Matrix2 {
        let h = self.project_homogeneous(p);
        let (u, v) = (h.x / h.z, h.y / h.z);
        let [r0, r1, r2] = &self.m;
        Matrix2::new(
            (r0[0] - u * r2[0]) / h.z,
            (r0[1] - u * r2[1]) / h.z,
            (r1[0] - v * r2[0]) / h.z,
            (r1[1] - v * r2[1]) / h.z,
        )
    }

    /// Whether w is the same everywhere, so that the map is affine.
    #[must_use]
    pub fn is_affine(&self) -> bool {
        self.m[2][0] == 0.0 && self.m[2][1] == 0.0
    }

    /// The same map as an [`Affine`], if it is one with w > 0.
    #[must_use]
    pub fn to_affine(&self) -> Option<Affine> {
        let w = self.m[2][2];
        if !self.is_affine() || w <= 0.0 {
            return None;
        }
        let [r0, r1, _] = &self.m;
        let affine = Affine::new(r0[0] / w, r1[0] / w, r0[1] / w, r1[1] / w, r0[2] / w, r1[2] / w);
        affine.is_finite().then_some(affine)
    }

    /// The determinant of the matrix.
    #[must_use]
    pub fn determinant(&self) -> f64 {
        let [a, b, c] = &self.m;
        a[0] * (b[1] * c[2] - b[2] * c[1]) - a[1] * (b[0] * c[2] - b[2] * c[0])
            + a[2] * (b[0] * c[1] - b[1] * c[0])
    }
}

impl From<Affine> for Homography {
    fn from(t: Affine) -> Self {
        Self::new([[t.a, t.c, t.e], [t.b, t.d, t.f], [0.0, 0.0, 1.0]])
    }
}

impl Mul for Homography {
    type Output = Self;

    fn mul(self, rhs: Self) -> Self {
        let mut m = [[0.0; 3]; 3];
        for (r, row) in m.iter_mut().enumerate() {
            for (c, out) in row.iter_mut().enumerate() {
                *out = (0..3).map(|k| self.m[r][k] * rhs.m[k][c]).sum();
            }
        }
        Self::new(m)
    }
}
