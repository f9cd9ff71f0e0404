use crate::decode::Decoder;
use crate::format::{Alpha, Channels, TexelFormat};
use crate::pyramid::Making;
use crate::texel::Texel;
use crate::{Texture, TextureError, TextureOptions};
use alloc::vec::Vec;
use core::ops::Range;

/// Makes a [`Texture`] of the rows of an image as a decoder yields them.
///
/// The texture is that of [`Texture::from_texels`] over the whole image, bit for bit; but the image is
/// never in memory as a whole, nor is any level that is not kept.
///
/// ```
/// use scumble_geometry::IntRect;
/// use scumble_texture::{Levels, TexelFormat, TextureBuilder, TextureOptions};
///
/// // A picture of 1000×800 that is to be shrunk five times, and only from its upper left part: it is
/// // read in its level 2, of which that part is kept.
/// let options = TextureOptions {
///     levels: Levels::Range { first: 2, last: 2 },
///     window: Some(IntRect::new(0, 0, 500, 300)),
///     ..TextureOptions::default()
/// };
/// let mut builder = TextureBuilder::new(1000, 800, TexelFormat::<[u8; 3], _>::straight(), &options)?;
/// // What lies below the window is not asked for; it may be left out, or skipped where it comes first.
/// let needed = builder.rows_needed();
/// assert!(needed.start == 0 && needed.end < 400);
/// for y in needed {
///     let row: Vec<[u8; 3]> = (0..1000).map(|x| [x as u8, y as u8, 128]).collect();
///     builder.push_row(&row)?;
/// }
/// let texture = builder.finish()?;
/// assert_eq!((texture.width(), texture.height(), texture.level_count()), (1000, 800, 1));
/// assert!(texture.memory() < 160 * 100 * 8);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone)]
pub struct TextureBuilder<P, A> {
    size: [usize; 2],
    options: TextureOptions,
    decoder: Decoder<P, A>,
    making: Work,
    /// Rows that have come.
    rows: usize,
    /// The last row that is needed, and one.
    end: usize,
}

/// The pyramid in the making.
#[derive(Debug, Clone)]
enum Work {
    Compact(Making<Texel>),
    Float(Making<[f32; 4]>),
}

impl Work {
    fn rows(&self) -> Range<usize> {
        match self {
            Self::Compact(making) => making.rows(),
            Self::Float(making) => making.rows(),
        }
    }

    /// The row that must come next.
    fn next(&self) -> Option<usize> {
        match self {
            Self::Compact(making) => making.next(),
            Self::Float(making) => making.next(),
        }
    }
}

impl<P: Channels, A: Alpha> TextureBuilder<P, A> {
    /// A builder for an image of a size whose pixels have a format. All memory is had here.
    ///
    /// # Errors
    /// As for [`Texture::new`].
    pub fn new(
        width: usize,
        height: usize,
        format: TexelFormat<P, A>,
        options: &TextureOptions,
    ) -> Result<Self, TextureError> {
        Self::over(width, height, format, options, None)
    }

    /// The same in the memory of another texture, where its levels have the same sizes: for the frames
    /// of a film. Fresh memory costs about as much as the pyramid.
    ///
    /// # Errors
    /// As for [`Texture::new`].
    pub fn renewing(
        texture: Texture,
        width: usize,
        height: usize,
        format: TexelFormat<P, A>,
        options: &TextureOptions,
    ) -> Result<Self, TextureError> {
        Self::over(width, height, format, options, Some(texture))
    }

    fn over(
        width: usize,
        height: usize,
        format: TexelFormat<P, A>,
        options: &TextureOptions,
        old: Option<Texture>,
    ) -> Result<Self, TextureError> {
        let size = [width, height];
        Texture::check(size, options)?;
        let decoder = Decoder::new(format, options.space, width.saturating_mul(height));
        let old = old.map_or(Vec::new(), |old| old.levels);
        let making = if options.storage.is_float(format.is_of_bytes()) {
            Work::Float(Making::new(size, options, false, old)?)
        } else {
            Work::Compact(Making::new(size, options, decoder.has_codes(|| !P::ALPHA), old)?)
        };
        let end = making.rows().end;
        Ok(Self { size, options: *options, decoder, making, rows: 0, end })
    }

    /// The rows that matter, from the first still to come: all but for
    /// [`TextureOptions::window`]. Earlier ones may be [skipped](TextureBuilder::skip_rows), later ones
    /// left out. Empty once no more matter.
    #[must_use]
    pub fn rows_needed(&self) -> Range<usize> {
        self.making.next().map_or(self.end..self.end, |next| next..self.end)
    }

    /// Takes the next row of the image, all of it.
    ///
    /// # Errors
    /// [`TextureError::Row`] if it is not as long as the image is wide, or if all rows have come; the
    /// builder is as before then.
    pub fn push_row(&mut self, row: &[P]) -> Result<(), TextureError> {
        let [width, height] = self.size;
        if row.len() != width || self.rows >= height {
            return Err(TextureError::Row { row: self.rows });
        }
        if self.making.next() == Some(self.rows) {
            match &mut self.making {
                Work::Compact(making) => making.push(&self.decoder, row),
                Work::Float(making) => making.push(&self.decoder, row),
            }
        }
        self.rows += 1;
        Ok(())
    }

    /// Takes the next rows of the image, one after the other; as many as there are in `rows`.
    ///
    /// # Errors
    /// [`TextureError::Row`] if the length is not a multiple of the image's width, or if more rows come
    /// than the image has; the builder is as before then.
    pub fn push_rows(&mut self, rows: &[P]) -> Result<(), TextureError> {
        let [width, height] = self.size;
        if !rows.len().is_multiple_of(width) || rows.len() / width > height - self.rows {
            return Err(TextureError::Row { row: self.rows });
        }
        rows.chunks_exact(width).try_for_each(|row| self.push_row(row))
    }

    /// Passes over rows that do not matter, up to the first that does: at most `count`. Returns how many.
    pub fn skip_rows(&mut self, count: usize) -> usize {
        let free = self.making.next().unwrap_or(self.size[1]).saturating_sub(self.rows);
        let skipped = free.min(count);
        self.rows += skipped;
        skipped
    }

    /// The texture.
    ///
    /// # Errors
    /// [`TextureError::Incomplete`] if a row that matters has not come.
    pub fn finish(self) -> Result<Texture, TextureError> {
        if let Some(row) = self.making.next() {
            return Err(TextureError::Incomplete { row });
        }
        let levels = match self.making {
            Work::Compact(making) => making.finish(),
            Work::Float(making) => making.finish(),
        };
        Texture::over(levels, self.size, &self.options, self.decoder.is_bounded())
    }
}
