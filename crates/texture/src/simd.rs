use alloc::vec::Vec;
use fearless_simd::Level;

/// Which instructions run the filters. Every choice gives the same bytes.
///
/// [`Simd::best`] is what a texture starts with; the others are for tests and measurements.
#[derive(Debug, Clone, Copy)]
pub struct Simd(pub(crate) Option<Level>);

impl Simd {
    /// Plain scalar code, which is also the definition of the rest.
    pub const SCALAR: Self = Self(None);

    /// The best that this machine has. Without the feature `std` nothing can be asked, and it is
    /// what the target promises.
    #[must_use]
    pub fn best() -> Self {
        #[cfg(feature = "std")]
        return Self(Some(Level::new()));
        #[cfg(not(feature = "std"))]
        return Self(Some(Level::baseline()));
    }

    /// Every choice that this machine can run, the scalar one first.
    #[must_use]
    pub fn all() -> Vec<Self> {
        let mut all = alloc::vec![Self::SCALAR, Self(Some(Level::baseline()))];
        #[cfg(any(target_arch = "x86", target_arch = "x86_64"))]
        if let Self(Some(best)) = Self::best() {
            all.extend(best.as_sse4_2().map(|l| Self(Some(Level::Sse4_2(l)))));
            all.extend(best.as_avx2().map(|l| Self(Some(Level::Avx2(l)))));
        }
        all.push(Self::best());
        all
    }
}

impl Default for Simd {
    fn default() -> Self {
        Self::best()
    }
}
