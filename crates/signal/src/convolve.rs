use crate::{Border, Kernel, Kernel2};
use scumble_pixel::{Image, ImageView};

/// The plane convolved with a kernel: (k ∗ p)(x, y) = Σ k(i, j)·p(x − i, y − j), i and j counted from
/// the kernel's middle.
///
/// Work goes with the number of weights; [`convolve_separable`] and
/// [`band_filter`](crate::band_filter) are for wide ones.
#[must_use]
pub fn convolve(plane: ImageView<'_, f64>, kernel: &Kernel2, border: Border) -> Image<f64> {
    let (columns, rows) = (kernel.width(), kernel.height());
    let at = |x: usize, y: usize| {
        let mut sum = 0.0;
        for (j, weights) in kernel.weights().chunks_exact(columns).enumerate() {
            let row = plane.row(border.resolve(behind(y, j, rows / 2), plane.height()));
            for (i, weight) in weights.iter().enumerate() {
                let column = border.resolve(behind(x, i, columns / 2), row.len());
                sum += weight * row[column];
            }
        }
        sum
    };
    Image::from_fn(plane.width(), plane.height(), at).unwrap_or_default()
}

/// The plane convolved with `across` along its rows and then with `down` along its columns.
#[must_use]
pub fn convolve_separable(
    plane: ImageView<'_, f64>,
    across: &Kernel,
    down: &Kernel,
    border: Border,
) -> Image<f64> {
    let (width, height) = (plane.width(), plane.height());
    let mut rows = Vec::with_capacity(width * height);
    let columns = sources(width, across, border);
    for row in plane.rows() {
        rows.extend((0..width).map(|x| {
            let from = &columns[x * across.weights().len()..];
            across.weights().iter().zip(from).map(|(weight, &i)| weight * row[i]).sum::<f64>()
        }));
    }
    let lines = sources(height, down, border);
    let mut out = Image::filled(width, height, 0.0).unwrap_or_default();
    for y in 0..height {
        let from = &lines[y * down.weights().len()..];
        for (weight, &j) in down.weights().iter().zip(from) {
            let source = &rows[j * width..(j + 1) * width];
            for (sum, value) in out.row_mut(y).iter_mut().zip(source) {
                *sum += weight * value;
            }
        }
    }
    out
}

/// For every place along an axis, where each weight finds its pixel.
fn sources(len: usize, kernel: &Kernel, border: Border) -> Vec<usize> {
    let weights = kernel.weights().len();
    let place = |at: usize| (0..weights).map(move |i| behind(at, i, weights / 2));
    (0..len).flat_map(place).map(|index| border.resolve(index, len)).collect()
}

/// `place` − (`index` − `middle`).
fn behind(place: usize, index: usize, middle: usize) -> i64 {
    place as i64 + middle as i64 - index as i64
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Frequency, Spectrum, Window};
    use proptest::prelude::*;

    fn noise(w: usize, h: usize, seed: usize) -> Image<f64> {
        let hash = |i: usize| (i.wrapping_mul(0x9e37_79b9_7f4a_7c15) >> 40) & 0xff;
        Image::from_fn(w, h, |x, y| hash(seed + x + 977 * y) as f64 / 255.0).unwrap()
    }

    #[test]
    fn a_row_by_hand() {
        // 1 2 1 over 1 3 5 3 7, the border's pixel repeated.
        let row = Image::from_vec(5, 1, vec![1.0, 3.0, 5.0, 3.0, 7.0]).unwrap();
        let kernel = Kernel2::new(3, 1, vec![1.0, 2.0, 1.0]).unwrap();
        let sums = convolve(row.view(), &kernel, Border::Clamp);
        assert_eq!(sums.pixels(), [6.0, 12.0, 16.0, 18.0, 24.0]);
    }

    #[test]
    fn a_shift_goes_the_way_of_a_convolution() {
        let row = Image::from_vec(4, 1, vec![1.0, 2.0, 3.0, 4.0]).unwrap();
        // The weight right of the middle brings the pixel from the left: all moves right.
        let shift = Kernel::new(vec![0.0, 0.0, 1.0]).unwrap();
        let one = Kernel::new(vec![1.0]).unwrap();
        let moved = convolve_separable(row.view(), &shift, &one, Border::Repeat);
        assert_eq!(moved.pixels(), [4.0, 1.0, 2.0, 3.0]);
    }

    proptest! {
        #[test]
        fn a_product_of_kernels_is_their_convolutions(
            (w, h) in (1..9_usize, 1..9_usize),
            a in prop::collection::vec(-1.0..1.0_f64, 3),
            b in prop::collection::vec(-1.0..1.0_f64, 5),
            border in prop::sample::select(vec![Border::Clamp, Border::Repeat, Border::Mirror]),
        ) {
            let plane = noise(w, h, 5);
            let weights = b.iter().flat_map(|b| a.iter().map(move |a| a * b)).collect();
            let whole = convolve(plane.view(), &Kernel2::new(3, 5, weights).unwrap(), border);
            let (a, b) = (Kernel::new(a).unwrap(), Kernel::new(b).unwrap());
            let parts = convolve_separable(plane.view(), &a, &b, border);
            for (a, b) in whole.pixels().iter().zip(parts.pixels()) {
                prop_assert!((a - b).abs() < 1e-13);
            }
        }

        #[test]
        fn the_convolution_theorem_holds(
            (w, h) in (1..12_usize, 1..12_usize),
            weights in prop::collection::vec(-1.0..1.0_f64, 5),
        ) {
            let plane = noise(w, h, 9);
            let kernel = Kernel::new(weights).unwrap();
            let space = convolve_separable(plane.view(), &kernel, &kernel, Border::Repeat);
            let before = Spectrum::new(plane.view(), Window::None);
            let after = Spectrum::new(space.view(), Window::None);
            for ((Frequency { x, y }, bin), (_, found)) in before.bins().zip(after.bins()) {
                let expected = bin * kernel.response(x) * kernel.response(y);
                prop_assert!((expected - found).norm() < 1e-10);
            }
        }
    }

    #[test]
    fn nothing_in_nothing_out() {
        let none = Image::<f64>::default();
        let kernel = Kernel::gaussian(2.0).unwrap();
        assert!(
            convolve_separable(none.view(), &kernel, &kernel, Border::Mirror).pixels().is_empty()
        );
        let small = Kernel2::new(1, 1, vec![2.0]).unwrap();
        assert!(convolve(none.view(), &small, Border::Clamp).pixels().is_empty());
    }
}
