//! The walk over an ellipse: rows of texels, quads of [`LANES`] in each. Here as a definition, in
//! scalar code; `walk_simd` is the same in vectors.

use crate::Wrap;
use crate::covariance::{Covariance, LEAST_VARIANCE};
use crate::ewa::Limits;
use crate::gaussian::weight;
use crate::level::{APRON, Frame, Level};
use crate::math::{floor, floor32, sqrt32, whole};
use crate::pyramid::plan::Span;
use crate::store::Whole;
use crate::texel::{STEP, Texel};

/// Texels of a row that are read in one piece: a quad.
pub(crate) const LANES: usize = 4;

/// The determinant up to which sums of an ellipse's weights times texels fit 31 bits. On a grid, a Gaussian whose σ is √0.15 and
/// more sums to at most 1.22 times its integral: here to 84,000 where it is widened most, times texels of at most
/// 20,400.
pub(crate) const SMALL: f32 = 4.0;

/// An ellipse in one level, ready to be walked.
///
/// Texel (x0 + i, y0 + j) lies at dv = j − fy below the centre; the ellipse's middle in its row is at
/// fx + slope·dv from x0, and with dx the distance from there the Gaussian's exponent, in [`Limits::unit`]s,
/// is e = row_scale·dv² + run_scale·dx². Both terms are positive, so nothing cancels.
///
/// A row begins with its first texel in the ellipse, and is read in quads. The ellipse is convex, so
/// those rows that need a second quad follow one another, and so do those that need a third.
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct Walk {
    /// The whole part of the centre, in index space.
    pub(crate) x0: i32,
    pub(crate) y0: i32,
    /// The rest of the centre, in [0, 1].
    pub(crate) fx: f32,
    pub(crate) fy: f32,
    /// Σuv/Σvv: how the middle moves from row to row.
    pub(crate) slope: f32,
    /// ½/Σvv, in units.
    pub(crate) row_scale: f32,
    /// ½Σvv/det Σ, in units.
    pub(crate) run_scale: f32,
    /// One over each of the two.
    pub(crate) row_width: f32,
    pub(crate) run_width: f32,
    /// Weights with e above this are 0: ½R², in units.
    pub(crate) cut: f32,
    /// Quads of the widest row.
    pub(crate) groups: i32,
}

/// The centre of an ellipse in the index space of a level, where texels have whole numbers.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Place {
    /// The whole part.
    pub(crate) x0: i32,
    pub(crate) y0: i32,
    /// The rest, in [0, 1].
    pub(crate) fx: f32,
    pub(crate) fy: f32,
}

/// The variance of an ellipse along an axis where all texels are the same, times R²: it reaches less than
/// a texel, so that it is one row or one column of them.
pub(crate) const THIN: f32 = 0.9;

/// How far from the level's edge such an ellipse is put: further than its reach, and with the rest of a
/// quad still in the apron.
pub(crate) const ASIDE: i32 = 2;

/// The most that is taken for a reach, so that sums with places fit integers.
pub(crate) const FARTHEST: f32 = 268_435_456.0;

impl Place {
    /// The place (u, v), in texels of the image, in a level.
    #[inline(always)]
    pub(crate) fn new(u: f64, v: f64, frame: &Frame) -> Self {
        let (u, v) = (u * frame.scale[0] - 0.5, v * frame.scale[1] - 0.5);
        let (x0, y0) = (floor(u), floor(v));
        Self { x0: whole(x0), y0: whole(y0), fx: (u - x0) as f32, fy: (v - y0) as f32 }
    }

    /// Where an ellipse lies wholly beyond an edge of a level that ends there, its texels along that
    /// axis are all the same: it is put beside the edge, and made thin. Whether that is so of an axis.
    #[inline(always)]
    pub(crate) fn pull_in(
        &mut self,
        s: Covariance,
        frame: &Frame,
        limits: &Limits,
    ) -> (Covariance, bool) {
        if !frame.ends {
            return (s, false);
        }
        let x = beyond(self.x0, s.uu, frame.last[0], limits);
        let y = beyond(self.y0, s.vv, frame.last[1], limits);
        if x.is_none() && y.is_none() {
            return (s, false);
        }
        let at_least = |v: f32| if v > LEAST_VARIANCE { v } else { LEAST_VARIANCE };
        let (mut uu, mut vv) = (at_least(s.uu), at_least(s.vv));
        if let Some(x) = x {
            (self.x0, self.fx, uu) = (x, 0.0, limits.thin);
        }
        if let Some(y) = y {
            (self.y0, self.fy, vv) = (y, 0.0, limits.thin);
        }
        (Covariance { uu, uv: 0.0, vv, det: uu * vv }, true)
    }
}

/// The whole texels that an ellipse of this variance reaches, at most, from the whole part of its centre.
#[inline(always)]
pub(crate) fn reach(variance: f32, limits: &Limits) -> i32 {
    let reach = limits.radius * sqrt32(variance);
    (if reach < FARTHEST { reach } else { FARTHEST }) as i32 + 1
}

/// Where to put an ellipse that lies wholly beyond the texels 0 to `last`.
#[inline(always)]
fn beyond(at: i32, variance: f32, last: i32, limits: &Limits) -> Option<i32> {
    let reach = reach(variance, limits);
    if at + reach < -1 {
        Some(-1 - ASIDE)
    } else if at - reach > last {
        Some(last + ASIDE)
    } else {
        None
    }
}

/// The rows that have a quad of a number: the first, relative to y0, and how many. None, if that is
/// not positive.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Rows {
    pub(crate) first: i32,
    pub(crate) count: i32,
}

impl Walk {
    /// The walk over the ellipse about a place in a level.
    #[inline(always)]
    pub(crate) fn new(at: &Place, sigma: &Covariance, limits: &Limits) -> Self {
        let Covariance { uv, vv, det, .. } = *sigma;
        let inverse_vv = 1.0 / vv;
        let across = det * inverse_vv;
        // Half of the width along any one row.
        let run = limits.radius * sqrt32(across);
        // An interval of half-width h holds at most ⌊2h⌋ + 1 whole numbers: ⌊h/2⌋ + 1 quads.
        let groups = floor32(0.5 * run) + 1.0;
        Self {
            x0: at.x0,
            y0: at.y0,
            fx: at.fx,
            fy: at.fy,
            slope: uv * inverse_vv,
            row_scale: 0.5 * limits.unit * inverse_vv,
            run_scale: 0.5 * limits.unit / across,
            row_width: 2.0 / limits.unit * vv,
            run_width: 2.0 / limits.unit * across,
            cut: limits.cut,
            groups: groups as i32,
        }
    }

    /// The rows that have a quad of this number: those at least four texels wide for each before it.
    #[inline(always)]
    pub(crate) fn rows(&self, group: i32) -> Rows {
        let before = (LANES / 2) as f32 * group as f32;
        let left = (self.cut - (before * before) * self.run_scale).max(0.0);
        let reach = sqrt32(left * self.row_width);
        let first = -(floor32(reach - self.fy) as i32);
        Rows { first, count: floor32(reach + self.fy) as i32 - first + 1 }
    }

    /// Texels that the walk reads.
    pub(crate) fn texels(&self) -> usize {
        (0..self.groups).map(|g| self.rows(g).count.max(0) as usize * LANES).sum()
    }

    /// The texel nearest to the centre.
    #[cold]
    #[inline(never)]
    pub(crate) fn centre(&self, level: &Level, wrap: Wrap) -> [f32; 4] {
        let right = i32::from(self.fx >= 0.5);
        let below = i32::from(self.fy >= 0.5);
        level.texel(self.x0 + right, self.y0 + below, wrap)
    }

    /// The colour, from the sums of the weights times texels and of the weights.
    #[inline(always)]
    pub(crate) fn mean(&self, sums: [f64; 4], total: i32, level: &Level, wrap: Wrap) -> [f32; 4] {
        if total <= 0 {
            return self.centre(level, wrap);
        }
        mean(sums, 1.0 / f64::from(total))
    }

    /// Row `j` of the walk, as far as it can be found in the level.
    #[inline(always)]
    pub(crate) fn row<'a>(&self, j: i32, level: &'a Level, wrap: Wrap) -> Row<'a> {
        Row::new(self.y0 + j, level, wrap)
    }
}

/// The colour, from the sums of the weights times texels and one over that of the weights. Both sums are
/// whole numbers below 2⁵³, so the mean of equal texels is one of them.
#[inline(always)]
pub(crate) fn mean(sums: [f64; 4], share: f64) -> [f32; 4] {
    sums.map(
        #[inline(always)]
        |sum| (sum * share) as f32 * STEP,
    )
}

/// A row of a level, or of the constant outside it.
#[derive(Clone, Copy)]
pub(crate) struct Row<'a> {
    /// With the apron on both sides.
    texels: Option<Whole<'a>>,
    /// The constant.
    outside: Texel,
    /// Columns that are kept, the apron apart.
    columns: Span,
    /// Columns of the level.
    width: usize,
    wrap: Wrap,
}

impl<'a> Row<'a> {
    /// Row `y`, which may lie outside.
    #[inline(always)]
    pub(crate) fn new(y: i32, level: &'a Level, wrap: Wrap) -> Self {
        let texels = wrap.resolve(y, level.height).map(|y| level.row_with_apron(y));
        Self { texels, outside: level.outside, columns: level.part[0], width: level.width, wrap }
    }

    /// The [`LANES`] texels from column `x`: a copy where they lie inside, collected where they do not.
    #[inline(always)]
    pub(crate) fn run(&self, x: i32) -> [Texel; LANES] {
        // Sizes are below 2²⁹. In a tile, every run begins in the row, and the apron ends it.
        let x = if self.wrap == Wrap::Repeat { x.rem_euclid(self.width as i32) } else { x };
        let place = usize::try_from(x - self.columns.start as i32 + APRON as i32);
        let inside = self.texels.and_then(|row| row.run(place.ok()?));
        inside.unwrap_or_else(|| self.collect(x))
    }

    #[cold]
    #[inline(never)]
    fn collect(&self, x: i32) -> [Texel; LANES] {
        core::array::from_fn(|i| {
            let found = self.texels.and_then(|row| {
                let column = self.wrap.resolve(x + i as i32, self.width)?;
                Some(row.texel(self.columns.place(column) + APRON))
            });
            found.unwrap_or(self.outside)
        })
    }
}

/// The weighted average of the texels in the ellipse.
///
/// Weights are whole numbers, and so are texels: their sums are exact, and the order does not matter.
pub(crate) fn walk(level: &Level, wrap: Wrap, w: &Walk) -> [f32; 4] {
    let mut sums = [0i64; 4];
    let mut total = 0;
    for group in 0..w.groups {
        let Rows { first, count } = w.rows(group);
        let shift = (LANES as i32 * group) as f32;
        for j in first..first.saturating_add(count) {
            let dv = j as f32 - w.fy;
            let e = (dv * dv) * w.row_scale;
            let half = sqrt32((w.cut - e).max(0.0) * w.run_width);
            let low = (dv * w.slope + w.fx) - half;
            let before = floor32(low);
            let offset = ((shift + 1.0) - half) - (low - before);
            let row = w.row(j, level, wrap);
            let start = w.x0 + 1 + LANES as i32 * group + before as i32;
            let run = row.run(start);
            for (i, texel) in run.iter().enumerate() {
                let dx = offset + i as f32;
                let e = e + w.run_scale * (dx * dx);
                let weight = if e <= w.cut { weight(e) } else { 0 };
                total += weight;
                for (sum, t) in sums.iter_mut().zip(texel) {
                    *sum += i64::from(weight) * i64::from(*t);
                }
            }
        }
    }
    w.mean(sums.map(|sum| sum as f64), total, level, wrap)
}
