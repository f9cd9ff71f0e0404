//! Exact area of triangles: their winding number is 0 or 1, so signed areas simply add up.

use super::Triangle;
use crate::area::{
    AreaRow, CHUNK, GAP, LANES, ROW_CELLS, Reach, Slope, eight_areas, eight_parts, extent,
    mirrored, splat, touched,
};
use crate::{AreaSink, FixedPoint};
use fearless_simd::{Level, Simd, dispatch, f64x8, prelude::*};
use scumble_geometry::IntRect;

/// Rows whose crossings are found side by side.
const BAND: usize = 8;

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
        [Side::new(p, q), Side::new(q, r), Side::new(r, p)]
    }
}

impl Reaches {
    /// The first and the last pixel that the side touches in each row, within the columns of `rect`.
    #[inline(always)]
    fn pixels(&self, sign: f64, rect: IntRect) -> ([i32; BAND], [i32; BAND]) {
        let mut out = ([0; BAND], [0; BAND]);
        for i in 0..BAND {
            let ends = extent(sign, self.from[i], self.to[i]);
            (out.0[i], out.1[i]) = touched(ends, rect.x0, rect.x1);
        }
        out
    }
}

impl Side {
    /// From `p` to `q`, clockwise to the eye: left sides run up. A level side has no height to add.
    #[inline(always)]
    fn new(p: FixedPoint, q: FixedPoint) -> Self {
        let up = p.y > q.y;
        let (top, bottom) = if up { (q, p) } else { (p, q) };
        let slope = if top.y < bottom.y {
            Slope::new(top.x, top.y, bottom.x, bottom.y)
        } else {
            Slope { sign: 1.0, x0: 0.0, y0: 0.0, run: 0.0, half_rise: 0.0 }
        };
        Self {
            slope,
            top: f64::from(top.y) * (1.0 / 256.0),
            bottom: f64::from(bottom.y) * (1.0 / 256.0),
            weight: if up { 1.0 } else { -1.0 },
        }
    }

    #[inline(always)]
    fn reach(&self, reaches: &Reaches, i: usize) -> Reach {
        Reach {
            sign: self.slope.sign,
            from: reaches.from[i],
            to: reaches.to[i],
            height: reaches.height[i],
            half_rise: self.slope.half_rise,
        }
    }

    /// Where the side meets the rows from `y` on.
    #[inline(always)]
    fn reaches<S: Simd>(&self, simd: S, y: i32) -> Reaches {
        let Slope { x0, y0, run, .. } = self.slope;
        let (x0, y0, run) = (splat(simd, x0), splat(simd, y0), splat(simd, run));
        let (top, bottom) = (splat(simd, self.top), splat(simd, self.bottom));
        let row = f64x8::from_slice(simd, &LANES) + splat(simd, f64::from(y));
        let start = row.max(top).min(bottom);
        let end = (row + splat(simd, 1.0)).max(top).min(bottom);
        let mut out = Reaches { from: [0.0; BAND], to: [0.0; BAND], height: [0.0; BAND] };
        (x0 + (start - y0) * run).store_slice(&mut out.from);
        (x0 + (end - y0) * run).store_slice(&mut out.to);
        (end - start).store_slice(&mut out.height);
        out
    }
}

// No closures around vectors: they would not be compiled for the instruction set.
#[inline(always)]
fn reaches<S: Simd>(simd: S, [p, q, r]: &[Side; 3], y: i32) -> [Reaches; 3] {
    [p.reaches(simd, y), q.reaches(simd, y), r.reaches(simd, y)]
}

/// Up to eight rows of up to eight pixels: all sides over all pixels of a row at once.
#[inline(always)]
fn narrow_band<S: Simd>(simd: S, sides: &[Side; 3], rect: IntRect, sink: &mut impl AreaSink) {
    let mut reaches = reaches(simd, sides, rect.y0);
    let columns = f64x8::from_slice(simd, &LANES) + splat(simd, f64::from(rect.x0));
    // What is left behind in the mirror lies left of the side: the rest is right of it.
    let mut corners = [columns; 3];
    let mut half_rises = [0.0; 3];
    let mut rest = [0.0; BAND];
    for (k, (side, reach)) in sides.iter().zip(&mut reaches).enumerate() {
        let sign = side.slope.sign;
        let (shift, all) = mirrored(sign, 0.0, side.weight);
        corners[k] = columns * splat(simd, sign) + splat(simd, shift);
        half_rises[k] = sign * side.weight * side.slope.half_rise;
        for (rest, height) in rest.iter_mut().zip(&mut reach.height) {
            *rest += all * *height;
            *height *= sign * side.weight;
        }
    }
    let width = (rect.x1 - rect.x0) as usize;
    for (i, y) in (rect.y0..rect.y1).enumerate().take(BAND) {
        let mut sum = splat(simd, rest[i]);
        for (k, reach) in reaches.iter().enumerate() {
            let ends = [reach.from[i], reach.to[i]];
            sum += eight_parts(simd, corners[k], ends, reach.height[i], half_rises[k]);
        }
        let areas = eight_areas(simd, sum);
        let covered = sum.simd_gt(splat(simd, 0.0)).to_bitmask() as u32 & ((1 << width) - 1);
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
    let reaches = reaches(simd, sides, rect.y0);
    let pixels = [
        reaches[0].pixels(sides[0].slope.sign, rect),
        reaches[1].pixels(sides[1].slope.sign, rect),
        reaches[2].pixels(sides[2].slope.sign, rect),
    ];
    for (i, y) in (rect.y0..rect.y1).enumerate().take(BAND) {
        // The sides that meet the row, left ones first, and the pixels that they touch.
        let mut met = [(Reach::NONE, (0, 0), 0.0); 3];
        let mut count = [0, 0];
        for weight in [1.0, -1.0] {
            for (k, side) in sides.iter().enumerate() {
                if side.weight == weight && reaches[k].height[i] > 0.0 {
                    let range = (pixels[k].0[i], pixels[k].1[i]);
                    met[count[0] + count[1]] = (side.reach(&reaches[k], i), range, weight);
                    count[usize::from(weight < 0.0)] += 1;
                }
            }
        }
        row.begin(0.0);
        let met = &met[..count[0] + count[1]];
        if let [left, right] = met
            && right.1.0 > left.1.1 + GAP
            && left.1.1 - left.1.0 < CHUNK
            && right.1.1 - right.1.0 < CHUNK
        {
            row.add_lone(simd, y, &left.0, left.1, left.2, sink);
            row.add_lone(simd, y, &right.0, right.1, right.2, sink);
        } else {
            add_groups(simd, y, met.split_at(count[0]), row, sink);
        }
        row.finish(simd, y, sink);
    }
}

/// A side in a row, the pixels that it touches, and its weight.
type Met = (Reach, (i32, i32), f64);

/// The left and the right sides of a row.
#[inline(always)]
fn add_groups<S: Simd>(
    simd: S,
    y: i32,
    (left, right): (&[Met], &[Met]),
    row: &mut AreaRow,
    sink: &mut impl AreaSink,
) {
    let (first, second) = (range(left), range(right));
    // Sides that meet may be a pixel out of order.
    let together = second.0 <= first.1;
    let both = (first.0.min(second.0), first.1.max(second.1));
    row.open(simd, y, if together { both } else { first }, sink);
    for side in left {
        row.add(simd, &side.0, side.1, side.2);
    }
    if !together {
        row.open(simd, y, second, sink);
    }
    for side in right {
        row.add(simd, &side.0, side.1, side.2);
    }
}

/// The pixels that the sides touch.
#[inline(always)]
fn range(sides: &[Met]) -> (i32, i32) {
    let mut range = (i32::MAX, i32::MIN);
    for (_, pixels, _) in sides {
        range = (range.0.min(pixels.0), range.1.max(pixels.1));
    }
    range
}
