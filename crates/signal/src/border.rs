/// What a convolution finds beyond an image's border.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default)]
pub enum Border {
    /// The outermost pixel, on and on.
    #[default]
    Clamp,
    /// The image again.
    Repeat,
    /// The image turned over, the outermost pixel twice.
    Mirror,
}

/// How an image becomes the pattern without end that the Fourier transform is of.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default)]
pub enum Tiling {
    /// Turned over at each border, as [`Border::Mirror`]: no jump there, at four times the work.
    #[default]
    Mirror,
    /// Side by side, as [`Border::Repeat`]: right for what tiles, a jump at the borders else.
    Repeat,
}

impl Border {
    /// The column (or row) of an image of `len` that stands for `index`; `len` is not 0.
    pub(crate) fn resolve(self, index: i64, len: usize) -> usize {
        let n = i64::try_from(len).unwrap_or(i64::MAX);
        let found = match self {
            Self::Clamp => index.clamp(0, n - 1),
            Self::Repeat => index.rem_euclid(n),
            Self::Mirror => {
                let around = index.rem_euclid(2 * n);
                around.min(2 * n - 1 - around)
            }
        };
        found as usize
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_continues_in_its_way() {
        let around = |border: Border| (-4..7).map(|i| border.resolve(i, 3)).collect::<Vec<_>>();
        assert_eq!(around(Border::Clamp), [0, 0, 0, 0, 0, 1, 2, 2, 2, 2, 2]);
        assert_eq!(around(Border::Repeat), [2, 0, 1, 2, 0, 1, 2, 0, 1, 2, 0]);
        assert_eq!(around(Border::Mirror), [2, 2, 1, 0, 0, 1, 2, 2, 1, 0, 0]);
    }
}
