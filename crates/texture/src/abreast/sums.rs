//! The sums of texels by their weights, walk by walk.

use super::sheet::{QUADS, Sheet};
use crate::batch::lanes;
use crate::run::ABREAST;
use crate::store::{CODE_BITS, Code, Whole};
use crate::texel::Texel;
use crate::walk::{LANES, mean};
use crate::walk_simd::{PAIR, four_times};
use fearless_simd::{Simd, i16x16, i16x32, i32x4, i32x16, prelude::*, u8x16, u8x64};

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
                    for (sum, own) in sums[i].iter_mut().zip(own) {
                        *sum += own;
                    }
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
    fold(weighed(simd, texels, sheet, quads, walk)) << T::BITS
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
    let own = weighed(simd, texels, sheet, quads, walk);
    let (high, low) = (fold(own >> 12).to_array(), fold(own & 0xfff).to_array());
    let unit = f64::from(1 << T::BITS);
    let mut sum = [0.0; 4];
    for c in 0..4 {
        sum[c] = (f64::from(high[c]) * 4096.0 + f64::from(low[c])) * unit;
    }
    sum
}

/// Σ w·t of so many quads of a walk: of each channel the sums of every fourth pair of texels, in every fourth
/// lane.
///
/// Of all that a sheet holds these are sure to fit 31 bits: twelve pairs of weights of at most 2¹², of texels
/// below 2¹⁴·⁴.
#[inline(always)]
fn weighed<S: Simd, T: Quad>(
    simd: S,
    texels: &[T],
    sheet: &Sheet,
    quads: usize,
    walk: usize,
) -> i32x16<S> {
    const { assert!(QUADS * 2 / 4 <= 12) };
    let mut own = i32x16::splat(simd, 0);
    for (weights, at) in sheet.pairs(quads, walk) {
        let (Some(first), Some(second)) = (quad(texels, at[0]), quad(texels, at[1])) else {
            return i32x16::load_array(simd, astray(texels, sheet, quads, walk));
        };
        let pairs = T::both(simd, first, second);
        let pairs = pairs.swizzle_dyn_within_blocks(u8x64::load_array_ref(simd, &PAIR));
        let weights = four_times(simd, i32x4::load_array_ref(simd, weights));
        own += pairs.pairwise_dot_product(weights.bitcast::<i16x32<S>>());
    }
    own
}

/// [`weighed`] where an index is not of a texel, and the quad counts for nothing. That is never so; but a call
/// that came back to the loop would take the sums out of their register in every round.
#[cold]
#[inline(never)]
fn astray<T: Quad>(texels: &[T], sheet: &Sheet, quads: usize, walk: usize) -> [i32; 16] {
    let mut own = [0; 16];
    for (weights, at) in sheet.pairs(quads, walk) {
        for (q, at) in at.iter().enumerate() {
            let Some(run) = quad(texels, *at) else { continue };
            for (pair, texels) in run.as_chunks::<2>().0.iter().enumerate() {
                let weights = weights[q * 2 + pair];
                let own = &mut own.as_chunks_mut::<4>().0[q * 2 + pair];
                for (texel, weight) in texels.iter().zip([i32::from(weights as i16), weights >> 16])
                {
                    for (sum, number) in own.iter_mut().zip(texel.numbers()) {
                        *sum += weight * number;
                    }
                }
            }
        }
    }
    own
}

/// The texels of a quad, from a place on.
#[inline(always)]
fn quad<T>(texels: &[T], at: i32) -> Option<&[T; LANES]> {
    let i = at as u32 as usize;
    texels.get(i..i + LANES)?.first_chunk()
}

/// A texel of which four of a row are read together.
trait Quad: Copy {
    /// Steps of its unit, as a power of two.
    const BITS: u32;

    /// The channels of two quads.
    fn both<S: Simd>(simd: S, first: &[Self; LANES], second: &[Self; LANES]) -> i16x32<S>;

    /// Its own.
    fn numbers(&self) -> [i32; 4];
}

impl Quad for Texel {
    const BITS: u32 = 0;

    #[inline(always)]
    fn both<S: Simd>(simd: S, first: &[Self; LANES], second: &[Self; LANES]) -> i16x32<S> {
        let first = i16x16::from_slice(simd, first.as_flattened());
        first.combine(i16x16::from_slice(simd, second.as_flattened()))
    }

    #[inline(always)]
    fn numbers(&self) -> [i32; 4] {
        self.map(i32::from)
    }
}

impl Quad for Code {
    const BITS: u32 = CODE_BITS;

    #[inline(always)]
    fn both<S: Simd>(simd: S, first: &[Self; LANES], second: &[Self; LANES]) -> i16x32<S> {
        let first = u8x16::from_slice(simd, first.as_flattened());
        let (low, high) = first.combine(u8x16::from_slice(simd, second.as_flattened())).widen();
        low.combine(high).bitcast()
    }

    #[inline(always)]
    fn numbers(&self) -> [i32; 4] {
        self.map(i32::from)
    }
}

/// The sum of the four blocks of four.
#[inline(always)]
fn fold<S: Simd>(v: i32x16<S>) -> i32x4<S> {
    let (low, high) = v.split();
    let (left, right) = (low + high).split();
    left + right
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::abreast::pair;
    use fearless_simd::{Level, dispatch, f32x16};
    use proptest::prelude::*;

    /// Whether the sums of a sheet of quads, by their weights and indices, are what they come to one by one.
    fn check<S: Simd, T: Quad>(simd: S, texels: &[T], quads: &[([f32; 4], i32)]) -> bool {
        let mut sheet = Sheet::default();
        for (i, (weights, at)) in quads.iter().enumerate() {
            // Each walk has its own, which begin one after the other.
            let [a, b, c, d] = weights.map(|w| f32x16::splat(simd, w));
            let lanes: [i32; ABREAST] = core::array::from_fn(|walk| at + walk as i32);
            let weights = [pair(simd, a, b), pair(simd, c, d)];
            sheet.put(i, weights, i32x16::load_array(simd, lanes));
        }
        sheet.turn(simd, quads.len());
        (0..ABREAST).all(|walk| {
            let mut sums = [0i64; 4];
            for (weights, at) in quads {
                let first = (at + walk as i32) as u32 as usize;
                let run = texels.get(first..first + LANES).unwrap_or_default();
                for (texel, weight) in run.iter().zip(weights) {
                    let numbers = texel.numbers();
                    (0..4).for_each(|c| sums[c] += *weight as i64 * i64::from(numbers[c]));
                }
            }
            let sum = |lanes: [i32; 16], c: usize| -> i64 {
                (0..4).map(|block| i64::from(lanes[block * 4 + c])).sum()
            };
            let found = weighed(simd, texels, &sheet, quads.len(), walk).to_array();
            let slow = astray(texels, &sheet, quads.len(), walk);
            let unit = f64::from(1 << T::BITS);
            let large = large(simd, texels, &sheet, quads.len(), walk);
            (0..4).all(|c| {
                sum(found, c) == sums[c]
                    && sum(slow, c) == sums[c]
                    && large[c] == sums[c] as f64 * unit
            })
        })
    }

    #[test]
    fn a_sheet_of_the_largest_weights_and_texels_fits() {
        let (steps, codes) = ([[20_400; 4]; 68], [[255; 4]; 68]);
        let quads = [([4096.0; 4], 0); QUADS];
        dispatch!(Level::new(), simd => {
            assert!(check::<_, Texel>(simd, &steps, &quads));
            assert!(check::<_, Code>(simd, &codes, &quads));
        });
    }

    proptest! {
        /// Quads of any weights, one of which may lie beyond the texels.
        #[test]
        fn sums_are_those_of_the_weights_and_texels(
            quads in prop::collection::vec((prop::array::uniform4(-300i16..=4096), 0i32..48), 1..=QUADS),
            seed in any::<u32>(),
            astray in prop::option::of(0usize..QUADS),
        ) {
            let number = |i: usize| (seed ^ i as u32).wrapping_mul(0x9e37_79b9) >> 16;
            let steps: Vec<Texel> =
                (0..68).map(|i| core::array::from_fn(|c| (number(i * 4 + c) % 20_401) as i16)).collect();
            let codes: Vec<Code> =
                (0..68).map(|i| core::array::from_fn(|c| number(i * 4 + c) as u8)).collect();
            let mut quads: Vec<_> =
                quads.iter().map(|(weights, at)| (weights.map(f32::from), *at)).collect();
            if let Some(i) = astray.filter(|i| *i < quads.len()) {
                quads[i].1 = 1 << 20;
            }
            for level in [Level::new(), Level::baseline()] {
                prop_assert!(dispatch!(level, simd => check(simd, &steps, &quads)));
                prop_assert!(dispatch!(level, simd => check(simd, &codes, &quads)));
            }
        }
    }
}
