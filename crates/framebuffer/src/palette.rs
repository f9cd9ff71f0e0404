use crate::encode_row;
use alloc::vec::Vec;
use scumble_pixel::{Premul, WorkingSpace};

/// Colours by their numbers, each with its encoding: what the keys of a
/// [`Visibility`](crate::Visibility) stand for where each is of one colour.
#[derive(Debug, Clone)]
pub struct Palette {
    space: WorkingSpace,
    colors: Vec<Premul>,
    codes: Vec<[u8; 4]>,
}

impl Palette {
    /// No colours yet, of a working space.
    #[must_use]
    pub fn new(space: WorkingSpace) -> Self {
        Self { space, colors: Vec::new(), codes: Vec::new() }
    }

    /// Adds the colour of the next key; the first is that of key 0.
    #[inline]
    pub fn push(&mut self, color: Premul) {
        self.colors.push(color);
        self.codes.push(self.space.export(color));
    }

    /// Adds the colours of the next keys, all in one go: much quicker than one by one.
    pub fn extend(&mut self, colors: impl IntoIterator<Item = Premul>) {
        let first = self.colors.len();
        self.colors.extend(colors);
        self.codes.resize(self.colors.len(), [0; 4]);
        encode_row(&self.colors[first..], self.space, &mut self.codes[first..]);
    }

    /// The working space of the colours.
    #[must_use]
    pub fn space(&self) -> WorkingSpace {
        self.space
    }

    /// The colour of a key.
    #[inline]
    pub(crate) fn color(&self, key: u32) -> Premul {
        self.colors.get(key as usize).copied().unwrap_or(Premul::TRANSPARENT)
    }

    /// The encoding of a key.
    #[inline]
    pub(crate) fn code(&self, key: u32) -> [u8; 4] {
        self.codes.get(key as usize).copied().unwrap_or_default()
    }
}
