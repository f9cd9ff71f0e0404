//! What pixels see.

use crate::gallery::Drawn;
use crate::gallery::ink::{BLUE, GREEN, GREY, LIGHT, RED, finish};
use crate::gallery::stage::{scene, shot};
use crate::svg::polar;
use scumble::texture::{LevelMode, PixelFilter, Sampler};
use scumble_geometry::{DVec2, Path};
use scumble_pixel::Straight;
use scumble_sheet::{Anchor, Cell, Drawing, INK, contact_sheet};

/// A Jacobian by its columns: the steps to the right and down.
pub(super) type Columns = [DVec2; 2];

/// The Jacobians that are drawn.
pub(super) const JACOBIANS: [(&str, Columns); 4] = [
    ("a scale", [DVec2::new(5.0, 0.0), DVec2::new(0.0, 2.0)]),
    ("a shear", [DVec2::new(5.0, 1.5), DVec2::new(4.0, 3.5)]),
    ("a rotation", [DVec2::new(2.6, 2.6), DVec2::new(-2.6, 2.6)]),
    ("far along a plane", [DVec2::new(1.2, 0.4), DVec2::new(4.2, 5.6)]),
];

/// The half-axes of the image of the unit circle: the eigenvectors of JJᵀ, the longer first.
pub(super) fn axes([a, b]: Columns) -> [DVec2; 2] {
    let (p, q, r) = (a.x * a.x + b.x * b.x, a.x * a.y + b.x * b.y, a.y * a.y + b.y * b.y);
    let root = ((p - r) * (p - r) / 4.0 + q * q).sqrt();
    let (long, short) = ((p + r) / 2.0 + root, ((p + r) / 2.0 - root).max(0.0));
    // Of two ways to write the eigenvector, the one that does not cancel.
    let (s, t) = (DVec2::new(q, long - p), DVec2::new(long - r, q));
    let way = if s.length() > t.length() { s } else { t };
    let way = if way.length() > 0.0 { way / way.length() } else { DVec2::new(1.0, 0.0) };
    [way * long.sqrt(), DVec2::new(-way.y, way.x) * short.sqrt()]
}

/// The image of a circle of radius `r` about the origin.
pub(super) fn ellipse([a, b]: Columns, r: f64, place: impl Fn(DVec2) -> DVec2) -> Path {
    let point = |k: u32| {
        let (x, y) = polar(0.0, 0.0, r, f64::from(k) / 96.0);
        place(a * x + b * y)
    };
    Path::polyline((0..96).map(point), true)
}

fn arrow(drawing: &mut Drawing, from: DVec2, to: DVec2, color: Straight) {
    let way = to - from;
    let back = way * (9.0 / way.length().max(1e-9));
    let side = DVec2::new(-back.y, back.x) * 0.45;
    drawing.line([from, to], 2.2, color);
    drawing.line([to - back + side, to, to - back - side], 2.2, color);
}

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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn axes_are_at_right_angles_and_on_the_ellipse() {
        for (name, columns) in JACOBIANS {
            let [long, short] = axes(columns);
            assert!(long.dot(short).abs() < 1e-12, "{name}");
            let [a, b] = columns;
            let det = a.x * b.y - a.y * b.x;
            assert!((long.length() * short.length() - det.abs()).abs() < 1e-12, "{name}");
            // The longest image of any unit vector.
            let longest = (0..3600)
                .map(|k| {
                    let (x, y) = polar(0.0, 0.0, 1.0, f64::from(k) / 3600.0);
                    (a * x + b * y).length()
                })
                .fold(0.0, f64::max);
            assert!((longest - long.length()).abs() < 1e-5, "{name}");
        }
    }
}
