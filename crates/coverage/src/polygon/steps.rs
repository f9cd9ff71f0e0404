//! The winding number along a vertical line through a row of pixels.

/// A winding number that changes at some of the heights of a row (1/256 pixel from its top).
///
/// Changes that cancel are forgotten, so that the same function always looks the same.
#[derive(Debug, Clone)]
pub(super) struct Steps {
    /// The winding number at the top of the row.
    pub(super) top: i32,
    /// By how much it changes at each height inside the row; nothing is ever written to the first.
    changes: [i32; 256],
    /// One bit for each height at which it changes.
    marked: [u64; 4],
}

impl Default for Steps {
    fn default() -> Self {
        Self { top: 0, changes: [0; 256], marked: [0; 4] }
    }
}

impl Steps {
    /// Changes by `change` from a height on, 0 (the top) to 256 (the bottom, where it is too late).
    #[inline(always)]
    pub(super) fn add(&mut self, height: i32, change: i32) {
        match height {
            0 => self.top += change,
            1..256 => {
                let height = height as usize;
                let at = &mut self.changes[height];
                *at += change;
                let (word, bit) = (height / 64, height % 64);
                self.marked[word] = self.marked[word] & !(1 << bit) | u64::from(*at != 0) << bit;
            }
            _ => {}
        }
    }

    /// Whether it is the same all the way down.
    #[inline(always)]
    pub(super) fn is_constant(&self) -> bool {
        self.marked == [0; 4]
    }

    /// One bit for each height at which it changes.
    pub(super) fn marks(&self) -> [u64; 4] {
        self.marked
    }

    /// By how much it changes at a height inside the row.
    pub(super) fn change(&self, height: i32) -> i32 {
        self.changes[height as usize & 255]
    }

    /// The heights at which it changes, and by how much, from the top.
    pub(super) fn iter(&self) -> impl Iterator<Item = (i32, i32)> {
        self.marked.iter().enumerate().flat_map(move |(word, &bits)| {
            let mut bits = bits;
            core::iter::from_fn(move || {
                let height = (bits != 0).then(|| word * 64 + bits.trailing_zeros() as usize)?;
                bits &= bits - 1;
                Some((height as i32, self.changes[height]))
            })
        })
    }

    /// The winding number at the bottom of the row.
    #[inline(always)]
    pub(super) fn bottom(&self) -> i32 {
        if self.is_constant() {
            return self.top;
        }
        self.top + self.iter().map(|step| step.1).sum::<i32>()
    }

    /// The mean over the row.
    #[inline(always)]
    pub(super) fn mean(&self) -> f64 {
        if self.is_constant() {
            return f64::from(self.top);
        }
        let sum: i32 = self.iter().map(|(height, change)| (256 - height) * change).sum();
        f64::from(self.top) + f64::from(sum) * (1.0 / 256.0)
    }

    /// Makes it constant.
    #[inline(always)]
    pub(super) fn reset(&mut self, top: i32) {
        self.top = top;
        for (word, bits) in self.marked.iter_mut().enumerate() {
            while *bits != 0 {
                self.changes[word * 64 + bits.trailing_zeros() as usize] = 0;
                *bits &= *bits - 1;
            }
        }
    }
}
