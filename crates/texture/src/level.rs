use crate::{TextureError, Wrap};
use alloc::vec::Vec;

/// One level: rows of premultiplied RGBA in the working space, no padding.
#[derive(Debug, Clone)]
pub(crate) struct Level {
    pub(crate) width: usize,
    pub(crate) height: usize,
    pub(crate) texels: Vec<[f32; 4]>,
    /// From texels of level 0 to texels of this one, per axis. Not 2^−l where a size was odd.
    pub(crate) scale: [f64; 2],
    /// The variance that the pyramid has added so far, per axis, in squared texels of level 0.
    pub(crate) blurred: [f64; 2],
    /// How far an ellipse may reach from its centre, per axis: no bound, except along an axis of one
    /// texel. An ellipse that is cut short of its length aliases: over a repeated texture it may
    /// well cross many repeats.
    pub(crate) most: [f64; 2],
}

impl Level {
    /// A level of nothing, to be filled.
    pub(crate) fn new(width: usize, height: usize) -> Result<Self, TextureError> {
        let len = width.checked_mul(height).ok_or(TextureError::TooLarge { width, height })?;
        let bytes = len
            .checked_mul(size_of::<[f32; 4]>())
            .ok_or(TextureError::TooLarge { width, height })?;
        let mut texels = Vec::new();
        texels.try_reserve_exact(len).map_err(|_| TextureError::OutOfMemory { bytes })?;
        texels.resize(len, [0.0; 4]);
        let most = [width, height].map(|n| if n == 1 { 2.5 } else { f64::INFINITY });
        Ok(Self { width, height, texels, scale: [1.0; 2], blurred: [0.0; 2], most })
    }

    /// This level as one over a base of the given size, made by steps that add `step` squared texels
    /// of variance each: m = step·(4^l − 1)/3, with 2^l the true ratio of the sizes.
    pub(crate) fn over(self, base: [usize; 2], step: f64) -> Self {
        let scale = [self.width as f64 / base[0] as f64, self.height as f64 / base[1] as f64];
        let blurred = scale.map(|s| step * (1.0 / (s * s) - 1.0) / 3.0);
        Self { scale, blurred, ..self }
    }

    /// The texels of row `y`, which must exist.
    #[inline(always)]
    pub(crate) fn row(&self, y: usize) -> &[[f32; 4]] {
        &self.texels[y * self.width..][..self.width]
    }

    /// The texel at (x, y), which may lie outside.
    #[inline(always)]
    pub(crate) fn texel(&self, x: i64, y: i64, wrap: Wrap) -> [f32; 4] {
        match (wrap.resolve(x, self.width), wrap.resolve(y, self.height)) {
            (Some(x), Some(y)) => self.texels[y * self.width + x],
            _ => wrap.border(),
        }
    }
}
