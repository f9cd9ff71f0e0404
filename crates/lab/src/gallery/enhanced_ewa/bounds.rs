//! The box of an ellipse, and the texels within.

use crate::gallery::Drawn;
use crate::gallery::ellipses::{Columns, axes, ellipse};
use crate::gallery::ink::{GREY, LIGHT, PURPLE, RED, YELLOW, finish};
use scumble_geometry::{DVec2, Path, Rect};
use scumble_pixel::Straight;
use scumble_sheet::{Anchor, Drawing, INK};

/// The matrix S of an ellipse xᵀSx = 1: a, b and d of the paper.
#[derive(Debug, Clone, Copy)]
struct Form {
    a: f64,
    b: f64,
    d: f64,
}

impl Form {
    /// That of the unit circle's image: S = (JJᵀ)⁻¹.
    fn new([x, y]: Columns) -> Self {
        let (uu, uv, vv) = (x.x * x.x + y.x * y.x, x.x * x.y + y.x * y.y, x.y * x.y + y.y * y.y);
        let det = uu * vv - uv * uv;
        Self { a: vv / det, b: -uv / det, d: uu / det }
    }

    fn at(self, p: DVec2) -> f64 {
        self.a * p.x * p.x + 2.0 * self.b * p.x * p.y + self.d * p.y * p.y
    }

    /// Half-widths of the box: the roots of S⁻¹'s entries.
    fn half_widths(self) -> DVec2 {
        let det = self.a * self.d - self.b * self.b;
        DVec2::new((self.d / det).sqrt(), (self.a / det).sqrt())
    }

    /// The same as §6.1 has them.
    fn printed_half_widths(self) -> DVec2 {
        let det = self.a * self.d - self.b * self.b;
        DVec2::new(self.d.sqrt() / det, self.a.sqrt() / det)
    }
}

fn frame(drawing: &mut Drawing, middle: DVec2, half: DVec2, color: Straight) {
    let corners = [-half, DVec2::new(half.x, -half.y), half, DVec2::new(-half.x, half.y)];
    drawing.stroke(Path::polyline(corners.map(|p| middle + p), true), 2.0, color);
}

pub(super) fn printed_box() -> Drawn {
    let shapes: [(&str, Columns); 3] = [
        ("the circle of radius 1/2", [DVec2::new(0.5, 0.0), DVec2::new(0.0, 0.5)]),
        (
            "an ellipse of the area of the unit circle",
            [DVec2::new(1.5, 0.6), DVec2::new(0.7, 0.947)],
        ),
        ("one twice as large", [DVec2::new(1.5, 0.6) * 1.414, DVec2::new(0.7, 0.947) * 1.414]),
    ];
    /// Pixels of the drawing to a texel.
    const TEXEL: f64 = 30.0;
    let mut drawing = Drawing::new(900, 300);
    for (index, (words, columns)) in shapes.into_iter().enumerate() {
        let middle = DVec2::new(152.0 + 298.0 * index as f64, 136.0);
        for k in -4..=4 {
            let at = f64::from(k) * TEXEL;
            let far = 4.0 * TEXEL;
            drawing.line([middle + DVec2::new(at, -far), middle + DVec2::new(at, far)], 1.0, LIGHT);
            drawing.line([middle + DVec2::new(-far, at), middle + DVec2::new(far, at)], 1.0, LIGHT);
        }
        let form = Form::new(columns);
        drawing.stroke(ellipse(columns, 1.0, |p| middle + p * TEXEL), 2.0, INK);
        frame(&mut drawing, middle, form.printed_half_widths() * TEXEL, PURPLE);
        frame(&mut drawing, middle, form.half_widths() * TEXEL, RED);
        let at = DVec2::new(middle.x - 4.0 * TEXEL, 286.0);
        drawing.text(at, 14.0, Anchor::Start, words, INK);
    }
    finish(drawing)
}

pub(super) fn walks() -> Drawn {
    const COLUMNS: i32 = 29;
    const ROWS: i32 = 19;
    const TEXEL: f64 = 15.0;
    let columns: Columns = [DVec2::new(11.2, 6.4), DVec2::new(-1.1, 1.9)];
    let form = Form::new(columns);
    let half = form.half_widths();
    let centre = DVec2::new(14.3, 9.6);
    let mut drawing = Drawing::new(908, 334);
    for (panel, title) in ["its bounding box", "its rows"].into_iter().enumerate() {
        let corner = DVec2::new(12.0 + 450.0 * panel as f64, 12.0);
        let place = |p: DVec2| corner + p * TEXEL;
        let (mut inside, mut visited) = (0, 0);
        for (x, y) in (0..ROWS).flat_map(|y| (0..COLUMNS).map(move |x| (x, y))) {
            let q = DVec2::new(f64::from(x) + 0.5, f64::from(y) + 0.5) - centre;
            let within = form.at(q) <= 1.0;
            let boxed = q.x.abs() <= half.x && q.y.abs() <= half.y;
            inside += u32::from(within);
            let seen = if panel == 0 { boxed } else { within };
            visited += u32::from(seen);
            let color = match (within, seen) {
                (true, _) => RED,
                (false, true) => YELLOW,
                (false, false) => Straight::WHITE,
            };
            let at = place(DVec2::new(f64::from(x), f64::from(y)));
            drawing.rect(Rect::new(at.x, at.y, at.x + TEXEL, at.y + TEXEL), color);
        }
        for k in 0..=COLUMNS {
            let at = f64::from(k);
            let ends = [DVec2::new(at, 0.0), DVec2::new(at, f64::from(ROWS))];
            drawing.line(ends.map(place), 1.0, LIGHT);
        }
        for k in 0..=ROWS {
            let at = f64::from(k);
            let ends = [DVec2::new(0.0, at), DVec2::new(f64::from(COLUMNS), at)];
            drawing.line(ends.map(place), 1.0, LIGHT);
        }
        drawing.stroke(ellipse(columns, 1.0, |p| place(centre + p)), 2.0, INK);
        if panel == 0 {
            frame(&mut drawing, place(centre), half * TEXEL, INK);
            let [long, short] = axes(columns);
            for axis in [long, short] {
                drawing.line([place(centre - axis), place(centre + axis)], 1.2, GREY);
            }
        }
        let words = format!("{title}: {visited} texels visited, {inside} in the ellipse");
        drawing.text(place(DVec2::new(0.0, 20.4)), 14.0, Anchor::Start, &words, INK);
    }
    finish(drawing)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::gallery::errata::says;
    use crate::svg::polar;

    #[test]
    fn the_box_is_tight_and_the_printed_one_is_not() {
        let columns: Columns = [DVec2::new(3.0, 1.0), DVec2::new(-0.4, 2.0)];
        let half = Form::new(columns).half_widths();
        let reach = (0..3600).map(|k| polar(0.0, 0.0, 1.0, f64::from(k) / 3600.0));
        let reach =
            reach.map(|(x, y)| columns[0] * x + columns[1] * y).fold(DVec2::ZERO, DVec2::max);
        assert!((half - reach).length() < 1e-4, "{half} {reach}");
        let circle = Form::new([DVec2::new(0.5, 0.0), DVec2::new(0.0, 0.5)]);
        assert_eq!(circle.half_widths(), DVec2::new(0.5, 0.5));
        assert_eq!(circle.printed_half_widths(), DVec2::new(0.125, 0.125));
        says("radius ½ (a = d = 4, b = 0) the printed form gives ⅛");
    }
}
