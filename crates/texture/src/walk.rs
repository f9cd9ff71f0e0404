//! The walk over an ellipse: rows of texels, runs of [`LANES`] in each. Here as a definition, in
//! scalar code; `walk_simd` is the same in vectors.

use crate::Wrap;
use crate::gaussian::gaussian;
use crate::level::Level;
use crate::math::floor32;

/// Rows walked together, and texels of each: the sums are taken in lanes of this logical shape and
/// folded in a fixed order, whatever the width of the machine's vectors. Four texels are one vector of
/// sixteen floats, and most rows of most ellipses hold no more than four.
pub(crate) const LANES: usize = 4;

/// An ellipse in one level, ready to be walked.
///
/// Texel (x0 + i, y0 + j) lies at dv = j − fy below the centre; the ellipse's middle in its row is at
/// fx + slope·dv from x0, and with dx the distance from there the Gaussian's exponent is
/// e = row_scale·dv² + run_scale·dx². Both terms are positive, so nothing cancels.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Walk {
    /// The whole part of the centre, in index space.
    pub(crate) x0: i64,
    pub(crate) y0: i64,
    /// The rest of the centre, in [0, 1].
    pub(crate) fx: f32,
    pub(crate) fy: f32,
    /// First row, relative to y0.
    pub(crate) first: i32,
    /// Half the ellipse's height.
    pub(crate) rise: f32,
    /// Half the ellipse's width along its widest row (any row through its centre).
    pub(crate) run: f32,
    /// Σuv/Σvv: how the middle moves from row to row.
    pub(crate) slope: f32,
    /// ½/Σvv.
    pub(crate) row_scale: f32,
    /// ½Σvv/det Σ.
    pub(crate) run_scale: f32,
    /// Weights with e above this are 0: ½R².
    pub(crate) cut: f32,
}

impl Walk {
    /// Groups of [`LANES`] texels that cover the widest row; every row reads as many. Weights
    /// outside the ellipse are 0, and a fixed count is cheaper than exact ends: it depends on the
    /// ellipse but not on where in a texel its centre lies, so neighbouring pixels agree on it and
    /// the processor can predict it.
    #[inline(always)]
    pub(crate) fn groups(&self) -> usize {
        groups(self.run)
    }

    /// Blocks of [`LANES`] rows, by the same reasoning.
    #[inline(always)]
    pub(crate) fn blocks(&self) -> usize {
        groups(self.rise)
    }

    /// Texels that the walk reads.
    pub(crate) fn texels(&self) -> usize {
        self.blocks() * self.groups() * LANES * LANES
    }

    /// The texel nearest to the centre. What is summed is the difference from it, so that a
    /// constant texture comes out exact to the last bit.
    #[inline(always)]
    pub(crate) fn centre(&self, level: &Level, wrap: Wrap) -> [f32; 4] {
        let right = i64::from(self.fx >= 0.5);
        let below = i64::from(self.fy >= 0.5);
        level.texel(self.x0 + right, self.y0 + below, wrap)
    }

    /// Whether every texel of the walk lies inside the level.
    ///
    /// The middle of the ellipse moves evenly from row to row, so the first and the last row reach
    /// farthest; the same numbers as in the walk, which only grow or only fall with the row.
    #[inline(always)]
    pub(crate) fn is_inside(&self, level: &Level) -> bool {
        let start = |j: i32| {
            let middle = self.fx + self.slope * (j as f32 - self.fy);
            self.x0 + (floor32(middle - self.run) + 1.0) as i64
        };
        let last = self.first + (self.blocks() * LANES) as i32 - 1;
        let (a, b) = (start(self.first), start(last));
        let end = a.max(b) + (self.groups() * LANES) as i64;
        let (top, bottom) = (self.y0 + i64::from(self.first), self.y0 + i64::from(last));
        (a.min(b) >= 0) & (end <= level.width as i64) & (top >= 0) & (bottom < level.height as i64)
    }

    /// Row `j` of the walk, as far as it can be found in the level.
    #[inline(always)]
    pub(crate) fn row<'a>(&self, j: i32, level: &'a Level, wrap: Wrap) -> Row<'a> {
        let y = wrap.resolve(self.y0 + i64::from(j), level.height);
        Row { texels: y.map(|y| level.row(y)), wrap }
    }
}

/// How many groups of [`LANES`] hold every whole number in any interval of that half-width.
#[inline(always)]
fn groups(half: f32) -> usize {
    (floor32(2.0 * half) as usize + 1).div_ceil(LANES)
}

/// A row of a level, or of the constant outside it.
#[derive(Clone, Copy)]
pub(crate) struct Row<'a> {
    texels: Option<&'a [[f32; 4]]>,
    wrap: Wrap,
}

impl Row<'_> {
    /// Calls `f` with the [`LANES`] texels from column `x`: in place where they lie inside,
    /// collected where they do not.
    #[inline(always)]
    pub(crate) fn with_run<R>(&self, x: i64, f: impl FnOnce(&[[f32; 4]; LANES]) -> R) -> R {
        let inside = self.texels.and_then(|row| row.get(usize::try_from(x).ok()?..)?.first_chunk());
        match inside {
            Some(run) => f(run),
            None => f(&self.collect(x)),
        }
    }

    #[cold]
    #[inline(never)]
    fn collect(&self, x: i64) -> [[f32; 4]; LANES] {
        core::array::from_fn(|i| {
            let found = self
                .texels
                .and_then(|row| self.wrap.resolve(x + i as i64, row.len()).map(|x| row[x]));
            found.unwrap_or_else(|| self.wrap.border())
        })
    }
}

/// The weighted average of the texels in the ellipse.
///
/// Four rows at a time, and in them a group of four columns after the other. The texels' lanes are
/// the columns of a group; the weights' lanes its rows, too.
pub(crate) fn walk(level: &Level, wrap: Wrap, w: &Walk) -> [f32; 4] {
    let centre = w.centre(level, wrap);
    let mut sums = [[0.0f32; 4]; LANES];
    let mut weights = [[0.0f32; LANES]; LANES];
    for block in 0..w.blocks() {
        for k in 0..w.groups() {
            for (r, totals) in weights.iter_mut().enumerate() {
                let j = w.first + (block * LANES + r) as i32;
                let dv = j as f32 - w.fy;
                let e = w.row_scale * (dv * dv);
                let middle = w.fx + w.slope * dv;
                let start = floor32(middle - w.run) + 1.0;
                let x = w.x0 + start as i64 + (k * LANES) as i64;
                let run = w.row(j, level, wrap).with_run(x, |run| *run);
                for i in 0..LANES {
                    let dx = (start + (k * LANES + i) as f32) - middle;
                    let weight = weigh(e + w.run_scale * (dx * dx), w);
                    totals[i] += weight;
                    for c in 0..4 {
                        sums[i][c] += weight * (run[i][c] - centre[c]);
                    }
                }
            }
        }
    }
    let fold = |v: [f32; LANES]| (v[0] + v[2]) + (v[1] + v[3]);
    let columns = core::array::from_fn(|i| fold(core::array::from_fn(|r| weights[r][i])));
    let total = fold(columns);
    if total <= 0.0 {
        return centre;
    }
    core::array::from_fn(|c| centre[c] + fold(core::array::from_fn(|i| sums[i][c])) / total)
}

/// The weight at an exponent: nothing beyond the cut.
#[inline(always)]
fn weigh(e: f32, w: &Walk) -> f32 {
    if e <= w.cut { gaussian(e) } else { 0.0 }
}
