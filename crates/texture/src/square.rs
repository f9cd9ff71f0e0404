//! The mean over the pixel's square: what "area averaging" means under any map.
//!
//! The square becomes a parallelogram in the texture, and the mean of the bilinear surface over it is
//! that of a grid of places, [`DENSITY`] to a texel along each side. The level is one in which the
//! parallelogram is a few texels wide at its narrowest, so the number of places is bounded as that of
//! texels in an ellipse is.

use crate::ewa::{BUDGET, Limits, auto_pick};
use crate::level::Level;
use crate::lod::{self, Pick};
use crate::math::{ceil, floor, floor32, sqrt};
use crate::point::lerp;
use crate::texel::STEP;
use crate::{Footprint, LevelMode, Sampler, Texture, place, point};

/// Places to a texel, along each side.
const DENSITY: f64 = 2.5;

/// The fewest along a side: a pixel that is smaller than a texel has the creases between four of them.
const LEAST: f64 = 4.0;

/// The most in all, which read as many texels as an ellipse may.
const MOST: f64 = BUDGET / 4.0;

/// The variance of a square of side 1.
const VARIANCE: f64 = 1.0 / 12.0;

/// The filter, made ready for many samples.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Square {
    limits: Limits,
    mode: LevelMode,
}

/// The places in one level: from the middle, in texels from its centre of texel (0, 0), `count` steps along
/// each side.
#[derive(Debug, Clone, Copy)]
struct Grid {
    middle: [f64; 2],
    sides: [[f64; 2]; 2],
    count: [u32; 2],
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
            Grid::new(level, f).mean(t, level)
        };
        let fine = within(level);
        if coarser > 0.0 { lerp(fine, within(level + 1), coarser) } else { fine }
    }

    /// Texels that [`Square::sample`] reads.
    pub(crate) fn cost(&self, t: &Texture, f: &Footprint) -> usize {
        let Pick { level, coarser } = self.pick(t, f);
        let within = |index: usize| {
            let [across, down] = Grid::new(&t.levels[index], f).count;
            4 * across as usize * down as usize
        };
        within(level) + if coarser > 0.0 { within(level + 1) } else { 0 }
    }

    /// The level in which the square has the width of an ellipse that the sampler would read there.
    #[inline(always)]
    fn pick(&self, t: &Texture, f: &Footprint) -> Pick {
        if self.mode != LevelMode::Auto {
            return lod::pick(f, self.mode, t.range());
        }
        let axes = f.jacobian.axes();
        let (major, minor) = (axes.major * axes.major, axes.minor * axes.minor);
        let minor = minor.max(major * f64::from(self.limits.inverse_ratio)) * VARIANCE;
        auto_pick(minor as f32 * self.limits.inverse_least, t.range(), self.limits.blend)
    }
}

impl Grid {
    #[inline(always)]
    fn new(level: &Level, f: &Footprint) -> Self {
        let ([su, sv], j) = (level.frame.scale, &f.jacobian);
        let sides = [[j.a * su, j.c * sv], [j.b * su, j.d * sv]];
        let wanted = sides.map(|[u, v]| ceil(DENSITY * sqrt(u * u + v * v)).max(LEAST));
        // Where no coarser level takes it: fewer places, which alias.
        let share = sqrt((MOST / (wanted[0] * wanted[1])).min(1.0));
        let count = wanted.map(|n| ((n * share).min(MOST) as u32).max(1));
        Self { middle: [f.u * su - 0.5, f.v * sv - 0.5], sides, count }
    }

    /// The mean of the bilinear surface, about the middle, so that a constant stays what it is.
    #[inline(always)]
    fn mean(&self, t: &Texture, level: &Level) -> [f32; 4] {
        let [u, v] = self.middle;
        let [x0, y0] = [u, v].map(floor);
        let rest = [(u - x0) as f32, (v - y0) as f32];
        if !level.is_float() && self.inside(level, [x0, y0]) {
            let first = level.index(x0 as i32, y0 as i32);
            return self.about(rest, |[u, v]| in_place(level, first, u, v)).map(|v| v * STEP);
        }
        self.about(rest, |[u, v]| {
            let (u, v) = (f64::from(u) + x0 + 0.5, f64::from(v) + y0 + 0.5);
            place::bilinear(level, t.wrap, u, v)
        })
    }

    /// The mean of a surface, whose places are given from the texel in the middle.
    #[inline(always)]
    fn about(&self, middle: [f32; 2], surface: impl Fn([f32; 2]) -> [f32; 4]) -> [f32; 4] {
        let about = surface(middle);
        let sum = self.sum(middle, about, surface);
        let [across, down] = self.count;
        let share = 1.0 / (across as f32 * down as f32);
        core::array::from_fn(|c| about[c] + sum[c] * share)
    }

    /// Whether all that is read about the texel in the middle is kept, or in the apron.
    #[inline(always)]
    fn inside(&self, level: &Level, [x0, y0]: [f64; 2]) -> bool {
        let [[au, av], [bu, bv]] = self.sides;
        let reach =
            [au.abs() + bu.abs(), av.abs() + bv.abs()].map(|r| (0.5 * r).min(1e9) as i32 + 2);
        let (x, y) = (x0 as i32, y0 as i32);
        level.holds([x - reach[0], y - reach[1]], [x + reach[0] + 1, y + reach[1] + 1])
    }

    /// Σ (surface − about) over the places, given from the texel in the middle.
    #[inline(always)]
    fn sum(
        &self,
        middle: [f32; 2],
        about: [f32; 4],
        surface: impl Fn([f32; 2]) -> [f32; 4],
    ) -> [f32; 4] {
        let [across, down] = self.count;
        let [a, b] = self.sides.map(|side| side.map(|v| v as f32));
        let place = |i: u32, n: u32| (i as f32 + 0.5) / n as f32 - 0.5;
        let mut sum = [0.0; 4];
        for j in 0..down {
            let y = place(j, down);
            let start = [middle[0] + y * b[0], middle[1] + y * b[1]];
            let mut row = [0.0; 4];
            for i in 0..across {
                let x = place(i, across);
                let color = surface([start[0] + x * a[0], start[1] + x * a[1]]);
                for c in 0..4 {
                    row[c] += color[c] - about[c];
                }
            }
            for c in 0..4 {
                sum[c] += row[c];
            }
        }
        sum
    }
}

/// The bilinear surface, in steps, (u, v) from the centre of the texel whose index is `first`.
#[inline(always)]
fn in_place(level: &Level, first: usize, u: f32, v: f32) -> [f32; 4] {
    let (x, y) = (floor32(u), floor32(v));
    let (fx, fy) = (u - x, v - y);
    let offset = (y as isize).wrapping_mul(level.stride as isize).wrapping_add(x as isize);
    let top = first.wrapping_add(offset as usize);
    // Every index is in range; and if it were not, the texels would be black, and no panic.
    let pair = |i: usize| {
        let rest = level.texels.get(i..).unwrap_or_default();
        rest.first_chunk().unwrap_or(&[[0; 4]; 2])
    };
    point::bilinear(pair(top), pair(top.wrapping_add(level.stride)), fx, fy)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::reference::{PixelShape, Reference};
    use crate::{Kernel, TextureOptions, Wrap};
    use scumble_geometry::{DVec2, Homography, Matrix2};
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
        let s = Sampler { kernel: Kernel::Box, ..Sampler::HIGH };
        for wrap in [Wrap::Repeat, Wrap::Clamp] {
            let t = texture(wrap);
            let truth = Reference::new(&t, PixelShape::Box).with_density(4.0, 16);
            for i in 0..40 {
                let at = |k: f64| (f64::from(i) * k) % 1.0;
                let size = if i % 2 == 0 { 0.4 } else { 5.0 };
                let j = Matrix2::new(at(0.37), 0.6 * at(0.71), -0.7 * at(0.59), 0.2 + at(0.13));
                let map = Homography::new([
                    [j.a * size, j.b * size, 96.0 * at(0.618)],
                    [j.c * size, j.d * size, 80.0 * at(0.414)],
                    [0.0, 0.0, 1.0],
                ]);
                let f = Footprint::at(&map, DVec2::ZERO);
                let (found, truth) = (t.sample(&f, &s).0, truth.sample(&map, DVec2::ZERO));
                for (a, b) in found.iter().zip(truth) {
                    assert!((f64::from(*a) - b).abs() < 0.02, "{f:?}: {found:?} {truth:?}");
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
