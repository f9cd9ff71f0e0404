use crate::math::power_of_two_below;
use crate::{Affine, DVec2, DVec3, GeometryError, Interpolator, Matrix2};
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

    /// The map of the unit square onto a quad: (0, 0), (1, 0), (1, 1), (0, 1) go to the four
    /// corners in order. Closed form, Heckbert 1989 §2.2.3. For a parallelogram whose sides are
    /// exact in f64 the last row is exactly (0, 0, 1).
    ///
    /// w is 1 at the first corner and, if the quad is convex, positive in the whole square. For a
    /// concave or self-crossing quad the map exists too, but w = 0 on a line through the square.
    ///
    /// # Errors
    /// [`GeometryError::NotFinite`] for a NaN or infinite corner, [`GeometryError::DegenerateQuad`]
    /// if three corners lie on a line: the height of the triangle that they make, over its longest
    /// side, is at most 16 ε of the largest coordinate. That is a few times the rounding of the
    /// coordinates themselves, so nothing that f64 can tell from a line is refused.
    pub fn unit_square_to_quad(quad: [DVec2; 4]) -> Result<Self, GeometryError> {
        let (local, place) = local_square_to_quad(quad)?;
        let map = Self::from(place) * local;
        if map.is_finite() { Ok(map) } else { Err(GeometryError::DegenerateQuad) }
    }

    /// The map that takes four points to four points: the system of eight unknowns, solved in
    /// closed form by going through the unit square.
    ///
    /// Each quad is moved to its first corner and scaled to unit size on the way, so neither a
    /// large offset nor the units spoil the condition. If both quads are convex, w > 0 on all of
    /// `from`.
    ///
    /// # Errors
    /// As [`Homography::unit_square_to_quad`], for either quad.
    ///
    /// ```
    /// use scumble_geometry::{DVec2, Homography};
    /// let square = [(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0)].map(|(x, y)| DVec2::new(x, y));
    /// let quad = [(10.0, 10.0), (30.0, 10.0), (40.0, 50.0), (0.0, 50.0)].map(|(x, y)| DVec2::new(x, y));
    /// let map = Homography::from_points(square, quad)?;
    /// let bottom_right = map.project(square[2]).ok_or("behind the eye")?;
    /// assert!((bottom_right - quad[2]).length() < 1e-12);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn from_points(from: [DVec2; 4], to: [DVec2; 4]) -> Result<Self, GeometryError> {
        let (from_local, from_place) = local_square_to_quad(from)?;
        let (to_local, to_place) = local_square_to_quad(to)?;
        let back = from_local.inverse().map_err(|_| GeometryError::DegenerateQuad)?
            * Self::from(from_place.inverse().map_err(|_| GeometryError::DegenerateQuad)?);
        let map = Self::from(to_place) * to_local * back;
        if map.is_finite() { Ok(map) } else { Err(GeometryError::DegenerateQuad) }
    }

    /// The exact perspective-correct map from the screen to an attribute such as (u, v).
    ///
    /// `positions` are the vertices in homogeneous screen coordinates (X, Y, w), before the
    /// division, and `values` the attribute at each. The result takes (x, y) on the screen to the
    /// attribute there, because value/w and 1/w are affine on the screen; its own w is 1/w of the
    /// point of the triangle's plane, so it is positive exactly where that point is in front of
    /// the eye. Vertices with w ≤ 0 are allowed. If the three w are equal and positive, the map
    /// is affine and its last row exactly (0, 0, 1).
    ///
    /// # Errors
    /// [`GeometryError::NotFinite`] for a NaN or infinite vertex, [`GeometryError::Singular`] if
    /// the triangle has no area on the screen or the result is not finite.
    ///
    /// ```
    /// use scumble_geometry::{DVec2, DVec3, Homography};
    /// // A road: its far end (w = 4) lies higher up on the screen than its near end.
    /// let road = [DVec3::new(0.0, 100.0, 1.0), DVec3::new(100.0, 100.0, 1.0), DVec3::new(200.0, 40.0, 4.0)];
    /// let uv = [DVec2::new(0.0, 0.0), DVec2::new(1.0, 0.0), DVec2::new(0.5, 1.0)];
    /// let map = Homography::from_triangle(road, uv)?;
    /// // Half-way up the screen between v = 0 (y = 100) and v = 1 (y = 10) is only 1/5 of the way.
    /// let v = map.project(DVec2::new(50.0, 55.0)).ok_or("behind the eye")?.y;
    /// assert!((v - 0.2).abs() < 1e-12);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn from_triangle(positions: [DVec3; 3], values: [DVec2; 3]) -> Result<Self, GeometryError> {
        let map = Interpolator::new(positions)?.to_homography(values);
        if map.is_finite() { Ok(map) } else { Err(GeometryError::Singular) }
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

    /// The map back: the true inverse matrix, adjugate over determinant.
    ///
    /// Its scale is kept as well: where this map sends p to q with some w, the inverse sends q to
    /// p with 1/w. So what lies in front of the eye comes back with w > 0.
    ///
    /// # Errors
    /// [`GeometryError::Singular`] if the determinant is zero or a number of the result is not
    /// finite.
    ///
    /// ```
    /// use scumble_geometry::{DVec2, Homography};
    /// let map = Homography::new([[2.0, 0.0, 1.0], [0.0, 2.0, 0.0], [0.0, 0.5, 1.0]]);
    /// let q = map.project(DVec2::new(3.0, 4.0)).ok_or("behind the eye")?;
    /// let p = map.inverse()?.project(q).ok_or("behind the eye")?;
    /// assert!((p - DVec2::new(3.0, 4.0)).length() < 1e-12);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn inverse(&self) -> Result<Self, GeometryError> {
        // Scaled to unit size first, so that neither the determinant nor its parts leave the
        // range of f64; by a power of two, which is exact.
        let largest = self.m.iter().flatten().fold(0.0f64, |max, v| max.max(v.abs()));
        if !(largest.is_normal() && self.is_finite()) {
            return Err(GeometryError::Singular);
        }
        let largest = power_of_two_below(largest);
        let [r0, r1, r2] = self.m.map(|row| DVec3::from(row) / largest);
        let columns = [r1.cross(r2), r2.cross(r0), r0.cross(r1)];
        let det = r0.dot(columns[0]);
        let column = |c: DVec3| c / det / largest;
        let [c0, c1, c2] = columns.map(column);
        let inverse = Self::new([[c0.x, c1.x, c2.x], [c0.y, c1.y, c2.y], [c0.z, c1.z, c2.z]]);
        if inverse.is_finite() { Ok(inverse) } else { Err(GeometryError::Singular) }
    }

    /// Whether all nine numbers are finite.
    #[must_use]
    pub fn is_finite(&self) -> bool {
        self.m.iter().flatten().all(|v| v.is_finite())
    }

    /// The least w at which geometry should be kept when it is projected by this map: 2⁻²⁰ of the
    /// largest coefficient of w.
    ///
    /// Depends on the map alone, so that neighbouring shapes under the same map are clipped along
    /// the same line; and scales with the matrix, so that the same map always clips alike. For an
    /// affine map with w > 0 it clips nothing.
    #[must_use]
    pub fn near_w(&self) -> f64 {
        let [a, b, c] = self.m[2];
        a.abs().max(b.abs()).max(c.abs()) / f64::from(1u32 << 20)
    }

    /// The determinant of the matrix.
    #[must_use]
    pub fn determinant(&self) -> f64 {
        let [a, b, c] = &self.m;
        a[0] * (b[1] * c[2] - b[2] * c[1]) - a[1] * (b[0] * c[2] - b[2] * c[0])
            + a[2] * (b[0] * c[1] - b[1] * c[0])
    }
}

/// The map of the unit square onto the quad moved to the origin and scaled to unit size, and the
/// affine map that puts that back in its place.
fn local_square_to_quad(quad: [DVec2; 4]) -> Result<(Homography, Affine), GeometryError> {
    check_quad(&quad)?;
    let origin = quad[0];
    let offsets = quad.map(|p| p - origin);
    let size = offsets.iter().fold(0.0f64, |max, d| max.max(d.abs().max_element()));
    if !(size.is_normal() && size.is_finite()) {
        return Err(GeometryError::DegenerateQuad);
    }
    // A power of two, so that the scaling does not round.
    let size = power_of_two_below(size);
    let [_, p1, p2, p3] = offsets.map(|d| d / size);
    // p0 is the origin from here on.
    let sum = p2 - p1 - p3;
    let (d1, d2) = (p1 - p2, p3 - p2);
    let det = d1.perp_dot(d2);
    let g = sum.perp_dot(d2) / det;
    let h = d1.perp_dot(sum) / det;
    let (a, b) = (p1 * (1.0 + g), p3 * (1.0 + h));
    let map = Homography::new([[a.x, b.x, 0.0], [a.y, b.y, 0.0], [g, h, 1.0]]);
    if !map.is_finite() {
        return Err(GeometryError::DegenerateQuad);
    }
    Ok((map, Affine::new(size, 0.0, 0.0, size, origin.x, origin.y)))
}

/// Refuses quads with a corner that is not finite or with three corners on a line.
pub(crate) fn check_quad(quad: &[DVec2; 4]) -> Result<(), GeometryError> {
    if let Some(&p) = quad.iter().find(|p| !p.is_finite()) {
        return Err(GeometryError::NotFinite(p));
    }
    let largest = quad.iter().fold(0.0f64, |max, p| max.max(p.abs().max_element()));
    for skip in 0..4 {
        let [a, b, c] = [1, 2, 3].map(|k| quad[(skip + k) % 4]);
        // Divided by the largest coordinate first, so that the products stay in range.
        let (ab, ac, bc) = ((b - a) / largest, (c - a) / largest, (c - b) / largest);
        let longest = ab.length().max(ac.length()).max(bc.length());
        let area = ab.perp_dot(ac).abs();
        // Four equal corners at the origin give NaN here.
        if area.is_nan() || area <= 16.0 * f64::EPSILON * longest {
            return Err(GeometryError::DegenerateQuad);
        }
    }
    Ok(())
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
