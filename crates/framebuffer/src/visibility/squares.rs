//! Squares of 8 × 8 pixels written at once: rows of eight in vectors, none of them looked at apart,
//! since nothing could guess which are covered.
//!
//! Each function has its definition in plain loops beside it, which also runs where there is no
//! choice of instructions.

use super::{GROUP, MIXED};
#[cfg(feature = "std")]
use fearless_simd::{Level, Simd, dispatch, mask32x8, mask32x16, prelude::*, u32x8, u32x16};

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

    /// Writes `key` to samples: bit 4·c + s of `rows[r]`, if it is `within`, is sample s in column c of
    /// row r.
    pub(super) fn cover(&mut self, rows: &[u32; SIDE], within: u32, key: u32) {
        for (r, row) in rows.iter().map(|row| row & within).enumerate() {
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
    pub(super) fn cover_by(&mut self, level: Level, rows: &[u32; SIDE], within: u32, key: u32) {
        dispatch!(level, simd => self.cover_at(simd, rows, within, key));
    }

    #[inline(always)]
    fn cover_at<S: Simd>(&mut self, simd: S, rows: &[u32; SIDE], within: u32, key: u32) {
        let mut start = 0;
        // One by one, as they were written: all of them at once would have to wait for the last.
        for &row in rows {
            let (seen, mixed) = (chunk(self.keys, start), chunk(self.mixed, start));
            let (Some(seen), Some(mixed)) = (seen, mixed) else { return };
            let row = row & within;
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
    key: u32,
) {
    let below = u32x8::load_array(simd, *seen);
    let [first, last] = [row & 0xffff, row >> 16];
    // Each pixel's key twice, then for each of its samples.
    let both = below.combine(below);
    let twice = both.zip_low(both);
    if let [left, right] = mixed.as_flattened_mut().as_chunks_mut::<16>().0 {
        cover_samples(simd, left, twice.zip_low(twice), first, key);
        cover_samples(simd, right, twice.zip_high(twice), last, key);
    }
    let key = u32x8::splat(simd, key);
    let places = u32x8::load_array(simd, [0, 4, 8, 12, 16, 20, 24, 28]);
    let bits = (u32x8::splat(simd, row) >> places) & 0xf;
    let same = bits.simd_eq(0) | below.simd_eq(key);
    let partly = same.select(below, u32x8::splat(simd, MIXED));
    *seen = bits.simd_eq(0xf).select(key, partly).to_array();
}

/// The samples of four pixels, of which `whole` has the pixels' own keys.
#[cfg(feature = "std")]
#[inline(always)]
fn cover_samples<S: Simd>(simd: S, samples: &mut [u32; 16], whole: u32x16<S>, bits: u32, key: u32) {
    let unknown = whole.simd_eq(u32x16::splat(simd, MIXED));
    let below = unknown.select(u32x16::load_array(simd, *samples), whole);
    let covered = mask32x16::from_bitmask(simd, u64::from(bits));
    *samples = covered.select(u32x16::splat(simd, key), below).to_array();
}
