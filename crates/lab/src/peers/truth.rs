//! Brute force at some places of a map.

use super::PeersError;
use crate::quality::{QualityError, SIZE, Source, warps};
use scumble::texture::Footprint;
use scumble::texture::reference::{PixelShape, Reference};
use scumble_geometry::{DVec2, Homography};
use scumble_pixel::Image;

/// A pixel that sees so many texels along its footprint's longer axis is far away.
const FAR: f64 = 16.0;

/// Points along each axis of a pixel that is enlarged: it sees a fifth of a texel, and four pixels
/// of its filter hold 128 of them.
const POINTS: usize = 32;

/// What a pixel is a mean of, and over what.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Pixel {
    /// A Gaussian of σ = ½ over bilinear reconstruction.
    Gaussian,
    /// The pixel's square, over the same.
    Square,
    /// The Gaussian over Catmull and Rom's reconstruction, for what is enlarged.
    Cubic,
}

/// What the right picture holds at some places.
pub(super) struct Truth {
    places: Vec<DVec2>,
    colors: Vec<[f64; 3]>,
    far: Vec<bool>,
}

/// Decibels: everywhere, and at the far places, if there are any.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Psnr {
    pub(super) all: f64,
    pub(super) far: Option<f64>,
}

impl Truth {
    /// What a kind of pixel sees of an image under a map, at one place in every square of `cell` pixels
    /// a side.
    pub(super) fn new(
        source: &Source,
        map: &Homography,
        pixel: Pixel,
        cell: usize,
    ) -> Result<Self, PeersError> {
        let places = warps::places(map, cell);
        let colors = if pixel == Pixel::Cubic {
            let image = source.image();
            in_parallel(&places, |at| enlarged(&image, map, at))
        } else {
            let texture = source.texture().map_err(QualityError::from)?;
            let shape = match pixel {
                Pixel::Square => PixelShape::Box,
                _ => PixelShape::Gaussian { sigma: 0.5 },
            };
            let brute = Reference::new(&texture, shape).with_density(2.5, 16);
            in_parallel(&places, |at| {
                let [r, g, b, _] = brute.sample(map, at);
                [r, g, b].map(|v| 255.0 * v)
            })
        };
        let is_far = |p: &DVec2| Footprint::at(map, *p).jacobian.axes().major >= FAR;
        let far = places.iter().map(is_far).collect();
        Ok(Self { places, colors, far })
    }

    /// Decibels of a picture of red, green and blue of 255, row after row.
    pub(super) fn psnr(&self, pixels: &[f32]) -> Psnr {
        let error = |(place, color): (&DVec2, &[f64; 3])| {
            let first = 3 * (place.y as usize * warps::WIDTH + place.x as usize);
            let found = pixels.get(first..first + 3).unwrap_or(&[0.0; 3]);
            color.iter().zip(found).map(|(c, f)| (c - f64::from(*f)).powi(2)).sum::<f64>()
        };
        let errors: Vec<f64> = self.places.iter().zip(&self.colors).map(error).collect();
        let far: Vec<f64> =
            errors.iter().zip(&self.far).filter(|(_, far)| **far).map(|(e, _)| *e).collect();
        Psnr { all: decibels(&errors), far: (!far.is_empty()).then(|| decibels(&far)) }
    }
}

/// Of the sums of three squares.
fn decibels(errors: &[f64]) -> f64 {
    let mean = errors.iter().sum::<f64>() / (3 * errors.len()) as f64;
    10.0 * (255.0 * 255.0 / mean).log10()
}

fn in_parallel(places: &[DVec2], f: impl Fn(DVec2) -> [f64; 3] + Sync) -> Vec<[f64; 3]> {
    let mut colors = vec![[0.0; 3]; places.len()];
    let share = places.len().div_ceil(std::thread::available_parallelism().map_or(1, usize::from));
    std::thread::scope(|scope| {
        for (places, colors) in places.chunks(share.max(1)).zip(colors.chunks_mut(share.max(1))) {
            let f = &f;
            scope.spawn(move || {
                for (place, color) in places.iter().zip(colors) {
                    *color = f(*place);
                }
            });
        }
    });
    colors
}

fn enlarged(image: &Image<[u8; 4]>, map: &Homography, at: DVec2) -> [f64; 3] {
    let count = 4 * POINTS;
    let offset = |i: usize| ((i as f64 + 0.5) / count as f64 - 0.5) * 4.0;
    let weight = |x: f64| (-2.0 * x * x).exp();
    let (mut sum, mut total) = ([0.0; 3], 0.0);
    for (j, i) in (0..count).flat_map(|j| (0..count).map(move |i| (j, i))) {
        let (x, y) = (offset(i), offset(j));
        let Some(p) = map.project(at + DVec2::new(x, y)) else { continue };
        let (w, color) = (weight(x) * weight(y), catmull_rom(image, p));
        total += w;
        for (sum, c) in sum.iter_mut().zip(color) {
            *sum += w * c;
        }
    }
    sum.map(|v| v / total)
}

/// The image between its texels.
fn catmull_rom(image: &Image<[u8; 4]>, p: DVec2) -> [f64; 3] {
    let (u, v) = (p.x - 0.5, p.y - 0.5);
    let (x, y) = (u.floor(), v.floor());
    let (across, down) = (taps(u - x), taps(v - y));
    let mut sum = [0.0; 3];
    for (j, wy) in down.iter().enumerate() {
        for (i, wx) in across.iter().enumerate() {
            let index = |first: f64, k: usize| {
                (first + k as f64 - 1.0).clamp(0.0, (SIZE - 1) as f64) as usize
            };
            let Some(texel) = image.get(index(x, i), index(y, j)) else { continue };
            for (sum, t) in sum.iter_mut().zip(texel) {
                *sum += wx * wy * f64::from(*t);
            }
        }
    }
    sum
}

/// The weights of the four texels around, `t` from the second to the third.
fn taps(t: f64) -> [f64; 4] {
    [
        0.5 * t * (t * (2.0 - t) - 1.0),
        0.5 * (t * t * (3.0 * t - 5.0) + 2.0),
        0.5 * t * (t * (4.0 - 3.0 * t) + 1.0),
        0.5 * t * t * (t - 1.0),
    ]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_cubic_passes_through_its_texels_and_keeps_parabolas() {
        assert_eq!(taps(0.0), [0.0, 1.0, 0.0, 0.0]);
        for t in [0.1, 0.5, 0.8] {
            let w = taps(t);
            assert!((w.iter().sum::<f64>() - 1.0).abs() < 1e-12);
            let square: f64 = w.iter().zip([1.0, 0.0, 1.0, 4.0]).map(|(w, s)| w * s).sum();
            assert!((square - t * t).abs() < 1e-12);
        }
    }
}
