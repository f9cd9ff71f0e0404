/// A 2×2 matrix by rows; as a Jacobian, `[[∂u/∂x, ∂u/∂y], [∂v/∂x, ∂v/∂y]]`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Matrix2 {
    /// Row 0, column 0: ∂u/∂x.
    pub a: f64,
    /// Row 0, column 1: ∂u/∂y.
    pub b: f64,
    /// Row 1, column 0: ∂v/∂x.
    pub c: f64,
    /// Row 1, column 1: ∂v/∂y.
    pub d: f64,
}

/// The ellipse that a matrix makes of the unit circle: its singular values and the direction of
/// the longer axis.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Axes {
    /// The larger singular value: the major half-axis.
    pub major: f64,
    /// The smaller singular value: the minor half-axis.
    pub minor: f64,
    /// Unit direction of the major axis in the image; (1, 0) for a circle.
    pub direction: [f64; 2],
}

impl Matrix2 {
    /// `[[a, b], [c, d]]`, row by row.
    #[must_use]
    pub const fn new(a: f64, b: f64, c: f64, d: f64) -> Self {
        Self { a, b, c, d }
    }

    /// a·d − b·c.
    #[must_use]
    pub fn determinant(&self) -> f64 {
        self.a * self.d - self.b * self.c
    }
}
