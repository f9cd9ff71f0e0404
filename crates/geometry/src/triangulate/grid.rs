use crate::DVec2;
use crate::math::floor;
use core::cmp::Ordering;

/// The rasterizer's guard band: ±2²¹ pixels.
pub(super) const GUARD_PX: f64 = (1u32 << 21) as f64;

/// A point in units of 1/256 pixel, within ±2²⁹. Ordered as the sweep goes: from top to bottom,
/// and from left to right on one height.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct GridPoint {
    pub(super) x: i64,
    pub(super) y: i64,
}

impl GridPoint {
    /// The nearest point of the grid; |v| ≤ 2²¹.
    pub(super) fn snap(p: DVec2) -> Self {
        let snap = |v: f64| floor(v * 256.0 + 0.5) as i64;
        Self { x: snap(p.x), y: snap(p.y) }
    }

    pub(super) fn to_pixels(self) -> DVec2 {
        // Exact: below 2³⁰, and a power of two.
        DVec2::new(self.x as f64, self.y as f64) / 256.0
    }
}

impl Ord for GridPoint {
    fn cmp(&self, other: &Self) -> Ordering {
        (self.y, self.x).cmp(&(other.y, other.x))
    }
}

impl PartialOrd for GridPoint {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

/// Twice the signed area of a triangle, exact: differences are at most 2³⁰. Positive if
/// a → b → c turns clockwise to the eye; for b below a, negative if c lies to the right of a → b.
pub(super) fn orient(a: GridPoint, b: GridPoint, c: GridPoint) -> i64 {
    (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x)
}
