/// The best instructions that the machine has.
#[cfg(feature = "std")]
#[derive(Debug, Clone, Copy)]
pub(crate) struct Best(pub(crate) fearless_simd::Level);

#[cfg(feature = "std")]
impl Default for Best {
    fn default() -> Self {
        Self(fearless_simd::Level::new())
    }
}

/// Those that the crate is compiled for.
#[cfg(not(feature = "std"))]
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct Best;
