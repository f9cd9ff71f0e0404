use crate::{DVec2, DVec3, GeometryError, Homography};

/// Perspective-correct barycentric coordinates of a projected triangle.
///
/// With P the matrix whose columns are the vertices (Xᵢ, Yᵢ, wᵢ), the screen point (x, y, 1) is
/// P·b for some b = P⁻¹·(x, y, 1); the barycentrics of the point of the triangle seen there are
/// βᵢ = bᵢ / Σb. Nothing in that asks for w > 0 at the vertices: a triangle that reaches behind
/// the eye is interpolated right wherever it is visible. Σb is 1/w of that point.
///
/// ```
/// use scumble_geometry::{DVec2, DVec3, Interpolator};
/// // The far end of an edge has w = 3.
/// let triangle = [DVec3::new(0.0, 0.0, 1.0), DVec3::new(30.0, 0.0, 3.0), DVec3::new(0.0, 10.0, 1.0)];
/// let interpolator = Interpolator::new(triangle)?;
/// // The middle of the edge on the screen is a quarter of its way in space.
/// let [b0, b1, b2] = interpolator.barycentrics(DVec2::new(5.0, 0.0));
/// assert!((b0 - 0.75).abs() < 1e-12 && (b1 - 0.25).abs() < 1e-12 && b2.abs() < 1e-12);
/// # Ok::<(), scumble_geometry::GeometryError>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Interpolator {
    /// bᵢ as an affine function of the screen: (∂/∂x, ∂/∂y, value at `origin`).
    rows: [DVec3; 3],
    /// Σb likewise; exactly (0, 0, 1) for an affine triangle.
    sum: DVec3,
    /// Screen position from which `rows` count; near the triangle, so that little cancels.
    origin: DVec2,
}

impl Interpolator {
    /// Prepares a triangle given by its vertices in homogeneous screen coordinates (X, Y, w),
    /// before the division. For a triangle without perspective, w = 1.
    ///
    /// # Errors
    /// [`GeometryError::NotFinite`] for a NaN or infinite number, [`GeometryError::Singular`] if
    /// the triangle has no area on the screen (among them every triangle seen edge-on).
    pub fn new(positions: [DVec3; 3]) -> Result<Self, GeometryError> {
        if let Some(p) = positions.iter().find(|p| !p.is_finite()) {
            return Err(GeometryError::NotFinite(p.truncate()));
        }
        // Of the vertices the one with the largest |w|: the others may lie far off the screen.
        let nearer = |a: DVec3, b: DVec3| if b.z.abs() > a.z.abs() { b } else { a };
        let anchor = nearer(nearer(positions[0], positions[1]), positions[2]);
        let origin = anchor.truncate() / anchor.z;
        if !origin.is_finite() {
            return Err(GeometryError::Singular);
        }
        let w = positions[0].z;
        let affine = w > 0.0 && positions.iter().all(|p| p.z == w);
        let rows = if affine {
            let [_, p, q] = positions.map(|p| p.truncate() / w - origin);
            affine_rows(p, q)
        } else {
            inverse_rows(positions.map(|p| (p.truncate() - origin * p.z).extend(p.z)))
        };
        let rows = rows.ok_or(GeometryError::Singular)?;
        let sum = if affine { DVec3::Z } else { rows[0] + rows[1] + rows[2] };
        Ok(Self { rows, sum, origin })
    }

    /// The barycentrics at a screen point; they sum to one. Outside the triangle some are
    /// negative. Non-finite on the triangle's horizon (where 1/w = 0).
    #[must_use]
    pub fn barycentrics(&self, p: DVec2) -> [f64; 3] {
        let q = (p - self.origin).extend(1.0);
        let b = self.rows.map(|row| row.dot(q));
        if self.is_affine() {
            return b;
        }
        let sum = b[0] + b[1] + b[2];
        b.map(|v| v / sum)
    }

    /// 1/w of the point of the triangle's plane that is seen at a screen point: positive in front
    /// of the eye. For an affine triangle it is 1 everywhere, whatever its w.
    #[must_use]
    pub fn inverse_w(&self, p: DVec2) -> f64 {
        self.sum.dot((p - self.origin).extend(1.0))
    }

    /// Whether w is the same at all vertices, so that the barycentrics are affine on the screen.
    #[must_use]
    pub fn is_affine(&self) -> bool {
        self.sum == DVec3::Z
    }

    /// An attribute of N numbers, such as a colour, at a screen point. Where it is the same at
    /// all vertices it comes out exactly.
    #[must_use]
    pub fn interpolate<const N: usize>(&self, p: DVec2, values: &[[f64; N]; 3]) -> [f64; N] {
        let [_, b1, b2] = self.barycentrics(p);
        let [v0, v1, v2] = values;
        core::array::from_fn(|i| v0[i] + b1 * (v1[i] - v0[i]) + b2 * (v2[i] - v0[i]))
    }

    /// The map from the screen to a two-dimensional attribute; see [`Homography::from_triangle`].
    /// Its numbers may overflow for huge `values`.
    #[must_use]
    pub fn to_homography(&self, values: [DVec2; 3]) -> Homography {
        let [_, r1, r2] = &self.rows;
        // Relative to the first value, v0 + Σ βᵢ (vᵢ − v0), so that the rounding is that of the
        // differences.
        let (d1, d2) = (values[1] - values[0], values[2] - values[0]);
        let u = *r1 * d1.x + *r2 * d2.x + self.sum * values[0].x;
        let v = *r1 * d1.y + *r2 * d2.y + self.sum * values[0].y;
        let at_origin = |r: DVec3| [r.x, r.y, r.z - r.x * self.origin.x - r.y * self.origin.y];
        Homography::new([at_origin(u), at_origin(v), at_origin(self.sum)])
    }
}

/// The rows of the inverse of the matrix with the given columns; `None` if it is singular.
fn inverse_rows(columns: [DVec3; 3]) -> Option<[DVec3; 3]> {
    let size = columns.iter().fold(0.0f64, |max, c| max.max(c.truncate().abs().max_element()));
    let depth = columns.iter().fold(0.0f64, |max, c| max.max(c.z.abs()));
    // x and y in units of the triangle's size, w in units of the largest w.
    let units = DVec3::new(size, size, depth);
    let [c0, c1, c2] = columns.map(|c| c / units);
    let cross = [c1.cross(c2), c2.cross(c0), c0.cross(c1)];
    let det = c0.dot(cross[0]);
    let rows = cross.map(|row| row / det / units);
    (det != 0.0 && rows.iter().all(|r| r.is_finite())).then_some(rows)
}

/// [`inverse_rows`] of (0, 0, 1), (p, 1) and (q, 1): the numbers that come of it, without what is
/// multiplied by 0 and by 1.
fn affine_rows(p: DVec2, q: DVec2) -> Option<[DVec3; 3]> {
    let size = p.abs().max(q.abs()).max_element();
    let (p, q) = (p / size, q / size);
    let det = p.x * q.y - q.x * p.y;
    let row = |v: DVec2, z: f64| (v / det / size).extend(z);
    let edge = q - p;
    let rows = [row(DVec2::new(-edge.y, edge.x), 1.0), row(-q.perp(), 0.0), row(p.perp(), 0.0)];
    (det != 0.0 && rows.iter().all(|r| r.is_finite())).then_some(rows)
}
