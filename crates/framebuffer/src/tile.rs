use alloc::vec::Vec;
use core::ops::Range;

use scumble_pixel::Premul;

use crate::level::Best;
use crate::samples::{SampleStore, Slot, mean, same_bits};
use crate::stretch;

/// The samples of one tile of the frame, reusable: see the [crate](crate) for the conventions.
///
/// Each pixel is either uniform, one colour for all its samples, or split into samples. Which of
/// the two never shows in a result: a uniform pixel is only a cheaper way to hold equal samples.
#[derive(Debug, Clone, Default)]
pub struct Tile {
    width: usize,
    height: usize,
    samples: u32,
    /// All samples of a pixel.
    full: u64,
    /// The colours of the uniform pixels; of a split one, what it was before.
    colors: Vec<Premul>,
    slots: Vec<Slot>,
    store: SampleStore,
    level: Best,
}

impl Tile {
    /// The greatest width and height of a tile, in pixels: 20 MiB of uniform pixels. A larger
    /// frame is many tiles.
    pub const MAX_SIDE: u32 = 1024;

    /// A tile of no pixels; [`reset`](Self::reset) gives it a shape.
    #[must_use]
    pub fn new() -> Self {
        Self::default()
    }

    /// Makes this a tile of `width` × `height` pixels, each at most [`MAX_SIDE`](Self::MAX_SIDE),
    /// with `samples` samples to the pixel, 1 to 64, all equal to `background`. Values out of
    /// range are brought into it. Allocations are kept.
    pub fn reset(&mut self, width: u32, height: u32, samples: u32, background: Premul) {
        self.width = width.min(Self::MAX_SIDE) as usize;
        self.height = height.min(Self::MAX_SIDE) as usize;
        self.samples = samples.clamp(1, 64);
        self.full = u64::MAX >> (64 - self.samples);
        let len = self.width * self.height;
        self.colors.resize(len, background);
        stretch::fill(self.level, &mut self.colors, background);
        if self.store.is_used() {
            self.slots.fill(Slot::UNIFORM);
        }
        self.slots.resize(len, Slot::UNIFORM);
        self.store.reset(self.samples as usize, len);
    }

    /// The most bytes that a tile of this shape takes: what it takes if an edge crosses every
    /// pixel. Shapes are brought into range as by [`reset`](Self::reset).
    ///
    /// ```
    /// use scumble_framebuffer::Tile;
    ///
    /// assert_eq!(Tile::max_bytes(64, 64, 1), 80 << 10);
    /// assert_eq!(Tile::max_bytes(64, 64, 16), 1152 << 10);
    /// ```
    #[must_use]
    pub fn max_bytes(width: u32, height: u32, samples: u32) -> u64 {
        let pixels = u64::from(width.min(Self::MAX_SIDE)) * u64::from(height.min(Self::MAX_SIDE));
        let uniform = size_of::<Premul>() + size_of::<Slot>();
        let split = match samples.clamp(1, 64) as usize {
            1 => 0,
            n => n * size_of::<Premul>() + SampleStore::OVERHEAD,
        };
        pixels * (uniform + split) as u64
    }

    /// Columns.
    #[must_use]
    pub fn width(&self) -> u32 {
        self.width as u32
    }

    /// Rows.
    #[must_use]
    pub fn height(&self) -> u32 {
        self.height as u32
    }

    /// Samples to the pixel.
    #[must_use]
    pub fn samples(&self) -> u32 {
        self.samples
    }

    /// Blends one colour over every sample of `w` × `h` pixels from (`x`, `y`) on.
    pub fn fill_block(&mut self, x: u32, y: u32, w: u32, h: u32, color: Premul) {
        let bottom = y.saturating_add(h).min(self.height());
        for row in y..bottom {
            let span = self.span(x, row, w as usize);
            if self.is_uniform(span.clone()) {
                stretch::blend(self.level, &mut self.colors[span], color);
            } else {
                span.for_each(|i| self.blend_pixel(i, color));
            }
        }
    }

    /// Blends one colour a pixel over every sample of the pixels from (`x`, `y`) to the right.
    pub fn blend_run(&mut self, x: u32, y: u32, colors: &[Premul]) {
        let span = self.span(x, y, colors.len());
        if self.is_uniform(span.clone()) {
            for (below, &color) in self.colors[span].iter_mut().zip(colors) {
                blend(below, color);
            }
        } else {
            for (i, &color) in span.zip(colors) {
                self.blend_pixel(i, color);
            }
        }
    }

    /// Blends parts of one colour, 0 to 1 of it, over every sample of the pixels from (`x`, `y`) to
    /// the right: what a shape that is antialiased by itself covers of each.
    ///
    /// 0 changes nothing and 1 of an opaque colour replaces what was there, both to the bit.
    pub fn blend_areas(&mut self, x: u32, y: u32, areas: &[f32], color: Premul) {
        let span = self.span(x, y, areas.len());
        if self.is_uniform(span.clone()) {
            stretch::blend_parts(self.level, &mut self.colors[span], areas, color);
        } else {
            for (i, &area) in span.zip(areas) {
                self.blend_pixel(i, color.scaled(area));
            }
        }
    }

    /// Blends one colour over those samples of a pixel that are in `mask`.
    pub fn blend_masked(&mut self, x: u32, y: u32, mask: u64, color: Premul) {
        let Some(i) = self.index(x, y) else { return };
        let mask = mask & self.full;
        if mask == self.full {
            self.blend_pixel(i, color);
        } else if mask != 0 && !self.is_idle(i, color) {
            self.blend_split(i, mask, core::iter::repeat(color));
        }
    }

    /// Blends one colour a sample over those samples of a pixel that are in `mask`: the first
    /// colour over the lowest set bit's sample, and so on. Bits without a colour are ignored.
    pub fn blend_samples(&mut self, x: u32, y: u32, mask: u64, colors: &[Premul]) {
        let (Some(i), Some(&first)) = (self.index(x, y), colors.first()) else { return };
        let mask = lowest_bits(mask & self.full, colors.len());
        if mask == self.full && colors.iter().all(|&c| same_bits(c, first)) {
            self.blend_pixel(i, first);
        } else if mask != 0 {
            self.blend_split(i, mask, colors.iter().copied());
        }
    }

    /// Blends another tile, every component times `opacity` (0…1), over this one, sample by
    /// sample: how a group with an opacity of its own joins what lies below it.
    ///
    /// The layer should have this tile's shape. Of one with another size the part that they have
    /// in common is blended; one with another number of samples is resolved, pixel by pixel.
    pub fn composite(&mut self, layer: &Self, opacity: f32) {
        // NaN is 0, so that a bad opacity hides its layer and harms nothing else.
        let opacity = if opacity > 0.0 { opacity.min(1.0) } else { return };
        for y in 0..self.height().min(layer.height()) {
            let below = self.span(0, y, layer.width);
            for (i, j) in below.zip(layer.span(0, y, self.width)) {
                self.composite_pixel(i, layer, j, opacity);
            }
        }
    }

    /// The pixels of a row, each the mean of its samples, from column 0 on; as many as both `out`
    /// and the row have. The mean of equal samples is their value, to the bit.
    pub fn resolve_row(&self, y: u32, out: &mut [Premul]) {
        let span = self.span(0, y, out.len());
        if self.is_uniform(span.clone()) {
            out[..span.len()].copy_from_slice(&self.colors[span]);
        } else {
            for (i, pixel) in span.zip(out) {
                *pixel = self.resolve(i);
            }
        }
    }

    /// The pixels of a row as [`resolve_row`](Self::resolve_row) finds them, if there is nothing to find:
    /// none of them is split.
    #[must_use]
    pub fn uniform_row(&self, y: u32) -> Option<&[Premul]> {
        let span = self.span(0, y, self.width);
        self.is_uniform(span.clone()).then(|| &self.colors[span])
    }

    /// How many pixels are split into samples now: a measure of memory and of work.
    #[must_use]
    pub fn split_pixels(&self) -> usize {
        self.slots.iter().filter(|slot| !slot.is_uniform()).count()
    }

    /// The indices of up to `len` pixels from (`x`, `y`) to the right.
    fn span(&self, x: u32, y: u32, len: usize) -> Range<usize> {
        let (x, y) = (x as usize, y as usize);
        if x >= self.width || y >= self.height {
            return 0..0;
        }
        let start = y * self.width + x;
        start..start + len.min(self.width - x)
    }

    /// Whether no pixel of the span is split.
    fn is_uniform(&self, span: Range<usize>) -> bool {
        self.samples == 1 || Slot::all_uniform(&self.slots[span])
    }

    fn index(&self, x: u32, y: u32) -> Option<usize> {
        self.span(x, y, 1).next()
    }

    /// Whether blending `color` over some samples of the pixel is known to change none of them.
    fn is_idle(&self, i: usize, color: Premul) -> bool {
        let alpha = color.alpha();
        if alpha == 1.0 {
            self.slots[i].is_uniform() && same_bits(self.colors[i], color)
        } else {
            alpha == 0.0 && same_bits(color, Premul::TRANSPARENT)
        }
    }

    /// Pixel `j` of the layer over pixel `i`.
    fn composite_pixel(&mut self, i: usize, layer: &Self, j: usize, opacity: f32) {
        let slot = layer.slots[j];
        if !slot.is_uniform() && layer.samples == self.samples {
            let colors = layer.store.get(slot).iter().map(|c| c.scaled(opacity));
            self.blend_split(i, self.full, colors);
            return;
        }
        let color = layer.resolve(j);
        // Most of a layer is empty.
        if !same_bits(color, Premul::TRANSPARENT) {
            self.blend_pixel(i, color.scaled(opacity));
        }
    }

    /// `color` over every sample.
    #[inline]
    fn blend_pixel(&mut self, i: usize, color: Premul) {
        let slot = self.slots[i];
        if slot.is_uniform() {
            blend(&mut self.colors[i], color);
        } else if color.alpha() == 1.0 {
            self.unite(i, color);
        } else {
            for sample in self.store.get_mut(slot) {
                blend(sample, color);
            }
        }
    }

    /// The colours over the samples in `mask`, in the order of the bits.
    fn blend_split(&mut self, i: usize, mask: u64, colors: impl Iterator<Item = Premul>) {
        let slot = self.split(i);
        let samples = self.store.get_mut(slot);
        for (bit, color) in set_bits(mask).zip(colors) {
            blend(&mut samples[bit], color);
        }
        if self.store.touch(slot, mask, self.full) {
            let color = self.store.get(slot)[0];
            self.unite(i, color);
        }
    }

    /// The pixel's samples, told apart if they were not.
    fn split(&mut self, i: usize) -> Slot {
        if self.slots[i].is_uniform() {
            self.slots[i] = self.store.take(self.colors[i]);
        }
        self.slots[i]
    }

    /// Makes a split pixel uniform.
    fn unite(&mut self, i: usize, color: Premul) {
        self.store.release(self.slots[i]);
        self.slots[i] = Slot::UNIFORM;
        self.colors[i] = color;
    }

    #[inline]
    fn resolve(&self, i: usize) -> Premul {
        let slot = self.slots[i];
        if slot.is_uniform() { self.colors[i] } else { mean(self.store.get(slot)) }
    }
}

/// Source-over, where an opaque source is stored as it is.
#[inline]
fn blend(below: &mut Premul, color: Premul) {
    *below = if color.alpha() == 1.0 { color } else { color.over(*below) };
}

/// The indices of the set bits, lowest first.
fn set_bits(mut mask: u64) -> impl Iterator<Item = usize> {
    core::iter::from_fn(move || {
        let bit = (mask != 0).then(|| mask.trailing_zeros() as usize);
        mask &= mask.wrapping_sub(1);
        bit
    })
}

/// The `count` lowest set bits of `mask`.
fn lowest_bits(mask: u64, count: usize) -> u64 {
    let mut rest = mask;
    for _ in 0..count {
        rest &= rest.wrapping_sub(1);
        if rest == 0 {
            break;
        }
    }
    mask ^ rest
}

#[cfg(test)]
mod tests;
