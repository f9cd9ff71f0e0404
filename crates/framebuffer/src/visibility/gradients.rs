//! Rows of colours that change evenly: a stretch of one key at a time, evaluated and encoded in the
//! same go, sixteen pixels side by side.

use super::{GROUP, Visibility, encode_mixed, mixed_bits};
use crate::Gradient;
use crate::samples::{mean, mean4};
#[cfg(feature = "std")]
use fearless_simd::{Simd, dispatch, f32x4, f32x16, i32x16, prelude::*, u32x16};
use scumble_pixel::{Premul, WorkingSpace};

/// Pixels that are looked at together: one for each bit of a word.
const WORD: usize = 64;

/// Pixels that are evaluated side by side. A stretch may write as many beyond its end.
const LANES: usize = 16;

/// Room for the codes of a word.
type Codes = [[u8; 4]; WORD + LANES];

/// Where the colours of a row come from, and where they go. (It is looked at where it is: a copy would
/// read more at once than was written at once, and so have to wait for all that was written before.)
struct Row<'a> {
    y: u32,
    gradients: &'a [Gradient],
    space: WorkingSpace,
}

impl<'a> Row<'a> {
    /// What a key stands for. (Not a branch: what keys follow each other nothing could guess.)
    #[inline(always)]
    fn gradient(&self, key: u32) -> &'a Gradient {
        &self.gradients[(key as usize).min(self.gradients.len() - 1)]
    }

    #[inline(always)]
    fn color(&self, key: u32, x: u32) -> Premul {
        self.gradient(key).at(x, self.y)
    }
}

/// Encodes the stretches of one key in a word.
trait Stretches: Copy {
    /// Which pixels have another key than the one before, as bits; bit 0 means nothing.
    fn changes(self, keys: &[u32]) -> u64;

    /// The pixels from column `x` of the tile on, as many as the codes without [`LANES`] at the end,
    /// where anything may be written.
    fn encode(self, row: &Row<'_>, key: u32, x: u32, codes: &mut [[u8; 4]]);

    /// The mean of four keys' colours in column `x` of the tile.
    fn mean(self, row: &Row<'_>, keys: [u32; GROUP], x: u32) -> Premul;
}

impl Visibility {
    /// The pixels of a row where every key stands for a gradient, encoded to straight 8-bit sRGB;
    /// as many as both `out` and the row have. Keys beyond the gradients stand for the last of them,
    /// of which there must be one.
    ///
    /// The bytes are those of [`shade_row`](Self::shade_row) and [`encode_row`](crate::encode_row).
    pub fn encode_gradients(
        &self,
        y: u32,
        gradients: &[Gradient],
        space: WorkingSpace,
        out: &mut [[u8; 4]],
    ) {
        if gradients.is_empty() {
            return;
        }
        let row = Row { y, gradients, space };
        #[cfg(feature = "std")]
        dispatch!(self.level.0, simd => self.encode_stretches(&row, Vectors(simd), out));
        #[cfg(not(feature = "std"))]
        self.encode_stretches(&row, Plain, out);
    }

    #[inline(always)]
    fn encode_stretches(&self, row: &Row<'_>, by: impl Stretches, out: &mut [[u8; 4]]) {
        let (start, keys) = self.keys(row.y);
        let mut codes: Codes = [[0; 4]; WORD + LANES];
        for (first, (keys, out)) in
            (0..).step_by(WORD).zip(keys.chunks(WORD).zip(out.chunks_mut(WORD)))
        {
            let len = keys.len().min(out.len());
            let begins = by.changes(keys) | 1;
            let mixed = if self.groups == 0 { 0 } else { mixed_bits(keys, keys.len()) };
            let mut rest = begins & !mixed;
            while rest != 0 {
                let x = rest.trailing_zeros() as usize;
                rest &= rest - 1;
                // The next stretch begins at a bit above this one, or the row ends.
                let next = (begins & (u64::MAX - 1) << x).trailing_zeros() as usize;
                let end = next.min(keys.len());
                by.encode(row, keys[x], (first + x) as u32, &mut codes[x..end + LANES]);
            }
            if mixed != 0 {
                self.encode_means(row, by, (start + first, first), mixed, &mut codes);
            }
            out[..len].copy_from_slice(&codes[..len]);
        }
    }

    /// The mixed ones of up to 64 pixels, the first of which has a place in the tile and a column.
    #[inline(always)]
    fn encode_means(
        &self,
        row: &Row<'_>,
        by: impl Stretches,
        (start, first): (usize, usize),
        mixed: u64,
        codes: &mut Codes,
    ) {
        if self.groups == 1 && self.samples == GROUP {
            // The most common number deserves a way of its own.
            let mean = |x: usize| by.mean(row, self.mixed[start + x], (first + x) as u32);
            return encode_mixed(mixed, row.space, codes, mean);
        }
        let mut samples = [Premul::TRANSPARENT; 64];
        encode_mixed(mixed, row.space, codes, |x| {
            let keys = self.samples_of(start + x);
            for (sample, &key) in samples.iter_mut().zip(keys) {
                *sample = row.color(key, (first + x) as u32);
            }
            mean(&samples[..keys.len()])
        });
    }
}

/// The definition.
#[derive(Clone, Copy)]
struct Plain;

impl Stretches for Plain {
    fn changes(self, keys: &[u32]) -> u64 {
        let changed = (1..).zip(keys.iter().zip(&keys[1..]));
        changed.fold(0, |bits, (i, (before, key))| bits | u64::from(before != key) << i)
    }

    #[inline(never)]
    fn encode(self, row: &Row<'_>, key: u32, x: u32, codes: &mut [[u8; 4]]) {
        let len = codes.len() - LANES;
        let mut colors = [Premul::TRANSPARENT; WORD];
        for (color, x) in colors[..len].iter_mut().zip(x..) {
            *color = row.color(key, x);
        }
        row.space.export_row(&colors[..len], &mut codes[..len]);
    }

    fn mean(self, row: &Row<'_>, [a, b, c, d]: [u32; GROUP], x: u32) -> Premul {
        mean4([row.color(a, x), row.color(b, x), row.color(c, x), row.color(d, x)])
    }
}

/// The same in vectors, where the colour is opaque and encoded already.
#[cfg(feature = "std")]
#[derive(Clone, Copy)]
struct Vectors<S: Simd>(S);

#[cfg(feature = "std")]
impl<S: Simd> Stretches for Vectors<S> {
    #[inline(always)]
    fn changes(self, keys: &[u32]) -> u64 {
        let (mut bits, mut at) = (0, 1);
        while at < keys.len() {
            // The last are those that end the row, and were looked at in part.
            let from = at.min((keys.len() - 1).saturating_sub(LANES - 1).max(1));
            let (Some(before), Some(here)) = (chunk(keys, from - 1), chunk(keys, from)) else {
                return Plain.changes(keys);
            };
            let before = u32x16::load_array(self.0, *before);
            let same = u32x16::load_array(self.0, *here).simd_eq(before);
            bits |= (!same.to_bitmask() & 0xffff) << from;
            at += LANES;
        }
        bits
    }

    #[inline(always)]
    fn encode(self, row: &Row<'_>, key: u32, x: u32, codes: &mut [[u8; 4]]) {
        let gradient = row.gradient(key);
        if row.space != WorkingSpace::Srgb || !gradient.is_plain {
            return Plain.encode(row, key, x, codes);
        }
        let len = codes.len() - LANES;
        let line = Line::new(self.0, gradient, row.y);
        let mut columns = line.columns(x);
        let mut at = 0;
        while at < len
            && let Some(codes) = codes[at..].first_chunk_mut()
        {
            line.encode(columns, codes);
            columns += LANES as i32;
            at += LANES;
        }
    }

    #[inline(always)]
    fn mean(self, row: &Row<'_>, [a, b, c, d]: [u32; GROUP], x: u32) -> Premul {
        let of = Self::color;
        let first = of(self, row, a, x);
        let (b, c, d) = (of(self, row, b, x), of(self, row, c, x), of(self, row, d, x));
        // As `mean4`: the first, and the mean of the differences, of which its own is nothing.
        let zero = f32x4::splat(self.0, 0.0);
        let (b, c, d) = (zero + (b - first), zero + (c - first), zero + (d - first));
        Premul((first + (b + (c + d)) * 0.25).to_array())
    }
}

#[cfg(feature = "std")]
impl<S: Simd> Vectors<S> {
    /// [`Gradient::at`] for a key.
    #[inline(always)]
    fn color(self, row: &Row<'_>, key: u32, x: u32) -> f32x4<S> {
        let gradient = row.gradient(key);
        let columns = f32x4::splat(self.0, (x as i32).wrapping_sub(gradient.column) as f32);
        let rows = f32x4::splat(self.0, (row.y as i32).wrapping_sub(gradient.row) as f32);
        let here = f32x4::load_array(self.0, gradient.here);
        let left = here + f32x4::load_array(self.0, gradient.below) * rows;
        let value = left + f32x4::load_array(self.0, gradient.right) * columns;
        let low = f32x4::load_array(self.0, gradient.low);
        value.max(low).min(f32x4::load_array(self.0, gradient.high))
    }
}

#[cfg(feature = "std")]
#[inline(always)]
fn chunk(keys: &[u32], at: usize) -> Option<&[u32; LANES]> {
    keys.get(at..)?.first_chunk()
}

/// A gradient along a row, in vectors.
#[cfg(feature = "std")]
struct Line<'a, S: Simd> {
    simd: S,
    gradient: &'a Gradient,
    /// The colour in the column from which it is counted.
    here: [f32x16<S>; 3],
}

#[cfg(feature = "std")]
impl<'a, S: Simd> Line<'a, S> {
    #[inline(always)]
    fn new(simd: S, gradient: &'a Gradient, y: u32) -> Self {
        let rows = i32x16::splat(simd, (y as i32).wrapping_sub(gradient.row));
        let rows: f32x16<S> = rows.to_float();
        // In a line each: what maps arrays would not be compiled for the instructions.
        let Gradient { here: [r, g, b, _], below: [down_r, down_g, down_b, _], .. } = *gradient;
        let r = f32x16::splat(simd, r) + rows * f32x16::splat(simd, down_r);
        let g = f32x16::splat(simd, g) + rows * f32x16::splat(simd, down_g);
        let b = f32x16::splat(simd, b) + rows * f32x16::splat(simd, down_b);
        Self { simd, gradient, here: [r, g, b] }
    }

    /// How many columns the pixels from `x` on lie right of the one from which it is counted.
    #[inline(always)]
    fn columns(&self, x: u32) -> i32x16<S> {
        const ASIDE: [i32; LANES] = [0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15];
        let first = (x as i32).wrapping_sub(self.gradient.column);
        i32x16::load_array(self.simd, ASIDE) + i32x16::splat(self.simd, first)
    }

    #[inline(always)]
    fn encode(&self, columns: i32x16<S>, codes: &mut [[u8; 4]; LANES]) {
        let columns: f32x16<S> = columns.to_float();
        let red = nearest(self.simd, self.component(0, columns));
        let green = nearest(self.simd, self.component(1, columns));
        let blue = nearest(self.simd, self.component(2, columns));
        let packed = pack(self.simd, red, green, blue);
        for (code, packed) in codes.iter_mut().zip(packed.to_array()) {
            *code = packed.to_le_bytes();
        }
    }

    /// A component, from 0 to 1, in so many columns.
    #[inline(always)]
    fn component(&self, i: usize, columns: f32x16<S>) -> f32x16<S> {
        let splat = f32x16::splat;
        let Gradient { right, low, high, .. } = self.gradient;
        let value = self.here[i] + columns * splat(self.simd, right[i]);
        value.max(splat(self.simd, low[i])).min(splat(self.simd, high[i]))
    }
}

/// Codes of 8 bits, opaque: the low bits of each are a component, and whatever lies above them.
#[cfg(feature = "std")]
#[inline(always)]
fn pack<S: Simd>(simd: S, r: u32x16<S>, g: u32x16<S>, b: u32x16<S>) -> u32x16<S> {
    let alpha = u32x16::splat(simd, 0xff00_0000);
    ((r & 0xff) | (g << 8)) | ((b << 16) | alpha)
}

/// [`unorm8`](scumble_pixel::unorm8) of numbers from 0 to 1, in the low bits.
#[cfg(feature = "std")]
#[inline(always)]
fn nearest<S: Simd>(simd: S, value: f32x16<S>) -> u32x16<S> {
    // 2²³: adding it leaves the nearest whole number in the low bits. The product must not be rounded
    // before that, or what is hardly more than a half could become one.
    let round = f32x16::splat(simd, 8_388_608.0);
    value.mul_add_precise(f32x16::splat(simd, 255.0), round).bitcast()
}

#[cfg(all(test, feature = "std"))]
mod tests {
    use super::*;
    use fearless_simd::Level;
    use scumble_pixel::unorm8;

    /// Whose products with 255 an `f32` cannot tell from a half.
    #[test]
    fn what_is_next_to_a_half_is_rounded_right() {
        for code in 0..255_u8 {
            let half = (f32::from(code) + 0.5) / 255.0;
            let near: [f32; LANES] =
                core::array::from_fn(|i| f32::from_bits(half.to_bits() - 8 + i as u32));
            for level in [Level::baseline(), Level::new()] {
                let codes = dispatch!(level, simd => {
                    nearest(simd, f32x16::load_array(simd, near)).to_array()
                });
                assert_eq!(codes.map(|code| code as u8), near.map(unorm8));
            }
        }
    }
}
