//! How the texels of a level stand in memory: in steps, in codes or in floats.

use crate::TextureError;
use crate::memory::{Memory, Plain};
use crate::texel::{Cell, Texel, of_color};
use core::ops::AddAssign;

/// A texel whose channels are codes of eight bits: sixty-four steps to each.
///
/// An opaque image of bytes that is averaged as it is encoded has no other texels. What a sample costs
/// is above all the memory that it touches, and these take half of it; as they are read they become the
/// same whole numbers.
pub(crate) type Code = [u8; 4];

/// Steps of a code, as a power of two.
pub(crate) const CODE_BITS: u32 = 6;

/// A texel as a level keeps it.
pub(crate) trait Stored: Plain + Send + Sync {
    /// The texel nearest to a colour.
    fn of_color(color: [f32; 4]) -> Self;
    /// Such texels, to be kept.
    fn keep(memory: Memory<Self>) -> Store;
    /// Those that are kept, if they are such.
    fn kept(store: &mut Store) -> Option<&mut Memory<Self>>;
}

impl Stored for Texel {
    #[inline(always)]
    fn of_color(color: [f32; 4]) -> Self {
        of_color(color)
    }

    fn keep(memory: Memory<Self>) -> Store {
        Store::Steps(memory)
    }

    fn kept(store: &mut Store) -> Option<&mut Memory<Self>> {
        if let Store::Steps(memory) = store { Some(memory) } else { None }
    }
}

impl Stored for Code {
    #[inline(always)]
    fn of_color(color: [f32; 4]) -> Self {
        code(of_color(color))
    }

    fn keep(memory: Memory<Self>) -> Store {
        Store::Codes(memory)
    }

    fn kept(store: &mut Store) -> Option<&mut Memory<Self>> {
        if let Store::Codes(memory) = store { Some(memory) } else { None }
    }
}

impl Stored for [f32; 4] {
    #[inline(always)]
    fn of_color(color: [f32; 4]) -> Self {
        color
    }

    fn keep(memory: Memory<Self>) -> Store {
        Store::Floats(memory)
    }

    fn kept(store: &mut Store) -> Option<&mut Memory<Self>> {
        if let Store::Floats(memory) = store { Some(memory) } else { None }
    }
}

/// The codes of a texel that has them.
#[inline(always)]
pub(crate) fn code(texel: Texel) -> Code {
    texel.map(|v| (v >> CODE_BITS) as u8)
}

/// The texel of codes, in steps.
#[inline(always)]
pub(crate) fn of_code(code: Code) -> Texel {
    code.map(|v| i16::from(v) << CODE_BITS)
}

/// Whether a colour has codes.
pub(crate) fn has_code(color: [f32; 4]) -> bool {
    of_code(code(of_color(color))) == of_color(color)
}

/// The texels of a level.
#[derive(Debug, Clone)]
pub(crate) enum Store {
    Steps(Memory<Texel>),
    Codes(Memory<Code>),
    Floats(Memory<[f32; 4]>),
}

impl Store {
    /// So many texels of no meaning, in the memory of others if those are as many of the same kind.
    pub(crate) fn new<T: Stored>(len: usize, old: Option<Self>) -> Result<Self, TextureError> {
        let old = old.and_then(|mut old| T::kept(&mut old).map(core::mem::take));
        match old {
            Some(old) if old.len() == len => Ok(T::keep(old)),
            other => {
                drop(other);
                Memory::zeroed(len).map(T::keep)
            }
        }
    }

    /// Those that are whole numbers; of floats none.
    #[inline(always)]
    pub(crate) fn whole(&self) -> Whole<'_> {
        match self {
            Self::Steps(texels) => Whole::Steps(texels),
            Self::Codes(texels) => Whole::Codes(texels),
            Self::Floats(_) => Whole::Steps(&[]),
        }
    }

    /// Those that are floats, if they are.
    #[inline(always)]
    pub(crate) fn floats(&self) -> Option<&[[f32; 4]]> {
        if let Self::Floats(texels) = self { Some(texels) } else { None }
    }

    /// The numbers of a texel: floats, or whole ones of steps.
    #[inline(always)]
    pub(crate) fn numbers(&self, index: usize) -> [f32; 4] {
        match self {
            Self::Floats(texels) => texels[index],
            _ => self.whole().texel(index).numbers(),
        }
    }

    /// The sum of so many texels from an index on, as [`Store::numbers`].
    pub(crate) fn sum(&self, start: usize, len: usize) -> [f64; 4] {
        match self {
            Self::Floats(texels) => sum(&texels[start..][..len], 0.0, f64::from),
            Self::Steps(texels) => sum(&texels[start..][..len], 0, i64::from).map(|s| s as f64),
            Self::Codes(texels) => {
                sum(&texels[start..][..len], 0, i64::from).map(|s| (s << CODE_BITS) as f64)
            }
        }
    }

    /// Bytes.
    pub(crate) fn bytes(&self) -> usize {
        match self {
            Self::Steps(texels) => size_of_val(&texels[..]),
            Self::Codes(texels) => size_of_val(&texels[..]),
            Self::Floats(texels) => size_of_val(&texels[..]),
        }
    }
}

/// The sums of channels, from zero on.
fn sum<C: Copy, N: Copy + AddAssign>(texels: &[[C; 4]], zero: N, number: fn(C) -> N) -> [N; 4] {
    let mut sum = [zero; 4];
    for texel in texels {
        (0..4).for_each(|c| sum[c] += number(texel[c]));
    }
    sum
}

/// Memory that texels of a pyramid in the making are put into.
#[derive(Debug)]
pub(crate) enum Strip<'a, T> {
    Own(&'a mut [T]),
    Codes(&'a mut [Code]),
}

impl<'a, T: Cell> Strip<'a, T> {
    /// All of a level's; none if it is not of such texels.
    pub(crate) fn of(store: &'a mut Store) -> Self {
        if let Store::Codes(codes) = store {
            return Self::Codes(codes);
        }
        Self::Own(T::kept(store).map_or(&mut [][..], |memory| memory))
    }

    /// Puts texels, from an index on, where there is room for them.
    pub(crate) fn put(&mut self, start: usize, texels: &[T]) {
        let range = start..start + texels.len();
        match self {
            Self::Own(memory) => {
                if let Some(memory) = memory.get_mut(range) {
                    memory.copy_from_slice(texels);
                }
            }
            Self::Codes(memory) => {
                for (code, texel) in memory.get_mut(range).unwrap_or(&mut []).iter_mut().zip(texels)
                {
                    *code = texel.code();
                }
            }
        }
    }

    /// The first so many, and the others.
    #[cfg(feature = "parallel")]
    pub(crate) fn split_at(self, len: usize) -> (Self, Self) {
        match self {
            Self::Own(memory) => {
                let (first, rest) = memory.split_at_mut(len.min(memory.len()));
                (Self::Own(first), Self::Own(rest))
            }
            Self::Codes(memory) => {
                let (first, rest) = memory.split_at_mut(len.min(memory.len()));
                (Self::Codes(first), Self::Codes(rest))
            }
        }
    }
}

/// Texels of whole numbers.
#[derive(Debug, Clone, Copy)]
pub(crate) enum Whole<'a> {
    Steps(&'a [Texel]),
    Codes(&'a [Code]),
}

impl<'a> Whole<'a> {
    /// So many of them from an index on.
    #[inline(always)]
    pub(crate) fn part(self, start: usize, len: usize) -> Self {
        match self {
            Self::Steps(texels) => Self::Steps(&texels[start..][..len]),
            Self::Codes(texels) => Self::Codes(&texels[start..][..len]),
        }
    }

    /// One of them, in steps.
    #[inline(always)]
    pub(crate) fn texel(self, index: usize) -> Texel {
        match self {
            Self::Steps(texels) => texels[index],
            Self::Codes(texels) => of_code(texels[index]),
        }
    }

    /// Some from an index on, in steps, if there are as many.
    #[inline(always)]
    pub(crate) fn run<const N: usize>(self, start: usize) -> Option<[Texel; N]> {
        match self {
            Self::Steps(texels) => texels.get(start..)?.first_chunk().copied(),
            Self::Codes(texels) => {
                let codes = texels.get(start..)?.first_chunk::<N>()?;
                let mut run = [[0; 4]; N];
                for (texel, codes) in run.iter_mut().zip(codes) {
                    *texel = of_code(*codes);
                }
                Some(run)
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn codes_are_the_steps_that_they_stand_for() {
        for v in 0..=255u8 {
            let steps = of_code([v, 255 - v, 0, 255]);
            assert_eq!(code(steps), [v, 255 - v, 0, 255]);
            assert_eq!(of_color([v, 255 - v, 0, 255].map(|v| f32::from(v) / 255.0)), steps);
            let color = [v, 0, 0, v].map(|v| f32::from(v) / 255.0);
            assert!(has_code(color));
            assert!(!has_code([color[0] + 0.001, 0.0, 0.0, 1.0]), "{v}");
        }
        assert!(!has_code([0.5, 0.5, 0.5, 0.5]) && !has_code([1.1, 0.0, 0.0, 1.0]));
        assert!(!has_code([-0.1, 0.0, 0.0, 1.0]));
    }

    #[test]
    fn memory_is_kept_if_it_is_of_the_kind_and_size() {
        let make = |old| Store::new::<Code>(5, old).unwrap();
        let Store::Codes(mut first) = make(None) else { panic!() };
        first[3] = [1, 2, 3, 4];
        let again = make(Some(Store::Codes(first)));
        assert_eq!(again.whole().texel(3), [64, 128, 192, 256]);
        assert_eq!(
            (again.bytes(), again.whole().run::<2>(3)),
            (20, Some([[64, 128, 192, 256], [0; 4]]))
        );
        assert_eq!(again.whole().run::<2>(4), None);
        assert_eq!(Store::new::<Texel>(5, Some(again)).unwrap().whole().texel(3), [0; 4]);
        assert!(Store::new::<[f32; 4]>(5, None).unwrap().floats().is_some());
    }
}
