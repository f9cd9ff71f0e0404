//! Sums: a convolution by hand, waves added up, and a picture as a sum of cosines.

use super::spectra::head;
use crate::gallery::ink::{BLUE, GREY, LIGHT, RED, enlarged, finish, grey};
use crate::gallery::plot::Plot;
use crate::gallery::{Drawn, GalleryError};
use crate::math::{cos, sin};
use scumble_geometry::{DVec2, Rect};
use scumble_pixel::{Image, Straight};
use scumble_sheet::{Anchor, Drawing, INK};
use scumble_signal::{Border, Kernel2, Spectrum, Window, convolve};
use std::f64::consts::PI;

const SIGNAL: [i32; 10] = [2, 4, 4, 6, 1, 0, 3, 5, 9, 7];
const WEIGHTS: [i32; 3] = [1, 2, 1];
/// Pixels along each side of a box with a number.
const BOX: f64 = 46.0;

/// Numbers in boxes, the first at a place.
fn boxes(drawing: &mut Drawing, at: DVec2, numbers: &[Option<i32>], fill: Straight) {
    for (index, number) in numbers.iter().enumerate() {
        let corner = at + DVec2::new(BOX * index as f64, 0.0);
        let rect = Rect::new(corner.x, corner.y, corner.x + BOX - 4.0, corner.y + BOX - 12.0);
        let Some(number) = number else {
            drawing.rect(rect, LIGHT);
            continue;
        };
        drawing.rect(rect, fill);
        let middle = corner + DVec2::new((BOX - 4.0) / 2.0, 23.0);
        drawing.text(middle, 16.0, Anchor::Middle, &number.to_string(), Straight::BLACK);
    }
}

/// The filtered signal: two numbers fewer.
fn filtered() -> Result<Vec<i32>, GalleryError> {
    let plane = Image::from_fn(SIGNAL.len(), 1, |x, _| f64::from(SIGNAL[x]))?;
    let kernel = Kernel2::new(3, 1, WEIGHTS.map(f64::from).to_vec())?;
    let found = convolve(plane.view(), &kernel, Border::Clamp);
    let inner = 1..SIGNAL.len() - 1;
    Ok(found.row(0)[inner].iter().map(|&v| (v + 0.5).floor() as i32).collect())
}

pub(super) fn by_hand() -> Drawn {
    let mut drawing = Drawing::new(900, 320);
    let left = 110.0;
    let pale = Straight([0.80, 0.87, 0.93, 1.0]);
    let warm = Straight([0.97, 0.88, 0.66, 1.0]);
    let label = |drawing: &mut Drawing, y: f64, words: &str| {
        drawing.text(DVec2::new(12.0, y + 23.0), 15.0, Anchor::Start, words, INK);
    };
    label(&mut drawing, 14.0, "signal");
    boxes(&mut drawing, DVec2::new(left, 14.0), &SIGNAL.map(Some), pale);
    for step in 0..3 {
        let y = 74.0 + 56.0 * step as f64;
        if step == 0 {
            label(&mut drawing, y, "filter");
        }
        let at = DVec2::new(left + BOX * step as f64, y);
        boxes(&mut drawing, at, &WEIGHTS.map(Some), warm);
        let terms: Vec<String> =
            (0..3).map(|k| format!("{}×{}", SIGNAL[step + k], WEIGHTS[k])).collect();
        let sum: i32 = (0..3).map(|k| SIGNAL[step + k] * WEIGHTS[k]).sum();
        let words = format!("{} = {sum}", terms.join(" + "));
        drawing.text(DVec2::new(640.0, y + 23.0), 16.0, Anchor::Start, &words, INK);
    }
    let y = 254.0;
    label(&mut drawing, y, "result");
    let mut row = vec![None];
    row.extend(filtered()?.into_iter().map(Some));
    row.push(None);
    boxes(&mut drawing, DVec2::new(left, y), &row, Straight([0.80, 0.90, 0.80, 1.0]));
    finish(drawing)
}

/// Three waves with their heights: half-cycles per unit.
const WAVES: [(f64, f64); 3] = [(1.0, 1.0), (2.0, 0.75), (4.0, 0.5)];

fn sum_of_waves(x: f64) -> f64 {
    WAVES.iter().map(|&(k, height)| height * sin(PI * k * x)).sum()
}

pub(super) fn waves() -> Drawn {
    const N: usize = 64;
    let mut drawing = Drawing::new(900, 450);
    let titles = ["sin πx", "0.75 sin 2πx", "0.5 sin 4πx", "their sum"];
    for (index, title) in titles.into_iter().enumerate() {
        let top = 30.0 + 106.0 * index as f64;
        let frame = Rect::new(40.0, top, 520.0, top + 76.0);
        let plot = Plot { frame, x: [0.0, 4.0], y: [-2.1, 2.1] };
        plot.rules(&mut drawing, &[(0.0, "0")]);
        plot.axes(&mut drawing, title);
        match WAVES.get(index) {
            Some(&(k, height)) => {
                plot.curve(&mut drawing, BLUE, 1.8, |x| height * sin(PI * k * x));
            }
            None => plot.curve(&mut drawing, RED, 2.0, sum_of_waves),
        }
    }
    // One period of the sum.
    let row = Image::from_fn(N, 1, |x, _| sum_of_waves(2.0 * x as f64 / N as f64))?;
    let spectrum = Spectrum::new(row.view(), Window::None);
    let frame = Rect::new(590.0, 60.0, 880.0, 400.0);
    let plot = Plot { frame, x: [0.0, 8.0], y: [0.0, 1.1] };
    plot.rules(&mut drawing, &[(0.0, "0"), (0.5, "0.5"), (0.75, "0.75"), (1.0, "1")]);
    let labels: Vec<String> = (1..8).map(|k| k.to_string()).collect();
    let ticks: Vec<(f64, &str)> =
        labels.iter().zip(1..).map(|(s, k)| (f64::from(k), s.as_str())).collect();
    plot.ticks(&mut drawing, &ticks);
    plot.axes(&mut drawing, "its spectrum: height over half-cycles a unit");
    for k in 0..8_i32 {
        let height = 2.0 * spectrum.bin(k as isize, 0).norm() / N as f64;
        let (low, high) = (plot.place(f64::from(k), 0.0), plot.place(f64::from(k), height));
        drawing.rect(Rect::new(low.x - 8.0, high.y, low.x + 8.0, low.y), RED);
    }
    finish(drawing)
}

/// The cosine of column i of eight, at pixel x.
fn cosine(i: usize, x: usize) -> f64 {
    cos(PI / 8.0 * i as f64 * (x as f64 + 0.5))
}

/// How much of each product of cosines a block of 8×8 holds.
fn coefficients(block: &Image<f64>) -> [[f64; 8]; 8] {
    std::array::from_fn(|j| {
        std::array::from_fn(|i| {
            let mut sum = 0.0;
            for y in 0..8 {
                for (x, value) in block.row(y).iter().enumerate() {
                    sum += value * cosine(i, x) * cosine(j, y);
                }
            }
            let share = |k: usize| if k == 0 { 1.0 } else { 2.0 };
            sum * share(i) * share(j) / 64.0
        })
    })
}

/// The block again, from the coefficients with i + j below a bound.
fn rebuilt(of: &[[f64; 8]; 8], below: usize) -> Result<Image<f64>, GalleryError> {
    Ok(Image::from_fn(8, 8, |x, y| {
        let mut sum = 0.0;
        for (j, row) in of.iter().enumerate() {
            for (i, value) in row.iter().enumerate().filter(|(i, _)| i + j < below) {
                sum += value * cosine(i, x) * cosine(j, y);
            }
        }
        sum
    })?)
}

pub(super) fn cosines() -> Drawn {
    let mut drawing = Drawing::new(900, 420);
    drawing.rect(Rect::new(8.0, 8.0, 300.0, 300.0), BLUE);
    for (i, j) in (0..8).flat_map(|j| (0..8).map(move |i| (i, j))) {
        let tile = Image::from_fn(8, 8, |x, y| 0.5 + 0.5 * cosine(i, x) * cosine(j, y))?;
        drawing.picture(enlarged(&grey(&tile), 4)?, 12 + 36 * i as u32, 12 + 36 * j as u32, 1);
    }
    // Across an eye.
    let face = head(128)?;
    let block = face.view().crop(41, 78, 8, 8).to_image();
    let table = coefficients(&block);
    for (j, row) in table.iter().enumerate() {
        for (i, value) in row.iter().enumerate() {
            // In codes of 255, to the nearest.
            let code = (255.0 * value + 0.5).floor() as i32;
            let at = DVec2::new(360.0 + 66.0 * i as f64, 32.0 + 36.0 * j as f64);
            let color = if code == 0 { GREY } else { INK };
            drawing.text(at, 15.0, Anchor::End, &code.to_string(), color);
        }
    }
    let counts = [(1, "1"), (2, "3"), (4, "10"), (8, "36"), (15, "all 64")];
    for (index, (below, words)) in counts.into_iter().enumerate() {
        let left = 12 + 150 * index as u32;
        drawing.picture(enlarged(&grey(&rebuilt(&table, below)?), 10)?, left, 312, 1);
        let at = DVec2::new(f64::from(left), 410.0);
        drawing.text(at, 14.0, Anchor::Start, words, INK);
    }
    drawing.picture(enlarged(&grey(&block), 10)?, 762, 312, 1);
    drawing.text(DVec2::new(762.0, 410.0), 14.0, Anchor::Start, "the block", INK);
    finish(drawing)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_convolution_is_what_the_hand_finds() {
        let by_hand =
            SIGNAL.windows(3).map(|w| w[0] * WEIGHTS[0] + w[1] * WEIGHTS[1] + w[2] * WEIGHTS[2]);
        assert!(filtered().unwrap().into_iter().eq(by_hand));
    }

    #[test]
    fn all_cosines_together_are_the_block() {
        let block = Image::from_fn(8, 8, |x, y| ((3 * x + 5 * y * y) % 11) as f64).unwrap();
        let again = rebuilt(&coefficients(&block), 15).unwrap();
        for (a, b) in block.pixels().iter().zip(again.pixels()) {
            assert!((a - b).abs() < 1e-12, "{a} {b}");
        }
    }
}
