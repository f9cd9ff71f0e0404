//! The mean over the pixel's square: what "area averaging" means under any map.
//!
//! The square becomes a parallelogram in the texture. The mean of the bilinear surface over it is a mean of
//! texels, each weighted by how much of its tent lies inside ([`shape`]). The level is one in which the
//! parallelogram is a few texels wide at its narrowest, so the number of texels is bounded as that in an
//! ellipse is. Here in scalar code; `lanes` is the same sixteen abreast.

pub(crate) mod lanes;
mod shape;

use crate::covariance::{minor_squared, products, single};
use crate::ewa::{Limits, auto_pick};
use crate::level::Level;
use crate::lod::{self, Pick};
use crate::magnify::patch::Spotted;
use crate::point::lerp;
use crate::texel::ROUNDER;
use crate::walk::{LANES, Row, mean};
use crate::{Footprint, LevelMode, Sampler, Texture, Wrap};
use scumble_geometry::Matrix2;
use shape::{COARSE, FINE, Rule, Shape};

/// What the square of a parallelogram's width is multiplied by to choose a level as for an ellipse's least
/// variance: it is at least 4.2 texels wide for the default's σ of 0.6. What pyramids do to a square is not
/// what a square does, and goes down with the fourth power of that.
const VARIANCE: f32 = 1.0 / 48.0;

/// The filter, made ready for many samples.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Square {
    limits: Limits,
    mode: LevelMode,
}

impl Square {
    pub(crate) fn new(s: &Sampler) -> Self {
        Self { limits: Limits::new(s), mode: s.level }
    }

    /// The colour of one footprint, its centre brought near and its Jacobian bounded.
    #[inline(always)]
    pub(crate) fn sample(&self, t: &Texture, f: &Footprint) -> [f32; 4] {
        let Pick { level, coarser } = self.pick(t, f);
        let within = |index: usize| {
            let level = &t.levels[index];
            average(level, t.wrap, &Spotted::new(level, f.u, f.v, &f.jacobian))
        };
        let fine = within(level);
        if coarser > 0.0 { lerp(fine, within(level + 1), coarser) } else { fine }
    }

    /// Texels that [`Square::sample`] reads.
    pub(crate) fn cost(&self, t: &Texture, f: &Footprint) -> usize {
        let Pick { level, coarser } = self.pick(t, f);
        let within = |index: usize| {
            let level = &t.levels[index];
            let shape = Shape::new(&Spotted::new(level, f.u, f.v, &f.jacobian).spot);
            let quads = |y| shape.row(&COARSE, y as f32).quads.max(0.0) as usize;
            (shape.low[1] as i32..=shape.high[1] as i32).map(quads).sum::<usize>() * LANES
        };
        within(level) + if coarser > 0.0 { within(level + 1) } else { 0 }
    }

    /// The level in which the square is wide enough.
    #[inline(always)]
    fn pick(&self, t: &Texture, f: &Footprint) -> Pick {
        if self.mode != LevelMode::Auto {
            return lod::pick(f, self.mode, t.range());
        }
        level_of(&f.jacobian, &self.limits, t.range())
    }
}

/// The level in which the square under a Jacobian is wide enough, of those from the first to the last.
#[inline(always)]
pub(crate) fn level_of(j: &Matrix2, limits: &Limits, range: [usize; 2]) -> Pick {
    let determinant = j.determinant() as f32;
    let minor = minor_squared(products(single(j)), determinant, limits.inverse_ratio);
    auto_pick(minor * VARIANCE * limits.inverse_least, range, limits.blend)
}

/// The colour at a spot of a level: the definition.
#[inline(always)]
fn average(level: &Level, wrap: Wrap, at: &Spotted) -> [f32; 4] {
    let shape = Shape::new(&at.spot);
    if shape.flat > 0.0 {
        weigh(level, wrap, at, &shape, &FINE)
    } else {
        weigh(level, wrap, at, &shape, &COARSE)
    }
}

/// The mean of the texels by their weights, rounded to whole numbers, so that sums are exact.
#[inline(always)]
fn weigh<const K: usize>(
    level: &Level,
    wrap: Wrap,
    at: &Spotted,
    shape: &Shape<f32>,
    rule: &Rule<K>,
) -> [f32; 4] {
    if level.is_float() {
        return weigh_floats(level, wrap, at, shape, rule);
    }
    let (mut sums, mut total) = ([0i64; 4], 0);
    for_each_quad(at, shape, rule, |[x, y], weights| {
        for (texel, weight) in Row::new(y, level, wrap).run(x).iter().zip(weights) {
            let weight = (weight + ROUNDER).to_bits() as i32 - ROUNDER.to_bits() as i32;
            total += weight;
            for (sum, t) in sums.iter_mut().zip(texel) {
                *sum += i64::from(weight) * i64::from(*t);
            }
        }
    });
    if total <= 0 {
        return nearest(level, wrap, at);
    }
    mean(sums.map(|sum| sum as f64), 1.0 / f64::from(total))
}

/// The same of floats, about the nearest texel, so that a constant stays what it is.
fn weigh_floats<const K: usize>(
    level: &Level,
    wrap: Wrap,
    at: &Spotted,
    shape: &Shape<f32>,
    rule: &Rule<K>,
) -> [f32; 4] {
    let about = nearest(level, wrap, at);
    let (mut sums, mut total) = ([0.0; 4], 0.0);
    for_each_quad(at, shape, rule, |[x, y], weights| {
        for (i, weight) in (0..).zip(weights.map(f64::from)) {
            let texel = level.texel(x.wrapping_add(i), y, wrap);
            total += weight;
            for c in 0..4 {
                sums[c] += weight * f64::from(texel[c] - about[c]);
            }
        }
    });
    if total <= 0.0 {
        return about;
    }
    core::array::from_fn(|c| (f64::from(about[c]) + sums[c] / total) as f32)
}

/// Calls `f` with the place of the first of [`LANES`] texels of a row and with their weights, until there
/// are no more.
#[inline(always)]
fn for_each_quad<const K: usize>(
    at: &Spotted,
    shape: &Shape<f32>,
    rule: &Rule<K>,
    mut f: impl FnMut([i32; 2], [f32; LANES]),
) {
    let [x0, y0] = at.base;
    for y in shape.low[1] as i32..=shape.high[1] as i32 {
        let row = shape.row(rule, y as f32);
        for quad in 0..row.quads as i32 {
            let column = row.first + (LANES as i32 * quad) as f32;
            f([x0.wrapping_add(column as i32), y0.wrapping_add(y)], row.weights(column));
        }
    }
}

/// The texel nearest to a spot.
#[inline(always)]
fn nearest(level: &Level, wrap: Wrap, at: &Spotted) -> [f32; 4] {
    let [x, y] = [at.spot.x, at.spot.y].map(|rest| i32::from(rest >= 0.5));
    level.texel(at.base[0].wrapping_add(x), at.base[1].wrapping_add(y), wrap)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::ewa::BUDGET;
    use crate::reference::{PixelShape, Reference};
    use crate::{Kernel, TextureOptions, Wrap};
    use scumble_geometry::{DVec2, Homography};
    use scumble_pixel::Image;

    fn texture(wrap: Wrap) -> Texture {
        let image = Image::from_fn(96, 80, |x, y| {
            let v = (x * 7919 + y * 104_729) % 251;
            [v as u8, (v * x % 256) as u8, (255 - v) as u8, 255]
        });
        let options = TextureOptions { wrap, ..TextureOptions::default() };
        Texture::new(image.unwrap().view(), &options).unwrap()
    }

    #[test]
    fn it_is_the_integral_over_the_square() {
        let s = Sampler { kernel: Kernel::Box, ..Sampler::DEFAULT };
        for wrap in [Wrap::Repeat, Wrap::Clamp] {
            let t = texture(wrap);
            let truth = Reference::new(&t, PixelShape::Box).with_density(4.0, 16);
            for i in 0..40 {
                let at = |k: f64| (f64::from(i) * k) % 1.0;
                let size = [0.4, 1.0, 4.0, 6.0][i as usize % 4];
                let j = Matrix2::new(at(0.37), 0.6 * at(0.71), -0.7 * at(0.59), 0.2 + at(0.13));
                let map = Homography::new([
                    [j.a * size, j.b * size, 96.0 * at(0.618)],
                    [j.c * size, j.d * size, 80.0 * at(0.414)],
                    [0.0, 0.0, 1.0],
                ]);
                let f = Footprint::at(&map, DVec2::ZERO);
                let (found, truth) = (t.sample(&f, &s).0, truth.sample(&map, DVec2::ZERO));
                for (a, b) in found.iter().zip(truth) {
                    assert!((f64::from(*a) - b).abs() < 0.006, "{f:?}: {found:?} {truth:?}");
                }
            }
        }
    }

    #[test]
    fn work_is_bounded_and_a_constant_stays() {
        let image = Image::from_fn(33, 21, |_, _| [200, 100, 50, 255]).unwrap();
        let t = Texture::new(image.view(), &TextureOptions::default()).unwrap();
        let square = Square::new(&Sampler::DEFAULT);
        for size in [0.0, 1e-9, 1.0, 37.0, 1e9] {
            let jacobian = Matrix2::new(size, 0.3, 0.1, 0.01 * size);
            let f = Footprint { u: 12.3, v: -4.0, jacobian };
            assert!(square.cost(&t, &f) as f64 <= 2.0 * BUDGET, "{size}");
            let color = square.sample(&t, &f);
            let [r, g, b] = [200.0, 100.0, 50.0].map(|v: f32| v / 255.0);
            for (found, expected) in color.iter().zip([r, g, b, 1.0]) {
                assert!((found - expected).abs() < 1e-6, "{size}: {color:?}");
            }
        }
    }
}
