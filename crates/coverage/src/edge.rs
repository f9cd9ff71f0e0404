use crate::FixedPoint;
use scumble_geometry::IntRect;

/// The edge function of a directed edge, exact: E(x, y) = a·x + b·y + c in units of 1/256² pixel.
///
/// E ≥ 0 means inside. On the line itself the top-left rule decides: a left edge (interior to the
/// right) and a top edge (level, interior below) own their points, the others do not. That is
/// folded into `c` as −1, which is exact because everything is a whole number. It is the rule of a
/// sample moved by (ε, ε²), the same as that of half-open scanline crossings.
///
/// With coordinates within ±2²⁹, |a|, |b| ≤ 2³⁰ and every value stays below 2⁶².
#[derive(Debug, Clone, Copy)]
pub(crate) struct Edge {
    pub(crate) a: i64,
    pub(crate) b: i64,
    pub(crate) c: i64,
}

impl Edge {
    /// The edge from `p` to `q` of a triangle that goes clockwise to the eye (y down), so that
    /// the interior lies to the right of the direction of travel.
    #[inline(always)]
    pub(crate) fn new(p: FixedPoint, q: FixedPoint) -> Self {
        let a = i64::from(p.y) - i64::from(q.y);
        let b = i64::from(q.x) - i64::from(p.x);
        let owns = a > 0 || (a == 0 && b > 0);
        let c = -(a * i64::from(p.x) + b * i64::from(p.y)) - i64::from(!owns);
        Self { a, b, c }
    }

    /// E at a point in 1/256 pixel.
    #[inline(always)]
    pub(crate) fn at(&self, x: i64, y: i64) -> i64 {
        self.a * x + self.b * y + self.c
    }

    /// The smallest and the largest value over the sample positions that `rect` (not empty) can
    /// hold.
    pub(crate) fn extremes(&self, rect: IntRect) -> (i64, i64) {
        let (x0, x1) = (i64::from(rect.x0) * 256, i64::from(rect.x1) * 256 - 1);
        let (y0, y1) = (i64::from(rect.y0) * 256, i64::from(rect.y1) * 256 - 1);
        let (ax0, ax1) = (self.a * x0, self.a * x1);
        let (by0, by1) = (self.b * y0, self.b * y1);
        (ax0.min(ax1) + by0.min(by1) + self.c, ax0.max(ax1) + by0.max(by1) + self.c)
    }
}
