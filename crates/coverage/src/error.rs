use scumble_geometry::DVec2;

/// Why a shape or a pattern cannot be made.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum CoverageError {
    /// A coordinate is NaN or infinite.
    #[error("a coordinate is not finite: ({}, {})", .0.x, .0.y)]
    NotFinite(DVec2),
    /// There is no pattern of that kind with so many samples.
    #[error("there is no such pattern of {0} samples")]
    SampleCount(usize),
}
