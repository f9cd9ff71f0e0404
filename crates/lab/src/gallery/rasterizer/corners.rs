//! A corner within a row, and the weights of three corners.

use crate::gallery::ink::{BLUE, GREEN, GREY, LIGHT, RED, finish};
use crate::gallery::{Drawn, GalleryError};
use scumble::coverage::{IntRect, SampleMask, SamplePattern, Scratch, Shape, Sink};
use scumble_geometry::{DVec2, Path};
use scumble_pixel::Straight;
use scumble_sheet::{Anchor, Drawing, INK};

const COLUMNS: i32 = 11;

/// Which samples of one row of pixels are covered.
struct Row([u64; COLUMNS as usize]);

impl Sink for Row {
    fn run(&mut self, _: i32, x0: i32, x1: i32) {
        for x in x0..x1 {
            self.0[x as usize] = u64::MAX;
        }
    }

    fn pixel(&mut self, x: i32, _: i32, mask: SampleMask) {
        self.0[x as usize] = mask.0;
    }
}

/// It is nothing wide where its row begins and ends.
const WEDGE: [DVec2; 3] = [DVec2::new(0.0, 0.0), DVec2::new(10.0, 0.5), DVec2::new(0.0, 1.0)];

/// Its samples.
fn covered(pattern: &SamplePattern) -> Result<Row, GalleryError> {
    let mut row = Row([0; COLUMNS as usize]);
    if let Some(shape) = Shape::triangle(WEDGE)? {
        let clip = IntRect::new(0, 0, COLUMNS, 1);
        shape.rasterize(clip, pattern, &mut Scratch::new(), &mut row);
    }
    Ok(row)
}

pub(super) fn wedge() -> Drawn {
    const SIDE: f64 = 78.0;
    let pattern = SamplePattern::grid(16)?;
    let row = covered(&pattern)?;
    let mut drawing = Drawing::new(900, 120);
    let place = |p: DVec2| DVec2::new(20.0, 20.0) + p * SIDE;
    for x in 0..=COLUMNS {
        let x = f64::from(x);
        drawing.line([place(DVec2::new(x, 0.0)), place(DVec2::new(x, 1.0))], 1.0, LIGHT);
    }
    for y in [0.0, 1.0] {
        let ends = [DVec2::new(0.0, y), DVec2::new(f64::from(COLUMNS), y)];
        drawing.line(ends.map(place), 1.0, LIGHT);
    }
    for (x, mask) in row.0.iter().enumerate() {
        for (bit, &[ox, oy]) in pattern.offsets().iter().enumerate() {
            let at = DVec2::new(x as f64 + f64::from(ox) / 256.0, f64::from(oy) / 256.0);
            let covered = mask >> bit & 1 == 1;
            drawing.dot(place(at), 3.0, if covered { RED } else { GREY });
        }
    }
    drawing.stroke(Path::polyline(WEDGE.map(place), true), 1.6, INK);
    for y in [0.0, 1.0] {
        drawing.dot(place(DVec2::new(0.0, y)), 5.5, GREEN);
    }
    finish(drawing)
}

/// Twice the area of a triangle, signed.
fn twice_area(a: DVec2, b: DVec2, c: DVec2) -> f64 {
    (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x)
}

/// The point of the line through `a` and `b` that is nearest to `p`.
fn foot(p: DVec2, a: DVec2, b: DVec2) -> DVec2 {
    let way = b - a;
    a + way * ((p - a).dot(way) / way.dot(way))
}

pub(super) fn weights() -> Drawn {
    let corners = [DVec2::new(70.0, 250.0), DVec2::new(190.0, 40.0), DVec2::new(400.0, 216.0)];
    let [a, b, c] = corners;
    let p = DVec2::new(184.0, 180.0);
    let whole = twice_area(a, b, c);
    let alpha = twice_area(p, b, c) / whole;
    let parts = [alpha, twice_area(a, p, c) / whole, twice_area(a, b, p) / whole];
    let mut drawing = Drawing::new(900, 330);
    for shift in [0.0, 450.0] {
        let by = |q: DVec2| q + DVec2::new(shift, 0.0);
        if shift > 0.0 {
            for (index, color) in [RED, GREEN, BLUE].into_iter().enumerate() {
                let others = [corners[(index + 1) % 3], corners[(index + 2) % 3], p].map(by);
                let Straight([r, g, b, _]) = color;
                drawing.fill(Path::polyline(others, true), Straight([r, g, b, 0.55]));
            }
        } else {
            for (q, color) in [(a, GREY), (p, RED)] {
                drawing.dashed([by(q), by(foot(q, b, c))], 2.0, 6.0, color);
            }
            drawing.line([by(b), by(c)], 3.5, BLUE);
        }
        drawing.stroke(Path::polyline(corners.map(by), true), 1.6, INK);
        drawing.dot(by(p), 4.5, INK);
        for (q, name, shift) in [
            (a, "A", (-16.0, 6.0)),
            (b, "B", (-4.0, -10.0)),
            (c, "C", (10.0, 6.0)),
            (p, "P", (-16.0, -6.0)),
        ] {
            let at = by(q) + DVec2::new(shift.0, shift.1);
            drawing.text(at, 16.0, Anchor::Start, name, INK);
        }
    }
    let heights = [(p, "P"), (a, "A")].map(|(q, _)| (q - foot(q, b, c)).length());
    let words = format!(
        "from BC: P {:.0}, A {:.0}; alpha = {:.2}",
        heights[0],
        heights[1],
        heights[0] / heights[1]
    );
    drawing.text(DVec2::new(20.0, 310.0), 15.0, Anchor::Start, &words, INK);
    let words = format!(
        "alpha {:.2} (red) + beta {:.2} (green) + gamma {:.2} (blue) = 1",
        parts[0], parts[1], parts[2]
    );
    drawing.text(DVec2::new(450.0, 310.0), 15.0, Anchor::Start, &words, INK);
    finish(drawing)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::gallery::errata::says;

    #[test]
    fn the_wedge_is_missed_from_its_borders() {
        let pattern = SamplePattern::grid(16).unwrap();
        let full = pattern.full_mask().0;
        let row = covered(&pattern).unwrap().0;
        let found: u32 = row.iter().map(|mask| (mask & full).count_ones()).sum();
        // Along both borders only x = 0 is inside.
        let [a, b, c] = WEDGE;
        assert_eq!((a.x, c.x, b.x), (0.0, 0.0, 10.0));
        says(&format!("{found} samples of 16 a pixel"));
    }

    #[test]
    fn both_ways_to_weigh_agree() {
        let [a, b, c] = [DVec2::new(1.0, 9.0), DVec2::new(4.0, 1.0), DVec2::new(9.0, 7.0)];
        let p = DVec2::new(4.5, 5.0);
        let by_area = twice_area(p, b, c) / twice_area(a, b, c);
        let by_height = (p - foot(p, b, c)).length() / (a - foot(a, b, c)).length();
        assert!((by_area - by_height).abs() < 1e-12, "{by_area} {by_height}");
    }
}
