use crate::DVec2;

/// N numbers that change evenly over the screen, kept within a range: a [`Ramp`](crate::Ramp)
/// without perspective, in `f32`.
///
/// ```
/// use scumble_geometry::{DVec2, DVec3, Plane, Ramp};
/// let corners = [DVec3::new(0.0, 0.0, 1.0), DVec3::new(4.0, 0.0, 1.0), DVec3::new(0.0, 4.0, 1.0)];
/// let ramp = Ramp::new(corners, [[0.0], [1.0], [0.0]])?;
/// let plane: &Plane<1> = ramp.plane().ok_or("without perspective there is one")?;
/// assert_eq!(plane.at(DVec2::new(3.0, 1.0)), [0.75]);
/// assert_eq!(plane.at(DVec2::new(9.0, 1.0)), [1.0]);
/// assert_eq!(Plane::constant([0.5]).at(DVec2::new(7.0, 8.0)), [0.5]);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Plane<const N: usize> {
    /// The pixel from whose centre it counts.
    pub(crate) pixel: (i32, i32),
    /// The value there.
    pub(crate) here: [f32; N],
    /// Its change per pixel along x and y.
    pub(crate) right: [f32; N],
    pub(crate) below: [f32; N],
    /// The range.
    pub(crate) low: [f32; N],
    pub(crate) high: [f32; N],
}

/// Times the distance of any two pixels it is far below the largest `f32`.
const STEEPEST: f32 = 1e20;

impl<const N: usize> Plane<N> {
    /// The same everywhere. Numbers should be finite.
    #[must_use]
    pub const fn constant(value: [f32; N]) -> Self {
        let none = [0.0; N];
        Self { pixel: (0, 0), here: value, right: none, below: none, low: value, high: value }
    }

    /// Whether no sum overflows over all pixels there can be.
    pub(crate) fn is_tame(&self) -> bool {
        let mut all = self.here.iter().chain(&self.right).chain(&self.below);
        all.all(|v| v.abs() < STEEPEST)
    }

    /// The value at a position: the bits of [`Ramp::at`](crate::Ramp::at).
    #[must_use]
    #[inline(always)]
    pub fn at(&self, p: DVec2) -> [f32; N] {
        self.along(self.left(p.y), p.x)
    }

    /// The pixel from which it is counted: `here` is at its centre. Over other pixels' centres the value
    /// is `here` + `below` × rows + `right` × columns, in this order, in `f32`, and then held to the
    /// range.
    ///
    /// ```
    /// use scumble_geometry::{DVec2, DVec3, Ramp};
    /// # let corners = [DVec3::new(0.0, 0.0, 1.0), DVec3::new(4.0, 0.0, 1.0), DVec3::new(0.0, 4.0, 1.0)];
    /// let ramp = Ramp::new(corners, [[0.0], [1.0], [0.0]])?;
    /// let plane = ramp.plane().ok_or("without perspective there is one")?;
    /// let (x, y) = plane.pixel();
    /// let ([here], [below], [right]) = (plane.here(), plane.below(), plane.right());
    /// let value = here + below * (3 - y) as f32 + right * (1 - x) as f32;
    /// assert_eq!(plane.at(DVec2::new(1.5, 3.5)), [value.max(plane.low()[0]).min(plane.high()[0])]);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    #[must_use]
    #[inline]
    pub fn pixel(&self) -> (i32, i32) {
        self.pixel
    }

    /// The value at the centre of that pixel.
    #[must_use]
    #[inline]
    pub fn here(&self) -> [f32; N] {
        self.here
    }

    /// Its change from a pixel to the one below.
    #[must_use]
    #[inline]
    pub fn below(&self) -> [f32; N] {
        self.below
    }

    /// Its change from a pixel to the one on the right.
    #[must_use]
    #[inline(always)]
    pub fn right(&self) -> [f32; N] {
        self.right
    }

    /// The least of each number.
    #[must_use]
    #[inline(always)]
    pub fn low(&self) -> [f32; N] {
        self.low
    }

    /// The most of each number.
    #[must_use]
    #[inline(always)]
    pub fn high(&self) -> [f32; N] {
        self.high
    }

    /// What a row begins from.
    #[inline(always)]
    pub(crate) fn left(&self, y: f64) -> [f32; N] {
        let y = (y - (f64::from(self.pixel.1) + 0.5)) as f32;
        let mut left = self.here;
        for (left, below) in left.iter_mut().zip(self.below) {
            *left += below * y;
        }
        left
    }

    /// The value in a row that begins from `left`.
    #[inline(always)]
    pub(crate) fn along(&self, left: [f32; N], x: f64) -> [f32; N] {
        let x = (x - (f64::from(self.pixel.0) + 0.5)) as f32;
        let mut value = left;
        for (value, right) in value.iter_mut().zip(self.right) {
            *value += right * x;
        }
        clamp(value, &self.low, &self.high)
    }
}

/// A NaN becomes the lower bound.
#[inline(always)]
pub(crate) fn clamp<const N: usize>(
    mut value: [f32; N],
    low: &[f32; N],
    high: &[f32; N],
) -> [f32; N] {
    for (v, (low, high)) in value.iter_mut().zip(low.iter().zip(high)) {
        // Comparisons in this form are one instruction each.
        let above = if *v > *low { *v } else { *low };
        *v = if above < *high { above } else { *high };
    }
    value
}
