/// Why a filter cannot be made or a measure cannot be taken.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum SignalError {
    /// A cutoff is negative or no number, or a band ends before it begins.
    #[error("{low} to {high} cycles per pixel is no band of frequencies")]
    Band {
        /// Where it begins.
        low: f64,
        /// Where it ends.
        high: f64,
    },
    /// A kernel's size is not above zero, or larger than [`Kernel::MAX_RADIUS`](crate::Kernel::MAX_RADIUS)
    /// allows.
    #[error("a kernel cannot have the size {0}")]
    Size(f64),
    /// A kernel's weights are no odd number across, down, or not as many as both say.
    #[error("{width} by {height} weights were asked for, odd numbers both, and {found} given")]
    Weights {
        /// Columns.
        width: usize,
        /// Rows.
        height: usize,
        /// Weights that there are.
        found: usize,
    },
    /// The weights' sum is zero, so that they cannot be made to sum to one.
    #[error("the weights sum to {0}, which cannot be made one")]
    Sum(f64),
    /// Two images that are to be compared differ in size, or have no pixels.
    #[error("images of {0}×{1} and {2}×{3} pixels cannot be compared")]
    Sizes(usize, usize, usize, usize),
    /// There is no single edge that crosses every row or every column.
    #[error("there is no edge that crosses the image from side to side")]
    NoEdge,
    /// The edge runs along the pixels, so that it meets them all at the same places, or the image
    /// has too few rows for it to meet them at enough.
    #[error("the edge is too little slanted for so small an image")]
    Unslanted,
}
