//! The transform in two dimensions: rows, then columns.

use rustfft::num_complex::Complex;
use rustfft::{FftDirection, FftPlannerScalar};

/// Transforms `width` × `height` bins in place, not normalised.
///
/// The planner is the scalar one, because the others choose by the processor and sum in another
/// order on each.
pub(crate) fn transform(
    bins: &mut [Complex<f64>],
    width: usize,
    height: usize,
    direction: FftDirection,
) {
    if width == 0 || height == 0 || bins.len() != width * height {
        return;
    }
    let mut planner = FftPlannerScalar::new();
    planner.plan_fft(width, direction).process(bins);
    let mut columns = transposed(bins, width);
    planner.plan_fft(height, direction).process(&mut columns);
    bins.copy_from_slice(&transposed(&columns, height));
}

/// Rows of `width` as columns. `width` divides the length.
fn transposed(bins: &[Complex<f64>], width: usize) -> Vec<Complex<f64>> {
    let height = bins.len() / width;
    let mut out = Vec::with_capacity(bins.len());
    for x in 0..width {
        out.extend((0..height).map(|y| bins[y * width + x]));
    }
    out
}
