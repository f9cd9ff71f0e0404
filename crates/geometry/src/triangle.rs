use crate::{DVec2, GeometryError, Rect};

/// A triangle in the plane, of either winding.
///
/// Edge i is the one opposite vertex i, from vertex i+1 to vertex i+2 (indices modulo 3).
///
/// ```
/// use scumble_geometry::{DVec2, Triangle};
/// let triangle = Triangle::new([DVec2::new(0.0, 0.0), DVec2::new(4.0, 0.0), DVec2::new(0.0, 4.0)]);
/// assert_eq!(triangle.signed_area(), 8.0);
/// assert_eq!(triangle.barycentrics(DVec2::new(1.0, 2.0))?, [0.25, 0.25, 0.5]);
/// # Ok::<(), scumble_geometry::GeometryError>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Triangle {
    /// The three corners.
    pub vertices: [DVec2; 3],
}

impl Triangle {
    /// The triangle with the given corners.
    #[must_use]
    pub const fn new(vertices: [DVec2; 3]) -> Self {
        Self { vertices }
    }

    /// The area; positive if the corners turn clockwise to the eye (y down).
    #[must_use]
    pub fn signed_area(&self) -> f64 {
        let [a, b, c] = self.vertices;
        (b - a).perp_dot(c - a) * 0.5
    }

    /// The three edge functions.
    #[must_use]
    pub fn edges(&self) -> [EdgeFunction; 3] {
        let [a, b, c] = self.vertices;
        [EdgeFunction::new(b, c), EdgeFunction::new(c, a), EdgeFunction::new(a, b)]
    }

    /// Whether a point is in the triangle, its outline included; either winding. Never in a
    /// triangle without area, nor in one with a NaN. Rounding decides close to an edge; a rasterizer
    /// that must give every point to exactly one of two neighbours snaps to a grid first.
    #[must_use]
    pub fn contains(&self, p: DVec2) -> bool {
        let area = self.signed_area();
        let inside = |e: EdgeFunction| e.at(p) * area >= 0.0;
        area != 0.0 && self.edges().into_iter().all(inside)
    }

    /// Barycentric coordinates as ratios of areas: coordinate i is the area of the triangle of
    /// the point and edge i, over the whole. They sum to one up to rounding, and are exactly
    /// 1, 0, 0 at a vertex; outside some are negative.
    ///
    /// # Errors
    /// [`GeometryError::Singular`] if the triangle has no area or the result is not finite.
    pub fn barycentrics(&self, p: DVec2) -> Result<[f64; 3], GeometryError> {
        let [a, b, c] = self.vertices;
        let (ab, ac, ap) = (b - a, c - a, p - a);
        // In this form the corners come out exactly, and so does the sum up to one rounding.
        let whole = ab.perp_dot(ac);
        let (b1, b2) = (ap.perp_dot(ac) / whole, ab.perp_dot(ap) / whole);
        finite([1.0 - b1 - b2, b1, b2])
    }

    /// The same coordinates as ratios of distances: coordinate i is the signed distance of the
    /// point from the line of edge i, over that of vertex i.
    ///
    /// # Errors
    /// As [`Triangle::barycentrics`].
    pub fn barycentrics_by_distance(&self, p: DVec2) -> Result<[f64; 3], GeometryError> {
        let edges = self.edges();
        let ratio = |i: usize| edges[i].distance(p) / edges[i].distance(self.vertices[i]);
        finite([ratio(0), ratio(1), ratio(2)])
    }

    /// The smallest rectangle around it; `None` if a coordinate is NaN.
    #[must_use]
    pub fn bounds(&self) -> Option<Rect> {
        Rect::bounding(self.vertices)
    }
}

fn finite(b: [f64; 3]) -> Result<[f64; 3], GeometryError> {
    if b.iter().all(|v| v.is_finite()) { Ok(b) } else { Err(GeometryError::Singular) }
}

/// The directed line through two points as a function of the plane: a·(x − x₀) + b·(y − y₀), where
/// (x₀, y₀) is the first point.
///
/// It is 0 on the line, positive to the right of the direction of travel as the eye sees it (y
/// down), and there it is twice the area of the triangle of the two points and (x, y). Counted
/// from its own first point, it loses nothing to cancellation far from the origin. Pineda 1988.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct EdgeFunction {
    /// The first point.
    pub origin: DVec2,
    /// (a, b): the line's normal, as long as the two points are apart; what the function grows by
    /// per step of x and of y.
    pub normal: DVec2,
}

impl EdgeFunction {
    /// The edge from one point to another.
    #[must_use]
    pub fn new(from: DVec2, to: DVec2) -> Self {
        Self { origin: from, normal: (to - from).perp() }
    }

    /// The value at a point.
    #[must_use]
    pub fn at(&self, p: DVec2) -> f64 {
        self.normal.dot(p - self.origin)
    }

    /// The signed distance of a point from the line, positive where the function is; NaN for an
    /// edge without length.
    #[must_use]
    pub fn distance(&self, p: DVec2) -> f64 {
        self.at(p) / self.normal.length()
    }
}
