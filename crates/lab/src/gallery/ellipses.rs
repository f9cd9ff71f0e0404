//! Jacobians and the ellipses that they make of a pixel.

use crate::svg::polar;
use scumble_geometry::{DVec2, Matrix2, Path};
use scumble_pixel::Straight;
use scumble_sheet::Drawing;

/// A Jacobian by its columns: the steps to the right and down.
pub(super) type Columns = [DVec2; 2];

/// The matrix of these columns.
pub(super) const fn matrix([a, b]: Columns) -> Matrix2 {
    Matrix2::new(a.x, b.x, a.y, b.y)
}

/// The half-axes of the image of the unit circle, the longer first.
pub(super) fn axes(columns: Columns) -> [DVec2; 2] {
    let axes = matrix(columns).axes();
    let [x, y] = axes.direction;
    [DVec2::new(x, y) * axes.major, DVec2::new(-y, x) * axes.minor]
}

/// The image of a circle of radius `r` about the origin.
pub(super) fn ellipse([a, b]: Columns, r: f64, place: impl Fn(DVec2) -> DVec2) -> Path {
    let point = |k: u32| {
        let (x, y) = polar(0.0, 0.0, r, f64::from(k) / 96.0);
        place(a * x + b * y)
    };
    Path::polyline((0..96).map(point), true)
}

/// An arrow with an open head.
pub(super) fn arrow(drawing: &mut Drawing, from: DVec2, to: DVec2, color: Straight) {
    let way = to - from;
    let back = way * (9.0 / way.length().max(1e-9));
    let side = DVec2::new(-back.y, back.x) * 0.45;
    drawing.line([from, to], 2.2, color);
    drawing.line([to - back + side, to, to - back - side], 2.2, color);
}
