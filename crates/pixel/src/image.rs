use alloc::vec::Vec;

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
    /// Width × height overflows, or there is no memory for so many pixels.
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
#[derive(Debug)]
pub struct ImageView<'a, P> {
    width: usize,
    height: usize,
    stride: usize,
    data: &'a [P],
}

// Not derived: a view is `Copy` whatever its pixels are.
impl<P> Clone for ImageView<'_, P> {
    fn clone(&self) -> Self {
        *self
    }
}

impl<P> Copy for ImageView<'_, P> {}

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
    /// [`ImageError::TooLarge`] if there is no memory for width × height pixels.
    pub fn filled(width: usize, height: usize, pixel: P) -> Result<Self, ImageError> {
        let (len, mut data) = allocate(width, height)?;
        data.resize(len, pixel);
        Ok(Self { width, height, data })
    }
}

impl<P> Image<P> {
    /// An image whose pixel in column x of row y is `pixel(x, y)`, called row by row.
    ///
    /// ```
    /// use scumble_pixel::Image;
    ///
    /// let checker = Image::from_fn(4, 2, |x, y| (x + y) % 2).unwrap();
    /// assert_eq!(checker.row(1), [1, 0, 1, 0]);
    /// ```
    ///
    /// # Errors
    /// [`ImageError::TooLarge`] if there is no memory for width × height pixels.
    pub fn from_fn(
        width: usize,
        height: usize,
        mut pixel: impl FnMut(usize, usize) -> P,
    ) -> Result<Self, ImageError> {
        let (len, mut data) = allocate(width, height)?;
        if len > 0 {
            for y in 0..height {
                data.extend((0..width).map(|x| pixel(x, y)));
            }
        }
        Ok(Self { width, height, data })
    }

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

    /// One row to write to; empty if `y` is outside.
    pub fn row_mut(&mut self, y: usize) -> &mut [P] {
        if y >= self.height {
            return &mut [];
        }
        let start = y * self.width;
        self.data.get_mut(start..start + self.width).unwrap_or(&mut [])
    }

    /// One pixel; `None` outside.
    #[must_use]
    pub fn get(&self, x: usize, y: usize) -> Option<&P> {
        self.row(y).get(x)
    }

    /// An image of the same shape with `f` of every pixel.
    #[must_use]
    pub fn map<Q>(&self, f: impl FnMut(&P) -> Q) -> Image<Q> {
        let data = self.data.iter().map(f).collect();
        Image { width: self.width, height: self.height, data }
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

    /// One pixel; `None` outside.
    #[must_use]
    pub fn get(&self, x: usize, y: usize) -> Option<&'a P> {
        self.row(y).get(x)
    }

    /// The rows, top to bottom.
    pub fn rows(&self) -> impl ExactSizeIterator<Item = &'a [P]> + use<'a, P> {
        let view = *self;
        (0..self.height).map(move |y| view.row(y))
    }

    /// The part of this view that lies within `width` × `height` pixels from (`x`, `y`) on; empty
    /// if none does.
    ///
    /// ```
    /// use scumble_pixel::Image;
    ///
    /// let image = Image::from_fn(4, 4, |x, y| 10 * y + x).unwrap();
    /// let part = image.view().crop(1, 2, 2, 9);
    /// assert_eq!((part.width(), part.height()), (2, 2));
    /// assert_eq!(part.row(1), [31, 32]);
    /// ```
    #[must_use]
    pub fn crop(&self, x: usize, y: usize, width: usize, height: usize) -> Self {
        let width = width.min(self.width.saturating_sub(x));
        let height = height.min(self.height.saturating_sub(y));
        if width == 0 || height == 0 {
            return Self { width, height, stride: self.stride, data: &[] };
        }
        // In range: the view was checked to hold its last row, and (x, y) lies in it.
        let data = self.data.get(y * self.stride + x..).unwrap_or(&[]);
        Self { width, height, stride: self.stride, data }
    }

    /// A copy without padding.
    #[must_use]
    pub fn to_image(&self) -> Image<P>
    where
        P: Clone,
    {
        let data = self.rows().flatten().cloned().collect();
        Image { width: self.width, height: self.height, data }
    }
}

/// Width × height, and room for as many pixels.
fn allocate<P>(width: usize, height: usize) -> Result<(usize, Vec<P>), ImageError> {
    let too_large = ImageError::TooLarge { width, height };
    let len = width.checked_mul(height).ok_or(too_large)?;
    let mut data = Vec::new();
    data.try_reserve_exact(len).map_err(|_| too_large)?;
    Ok((len, data))
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    #[test]
    fn shapes_are_checked() {
        assert_eq!(
            Image::from_vec(2, 2, vec![0; 3]),
            Err(ImageError::TooShort { needed: 4, found: 3 })
        );
        let (width, height) = (usize::MAX, 2);
        assert_eq!(Image::filled(width, height, 0), Err(ImageError::TooLarge { width, height }));
        assert!(Image::from_fn(width, height, |_, _| 0).is_err());
        // The count fits, the bytes do not.
        assert!(Image::filled(usize::MAX, 1, 0_u64).is_err());
        assert_eq!(Image::from_fn(0, usize::MAX, |_, _| 0).unwrap().width(), 0);
        assert!(ImageView::new(2, 2, 1, &[0; 9]).is_err());
        assert!(ImageView::new(2, 2, 3, &[0; 4]).is_err());
        assert!(ImageView::new(2, 2, 3, &[0; 5]).is_ok());
        assert!(ImageView::new(1, usize::MAX, 2, &[0; 5]).is_err());
        assert!(ImageView::<u8>::new(5, 0, 5, &[]).is_ok());
    }

    #[test]
    fn an_image_without_rows_or_columns() {
        for (width, height) in [(0, 0), (0, 3), (3, 0)] {
            let image = Image::filled(width, height, 7).unwrap();
            assert!(image.view().rows().all(<[i32]>::is_empty));
            assert_eq!(image.view().rows().len(), height);
            assert_eq!(image.get(0, 0), None);
            assert_eq!(image.view().to_image(), image);
        }
    }

    #[test]
    fn rows_can_be_written() {
        let mut image = Image::filled(3, 2, 0).unwrap();
        image.row_mut(1).fill(5);
        assert!(image.row_mut(2).is_empty());
        assert_eq!(image.pixels(), [0, 0, 0, 5, 5, 5]);
        assert_eq!(image.map(|v| v * 2).into_vec(), [0, 0, 0, 10, 10, 10]);
    }

    proptest! {
        #[test]
        fn a_crop_is_that_part(
            (w, h) in (0..9_usize, 0..9_usize),
            padding in 0..3_usize,
            (x, y, cw, ch) in (0..12_usize, 0..12_usize, 0..12_usize, 0..12_usize),
        ) {
            let stride = w + padding;
            let data: Vec<usize> = (0..stride * h).collect();
            let view = ImageView::new(w, h, stride, &data).unwrap();
            let part = view.crop(x, y, cw, ch);
            prop_assert_eq!(part.width(), cw.min(w.saturating_sub(x)));
            prop_assert_eq!(part.height(), ch.min(h.saturating_sub(y)));
            for (j, row) in part.rows().enumerate() {
                prop_assert_eq!(row.len(), part.width());
                for (i, &value) in row.iter().enumerate() {
                    prop_assert_eq!(value, (y + j) * stride + x + i);
                }
            }
            let whole = part.to_image();
            prop_assert_eq!(part.crop(0, 0, usize::MAX, usize::MAX).to_image(), whole);
            prop_assert!(part.crop(usize::MAX, usize::MAX, 1, 1).rows().next().is_none());
        }
    }
}
