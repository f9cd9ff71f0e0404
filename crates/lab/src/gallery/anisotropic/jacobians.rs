//! Jacobians, their columns and their axes.

use super::printed::{Signs, half_axes, longer};
use crate::gallery::Drawn;
use crate::gallery::ellipses::{Columns, arrow, axes, ellipse};
use crate::gallery::ink::{BLUE, GREEN, LIGHT, PURPLE, RED, YELLOW, finish};
use crate::math::{cos, sin};
use scumble_geometry::DVec2;
use scumble_pixel::Straight;
use scumble_sheet::{Anchor, Drawing, INK};
use std::f64::consts::TAU;

/// Lines at every unit about a place, so many to either side.
fn lattice(drawing: &mut Drawing, reach: i32, place: impl Fn(DVec2) -> DVec2) {
    let far = f64::from(reach);
    for k in -reach..=reach {
        let at = f64::from(k);
        drawing.line([place(DVec2::new(at, -far)), place(DVec2::new(at, far))], 1.0, LIGHT);
        drawing.line([place(DVec2::new(-far, at)), place(DVec2::new(far, at))], 1.0, LIGHT);
    }
}

pub(super) fn strip() -> Drawn {
    const SIDE: f64 = 168.0;
    /// Pixels of the drawing to a texel.
    const TEXEL: f64 = 16.0;
    let mut drawing = Drawing::new(910, 250);
    let circle: Columns = [DVec2::new(1.0, 0.0), DVec2::new(0.0, 1.0)];
    let fixed = DVec2::new(3.2, 1.2);
    for (index, degrees) in [90.0, 65.0, 45.0, 25.0, 10.0].into_iter().enumerate() {
        let left = 10.0 + 180.0 * index as f64;
        let middle = DVec2::new(left + SIDE / 2.0, 10.0 + SIDE / 2.0);
        let place = |p: DVec2| middle + p * TEXEL;
        lattice(&mut drawing, 5, place);
        let (c, s) = (cos(degrees * TAU / 360.0), sin(degrees * TAU / 360.0));
        let other = DVec2::new(c * fixed.x - s * fixed.y, s * fixed.x + c * fixed.y) * 0.8;
        let columns = [fixed, other];
        drawing.stroke(ellipse(circle, 1.0, place), 1.6, PURPLE);
        drawing.stroke(ellipse(columns, 1.0, place), 1.8, INK);
        let [long, short] = axes(columns);
        drawing.line([place(-long), place(long)], 1.6, BLUE);
        drawing.line([place(-short), place(short)], 1.6, YELLOW);
        arrow(&mut drawing, middle, place(fixed), RED);
        arrow(&mut drawing, middle, place(other), GREEN);
        let lengths = fixed.length() / other.length();
        let lines = [
            format!("{degrees:.0}° between columns"),
            format!("columns {lengths:.2} : 1"),
            format!("axes {:.2} : 1", long.length() / short.length()),
        ];
        for (k, line) in lines.iter().enumerate() {
            let at = DVec2::new(left, 10.0 + SIDE + 22.0 + 18.0 * k as f64);
            drawing.text(at, 14.0, Anchor::Start, line, INK);
        }
    }
    finish(drawing)
}

/// Leaning to one side, to the other, at 45°, and upright, leaning a little.
const LEANING: [(&str, Columns); 4] = [
    ("leans right", [DVec2::new(4.2, -1.6), DVec2::new(-0.8, 1.6)]),
    ("leans left", [DVec2::new(4.2, 1.6), DVec2::new(0.8, 1.6)]),
    ("at 45°", [DVec2::new(3.6, 1.8), DVec2::new(1.8, 3.6)]),
    ("steep", [DVec2::new(1.4, 0.3), DVec2::new(0.9, 4.2)]),
];

pub(super) fn signs() -> Drawn {
    const SIDE: f64 = 150.0;
    const TEXEL: f64 = 15.0;
    let rows = [
        ("as printed", Signs::PRINTED),
        ("the sine with its sign, B = +2(...)", Signs { b: false, ..Signs::RIGHT }),
        ("put right", Signs::RIGHT),
    ];
    let mut drawing = Drawing::new(676, 580);
    for (row, (words, signs)) in rows.into_iter().enumerate() {
        let top = 30.0 + 184.0 * row as f64;
        drawing.text(DVec2::new(10.0, top - 10.0), 15.0, Anchor::Start, words, INK);
        for (index, (name, columns)) in LEANING.into_iter().enumerate() {
            let left = 10.0 + 168.0 * index as f64;
            let middle = DVec2::new(left + SIDE / 2.0, top + SIDE / 2.0);
            let place = |p: DVec2| middle + p * TEXEL;
            lattice(&mut drawing, 5, place);
            drawing.stroke(ellipse(columns, 1.0, place), 1.8, INK);
            let found = half_axes(columns, signs);
            samples(&mut drawing, columns, found, place);
            if row == 2 {
                let at = DVec2::new(left, 570.0);
                drawing.text(at, 14.0, Anchor::Start, name, INK);
            }
        }
    }
    finish(drawing)
}

/// Eight dots along the longer of the axes found, blue if they lie on the true one and red if not.
fn samples(
    drawing: &mut Drawing,
    columns: Columns,
    found: [DVec2; 2],
    place: impl Fn(DVec2) -> DVec2,
) {
    let (axis, truth) = (longer(found), axes(columns)[0]);
    let off = (axis - truth).length().min((axis + truth).length());
    let color: Straight = if off < 1e-9 { BLUE } else { RED };
    drawing.line([place(-axis), place(axis)], 1.4, color);
    let shorter = if axis == found[0] { found[1] } else { found[0] };
    drawing.line([place(-shorter), place(shorter)], 1.4, color);
    for k in 0..8 {
        let at = axis * ((f64::from(k) + 0.5) / 4.0 - 1.0);
        drawing.dot(place(at), 4.0, color);
    }
}
