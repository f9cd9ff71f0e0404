//! The listing's axes, as printed and put right.

use crate::gallery::Drawn;
use crate::gallery::ellipses::Columns;
use crate::gallery::ink::{finish, part, shown};
use crate::views::{self, HEIGHT, WIDTH};
use scumble::texture::{Footprint, LevelMode, PixelFilter, Sampler, Texture};
use scumble_geometry::{DVec2, Matrix2};
use scumble_pixel::Image;
use scumble_sheet::{Cell, contact_sheet};

/// Which of the listing's signs are as printed.
#[derive(Debug, Clone, Copy)]
pub(super) struct Signs {
    /// B = −2(…), and not +2(…).
    pub(super) b: bool,
    /// sin θ has the sign of B/t, and is not always positive.
    pub(super) sine: bool,
    /// sign(0) is 1, and not 0.
    pub(super) zero: bool,
}

impl Signs {
    pub(super) const PRINTED: Self = Self { b: false, sine: false, zero: false };
    pub(super) const RIGHT: Self = Self { b: true, sine: true, zero: true };
}

/// The half-axes of the unit circle's image, by the listing: the inverse of M′⁻¹ = ΛR.
pub(super) fn half_axes([x, y]: Columns, signs: Signs) -> [DVec2; 2] {
    let det = x.x * y.y - x.y * y.x;
    let f = det * det;
    let a = (x.y * x.y + y.y * y.y) / f;
    let b = if signs.b { -2.0 } else { 2.0 } * (x.x * x.y + y.x * y.y) / f;
    let c = (x.x * x.x + y.x * y.x) / f;
    let (p, q) = (a - c, a + c);
    let sign = |v: f64| if v == 0.0 { 0.0 } else { 1.0_f64.copysign(v) };
    let sign_of_p = if p == 0.0 && signs.zero { 1.0 } else { sign(p) };
    let t = sign_of_p * (p * p + b * b).sqrt();
    if t == 0.0 {
        let radius = 1.0 / a.sqrt();
        return [DVec2::new(radius, 0.0), DVec2::new(0.0, radius)];
    }
    let cosine = ((t + p) / (2.0 * t)).max(0.0).sqrt();
    let sine = ((t - p) / (2.0 * t)).max(0.0).sqrt();
    let sine = if signs.sine { sine * sign(b / t) } else { sine };
    let (first, second) = (((q + t) / 2.0).max(0.0).sqrt(), ((q - t) / 2.0).max(0.0).sqrt());
    [DVec2::new(cosine, sine) / first, DVec2::new(-sine, cosine) / second]
}

/// The longer of two.
pub(super) fn longer([a, b]: [DVec2; 2]) -> DVec2 {
    if b.length() > a.length() { b } else { a }
}

/// The mean of up to 16 trilinear samples along the axis that the listing finds.
fn along(texture: &Texture, f: &Footprint, signs: Signs) -> [f64; 3] {
    const TRILINEAR: Sampler = Sampler::DEFAULT.with(PixelFilter::Bilinear, LevelMode::Linear);
    let Matrix2 { a, b, c, d } = f.jacobian;
    let axes = half_axes([DVec2::new(a, c), DVec2::new(b, d)], signs);
    let axis = longer(axes);
    let shorter = axes[0].length().min(axes[1].length());
    let count = (axis.length() / shorter).min(16.0).ceil().max(1.0);
    let spot = axis.length() / count;
    let jacobian = Matrix2::new(spot, 0.0, 0.0, spot);
    let mut sum = [0.0; 3];
    for k in 0..count as u32 {
        let place = (f64::from(k) + 0.5) / count - 0.5;
        let at = Footprint { u: f.u + place * axis.x, v: f.v + place * axis.y, jacobian };
        let color = texture.sample(&at, &TRILINEAR).0;
        sum = std::array::from_fn(|i| sum[i] + f64::from(color[i]) / count);
    }
    sum
}

pub(super) fn on_a_plane() -> Drawn {
    let view = views::diagonal()?;
    let by = |signs| view.each(view.background, |t, f| along(t, f, signs));
    let (printed, right) = (by(Signs::PRINTED), by(Signs::RIGHT));
    let apart = |(a, b): (&[f64; 3], &[f64; 3])| -> [f64; 3] {
        std::array::from_fn(|i| 1.0 - 4.0 * (a[i] - b[i]).abs())
    };
    let difference: Vec<[f64; 3]> = printed.iter().zip(&right).map(apart).collect();
    let pictures = [
        (printed, "the axis as printed"),
        (right, "the right axis"),
        (difference, "the difference, white where there is none"),
    ];
    let mut cells = Vec::new();
    for (colors, words) in pictures {
        cells.push(Cell::new(far(&shown(&colors)?), [words]));
    }
    finish(contact_sheet(&cells, 1, 3))
}

/// What lies below the horizon.
fn far(picture: &Image<[u8; 4]>) -> Image<[u8; 4]> {
    const _: () = assert!(HEIGHT > 104);
    part(picture, [0, 20, WIDTH, 84])
}

#[cfg(test)]
mod tests;
