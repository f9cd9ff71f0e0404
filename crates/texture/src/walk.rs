//! The walk over an ellipse: rows of texels, runs of [`LANES`] in each. Here as a definition, in
//! scalar code; `walk_simd` is the same in vectors.

use crate::Wrap;
use crate::covariance::Covariance;
use crate::ewa::Limits;
use crate::gaussian::{UNIT, weight};
use crate::level::{Frame, Level};
use crate::math::{floor, floor32, sqrt32, whole};
use crate::pyramid::plan::Span;
use crate::texel::{STEP, Texel, of_color};

/// Rows walked together, and texels of each. Their weights are one vector of sixteen floats, and most
/// rows of most ellipses hold no more than four.
pub(crate) const LANES: usize = 4;

/// The determinant up to which an ellipse is [`Walk::small`]. On a grid, a Gaussian whose σ is √0.15 and
/// more sums to at most 1.22 times its integral: here to 63,000, times texels of at most 20,400.
const SMALL: f32 = 4.0;

/// An ellipse in one level, ready to be walked.
///
/// Texel (x0 + i, y0 + j) lies at dv = j − fy below the centre; the ellipse's middle in its row is at
/// fx + slope·dv from x0, and with dx the distance from there the Gaussian's exponent, in [`UNIT`]s,
/// is e = row_scale·dv² + run_scale·dx². Both terms are positive, so nothing cancels.
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct Walk {
    /// The whole part of the centre, in index space.
    pub(crate) x0: i32,
    pub(crate) y0: i32,
    /// The rest of the centre, in [0, 1].
    pub(crate) fx: f32,
    pub(crate) fy: f32,
    /// First row, relative to y0.
    pub(crate) first: i32,
    /// Blocks of [`LANES`] rows, and groups of as many texels that cover the widest row. Weights
    /// outside the ellipse are 0, and a fixed count is cheaper than exact ends: it depends on the
    /// ellipse but not on where in a texel its centre lies, so neighbouring pixels agree on it and
    /// the processor can predict it.
    pub(crate) blocks: i32,
    pub(crate) groups: i32,
    /// Half the ellipse's width along any row through its centre.
    pub(crate) run: f32,
    /// Σuv/Σvv: how the middle moves from row to row.
    pub(crate) slope: f32,
    /// ½/Σvv, in units.
    pub(crate) row_scale: f32,
    /// ½Σvv/det Σ, in units.
    pub(crate) run_scale: f32,
    /// Weights with e above this are 0: ½R², in units.
    pub(crate) cut: f32,
    /// 1 if every texel of the walk lies inside the level, or in tiles that are as good, else 0.
    pub(crate) inside: i32,
    /// 1 if the ellipse is so small that sums of weights times texels fit 31 bits, else 0.
    pub(crate) small: i32,
}

impl Walk {
    /// The walk over the ellipse about (u, v), in texels of level 0, in a level.
    ///
    /// No branch and no call: a loop over many is one of vectors.
    #[inline(always)]
    pub(crate) fn new(u: f64, v: f64, frame: &Frame, sigma: &Covariance, limits: &Limits) -> Self {
        // Index space: texel centres at whole numbers.
        let (u, v) = (u * frame.scale[0] - 0.5, v * frame.scale[1] - 0.5);
        let (x0, y0) = (floor(u), floor(v));
        let (fx, fy) = ((u - x0) as f32, (v - y0) as f32);
        let (uv, vv, det) = (sigma.uv as f32, sigma.vv as f32, sigma.det as f32);
        let inverse_vv = 1.0 / vv;
        let slope = uv * inverse_vv;
        // Half-widths: R√Σvv over the rows, R√(det/Σvv) along any one row.
        let rise = limits.radius * sqrt32(vv);
        let run = limits.radius * sqrt32(det * inverse_vv);
        // An interval of half-width h holds at most ⌊2h⌋ + 1 whole numbers: ⌊h/2⌋ + 1 groups of 4.
        let blocks = floor32(0.5 * rise) + 1.0;
        let groups = floor32(0.5 * run) + 1.0;
        // The middle moves evenly from row to row, so the first and the last reach farthest: these
        // are the numbers of the walk itself, which only grow or only fall with the row.
        let first = -floor32(rise - fy);
        let last = first + (4.0 * blocks - 1.0);
        let start = |j: f32| floor32(slope * (j - fy) + (fx - run)) + 1.0;
        let (a, b) = (start(first), start(last));
        let (left, right) = (a.min(b), a.max(b) + 4.0 * groups);
        let inside = (x0 + f64::from(left) >= frame.low[0])
            & (x0 + f64::from(right) <= frame.high[0])
            & (y0 + f64::from(first) >= frame.low[1])
            & (y0 + f64::from(last) < frame.high[1]);
        Self {
            x0: whole(x0),
            y0: whole(y0),
            fx,
            fy,
            first: first as i32,
            blocks: blocks as i32,
            groups: groups as i32,
            run,
            slope,
            row_scale: 0.5 * UNIT * inverse_vv,
            run_scale: 0.5 * UNIT * (vv / det),
            cut: limits.cut,
            inside: i32::from(inside),
            small: i32::from(det <= SMALL),
        }
    }

    /// The first row of a block.
    #[inline(always)]
    pub(crate) fn row_of(&self, block: i32) -> i32 {
        self.first + block * LANES as i32
    }

    /// Blocks times groups of a walk inside its level; 0 if it is not.
    #[inline(always)]
    pub(crate) fn pieces(&self) -> usize {
        (self.blocks * self.groups * self.inside) as usize
    }

    /// Texels that the walk reads.
    pub(crate) fn texels(&self) -> usize {
        self.blocks as usize * self.groups as usize * LANES * LANES
    }

    /// The texel nearest to the centre.
    #[cold]
    #[inline(never)]
    fn centre(&self, level: &Level, wrap: Wrap) -> [f32; 4] {
        let right = i32::from(self.fx >= 0.5);
        let below = i32::from(self.fy >= 0.5);
        level.texel(self.x0 + right, self.y0 + below, wrap)
    }

    /// The colour, from the sums of the weights times texels and of the weights. Both are whole numbers
    /// below 2⁵³, so the mean of equal texels is one of them.
    #[inline(always)]
    pub(crate) fn mean(&self, sums: [f64; 4], total: i32, level: &Level, wrap: Wrap) -> [f32; 4] {
        if total <= 0 {
            return self.centre(level, wrap);
        }
        let share = 1.0 / f64::from(total);
        sums.map(|sum| (sum * share) as f32 * STEP)
    }

    /// Row `j` of the walk, as far as it can be found in the level.
    #[inline(always)]
    pub(crate) fn row<'a>(&self, j: i32, level: &'a Level, wrap: Wrap) -> Row<'a> {
        let y = wrap.resolve(self.y0 + j, level.height);
        let texels = y.map(|y| match wrap {
            Wrap::Repeat => level.row_with_apron(y),
            _ => level.row(y),
        });
        Row { texels, columns: level.part[0], width: level.width, wrap }
    }
}

/// A row of a level, or of the constant outside it.
#[derive(Clone, Copy)]
pub(crate) struct Row<'a> {
    texels: Option<&'a [Texel]>,
    /// Columns that are kept, the apron apart.
    columns: Span,
    /// Columns of the level.
    width: usize,
    wrap: Wrap,
}

impl Row<'_> {
    /// Calls `f` with the [`LANES`] texels from column `x`: in place where they lie inside,
    /// collected where they do not.
    #[inline(always)]
    pub(crate) fn with_run<R>(&self, x: i32, f: impl FnOnce(&[Texel; LANES]) -> R) -> R {
        // Sizes are below 2²⁹. In a tile, every run begins in the row, and the apron ends it.
        let x = if self.wrap == Wrap::Repeat { x.rem_euclid(self.width as i32) } else { x };
        let place = usize::try_from(x - self.columns.start as i32);
        let inside = self.texels.and_then(|row| row.get(place.ok()?..)?.first_chunk());
        match inside {
            Some(run) => f(run),
            None => f(&self.collect(x)),
        }
    }

    #[cold]
    #[inline(never)]
    fn collect(&self, x: i32) -> [Texel; LANES] {
        core::array::from_fn(|i| {
            let found = self.texels.and_then(|row| {
                Some(row[self.columns.place(self.wrap.resolve(x + i as i32, self.width)?)])
            });
            found.unwrap_or_else(|| of_color(self.wrap.border()))
        })
    }
}

/// The weighted average of the texels in the ellipse.
///
/// Weights are whole numbers, and so are texels: their sums are exact, and the order does not matter.
pub(crate) fn walk(level: &Level, wrap: Wrap, w: &Walk) -> [f32; 4] {
    let mut sums = [0i64; 4];
    let mut total = 0;
    for (j, r) in (0..w.blocks).flat_map(|b| (0..LANES as i32).map(move |r| (w.row_of(b), r))) {
        let dv = r as f32 + (j as f32 - w.fy);
        let e = w.row_scale * (dv * dv);
        let low = (w.slope * dv) + (w.fx - w.run);
        let before = floor32(low);
        let offset = (1.0 - w.run) - (low - before);
        let row = w.row(j + r, level, wrap);
        for k in (0..w.groups).map(|k| k * LANES as i32) {
            let run = row.with_run(w.x0 + 1 + before as i32 + k, |run| *run);
            for (i, texel) in run.iter().enumerate() {
                let dx = (k + i as i32) as f32 + offset;
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
