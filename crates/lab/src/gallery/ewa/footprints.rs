//! What pixels see.

use crate::gallery::Drawn;
use crate::gallery::ellipses::{Columns, arrow, axes, ellipse};
use crate::gallery::ink::{BLUE, GREEN, GREY, LIGHT, RED, finish};
use crate::gallery::stage::{scene, shot};
use scumble::texture::{LevelMode, PixelFilter, Sampler};
use scumble_geometry::{DVec2, Path};
use scumble_pixel::Straight;
use scumble_sheet::{Anchor, Cell, Drawing, INK, contact_sheet};

/// The Jacobians that are drawn.
pub(super) const JACOBIANS: [(&str, Columns); 4] = [
    ("a scale", [DVec2::new(5.0, 0.0), DVec2::new(0.0, 2.0)]),
    ("a shear", [DVec2::new(5.0, 1.5), DVec2::new(4.0, 3.5)]),
    ("a rotation", [DVec2::new(2.6, 2.6), DVec2::new(-2.6, 2.6)]),
    ("far along a plane", [DVec2::new(1.2, 0.4), DVec2::new(4.2, 5.6)]),
];

pub(super) fn strip() -> Drawn {
    const SIDE: f64 = 212.0;
    /// Pixels of the drawing to a texel.
    const TEXEL: f64 = 15.0;
    let mut drawing = Drawing::new(908, 258);
    for (index, (name, columns)) in JACOBIANS.into_iter().enumerate() {
        let left = 12.0 + 224.0 * index as f64;
        let middle = DVec2::new(left + SIDE / 2.0, 12.0 + SIDE / 2.0);
        let place = |p: DVec2| middle + p * TEXEL;
        for k in -7..=7 {
            let at = f64::from(k);
            drawing.line([place(DVec2::new(at, -7.0)), place(DVec2::new(at, 7.0))], 1.0, LIGHT);
            drawing.line([place(DVec2::new(-7.0, at)), place(DVec2::new(7.0, at))], 1.0, LIGHT);
        }
        let [a, b] = columns;
        let corners = [-a - b, a - b, a + b, b - a].map(|p| place(p * 0.5));
        drawing.fill(Path::polyline(corners, true), Straight([0.66, 0.66, 0.66, 0.45]));
        drawing.stroke(Path::polyline(corners, true), 1.4, GREY);
        // The circle in the pixel's square has radius ½.
        drawing.stroke(ellipse(columns, 0.5, place), 1.8, INK);
        for axis in axes(columns) {
            drawing.line([place(-axis * 0.5), place(axis * 0.5)], 2.0, BLUE);
        }
        arrow(&mut drawing, place((-a - b) * 0.5), place((a - b) * 0.5), RED);
        arrow(&mut drawing, place((-a - b) * 0.5), place((b - a) * 0.5), GREEN);
        drawing.text(DVec2::new(left, 12.0 + SIDE + 22.0), 14.0, Anchor::Start, name, INK);
    }
    finish(drawing)
}

pub(super) fn ground() -> Drawn {
    let scene = scene("ground")?;
    let crops = [
        ("far", [330, 205, 140, 100]),
        ("top", [400, 245, 140, 100]),
        ("near", [60, 480, 140, 100]),
    ];
    let filters = [
        ("trilinear", PixelFilter::Bilinear, LevelMode::Linear),
        ("EWA", Sampler::DEFAULT.pixel, LevelMode::Auto),
    ];
    let mut cells = Vec::new();
    for (filter, pixel, level) in filters {
        for (part, crop) in crops {
            let picture = shot(&scene, [800, 600], crop, |settings| {
                settings.sampler = settings.sampler.with(pixel, level);
                Ok(())
            })?;
            cells.push(Cell::new(picture, [format!("{filter}, {part}")]));
        }
    }
    finish(contact_sheet(&cells, 3, 2))
}
