//! Exact area of triangles: their winding number is 0 or 1, so signed areas simply add up.

use super::Triangle;
use crate::AreaSink;
use crate::accumulate::{AreaRow, Piece, Slope};
use scumble_geometry::IntRect;

/// Columns of a row's sums: what comfortably stays in the cache.
const ROW_CELLS: i32 = 1 << 15;

/// A side of the triangle that crosses rows.
#[derive(Debug, Clone, Copy)]
struct Side {
    slope: Slope,
    /// Heights in 1/256 pixel, y0 < y1.
    y0: i32,
    y1: i32,
    /// +1 for a left side: what lies right of it is inside.
    weight: i64,
}

impl Triangle {
    /// `region` lies within the bounds and is not empty.
    pub(crate) fn rasterize_area(
        &self,
        region: IntRect,
        scratch: &mut AreaRow,
        sink: &mut impl AreaSink,
    ) {
        let [p, q, r] = self.corners();
        let sides = [(p, q), (q, r), (r, p)].map(|(p, q)| {
            // Clockwise to the eye: left sides run up.
            let (top, bottom, weight) = if p.y > q.y { (q, p, 1) } else { (p, q, -1) };
            let slope = Slope::new(top.x, top.y, bottom.x, bottom.y);
            Side { slope, y0: top.y, y1: bottom.y, weight }
        });
        let mut x = region.x0;
        while x < region.x1 {
            let end = region.x1.min(x + ROW_CELLS);
            scratch.start(x, end);
            for y in region.y0..region.y1 {
                add_row(&sides, y, scratch);
                scratch.sweep(y, sink);
            }
            x = end;
        }
    }
}

fn add_row(sides: &[Side; 3], y: i32, row: &mut AreaRow) {
    let (top, bottom) = (y * 256, y * 256 + 256);
    for side in sides {
        let (from, to) = (side.y0.max(top), side.y1.min(bottom));
        if from < to {
            let (from, to) = (f64::from(from) / 256.0, f64::from(to) / 256.0);
            row.add(&Piece::new(side.slope, from), from, to, side.weight);
        }
    }
}
