use crate::{TextureError, Wrap};
use alloc::vec::Vec;

/// One level: rows of premultiplied RGBA in the working space, no padding.
#[derive(Debug, Clone)]
pub(crate) struct Level {
    pub(crate) width: usize,
    pub(crate) height: usize,
    pub(crate) texels: Vec<[f32; 4]>,
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
        Ok(Self { width, height, texels })
    }

    /// The texels of row `y`, which must exist.
    #[inline(always)]
    pub(crate) fn row(&self, y: usize) -> &[[f32; 4]] {
        &self.texels[y * self.width..][..self.width]
    }

    /// The texel at (x, y), which may lie outside.
    #[inline]
    pub(crate) fn texel(&self, x: i64, y: i64, wrap: Wrap) -> [f32; 4] {
        match (wrap.resolve(x, self.width), wrap.resolve(y, self.height)) {
            (Some(x), Some(y)) => self.texels[y * self.width + x],
            _ => wrap.border(),
        }
    }
}
