use crate::Palette;
#[cfg(feature = "std")]
use crate::level::Best;
use crate::samples::{mean, mean_of, mean4};
use crate::stretch::fill_keys;
use alloc::vec::Vec;
use scumble_pixel::{Premul, WorkingSpace};
use squares::{Rows, SIDE};

/// Which surface is seen in each sample of a tile: a number, the *key*, in place of a colour.
///
/// Opaque primitives hide what lies under them, so while nothing but those is drawn it is enough
/// to keep which of them came last, a quarter of a colour's size, and to ask for colours once for
/// each pixel at the end, however often it was drawn over. What a key stands for is the affair of
/// whoever draws.
///
/// ```
/// use scumble_framebuffer::{Seen, Visibility};
///
/// let mut tile = Visibility::new();
/// tile.reset(4, 1, 4, 0);
/// tile.fill_block(0, 0, 2, 1, 7);
/// tile.cover(2, 0, 0b0011, 8);
/// let row: Vec<Seen> = tile.row(0).collect();
/// assert_eq!(row[0], Seen::Whole { x: 0, len: 2, key: 7 });
/// assert_eq!(row[1], Seen::Mixed { x: 2, keys: &[8, 8, 0, 0] });
/// assert_eq!(row[2], Seen::Whole { x: 3, len: 1, key: 0 });
/// ```
#[derive(Debug, Clone, Default)]
pub struct Visibility {
    width: usize,
    height: usize,
    samples: usize,
    /// All samples of a pixel.
    full: u64,
    /// Per pixel: the key of all its samples, or [`MIXED`]. Then [`SIDE`] more, so that as many can
    /// be written from any pixel on.
    keys: Vec<u32>,
    /// Per pixel, `groups` of them: the keys of its samples, if it is mixed; else anything. And then
    /// for [`SIDE`] pixels more.
    mixed: Vec<[u32; GROUP]>,
    /// Groups that hold the samples of a pixel; 0 if there is only one.
    groups: usize,
    #[cfg(feature = "std")]
    level: Best,
}

/// What is seen in some pixels of a row.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Seen<'a> {
    /// One key in every sample of some pixels.
    Whole {
        /// The first pixel.
        x: usize,
        /// How many.
        len: usize,
        /// What is seen.
        key: u32,
    },
    /// Several keys in one pixel: perhaps all the same.
    Mixed {
        /// The pixel.
        x: usize,
        /// What is seen in each sample.
        keys: &'a [u32],
    },
}

/// Stands in place of a key where samples differ.
const MIXED: u32 = u32::MAX;

/// Samples that are written at once: what any machine's vectors hold.
const GROUP: usize = 4;

impl Visibility {
    /// The largest key.
    pub const MAX_KEY: u32 = MIXED - 1;

    /// A tile of no pixels; [`reset`](Self::reset) gives it a shape.
    #[must_use]
    pub fn new() -> Self {
        Self::default()
    }

    /// Makes this a tile of `width` × `height` pixels, each at most
    /// [`Tile::MAX_SIDE`](crate::Tile::MAX_SIDE), with `samples` samples to the pixel, 1 to 64, in
    /// all of which `key` is seen. Values out of range are brought into it. Allocations are kept.
    pub fn reset(&mut self, width: u32, height: u32, samples: u32, key: u32) {
        let side = |v: u32| v.min(crate::Tile::MAX_SIDE) as usize;
        (self.width, self.height) = (side(width), side(height));
        self.samples = samples.clamp(1, 64) as usize;
        self.full = u64::MAX >> (64 - self.samples);
        self.groups = if self.samples == 1 { 0 } else { self.samples.div_ceil(GROUP) };
        let len = self.width * self.height + SIDE;
        self.keys.clear();
        self.keys.resize(len, key.min(Self::MAX_KEY));
        if self.mixed.len() < len * self.groups {
            self.mixed.resize(len * self.groups, [0; GROUP]);
        }
    }

    /// The most bytes that a tile of this shape takes. Shapes are brought into range as by
    /// [`reset`](Self::reset).
    ///
    /// ```
    /// use scumble_framebuffer::Visibility;
    ///
    /// assert_eq!(Visibility::max_bytes(64, 64, 1), (16 << 10) + 32);
    /// assert_eq!(Visibility::max_bytes(64, 64, 16), ((16 << 10) + 32) * 17);
    /// ```
    #[must_use]
    pub fn max_bytes(width: u32, height: u32, samples: u32) -> u64 {
        let side = |v: u32| u64::from(v.min(crate::Tile::MAX_SIDE));
        let each = match samples.clamp(1, 64) as usize {
            1 => 1,
            n => 1 + n.next_multiple_of(GROUP),
        };
        (side(width) * side(height) + SIDE as u64) * (each * size_of::<u32>()) as u64
    }

    /// `key` hides what was seen in every sample of `w` × `h` pixels from (`x`, `y`) on.
    #[inline]
    pub fn fill_block(&mut self, x: u32, y: u32, w: u32, h: u32, key: u32) {
        let (x, y) = (x as usize, y as usize);
        let right = x.saturating_add(w as usize).min(self.width);
        let bottom = y.saturating_add(h as usize).min(self.height);
        if x >= right {
            return;
        }
        let key = key.min(Self::MAX_KEY);
        for row in y..bottom {
            fill_keys(&mut self.keys[row * self.width..][x..right], key);
        }
    }

    /// `key` hides what was seen in every sample of `len` pixels from (`x`, `y`) to the right.
    #[inline]
    pub fn fill_run(&mut self, x: u32, y: u32, len: u32, key: u32) {
        let (x, y) = (x as usize, y as usize);
        let right = x.saturating_add(len as usize).min(self.width);
        if x < right && y < self.height {
            let start = y * self.width;
            fill_keys(&mut self.keys[start + x..start + right], key.min(Self::MAX_KEY));
        }
    }

    /// `key` hides what was seen in those samples of a pixel that are in `mask`.
    #[inline]
    pub fn cover(&mut self, x: u32, y: u32, mask: u64, key: u32) {
        let (x, y) = (x as usize, y as usize);
        if x >= self.width || y >= self.height {
            return;
        }
        let (i, mask) = (y * self.width + x, mask & self.full);
        let (seen, key) = (self.keys[i], key.min(Self::MAX_KEY));
        if mask == self.full {
            self.keys[i] = key;
        } else if mask != 0 && seen != key {
            self.keys[i] = MIXED;
            let mut bits = mask;
            for group in &mut self.mixed[i * self.groups..][..self.groups] {
                // Selected, not stored where needed: vectors have no branches.
                let mut below = if seen == MIXED { *group } else { [seen; GROUP] };
                for (sample, bit) in below.iter_mut().zip([1, 2, 4, 8]) {
                    *sample = if bits & bit != 0 { key } else { *sample };
                }
                *group = below;
                bits >>= GROUP;
            }
        }
    }

    /// `key` hides what was seen in every sample of those of the 8 × 8 pixels from (`x`, `y`) on that
    /// are in `pixels`: bit 8·r + c is the pixel (x + c, y + r).
    #[inline]
    pub fn fill_pixels(&mut self, x: u32, y: u32, pixels: u64, key: u32) {
        #[cfg(feature = "std")]
        let level = self.level.0;
        let Some((mut rows, columns)) = self.square(x, y) else { return };
        let within = (0xff >> (SIDE - columns)) * 0x0101_0101_0101_0101;
        let (pixels, key) = (pixels & within, key.min(Self::MAX_KEY));
        #[cfg(feature = "std")]
        rows.fill_by(level, pixels, key);
        #[cfg(not(feature = "std"))]
        rows.fill(pixels, key);
    }

    /// `key` hides what was seen in some samples of the 8 × 8 pixels from (`x`, `y`) on, four samples
    /// to the pixel: bit 4·c + s of `samples[r]` is sample s of the pixel (x + c, y + r). In a tile
    /// of another number of samples it does nothing.
    #[inline]
    pub fn cover_square(&mut self, x: u32, y: u32, samples: &[u32; 8], key: u32) {
        if self.samples != GROUP {
            return;
        }
        #[cfg(feature = "std")]
        let level = self.level.0;
        let Some((mut rows, columns)) = self.square(x, y) else { return };
        let within = u32::MAX >> (GROUP * (SIDE - columns));
        let key = key.min(Self::MAX_KEY);
        #[cfg(feature = "std")]
        rows.cover_by(level, samples, within, key);
        #[cfg(not(feature = "std"))]
        rows.cover(samples, within, key);
    }

    /// The tile from a pixel on, and how many of the eight columns from there are in it.
    #[inline]
    fn square(&mut self, x: u32, y: u32) -> Option<(Rows<'_>, usize)> {
        let (x, y, stride) = (x as usize, y as usize, self.width);
        if x >= stride || y >= self.height {
            return None;
        }
        let start = y * stride + x;
        let keys = &mut self.keys[start..];
        let mixed = self.mixed.get_mut(start..).unwrap_or_default();
        Some((Rows { keys, mixed, stride }, (stride - x).min(SIDE)))
    }

    /// The row's keys, and where they begin; none if there is no such row.
    fn keys(&self, y: u32) -> (usize, &[u32]) {
        if y as usize >= self.height {
            return (0, &[]);
        }
        let start = y as usize * self.width;
        (start, &self.keys[start..start + self.width])
    }

    /// The keys of the samples of a mixed pixel.
    fn samples_of(&self, i: usize) -> &[u32] {
        &self.mixed[i * self.groups..][..self.groups].as_flattened()[..self.samples]
    }

    /// The pixels of a row where every key stands for one colour, encoded to straight 8-bit sRGB;
    /// as many as both `out` and the row have. Keys beyond the palette are transparent.
    ///
    /// The bytes are those of [`shade_row`](Self::shade_row) and [`encode_row`](crate::encode_row).
    pub fn encode_row(&self, y: u32, palette: &Palette, out: &mut [[u8; 4]]) {
        #[cfg(feature = "std")]
        fearless_simd::dispatch!(self.level.0, _simd => self.encode_row_by(y, palette, out));
        #[cfg(not(feature = "std"))]
        self.encode_row_by(y, palette, out);
    }

    // Inlined, so that it runs on the instructions of its caller.
    #[inline(always)]
    fn encode_row_by(&self, y: u32, palette: &Palette, out: &mut [[u8; 4]]) {
        let (start, keys) = self.keys(y);
        for (key, code) in keys.iter().zip(&mut *out) {
            *code = palette.code(*key);
        }
        if self.groups == 0 {
            return;
        }
        for (first, (keys, out)) in (0..).step_by(64).zip(keys.chunks(64).zip(out.chunks_mut(64))) {
            let mixed = mixed_bits(keys, out.len());
            encode_mixed(mixed, palette.space(), out, |x| self.mix(start + first + x, palette));
        }
    }

    #[inline(always)]
    fn mix(&self, i: usize, palette: &Palette) -> Premul {
        if self.groups == 1 && self.samples == GROUP {
            // The most common number deserves a way of its own.
            let [a, b, c, d] = self.mixed[i];
            let color = [palette.color(a), palette.color(b), palette.color(c), palette.color(d)];
            return mean4(color);
        }
        let keys = self.samples_of(i);
        mean_of(keys.len(), |s| palette.color(keys[s]))
    }

    /// The pixels of a row, each the mean of its samples; as many as both `out` and the row have.
    ///
    /// `shade` is asked for the colours of a key in the pixels from a column on, as many as it is
    /// given room for: once for each stretch of pixels, and once for each key of a mixed pixel.
    pub fn shade_row(
        &self,
        y: u32,
        out: &mut [Premul],
        mut shade: impl FnMut(u32, usize, &mut [Premul]),
    ) {
        let mut colors = [Premul::TRANSPARENT; 64];
        for seen in self.row(y) {
            match seen {
                Seen::Whole { x, len, key } => {
                    let end = (x + len).min(out.len());
                    if x < end {
                        shade(key, x, &mut out[x..end]);
                    }
                }
                Seen::Mixed { x, keys } => {
                    let Some(pixel) = out.get_mut(x) else { return };
                    for (s, key) in keys.iter().enumerate() {
                        match keys[..s].iter().rposition(|k| k == key) {
                            Some(same) => colors[s] = colors[same],
                            None => shade(*key, x, &mut colors[s..=s]),
                        }
                    }
                    *pixel = mean(&colors[..keys.len()]);
                }
            }
        }
    }

    /// What is seen in a row, from left to right; nothing if there is no such row.
    pub fn row(&self, y: u32) -> impl Iterator<Item = Seen<'_>> {
        let (start, row) = self.keys(y);
        let mut x = 0;
        core::iter::from_fn(move || {
            let key = *row.get(x)?;
            let first = x;
            if key == MIXED {
                x += 1;
                return Some(Seen::Mixed { x: first, keys: self.samples_of(start + first) });
            }
            let len = row[first..].iter().take_while(|&&k| k == key).count();
            x += len;
            Some(Seen::Whole { x: first, len, key })
        })
    }
}

/// Mixed pixels that are encoded together: whole vectors of opaque ones are quickest.
const TOGETHER: usize = 16;

/// Encodes the pixels of `mixed`, of which `color` tells what they look like.
#[inline(always)]
fn encode_mixed(
    mut mixed: u64,
    space: WorkingSpace,
    codes: &mut [[u8; 4]],
    mut color: impl FnMut(usize) -> Premul,
) {
    while mixed != 0 {
        let mut colors = [Premul([0.0, 0.0, 0.0, 1.0]); TOGETHER];
        let (mut rest, mut count) = (mixed, 0);
        while rest != 0 && count < TOGETHER {
            colors[count] = color(rest.trailing_zeros() as usize);
            rest &= rest - 1;
            count += 1;
        }
        let mut found = [[0; 4]; TOGETHER];
        space.export_row(&colors, &mut found);
        for code in &found[..count] {
            codes[mixed.trailing_zeros() as usize] = *code;
            mixed &= mixed - 1;
        }
    }
}

/// Which of the first pixels are mixed: of at most 64, and at most `room`. As bits, since whether a
/// pixel is mixed is nothing that a branch could guess.
#[inline(always)]
fn mixed_bits(keys: &[u32], room: usize) -> u64 {
    let bits = (0..).zip(keys).map(|(i, &key)| u64::from(key == MIXED) << i);
    bits.fold(0, |all, bit| all | bit) & u64::MAX >> (64 - room.min(64))
}

mod gradients;
mod squares;
#[cfg(test)]
mod tests;
