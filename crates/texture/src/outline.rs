use scumble_geometry::IntRect;

/// Bands of rows into which an image is cut.
const BANDS: usize = 32;

/// A part of an image that is not a rectangle: in each of 32 bands of rows, as high as each other, the
/// columns from a first to a last.
///
/// ```
/// use scumble_geometry::IntRect;
/// use scumble_texture::Outline;
///
/// let mut outline = Outline::new(640);
/// outline.add(IntRect::new(100, 0, 200, 10));
/// outline.add(IntRect::new(150, 70, 400, 80));
/// assert_eq!(outline.columns(5, 6), Some([100, 200]));
/// assert_eq!(outline.columns(0, 640), Some([100, 400]));
/// assert_eq!(outline.columns(300, 400), None);
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Outline {
    height: i32,
    /// The first and the end of the rows.
    rows: [i32; 2],
    /// The first and the end of the columns of each band, the first not before the end where there are
    /// none.
    bands: [[i32; 2]; BANDS],
}

impl Outline {
    /// Nothing, of an image with so many rows.
    #[must_use]
    pub fn new(height: usize) -> Self {
        let height = i32::try_from(height).unwrap_or(i32::MAX).max(1);
        Self { height, rows: NOTHING, bands: [NOTHING; BANDS] }
    }

    /// Adds a rectangle of texels, cut to the image's rows. More than it may come in: all of the bands
    /// that it touches, and what lies between it and what was there.
    pub fn add(&mut self, part: IntRect) {
        let (first, end) = (part.y0.max(0), part.y1.min(self.height));
        if part.x0 >= part.x1 || first >= end {
            return;
        }
        self.rows = hull(self.rows, [first, end]);
        for band in &mut self.bands[touched(self.height, first, end)] {
            *band = hull(*band, [part.x0, part.x1]);
        }
    }

    /// The columns from a first to an end that hold all that is read in rows from a first to an end;
    /// `None` if nothing is.
    #[must_use]
    pub fn columns(&self, first: i32, end: i32) -> Option<[i32; 2]> {
        let bands = &self.bands[touched(self.height, first, end)];
        let columns = bands.iter().fold(NOTHING, |all, band| hull(all, *band));
        (columns[0] < columns[1]).then_some(columns)
    }

    /// The least rectangle that holds all that was added.
    pub(crate) fn bounds(&self) -> IntRect {
        let [first, end] = self.rows;
        let none = IntRect::new(0, 0, 0, 0);
        self.columns(first, end).map_or(none, |[x0, x1]| IntRect::new(x0, first, x1, end))
    }
}

/// No rows, or no columns.
const NOTHING: [i32; 2] = [i32::MAX, i32::MIN];

/// From the first of both to the end of both.
fn hull([a, b]: [i32; 2], [c, d]: [i32; 2]) -> [i32; 2] {
    [a.min(c), b.max(d)]
}

/// The bands that rows from a first to an end touch; none if there are no rows.
fn touched(height: i32, first: i32, end: i32) -> core::ops::Range<usize> {
    let (first, end) = (first.clamp(0, height), end.clamp(0, height));
    if first >= end {
        return 0..0;
    }
    // In 64 bits: the height may be 2³¹ − 1. At most 31 and 32.
    let band = |row: i32| (i64::from(row) * BANDS as i64 / i64::from(height)) as usize;
    band(first)..band(end - 1) + 1
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn what_was_added_is_held(
            height in prop_oneof![1usize..100, Just(i32::MAX as usize), Just(usize::MAX)],
            parts in prop::collection::vec(prop::array::uniform4(any::<i32>()), 1..5),
            row: i32,
        ) {
            let mut outline = Outline::new(height);
            let parts = parts.iter().map(|[x0, y0, x1, y1]| IntRect::new(*x0, *y0, *x1, *y1));
            let parts: Vec<IntRect> = parts.collect();
            parts.iter().for_each(|part| outline.add(*part));
            let rows = i32::try_from(height).unwrap_or(i32::MAX);
            for part in &parts {
                let (first, end) = (part.y0.max(0), part.y1.min(rows));
                if part.x0 >= part.x1 || first >= end {
                    continue;
                }
                let row = row.clamp(first, end - 1);
                let columns = outline.columns(row, row + 1);
                let held = columns.is_some_and(|[x0, x1]| x0 <= part.x0 && part.x1 <= x1);
                prop_assert!(held, "{columns:?} {part:?}");
                let bounds = outline.bounds();
                prop_assert!(bounds.x0 <= part.x0 && part.x1 <= bounds.x1, "{bounds:?} {part:?}");
                prop_assert!(bounds.y0 <= first && end <= bounds.y1, "{bounds:?} {part:?}");
            }
        }
    }
}
