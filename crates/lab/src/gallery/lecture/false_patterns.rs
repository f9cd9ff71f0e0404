//! What shows that is not there.

use super::coverage::spokes;
use crate::gallery::ink::{BLUE, RED, enlarged, finish, grey, part, plane, rgb, sampled};
use crate::gallery::{Drawn, GalleryError, Picture};
use crate::math::cos;
use crate::svg::polar;
use scumble::framebuffer::Exposure;
use scumble_geometry::{DVec2, Path};
use scumble_pixel::{Image, Premul, Straight, WorkingSpace};
use scumble_sheet::{Cell, Drawing, contact_sheet};
use scumble_signal::{Band, Shape, Tiling, band_filter};
use std::f64::consts::PI;

/// The spokes by so many samples, on 96 × 96 pixels.
pub(super) fn wheel(samples: usize) -> Drawn {
    let mut drawing = Drawing::new(96, 96);
    drawing.fill(spokes(47.3, 44.0, 24), BLUE);
    sampled(&drawing.into_scene(), 96, 96, samples)
}

pub(super) fn jaggies() -> Drawn {
    let mut cells = Vec::new();
    for samples in [1, 4, 16] {
        let words = if samples == 1 { "1 sample".to_owned() } else { format!("{samples} samples") };
        cells.push(Cell::new(wheel(samples)?, [words]));
    }
    finish(contact_sheet(&cells, 3, 3))
}

pub(super) fn moire() -> Drawn {
    const N: usize = 384;
    let half = N as f64 / 2.0;
    let rings = plane(N, N, |x, y| {
        let (x, y) = (x - half, y - half);
        0.5 + 0.5 * cos(PI * (x * x + y * y) / (2.0 * half))
    })?;
    let third = |image: &Image<f64>| -> Result<Picture, GalleryError> {
        let small = Image::from_fn(N / 3, N / 3, |x, y| image.row(3 * y)[3 * x])?;
        enlarged(&grey(&small), 2)
    };
    // The rings repeat after N pixels, without a seam.
    let smooth = band_filter(rings.view(), Band::LowPass(0.125), Shape::Gaussian, Tiling::Repeat)?;
    let whole = part(&grey(&rings), [64, 64, 256, 256]);
    let cells = [
        Cell::new(whole, ["the picture, its middle"]),
        Cell::new(third(&rings)?, ["every third pixel"]),
        Cell::new(third(&smooth)?, ["filtered, then every third"]),
    ];
    finish(contact_sheet(&cells, 3, 1))
}

/// Turns from picture to picture: 40°.
const TURN: f64 = 1.0 / 9.0;

/// A wheel of eight spokes, turned clockwise from its place.
fn wagon(turn: f64) -> Drawn {
    const SIDE: u32 = 92;
    let middle = f64::from(SIDE) / 2.0;
    let mut drawing = Drawing::new(SIDE, SIDE);
    let center = DVec2::new(middle, middle);
    let wood = rgb(0x4a4038);
    drawing.stroke(Path::ellipse(center, DVec2::new(40.0, 40.0)), 4.0, wood);
    for k in 0..8 {
        let end = polar(middle, middle, 38.0, turn + f64::from(k) / 8.0);
        // The red one broad, so that its sweep is seen.
        let (color, width): (Straight, f64) = if k == 0 { (RED, 7.0) } else { (wood, 3.4) };
        drawing.line([center, DVec2::new(end.0, end.1)], width, color);
    }
    drawing.dot(center, 6.0, wood);
    finish(drawing)
}

/// The mean of many moments of a turning wheel, as light adds.
fn blurred(from: f64) -> Drawn {
    const MOMENTS: u32 = 48;
    let space = WorkingSpace::Linear;
    let mut exposure = Exposure::default();
    let mut picture = Picture::default();
    for i in 0..MOMENTS {
        picture = wagon(from + TURN * f64::from(i) / f64::from(MOMENTS))?;
        if i == 0 {
            exposure = Exposure::new(picture.width(), picture.height());
        }
        for y in 0..picture.height() {
            let row: Vec<Premul> = picture.row(y).iter().map(|&code| space.import8(code)).collect();
            exposure.add_row(y, 1.0, &row);
        }
    }
    let mut row = vec![Premul::TRANSPARENT; picture.width()];
    for y in 0..picture.height() {
        exposure.mean_row(y, &mut row);
        space.export_row(&row, picture.row_mut(y));
    }
    Ok(picture)
}

pub(super) fn wagon_wheel() -> Drawn {
    let mut cells = Vec::new();
    for (row, draw) in [wagon as fn(f64) -> Drawn, blurred].into_iter().enumerate() {
        for i in 0..8 {
            let words = match (row, i) {
                (0, 0) => vec!["moments"],
                (1, 0) => vec!["motion blur"],
                _ => Vec::new(),
            };
            cells.push(Cell::new(draw(TURN * f64::from(i))?, words));
        }
    }
    finish(contact_sheet(&cells, 8, 1))
}
