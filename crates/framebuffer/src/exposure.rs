use alloc::{vec, vec::Vec};
use scumble_pixel::Premul;

/// Several moments as one picture: the mean of frames, which is motion blur if they are moments of an
/// exposure, and antialiasing if each is shifted by a part of a pixel.
///
/// Frames come row by row, as a renderer yields them, and each row is a mean of its own: of what has been
/// added to it. Sampling in time aliases like sampling in space, and the cure is the same: more samples,
/// averaged. Light adds, so the colours should be of [`WorkingSpace::Linear`](scumble_pixel::WorkingSpace).
///
/// What stays the same from frame to frame comes out exactly as it went in. Memory is 32 bytes a pixel.
///
/// ```
/// use scumble_framebuffer::Exposure;
/// use scumble_pixel::Premul;
///
/// // A white pixel that moves over black from left to right while the shutter is open.
/// let mut exposure = Exposure::new(4, 1);
/// for moment in 0..4 {
///     let mut row = [Premul([0.0, 0.0, 0.0, 1.0]); 4];
///     row[moment] = Premul([1.0; 4]);
///     exposure.add_row(0, 1.0, &row);
/// }
/// let mut row = [Premul::TRANSPARENT; 4];
/// exposure.mean_row(0, &mut row);
/// assert_eq!(row, [Premul([0.25, 0.25, 0.25, 1.0]); 4]);
/// ```
#[derive(Debug, Clone, Default)]
pub struct Exposure {
    width: usize,
    /// The first frame, and by how much the others differ from it: weighted, summed.
    pixels: Vec<[Premul; 2]>,
    /// For each row the sum of its weights; none before the first.
    totals: Vec<Option<f32>>,
}

impl Exposure {
    /// Nothing exposed yet, on so many pixels; on none if they are more than memory has addresses for.
    #[must_use]
    pub fn new(width: usize, height: usize) -> Self {
        let bytes = width.checked_mul(height).and_then(|n| n.checked_mul(size_of::<[Premul; 2]>()));
        if bytes.is_none_or(|bytes| isize::try_from(bytes).is_err()) {
            return Self::default();
        }
        let pixels = vec![[Premul::TRANSPARENT; 2]; width * height];
        Self { width, pixels, totals: vec![None; height] }
    }

    /// Adds row `y` of a frame that counts `weight` times as much as one of weight 1: how far the shutter
    /// is open. A weight below 0 or not finite counts as 0, and so does everything beyond the picture.
    /// A row that is too short leaves the rest of it as if it were the first frame's again.
    pub fn add_row(&mut self, y: usize, weight: f32, row: &[Premul]) {
        let Some(total) = self.totals.get_mut(y) else { return };
        let weight = if weight > 0.0 && weight < f32::INFINITY { weight } else { 0.0 };
        let pixels = &mut self.pixels[y * self.width..][..self.width];
        if total.is_none() {
            for ([first, _], color) in pixels.iter_mut().zip(row) {
                *first = *color;
            }
        }
        for ([Premul(first), Premul(sum)], Premul(color)) in pixels.iter_mut().zip(row) {
            for ((sum, first), color) in sum.iter_mut().zip(first).zip(color) {
                *sum += weight * (color - *first);
            }
        }
        *total = Some(total.unwrap_or(0.0) + weight);
    }

    /// The mean of row `y`: transparent before anything was added to it, and the first frame's where no
    /// frame had a weight. What of `out` lies beyond the picture is left alone.
    pub fn mean_row(&self, y: usize, out: &mut [Premul]) {
        let Some(total) = self.totals.get(y) else { return };
        let total = total.filter(|total| *total > 0.0);
        let scale = total.map_or(0.0, |total| 1.0 / total);
        let pixels = &self.pixels[y * self.width..][..self.width];
        for ([Premul(first), Premul(sum)], Premul(out)) in pixels.iter().zip(out) {
            *out = core::array::from_fn(|c| first[c] + sum[c] * scale);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn mean(exposure: &Exposure, y: usize, width: usize) -> Vec<Premul> {
        let mut row = vec![Premul([9.0; 4]); width];
        exposure.mean_row(y, &mut row);
        row
    }

    #[test]
    fn weights_are_shares() {
        let mut exposure = Exposure::new(1, 2);
        exposure.add_row(1, 3.0, &[Premul([1.0; 4])]);
        exposure.add_row(1, 1.0, &[Premul([0.0; 4])]);
        assert_eq!(mean(&exposure, 1, 1), [Premul([0.75; 4])]);
        assert_eq!(mean(&exposure, 0, 1), [Premul::TRANSPARENT], "nothing was added");
    }

    #[test]
    fn what_lies_beyond_is_left_alone() {
        let mut exposure = Exposure::new(2, 1);
        exposure.add_row(1, 1.0, &[Premul([1.0; 4]); 2]);
        exposure.add_row(0, 1.0, &[Premul([1.0; 4]); 5]);
        assert_eq!(mean(&exposure, 0, 3), [Premul([1.0; 4]), Premul([1.0; 4]), Premul([9.0; 4])]);
        assert_eq!(mean(&exposure, 7, 1), [Premul([9.0; 4])]);
        assert_eq!(mean(&Exposure::new(usize::MAX, 2), 0, 1), [Premul([9.0; 4])]);
    }

    #[test]
    fn odd_weights_count_as_none() {
        let mut exposure = Exposure::new(1, 1);
        for weight in [f32::NAN, -1.0, f32::INFINITY, 0.0] {
            exposure.add_row(0, weight, &[Premul([0.5; 4])]);
        }
        assert_eq!(mean(&exposure, 0, 1), [Premul([0.5; 4])]);
        exposure.add_row(0, 2.0, &[Premul([1.0; 4])]);
        assert_eq!(mean(&exposure, 0, 1), [Premul([1.0; 4])]);
    }

    proptest! {
        #[test]
        fn a_still_picture_stays_as_it_is(
            color in prop::array::uniform4(0.0..1.0_f32),
            weights in prop::collection::vec(0.0..9.0_f32, 1..40),
        ) {
            let mut exposure = Exposure::new(3, 1);
            for weight in weights {
                exposure.add_row(0, weight, &[Premul(color); 3]);
            }
            prop_assert_eq!(mean(&exposure, 0, 3), [Premul(color); 3]);
        }

        #[test]
        fn a_mean_is_near_the_sum_over_the_weights(
            frames in prop::collection::vec((0.1..9.0_f32, 0.0..1.0_f32), 1..60),
        ) {
            let mut exposure = Exposure::new(1, 1);
            for (weight, value) in &frames {
                exposure.add_row(0, *weight, &[Premul([*value; 4])]);
            }
            let sum: f64 = frames.iter().map(|(w, v)| f64::from(*w) * f64::from(*v)).sum();
            let total: f64 = frames.iter().map(|(w, _)| f64::from(*w)).sum();
            let found = f64::from(mean(&exposure, 0, 1)[0].0[0]);
            prop_assert!((found - sum / total).abs() < 1e-5, "{} {}", found, sum / total);
        }
    }
}
