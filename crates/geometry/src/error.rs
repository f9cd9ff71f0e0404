use crate::DVec2;

/// Why a geometric object cannot be made.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum GeometryError {
    /// Three of a quad's corners lie on a line, or two coincide.
    #[error("the quad is degenerate: three of its corners lie on a line")]
    DegenerateQuad,
    /// Two sides of a quad cross, or a corner points inward.
    #[error("the quad is not convex: its corners are not in order around it")]
    NotConvex,
    /// The map squeezes the plane into a line or a point.
    #[error("the matrix is singular")]
    Singular,
    /// A coordinate is NaN or infinite.
    #[error("a coordinate is not finite: ({}, {})", .0.x, .0.y)]
    NotFinite(DVec2),
}
