//! The memory of a level.

use crate::TextureError;
use alloc::{vec, vec::Vec};
use core::ops::{Deref, DerefMut};

/// What any bits make one of.
#[cfg(feature = "huge-pages")]
pub(crate) trait Plain: Copy + Default + bytemuck::Pod {}

/// What any bits make one of.
#[cfg(not(feature = "huge-pages"))]
pub(crate) trait Plain: Copy + Default {}

impl Plain for [i16; 4] {}
impl Plain for [u8; 4] {}
impl Plain for [f32; 4] {}

/// Memory of so many texels.
///
/// The system hands out memory by the page, and takes a trap for each that is touched for the first time:
/// for a level of 32 MB in pages of 4 KB these cost as much as what is written into it. So a large one
/// asks for large pages, if the feature `huge-pages` is on and the system has them.
#[derive(Debug)]
pub(crate) enum Memory<T> {
    Small(Vec<T>),
    #[cfg(feature = "huge-pages")]
    Large(memmap2::MmapMut),
}

/// Bytes from which on memory asks for large pages: two of the usual size.
#[cfg(feature = "huge-pages")]
const LARGE: usize = 4 << 20;

impl<T: Plain> Memory<T> {
    /// Of zeros. Of the system's pages those that are never written cost nothing, or little.
    pub(crate) fn zeroed(len: usize) -> Result<Self, TextureError> {
        #[cfg(feature = "huge-pages")]
        if let Some(map) = large(len.saturating_mul(size_of::<T>())) {
            return Ok(Self::Large(map));
        }
        zeroed(len).map(Self::Small)
    }
}

/// Memory in large pages, where that is worth it and there is enough.
#[cfg(feature = "huge-pages")]
fn large(bytes: usize) -> Option<memmap2::MmapMut> {
    if bytes < LARGE {
        return None;
    }
    let map = memmap2::MmapMut::map_anon(bytes).ok()?;
    // A system that has none refuses, and gives its usual ones.
    #[cfg(target_os = "linux")]
    let _ = map.advise(memmap2::Advice::HugePage);
    Some(map)
}

/// Its texels: a function of its own, whose checks do not stand in loops.
#[cfg(feature = "huge-pages")]
#[inline(never)]
fn cast<T: Plain>(map: &memmap2::MmapMut) -> &[T] {
    bytemuck::cast_slice(map)
}

/// So many, zeroed by the system.
pub(crate) fn zeroed<T: Clone + Default>(len: usize) -> Result<Vec<T>, TextureError> {
    // Asked for first, so that a refusal is an error; then had zeroed from the system. The compiler must
    // not know that nothing is done with what was asked for, or it would not ask.
    let mut asked = Vec::<T>::new();
    let bytes = len.saturating_mul(size_of::<T>());
    asked.try_reserve_exact(len).map_err(|_| TextureError::OutOfMemory { bytes })?;
    drop(core::hint::black_box(asked));
    Ok(vec![T::default(); len])
}

impl<T> Default for Memory<T> {
    fn default() -> Self {
        Self::Small(Vec::new())
    }
}

impl<T: Plain> Clone for Memory<T> {
    fn clone(&self) -> Self {
        #[cfg(feature = "huge-pages")]
        if let Self::Large(_) = self
            && let Ok(mut copy) = Self::zeroed(self.len())
        {
            copy.copy_from_slice(self);
            return copy;
        }
        Self::Small(self.to_vec())
    }
}

impl<T: Plain> Deref for Memory<T> {
    type Target = [T];

    #[inline(always)]
    fn deref(&self) -> &[T] {
        match self {
            Self::Small(memory) => memory,
            #[cfg(feature = "huge-pages")]
            Self::Large(map) => cast(map),
        }
    }
}

impl<T: Plain> DerefMut for Memory<T> {
    #[inline(always)]
    fn deref_mut(&mut self) -> &mut [T] {
        match self {
            Self::Small(memory) => memory,
            #[cfg(feature = "huge-pages")]
            Self::Large(map) => bytemuck::cast_slice_mut(map),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn small_and_large_memory_is_zeroed_and_copied() {
        for len in [0, 5, 1 << 20] {
            let mut memory = Memory::<[i16; 4]>::zeroed(len).unwrap();
            assert_eq!(memory.len(), len);
            assert!(memory.iter().all(|t| *t == [0; 4]));
            if let Some(last) = memory.last_mut() {
                *last = [1, 2, 3, 4];
            }
            let copy = memory.clone();
            assert!(memory.iter().eq(copy.iter()));
            #[cfg(feature = "huge-pages")]
            assert_eq!(matches!(copy, Memory::Large(_)), len > 5);
        }
        let refused = Memory::<[f32; 4]>::zeroed(usize::MAX / 32);
        assert!(matches!(refused, Err(TextureError::OutOfMemory { .. })));
    }
}
