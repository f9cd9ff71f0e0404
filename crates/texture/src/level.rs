use crate::texel::{Texel, color, of_color};
use crate::{TextureError, Wrap};
use alloc::{vec, vec::Vec};

/// One level: rows of premultiplied RGBA in the working space, [`stride`] texels from row to row.
#[derive(Debug, Clone)]
pub(crate) struct Level {
    pub(crate) width: usize,
    pub(crate) height: usize,
    pub(crate) stride: usize,
    pub(crate) texels: Vec<Texel>,
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
    /// From where and to where a walk takes the short way; nowhere if an index would not fit 31
    /// bits, and everywhere over tiles that [`Level::mask`] serves.
    pub(crate) low: f64,
    pub(crate) size: [f64; 2],
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

impl Level {
    /// A level of no meaning, to be filled, in the memory of another if that is of its size.
    pub(crate) fn new(width: usize, height: usize, old: Vec<Texel>) -> Result<Self, TextureError> {
        let stride = stride(width);
        let len = stride.checked_mul(height).ok_or(TextureError::TooLarge { width, height })?;
        let bytes =
            len.checked_mul(size_of::<Texel>()).ok_or(TextureError::TooLarge { width, height })?;
        let texels = if old.len() == len {
            old
        } else {
            drop(old);
            // Asked for first, so that a refusal is an error; then had zeroed from the system, which
            // costs nothing until it is written.
            let mut asked = Vec::<Texel>::new();
            asked.try_reserve_exact(len).map_err(|_| TextureError::OutOfMemory { bytes })?;
            drop(asked);
            vec![[0; 4]; len]
        };
        let most = [width, height].map(|n| if n == 1 { 2.5 } else { f64::INFINITY });
        let size = if len < SHORT { [width as f64, height as f64] } else { [0.0; 2] };
        let frame = Frame { scale: [1.0; 2], blurred: [0.0; 2], most, low: 0.0, size };
        Ok(Self { width, height, stride, texels, mask: [-1; 2], frame })
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
        let Self { width, height, stride, .. } = *self;
        for row in self.texels.chunks_exact_mut(stride) {
            for i in 0..APRON {
                row[width + i] = row[i % width];
            }
        }
        if self.frame.size[0] > 0.0 && width.is_power_of_two() && height.is_power_of_two() {
            self.mask = [width, height].map(|n| n as i32 - 1);
            self.frame.low = f64::NEG_INFINITY;
            self.frame.size = [f64::INFINITY; 2];
        }
    }

    /// The texels of row `y`, which must exist, and its apron.
    #[inline(always)]
    pub(crate) fn row_with_apron(&self, y: usize) -> &[Texel] {
        &self.texels[y * self.stride..][..self.width + APRON]
    }

    /// The texels of row `y`, which must exist.
    #[inline(always)]
    pub(crate) fn row(&self, y: usize) -> &[Texel] {
        &self.texels[y * self.stride..][..self.width]
    }

    /// The texel at (x, y), which may lie outside.
    #[inline(always)]
    pub(crate) fn stored(&self, x: i32, y: i32, wrap: Wrap) -> Texel {
        match (wrap.resolve(x, self.width), wrap.resolve(y, self.height)) {
            (Some(x), Some(y)) => self.texels[y * self.stride + x],
            _ => of_color(wrap.border()),
        }
    }

    /// The colour of the texel at (x, y), which may lie outside.
    #[inline(always)]
    pub(crate) fn texel(&self, x: i32, y: i32, wrap: Wrap) -> [f32; 4] {
        color(self.stored(x, y, wrap))
    }
}
