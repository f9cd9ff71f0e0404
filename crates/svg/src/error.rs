use crate::{Position, ResourceError};
use core::fmt;

/// Why a document cannot be read: what went wrong and, where there is one, the place.
///
/// It displays as `line:column: message`.
#[derive(Debug, Clone, PartialEq)]
pub struct SvgError {
    position: Option<Position>,
    kind: ErrorKind,
}

/// What went wrong.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum ErrorKind {
    /// The bytes are not text that can be read.
    #[error("{0}")]
    Encoding(String),
    /// The text is not well-formed XML.
    #[error("malformed XML: {0}")]
    Xml(String),
    /// The root element is not `svg`.
    #[error("the root element is `{0}`, not `svg`")]
    NotSvg(String),
    /// The document has no size to draw at.
    #[error("the document has no usable size: {0}")]
    Size(String),
    /// An element that cannot be drawn without what it lacks.
    #[error("`{element}`: {message}")]
    Element {
        /// The element's name.
        element: String,
        /// What is wrong with it.
        message: String,
    },
    /// An image that the resources do not give.
    #[error("cannot load `{href}`: {source}")]
    Resource {
        /// The name of the image, as the document spells it.
        href: String,
        /// Why not.
        source: ResourceError,
    },
    /// An image that is there but cannot be decoded.
    #[error("cannot read image `{href}`: {message}")]
    Image {
        /// The name of the image, as the document spells it; data URIs are cut short.
        href: String,
        /// What the decoder says.
        message: String,
    },
    /// One of the [`Limits`](crate::Limits) is exceeded.
    #[error("limit: {0}")]
    Limit(String),
}

impl SvgError {
    pub(crate) fn new(kind: ErrorKind) -> Self {
        Self { position: None, kind }
    }

    pub(crate) fn at(position: Position, kind: ErrorKind) -> Self {
        Self { position: Some(position), kind }
    }

    /// Where, in the document.
    #[must_use]
    pub fn position(&self) -> Option<Position> {
        self.position
    }

    /// What went wrong.
    #[must_use]
    pub fn kind(&self) -> &ErrorKind {
        &self.kind
    }

    /// Whether a limit stopped the reading, rather than a fault of the document.
    #[must_use]
    pub fn is_limit(&self) -> bool {
        matches!(
            self.kind,
            ErrorKind::Limit(_)
                | ErrorKind::Resource { source: ResourceError::TooLarge { .. }, .. }
        )
    }
}

impl fmt::Display for SvgError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if let Some(position) = self.position {
            write!(f, "{position}: ")?;
        }
        self.kind.fmt(f)
    }
}

impl core::error::Error for SvgError {
    fn source(&self) -> Option<&(dyn core::error::Error + 'static)> {
        match &self.kind {
            ErrorKind::Resource { source, .. } => Some(source),
            _ => None,
        }
    }
}

/// An error on its way up, with a byte offset that still has to become a position.
#[derive(Debug)]
pub(crate) struct Fault {
    pub(crate) offset: Option<usize>,
    pub(crate) kind: ErrorKind,
}

impl Fault {
    pub(crate) fn at(offset: usize, kind: ErrorKind) -> Self {
        Self { offset: Some(offset), kind }
    }

    /// The public error, with the place looked up in the document.
    pub(crate) fn locate(self, text: &str) -> SvgError {
        match self.offset {
            Some(offset) => SvgError::at(Position::at(text, offset), self.kind),
            None => SvgError::new(self.kind),
        }
    }
}

impl From<ErrorKind> for Fault {
    fn from(kind: ErrorKind) -> Self {
        Self { offset: None, kind }
    }
}
