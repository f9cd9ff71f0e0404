//! What pixels of one picture see of a plane.

use crate::gallery::Drawn;
use crate::gallery::ink::{BLUE, GREEN, GREY, LIGHT, RED, YELLOW, finish};
use scumble_geometry::{DVec2, Homography, Path};
use scumble_pixel::Straight;
use scumble_sheet::{Anchor, Drawing, INK};

const COLUMNS: i32 = 24;
const ROWS: i32 = 12;

/// From the screen, in pixels, to the plane, whose horizon lies two pixels above the screen.
fn map() -> Homography {
    Homography::new([[1.0, 0.0, -12.0], [0.0, 0.0, 12.0], [0.0, 1.0, 2.0]])
}

/// The corners of a pixel.
fn corners(x: i32, y: i32) -> [DVec2; 4] {
    let at = |dx: i32, dy: i32| DVec2::new(f64::from(x + dx), f64::from(y + dy));
    [at(0, 0), at(1, 0), at(1, 1), at(0, 1)]
}

const MARKED: [(i32, i32, Straight); 4] =
    [(4, 0, RED), (13, 1, BLUE), (19, 3, GREEN), (8, 9, YELLOW)];

pub(super) fn pixels() -> Drawn {
    let map = map();
    let mut drawing = Drawing::new(900, 260);
    let on_screen = |p: DVec2| DVec2::new(12.0, 12.0) + p * 17.0;
    // From above, the eye below.
    let on_plane = |p: DVec2| DVec2::new(670.0 + p.x * 36.0, 232.0 - p.y * 36.0);
    let seen = |p: DVec2| map.project(p).map_or(on_plane(DVec2::ZERO), on_plane);
    for (x, y) in (0..ROWS).flat_map(|y| (0..COLUMNS).map(move |x| (x, y))) {
        let pixel = corners(x, y);
        drawing.stroke(Path::polyline(pixel.map(on_screen), true), 1.0, LIGHT);
        drawing.stroke(Path::polyline(pixel.map(seen), true), 0.7, LIGHT);
    }
    for (x, y, color) in MARKED {
        let pixel = corners(x, y);
        drawing.fill(Path::polyline(pixel.map(on_screen), true), color);
        drawing.fill(Path::polyline(pixel.map(seen), true), color);
        drawing.stroke(Path::polyline(pixel.map(seen), true), 1.2, GREY);
    }
    for (x, words) in [(12.0, "the screen"), (454.0, "the plane from above")] {
        drawing.text(DVec2::new(x, 250.0), 14.0, Anchor::Start, words, INK);
    }
    finish(drawing)
}
