use crate::pyramid::plan::Span;
use crate::texel::{Cell, STEP, Texel, color, of_color, steps};
use crate::{TextureError, Wrap};
use alloc::{vec, vec::Vec};

/// One level, or a part of it: rows of premultiplied RGBA in the working space, [`stride`] texels from
/// row to row.
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
    /// Texels in steps; none if they are floats.
    pub(crate) texels: Vec<Texel>,
    /// Texels as floats; none if they are in steps.
    pub(crate) floats: Vec<[f32; 4]>,
    /// The index in `texels` of texel (0, 0), which may not be kept, below zero: what is to be taken
    /// off y·stride + x.
    pub(crate) base: i32,
    /// What an index is cut to, per axis, before it is used: all ones, or a size less one where the
    /// level is a tile whose sides are powers of two.
    pub(crate) mask: [i32; 2],
    pub(crate) frame: Frame,
}

/// Where a level stands in its pyramid, each number per axis.
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct Frame {
    /// From texels of level 0 to texels of this one. Not 2^−l where a size was odd.
    pub(crate) scale: [f64; 2],
    /// The variance that the pyramid has added so far, in squared texels of level 0.
    pub(crate) blurred: [f64; 2],
    /// How far an ellipse may reach from its centre: no bound, except along an axis of one texel,
    /// where there is nothing to see. Anywhere else, an ellipse that is cut short of its length
    /// aliases: over a repeated texture it may well cross many repeats.
    pub(crate) most: [f64; 2],
    /// From where and to where a walk takes the short way: what is kept; nowhere if an index would
    /// not fit 31 bits, and everywhere over tiles that [`Level::mask`] serves.
    pub(crate) low: [f64; 2],
    pub(crate) high: [f64; 2],
}

/// The largest side of a texture, in texels.
pub(crate) const LARGEST: usize = 1 << 29;

/// Texels of the largest level that a walk takes the short way in.
const SHORT: usize = 1 << 31;

/// Texels that follow the last of a row: in a tile the first ones again, so that a run that begins
/// in a row can be read in one piece. [`LANES`](crate::walk::LANES) less one.
pub(crate) const APRON: usize = crate::walk::LANES - 1;

/// Texels from one row of a level to the next.
///
/// Eight texels are a line of the cache. An odd number of lines puts the rows that an ellipse crosses
/// into different sets of it; with the powers of two that textures like to be, they would all fall into
/// one and push each other out. Narrow levels are left alone.
pub(crate) fn stride(width: usize) -> usize {
    let wide = width.saturating_add(APRON);
    if width < 64 { wide } else { (wide.div_ceil(8) | 1).saturating_mul(8) }
}

/// Memory of so many texels. Of the system's pages those that are never written cost nothing.
pub(crate) fn zeroed<T: Clone + Default>(len: usize) -> Result<Vec<T>, TextureError> {
    // Asked for first, so that a refusal is an error; then had zeroed from the system.
    let mut asked = Vec::<T>::new();
    let bytes = len.saturating_mul(size_of::<T>());
    asked.try_reserve_exact(len).map_err(|_| TextureError::OutOfMemory { bytes })?;
    drop(asked);
    Ok(vec![T::default(); len])
}

impl Level {
    /// A level of no meaning, to be filled, in the memory of another if that is of its size.
    pub(crate) fn new<T: Cell>(
        [width, height]: [usize; 2],
        part: [Span; 2],
        mut old: Option<Self>,
    ) -> Result<Self, TextureError> {
        let too_large = TextureError::TooLarge { width, height };
        let [columns, rows] = part;
        let stride = stride(columns.len());
        let len = stride.checked_mul(rows.len()).ok_or(too_large)?;
        len.checked_mul(size_of::<T>()).ok_or(too_large)?;
        let old = old.as_mut().map(|old| core::mem::take(T::memory(old))).unwrap_or_default();
        let most = [width, height].map(|n| if n == 1 { 2.5 } else { f64::INFINITY });
        let low = part.map(|span| span.start as f64);
        let high = part.map(|span| if len < SHORT { span.end as f64 } else { -1.0 });
        let frame = Frame { scale: [1.0; 2], blurred: [0.0; 2], most, low, high };
        // Whatever wraps around here wraps back where it is taken off.
        let base =
            (rows.start as i32).wrapping_mul(stride as i32).wrapping_add(columns.start as i32);
        let mut level = Self {
            width,
            height,
            part,
            stride,
            texels: Vec::new(),
            floats: Vec::new(),
            base,
            mask: [-1; 2],
            frame,
        };
        *T::memory(&mut level) = if old.len() == len {
            old
        } else {
            drop(old);
            zeroed(len)?
        };
        Ok(level)
    }

    /// This level as one over a base of the given size, made by steps that add `step` squared texels
    /// of variance each: m = step·(4^l − 1)/3, with 2^l the true ratio of the sizes.
    pub(crate) fn over(mut self, base: [usize; 2], step: f64) -> Self {
        let scale = [self.width as f64 / base[0] as f64, self.height as f64 / base[1] as f64];
        self.frame.scale = scale;
        self.frame.blurred = scale.map(|s| step * (1.0 / (s * s) - 1.0) / 3.0);
        self
    }

    /// Makes a filled level a tile: rows get their apron, and walks over powers of two go on for
    /// ever.
    pub(crate) fn make_tile(&mut self) {
        let Self { width, height, stride, part, .. } = *self;
        let columns = part[0].len();
        // Floats are read one by one where they wrap.
        for row in self.texels.chunks_exact_mut(stride) {
            for i in 0..APRON {
                row[columns + i] = row[if columns == width { i % columns } else { columns - 1 }];
            }
        }
        let short = self.frame.high[0] > 0.0;
        if short && self.is_whole() && width.is_power_of_two() && height.is_power_of_two() {
            self.mask = [width, height].map(|n| n as i32 - 1);
            self.frame.low = [f64::NEG_INFINITY; 2];
            self.frame.high = [f64::INFINITY; 2];
        }
    }

    /// Whether all of the level is kept.
    pub(crate) fn is_whole(&self) -> bool {
        self.part == [Span::all(self.width), Span::all(self.height)]
    }

    /// Where row `y` of the level, which must exist, is kept; or the row that stands for it.
    #[inline(always)]
    fn start(&self, y: usize) -> usize {
        self.part[1].place(y) * self.stride
    }

    /// The columns of row `y`, which must exist, that are kept, and their apron.
    #[inline(always)]
    pub(crate) fn row_with_apron(&self, y: usize) -> &[Texel] {
        &self.texels[self.start(y)..][..self.part[0].len() + APRON]
    }

    /// The columns of row `y`, which must exist, that are kept.
    #[inline(always)]
    pub(crate) fn row(&self, y: usize) -> &[Texel] {
        &self.texels[self.start(y)..][..self.part[0].len()]
    }

    /// The same to write to, if they are kept.
    pub(crate) fn row_mut<T: Cell>(&mut self, y: usize) -> Option<&mut [T]> {
        let (start, [columns, rows]) = (self.start(y), self.part);
        rows.holds(y).then(|| T::memory(self).get_mut(start..start + columns.len()))?
    }

    /// Where texel (x, y), which is kept, stands in `texels`; elsewhere something of no meaning.
    #[inline(always)]
    pub(crate) fn index(&self, x: i32, y: i32) -> usize {
        let [columns, rows] = self.part.map(|span| span.start as i32);
        let (y, x) = (y.wrapping_sub(rows), x.wrapping_sub(columns));
        (y as u32 as usize).wrapping_mul(self.stride).wrapping_add(x as u32 as usize)
    }

    /// The texel at (x, y), which may lie outside.
    #[inline(always)]
    pub(crate) fn stored(&self, x: i32, y: i32, wrap: Wrap) -> Texel {
        match (wrap.resolve(x, self.width), wrap.resolve(y, self.height)) {
            (Some(x), Some(y)) => self.texels[self.start(y) + self.part[0].place(x)],
            _ => of_color(wrap.border()),
        }
    }

    /// The colour of the texel at (x, y), which may lie outside.
    #[inline(always)]
    pub(crate) fn texel(&self, x: i32, y: i32, wrap: Wrap) -> [f32; 4] {
        if !self.is_float() {
            return color(self.stored(x, y, wrap));
        }
        match (wrap.resolve(x, self.width), wrap.resolve(y, self.height)) {
            (Some(x), Some(y)) => self.floats[self.start(y) + self.part[0].place(x)],
            _ => wrap.border(),
        }
    }

    /// Whether texels are floats.
    #[inline(always)]
    pub(crate) fn is_float(&self) -> bool {
        !self.floats.is_empty()
    }

    /// What a number of a texel is counted in: [`STEP`] or 1.
    #[inline(always)]
    pub(crate) fn unit(&self) -> f32 {
        if self.is_float() { 1.0 } else { STEP }
    }

    /// The colour of the texel at (x, y) in [`Level::unit`]s.
    #[inline(always)]
    pub(crate) fn numbers(&self, x: i32, y: i32, wrap: Wrap) -> [f32; 4] {
        if self.is_float() { self.texel(x, y, wrap) } else { steps(self.stored(x, y, wrap)) }
    }

    /// The mean of the texels that are kept.
    pub(crate) fn mean(&self) -> [f32; 4] {
        let [columns, rows] = self.part;
        let mut sum = [0.0; 4];
        let mut rest = [0i64; 4];
        for y in rows.start..rows.end {
            let start = self.start(y);
            for t in self.floats.get(start..start + columns.len()).unwrap_or(&[]) {
                (0..4).for_each(|c| sum[c] += f64::from(t[c]));
            }
            for t in self.texels.get(start..start + columns.len()).unwrap_or(&[]) {
                (0..4).for_each(|c| rest[c] += i64::from(t[c]));
            }
        }
        let n = columns.len() as f64 * rows.len() as f64;
        core::array::from_fn(|c| ((sum[c] + rest[c] as f64) / n) as f32 * self.unit())
    }
}
