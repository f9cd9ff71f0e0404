//! An endless grid on the ground.

use crate::gallery::Drawn;
use crate::gallery::ink::{finish, grey, plane};
use scumble::pixel::Premul;
use scumble::texture::procedural::{Antialias, Grid};
use scumble::texture::{Footprint, Probes};
use scumble_geometry::{DVec2, Homography, Matrix2};
use scumble_pixel::Image;
use scumble_sheet::{Cell, contact_sheet};

const WIDTH: usize = 292;
const HEIGHT: usize = 176;
const HORIZON: f64 = 9.5;
/// Points along each side of a pixel of the last picture.
const POINTS: u32 = 24;

/// From the screen to the ground, which is turned by the angle of (0.8, 0.6).
fn ground() -> Homography {
    let (scale, depth, middle) = (8.5, 170.0, 0.4 * WIDTH as f64);
    let (u, v) = ([scale, 0.0, -scale * middle], [0.0, 0.0, scale * depth]);
    let row = |a: f64, b: f64| std::array::from_fn(|i| a * u[i] + b * v[i]);
    Homography::new([row(0.8, -0.6), row(0.6, 0.8), [0.0, 1.0, -HORIZON]])
}

fn lines(antialias: Antialias) -> Grid {
    Grid { period: 2.0, width: 0.1, antialias, ..Grid::default() }
}

/// The alpha by one width of a pixel for both families: the longer half-axis.
fn isotropic(f: &Footprint) -> f64 {
    let major = f.jacobian.axes().major;
    lines(Antialias::Gradient)
        .coverage(&Footprint { jacobian: Matrix2::new(major, 0.0, 0.0, major), ..*f })
}

/// The page's method: that alpha at so many places along the long axis.
fn probed(f: &Footprint, most: u32) -> f64 {
    let alpha = |spot: &Footprint| Premul([isotropic(spot) as f32; 4]);
    f64::from(Probes::new(most).sample(f, &alpha).0[0])
}

/// The mean over points of the pixel itself, on or off a line.
fn true_mean(map: &Homography, corner: DVec2) -> f64 {
    let grid = lines(Antialias::None);
    let at = |k: u32| (f64::from(k) + 0.5) / f64::from(POINTS);
    let on = |i: u32, j: u32| {
        let p = map.project(corner + DVec2::new(at(i), at(j)));
        p.is_some_and(|p| grid.distance(p.x, p.y) < 0.0)
    };
    let count = (0..POINTS * POINTS).filter(|k| on(k % POINTS, k / POINTS)).count();
    count as f64 / f64::from(POINTS * POINTS)
}

/// One way to find how much of a pixel is covered.
type Way = fn(&Footprint) -> f64;

pub(super) fn nine() -> Drawn {
    let map = ground();
    let picture = |alpha: &dyn Fn(DVec2) -> f64| {
        plane(WIDTH, HEIGHT, |x, y| {
            let below = y > HORIZON;
            0.95 - 0.85 * if below { alpha(DVec2::new(x, y)) } else { 0.0 }
        })
    };
    let truth = picture(&|corner| true_mean(&map, corner))?;
    let ways: [(&str, Way); 8] = [
        ("none", |f| lines(Antialias::None).coverage(f)),
        ("isotropic", isotropic),
        ("clamped", |f| lines(Antialias::Gradient).coverage(f)),
        ("2 probes", |f| probed(f, 2)),
        ("4 probes", |f| probed(f, 4)),
        ("8 probes", |f| probed(f, 8)),
        ("16 probes", |f| probed(f, 16)),
        ("integral", |f| lines(Antialias::Integral).coverage(f)),
    ];
    let mut cells = Vec::new();
    for (name, way) in ways {
        let middle = DVec2::new(0.5, 0.5);
        let made = picture(&|corner| way(&Footprint::at(&map, corner + middle)))?;
        let words = format!("{name}: error {:.1}", 255.0 * rms(&made, &truth));
        cells.push(Cell::new(grey(&made), [words]));
    }
    cells.push(Cell::new(grey(&truth), ["576 points a pixel"]));
    finish(contact_sheet(&cells, 3, 1))
}

fn rms(a: &Image<f64>, b: &Image<f64>) -> f64 {
    let squares = a.pixels().iter().zip(b.pixels()).map(|(a, b)| (a - b) * (a - b));
    (squares.sum::<f64>() / a.pixels().len() as f64).sqrt()
}
