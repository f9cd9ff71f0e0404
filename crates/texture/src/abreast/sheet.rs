//! Quads of sixteen walks, until their texels are read.

use super::QUADS;
use crate::run::ABREAST;
use fearless_simd::{Simd, f32x16, i32x16, i64x8, prelude::*};

/// The beginning of a quad in a row.
#[derive(Clone, Copy)]
pub(super) struct Start<S: Simd> {
    /// The exponent's part from the row; beyond every cut where there is no quad.
    pub(super) e: f32x16<S>,
    /// From the middle of the ellipse in the row to the first texel.
    pub(super) offset: f32x16<S>,
}

/// Memory for [`walk_all`](super::walk_all), made once for a run of pixels: by quad and then by lane.
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
    pub(super) fn put<S: Simd>(
        &mut self,
        quad: usize,
        [left, right]: [i32x16<S>; 2],
        at: i32x16<S>,
    ) {
        self.weigh(quad, [left, right]);
        self.at[quad] = at.to_array();
    }

    /// The weights of a quad, in the place of where it begins.
    #[inline(always)]
    pub(super) fn weigh<S: Simd>(&mut self, quad: usize, [left, right]: [i32x16<S>; 2]) {
        let (first, second) = left.interleave(right);
        self.keep(quad, [first.bitcast(), second.bitcast()]);
    }

    /// Where a quad begins, in the place of its weights, and the index of its first texel.
    #[inline(always)]
    pub(super) fn start<S: Simd>(&mut self, quad: usize, start: &Start<S>, at: i32x16<S>) {
        self.keep(quad, [start.e.bitcast(), start.offset.bitcast()]);
        self.at[quad] = at.to_array();
    }

    #[inline(always)]
    pub(super) fn started<S: Simd>(&self, simd: S, quad: usize) -> Start<S> {
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
    pub(super) fn quads(&self, quads: usize, walk: usize) -> impl Iterator<Item = (i64, i32)> {
        self.weights[..quads.min(QUADS)].iter().zip(&self.at).map(
            #[inline(always)]
            move |(weights, at)| (weights[walk], at[walk]),
        )
    }
}
