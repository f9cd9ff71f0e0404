use alloc::{vec, vec::Vec};

/// Why an image or a view cannot be made.
#[derive(Debug, Clone, Copy, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum ImageError {
    /// The buffer is too short for the width, height and stride.
    #[error("the buffer holds {found} pixels, {needed} are needed")]
    TooShort {
        /// Pixels that the shape asks for.
        needed: usize,
        /// Pixels that the buffer holds.
        found: usize,
    },
    /// The stride is less than the width.
    #[error("the stride {stride} is less than the width {width}")]
    Stride {
        /// Pixels from one row to the next.
        stride: usize,
        /// Pixels in a row.
        width: usize,
    },
    /// Width × height does not fit the address space.
    #[error("an image of {width} by {height} pixels is too large")]
    TooLarge {
        /// Columns.
        width: usize,
        /// Rows.
        height: usize,
    },
}

/// An owned image: rows of pixels, top to bottom, no padding.
#[derive(Debug, Clone, PartialEq)]
pub struct Image<P> {
    width: usize,
    height: usize,
    data: Vec<P>,
}

/// A borrowed image: rows of pixels, top to bottom, `stride` pixels from row to row.
#[derive(Debug, Clone, Copy)]
pub struct ImageView<'a, P> {
    width: usize,
    height: usize,
    stride: usize,
    data: &'a [P],
}

/// An image without pixels.
impl<P> Default for Image<P> {
    fn default() -> Self {
        Self { width: 0, height: 0, data: Vec::new() }
    }
}

impl<P: Clone> Image<P> {
    /// An image with every pixel equal to `pixel`.
    ///
    /// # Errors
    /// [`ImageError::TooLarge`] if width × height overflows.
    pub fn filled(width: usize, height: usize, pixel: P) -> Result<Self, ImageError> {
        let len = width.checked_mul(height).ok_or(ImageError::TooLarge { width, height })?;
        Ok(Self { width, height, data: vec![pixel; len] })
    }
}

impl<P> Image<P> {
    /// An image over `width * height` pixels, row by row.
    ///
    /// # Errors
    /// [`ImageError::TooShort`] unless the length is exactly width × height;
    /// [`ImageError::TooLarge`] if that overflows.
    pub fn from_vec(width: usize, height: usize, data: Vec<P>) -> Result<Self, ImageError> {
        let needed = width.checked_mul(height).ok_or(ImageError::TooLarge { width, height })?;
        if data.len() != needed {
            return Err(ImageError::TooShort { needed, found: data.len() });
        }
        Ok(Self { width, height, data })
    }

    /// Columns.
    #[must_use]
    pub fn width(&self) -> usize {
        self.width
    }

    /// Rows.
    #[must_use]
    pub fn height(&self) -> usize {
        self.height
    }

    /// All pixels, row by row.
    #[must_use]
    pub fn pixels(&self) -> &[P] {
        &self.data
    }

    /// All pixels, row by row.
    pub fn pixels_mut(&mut self) -> &mut [P] {
        &mut self.data
    }

    /// One row; empty if `y` is outside.
    #[must_use]
    pub fn row(&self, y: usize) -> &[P] {
        self.view().row(y)
    }

    /// The pixels as a vector.
    #[must_use]
    pub fn into_vec(self) -> Vec<P> {
        self.data
    }

    /// A borrowed view of the whole.
    #[must_use]
    pub fn view(&self) -> ImageView<'_, P> {
        ImageView { width: self.width, height: self.height, stride: self.width, data: &self.data }
    }
}

impl<'a, P> ImageView<'a, P> {
    /// A view of foreign memory: row y starts at `y * stride`.
    ///
    /// # Errors
    /// [`ImageError`] if the stride is less than the width or the slice ends before the last row.
    pub fn new(
        width: usize,
        height: usize,
        stride: usize,
        data: &'a [P],
    ) -> Result<Self, ImageError> {
        if stride < width {
            return Err(ImageError::Stride { stride, width });
        }
        let needed = match height.checked_sub(1) {
            None => 0,
            Some(rows) => rows
                .checked_mul(stride)
                .and_then(|n| n.checked_add(width))
                .ok_or(ImageError::TooLarge { width, height })?,
        };
        if data.len() < needed {
            return Err(ImageError::TooShort { needed, found: data.len() });
        }
        Ok(Self { width, height, stride, data })
    }

    /// Columns.
    #[must_use]
    pub fn width(&self) -> usize {
        self.width
    }

    /// Rows.
    #[must_use]
    pub fn height(&self) -> usize {
        self.height
    }

    /// One row; empty if `y` is outside.
    #[must_use]
    pub fn row(&self, y: usize) -> &'a [P] {
        if y >= self.height {
            return &[];
        }
        let start = y * self.stride;
        self.data.get(start..start + self.width).unwrap_or(&[])
    }
}
