use crate::DVec2;

/// An axis-aligned rectangle with real corners; empty unless `x0 < x1` and `y0 < y1`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Rect {
    /// Left.
    pub x0: f64,
    /// Top.
    pub y0: f64,
    /// Right.
    pub x1: f64,
    /// Bottom.
    pub y1: f64,
}

impl Rect {
    /// The rectangle with the corners (x0, y0) and (x1, y1).
    #[must_use]
    pub const fn new(x0: f64, y0: f64, x1: f64, y1: f64) -> Self {
        Self { x0, y0, x1, y1 }
    }

    /// The rectangle at (x, y) with the given size.
    #[must_use]
    pub fn from_size(x: f64, y: f64, width: f64, height: f64) -> Self {
        Self { x0: x, y0: y, x1: x + width, y1: y + height }
    }

    /// The smallest rectangle that holds all points; `None` for no point or a NaN coordinate.
    pub fn bounding(points: impl IntoIterator<Item = DVec2>) -> Option<Self> {
        let mut points = points.into_iter();
        let first = points.next()?;
        let mut bounds = Self::new(first.x, first.y, first.x, first.y);
        let mut nan = first.is_nan();
        for p in points {
            nan |= p.is_nan();
            bounds.x0 = bounds.x0.min(p.x);
            bounds.y0 = bounds.y0.min(p.y);
            bounds.x1 = bounds.x1.max(p.x);
            bounds.y1 = bounds.y1.max(p.y);
        }
        (!nan).then_some(bounds)
    }

    /// Width; negative for a rectangle turned inside out.
    #[must_use]
    pub fn width(&self) -> f64 {
        self.x1 - self.x0
    }

    /// Height; negative for a rectangle turned inside out.
    #[must_use]
    pub fn height(&self) -> f64 {
        self.y1 - self.y0
    }

    /// Whether it holds no area.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        // Written so that a NaN counts as empty.
        !(self.x0 < self.x1 && self.y0 < self.y1)
    }

    /// The four corners, clockwise from the top left.
    #[must_use]
    pub fn corners(&self) -> [DVec2; 4] {
        [
            DVec2::new(self.x0, self.y0),
            DVec2::new(self.x1, self.y0),
            DVec2::new(self.x1, self.y1),
            DVec2::new(self.x0, self.y1),
        ]
    }
}

/// A half-open rectangle of whole pixels: columns `x0..x1`, rows `y0..y1`.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub struct IntRect {
    /// First column.
    pub x0: i32,
    /// First row.
    pub y0: i32,
    /// One past the last column.
    pub x1: i32,
    /// One past the last row.
    pub y1: i32,
}

impl IntRect {
    /// The pixels `x0..x1` × `y0..y1`.
    #[must_use]
    pub const fn new(x0: i32, y0: i32, x1: i32, y1: i32) -> Self {
        Self { x0, y0, x1, y1 }
    }

    /// Columns; 0 if empty.
    #[must_use]
    pub fn width(&self) -> u32 {
        if self.x1 > self.x0 { self.x1.abs_diff(self.x0) } else { 0 }
    }

    /// Rows; 0 if empty.
    #[must_use]
    pub fn height(&self) -> u32 {
        if self.y1 > self.y0 { self.y1.abs_diff(self.y0) } else { 0 }
    }

    /// Whether it holds no pixel.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.x0 >= self.x1 || self.y0 >= self.y1
    }

    /// The pixels that both hold; possibly empty.
    #[must_use]
    pub fn intersect(&self, other: &Self) -> Self {
        Self {
            x0: self.x0.max(other.x0),
            y0: self.y0.max(other.y0),
            x1: self.x1.min(other.x1),
            y1: self.y1.min(other.y1),
        }
    }

    /// Its four quarters, row by row; some are empty if a side is 1.
    #[must_use]
    pub fn quarters(&self) -> [Self; 4] {
        let Self { x0, y0, x1, y1 } = *self;
        let (x, y) = (x0.midpoint(x1), y0.midpoint(y1));
        [
            Self::new(x0, y0, x, y),
            Self::new(x, y0, x1, y),
            Self::new(x0, y, x, y1),
            Self::new(x, y, x1, y1),
        ]
    }

    /// Whether pixel (x, y) is in it.
    #[must_use]
    pub fn contains(&self, x: i32, y: i32) -> bool {
        (self.x0..self.x1).contains(&x) && (self.y0..self.y1).contains(&y)
    }
}
