//! The walk over an ellipse: rows of texels, runs of [`LANES`] in each.

use crate::Wrap;
use crate::gaussian::gaussian;
use crate::level::Level;
use crate::math::floor32;

/// Texels weighted together. A logical number: the sums are taken in this many lanes, and folded in
/// a fixed order, whatever the width of the machine's vectors.
pub(crate) const LANES: usize = 8;

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
    /// First and last row, relative to y0.
    pub(crate) first: i32,
    pub(crate) last: i32,
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
    /// outside the ellipse are 0, and a fixed count is cheaper than exact ends.
    fn groups(&self) -> usize {
        let texels = floor32(2.0 * self.run) as usize + 1;
        texels.div_ceil(LANES)
    }

    /// Texels that the walk reads.
    pub(crate) fn texels(&self) -> usize {
        (self.last - self.first + 1).max(0) as usize * self.groups() * LANES
    }
}

/// Σ w·(t − centre) in lanes and Σ w, for one texture's channels.
struct Sums {
    texels: [[f32; 4]; LANES],
    weights: [f32; LANES],
}

/// The weighted average of the texels in the ellipse.
///
/// What is summed is the difference from the texel at the centre, so that a constant texture comes
/// out exact to the last bit.
pub(crate) fn walk(level: &Level, wrap: Wrap, w: &Walk) -> [f32; 4] {
    let right = i64::from(w.fx >= 0.5);
    let below = i64::from(w.fy >= 0.5);
    let centre = level.texel(w.x0 + right, w.y0 + below, wrap);
    let mut sums = Sums { texels: [[0.0; 4]; LANES], weights: [0.0; LANES] };
    let groups = w.groups();
    for j in w.first..=w.last {
        let dv = j as f32 - w.fy;
        let e = w.row_scale * (dv * dv);
        let middle = w.fx + w.slope * dv;
        let start = floor32(middle - w.run) + 1.0;
        let row = Row { level, wrap, y: wrap.resolve(w.y0 + i64::from(j), level.height) };
        for k in 0..groups {
            let first = start + (k * LANES) as f32;
            let weights = weigh(first - middle, e, w);
            row.with_run(w.x0 + first as i64, |run| sums.add(run, &weights, &centre));
        }
    }
    sums.finish(centre)
}

/// The weights of a group whose first texel is `dx` from the middle of its row.
#[inline(always)]
fn weigh(dx: f32, e: f32, w: &Walk) -> [f32; LANES] {
    core::array::from_fn(|i| {
        let dx = dx + i as f32;
        let e = e + w.run_scale * (dx * dx);
        let weight = gaussian(e);
        if e <= w.cut { weight } else { 0.0 }
    })
}

/// A row of a level, or of the constant outside it.
struct Row<'a> {
    level: &'a Level,
    wrap: Wrap,
    y: Option<usize>,
}

impl Row<'_> {
    /// Calls `f` with the [`LANES`] texels from column `x`: in place where they lie inside,
    /// collected where they do not.
    #[inline(always)]
    fn with_run(&self, x: i64, mut f: impl FnMut(&[[f32; 4]; LANES])) {
        let Some(y) = self.y else {
            return f(&[self.wrap.border(); LANES]);
        };
        let row = self.level.row(y);
        let inside = usize::try_from(x).ok().and_then(|x| row.get(x..)?.first_chunk());
        match inside {
            Some(run) => f(run),
            None => f(&self.collect(row, x)),
        }
    }

    #[cold]
    fn collect(&self, row: &[[f32; 4]], x: i64) -> [[f32; 4]; LANES] {
        core::array::from_fn(|i| match self.wrap.resolve(x + i as i64, row.len()) {
            Some(x) => row[x],
            None => self.wrap.border(),
        })
    }
}

impl Sums {
    #[inline(always)]
    fn add(&mut self, run: &[[f32; 4]; LANES], weights: &[f32; LANES], centre: &[f32; 4]) {
        for i in 0..LANES {
            self.weights[i] += weights[i];
            for c in 0..4 {
                self.texels[i][c] += weights[i] * (run[i][c] - centre[c]);
            }
        }
    }

    /// Folds the lanes, eight to four to two to one.
    fn finish(&self, centre: [f32; 4]) -> [f32; 4] {
        let w = &self.weights;
        let weight = ((w[0] + w[4]) + (w[2] + w[6])) + ((w[1] + w[5]) + (w[3] + w[7]));
        if weight <= 0.0 {
            return centre;
        }
        let t = &self.texels;
        core::array::from_fn(|c| {
            let even = (t[0][c] + t[4][c]) + (t[2][c] + t[6][c]);
            let odd = (t[1][c] + t[5][c]) + (t[3][c] + t[7][c]);
            centre[c] + (even + odd) / weight
        })
    }
}
