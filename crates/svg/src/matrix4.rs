use crate::trig::{sin_cos_degrees, tan_degrees};
use core::ops::Mul;
use scumble_geometry::{Affine, Homography};

/// A 4×4 matrix by rows, acting on columns (x, y, z, 1): what CSS composes a `transform` list as.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Matrix4(pub(crate) [[f64; 4]; 4]);

impl Matrix4 {
    pub(crate) const IDENTITY: Self = Self([
        [1.0, 0.0, 0.0, 0.0],
        [0.0, 1.0, 0.0, 0.0],
        [0.0, 0.0, 1.0, 0.0],
        [0.0, 0.0, 0.0, 1.0],
    ]);

    /// CSS `matrix3d`: sixteen numbers, column by column.
    pub(crate) fn from_columns(n: &[f64; 16]) -> Self {
        Self(core::array::from_fn(|r| core::array::from_fn(|c| n[c * 4 + r])))
    }

    pub(crate) fn translate(x: f64, y: f64, z: f64) -> Self {
        let mut m = Self::IDENTITY;
        (m.0[0][3], m.0[1][3], m.0[2][3]) = (x, y, z);
        m
    }

    pub(crate) fn scale(x: f64, y: f64, z: f64) -> Self {
        let mut m = Self::IDENTITY;
        (m.0[0][0], m.0[1][1], m.0[2][2]) = (x, y, z);
        m
    }

    /// Moves the eye to z = `distance`; nearer than 1 counts as 1, as in CSS.
    pub(crate) fn perspective(distance: f64) -> Self {
        let mut m = Self::IDENTITY;
        m.0[3][2] = -1.0 / distance.max(1.0);
        m
    }

    /// Turns about the axis (x, y, z), clockwise when looking along it. No axis, no turn.
    pub(crate) fn rotate(x: f64, y: f64, z: f64, degrees: f64) -> Self {
        let length = (x * x + y * y + z * z).sqrt();
        if !(length > 0.0 && length.is_finite()) {
            return Self::IDENTITY;
        }
        let (x, y, z) = (x / length, y / length, z / length);
        let (s, c) = sin_cos_degrees(degrees);
        let k = 1.0 - c;
        let mut m = Self::IDENTITY;
        m.0[0][..3].copy_from_slice(&[x * x * k + c, x * y * k - z * s, x * z * k + y * s]);
        m.0[1][..3].copy_from_slice(&[x * y * k + z * s, y * y * k + c, y * z * k - x * s]);
        m.0[2][..3].copy_from_slice(&[x * z * k - y * s, y * z * k + x * s, z * z * k + c]);
        m
    }

    pub(crate) fn skew(x_degrees: f64, y_degrees: f64) -> Self {
        let mut m = Self::IDENTITY;
        (m.0[0][1], m.0[1][0]) = (tan_degrees(x_degrees), tan_degrees(y_degrees));
        m
    }

    /// What the matrix does to the plane z = 0, seen along z.
    pub(crate) fn restrict(&self) -> Homography {
        let row = |r: [f64; 4]| [r[0], r[1], r[3]];
        Homography::new([row(self.0[0]), row(self.0[1]), row(self.0[3])])
    }
}

impl From<Affine> for Matrix4 {
    fn from(t: Affine) -> Self {
        let mut m = Self::IDENTITY;
        (m.0[0][0], m.0[0][1], m.0[0][3]) = (t.a, t.c, t.e);
        (m.0[1][0], m.0[1][1], m.0[1][3]) = (t.b, t.d, t.f);
        m
    }
}

impl Mul for Matrix4 {
    type Output = Self;

    fn mul(self, rhs: Self) -> Self {
        let dot = |r: usize, c: usize| {
            let [a, b, d, e] = self.0[r];
            a * rhs.0[0][c] + b * rhs.0[1][c] + d * rhs.0[2][c] + e * rhs.0[3][c]
        };
        Self(core::array::from_fn(|r| core::array::from_fn(|c| dot(r, c))))
    }
}
