//! Quads of sixteen walks, until their texels are read.

use crate::run::ABREAST;
use fearless_simd::{Simd, f32x16, i32x16, prelude::*};

/// Quads of each walk that are weighed before their texels are read: as many as most ellipses of the
/// default have.
pub(super) const QUADS: usize = 24;

/// The beginning of a quad in a row.
#[derive(Clone, Copy)]
pub(super) struct Start<S: Simd> {
    /// The exponent's part from the row; beyond every cut where there is no quad.
    pub(super) e: f32x16<S>,
    /// From the middle of the ellipse in the row to the first texel.
    pub(super) offset: f32x16<S>,
}

/// Memory for [`walk_all`](super::walk_all), made once for a run of pixels.
#[derive(Debug, Default)]
pub(crate) struct Sheet {
    pairs: [Pair; QUADS / 2],
}

/// Two quads of each walk, whose texels are read together. As they are made, a number of all sixteen walks and
/// then the next; turned, all numbers of one walk and then the next's.
#[derive(Debug)]
#[repr(align(64))]
struct Pair {
    /// The weights on the left of the first quad, two in the halves of a number, those on its right, and those of
    /// the second. Of quads that are yet to be weighed, [`Start`]s.
    weights: [i32; 4 * ABREAST],
    /// The index of the first texel of each.
    at: [i32; 2 * ABREAST],
}

impl Default for Pair {
    fn default() -> Self {
        Self { weights: [0; 4 * ABREAST], at: [0; 2 * ABREAST] }
    }
}

impl Sheet {
    #[inline(always)]
    pub(super) fn put<S: Simd>(&mut self, quad: usize, weights: [i32x16<S>; 2], at: i32x16<S>) {
        self.weigh(quad, weights);
        at.store_slice(&mut self.pairs[quad / 2].at.as_chunks_mut::<ABREAST>().0[quad % 2]);
    }

    /// The weights of a quad, in the place of where it begins.
    #[inline(always)]
    pub(super) fn weigh<S: Simd>(&mut self, quad: usize, [left, right]: [i32x16<S>; 2]) {
        let lists = self.pairs[quad / 2].weights.as_chunks_mut::<ABREAST>().0;
        left.store_slice(&mut lists[quad % 2 * 2]);
        right.store_slice(&mut lists[quad % 2 * 2 + 1]);
    }

    /// Where a quad begins, in the place of its weights, and the index of its first texel.
    #[inline(always)]
    pub(super) fn start<S: Simd>(&mut self, quad: usize, start: &Start<S>, at: i32x16<S>) {
        self.put(quad, [start.e.bitcast(), start.offset.bitcast()], at);
    }

    #[inline(always)]
    pub(super) fn started<S: Simd>(&self, simd: S, quad: usize) -> Start<S> {
        let lists = self.pairs[quad / 2].weights.as_chunks::<ABREAST>().0;
        Start {
            e: i32x16::load_array_ref(simd, &lists[quad % 2 * 2]).bitcast(),
            offset: i32x16::load_array_ref(simd, &lists[quad % 2 * 2 + 1]).bitcast(),
        }
    }

    /// Turns so many quads; what is wanting of the last pair is without weight.
    #[inline(always)]
    pub(super) fn turn<S: Simd>(&mut self, simd: S, quads: usize) {
        if quads % 2 == 1 {
            let nothing = i32x16::splat(simd, 0);
            self.put(quads, [nothing, nothing], nothing);
        }
        for Pair { weights, at } in self.pairs.iter_mut().take(quads.div_ceil(2)) {
            turn_four(simd, weights);
            turn_two(simd, at);
        }
    }

    /// So many quads of a walk, two by two: the weights of both, and their indices.
    #[inline(always)]
    pub(super) fn pairs(
        &self,
        quads: usize,
        walk: usize,
    ) -> impl Iterator<Item = (&[i32; 4], &[i32; 2])> {
        self.pairs.iter().take(quads.div_ceil(2)).map(
            #[inline(always)]
            move |Pair { weights, at }| {
                let walk = walk % ABREAST;
                (&weights.as_chunks().0[walk], &at.as_chunks().0[walk])
            },
        )
    }
}

/// Puts side by side what four lists have in the same place.
#[inline(always)]
fn turn_four<S: Simd>(simd: S, lanes: &mut [i32; 4 * ABREAST]) {
    let [a, b, c, d] = lanes.as_chunks_mut::<ABREAST>().0 else { return };
    let first = i32x16::load_array_ref(simd, a).interleave(i32x16::load_array_ref(simd, c));
    let second = i32x16::load_array_ref(simd, b).interleave(i32x16::load_array_ref(simd, d));
    let (low, high) = (first.0.interleave(second.0), first.1.interleave(second.1));
    low.0.store_slice(a);
    low.1.store_slice(b);
    high.0.store_slice(c);
    high.1.store_slice(d);
}

/// The same of two lists.
#[inline(always)]
fn turn_two<S: Simd>(simd: S, lanes: &mut [i32; 2 * ABREAST]) {
    let [a, b] = lanes.as_chunks_mut::<ABREAST>().0 else { return };
    let (low, high) = i32x16::load_array_ref(simd, a).interleave(i32x16::load_array_ref(simd, b));
    low.store_slice(a);
    high.store_slice(b);
}
