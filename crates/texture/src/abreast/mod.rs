//! Sixteen walks abreast: a lane for each, row by row. The same whole numbers as in [`crate::walk`].
//!
//! Neighbouring pixels have ellipses of nearly the same shape. So row r of all sixteen is weighed at
//! once, with the walks' own numbers in lanes and nothing to be spread over them; and then each walk
//! reads its texels, all with the same count of quads, so that the processor foresees every branch.

mod sheet;
mod sums;

pub(crate) use sheet::Sheet;

use crate::batch::lanes;
use crate::level::{Level, Places};
use crate::magnify::patch::Patch;
use crate::run::ABREAST;
use crate::store::Whole;
use crate::texel::ROUNDER;
use crate::walk::{LANES, Walk};
use crate::{Texture, gaussian::lanes as gaussian};
use fearless_simd::{Simd, f32x16, i16x32, i32x16, mask32x16, prelude::*};
use sheet::{QUADS, Start};
use sums::{Sums, finish_small};

/// The columns and rows of a quad.
pub(crate) const QUAD: [i32; 2] = [LANES as i32, 1];

/// An exponent beyond every cut.
pub(crate) const NOTHING: f32 = 16.0;

/// [`Walk`]s in one level, by field.
#[derive(Clone, Copy)]
pub(crate) struct Walks<S: Simd> {
    pub(crate) x0: i32x16<S>,
    pub(crate) y0: i32x16<S>,
    pub(crate) fx: f32x16<S>,
    pub(crate) fy: f32x16<S>,
    pub(crate) slope: f32x16<S>,
    pub(crate) row_scale: f32x16<S>,
    pub(crate) run_scale: f32x16<S>,
    pub(crate) row_width: f32x16<S>,
    pub(crate) run_width: f32x16<S>,
    pub(crate) cut: f32x16<S>,
    pub(crate) groups: i32x16<S>,
    pub(crate) small: mask32x16<S>,
}

/// The colours of the walks whose bits are set.
#[inline(always)]
pub(crate) fn walk_all<S: Simd>(
    simd: S,
    t: &Texture,
    level: &Level,
    walks: &Walks<S>,
    wanted: u64,
    sheet: &mut Sheet,
    out: &mut [[f32; 4]; ABREAST],
) {
    let walk = mask32x16::from_bitmask(simd, wanted);
    let groups = walk.select(walks.groups, i32x16::splat(simd, 0));
    let small = wanted & !walks.small.to_bitmask() == 0;
    let places = level.places(simd, QUAD);
    let mut gather = Gather::new(simd, level.texels.whole(), wanted, small, sheet);
    for group in 0..most(groups) {
        gather.start(walks, &places, walks.rows(simd, groups, group));
    }
    gather.weigh(walks);
    for i in lanes(gather.finish(out)) {
        out[i] = walks.get(i).centre(level, t.wrap);
    }
}

/// The sum of weights up to which their sums with texels of at most 20,400 fit 31 bits.
const FITS: i32 = i32::MAX / 20_400;

/// Sums on their way: quads are weighed one after the other for all walks, and then each walk's are read.
pub(crate) struct Gather<'a, S: Simd> {
    simd: S,
    texels: Whole<'a>,
    wanted: u64,
    sheet: &'a mut Sheet,
    /// Quads that stand in it, and whether others have been read.
    used: usize,
    read: bool,
    sums: Sums,
    /// Of the weights.
    totals: i32x16<S>,
}

impl<'a, S: Simd> Gather<'a, S> {
    /// For the walks whose bits are set, their weights at least 0 and at most 2¹². `small` says that all their
    /// sums are sure to fit 31 bits.
    #[inline(always)]
    pub(crate) fn new(
        simd: S,
        texels: Whole<'a>,
        wanted: u64,
        small: bool,
        sheet: &'a mut Sheet,
    ) -> Self {
        let sums =
            if small { Sums::Small([[0; 4]; ABREAST]) } else { Sums::Large([[0.0; 4]; ABREAST]) };
        let totals = i32x16::splat(simd, 0);
        Self { simd, texels, wanted, sheet, used: 0, read: false, sums, totals }
    }

    /// A quad of each walk: the pairs of its weights, and the index of its first texel.
    #[inline(always)]
    pub(crate) fn put(&mut self, weights: [i32x16<S>; 2], at: i32x16<S>) {
        self.totals += sum(self.simd, weights);
        self.sheet.put(self.used, weights, at);
        self.used += 1;
        if self.used == QUADS {
            self.sum();
        }
    }

    /// Quads of rows of each walk, which are yet to be weighed.
    ///
    /// Where a quad begins takes a root, which takes its time, and so do weights, step by step. One row after
    /// the other, each would wait for the one and then for the other; so the beginnings of all rows are found,
    /// which wait together, and then all the weights.
    #[inline(always)]
    fn start(&mut self, walks: &Walks<S>, places: &Places<S>, mut rows: Rows<S>) {
        let mut left = most(rows.count).max(0) as usize;
        while left > 0 {
            // Nothing else is done in the loop, so that the rows stay in registers.
            let quads = left.min(QUADS - self.used);
            for quad in self.used..self.used + quads {
                let (start, at) = walks.start(self.simd, places, &mut rows);
                self.sheet.start(quad, &start, at);
            }
            left -= quads;
            self.used += quads;
            if self.used == QUADS {
                self.weigh(walks);
                self.sum();
            }
        }
    }

    /// Weighs the quads that stand in the sheet.
    #[inline(always)]
    fn weigh(&mut self, walks: &Walks<S>) {
        for quad in 0..self.used {
            let weights = walks.weights(self.simd, &self.sheet.started(self.simd, quad));
            self.totals += sum(self.simd, weights);
            self.sheet.weigh(quad, weights);
        }
    }

    /// Adds the quads that stand in the sheet, which is empty then.
    #[inline(always)]
    fn sum(&mut self) {
        self.sheet.turn(self.simd, self.used);
        self.sums.gather(self.simd, self.texels, self.wanted, self.sheet, self.used);
        self.used = 0;
        self.read = true;
    }

    /// Makes the means. Returns the bits of walks of which no texel has any weight, whose means are of no
    /// meaning.
    #[inline(always)]
    pub(crate) fn finish(&mut self, out: &mut [[f32; 4]; ABREAST]) -> u64 {
        let Self { simd, texels, wanted, used, totals, .. } = *self;
        self.sheet.turn(simd, used);
        let shares = shares(totals);
        if !self.read && most(totals) <= FITS {
            finish_small(simd, texels, wanted, self.sheet, used, &shares, out);
        } else {
            self.sums.finish(simd, texels, wanted, self.sheet, used, &shares, out);
        }
        totals.simd_le(0).to_bitmask() & wanted
    }
}

/// The means of the texels of patches whose bits are set, from the spots that they count from; of those
/// which can be read in place, whose bits it returns.
#[inline(always)]
pub(crate) fn average_all<S: Simd, const C: usize, const R: usize>(
    simd: S,
    level: &Level,
    patch: &Patch<f32x16<S>, C, R>,
    base: [i32x16<S>; 2],
    wanted: u64,
    sheet: &mut Sheet,
    out: &mut [[f32; 4]; ABREAST],
) -> u64 {
    const { assert!(R <= QUADS && C <= LANES) };
    let [x, y] = [
        base[0] + patch.low[0].to_int::<i32x16<S>>(),
        base[1] + patch.low[1].to_int::<i32x16<S>>(),
    ];
    let inside = level.reads(simd, [x, y], [x + (LANES as i32 - 1), y + (R as i32 - 1)]);
    let done = inside.to_bitmask() & wanted;
    let places = level.places(simd, QUAD);
    let mut totals = i32x16::splat(simd, 0);
    for (r, row) in patch.weights.iter().enumerate() {
        let at = places.index([x, y + r as i32]);
        let mut quad = [f32x16::splat(simd, 0.0); LANES];
        quad[..C].copy_from_slice(row);
        let [left, right] = [pair(simd, quad[0], quad[1]), pair(simd, quad[2], quad[3])];
        totals += sum(simd, [left, right]);
        sheet.put(r, [left, right], inside.select(at, i32x16::splat(simd, 0)));
    }
    sheet.turn(simd, R);
    finish_small(simd, level.texels.whole(), done, sheet, R, &shares(totals), out);
    done
}

/// One over each.
#[inline(always)]
fn shares<S: Simd>(totals: i32x16<S>) -> [f64; ABREAST] {
    let mut shares = [0.0; ABREAST];
    for (share, total) in shares.iter_mut().zip(totals.to_array()) {
        *share = 1.0 / f64::from(total);
    }
    shares
}

/// Two weights, rounded to whole numbers, in the low and the high halves of the lanes.
#[inline(always)]
pub(crate) fn pair<S: Simd>(simd: S, first: f32x16<S>, second: f32x16<S>) -> i32x16<S> {
    let rounder = f32x16::splat(simd, ROUNDER);
    let first = (first + rounder).bitcast::<i32x16<S>>() & 0xffff;
    first | ((second + rounder).bitcast::<i32x16<S>>() << 16)
}

/// The largest of sixteen.
#[inline(always)]
fn most<S: Simd>(v: i32x16<S>) -> i32 {
    v.reduce_max()
}

/// The rows that have a quad of a number, from the next one on.
struct Rows<S: Simd> {
    /// How many.
    count: i32x16<S>,
    /// The next, from the walk's own and from the level's first.
    j: f32x16<S>,
    y: i32x16<S>,
    /// The column from which quads of this number are counted, and how far it is from the walk's first.
    x: i32x16<S>,
    shift: f32,
}

/// The sums of the weights of quads.
#[inline(always)]
fn sum<S: Simd>(simd: S, [left, right]: [i32x16<S>; 2]) -> i32x16<S> {
    let both = left.bitcast::<i16x32<S>>() + right.bitcast::<i16x32<S>>();
    both.pairwise_dot_product(i16x32::splat(simd, 1))
}

impl<S: Simd> Walks<S> {
    /// What [`Walk::centre`] needs of one of them.
    #[cold]
    #[inline(never)]
    fn get(&self, i: usize) -> Walk {
        Walk {
            x0: self.x0.to_array()[i],
            y0: self.y0.to_array()[i],
            fx: self.fx.to_array()[i],
            fy: self.fy.to_array()[i],
            ..Walk::default()
        }
    }

    /// [`Walk::rows`]; none of those that have no quad of the number.
    #[inline(always)]
    fn rows(&self, simd: S, groups: i32x16<S>, group: i32) -> Rows<S> {
        let before = (LANES / 2) as f32 * group as f32;
        let left = self.cut - self.run_scale * (before * before);
        let left = left.max(f32x16::splat(simd, 0.0));
        let reach = (left * self.row_width).sqrt();
        let first = -(reach - self.fy).floor();
        let last = (reach + self.fy).floor();
        let count = (last - first).to_int::<i32x16<S>>() + 1;
        let shift = LANES as i32 * group + 1;
        Rows {
            count: groups.simd_gt(group).select(count, i32x16::splat(simd, 0)),
            j: first,
            y: first.to_int::<i32x16<S>>() + self.y0,
            x: self.x0 + shift,
            shift: shift as f32,
        }
    }

    /// The beginning of a quad in the next row of each walk, and the index of its first texel, which is of no
    /// meaning where there is none.
    #[inline(always)]
    fn start(&self, simd: S, places: &Places<S>, rows: &mut Rows<S>) -> (Start<S>, i32x16<S>) {
        let dv = rows.j - self.fy;
        let e = (dv * dv) * self.row_scale;
        let half = (self.cut - e).max(f32x16::splat(simd, 0.0));
        let half = (half * self.run_width).sqrt();
        let low = (dv * self.slope + self.fx) - half;
        let before = low.floor();
        let offset = (f32x16::splat(simd, rows.shift) - half) - (low - before);
        let e = rows.count.simd_gt(0).select(e, f32x16::splat(simd, NOTHING));
        let x = before.to_int::<i32x16<S>>() + rows.x;
        let at = places.index([x, rows.y]);
        rows.j += 1.0;
        rows.y += 1;
        rows.count -= 1;
        (Start { e, offset }, at)
    }

    /// The weights of a quad: the pair on the left, and that on the right.
    #[inline(always)]
    fn weights(&self, simd: S, start: &Start<S>) -> [i32x16<S>; 2] {
        let Start { e, offset } = *start;
        [self.pair(simd, e, offset), self.pair(simd, e, offset + 2.0)]
    }

    /// The weights of two texels side by side, the first of which lies so far from the middle of its row:
    /// in the low and the high halves of the lanes.
    #[inline(always)]
    fn pair(&self, simd: S, e: f32x16<S>, dx: f32x16<S>) -> i32x16<S> {
        let next = dx + 1.0;
        let first = gaussian::weight(simd, e + self.run_scale * (dx * dx), self.cut);
        let second = gaussian::weight(simd, e + self.run_scale * (next * next), self.cut);
        // What a rounder leaves in the high half, the other takes off.
        let first = (first + ROUNDER).bitcast::<i32x16<S>>();
        ((second + (ROUNDER - ROUNDER_HIGH)).bitcast::<i32x16<S>>() << 16) + first
    }
}

/// The high half of the bits of [`ROUNDER`].
const ROUNDER_HIGH: f32 = (ROUNDER.to_bits() >> 16) as f32;
