use crate::encode_row;
use alloc::{vec, vec::Vec};
use scumble_pixel::{Premul, WorkingSpace};

/// Colours by their numbers, each with its encoding: what the keys of a
/// [`Visibility`](crate::Visibility) stand for where each is of one colour.
#[derive(Debug, Clone)]
pub struct Palette {
    space: WorkingSpace,
    /// By key, and last what stands for all keys beyond: no colour. So finding one takes no branch,
    /// which nothing could guess.
    colors: Vec<Premul>,
    codes: Vec<[u8; 4]>,
}

impl Palette {
    /// No colours yet, of a working space.
    #[must_use]
    pub fn new(space: WorkingSpace) -> Self {
        Self { space, colors: vec![Premul::TRANSPARENT], codes: vec![[0; 4]] }
    }

    /// Adds the colour of the next key; the first is that of key 0.
    pub fn push(&mut self, color: Premul) {
        self.extend([color]);
    }

    /// Adds the colours of the next keys, all in one go: much quicker than one by one.
    pub fn extend(&mut self, colors: impl IntoIterator<Item = Premul>) {
        let first = self.colors.len() - 1;
        self.colors.truncate(first);
        self.colors.extend(colors);
        self.colors.push(Premul::TRANSPARENT);
        self.codes.resize(self.colors.len(), [0; 4]);
        encode_row(&self.colors[first..], self.space, &mut self.codes[first..]);
    }

    /// The working space of the colours.
    #[must_use]
    pub fn space(&self) -> WorkingSpace {
        self.space
    }

    /// The colour of a key.
    #[inline(always)]
    pub(crate) fn color(&self, key: u32) -> Premul {
        self.colors[(key as usize).min(self.colors.len() - 1)]
    }

    /// The colours by key, and last what stands for all keys beyond.
    pub(crate) fn colors(&self) -> &[Premul] {
        &self.colors
    }

    /// As many encodings.
    pub(crate) fn codes(&self) -> &[[u8; 4]] {
        &self.codes
    }

    /// The encoding of a key.
    #[inline(always)]
    pub(crate) fn code(&self, key: u32) -> [u8; 4] {
        self.codes[(key as usize).min(self.codes.len() - 1)]
    }
}
