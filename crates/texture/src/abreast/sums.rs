//! The sums of texels by their weights, walk by walk.

use super::QUADS;
use super::sheet::Sheet;
use crate::batch::lanes;
use crate::run::ABREAST;
use crate::store::{CODE_BITS, Code, Whole};
use crate::texel::Texel;
use crate::walk::{LANES, mean};
use crate::walk_simd::PAIR;
use fearless_simd::{Simd, i16x16, i32x4, i32x8, i64x4, prelude::*, u8x16, u8x32};

/// The means of walks of which all quads stand in the sheet, and whose sums fit 31 bits.
#[inline(always)]
pub(super) fn finish_small<S: Simd>(
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

/// Σ w·t of each walk.
#[expect(clippy::large_enum_variant, reason = "it lives on the stack, for a moment")]
pub(super) enum Sums {
    /// Where they are sure to fit 31 bits.
    Small([[i32; 4]; ABREAST]),
    /// Whole numbers below 2⁵³.
    Large([[f64; 4]; ABREAST]),
}

impl Sums {
    /// Adds so many quads of each walk.
    #[inline(always)]
    pub(super) fn gather<S: Simd>(
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
    pub(super) fn finish<S: Simd>(
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
