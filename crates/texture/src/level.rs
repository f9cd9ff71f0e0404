use crate::pyramid::plan::Span;
use crate::store::{Code, Store, Stored, Strip, Whole};
use crate::texel::{Cell, STEP, Texel, of_color};
use crate::{TextureError, Wrap};
use fearless_simd::{Simd, i32x16, mask32x16, prelude::*};
use scumble_pixel::ImageView;

/// One level, or a part of it: rows of premultiplied RGBA in the working space, [`stride`] texels from
/// row to row, with an apron of [`APRON`] texels on every side that holds what [`Wrap`] puts there.
///
/// Indices of texels are those of the whole level. Of a part, the nearest texel that is kept stands for
/// those that are not.
#[derive(Debug, Clone)]
pub(crate) struct Level {
    /// Columns and rows of the whole level.
    pub(crate) width: usize,
    pub(crate) height: usize,
    /// Columns and rows that are kept.
    pub(crate) part: [Span; 2],
    pub(crate) stride: usize,
    pub(crate) texels: Store,
    /// The index in `texels` of texel (0, 0), which may not be kept, below zero: what is to be taken
    /// off y·stride + x.
    pub(crate) base: i32,
    /// What an index is cut to, per axis, before it is used: all ones, or a size less one where the
    /// level is a tile whose sides are powers of two.
    pub(crate) mask: [i32; 2],
    /// What stands beyond the level, where that is one colour.
    pub(crate) outside: Texel,
    pub(crate) frame: Frame,
}

/// Where a level stands in its pyramid, each number per axis.
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct Frame {
    /// From texels of the image to texels of this level. Not 2^−l where a size was odd.
    pub(crate) scale: [f64; 2],
    /// Its products: with itself along u, across, along v; and the product of the first and the last.
    pub(crate) products: [f32; 4],
    /// The variance that the pyramid has added so far, in squared texels of the image.
    pub(crate) blurred: [f32; 2],
    /// How far an ellipse may reach from its centre: no bound, except along an axis of one texel,
    /// where there is nothing to see. Anywhere else, an ellipse that is cut short of its length
    /// aliases: over a repeated texture it may well cross many repeats.
    pub(crate) most: [f32; 2],
    /// The first and the last texel that a walk reads in place: those that are kept and the apron;
    /// none if an index would not fit 31 bits, and all of a tile that [`Level::mask`] serves.
    pub(crate) low: [i32; 2],
    pub(crate) high: [i32; 2],
    /// The last texel of the level.
    pub(crate) last: [i32; 2],
    /// Whether beyond the level there is nothing but the texels at its edge, or one colour.
    pub(crate) ends: bool,
    /// Whether it goes on beyond the apron as in its outermost texels, so that those can be read instead
    /// of any that lie farther out.
    pub(crate) even: bool,
}

/// The largest side of a texture, in texels.
pub(crate) const LARGEST: usize = 1 << 29;

/// Texels of the largest level that a walk takes the short way in.
const SHORT: usize = 1 << 31;

/// Texels around those that are kept: so many that most ellipses at an edge lie within, and those beyond
/// it can be taken to lie there.
pub(crate) const APRON: usize = 8;

/// Texels from one row of a level to the next.
///
/// Eight texels are a line of the cache. An odd number of lines puts the rows that an ellipse crosses
/// into different sets of it; with the powers of two that textures like to be, they would all fall into
/// one and push each other out. Narrow levels are left alone.
pub(crate) fn stride(width: usize) -> usize {
    let wide = width.saturating_add(2 * APRON);
    if width < 64 { wide } else { (wide.div_ceil(8) | 1).saturating_mul(8) }
}

/// Texels that a part of a level takes with its apron; `None` if that overflows.
pub(crate) fn texels_kept(part: [Span; 2]) -> Option<usize> {
    stride(part[0].len()).checked_mul(part[1].len().checked_add(2 * APRON)?)
}

/// What it takes to find rectangles of texels in the memory of a level, in lanes.
#[derive(Clone, Copy)]
pub(crate) struct Places<S: Simd> {
    low: [i32x16<S>; 2],
    last: [i32x16<S>; 2],
    mask: [i32x16<S>; 2],
    stride: i32x16<S>,
    base: i32x16<S>,
}

/// Two numbers, each in all lanes. A map of the array would be a call that leaves the instruction set.
#[inline(always)]
fn both<S: Simd>(simd: S, [x, y]: [i32; 2]) -> [i32x16<S>; 2] {
    [i32x16::splat(simd, x), i32x16::splat(simd, y)]
}

impl<S: Simd> Places<S> {
    /// The indices of the first of the texels from (x, y) on, or of texels that are the same; where they can
    /// not be read, something of no meaning.
    #[inline(always)]
    pub(crate) fn index(&self, [x, y]: [i32x16<S>; 2]) -> i32x16<S> {
        let x = x.max(self.low[0]).min(self.last[0]);
        let y = y.max(self.low[1]).min(self.last[1]);
        // After the masks, every sum here is an index of a texel, and fits 31 bits.
        (y & self.mask[1]) * self.stride + (x & self.mask[0]) - self.base
    }
}

impl Level {
    /// A level of no meaning, to be filled, in the memory of another if that is of its size.
    pub(crate) fn new<T: Stored>(
        [width, height]: [usize; 2],
        part: [Span; 2],
        old: Option<Self>,
    ) -> Result<Self, TextureError> {
        let too_large = TextureError::TooLarge { width, height };
        let [columns, rows] = part;
        let stride = stride(columns.len());
        let len = texels_kept(part).ok_or(too_large)?;
        len.checked_mul(size_of::<T>()).ok_or(too_large)?;
        let most = [width, height].map(|n| if n == 1 { 2.5 } else { f32::INFINITY });
        // Sides are below 2²⁹.
        let last = [width, height].map(|n| n as i32 - 1);
        let apron = APRON as i32;
        let (mut low, mut high) = ([i32::MAX; 2], [i32::MIN; 2]);
        if len < SHORT {
            low = part.map(|span| span.start as i32 - apron);
            high = part.map(|span| span.end as i32 - 1 + apron);
        }
        let frame = Frame { scale: [1.0; 2], most, low, high, last, ..Frame::default() };
        // Whatever wraps around here wraps back where it is taken off.
        let [x0, y0] = [columns, rows].map(|span| span.start as i32 - apron);
        let base = y0.wrapping_mul(stride as i32).wrapping_add(x0);
        Ok(Self {
            width,
            height,
            part,
            stride,
            texels: Store::new::<T>(len, old.map(|old| old.texels))?,
            base,
            mask: [-1; 2],
            outside: Texel::default(),
            frame,
        })
    }

    /// This level as one over an image of the given size, made by steps that add `step` squared texels
    /// of variance each: m = step·(4^l − 1)/3, with 2^l the true ratio of the sizes.
    pub(crate) fn over(mut self, image: [usize; 2], step: f64) -> Self {
        let scale = [self.width as f64 / image[0] as f64, self.height as f64 / image[1] as f64];
        let [su, sv] = scale;
        self.frame.scale = scale;
        self.frame.products = [su * su, su * sv, sv * sv, su * su * sv * sv].map(|p| p as f32);
        self.frame.blurred = scale.map(|s| (step * (1.0 / (s * s) - 1.0) / 3.0) as f32);
        self
    }

    /// Fills the apron of a filled level with what lies there, and makes a tile whose sides are powers
    /// of two go on for ever.
    ///
    /// Of a level with an outline, the columns of its rows that are stored: beside those that do not
    /// reach to an end there is nothing to repeat, and pages that nobody reads are left alone. But a
    /// constant may be read beside any row.
    pub(crate) fn seal(&mut self, wrap: Wrap, stored: &[Span]) {
        self.frame.ends = matches!(wrap, Wrap::Clamp | Wrap::Constant(_));
        self.outside = of_color(wrap.border());
        match self.texels {
            Store::Steps(_) => self.fill_apron::<Texel>(wrap, stored),
            Store::Codes(_) => self.fill_apron::<Code>(wrap, stored),
            Store::Floats(_) => self.fill_apron::<[f32; 4]>(wrap, stored),
        }
        let Self { width, height, .. } = *self;
        let short = self.frame.low[0] < self.frame.high[0];
        self.frame.even = short && (wrap == Wrap::Clamp || self.frame.ends && self.is_whole());
        let binary = width.is_power_of_two() && height.is_power_of_two();
        if wrap == Wrap::Repeat && short && binary && self.is_whole() {
            self.mask = [width, height].map(|n| n as i32 - 1);
            self.frame.low = [i32::MIN; 2];
            self.frame.high = [i32::MAX; 2];
        }
    }

    fn fill_apron<T: Stored>(&mut self, wrap: Wrap, stored: &[Span]) {
        let Self { width, height, stride, part: [columns, rows], .. } = *self;
        let border = T::of_color(wrap.border());
        let apron = APRON as i32;
        // What stands at index `i` of an axis with `n` texels, as a place among those that are kept.
        let place =
            |i: i32, span: Span, n: usize| wrap.resolve(i, n).map(|i| span.place(i) + APRON);
        let beside = |from: i32| -> [Option<usize>; APRON] {
            core::array::from_fn(|i| place(from + i as i32, columns, width))
        };
        let left = beside(columns.start as i32 - apron);
        let right = beside(columns.end as i32);
        let Some(memory) = T::kept(&mut self.texels) else { return };
        let kept = memory.chunks_exact_mut(stride).skip(APRON).take(rows.len());
        for (y, row) in kept.enumerate() {
            let stored = stored.get(y).copied().unwrap_or(columns);
            let ends = [stored.start == columns.start, stored.end == columns.end];
            let known = ends.map(|end| end && stored.len() > 0);
            for i in (0..APRON).filter(|&i| known[0] || left[i].is_none()) {
                row[i] = left[i].map_or(border, |from| row[from]);
            }
            for i in (0..APRON).filter(|&i| known[1] || right[i].is_none()) {
                row[APRON + columns.len() + i] = right[i].map_or(border, |from| row[from]);
            }
        }
        let above = (0..APRON).map(|i| (i, rows.start as i32 - apron + i as i32));
        let below = (0..APRON).map(|i| (APRON + rows.len() + i, (rows.end + i) as i32));
        for (to, y) in above.chain(below) {
            match place(y, rows, height) {
                Some(from) => memory.copy_within(from * stride..(from + 1) * stride, to * stride),
                None => memory[to * stride..][..stride].fill(border),
            }
        }
    }

    /// Whether all of the level is kept.
    pub(crate) fn is_whole(&self) -> bool {
        self.part == [Span::all(self.width), Span::all(self.height)]
    }

    /// Where the columns that are kept begin in the memory of row `y` of the level, which must exist, or
    /// of the row that stands for it.
    #[inline(always)]
    fn start(&self, y: usize) -> usize {
        (self.part[1].place(y) + APRON) * self.stride + APRON
    }

    /// The columns of row `y`, which must exist, that are kept, and the apron on both sides.
    #[inline(always)]
    pub(crate) fn row_with_apron(&self, y: usize) -> Whole<'_> {
        self.texels.whole().part(self.start(y) - APRON, self.part[0].len() + 2 * APRON)
    }

    /// The texels that are kept as an image without a place.
    pub(crate) fn view<'a, T>(&self, memory: &'a [T]) -> Option<ImageView<'a, T>> {
        let [columns, rows] = self.part.map(Span::len);
        let first = APRON * self.stride + APRON;
        ImageView::new(columns, rows, self.stride, memory.get(first..)?).ok()
    }

    /// Whether the texels from (x0, y0) to (x1, y1) are kept or in the apron.
    #[inline(always)]
    pub(crate) fn holds(&self, [x0, y0]: [i32; 2], [x1, y1]: [i32; 2]) -> bool {
        let apron = APRON as i32;
        let [columns, rows] = self.part;
        (x0 >= columns.start as i32 - apron)
            & (y0 >= rows.start as i32 - apron)
            & (x1 < columns.end as i32 + apron)
            & (y1 < rows.end as i32 + apron)
    }

    /// Whether the texels from (x0, y0) to (x1, y1) can be read in place.
    #[inline(always)]
    pub(crate) fn reads<S: Simd>(
        &self,
        simd: S,
        [x0, y0]: [i32x16<S>; 2],
        [x1, y1]: [i32x16<S>; 2],
    ) -> mask32x16<S> {
        let Frame { low, high, even, .. } = self.frame;
        if even {
            return mask32x16::from_bitmask(simd, u64::MAX);
        }
        x0.simd_ge(low[0]) & x1.simd_le(high[0]) & y0.simd_ge(low[1]) & y1.simd_le(high[1])
    }

    /// Where so many columns and rows of texels begin in the memory.
    #[inline(always)]
    pub(crate) fn places<S: Simd>(&self, simd: S, [columns, rows]: [i32; 2]) -> Places<S> {
        let Frame { low, high: [right, bottom], .. } = self.frame;
        let last = [right.saturating_sub(columns - 1), bottom.saturating_sub(rows - 1)];
        Places {
            low: both(simd, low),
            last: both(simd, last),
            mask: both(simd, self.mask),
            stride: i32x16::splat(simd, self.stride as i32),
            base: i32x16::splat(simd, self.base),
        }
    }

    /// The columns of row `y` that are kept, if the row is and its texels are such.
    #[cfg(feature = "parallel")]
    pub(crate) fn row<T: Stored>(&mut self, y: usize) -> Option<&[T]> {
        let (start, [columns, rows]) = (self.start(y), self.part);
        let memory = T::kept(&mut self.texels).filter(|_| rows.holds(y))?;
        memory.get(start..start + columns.len())
    }

    /// Stores texels of row `y`, from so many of the columns that are kept on, if the row is kept.
    pub(crate) fn put<T: Cell>(&mut self, y: usize, from: usize, texels: &[T]) {
        let (start, [_, rows]) = (self.start(y) + from, self.part);
        if rows.holds(y) {
            Strip::<T>::of(&mut self.texels).put(start, texels);
        }
    }

    /// Where texel (x, y), which [`Level::holds`], stands in its memory; elsewhere something of no
    /// meaning.
    #[inline(always)]
    pub(crate) fn index(&self, x: i32, y: i32) -> usize {
        let [columns, rows] = self.part.map(|span| span.start as i32 - APRON as i32);
        let (y, x) = (y.wrapping_sub(rows), x.wrapping_sub(columns));
        (y as u32 as usize).wrapping_mul(self.stride).wrapping_add(x as u32 as usize)
    }

    /// The texel at (x, y), which may lie outside.
    #[inline(always)]
    pub(crate) fn stored(&self, x: i32, y: i32, wrap: Wrap) -> Texel {
        match (wrap.resolve(x, self.width), wrap.resolve(y, self.height)) {
            (Some(x), Some(y)) => self.texels.whole().texel(self.start(y) + self.part[0].place(x)),
            _ => self.outside,
        }
    }

    /// The numbers of the texel at (x, y), which may lie outside, in the level's unit.
    #[inline(always)]
    pub(crate) fn numbers(&self, x: i32, y: i32, wrap: Wrap) -> [f32; 4] {
        match (wrap.resolve(x, self.width), wrap.resolve(y, self.height)) {
            (Some(x), Some(y)) => self.texels.numbers(self.start(y) + self.part[0].place(x)),
            _ if self.is_float() => wrap.border(),
            _ => self.outside.numbers(),
        }
    }

    /// The colour of the texel at (x, y), which may lie outside.
    #[inline(always)]
    pub(crate) fn texel(&self, x: i32, y: i32, wrap: Wrap) -> [f32; 4] {
        self.numbers(x, y, wrap).map(|v| v * self.unit())
    }

    /// Whether texels are floats.
    #[inline(always)]
    pub(crate) fn is_float(&self) -> bool {
        matches!(self.texels, Store::Floats(_))
    }

    /// What a number of a texel is counted in: [`STEP`] or 1.
    #[inline(always)]
    pub(crate) fn unit(&self) -> f32 {
        if self.is_float() { 1.0 } else { STEP }
    }

    /// The mean of the texels that are kept.
    pub(crate) fn mean(&self) -> [f32; 4] {
        let [columns, rows] = self.part;
        let mut sum = [0.0; 4];
        for y in rows.start..rows.end {
            let row = self.texels.sum(self.start(y), columns.len());
            (0..4).for_each(|c| sum[c] += row[c]);
        }
        let n = columns.len() as f64 * rows.len() as f64;
        sum.map(|sum| (sum / n) as f32 * self.unit())
    }
}
