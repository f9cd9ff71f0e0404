use crate::math;

/// What an image is multiplied by before its spectrum is taken.
///
/// An image that does not tile has a jump at its borders, which shows as a cross through the middle of
/// its spectrum. A window that falls to zero at the borders takes the cross away, and widens every
/// peak to two bins for it.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default)]
pub enum Window {
    /// Nothing: for what tiles, and wherever the transform is to be undone.
    #[default]
    None,
    /// Hann's raised cosine along each axis, periodic, divided by its mean ½: the bin at zero stays the
    /// sum of a constant image, and a sinusoid of whole cycles keeps its height.
    Hann,
}

impl Window {
    /// The weights of `len` samples; their mean is 1, but for a Hann window of a single sample, which
    /// is 1 as well.
    #[must_use]
    pub fn weights(self, len: usize) -> Vec<f64> {
        match self {
            Self::Hann if len > 1 => {
                // Half a sample in, so that it is the same from either side.
                let turns = |i: usize| (i as f64 + 0.5) / len as f64;
                (0..len).map(|i| 1.0 - math::sin_cos_turns(turns(i)).1).collect()
            }
            _ => vec![1.0; len],
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_mean_is_one() {
        for window in [Window::None, Window::Hann] {
            for len in [1, 2, 3, 8, 17] {
                let weights = window.weights(len);
                let mean = weights.iter().sum::<f64>() / len as f64;
                assert!((mean - 1.0).abs() < 1e-14, "{window:?} {len}");
                assert!(
                    weights.iter().zip(weights.iter().rev()).all(|(a, b)| (a - b).abs() < 1e-14)
                );
            }
            assert!(window.weights(0).is_empty());
        }
    }
}
