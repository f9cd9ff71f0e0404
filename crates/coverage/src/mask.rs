/// The samples of one pixel that are covered: bit i is sample i of the pattern.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default)]
pub struct SampleMask(pub u64);

impl SampleMask {
    /// No sample.
    pub const EMPTY: Self = Self(0);

    /// The first `samples` bits set: every sample of a pattern of that length (at most 64).
    #[must_use]
    pub const fn full(samples: usize) -> Self {
        if samples >= 64 { Self(u64::MAX) } else { Self((1 << samples) - 1) }
    }

    /// How many samples are covered.
    #[must_use]
    pub const fn count(self) -> u32 {
        self.0.count_ones()
    }

    /// Whether no sample is covered.
    #[must_use]
    pub const fn is_empty(self) -> bool {
        self.0 == 0
    }

    /// Whether sample `i` (below 64) is covered.
    #[must_use]
    pub const fn contains(self, i: u32) -> bool {
        (self.0 >> (i & 63)) & 1 == 1
    }
}
