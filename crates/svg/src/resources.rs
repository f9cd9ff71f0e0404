/// Where images that a scene names are fetched from: the caller's policy. This crate touches no
/// file and no network of its own.
///
/// An implementation decides what a name means (usually a path relative to the scene's folder),
/// what it refuses (paths that leave that folder, absolute paths, URLs), and how much it is
/// willing to read.
pub trait Resources {
    /// The bytes behind a `texture`'s `filename` or an `image`'s `href`, exactly as the scene
    /// spells it. Data URIs never come here.
    ///
    /// # Errors
    /// [`ResourceError`] if there is nothing to give; reading stops with it.
    fn load(&self, href: &str) -> Result<Vec<u8>, ResourceError>;
}

/// Why a resource cannot be had.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum ResourceError {
    /// The caller's policy forbids it; the text says why.
    #[error("refused: {0}")]
    Refused(String),
    /// There is no such thing.
    #[error("not found")]
    NotFound,
    /// It is larger than the caller or [`Limits::max_file_bytes`](crate::Limits::max_file_bytes)
    /// allows.
    #[error("larger than {limit} bytes")]
    TooLarge {
        /// The number of bytes allowed.
        limit: usize,
    },
    /// Anything else, in words.
    #[error("{0}")]
    Other(String),
}

/// Refuses everything: for scenes that stand alone.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct NoResources;

impl Resources for NoResources {
    fn load(&self, _: &str) -> Result<Vec<u8>, ResourceError> {
        Err(ResourceError::Refused("this run reads no files beside the scene".into()))
    }
}
