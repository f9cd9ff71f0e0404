//! The maps that filters are judged on: from a screen of 1280×720 to the texels of an image.

use super::sources::SIZE;
use crate::math::hash;
use scumble_geometry::{DVec2, GeometryError, Homography};
use std::f64::consts::FRAC_1_SQRT_2;

pub(crate) const WIDTH: usize = 1280;
pub(crate) const HEIGHT: usize = 720;

/// What the maps are.
pub(crate) const ABOUT: [&str; 3] = [
    "W1: a ground plane to its horizon",
    "W2: a keystone, three times down",
    "W3: a turn by 30°, four times down",
];

/// The maps, in the order of [`ABOUT`].
pub(crate) fn all() -> Result<[Homography; 3], GeometryError> {
    Ok([ground(), keystone()?, turned(4.0)])
}

/// A ground plane seen along the diagonal of the image, from less than a texel a pixel to an axis
/// ratio of 40.
fn ground() -> Homography {
    let (focal, eye, horizon, behind) = (1100.0, 70.0, -14.0, 60.0);
    let row = |sign: f64| {
        let middle = (WIDTH / 2) as f64;
        let row = [sign * eye, -behind, eye * focal - sign * eye * middle + behind * horizon];
        row.map(|v| v * FRAC_1_SQRT_2)
    };
    Homography::new([row(-1.0), row(1.0), [0.0, 1.0, -horizon]])
}

/// The map of [`with_enlargement`] that enlarges.
pub(crate) const ENLARGEMENT: usize = 3;

/// The maps of [`all`], and then one five times up, turned by −15°.
pub(crate) fn with_enlargement() -> Result<[Homography; 4], GeometryError> {
    let [ground, keystone, turned] = all()?;
    // The cosine and the sine of 15°, a fifth of each.
    let (c, s) = ((6.0f64.sqrt() + 2.0f64.sqrt()) / 20.0, (6.0f64.sqrt() - 2.0f64.sqrt()) / 20.0);
    let (x, y) = ((WIDTH / 2) as f64, (HEIGHT / 2) as f64);
    let row = |a: f64, b: f64, middle: f64| [a, b, middle - a * x - b * y];
    let enlarged = Homography::new([row(c, -s, 900.0), row(s, c, 820.0), [0.0, 0.0, 1.0]]);
    Ok([ground, keystone, turned, enlarged])
}

fn keystone() -> Result<Homography, GeometryError> {
    let n = SIZE as f64;
    let source = [(0.0, 0.0), (n, 0.0), (n, n), (0.0, n)];
    let screen = [(330.0, 60.0), (900.0, 20.0), (1180.0, 690.0), (240.0, 700.0)];
    let points = |p: [(f64, f64); 4]| p.map(|(x, y)| DVec2::new(x, y));
    Homography::from_points(points(screen), points(source))
}

/// A turn by 30° and so many times down, about the middles.
pub(crate) fn turned(scale: f64) -> Homography {
    let (s, c) = (0.5 * scale, 0.75f64.sqrt() * scale);
    let (x, y) = ((WIDTH / 2) as f64, (HEIGHT / 2) as f64);
    let row = |a: f64, b: f64| [a, b, SIZE as f64 / 2.0 - a * x - b * y];
    Homography::new([row(c, s), row(-s, c), [0.0, 0.0, 1.0]])
}

/// Pixels to compare at: one by chance in every square of `cell`×`cell` pixels, where everything
/// within 2½ pixels lies well inside the image.
pub(crate) fn places(map: &Homography, cell: usize) -> Vec<DVec2> {
    let inside = |p: DVec2| {
        let within = |q: DVec2| q.min_element() > 4.0 && q.max_element() < SIZE as f64 - 4.0;
        let reach = [-2.5, 0.0, 2.5];
        let corners = reach.iter().flat_map(|x| reach.map(|y| p + DVec2::new(*x, y)));
        corners.map(|p| map.project(p)).all(|q| q.is_some_and(within))
    };
    let cells = (0..HEIGHT / cell).flat_map(|j| (0..WIDTH / cell).map(move |i| (i, j)));
    let place = |(i, j): (usize, usize)| {
        let chance = |seed| hash(i as i64, j as i64, seed) as usize % cell;
        let (x, y) = (i * cell + chance(1), j * cell + chance(2));
        DVec2::new(x as f64 + 0.5, y as f64 + 0.5)
    };
    cells.map(place).filter(|p| inside(*p)).collect()
}
