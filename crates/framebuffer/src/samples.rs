use alloc::vec::Vec;
use scumble_pixel::Premul;

/// A pixel's samples in [`SampleStore`]; 0 is a pixel that has none of its own.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub(crate) struct Slot(u32);

impl Slot {
    /// The pixel is uniform: its colour stands for all its samples.
    pub(crate) const UNIFORM: Self = Self(0);

    pub(crate) fn is_uniform(self) -> bool {
        self == Self::UNIFORM
    }

    /// Looks at all of them, since a loop that could stop early would not fill vectors.
    pub(crate) fn all_uniform(slots: &[Self]) -> bool {
        slots.iter().fold(0, |any, slot| any | slot.0) == 0
    }

    fn index(self) -> usize {
        self.0 as usize - 1
    }
}

/// The samples of the pixels that have been told apart, packed in the order in which that
/// happened, so that a tile with few edges touches little memory.
#[derive(Debug, Clone, Default)]
pub(crate) struct SampleStore {
    per_pixel: usize,
    /// Slots that there can be: one a pixel.
    most: usize,
    colors: Vec<Premul>,
    /// Per slot: the samples written since they were last seen to differ. Once all have been, they
    /// are worth comparing.
    touched: Vec<u64>,
    free: Vec<Slot>,
}

impl SampleStore {
    /// Bytes that a slot takes beside its samples.
    pub(crate) const OVERHEAD: usize = size_of::<u64>() + size_of::<Slot>();

    /// Forgets every slot, keeps the allocation.
    pub(crate) fn reset(&mut self, per_pixel: usize, pixels: usize) {
        self.per_pixel = per_pixel;
        self.most = pixels;
        self.colors.clear();
        self.touched.clear();
        self.free.clear();
    }

    /// Whether a slot was taken since it was reset.
    pub(crate) fn is_used(&self) -> bool {
        !self.touched.is_empty()
    }

    /// A slot with every sample equal to `color`.
    pub(crate) fn take(&mut self, color: Premul) -> Slot {
        if let Some(slot) = self.free.pop() {
            self.get_mut(slot).fill(color);
            self.touched[slot.index()] = 0;
            return slot;
        }
        if self.touched.len() == self.touched.capacity() {
            self.grow();
        }
        self.colors.resize(self.colors.len() + self.per_pixel, color);
        self.touched.push(0);
        Slot(self.touched.len() as u32)
    }

    /// Doubles the room, but never beyond a slot for every pixel.
    #[cold]
    fn grow(&mut self) {
        let slots = self.touched.len();
        let more = slots.max(16).min(self.most.saturating_sub(slots));
        self.touched.reserve_exact(more);
        self.free.reserve_exact(slots + more);
        self.colors.reserve_exact((slots + more) * self.per_pixel - self.colors.len());
    }

    /// Gives a slot back.
    pub(crate) fn release(&mut self, slot: Slot) {
        self.free.push(slot);
    }

    pub(crate) fn get(&self, slot: Slot) -> &[Premul] {
        let start = slot.index() * self.per_pixel;
        &self.colors[start..start + self.per_pixel]
    }

    pub(crate) fn get_mut(&mut self, slot: Slot) -> &mut [Premul] {
        let start = slot.index() * self.per_pixel;
        &mut self.colors[start..start + self.per_pixel]
    }

    /// Notes that the samples in `mask` have changed; whether all are alike now, as far as is
    /// worth knowing: two triangles of one colour that share the pixel leave it uniform.
    pub(crate) fn touch(&mut self, slot: Slot, mask: u64, full: u64) -> bool {
        let touched = &mut self.touched[slot.index()];
        *touched |= mask;
        if *touched != full {
            return false;
        }
        *touched = 0;
        let samples = self.get(slot);
        samples.iter().all(|&s| same_bits(s, samples[0]))
    }
}

#[cfg(test)]
impl SampleStore {
    pub(crate) fn color_capacity(&self) -> usize {
        self.colors.capacity()
    }

    pub(crate) fn slot_capacity(&self) -> usize {
        self.touched.capacity().max(self.free.capacity())
    }
}

/// Equality of bits: what it calls equal nothing downstream can tell apart.
pub(crate) fn same_bits(a: Premul, b: Premul) -> bool {
    a.0.map(f32::to_bits) == b.0.map(f32::to_bits)
}

/// The mean of the samples: the first, plus the mean of the differences from it, so that the mean
/// of equal samples is that value to the bit.
///
/// The differences are added in four chains, sample i to chain i mod 4, and then
/// (0 + 1) + (2 + 3): a fixed order that a machine of any vector width can follow.
pub(crate) fn mean(samples: &[Premul]) -> Premul {
    mean_of(samples.len(), |i| samples[i])
}

/// [`mean`] of `len` samples, each told by its number.
#[inline(always)]
pub(crate) fn mean_of(len: usize, sample: impl Fn(usize) -> Premul) -> Premul {
    if len == 0 {
        return Premul::TRANSPARENT;
    }
    let first = sample(0);
    let mut chains = [[0.0; 4]; 4];
    let whole = len / 4 * 4;
    for i in (0..whole).step_by(4) {
        let group = core::array::from_fn(|k| sample(i + k));
        add_differences(&mut chains, &group, first);
    }
    if whole < len {
        // Filled up with the first sample, which adds nothing.
        let group =
            core::array::from_fn(|k| if whole + k < len { sample(whole + k) } else { first });
        add_differences(&mut chains, &group, first);
    }
    let n = len as f32;
    let [c0, c1, c2, c3] = chains;
    Premul(core::array::from_fn(|c| first.0[c] + ((c0[c] + c1[c]) + (c2[c] + c3[c])) / n))
}

/// [`mean`] of four samples: in a line, and the same bits.
#[inline(always)]
pub(crate) fn mean4([a, b, c, d]: [Premul; 4]) -> Premul {
    // What `mean_of` does to each chain: it adds to a zero, which makes a zero of minus zero.
    let of = |sample: Premul, i: usize| 0.0 + (sample.0[i] - a.0[i]);
    let sum = |i: usize| (of(a, i) + of(b, i)) + (of(c, i) + of(d, i));
    Premul(core::array::from_fn(|i| a.0[i] + sum(i) / 4.0))
}

/// Over arrays, whose lengths the compiler knows: so the chains stay in registers.
#[inline]
fn add_differences(chains: &mut [[f32; 4]; 4], group: &[Premul; 4], first: Premul) {
    for (chain, sample) in chains.iter_mut().zip(group) {
        *chain = core::array::from_fn(|c| chain[c] + (sample.0[c] - first.0[c]));
    }
}
