use crate::{DVec2, Rect};
use alloc::vec::Vec;

/// Outlines made of straight edges, all in one list of points.
///
/// Contour i is `points[ends[i-1]..ends[i]]`, and 0 stands for `ends[-1]`. For a fill every
/// contour is closed: its last point joins its first, which is not repeated.
///
/// ```
/// use scumble_geometry::{Contours, DVec2};
/// let mut contours = Contours::new();
/// contours.push([(0.0, 0.0), (4.0, 0.0), (0.0, 4.0)].map(|(x, y)| DVec2::new(x, y)));
/// contours.push([(1.0, 1.0), (2.0, 1.0), (1.0, 2.0)].map(|(x, y)| DVec2::new(x, y)));
/// assert_eq!(contours.len(), 2);
/// assert_eq!(contours.iter().map(|c| c.len()).sum::<usize>(), contours.points.len());
/// ```
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Contours {
    /// The points of all contours, one contour after the other.
    pub points: Vec<DVec2>,
    /// For each contour, the index in `points` just after its last point; never decreasing.
    pub ends: Vec<usize>,
}

impl Contours {
    /// No contour.
    #[must_use]
    pub const fn new() -> Self {
        Self { points: Vec::new(), ends: Vec::new() }
    }

    /// Appends a contour; one without points is left out.
    pub fn push(&mut self, contour: impl IntoIterator<Item = DVec2>) {
        self.points.extend(contour);
        self.finish();
    }

    /// Makes a contour of the points that were pushed since the last one; nothing if there are
    /// none.
    pub fn finish(&mut self) {
        if self.points.len() > self.ends.last().copied().unwrap_or(0) {
            self.ends.push(self.points.len());
        }
    }

    /// Each contour as a slice of points.
    pub fn iter(&self) -> impl Iterator<Item = &[DVec2]> + Clone {
        let starts = core::iter::once(0).chain(self.ends.iter().copied());
        // An index that does not fit, in a value made by hand, gives an empty contour.
        starts.zip(&self.ends).map(|(start, &end)| self.points.get(start..end).unwrap_or(&[]))
    }

    /// How many contours there are.
    #[must_use]
    pub fn len(&self) -> usize {
        self.ends.len()
    }

    /// Whether there is no contour.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.ends.is_empty()
    }

    /// Removes all contours and keeps the memory.
    pub fn clear(&mut self) {
        self.points.clear();
        self.ends.clear();
    }

    /// The smallest rectangle that holds all points; `None` if there is none or a coordinate is
    /// NaN.
    #[must_use]
    pub fn bounds(&self) -> Option<Rect> {
        Rect::bounding(self.points.iter().copied())
    }
}
