use crate::rows::Stopped;
use crate::texture::TextureError;
use std::convert::Infallible;

/// Why a picture was not warped. `E` is the sink's own error.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum WarpError<E = Infallible> {
    /// The output has no pixels, or more than 2³⁰ − 1 on a side.
    #[error("an output of {width} by {height} pixels cannot be made")]
    Size {
        /// Columns asked for.
        width: u32,
        /// Rows asked for.
        height: u32,
    },
    /// The crop holds no pixel of the output.
    #[error("the crop lies outside the output of {width} by {height} pixels")]
    Crop {
        /// Columns of the output.
        width: u32,
        /// Rows of the output.
        height: u32,
    },
    /// The homography has no inverse, or a number in it is not finite.
    #[error("the map is singular")]
    Singular,
    /// The memory limit would be passed.
    #[error("{needed} bytes of memory are needed, the limit is {limit}")]
    Memory {
        /// Bytes needed, at least.
        needed: u64,
        /// The limit of the warp.
        limit: u64,
    },
    /// The source cannot become a texture.
    #[error(transparent)]
    Source(#[from] TextureError),
    /// The threads could not be started.
    #[error("cannot start the threads: {0}")]
    Threads(String),
    /// The caller's flag was set.
    #[error("cancelled")]
    Cancelled,
    /// The sink failed.
    #[error("{0}")]
    Sink(E),
}

impl<E> From<Stopped<E>> for WarpError<E> {
    fn from(stopped: Stopped<E>) -> Self {
        match stopped {
            Stopped::Cancelled => Self::Cancelled,
            Stopped::Sink(error) => Self::Sink(error),
        }
    }
}
