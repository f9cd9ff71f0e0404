//! The words for presets, filters, kernels and magnification, for command lines and files.

use crate::{Kernel, Magnify, PixelFilter, Sampler, Separable};
use core::fmt;
use core::str::FromStr;

/// A word that names nothing of its kind.
#[derive(Debug, Clone, Copy, PartialEq, Eq, thiserror::Error)]
#[error("not the name of a {kind}")]
pub struct UnknownName {
    kind: &'static str,
}

impl Sampler {
    /// The presets, by name.
    ///
    /// ```
    /// use scumble_texture::Sampler;
    ///
    /// assert_eq!(Sampler::preset("high"), Some(Sampler::HIGH));
    /// let names = Sampler::PRESETS.map(|(name, _)| name);
    /// assert_eq!(names, ["fast", "default", "high", "reference", "classic"]);
    /// ```
    pub const PRESETS: [(&'static str, Self); 5] = [
        ("fast", Self::FAST),
        ("default", Self::DEFAULT),
        ("high", Self::HIGH),
        ("reference", Self::REFERENCE),
        ("classic", Self::CLASSIC),
    ];

    /// The preset of a name.
    #[must_use]
    pub fn preset(name: &str) -> Option<Self> {
        Self::PRESETS.iter().find(|(n, _)| *n == name).map(|(_, sampler)| *sampler)
    }
}

impl Separable {
    /// Its name: `catmull-rom`, `mitchell`, `lanczos2` or `lanczos3`.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::CatmullRom => "catmull-rom",
            Self::Mitchell => "mitchell",
            Self::Lanczos2 => "lanczos2",
            Self::Lanczos3 => "lanczos3",
        }
    }
}

impl PixelFilter {
    /// All of them.
    pub const ALL: [Self; 9] = [
        Self::Nearest,
        Self::Bilinear,
        Self::Separable(Separable::CatmullRom),
        Self::Separable(Separable::Mitchell),
        Self::Separable(Separable::Lanczos2),
        Self::Separable(Separable::Lanczos3),
        Self::Probes,
        Self::Ewa,
        Self::Classic,
    ];

    /// Its name: `nearest`, `bilinear`, `probes`, `ewa`, `classic`, or that of its [`Separable`].
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Nearest => "nearest",
            Self::Bilinear => "bilinear",
            Self::Separable(kernel) => kernel.name(),
            Self::Probes => "probes",
            Self::Ewa => "ewa",
            Self::Classic => "classic",
        }
    }
}

impl Kernel {
    /// Its name: `gaussian`, `smooth`, `triangle`, `mitchell`, `lanczos2`, `lanczos3` or `box`; `own`
    /// for [`Kernel::Own`], which no name can bring back.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Gaussian => "gaussian",
            Self::Smooth => "smooth",
            Self::Triangle => "triangle",
            Self::Mitchell => "mitchell",
            Self::Lanczos2 => "lanczos2",
            Self::Lanczos3 => "lanczos3",
            Self::Box => "box",
            Self::Own(_) => "own",
        }
    }
}

impl Magnify {
    /// Its name: `none`, `taps`, `bilinear`, `catmull-rom`, `mitchell`, `lanczos2` or `radial`, which
    /// stands before the name of its kernel.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::None => "none",
            Self::Taps => "taps",
            Self::Bilinear => "bilinear",
            Self::CatmullRom => "catmull-rom",
            Self::Mitchell => "mitchell",
            Self::Lanczos2 => "lanczos2",
            Self::Radial(_) => "radial",
        }
    }
}

impl fmt::Display for Separable {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(self.name())
    }
}

impl fmt::Display for PixelFilter {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(self.name())
    }
}

impl fmt::Display for Kernel {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(self.name())
    }
}

/// The name; of [`Magnify::Radial`], `radial-` and the kernel's.
impl fmt::Display for Magnify {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Radial(kernel) => write!(f, "radial-{kernel}"),
            _ => f.pad(self.name()),
        }
    }
}

/// The one among `all` whose name it is.
fn find<T: Copy>(
    all: &[T],
    name: fn(T) -> &'static str,
    word: &str,
    kind: &'static str,
) -> Result<T, UnknownName> {
    all.iter().copied().find(|v| name(*v) == word).ok_or(UnknownName { kind })
}

impl FromStr for Separable {
    type Err = UnknownName;

    fn from_str(word: &str) -> Result<Self, UnknownName> {
        find(&Self::ALL, Self::name, word, "separable kernel")
    }
}

impl FromStr for PixelFilter {
    type Err = UnknownName;

    fn from_str(word: &str) -> Result<Self, UnknownName> {
        find(&Self::ALL, Self::name, word, "pixel filter")
    }
}

impl FromStr for Kernel {
    type Err = UnknownName;

    fn from_str(word: &str) -> Result<Self, UnknownName> {
        find(&Self::ALL, Self::name, word, "kernel")
    }
}

impl FromStr for Magnify {
    type Err = UnknownName;

    fn from_str(word: &str) -> Result<Self, UnknownName> {
        match word.strip_prefix("radial-") {
            Some(kernel) => kernel.parse().map(Self::Radial),
            None => find(&Self::ALL, Self::name, word, "way to magnify"),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use alloc::string::ToString;

    #[test]
    fn every_name_comes_back() {
        for v in PixelFilter::ALL {
            assert_eq!(v.to_string().parse(), Ok(v));
        }
        for v in Separable::ALL {
            assert_eq!(v.to_string().parse(), Ok(v));
        }
        for v in Kernel::ALL {
            assert_eq!(v.to_string().parse(), Ok(v));
            assert_eq!(Magnify::Radial(v).to_string().parse(), Ok(Magnify::Radial(v)));
        }
        for v in Magnify::ALL {
            assert_eq!(v.to_string().parse(), Ok(v));
        }
        for (name, sampler) in Sampler::PRESETS {
            assert_eq!(Sampler::preset(name), Some(sampler));
        }
        let error = "gauss".parse::<Kernel>().unwrap_err();
        assert_eq!(error.to_string(), "not the name of a kernel");
        assert!("radial-".parse::<Magnify>().is_err() && "radial-own".parse::<Magnify>().is_err());
        assert_eq!(Sampler::preset(""), None);
    }
}
