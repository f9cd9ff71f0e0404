//! Triangles: three corners, clockwise to the eye.

mod area;
mod narrow;
mod spans;
mod squares;
mod tiled;
mod wide;

pub(crate) use tiled::TriangleScratch;

use crate::edge::Edge;
use crate::{Cover, FixedPoint};
use scumble_geometry::{DVec2, IntRect};

/// A triangle with area, snapped, clockwise to the eye.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Triangle {
    corners: [FixedPoint; 3],
}

impl Triangle {
    /// The corners on the grid, if all lie inside the guard band.
    pub(crate) fn snap(p: [DVec2; 3]) -> Option<[FixedPoint; 3]> {
        Some([FixedPoint::snap(p[0])?, FixedPoint::snap(p[1])?, FixedPoint::snap(p[2])?])
    }

    /// Turns the corners clockwise; `None` without area.
    pub(crate) fn new([p, q, r]: [FixedPoint; 3]) -> Option<Self> {
        let (px, py) = (i64::from(p.x), i64::from(p.y));
        let twice_area = (i64::from(q.x) - px) * (i64::from(r.y) - py)
            - (i64::from(q.y) - py) * (i64::from(r.x) - px);
        match twice_area {
            0 => None,
            1.. => Some(Self { corners: [p, q, r] }),
            _ => Some(Self { corners: [p, r, q] }),
        }
    }

    pub(crate) fn corners(&self) -> [FixedPoint; 3] {
        self.corners
    }

    #[inline(always)]
    pub(crate) fn edges(&self) -> [Edge; 3] {
        let [p, q, r] = self.corners;
        [Edge::new(p, q), Edge::new(q, r), Edge::new(r, p)]
    }

    pub(crate) fn bounds(&self) -> IntRect {
        let [p, q, r] = self.corners;
        let (x0, x1) = (p.x.min(q.x).min(r.x), p.x.max(q.x).max(r.x));
        let (y0, y1) = (p.y.min(q.y).min(r.y), p.y.max(q.y).max(r.y));
        owning_pixels(x0, y0, x1, y1)
    }

    /// `rect` lies within the bounds and is not empty.
    pub(crate) fn covers(&self, rect: IntRect) -> Cover {
        let mut full = true;
        for edge in self.edges() {
            let (low, high) = edge.extremes(rect);
            if high < 0 {
                return Cover::None;
            }
            full &= low >= 0;
        }
        if full { Cover::Full } else { Cover::Partial }
    }
}

/// The pixels that can own a sample of a shape that spans the given coordinates. The right and
/// bottom borders are not owned.
pub(crate) fn owning_pixels(x0: i32, y0: i32, x1: i32, y1: i32) -> IntRect {
    IntRect::new(x0 >> 8, y0 >> 8, ((x1 - 1) >> 8) + 1, ((y1 - 1) >> 8) + 1)
}
