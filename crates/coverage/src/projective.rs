use crate::Shape;
use alloc::vec::Vec;
use scumble_geometry::{DVec2, DVec3, FillRule, clip_polygon};

impl Shape {
    /// A convex polygon given by its corners in homogeneous screen coordinates (X, Y, w), before
    /// the division, with what lies nearer to the eye than `w = min_w` clipped away. `None` if
    /// nothing remains of it, if it has no area on the screen, or for a NaN or an infinity.
    ///
    /// ```
    /// use scumble_coverage::Shape;
    /// use scumble_geometry::{DVec3, IntRect};
    ///
    /// // A ground plane that runs on behind the eye.
    /// let corners = [(-9.0, 4.0, 1.0), (9.0, 4.0, 1.0), (0.0, 1.0, -1.0)];
    /// let shape = Shape::projective(&corners.map(DVec3::from), 0.5);
    /// assert_eq!(shape.map(|s| s.bounds()), Some(IntRect::new(-14, 4, 14, 7)));
    /// assert!(Shape::projective(&corners.map(DVec3::from), 2.0).is_none());
    /// ```
    #[must_use]
    pub fn projective(corners: &[DVec3], min_w: f64) -> Option<Self> {
        if let &[a, b, c] = corners
            && corners.iter().all(|c| c.z >= min_w)
        {
            return Self::triangle([a, b, c].map(divide)).ok().flatten();
        }
        let mut clipped = Vec::new();
        clip_polygon(corners, min_w, &mut clipped);
        let points: Vec<DVec2> = clipped.into_iter().map(divide).collect();
        Self::polygon([&points[..]], FillRule::NonZero).ok().flatten()
    }
}

fn divide(p: DVec3) -> DVec2 {
    DVec2::new(p.x / p.z, p.y / p.z)
}
