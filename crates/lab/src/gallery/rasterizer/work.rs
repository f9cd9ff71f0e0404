//! What a triangle's pixels cost to find.

use crate::gallery::Drawn;
use crate::gallery::ink::{GREEN, LIGHT, RED, YELLOW, finish};
use scumble::coverage::{Cover, IntRect, SampleMask, SamplePattern, Scratch, Shape, Sink};
use scumble_geometry::{DVec2, Path, Rect};
use scumble_pixel::Straight;
use scumble_sheet::{Anchor, Drawing, INK};

const COLUMNS: i32 = 96;
const ROWS: i32 = 72;
/// Pixels of the drawing to one of the grid.
const SIDE: f64 = 3.0;

/// Which pixels are covered.
struct Covered(Vec<bool>);

impl Sink for Covered {
    fn run(&mut self, y: i32, x0: i32, x1: i32) {
        for x in x0..x1 {
            self.0[(y * COLUMNS + x) as usize] = true;
        }
    }

    fn pixel(&mut self, x: i32, y: i32, _: SampleMask) {
        self.run(y, x, x + 1);
    }
}

/// The triangle that is drawn.
const POINTS: [DVec2; 3] = [DVec2::new(3.9, 61.8), DVec2::new(51.6, 4.2), DVec2::new(92.1, 67.5)];

pub(super) fn looked_at() -> Drawn {
    let mut drawing = Drawing::new(920, 280);
    let Some(shape) = Shape::triangle(POINTS)? else { return finish(drawing) };
    let mut covered = Covered(vec![false; (COLUMNS * ROWS) as usize]);
    let clip = IntRect::new(0, 0, COLUMNS, ROWS);
    shape.rasterize(clip, &SamplePattern::grid(1)?, &mut Scratch::new(), &mut covered);
    let bounds = shape.bounds();
    for (panel, title) in ["bounding box", "scanlines", "blocks of 8x8"].into_iter().enumerate() {
        let at = DVec2::new(12.0 + 304.0 * panel as f64, 12.0);
        let mut tested = 0;
        for (x, y) in (0..ROWS).flat_map(|y| (0..COLUMNS).map(move |x| (x, y))) {
            let inside = covered.0[(y * COLUMNS + x) as usize];
            let block = IntRect::new(x & !7, y & !7, (x & !7) + 8, (y & !7) + 8);
            let cover = shape.covers(block);
            let is_tested = match panel {
                0 => (bounds.x0..bounds.x1).contains(&x) && (bounds.y0..bounds.y1).contains(&y),
                1 => false,
                _ => cover == Cover::Partial,
            };
            tested += i32::from(is_tested);
            let color = match (inside, is_tested) {
                (true, _) if panel == 2 && cover == Cover::Full => GREEN,
                (true, _) => RED,
                (false, true) => YELLOW,
                (false, false) => Straight::WHITE,
            };
            let corner = at + DVec2::new(f64::from(x), f64::from(y)) * SIDE;
            drawing.rect(Rect::new(corner.x, corner.y, corner.x + SIDE, corner.y + SIDE), color);
        }
        grid(&mut drawing, at);
        let outline = POINTS.map(|q| at + q * SIDE);
        drawing.stroke(Path::polyline(outline, true), 1.5, INK);
        let words = if panel == 1 {
            format!("{title}: 2 crossings a row")
        } else {
            format!("{title}: {tested} pixels tested")
        };
        let below = at + DVec2::new(0.0, f64::from(ROWS) * SIDE + 20.0);
        drawing.text(below, 14.0, Anchor::Start, &words, INK);
    }
    let count = covered.0.iter().filter(|c| **c).count();
    let line = format!("{count} pixels are covered");
    drawing.text(DVec2::new(12.0, 268.0), 14.0, Anchor::Start, &line, INK);
    finish(drawing)
}

/// A line at every eighth pixel.
fn grid(drawing: &mut Drawing, at: DVec2) {
    let far = at + DVec2::new(f64::from(COLUMNS), f64::from(ROWS)) * SIDE;
    for x in (0..=COLUMNS).step_by(8) {
        let x = at.x + f64::from(x) * SIDE;
        drawing.line([DVec2::new(x, at.y), DVec2::new(x, far.y)], 1.0, LIGHT);
    }
    for y in (0..=ROWS).step_by(8) {
        let y = at.y + f64::from(y) * SIDE;
        drawing.line([DVec2::new(at.x, y), DVec2::new(far.x, y)], 1.0, LIGHT);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::gallery::errata::says;

    /// Counts pixels and samples.
    #[derive(Default)]
    struct Count {
        pixels: usize,
        samples: u32,
    }

    impl Sink for Count {
        fn run(&mut self, _: i32, x0: i32, x1: i32) {
            self.pixels += (x1 - x0) as usize;
            self.samples += 16 * (x1 - x0) as u32;
        }

        fn pixel(&mut self, _: i32, _: i32, mask: SampleMask) {
            self.pixels += 1;
            self.samples += mask.0.count_ones();
        }
    }

    #[test]
    fn supersampling_shades_sixteen_times_as_often() {
        let shape = Shape::triangle(POINTS).unwrap().unwrap();
        let mut count = Count::default();
        let pattern = SamplePattern::grid(16).unwrap();
        shape.rasterize(
            IntRect::new(0, 0, COLUMNS, ROWS),
            &pattern,
            &mut Scratch::new(),
            &mut count,
        );
        let Count { pixels, samples } = count;
        says(&format!("{samples} times by supersampling, {pixels} times by multisampling"));
    }
}
