use crate::FixedPoint;
use scumble_geometry::DVec2;

/// The barycentric coordinates over a triangle: how much of each corner a point is.
///
/// They are the edge functions of the snapped triangle divided by its doubled area. The edge
/// functions are whole numbers that are carried from pixel to pixel without error, so a value does
/// not depend on where a run began, and each coordinate has a relative error below 2⁻⁵¹. Outside the
/// triangle (as the centre of a pixel on an edge may be) they extrapolate.
///
/// The corners keep the order in which they were given, whatever the winding.
#[derive(Debug, Clone, Copy)]
pub struct Barycentric {
    /// Per corner: a, b, c of the opposite edge's a·x + b·y + c in 1/256 pixel, positive inside.
    edges: [[i64; 3]; 3],
    /// 1 / doubled area.
    scale: f64,
}

impl Barycentric {
    /// `None` without area once snapped, or for a corner that is not finite or lies beyond ±2²¹
    /// pixels.
    #[must_use]
    pub fn new(corners: [DVec2; 3]) -> Option<Self> {
        let [p, q, r] = corners.map(FixedPoint::snap);
        let (p, q, r) = (p?, q?, r?);
        let opposite = |q: FixedPoint, r: FixedPoint| {
            let a = i64::from(q.y) - i64::from(r.y);
            let b = i64::from(r.x) - i64::from(q.x);
            [a, b, -(a * i64::from(q.x) + b * i64::from(q.y))]
        };
        let mut edges = [opposite(q, r), opposite(r, p), opposite(p, q)];
        let [a, b, c] = edges[0];
        let doubled = a * i64::from(p.x) + b * i64::from(p.y) + c;
        if doubled == 0 {
            return None;
        }
        if doubled < 0 {
            edges = edges.map(|e| e.map(|v| -v));
        }
        Some(Self { edges, scale: 1.0 / doubled.abs() as f64 })
    }

    /// The coordinates at `offset` (in 1/256 pixel; the centre is `[128, 128]`) from the corner of
    /// pixel (x, y), which must lie within ±2²¹. They sum to 1 but for rounding.
    #[must_use]
    pub fn at(&self, x: i32, y: i32, offset: [u8; 2]) -> [f64; 3] {
        self.scaled(self.edges_at(x, y, offset))
    }

    /// The coordinates of pixel (x, y) and of those right of it, without end.
    #[must_use]
    pub fn row(&self, x: i32, y: i32, offset: [u8; 2]) -> BarycentricRow<'_> {
        BarycentricRow { of: self, values: self.edges_at(x, y, offset) }
    }

    fn edges_at(&self, x: i32, y: i32, offset: [u8; 2]) -> [i64; 3] {
        let at = |pixel: i32, offset: u8| i64::from(pixel) * 256 + i64::from(offset);
        let (x, y) = (at(x, offset[0]), at(y, offset[1]));
        // Wrapping: far outside the range that is promised, nonsense rather than a panic.
        self.edges
            .map(|[a, b, c]| a.wrapping_mul(x).wrapping_add(b.wrapping_mul(y)).wrapping_add(c))
    }

    fn scaled(&self, values: [i64; 3]) -> [f64; 3] {
        values.map(|v| v as f64 * self.scale)
    }
}

/// [`Barycentric`] coordinates along a row, pixel by pixel.
#[derive(Debug, Clone)]
pub struct BarycentricRow<'a> {
    of: &'a Barycentric,
    values: [i64; 3],
}

impl Iterator for BarycentricRow<'_> {
    type Item = [f64; 3];

    fn next(&mut self) -> Option<[f64; 3]> {
        let now = self.of.scaled(self.values);
        for (v, edge) in self.values.iter_mut().zip(&self.of.edges) {
            *v = v.wrapping_add(edge[0].wrapping_mul(256));
        }
        Some(now)
    }
}

/// Perspective-correct weights over a triangle whose corners were divided by w.
///
/// What is linear in space is not linear on the screen, but it is after a division by w, and so is
/// 1/w itself (Blinn, "Hyperbolic Interpolation", 1992).
#[derive(Debug, Clone, Copy)]
pub struct Perspective {
    screen: Barycentric,
    inverse_w: [f64; 3],
}

/// What [`Perspective`] tells of one point.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PerspectiveWeights {
    /// How much of each corner's attributes the point has; they sum to 1 but for rounding.
    pub weights: [f64; 3],
    /// 1/w of the point. Where it is not positive (possible outside the triangle), the point lies
    /// behind the eye.
    pub inverse_w: f64,
}

impl Perspective {
    /// The corners on the screen and the w that each was divided by. `None` as
    /// [`Barycentric::new`] says, or unless every w is positive and finite.
    #[must_use]
    pub fn new(corners: [DVec2; 3], w: [f64; 3]) -> Option<Self> {
        let inverse_w = w.map(|w| 1.0 / w);
        if !inverse_w.iter().all(|v| *v > 0.0 && v.is_finite()) {
            return None;
        }
        Some(Self { screen: Barycentric::new(corners)?, inverse_w })
    }

    /// The weights at `offset` from the corner of pixel (x, y): see [`Barycentric::at`].
    #[must_use]
    pub fn at(&self, x: i32, y: i32, offset: [u8; 2]) -> PerspectiveWeights {
        self.divided(self.screen.at(x, y, offset))
    }

    /// The weights of pixel (x, y) and of those right of it, without end.
    pub fn row(
        &self,
        x: i32,
        y: i32,
        offset: [u8; 2],
    ) -> impl Iterator<Item = PerspectiveWeights> + '_ {
        self.screen.row(x, y, offset).map(|screen| self.divided(screen))
    }

    fn divided(&self, screen: [f64; 3]) -> PerspectiveWeights {
        let [p, q, r] = self.inverse_w;
        let parts = [screen[0] * p, screen[1] * q, screen[2] * r];
        let inverse_w = parts[0] + parts[1] + parts[2];
        PerspectiveWeights { weights: parts.map(|v| v / inverse_w), inverse_w }
    }
}
