//! What texels weigh, rightly and as printed.

use super::footprints::JACOBIANS;
use crate::gallery::Drawn;
use crate::gallery::ellipses::{Columns, ellipse};
use crate::gallery::ink::{finish, heat_map};
use crate::math::exp;
use scumble_geometry::{DVec2, Homography};
use scumble_pixel::{Image, unorm8};
use scumble_sheet::{Anchor, Cell, Drawing, INK, contact_sheet};

/// A Δu² + 2B ΔuΔv + C Δv².
#[derive(Clone, Copy)]
struct Quadratic {
    a: f64,
    b: f64,
    c: f64,
}

impl Quadratic {
    /// The inverse of J·Jᵀ/4, a pixel of σ = ½, plus 1/6 along either axis for the reconstruction.
    fn right([x, y]: Columns) -> Self {
        let uu = (x.x * x.x + y.x * y.x) / 4.0 + 1.0 / 6.0;
        let uv = (x.x * x.y + y.x * y.y) / 4.0;
        let vv = (x.y * x.y + y.y * y.y) / 4.0 + 1.0 / 6.0;
        let det = uu * vv - uv * uv;
        Self { a: vv / det, b: -uv / det, c: uu / det }
    }

    /// As printed: with u_x and v_x in A, u_y and v_y in C.
    fn printed([x, y]: Columns) -> Self {
        Self { a: x.x * x.x + x.y * x.y, b: x.x * y.x + x.y * y.y, c: y.x * y.x + y.y * y.y }
    }

    fn weight(self, u: f64, v: f64) -> f64 {
        exp(-0.5 * (self.a * u * u + 2.0 * self.b * u * v + self.c * v * v))
    }
}

pub(super) fn heat() -> Drawn {
    const REACH: i32 = 10;
    const TEXEL: usize = 15;
    let columns = JACOBIANS[1].1;
    let side = (2 * REACH + 1) as usize;
    let mut drawing = Drawing::new(700, 370);
    let ways = [
        ("the covariance", Quadratic::right(columns)),
        ("as printed", Quadratic::printed(columns)),
    ];
    for (index, (name, quadratic)) in ways.into_iter().enumerate() {
        let left = 12 + 340 * index as u32;
        let offset = |texel: usize| texel as f64 - f64::from(REACH);
        let weight = |x, y| quadratic.weight(offset(x), offset(y));
        let picture = heat_map(side, TEXEL, weight)?;
        drawing.picture(picture, left, 12, 1);
        let half = (side * TEXEL) as f64 / 2.0;
        let middle = DVec2::new(f64::from(left) + half, 12.0 + half);
        for r in [0.5, 1.0] {
            let outline = ellipse(columns, r, |p| middle + p * TEXEL as f64);
            drawing.stroke(outline, 1.4, INK);
        }
        let at = DVec2::new(f64::from(left), 12.0 + 2.0 * half + 22.0);
        drawing.text(at, 14.0, Anchor::Start, name, INK);
    }
    finish(drawing)
}

const WIDTH: usize = 280;
const HEIGHT: usize = 200;

/// Squares of 8 texels.
fn texel(u: f64, v: f64) -> f64 {
    if (((u / 8.0).floor() + (v / 8.0).floor()) as i64).rem_euclid(2) == 0 { 0.92 } else { 0.15 }
}

/// From pixels to texels: a plane whose horizon lies above the picture.
fn plane() -> Homography {
    Homography::new([[200.0, 0.0, -22_000.0], [30.0, 0.0, 12_000.0], [0.0, 1.0, 40.0]])
}

/// The columns of the Jacobian at a pixel, by small differences.
fn columns(map: &Homography, at: DVec2) -> Option<(DVec2, Columns)> {
    const STEP: f64 = 1e-4;
    let here = map.project(at)?;
    let right = map.project(at + DVec2::new(STEP, 0.0))?;
    let down = map.project(at + DVec2::new(0.0, STEP))?;
    Some((here, [(right - here) / STEP, (down - here) / STEP]))
}

fn bilinear(p: DVec2) -> f64 {
    let (u, v) = (p.x - 0.5, p.y - 0.5);
    let (i, j) = (u.floor(), v.floor());
    let (s, t) = (u - i, v - j);
    let row = |j: f64| texel(i, j) * (1.0 - s) + texel(i + 1.0, j) * s;
    row(j) * (1.0 - t) + row(j + 1.0) * t
}

fn average(p: DVec2, quadratic: Quadratic, reach: DVec2) -> f64 {
    let (mut sum, mut weights) = (0.0, 0.0);
    let (low, high) = (p - reach, p + reach);
    let mut j = low.y.floor();
    while j <= high.y {
        let mut i = low.x.floor();
        while i <= high.x {
            let w = quadratic.weight(i + 0.5 - p.x, j + 0.5 - p.y);
            sum += w * texel(i, j);
            weights += w;
            i += 1.0;
        }
        j += 1.0;
    }
    if weights > 0.0 { sum / weights } else { bilinear(p) }
}

/// One pixel by one of the three ways.
fn shade(way: usize, at: DVec2, map: &Homography) -> f64 {
    let Some((p, columns)) = columns(map, at) else { return 1.0 };
    let [x, y] = columns;
    // Three standard deviations of the right filter along u and v, for either.
    let reach = |a: f64, b: f64| 3.0 * ((a * a + b * b) / 4.0 + 1.0 / 6.0).sqrt();
    let reach = DVec2::new(reach(x.x, y.x), reach(x.y, y.y));
    match way {
        0 => bilinear(p),
        1 => average(p, Quadratic::printed(columns), reach),
        _ => average(p, Quadratic::right(columns), reach),
    }
}

pub(super) fn printed() -> Drawn {
    let map = plane();
    let mut cells = Vec::new();
    for (way, name) in
        ["bilinear", "weights as printed", "weights put right"].into_iter().enumerate()
    {
        let picture = Image::from_fn(WIDTH, HEIGHT, |x, y| {
            let value = shade(way, DVec2::new(x as f64 + 0.5, y as f64 + 0.5), &map);
            let code = unorm8(value as f32);
            [code, code, code, 255]
        })?;
        cells.push(Cell::new(picture, [name]));
    }
    finish(contact_sheet(&cells, 3, 1))
}

#[cfg(test)]
mod tests;
