use std::ffi::OsStr;
use std::path::Path;

/// A format of picture files.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Format {
    Png,
    Jpeg,
    WebP,
    Tiff,
    Exr,
}

/// What a number of a picture is stored as.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Depth {
    /// Whole numbers of 8 bits and less.
    Eight,
    /// Whole numbers of 16 bits.
    Sixteen,
    /// Floats of 16 bits.
    Half,
    /// Floats of 32 bits.
    Float,
}

impl Depth {
    /// Bits of a number.
    pub(crate) fn bits(self) -> u32 {
        match self {
            Self::Eight => 8,
            Self::Sixteen | Self::Half => 16,
            Self::Float => 32,
        }
    }

    /// Whether the numbers are floats.
    pub(crate) fn is_float(self) -> bool {
        matches!(self, Self::Half | Self::Float)
    }

    /// What messages call it.
    pub(crate) fn name(self) -> &'static str {
        match self {
            Self::Eight => "8-bit",
            Self::Sixteen => "16-bit",
            Self::Half => "half-float",
            Self::Float => "float",
        }
    }
}

/// The endings of file names that say a format.
const ENDINGS: [(&str, Format); 7] = [
    ("png", Format::Png),
    ("jpg", Format::Jpeg),
    ("jpeg", Format::Jpeg),
    ("webp", Format::WebP),
    ("tif", Format::Tiff),
    ("tiff", Format::Tiff),
    ("exr", Format::Exr),
];

impl Format {
    /// The format that a file's first bytes say.
    pub(crate) fn of_content(start: &[u8]) -> Option<Self> {
        let webp = start.starts_with(b"RIFF") && start.get(8..12) == Some(b"WEBP");
        match start {
            [0x89, b'P', b'N', b'G', b'\r', b'\n', 0x1a, b'\n', ..] => Some(Self::Png),
            [0xff, 0xd8, 0xff, ..] => Some(Self::Jpeg),
            _ if webp => Some(Self::WebP),
            // Classic TIFF and BigTIFF, in both orders of bytes.
            [b'I', b'I', 42 | 43, 0, ..] | [b'M', b'M', 0, 42 | 43, ..] => Some(Self::Tiff),
            [0x76, 0x2f, 0x31, 0x01, ..] => Some(Self::Exr),
            _ => None,
        }
    }

    /// The format that the ending of a file's name says.
    pub(crate) fn of_name(path: &Path) -> Option<Self> {
        let ending = path.extension().and_then(OsStr::to_str)?.to_ascii_lowercase();
        ENDINGS.iter().find(|(e, _)| *e == ending).map(|&(_, format)| format)
    }

    /// Its name.
    pub(crate) fn name(self) -> &'static str {
        match self {
            Self::Png => "PNG",
            Self::Jpeg => "JPEG",
            Self::WebP => "WebP",
            Self::Tiff => "TIFF",
            Self::Exr => "OpenEXR",
        }
    }

    /// Whether it stores numbers of this depth.
    pub(crate) fn carries(self, depth: Depth) -> bool {
        match self {
            Self::Png => !depth.is_float(),
            Self::Jpeg | Self::WebP => depth == Depth::Eight,
            Self::Tiff => depth != Depth::Half,
            Self::Exr => depth.is_float(),
        }
    }

    /// The depth that keeps most of numbers of `depth`, and no more than it needs.
    pub(crate) fn depth_for(self, depth: Depth) -> Depth {
        match self {
            _ if self.carries(depth) => depth,
            Self::Png => Depth::Sixteen,
            Self::Jpeg | Self::WebP => Depth::Eight,
            Self::Tiff => Depth::Float,
            // A half float has eleven bits: enough for eight, too few for sixteen.
            Self::Exr if depth == Depth::Eight => Depth::Half,
            Self::Exr => Depth::Float,
        }
    }

    /// Whether it stores alpha.
    pub(crate) fn carries_alpha(self) -> bool {
        self != Self::Jpeg
    }

    /// Whether it stores ICC profiles.
    pub(crate) fn carries_icc(self) -> bool {
        self != Self::Exr
    }

    /// Whether its colours are multiplied by alpha.
    pub(crate) fn premultiplies(self) -> bool {
        self == Self::Exr
    }

    /// The longest side.
    pub(crate) fn longest_side(self) -> u32 {
        match self {
            Self::Jpeg => 65_535,
            Self::WebP => 16_384,
            Self::Png | Self::Tiff | Self::Exr => i32::MAX as u32,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn endings_and_contents() {
        let of = |name: &str| Format::of_name(Path::new(name));
        assert_eq!(of("a.PNG"), Some(Format::Png));
        assert_eq!(of("a.b/c.tiff"), Some(Format::Tiff));
        assert_eq!((of("png"), of("a.gif"), of("a.")), (None, None, None));
        assert_eq!(Format::of_content(b"II*\0"), Some(Format::Tiff));
        assert_eq!(Format::of_content(b"RIFF....WAVE"), None);
        assert_eq!(Format::of_content(b""), None);
    }

    #[test]
    fn what_is_chosen_is_carried() {
        use Format::*;
        for format in [Png, Jpeg, WebP, Tiff, Exr] {
            for depth in [Depth::Eight, Depth::Sixteen, Depth::Half, Depth::Float] {
                let chosen = format.depth_for(depth);
                assert!(format.carries(chosen), "{format:?} {depth:?}");
                assert!(!format.carries(depth) || chosen == depth);
            }
        }
    }
}
