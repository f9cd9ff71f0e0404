//! Brute force in `f64`: what the fast filters are measured against.
//!
//! The texture is level 0 with bilinear reconstruction between texel centres; the pixel is a box
//! or a Gaussian on the screen; the integral of their product is taken over a grid of points that
//! is dense in both. No pyramid, no ellipse, no approximation of the map. Slow: a pixel that sees a
//! thousand texels takes some hundred thousand points.

use crate::Texture;
use crate::math::{exp, floor, sqrt};
use scumble_geometry::{DVec2, Homography};

/// The filter of a pixel on the screen.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum PixelShape {
    /// The mean over the pixel's square.
    Box,
    /// A Gaussian of the given standard deviation in pixels, cut at four of them. The elliptical
    /// filter's pixel has σ = ½.
    Gaussian {
        /// Standard deviation, in pixels.
        sigma: f64,
    },
}

/// A brute-force filter over a texture.
#[derive(Debug, Clone, Copy)]
pub struct Reference<'a> {
    texture: &'a Texture,
    shape: PixelShape,
    density: f64,
    least: usize,
}

/// Points along each axis of the screen that a pixel's support gets at most.
const MOST_POINTS: f64 = 4096.0;

impl<'a> Reference<'a> {
    /// A filter with 2.5 points per texel and at least 32 per pixel along each axis of the screen,
    /// which converges to 94 dB and more.
    #[must_use]
    pub const fn new(texture: &'a Texture, shape: PixelShape) -> Self {
        Self { texture, shape, density: 2.5, least: 32 }
    }

    /// With other densities: points per texel, and the least number per pixel, along each axis.
    #[must_use]
    pub const fn with_density(self, per_texel: f64, per_pixel: usize) -> Self {
        Self { density: per_texel, least: per_pixel, ..self }
    }

    /// The colour of the pixel whose centre is at `at`, under a homography from the screen to
    /// texels of level 0. Points behind the eye count for nothing.
    #[must_use]
    pub fn sample(&self, map: &Homography, at: DVec2) -> [f64; 4] {
        self.sample_with(|p| map.project(p), at)
    }

    /// The same under any map; where it gives `None` there is nothing.
    #[must_use]
    pub fn sample_with(&self, map: impl Fn(DVec2) -> Option<DVec2>, at: DVec2) -> [f64; 4] {
        let half = match self.shape {
            PixelShape::Box => 0.5,
            PixelShape::Gaussian { sigma } => 4.0 * sigma,
        };
        let columns = self.points(&map, at, half, DVec2::new(1.0, 0.0));
        let rows = self.points(&map, at, half, DVec2::new(0.0, 1.0));
        let mut sum = [0.0; 4];
        let mut total = 0.0;
        for j in 0..rows {
            let y = ((j as f64 + 0.5) / rows as f64 * 2.0 - 1.0) * half;
            for i in 0..columns {
                let x = ((i as f64 + 0.5) / columns as f64 * 2.0 - 1.0) * half;
                let Some(p) = map(at + DVec2::new(x, y)) else { continue };
                let Some(texel) = bilinear(self.texture, p) else { continue };
                let weight = self.weight(x) * self.weight(y);
                total += weight;
                for c in 0..4 {
                    sum[c] += weight * texel[c];
                }
            }
        }
        if total > 0.0 { sum.map(|v| v / total) } else { [0.0; 4] }
    }

    fn weight(&self, x: f64) -> f64 {
        match self.shape {
            PixelShape::Box => 1.0,
            PixelShape::Gaussian { sigma } => exp(-0.5 * x * x / (sigma * sigma)),
        }
    }

    /// Points along one axis of the screen, from the largest stretch at nine places of the support.
    fn points(
        &self,
        map: impl Fn(DVec2) -> Option<DVec2>,
        at: DVec2,
        half: f64,
        axis: DVec2,
    ) -> usize {
        let step = 1e-3;
        let mut stretch = 0.0f64;
        for k in 0..9 {
            let offset = DVec2::new(f64::from(k % 3 - 1), f64::from(k / 3 - 1)) * half;
            let p = at + offset;
            if let (Some(a), Some(b)) = (map(p - axis * step), map(p + axis * step)) {
                let d = (b - a) / (2.0 * step);
                stretch = stretch.max(sqrt(d.x * d.x + d.y * d.y));
            }
        }
        let wanted = 2.0 * half * (stretch * self.density).max(self.least as f64);
        wanted.clamp(1.0, MOST_POINTS) as usize
    }
}

/// What the brute force integrates: the first level that is kept, interpolated bilinearly, at a position
/// in texels of the image. `None` where that is not finite.
#[must_use]
pub fn surface(texture: &Texture, p: DVec2) -> Option<[f64; 4]> {
    bilinear(texture, p)
}

/// Level 0 at a position in its texels.
fn bilinear(texture: &Texture, p: DVec2) -> Option<[f64; 4]> {
    let level = &texture.levels[0];
    let wrap = texture.wrap;
    if !p.is_finite() {
        return None;
    }
    let ([x, y], [su, sv]) = (texture.nearer, level.frame.scale);
    let (x, y) = (x.bring(p.x) * su - 0.5, y.bring(p.y) * sv - 0.5);
    let (x0, y0) = (floor(x), floor(y));
    let (fx, fy) = (x - x0, y - y0);
    let texel = |i, j| level.texel(x0 as i32 + i, y0 as i32 + j, wrap).map(f64::from);
    let (a, b, c, d) = (texel(0, 0), texel(1, 0), texel(0, 1), texel(1, 1));
    Some(core::array::from_fn(|k| {
        let (top, bottom) = (a[k] + (b[k] - a[k]) * fx, c[k] + (d[k] - c[k]) * fx);
        top + (bottom - top) * fy
    }))
}
