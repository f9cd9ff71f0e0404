/// Why a texture cannot be made.
#[derive(Debug, Clone, Copy, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum TextureError {
    /// The image has no pixel.
    #[error("the image is empty")]
    Empty,
    /// A side is above 2²⁹, or the texels do not fit the address space.
    #[error("a texture of {width} by {height} texels is too large")]
    TooLarge {
        /// Columns.
        width: usize,
        /// Rows.
        height: usize,
    },
    /// A kind of pixel that is not known.
    #[error("a kind of pixel that is not known")]
    Format,
    /// A row of pixels that is not as long as the image is wide, or one too many.
    #[error("row {row} is not one of the image's")]
    Row {
        /// Which, from 0 on.
        row: usize,
    },
    /// Not all rows of the image have come.
    #[error("the image ends at row {row}")]
    Incomplete {
        /// The first that is missing.
        row: usize,
    },
    /// The allocator refused the memory.
    #[error("no memory for {bytes} bytes of texels")]
    OutOfMemory {
        /// Bytes asked for.
        bytes: usize,
    },
}
