//! Sixteen walks abreast: a lane for each, row by row. The same whole numbers as in [`crate::walk`].
//!
//! Neighbouring pixels have ellipses of nearly the same shape. So row r of all sixteen is weighed at
//! once, with the walks' own numbers in lanes and nothing to be spread over them; and then each walk
//! reads its texels, all with the same count of quads, so that the processor foresees every branch.

use crate::level::Level;
use crate::walk::{LANES, Walk, mean};
use crate::walk_simd::{EXPAND, PAIR, walk};
use crate::{Texture, gaussian};
use fearless_simd::{Simd, f32x16, f64x4, i16x16, i16x32, i32x4, i32x8, i32x16, prelude::*, u8x32};

/// How many.
pub(crate) const ABREAST: usize = 16;

/// Quads of each walk that are weighed before their texels are read: as many as most ellipses of the
/// default have. More take longer to clear for each run of pixels.
const QUADS: usize = 24;

/// An exponent beyond every cut.
pub(crate) const NOTHING: f32 = 16.0;

/// Whether and how a lane is walked.
pub(crate) const IDLE: i32 = 0;
pub(crate) const ALONE: i32 = 1;
pub(crate) const TOGETHER: i32 = 2;

/// [`Walk`]s, by field, and what they need to know of their levels.
#[derive(Debug, Default)]
pub(crate) struct Walks {
    pub(crate) how: [i32; ABREAST],
    pub(crate) level: [u32; ABREAST],
    pub(crate) stride: [i32; ABREAST],
    /// [`Level::base`].
    pub(crate) base: [i32; ABREAST],
    pub(crate) mask_x: [i32; ABREAST],
    pub(crate) mask_y: [i32; ABREAST],
    pub(crate) x0: [i32; ABREAST],
    pub(crate) y0: [i32; ABREAST],
    pub(crate) fx: [f32; ABREAST],
    pub(crate) fy: [f32; ABREAST],
    pub(crate) slope: [f32; ABREAST],
    pub(crate) row_scale: [f32; ABREAST],
    pub(crate) run_scale: [f32; ABREAST],
    pub(crate) row_width: [f32; ABREAST],
    pub(crate) run_width: [f32; ABREAST],
    pub(crate) groups: [i32; ABREAST],
    pub(crate) small: [i32; ABREAST],
    pub(crate) cut: f32,
}

impl Walks {
    /// Makes one of them `w`; whether it is walked at all is left as it is.
    #[inline(always)]
    pub(crate) fn set(&mut self, i: usize, w: &Walk) {
        self.x0[i] = w.x0;
        self.y0[i] = w.y0;
        self.fx[i] = w.fx;
        self.fy[i] = w.fy;
        self.slope[i] = w.slope;
        self.row_scale[i] = w.row_scale;
        self.run_scale[i] = w.run_scale;
        self.row_width[i] = w.row_width;
        self.run_width[i] = w.run_width;
        self.groups[i] = w.groups;
        self.small[i] = w.small;
    }

    /// One of them.
    #[inline(always)]
    pub(crate) fn get(&self, i: usize) -> Walk {
        Walk {
            x0: self.x0[i],
            y0: self.y0[i],
            fx: self.fx[i],
            fy: self.fy[i],
            slope: self.slope[i],
            row_scale: self.row_scale[i],
            run_scale: self.run_scale[i],
            row_width: self.row_width[i],
            run_width: self.run_width[i],
            cut: self.cut,
            groups: self.groups[i],
            inside: i32::from(self.how[i] == TOGETHER),
            small: self.small[i],
        }
    }
}

/// Memory for [`walk_all`], made once for a run of pixels: by quad and then by lane.
#[derive(Debug)]
pub(crate) struct Sheet {
    /// Four weights of 16 bits, in two pairs.
    weights: [[i32; 2 * ABREAST]; QUADS],
    /// The index of the first texel.
    at: [[i32; ABREAST]; QUADS],
}

impl Default for Sheet {
    fn default() -> Self {
        Self { weights: [[0; 2 * ABREAST]; QUADS], at: [[0; ABREAST]; QUADS] }
    }
}

/// The colours of the walks that are not idle.
#[inline(always)]
pub(crate) fn walk_all<S: Simd>(
    simd: S,
    t: &Texture,
    walks: &Walks,
    sheet: &mut Sheet,
    out: &mut [[f32; 4]; ABREAST],
) {
    together(simd, t, walks, sheet, out);
    for i in (0..ABREAST).filter(|i| walks.how[*i] == ALONE) {
        let level = &t.levels[walks.level[i] as usize];
        out[i] = simd.vectorize(
            #[inline(always)]
            || walk(simd, level, t.wrap, &walks.get(i)),
        );
    }
}

/// The colours of the walks that go together.
#[inline(always)]
fn together<S: Simd>(
    simd: S,
    t: &Texture,
    walks: &Walks,
    sheet: &mut Sheet,
    out: &mut [[f32; 4]; ABREAST],
) {
    let weigher = Weigher::new(simd, walks);
    let (mut most, mut small) = (0, true);
    for i in 0..ABREAST {
        let goes = walks.how[i] == TOGETHER;
        most = most.max(if goes { walks.groups[i] } else { 0 });
        small &= !goes | (walks.small[i] != 0);
    }
    let mut totals = i32x16::splat(simd, 0);
    let mut sums = [[0.0; 4]; ABREAST];
    let mut used = 0;
    for group in 0..most {
        let rows = weigher.rows(simd, walks, group);
        let count = rows.count.to_array().into_iter().fold(0, i32::max);
        for r in 0..count {
            let (weights, at) = (&mut sheet.weights[used], &mut sheet.at[used]);
            *at = weigher.row(simd, walks, &rows, [group, r], weights, &mut totals).to_array();
            used += 1;
            if used == QUADS {
                gather(simd, t, walks, sheet, used, small, &mut sums);
                used = 0;
            }
        }
    }
    gather(simd, t, walks, sheet, used, small, &mut sums);
    let totals = totals.to_array();
    for i in (0..ABREAST).filter(|i| walks.how[*i] == TOGETHER) {
        out[i] = match totals[i] {
            total if total > 0 => mean(sums[i], total),
            _ => walks.get(i).centre(&t.levels[walks.level[i] as usize], t.wrap),
        };
    }
}

/// What the rows of sixteen walks have in common.
struct Weigher<S: Simd> {
    fx: f32x16<S>,
    fy: f32x16<S>,
    slope: f32x16<S>,
    row_scale: f32x16<S>,
    run_scale: f32x16<S>,
    run_width: f32x16<S>,
    x1: i32x16<S>,
    cut: f32x16<S>,
    zero: f32x16<S>,
}

/// The rows that have a quad of a number.
struct Rows<S: Simd> {
    first: f32x16<S>,
    count: i32x16<S>,
}

impl<S: Simd> Weigher<S> {
    #[inline(always)]
    fn new(simd: S, w: &Walks) -> Self {
        Self {
            fx: floats(simd, &w.fx),
            fy: floats(simd, &w.fy),
            slope: floats(simd, &w.slope),
            row_scale: floats(simd, &w.row_scale),
            run_scale: floats(simd, &w.run_scale),
            run_width: floats(simd, &w.run_width),
            x1: wholes(simd, &w.x0) + 1,
            cut: f32x16::splat(simd, w.cut),
            zero: f32x16::splat(simd, 0.0),
        }
    }

    /// [`Walk::rows`]; none of those that do not walk together.
    #[inline(always)]
    fn rows(&self, simd: S, w: &Walks, group: i32) -> Rows<S> {
        let before = (LANES / 2) as f32 * group as f32;
        let left = (self.cut - self.run_scale * (before * before)).max(self.zero);
        let reach = (left * floats(simd, &w.row_width)).sqrt();
        let first = -(reach - self.fy).floor();
        let last = (reach + self.fy).floor();
        let count = (last - first).to_int::<i32x16<S>>() + 1;
        let how = wholes(simd, &w.how);
        let groups = wholes(simd, &w.groups);
        let none = i32x16::splat(simd, 0);
        let count = how.simd_eq(TOGETHER).select(count, none);
        Rows { first, count: groups.simd_gt(group).select(count, none) }
    }

    /// The weights of a quad in a row of each walk, and the index of its first texel.
    #[inline(always)]
    fn row(
        &self,
        simd: S,
        w: &Walks,
        rows: &Rows<S>,
        [group, r]: [i32; 2],
        weights: &mut [i32; 2 * ABREAST],
        totals: &mut i32x16<S>,
    ) -> i32x16<S> {
        let j = rows.first + r as f32;
        let dv = j - self.fy;
        let e = (dv * dv) * self.row_scale;
        let half = ((self.cut - e).max(self.zero) * self.run_width).sqrt();
        let low = (dv * self.slope + self.fx) - half;
        let before = low.floor();
        let shift = LANES as i32 * group;
        let offset = (f32x16::splat(simd, shift as f32 + 1.0) - half) - (low - before);
        let live = rows.count.simd_gt(r);
        let e = live.select(e, f32x16::splat(simd, NOTHING));
        // The rounder has nothing in the low half of its bits.
        let left = self.column(simd, e, offset) & 0xffff;
        let left = left | (self.column(simd, e, offset + 1.0) << 16);
        let right = self.column(simd, e, offset + 2.0) & 0xffff;
        let right = right | (self.column(simd, e, offset + 3.0) << 16);
        let both = (left + right).bitcast::<i16x32<S>>();
        *totals += both.pairwise_dot_product(i16x32::splat(simd, 1));
        let (low, high) = weights.split_at_mut(ABREAST);
        left.zip_low(right).store_slice(low);
        left.zip_high(right).store_slice(high);
        // After the masks, every sum here is an index of a texel, and fits 31 bits.
        let y = (j.to_int::<i32x16<S>>() + wholes(simd, &w.y0)) & wholes(simd, &w.mask_y);
        let x = (before.to_int::<i32x16<S>>() + self.x1 + shift) & wholes(simd, &w.mask_x);
        let at = y * wholes(simd, &w.stride) + x - wholes(simd, &w.base);
        live.select(at, i32x16::splat(simd, 0))
    }

    /// The weights, in the low halves of the lanes, of the texels that lie so far from the middle of
    /// their rows.
    #[inline(always)]
    fn column(&self, simd: S, e: f32x16<S>, dx: f32x16<S>) -> i32x16<S> {
        gaussian::weight_bits(simd, e + self.run_scale * (dx * dx), self.cut)
    }
}

/// Numbers in lanes.
#[inline(always)]
fn floats<S: Simd>(simd: S, numbers: &[f32; ABREAST]) -> f32x16<S> {
    f32x16::load_array_ref(simd, numbers)
}

/// Numbers in lanes.
#[inline(always)]
fn wholes<S: Simd>(simd: S, numbers: &[i32; ABREAST]) -> i32x16<S> {
    i32x16::load_array_ref(simd, numbers)
}

/// Adds so many quads of each walk to its sums.
#[inline(always)]
fn gather<S: Simd>(
    simd: S,
    t: &Texture,
    walks: &Walks,
    sheet: &Sheet,
    quads: usize,
    small: bool,
    sums: &mut [[f64; 4]; ABREAST],
) {
    let weights = &sheet.weights[..quads.min(QUADS)];
    for i in (0..ABREAST).filter(|i| walks.how[*i] == TOGETHER) {
        let level = &t.levels[walks.level[i] as usize];
        let mut own = Sums::new(simd);
        if small {
            for (weights, at) in weights.iter().zip(&sheet.at) {
                own.add(simd, level, [weights[2 * i], weights[2 * i + 1]], at[i]);
            }
        } else {
            let at = sheet.at.chunks(Sums::<S>::ROOM);
            for (weights, at) in weights.chunks(Sums::<S>::ROOM).zip(at) {
                for (weights, at) in weights.iter().zip(at) {
                    own.add(simd, level, [weights[2 * i], weights[2 * i + 1]], at[i]);
                }
                own.settle(simd);
            }
        }
        own.add_to(&mut sums[i]);
    }
}

/// Σ w·t of the channels, those of every second texel apart.
struct Sums<S: Simd> {
    /// Of at most [`Sums::ROOM`] quads, or of any number if the walk is small.
    texels: i32x8<S>,
    /// What came before them: the bits from 12 on, and those below.
    high: i32x8<S>,
    low: i32x8<S>,
}

impl<S: Simd> Sums<S> {
    /// Quads whose sums are sure to fit 31 bits: in each lane two weights of at most 2¹² times texels
    /// below 2¹⁴·⁴ each.
    const ROOM: usize = 12;

    #[inline(always)]
    fn new(simd: S) -> Self {
        let zero = i32x8::splat(simd, 0);
        Self { texels: zero, high: zero, low: zero }
    }

    /// Adds four texels of a row by their weights.
    #[inline(always)]
    fn add(&mut self, simd: S, level: &Level, [left, right]: [i32; 2], at: i32) {
        let i = at as u32 as usize;
        let run = level.texels.get(i..i + LANES).unwrap_or(&[[0; 4]; LANES]);
        let texels = i16x16::from_slice(simd, run.as_flattened());
        // The weights of two texels side by side are a pair; so are, after this, their channels.
        let texels = texels.swizzle_dyn_within_blocks(half(simd, &PAIR));
        let pairs = u64::from(left as u32) | u64::from(right as u32) << 32;
        let pairs = f64x4::splat(simd, f64::from_bits(pairs)).bitcast::<i16x16<S>>();
        let pairs = pairs.swizzle_dyn_within_blocks(half(simd, &EXPAND));
        self.texels += texels.pairwise_dot_product(pairs);
    }

    /// Makes room for as many quads again.
    #[inline(always)]
    fn settle(&mut self, simd: S) {
        self.high += self.texels >> 12;
        self.low += self.texels & 0xfff;
        self.texels = i32x8::splat(simd, 0);
    }

    /// Adds them to sums that hold whole numbers below 2⁵³.
    #[inline(always)]
    fn add_to(self, sums: &mut [f64; 4]) {
        let (high, low) = (fold(self.high).to_array(), fold(self.low + self.texels).to_array());
        for c in 0..4 {
            sums[c] += f64::from(high[c]) * 4096.0 + f64::from(low[c]);
        }
    }
}

/// The sum of the two blocks of four.
#[inline(always)]
fn fold<S: Simd>(v: i32x8<S>) -> i32x4<S> {
    let (left, right) = v.split();
    left + right
}

/// The first half of a table.
#[inline(always)]
fn half<S: Simd>(simd: S, table: &[u8; 64]) -> u8x32<S> {
    u8x32::from_slice(simd, &table[..32])
}
