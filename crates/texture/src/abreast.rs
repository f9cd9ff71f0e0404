//! Sixteen walks abreast: a lane for each, row by row. The same whole numbers as in [`crate::walk`].
//!
//! Neighbouring pixels have ellipses of nearly the same shape. So row r of all sixteen is weighed at
//! once, with the walks' own numbers in lanes and nothing to be spread over them; and then each walk
//! reads its texels, all with the same count of quads, so that the processor foresees every branch.

use crate::batch::lanes;
use crate::level::{Level, Places};
use crate::magnify::patch::Patch;
use crate::run::ABREAST;
use crate::store::{CODE_BITS, Code, Whole};
use crate::texel::{ROUNDER, Texel};
use crate::walk::{LANES, Walk, mean};
use crate::walk_simd::PAIR;
use crate::{Texture, gaussian::lanes as gaussian};
use fearless_simd::{
    Simd, f32x16, i16x16, i16x32, i32x4, i32x8, i32x16, i64x4, i64x8, mask32x16, prelude::*, u8x16,
    u8x32,
};

/// Quads of each walk that are weighed before their texels are read: as many as most ellipses of the
/// default have. More take longer to clear for each run of pixels.
const QUADS: usize = 24;

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

/// Memory for [`walk_all`], made once for a run of pixels: by quad and then by lane.
#[derive(Debug)]
pub(crate) struct Sheet {
    /// Four weights of 16 bits, the first in the lowest; of quads that are yet to be weighed [`Start`]s.
    weights: [[i64; ABREAST]; QUADS],
    /// The index of the first texel.
    at: [[i32; ABREAST]; QUADS],
}

impl Default for Sheet {
    fn default() -> Self {
        Self { weights: [[0; ABREAST]; QUADS], at: [[0; ABREAST]; QUADS] }
    }
}

impl Sheet {
    #[inline(always)]
    fn put<S: Simd>(&mut self, quad: usize, [left, right]: [i32x16<S>; 2], at: i32x16<S>) {
        self.weigh(quad, [left, right]);
        self.at[quad] = at.to_array();
    }

    /// The weights of a quad, in the place of where it begins.
    #[inline(always)]
    fn weigh<S: Simd>(&mut self, quad: usize, [left, right]: [i32x16<S>; 2]) {
        let (first, second) = left.interleave(right);
        self.keep(quad, [first.bitcast(), second.bitcast()]);
    }

    /// Where a quad begins, in the place of its weights, and the index of its first texel.
    #[inline(always)]
    fn start<S: Simd>(&mut self, quad: usize, start: &Start<S>, at: i32x16<S>) {
        self.keep(quad, [start.e.bitcast(), start.offset.bitcast()]);
        self.at[quad] = at.to_array();
    }

    #[inline(always)]
    fn started<S: Simd>(&self, simd: S, quad: usize) -> Start<S> {
        let (low, high) = self.weights[quad].split_at(ABREAST / 2);
        let [e, offset] = [i64x8::from_slice(simd, low), i64x8::from_slice(simd, high)];
        Start { e: e.bitcast(), offset: offset.bitcast() }
    }

    #[inline(always)]
    fn keep<S: Simd>(&mut self, quad: usize, [low, high]: [i64x8<S>; 2]) {
        let (first, second) = self.weights[quad].split_at_mut(ABREAST / 2);
        low.store_slice(first);
        high.store_slice(second);
    }

    /// The weights of so many quads of a walk, and the index of the first texel of each.
    #[inline(always)]
    fn quads(&self, quads: usize, walk: usize) -> impl Iterator<Item = (i64, i32)> {
        self.weights[..quads.min(QUADS)].iter().zip(&self.at).map(
            #[inline(always)]
            move |(weights, at)| (weights[walk], at[walk]),
        )
    }
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
        let mut rows = walks.rows(simd, groups, group);
        for _ in 0..most(rows.count) {
            let (start, at) = walks.start(simd, &places, &mut rows);
            gather.start(walks, &start, at);
        }
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

    /// A quad of each walk that is yet to be weighed.
    ///
    /// Where a quad begins takes a root, which takes its time, and so do weights, step by step. One row after
    /// the other, each would wait for the one and then for the other; so the beginnings of all rows are found,
    /// which wait together, and then all the weights.
    #[inline(always)]
    fn start(&mut self, walks: &Walks<S>, start: &Start<S>, at: i32x16<S>) {
        self.sheet.start(self.used, start, at);
        self.used += 1;
        if self.used == QUADS {
            self.weigh(walks);
            self.sum();
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
        self.sums.gather(self.simd, self.texels, self.wanted, self.sheet, self.used);
        self.used = 0;
        self.read = true;
    }

    /// Makes the means. Returns the bits of walks of which no texel has any weight, whose means are of no
    /// meaning.
    #[inline(always)]
    pub(crate) fn finish(&mut self, out: &mut [[f32; 4]; ABREAST]) -> u64 {
        let Self { simd, texels, wanted, used, totals, .. } = *self;
        let shares = shares(totals);
        if !self.read && most(totals) <= FITS {
            finish_small(simd, texels, wanted, self.sheet, used, &shares, out);
        } else {
            self.sums.finish(simd, texels, wanted, self.sheet, used, &shares, out);
        }
        totals.simd_le(0).to_bitmask() & wanted
    }
}

/// The means of walks of which all quads stand in the sheet, and whose sums fit 31 bits.
#[inline(always)]
fn finish_small<S: Simd>(
    simd: S,
    texels: Whole<'_>,
    wanted: u64,
    sheet: &Sheet,
    quads: usize,
    shares: &[f64; ABREAST],
    out: &mut [[f32; 4]; ABREAST],
) {
    match texels {
        Whole::Steps(texels) => finish_in(simd, texels, wanted, sheet, quads, shares, out),
        Whole::Codes(texels) => finish_in(simd, texels, wanted, sheet, quads, shares, out),
    }
}

/// [`finish_small`] of texels as they are kept.
#[inline(always)]
fn finish_in<S: Simd>(
    simd: S,
    texels: &[impl Quad],
    wanted: u64,
    sheet: &Sheet,
    quads: usize,
    shares: &[f64; ABREAST],
    out: &mut [[f32; 4]; ABREAST],
) {
    for i in lanes(wanted) {
        let sum = small(simd, texels, sheet, quads, i).to_array();
        out[i] = mean(sum.map(f64::from), shares[i]);
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

/// The beginning of a quad in a row.
#[derive(Clone, Copy)]
struct Start<S: Simd> {
    /// The exponent's part from the row; beyond every cut where there is no quad.
    e: f32x16<S>,
    /// From the middle of the ellipse in the row to the first texel.
    offset: f32x16<S>,
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

/// Σ w·t of each walk.
#[expect(clippy::large_enum_variant, reason = "it lives on the stack, for a moment")]
enum Sums {
    /// Where they are sure to fit 31 bits.
    Small([[i32; 4]; ABREAST]),
    /// Whole numbers below 2⁵³.
    Large([[f64; 4]; ABREAST]),
}

impl Sums {
    /// Adds so many quads of each walk.
    #[inline(always)]
    fn gather<S: Simd>(
        &mut self,
        simd: S,
        texels: Whole<'_>,
        wanted: u64,
        sheet: &Sheet,
        quads: usize,
    ) {
        match texels {
            Whole::Steps(texels) => self.gather_in(simd, texels, wanted, sheet, quads),
            Whole::Codes(texels) => self.gather_in(simd, texels, wanted, sheet, quads),
        }
    }

    /// [`Sums::gather`] of texels as they are kept.
    #[inline(always)]
    fn gather_in<S: Simd>(
        &mut self,
        simd: S,
        texels: &[impl Quad],
        wanted: u64,
        sheet: &Sheet,
        quads: usize,
    ) {
        match self {
            Self::Small(sums) => {
                for i in lanes(wanted) {
                    let own = small(simd, texels, sheet, quads, i);
                    sums[i] = (own + i32x4::load_array(simd, sums[i])).to_array();
                }
            }
            Self::Large(sums) => {
                for i in lanes(wanted) {
                    let own = large(simd, texels, sheet, quads, i);
                    (0..4).for_each(|c| sums[i][c] += own[c]);
                }
            }
        }
    }

    /// Adds the last quads, and makes the means of the sums, of which `shares` are one over those of the
    /// weights.
    #[inline(always)]
    #[expect(clippy::too_many_arguments, reason = "what a batch of pixels has in hand")]
    fn finish<S: Simd>(
        &mut self,
        simd: S,
        texels: Whole<'_>,
        wanted: u64,
        sheet: &Sheet,
        quads: usize,
        shares: &[f64; ABREAST],
        out: &mut [[f32; 4]; ABREAST],
    ) {
        self.gather(simd, texels, wanted, sheet, quads);
        for i in lanes(wanted) {
            let sum = match self {
                Self::Small(sums) => sums[i].map(f64::from),
                Self::Large(sums) => sums[i],
            };
            out[i] = mean(sum, shares[i]);
        }
    }
}

/// The sum of so many quads of a walk, which is sure to fit 31 bits.
#[inline(always)]
fn small<S: Simd, T: Quad>(
    simd: S,
    texels: &[T],
    sheet: &Sheet,
    quads: usize,
    walk: usize,
) -> i32x4<S> {
    let mut own = i32x8::splat(simd, 0);
    for (weights, at) in sheet.quads(quads, walk) {
        own += T::weighed(simd, texels, weights, at);
    }
    fold(own) << T::BITS
}

/// The sum of so many quads of a walk, whatever it is.
#[inline(always)]
fn large<S: Simd, T: Quad>(
    simd: S,
    texels: &[T],
    sheet: &Sheet,
    quads: usize,
    walk: usize,
) -> [f64; 4] {
    let zero = i32x8::splat(simd, 0);
    let (mut high, mut low) = (zero, zero);
    let mut rest = sheet.quads(quads, walk);
    for _ in 0..quads.min(QUADS).div_ceil(ROOM) {
        let mut own = zero;
        for (weights, at) in rest.by_ref().take(ROOM) {
            own += T::weighed(simd, texels, weights, at);
        }
        own <<= T::BITS;
        high += own >> 12;
        low += own & 0xfff;
    }
    let (high, low) = (fold(high).to_array(), fold(low).to_array());
    let mut sum = [0.0; 4];
    for c in 0..4 {
        sum[c] = f64::from(high[c]) * 4096.0 + f64::from(low[c]);
    }
    sum
}

/// Quads whose sums are sure to fit 31 bits: in each lane two weights of at most 2¹² times texels below
/// 2¹⁴·⁴ each.
const ROOM: usize = 12;

/// A texel of which four of a row are read together.
trait Quad: Copy {
    /// Steps of its unit, as a power of two.
    const BITS: u32;

    /// Four from a place on by their weights: Σ w·t of the channels in its unit, those of every second texel
    /// apart.
    fn weighed<S: Simd>(simd: S, texels: &[Self], weights: i64, at: i32) -> i32x8<S>;
}

impl Quad for Texel {
    const BITS: u32 = 0;

    #[inline(always)]
    fn weighed<S: Simd>(simd: S, texels: &[Self], weights: i64, at: i32) -> i32x8<S> {
        let i = at as u32 as usize;
        let Some(run) = texels.get(i..i + LANES) else { return nothing(simd) };
        let texels = i16x16::from_slice(simd, run.as_flattened());
        let texels = texels.swizzle_dyn_within_blocks(u8x32::from_slice(simd, &PAIR[..32]));
        weigh(simd, texels, weights)
    }
}

/// Makes pairs of the channels of two texels in codes, of four in every block of sixteen bytes: those of the
/// first two in the first block, of the others in the second. Every second byte is of no meaning.
const PAIR_OF_CODES: [u8; 32] = {
    let mut bytes = [0; 32];
    let mut i = 0;
    while i < 32 {
        bytes[i] = (i / 16 * 8 + i % 16 / 4 + i % 4 / 2 * 4) as u8;
        i += 1;
    }
    bytes
};

impl Quad for Code {
    const BITS: u32 = CODE_BITS;

    #[inline(always)]
    fn weighed<S: Simd>(simd: S, texels: &[Self], weights: i64, at: i32) -> i32x8<S> {
        let i = at as u32 as usize;
        let Some(run) = texels.get(i..i + LANES) else { return nothing(simd) };
        let codes = u8x32::block_splat(u8x16::from_slice(simd, run.as_flattened()));
        let codes = codes.swizzle_dyn_within_blocks(u8x32::load_array(simd, PAIR_OF_CODES));
        weigh(simd, codes.bitcast::<i16x16<S>>() & 0xff, weights)
    }
}

/// What there is where no texel is: never, since indices are of texels. A branch that is not taken costs less
/// than a choice of what to read.
#[cold]
#[inline(never)]
fn nothing<S: Simd>(simd: S) -> i32x8<S> {
    i32x8::splat(simd, 0)
}

/// Takes the pair of weights on the left four times, then that on the right, out of blocks of both.
const SPREAD: [u8; 32] = {
    let mut bytes = [0; 32];
    let mut i = 0;
    while i < 32 {
        bytes[i] = (i / 16 * 4 + i % 4) as u8;
        i += 1;
    }
    bytes
};

/// The products of pairs of channels and of weights: the weights of two texels side by side are a pair, and so
/// are their channels.
#[inline(always)]
fn weigh<S: Simd>(simd: S, channels: i16x16<S>, weights: i64) -> i32x8<S> {
    let pairs = i64x4::splat(simd, weights).bitcast::<u8x32<S>>();
    let pairs = pairs.swizzle_dyn_within_blocks(u8x32::load_array(simd, SPREAD));
    channels.pairwise_dot_product(pairs.bitcast::<i16x16<S>>())
}

/// The sum of the two blocks of four.
#[inline(always)]
fn fold<S: Simd>(v: i32x8<S>) -> i32x4<S> {
    let (left, right) = v.split();
    left + right
}
