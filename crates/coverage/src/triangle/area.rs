//! Exact area of triangles: their winding number is 0 or 1, so signed areas simply add up.

use super::Triangle;
use crate::AreaSink;
use crate::area::{AreaRow, CHUNK, ROW_CELLS, Reach, Slope, eight_parts};
use fearless_simd::{Level, Simd, dispatch, f64x8, prelude::*};
use scumble_geometry::IntRect;

/// Rows whose crossings are found side by side.
const BAND: usize = 8;

const STEPS: [f64; 8] = [0.0, 1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0];

/// A side of the triangle that crosses rows.
#[derive(Debug, Clone, Copy)]
struct Side {
    slope: Slope,
    /// The heights of its ends in pixels.
    top: f64,
    bottom: f64,
    /// +1 for a left side: what lies right of it is inside.
    weight: f64,
}

/// Where a side meets each row of a band: [`Reach`] eight times over.
#[derive(Debug, Clone, Copy)]
struct Reaches {
    from: [f64; BAND],
    to: [f64; BAND],
    /// 0 in a row that the side does not meet.
    height: [f64; BAND],
}

impl Triangle {
    /// `region` lies within the bounds and is not empty.
    #[inline]
    pub(crate) fn rasterize_area(
        &self,
        region: IntRect,
        level: Level,
        scratch: &mut AreaRow,
        sink: &mut impl AreaSink,
    ) {
        dispatch!(level, simd => self.rasterize_area_at(simd, region, scratch, sink));
    }

    #[inline(always)]
    fn rasterize_area_at<S: Simd>(
        &self,
        simd: S,
        region: IntRect,
        scratch: &mut AreaRow,
        sink: &mut impl AreaSink,
    ) {
        let sides = self.sides();
        if region.x1 - region.x0 <= CHUNK {
            for y in (region.y0..region.y1).step_by(BAND) {
                narrow_band(simd, &sides, IntRect { y0: y, ..region }, sink);
            }
            return;
        }
        let mut x = region.x0;
        while x < region.x1 {
            let end = region.x1.min(x.saturating_add(ROW_CELLS));
            scratch.start(x, end);
            for y in (region.y0..region.y1).step_by(BAND) {
                wide_band(simd, &sides, IntRect { x0: x, x1: end, y0: y, ..region }, scratch, sink);
            }
            x = end;
        }
    }

    #[inline(always)]
    fn sides(&self) -> [Side; 3] {
        let [p, q, r] = self.corners();
        [(p, q), (q, r), (r, p)].map(|(p, q)| {
            // Clockwise to the eye: left sides run up. A level side has no height to add.
            let up = p.y > q.y;
            let (top, bottom) = if up { (q, p) } else { (p, q) };
            let slope = if top.y < bottom.y {
                Slope::new(top.x, top.y, bottom.x, bottom.y)
            } else {
                Slope { mirrored: false, x0: 0.0, y0: 0.0, run: 0.0, half_rise: 0.0 }
            };
            Side {
                slope,
                top: f64::from(top.y) * (1.0 / 256.0),
                bottom: f64::from(bottom.y) * (1.0 / 256.0),
                weight: if up { 1.0 } else { -1.0 },
            }
        })
    }
}

impl Side {
    /// Where the side meets the rows from `y` on.
    #[inline(always)]
    fn reaches<S: Simd>(&self, simd: S, y: i32) -> Reaches {
        let splat = |v: f64| f64x8::splat(simd, v);
        let Slope { x0, y0, run, .. } = self.slope;
        let row = f64x8::from_slice(simd, &STEPS) + splat(f64::from(y));
        let held = |y: f64x8<S>| y.max(splat(self.top)).min(splat(self.bottom));
        let (start, end) = (held(row), held(row + splat(1.0)));
        let along = |y: f64x8<S>| splat(x0) + (y - splat(y0)) * splat(run);
        let mut out = Reaches { from: [0.0; BAND], to: [0.0; BAND], height: [0.0; BAND] };
        along(start).store_slice(&mut out.from);
        along(end).store_slice(&mut out.to);
        (end - start).store_slice(&mut out.height);
        out
    }
}

/// Up to eight rows of up to eight pixels: all sides over all pixels of a row at once.
#[inline(always)]
fn narrow_band<S: Simd>(simd: S, sides: &[Side; 3], rect: IntRect, sink: &mut impl AreaSink) {
    let splat = |v: f64| f64x8::splat(simd, v);
    let reaches = [0, 1, 2].map(|k: usize| sides[k].reaches(simd, rect.y0));
    let columns = f64x8::from_slice(simd, &STEPS) + splat(f64::from(rect.x0));
    let mirrored = splat(-1.0) - columns;
    // What is left behind in the mirror lies left of the side: the rest is right of it.
    let sign = sides.map(|s| if s.slope.mirrored { -s.weight } else { s.weight });
    let all = sides.map(|s| if s.slope.mirrored { s.weight } else { 0.0 });
    let width = (rect.x1 - rect.x0) as usize;
    for (i, y) in (rect.y0..rect.y1).enumerate().take(BAND) {
        let mut sum = splat(0.0);
        for (k, (side, reach)) in sides.iter().zip(&reaches).enumerate() {
            let c = if side.slope.mirrored { mirrored } else { columns };
            let (height, half_rise) = (sign[k] * reach.height[i], sign[k] * side.slope.half_rise);
            let parts = eight_parts(simd, c, [reach.from[i], reach.to[i]], height, half_rise);
            sum += splat(all[k] * reach.height[i]) + parts;
        }
        let mut sums = [0.0; 8];
        sum.max(splat(0.0)).min(splat(1.0)).store_slice(&mut sums);
        let areas = sums.map(|v| v as f32);
        let covered = sum.simd_gt(splat(0.0)).to_bitmask() as u32 & ((1 << width) - 1);
        if covered != 0 {
            let first = covered.trailing_zeros() as usize;
            let end = 32 - covered.leading_zeros() as usize;
            sink.row(y, rect.x0 + first as i32, &areas[first..end]);
        }
    }
}

/// Up to eight rows of any length: pixel by pixel along the sides only.
#[inline(always)]
fn wide_band<S: Simd>(
    simd: S,
    sides: &[Side; 3],
    rect: IntRect,
    row: &mut AreaRow,
    sink: &mut impl AreaSink,
) {
    let reaches = [0, 1, 2].map(|k: usize| sides[k].reaches(simd, rect.y0));
    for (i, y) in (rect.y0..rect.y1).enumerate().take(BAND) {
        row.begin(0.0);
        // The pixels that the left and the right sides touch.
        let mut ranges = [(i32::MAX, i32::MIN); 2];
        let mut touched = [(0, 0); 3];
        let reach = |k: usize| Reach {
            mirrored: sides[k].slope.mirrored,
            from: reaches[k].from[i],
            to: reaches[k].to[i],
            height: reaches[k].height[i],
            half_rise: sides[k].slope.half_rise,
        };
        for k in 0..3 {
            if reaches[k].height[i] > 0.0 {
                touched[k] = reach(k).pixels(rect.x0, rect.x1);
                let range = &mut ranges[usize::from(sides[k].weight < 0.0)];
                *range = (range.0.min(touched[k].0), range.1.max(touched[k].1));
            }
        }
        // Sides that meet may be a pixel out of order.
        let [left, right] = ranges;
        let together = right.0 <= left.1;
        let first = if together { (left.0.min(right.0), left.1.max(right.1)) } else { left };
        row.open(simd, y, first, sink);
        for weight in [1.0, -1.0] {
            if weight < 0.0 && !together {
                row.open(simd, y, right, sink);
            }
            for k in 0..3 {
                if sides[k].weight == weight && reaches[k].height[i] > 0.0 {
                    row.add(simd, &reach(k), touched[k], weight);
                }
            }
        }
        row.finish(simd, y, sink);
    }
}
