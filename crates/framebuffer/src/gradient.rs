use scumble_pixel::Premul;

/// A colour that changes evenly over the pixels of a tile and is kept within a range: what a key of
/// a [`Visibility`](crate::Visibility) may stand for.
///
/// ```
/// use scumble_framebuffer::Gradient;
///
/// let (here, right, below) = ([0.5, 0.5, 0.5, 1.0], [0.25, 0.0, -1.0, 0.0], [0.0, 0.125, 0.0, 0.0]);
/// let gradient = Gradient::new((2, 0), [here, right, below], [[0.0, 0.0, 0.0, 1.0], [1.0; 4]]);
/// assert_eq!(gradient.at(3, 1).0, [0.75, 0.625, 0.0, 1.0]);
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Gradient {
    pub(crate) here: [f32; 4],
    pub(crate) right: [f32; 4],
    pub(crate) below: [f32; 4],
    pub(crate) low: [f32; 4],
    pub(crate) high: [f32; 4],
    pub(crate) column: i32,
    pub(crate) row: i32,
    /// Whether it is opaque and within 0 to 1 throughout.
    pub(crate) is_plain: bool,
}

impl Gradient {
    /// Counted from the pixel (`column`, `row`) of the tile, which may be anywhere: the colour there,
    /// its change from a pixel to the one on the right and to the one below; and the least and the most
    /// of each component. Numbers should be so small that no sum overflows.
    #[must_use]
    #[inline]
    pub fn new(
        (column, row): (i32, i32),
        [here, right, below]: [[f32; 4]; 3],
        [low, high]: [[f32; 4]; 2],
    ) -> Self {
        // All looked at, whatever comes first: side by side, and with no branch.
        let mut is_plain = low[3] == 1.0 && high[3] == 1.0;
        for (low, high) in low.iter().zip(&high) {
            is_plain &= (*low >= 0.0) & (*low <= 1.0) & (*high >= 0.0) & (*high <= 1.0);
        }
        Self { here, right, below, low, high, column, row, is_plain }
    }

    /// The same everywhere.
    #[must_use]
    #[inline]
    pub fn constant(color: Premul) -> Self {
        Self::new((0, 0), [color.0, [0.0; 4], [0.0; 4]], [color.0; 2])
    }

    /// The colour of pixel (`x`, `y`): that of the first pixel, plus `below` × rows, plus `right` ×
    /// columns, in this order, each component then brought into its range.
    #[must_use]
    #[inline(always)]
    pub fn at(&self, x: u32, y: u32) -> Premul {
        let columns = (x as i32).wrapping_sub(self.column) as f32;
        let rows = (y as i32).wrapping_sub(self.row) as f32;
        let mut color = self.here;
        for (i, v) in color.iter_mut().enumerate() {
            *v = (*v + self.below[i] * rows) + self.right[i] * columns;
            // Comparisons in this form are one instruction each.
            let above = if *v > self.low[i] { *v } else { self.low[i] };
            *v = if above < self.high[i] { above } else { self.high[i] };
        }
        Premul(color)
    }
}
