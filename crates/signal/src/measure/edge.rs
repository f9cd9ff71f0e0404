//! The slanted edge: where it runs, and its profile.

use crate::SignalError;
use scumble_pixel::{Image, ImageView};

/// Samples of the profile to a pixel.
pub(super) const OVERSAMPLING: usize = 4;

/// Fewest columns and rows of an image with an edge.
const LEAST: usize = 16;

/// Pixels to either side of the edge that the second fit looks at.
const REACH: f64 = 10.0;

/// Least height of the edge, beside the spread of the image: below it there is none.
const CONTRAST: f64 = 0.2;

/// A line x = `at` + `slope`·y, x and y in pixels from the first one's centre.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Line {
    pub(super) at: f64,
    pub(super) slope: f64,
}

impl Line {
    fn x(self, y: f64) -> f64 {
        self.at + self.slope * y
    }

    /// The line nearest to the points (position, x) in the sense of least squares.
    fn through(points: &[(f64, f64)]) -> Option<Self> {
        let n = points.len() as f64;
        let (mean_y, mean_x) =
            points.iter().fold((0.0, 0.0), |(y, x), p| (y + p.0 / n, x + p.1 / n));
        let (mut yy, mut xy) = (0.0, 0.0);
        for (y, x) in points {
            yy += (y - mean_y) * (y - mean_y);
            xy += (y - mean_y) * (x - mean_x);
        }
        let slope = xy / yy;
        slope.is_finite().then_some(Self { at: mean_x - slope * mean_y, slope })
    }
}

/// The image, turned so that its edge crosses the rows, and the edge's line.
pub(super) fn find(plane: ImageView<'_, f64>) -> Result<(Image<f64>, Line), SignalError> {
    if plane.width() < LEAST || plane.height() < LEAST {
        return Err(SignalError::NoEdge);
    }
    let along = |dx: usize, dy: usize| -> f64 {
        let (w, h) = (plane.width() - dx, plane.height() - dy);
        (0..h)
            .map(|y| (0..w).map(|x| plane.row(y + dy)[x + dx] - plane.row(y)[x]).sum::<f64>())
            .sum()
    };
    let image = if along(1, 0).abs() >= along(0, 1).abs() {
        plane.to_image()
    } else {
        let turned = Image::from_fn(plane.height(), plane.width(), |x, y| plane.row(x)[y]);
        turned.unwrap_or_default()
    };
    let line = fit(&image)?;
    Ok((image, line))
}

/// The edge's place in each row is the middle of its derivative; a line through them all, then again
/// from what is near that line, which leaves the noise of the rest out.
fn fit(image: &Image<f64>) -> Result<Line, SignalError> {
    let line = pass(image, |_, _| 1.0)?;
    let near = |x: f64, y: f64| {
        let t = (x - line.x(y)) / REACH;
        // Smooth, so that no pixel comes in at once.
        if t.abs() < 1.0 { (1.0 - t * t) * (1.0 - t * t) } else { 0.0 }
    };
    // An even weight about the true place leaves the middle where it is.
    pass(image, near)
}

fn pass(image: &Image<f64>, weight: impl Fn(f64, f64) -> f64) -> Result<Line, SignalError> {
    let mut places = Vec::with_capacity(image.height());
    for (y, row) in image.view().rows().enumerate() {
        let (mut sum, mut moment, mut spread) = (0.0, 0.0, 0.0_f64);
        for (i, pair) in row.windows(2).enumerate() {
            let x = i as f64 + 0.5;
            let step = (pair[1] - pair[0]) * weight(x, y as f64);
            sum += step;
            moment += step * x;
            spread += step.abs();
        }
        // Also where either is NaN.
        let clear = sum.abs() > CONTRAST * spread;
        let place = moment / sum;
        if !clear || !(0.0..=row.len() as f64).contains(&place) {
            return Err(SignalError::NoEdge);
        }
        places.push((y as f64, place));
    }
    Line::through(&places).ok_or(SignalError::NoEdge)
}

/// The edge's profile, [`OVERSAMPLING`] values to a pixel across it, the edge in the middle.
///
/// Each value is the mean of the pixels nearest to its place, brought there from where they are by
/// the profile's own first two derivatives: so it is the profile at a point, and not its mean over
/// a quarter of a pixel.
pub(super) fn profile(image: &Image<f64>, line: Line) -> Result<Vec<f64>, SignalError> {
    let bins = gather(image, line)?;
    let mut profile: Vec<f64> = bins.iter().map(|bin| bin.value).collect();
    // Three rounds: each brings the derivatives nearer.
    for _ in 0..3 {
        let last = profile.clone();
        for i in 2..profile.len() - 2 {
            let [a, b, c, d, e] = [0, 1, 2, 3, 4].map(|k| last[i + k - 2]);
            // Differences of fourth order, per step.
            let first = (a - e + 8.0 * (d - b)) / 12.0;
            let second = (16.0 * (b + d) - a - e - 30.0 * c) / 12.0;
            profile[i] = bins[i].value - first * bins[i].offset - 0.5 * second * bins[i].square;
        }
    }
    Ok(profile)
}

/// What fell nearest to one place of the profile.
#[derive(Clone, Copy, Default)]
struct Bin {
    count: f64,
    /// The mean value.
    value: f64,
    /// The mean distance from the place, in steps of the profile, and the mean of its square.
    offset: f64,
    square: f64,
}

fn gather(image: &Image<f64>, line: Line) -> Result<Vec<Bin>, SignalError> {
    // As far as every row reaches to both sides.
    let (width, last) = (image.width() as f64, image.height() as f64 - 1.0);
    let (low, high) = (line.x(0.0).min(line.x(last)), line.x(0.0).max(line.x(last)));
    let across = 1.0 / (1.0 + line.slope * line.slope).sqrt();
    let reach = (low.min(width - 1.0 - high) * across).floor();
    if reach.is_nan() || reach < LEAST as f64 / 4.0 {
        return Err(SignalError::NoEdge);
    }
    let half = reach as usize * OVERSAMPLING;
    let mut bins = vec![Bin::default(); 2 * half + 1];
    for (y, row) in image.view().rows().enumerate() {
        for (x, value) in row.iter().enumerate() {
            let steps = (x as f64 - line.x(y as f64)) * across * OVERSAMPLING as f64;
            let place = (steps + 0.5).floor();
            let index = place + half as f64;
            if index < 0.0 || index >= bins.len() as f64 {
                continue;
            }
            let bin = &mut bins[index as usize];
            let offset = steps - place;
            bin.count += 1.0;
            bin.value += value;
            bin.offset += offset;
            bin.square += offset * offset;
        }
    }
    if bins.iter().any(|bin| bin.count == 0.0) {
        return Err(SignalError::Unslanted);
    }
    for bin in &mut bins {
        bin.value /= bin.count;
        bin.offset /= bin.count;
        bin.square /= bin.count;
    }
    Ok(bins)
}
