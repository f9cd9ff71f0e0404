//! Squares of 8 × 8 pixels written at once: rows of eight in vectors, none of them looked at apart,
//! since nothing could guess which are covered.
//!
//! Each function has its definition in plain loops beside it, which also runs where there is no
//! choice of instructions.

use super::{GROUP, MIXED};
#[cfg(feature = "std")]
use fearless_simd::{Level, Simd, dispatch, mask32x8, prelude::*, u32x4, u32x8};

/// Pixels along the side of a square.
pub(super) const SIDE: usize = 8;

/// Some rows of a tile, from a pixel on.
pub(super) struct Rows<'a> {
    /// From the square's first pixel on.
    pub(super) keys: &'a mut [u32],
    /// Likewise, with [`GROUP`] samples a pixel.
    pub(super) mixed: &'a mut [[u32; GROUP]],
    /// From row to row.
    pub(super) stride: usize,
}

/// The eight elements from `start` on, if there are so many.
#[inline(always)]
fn chunk<T>(all: &mut [T], start: usize) -> Option<&mut [T; SIDE]> {
    all.get_mut(start..)?.first_chunk_mut()
}

#[cfg(any(test, not(feature = "std")))]
impl Rows<'_> {
    /// Writes `key` where `pixels` has a bit: bit 8·r + c is column c of row r.
    pub(super) fn fill(&mut self, mut pixels: u64, key: u32) {
        let mut start = 0;
        while pixels != 0
            && let Some(seen) = chunk(self.keys, start)
        {
            for (c, seen) in seen.iter_mut().enumerate() {
                *seen = if pixels & 1 << c != 0 { key } else { *seen };
            }
            pixels >>= SIDE;
            start += self.stride;
        }
    }

    /// Writes `key` to samples: bit 4·c + s of `rows[r]` is sample s in column c of row r.
    pub(super) fn cover(&mut self, rows: &[u32; SIDE], key: u32) {
        for (r, row) in rows.iter().enumerate() {
            let start = r * self.stride;
            let (seen, mixed) = (chunk(self.keys, start), chunk(self.mixed, start));
            let (Some(seen), Some(mixed)) = (seen, mixed) else { return };
            for (c, (seen, mixed)) in seen.iter_mut().zip(mixed).enumerate() {
                let bits = row >> (4 * c) & 0xf;
                for (s, sample) in mixed.iter_mut().enumerate() {
                    let below = if *seen == MIXED { *sample } else { *seen };
                    *sample = if bits & 1 << s != 0 { key } else { below };
                }
                let partly = if bits == 0 || *seen == key { *seen } else { MIXED };
                *seen = if bits == 0xf { key } else { partly };
            }
        }
    }
}

#[cfg(feature = "std")]
impl Rows<'_> {
    /// [`Self::fill`] with the instructions of a level.
    pub(super) fn fill_by(&mut self, level: Level, pixels: u64, key: u32) {
        dispatch!(level, simd => self.fill_at(simd, pixels, key));
    }

    #[inline(always)]
    fn fill_at<S: Simd>(&mut self, simd: S, mut pixels: u64, key: u32) {
        let (key, mut start) = (u32x8::splat(simd, key), 0);
        while pixels != 0
            && let Some(seen) = chunk(self.keys, start)
        {
            let below = u32x8::load_array(simd, *seen);
            let covered = mask32x8::from_bitmask(simd, pixels & 0xff);
            *seen = covered.select(key, below).to_array();
            pixels >>= SIDE;
            start += self.stride;
        }
    }

    /// [`Self::cover`] with the instructions of a level.
    pub(super) fn cover_by(&mut self, level: Level, rows: &[u32; SIDE], key: u32) {
        dispatch!(level, simd => self.cover_at(simd, rows, key));
    }

    #[inline(always)]
    fn cover_at<S: Simd>(&mut self, simd: S, rows: &[u32; SIDE], key: u32) {
        let key = u32x8::splat(simd, key);
        let mut start = 0;
        for &row in rows {
            let (seen, mixed) = (chunk(self.keys, start), chunk(self.mixed, start));
            let (Some(seen), Some(mixed)) = (seen, mixed) else { return };
            if row != 0 {
                cover_row(simd, seen, mixed, row, key);
            }
            start += self.stride;
        }
    }
}

/// A row of [`Rows::cover`]. What is stored for a pixel that is not mixed means nothing.
#[cfg(feature = "std")]
#[inline(always)]
fn cover_row<S: Simd>(
    simd: S,
    seen: &mut [u32; SIDE],
    mixed: &mut [[u32; GROUP]; SIDE],
    row: u32,
    key: u32x8<S>,
) {
    let unknown = u32x8::splat(simd, MIXED);
    for (pair, samples) in mixed.as_flattened_mut().as_chunks_mut::<8>().0.iter_mut().enumerate() {
        let [first, second] = [seen[2 * pair], seen[2 * pair + 1]];
        let whole = u32x4::splat(simd, first).combine(u32x4::splat(simd, second));
        let below = whole.simd_eq(unknown).select(u32x8::load_array(simd, *samples), whole);
        let covered = mask32x8::from_bitmask(simd, u64::from(row >> (8 * pair) & 0xff));
        *samples = covered.select(key, below).to_array();
    }
    let places = u32x8::load_array(simd, [0, 4, 8, 12, 16, 20, 24, 28]);
    let bits = (u32x8::splat(simd, row) >> places) & 0xf;
    let below = u32x8::load_array(simd, *seen);
    let same = bits.simd_eq(0) | below.simd_eq(key);
    *seen = bits.simd_eq(0xf).select(key, same.select(below, unknown)).to_array();
}
