//! Blur before sampling, and after it.

use super::false_patterns::wheel;
use crate::gallery::ink::{BLUE, GREY, RED, finish, grey};
use crate::gallery::plot::Plot;
use crate::gallery::{Drawn, GalleryError, Picture};
use scumble::coverage::{AreaSink, IntRect, Scratch, Shape};
use scumble_geometry::{DVec2, Rect};
use scumble_pixel::{Image, WorkingSpace};
use scumble_sheet::{Cell, Drawing, contact_sheet};
use scumble_signal::measure::unexplained;
use scumble_signal::{Border, Channel, Kernel, convolve_separable, plane};

fn luma(picture: &Picture) -> Image<f64> {
    let colors = picture.map(|&c| WorkingSpace::Srgb.import8(c));
    plane(colors.view(), Channel::Luminance)
}

pub(super) fn before_and_after() -> Drawn {
    let truth = luma(&wheel(64)?);
    let point = luma(&wheel(1)?);
    let kernel = Kernel::rectangle(3.0)?;
    let after = convolve_separable(point.view(), &kernel, &kernel, Border::Clamp);
    let before = luma(&wheel(16)?);
    let pictures =
        [(point, "sampled"), (after, "sampled, then blurred"), (before, "blurred, then sampled")];
    let mut cells = Vec::new();
    for (picture, words) in pictures {
        let fit = unexplained(picture.view(), truth.view())?;
        let percent = format!("{:.1}% unexplained", 100.0 * fit.ratio());
        cells.push(Cell::new(grey(&picture), [words.to_owned(), percent]));
    }
    finish(contact_sheet(&cells, 3, 3))
}

/// The areas of one row of pixels.
struct Row(Vec<f32>);

impl AreaSink for Row {
    fn run(&mut self, _: i32, x0: i32, x1: i32) {
        for x in x0..x1 {
            self.0[x as usize] = 1.0;
        }
    }

    fn pixel(&mut self, x: i32, _: i32, area: f32) {
        self.0[x as usize] = area;
    }
}

/// The left edge's place is the same in every row; the right one's falls by so much a row.
const LEFT: f64 = 3.25;
const SLOPE: f64 = 2.6;
/// Where the right edge is half way down the row.
const RIGHT: f64 = 12.3;

fn areas() -> Result<Vec<f32>, GalleryError> {
    let mut row = Row(vec![0.0; 18]);
    // The apex is where both edges meet, far above.
    let height = (RIGHT - LEFT) / SLOPE;
    let apex = DVec2::new(LEFT, 0.5 - height);
    let low = DVec2::new(LEFT, 9.5);
    let far = DVec2::new(RIGHT + 9.0 * SLOPE, 9.5);
    if let Some(shape) = Shape::triangle([apex, far, low])? {
        shape.rasterize_area(IntRect::new(0, 0, 18, 1), &mut Scratch::new(), &mut row);
    }
    Ok(row.0)
}

/// The part of a unit square about (x, ½) that lies within the triangle's two edges, by thin rows.
fn convolved(x: f64) -> f64 {
    const ROWS: i32 = 400;
    let covered = |k: i32| {
        let y = (f64::from(k) + 0.5) / f64::from(ROWS);
        let right = RIGHT + SLOPE * (y - 0.5);
        ((x + 0.5).min(right) - (x - 0.5).max(LEFT)).clamp(0.0, 1.0)
    };
    (0..ROWS).map(covered).sum::<f64>() / f64::from(ROWS)
}

pub(super) fn pixel_box() -> Drawn {
    let mut drawing = Drawing::new(880, 230);
    let plot = Plot { frame: Rect::new(50.0, 30.0, 860.0, 190.0), x: [0.0, 18.0], y: [0.0, 1.1] };
    plot.rules(&mut drawing, &[(0.0, "0"), (0.5, "0.5"), (1.0, "1")]);
    let ticks: Vec<(f64, String)> = (0..18).map(|i| (f64::from(i) + 0.5, i.to_string())).collect();
    let ticks: Vec<(f64, &str)> = ticks.iter().map(|(x, s)| (*x, s.as_str())).collect();
    plot.ticks(&mut drawing, &ticks);
    plot.axes(&mut drawing, "coverage along a row of pixels");
    plot.curve(&mut drawing, GREY, 1.6, |x| f64::from(u8::from((LEFT..RIGHT).contains(&x))));
    plot.curve(&mut drawing, BLUE, 2.0, convolved);
    let points: Vec<(f64, f64)> = areas()?
        .into_iter()
        .zip(0..)
        .map(|(area, i)| (f64::from(i) + 0.5, f64::from(area)))
        .collect();
    plot.dots(&mut drawing, RED, &points);
    finish(drawing)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn areas_are_the_convolution_at_the_centres() {
        for (x, area) in areas().unwrap().into_iter().enumerate() {
            let expected = convolved(x as f64 + 0.5);
            // The corners are snapped to 1/256 pixel.
            assert!((f64::from(area) - expected).abs() < 0.004, "{x}: {area} {expected}");
        }
    }
}
