//! Enhanced EWA as it was published, for comparison and for teaching.
//!
//! After Rutanen, "Enhanced EWA filtering" (2009), which builds on Heckbert and Greene (1986):
//!
//! 1. The unit circle of the pixel becomes the ellipse xᵀ(JJᵀ + I)⁻¹x = 1; the identity is the
//!    reconstruction between texels, which the paper asks for and leaves open; Heckbert's is taken.
//! 2. If its axis ratio is above the clamp, 30, the minor axis is widened.
//! 3. Two neighbouring levels are read, everywhere, and blended by the fraction of
//!    log₂(minor axis): in the coarser one the minor axis has at least x texels per unit of the
//!    kernel's radius, so the work grows with that, as it should.
//! 4. In each level the texels of the ellipse's bounding box are visited, r² of each found by forward
//!    differences: two additions a texel.
//! 5. Weights of a kernel for minification and one for magnification are blended, seamlessly.
//!
//! Where this departs: the half-widths of the box are R√(S⁻¹)ᵢᵢ, the root over the whole (the paper's
//! example takes it of the numerator only); forward differences are in `f64`, because in `f32` r² is off
//! by hundredths at the end of a long ellipse; the pyramid is this crate's; and an ellipse that would
//! not fit a box of [`MOST`] texels is shrunk.
//!
//! What it costs beside the other filter: two levels everywhere, boxes that are mostly empty for slanted
//! ellipses, and a blur by the pyramid that is not subtracted.

use crate::level::Level;
use crate::lod::{self, Pick};
use crate::magnify::nearness;
use crate::math::{ceil, floor, log2, sqrt};
use crate::mixture::{Mixture, Sums};
use crate::point::lerp;
use crate::{Footprint, LevelMode, Sampler, Texture, Wrap};
use scumble_geometry::Matrix2;

/// Texels of the largest box.
const MOST: f64 = 65_536.0;

/// The method, made ready for many samples.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Classic {
    sampler: Sampler,
    /// 1/a².
    inverse_ratio: f64,
    /// 1/x².
    inverse_least: f64,
}

/// A covariance-like matrix of the unit circle's image, in texels of level 0.
#[derive(Debug, Clone, Copy)]
struct Shape {
    uu: f64,
    uv: f64,
    vv: f64,
    /// The square of its minor axis.
    minor: f64,
}

impl Classic {
    pub(crate) fn new(s: &Sampler) -> Self {
        // In this order a NaN becomes the lower bound.
        let within = |x: f32, low: f64, high: f64| f64::from(x).max(low).min(high);
        let ratio = within(s.max_eccentricity, 1.0, 1024.0);
        // A σ is half the unit.
        let least = 2.0 * within(s.least_sigma, 0.4, 4.0);
        Self {
            sampler: *s,
            inverse_ratio: 1.0 / (ratio * ratio),
            inverse_least: 1.0 / (least * least),
        }
    }

    /// The colour of one footprint, its centre brought near and its Jacobian bounded.
    pub(crate) fn sample(&self, t: &Texture, f: &Footprint) -> [f32; 4] {
        let weights = Mixture::new(&self.sampler, nearness(f.major_squared() as f32));
        let over = |level: &Level, walk: &Walk| walk.average(level, t.wrap, &weights);
        self.over_levels(t, f, weights.radius(), over, lerp)
    }

    /// Texels that [`Classic::sample`] reads.
    pub(crate) fn cost(&self, t: &Texture, f: &Footprint) -> usize {
        let weights = Mixture::new(&self.sampler, nearness(f.major_squared() as f32));
        self.over_levels(t, f, weights.radius(), |_, walk| walk.texels(), |a, b, _| a + b)
    }

    fn over_levels<R>(
        &self,
        t: &Texture,
        f: &Footprint,
        radius: f64,
        each: impl Fn(&Level, &Walk) -> R,
        join: impl FnOnce(R, R, f32) -> R,
    ) -> R {
        let shape = self.shape(&f.jacobian);
        let Pick { level, coarser } = self.pick(f, &shape, t.range());
        let within = |index: usize| {
            let level = &t.levels[index];
            each(level, &Walk::new(f, &shape, level.frame.scale, radius))
        };
        let fine = within(level);
        if coarser > 0.0 { join(fine, within(level + 1), coarser) } else { fine }
    }

    /// JJᵀ + I, its axis ratio clamped.
    fn shape(&self, j: &Matrix2) -> Shape {
        let axes = j.axes();
        let (major, minor) = (axes.major * axes.major + 1.0, axes.minor * axes.minor + 1.0);
        let minor = minor.max(major * self.inverse_ratio);
        let [x, y] = axes.direction;
        Shape {
            uu: major * x * x + minor * y * y,
            uv: (major - minor) * x * y,
            vv: major * y * y + minor * x * x,
            minor,
        }
    }

    /// The two levels: in the coarser one the minor axis has x to 2x texels.
    fn pick(&self, f: &Footprint, shape: &Shape, [first, last]: [usize; 2]) -> Pick {
        if self.sampler.level != LevelMode::Auto {
            return lod::pick(f, self.sampler.level, [first, last]);
        }
        let detail = (0.5 * log2(shape.minor * self.inverse_least) - 1.0).max(first as f64);
        let level = (detail as usize).min(last);
        let coarser = if level < last { (detail - level as f64) as f32 } else { 0.0 };
        Pick { level: level - first, coarser }
    }
}

/// A bounding box in the index space of a level, and the quadratic in it.
#[derive(Debug, Clone, Copy)]
struct Walk {
    centre: [f64; 2],
    /// First column and row, last column and row.
    first: [i32; 2],
    last: [i32; 2],
    /// r² = a·dx² + 2b·dx·dy + d·dy².
    a: f64,
    b: f64,
    d: f64,
}

impl Walk {
    fn new(f: &Footprint, shape: &Shape, [su, sv]: [f64; 2], radius: f64) -> Self {
        let (mut uu, mut uv, mut vv) = (shape.uu * su * su, shape.uv * su * sv, shape.vv * sv * sv);
        let side = |variance: f64| 2.0 * radius * sqrt(variance) + 1.0;
        let area = side(uu) * side(vv);
        if area > MOST {
            // One side may be all of it, so both give way by the whole.
            let k = (MOST / area) * (MOST / area);
            (uu, uv, vv) = (uu * k, uv * k, vv * k);
        }
        // A level that is much smaller along one axis only may flatten the ellipse.
        let det = (uu * vv - uv * uv).max(1e-3 * uu.max(vv));
        let (u, v) = (f.u * su - 0.5, f.v * sv - 0.5);
        let (width, height) = (radius * sqrt(uu), radius * sqrt(vv));
        Self {
            centre: [u, v],
            first: [ceil(u - width) as i32, ceil(v - height) as i32],
            last: [floor(u + width) as i32, floor(v + height) as i32],
            a: vv / det,
            b: -uv / det,
            d: uu / det,
        }
    }

    /// Calls `visit` with the column, row and r² of every texel of the box: §7 of the paper.
    fn each(&self, mut visit: impl FnMut(i32, i32, f64)) {
        let Self { first: [x0, y0], last: [x1, y1], a, b, d, .. } = *self;
        let (dx, dy) = (f64::from(x0) - self.centre[0], f64::from(y0) - self.centre[1]);
        // At the first texel of a row: the value, and what a step along x or y adds to it.
        let mut row = a * dx * dx + 2.0 * b * dx * dy + d * dy * dy;
        let mut row_step_x = 2.0 * a * dx + 2.0 * b * dy + a;
        let mut row_step_y = 2.0 * b * dx + 2.0 * d * dy + d;
        for y in y0..=y1 {
            let (mut value, mut step) = (row, row_step_x);
            for x in x0..=x1 {
                visit(x, y, value);
                value += step;
                step += 2.0 * a;
            }
            row += row_step_y;
            row_step_x += 2.0 * b;
            row_step_y += 2.0 * d;
        }
    }

    fn average(&self, level: &Level, wrap: Wrap, weights: &Mixture) -> [f32; 4] {
        let [u, v] = self.centre;
        let texel = |x, y| level.texel(x, y, wrap);
        let mut sums = Sums::new(texel(floor(u + 0.5) as i32, floor(v + 0.5) as i32));
        self.each(|x, y, r2| {
            let weight = weights.weight(r2 as f32);
            if weight != 0.0 {
                sums.add(weight, texel(x, y));
            }
        });
        sums.finish()
    }

    fn texels(&self) -> usize {
        let side = |i: usize| usize::try_from(self.last[i] - self.first[i] + 1).unwrap_or(0);
        side(0) * side(1)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Kernel, Magnify, TextureOptions};
    use scumble_pixel::Image;

    fn texture() -> Texture {
        let image = Image::from_fn(96, 80, |x, y| {
            let v = ((x * 7919 + y * 104_729) % 256) as u8;
            [v, v / 2, 255 - v, 255]
        });
        let options = TextureOptions { wrap: Wrap::Repeat, ..TextureOptions::default() };
        Texture::new(image.unwrap().view(), &options).unwrap()
    }

    /// The definition, level by level, from the inverse matrix and a wide box.
    fn direct(t: &Texture, f: &Footprint, s: &Sampler) -> [f64; 4] {
        let axes = f.jacobian.axes();
        let (m, n) = (axes.major * axes.major + 1.0, axes.minor * axes.minor + 1.0);
        let n = n.max(m / f64::from(s.max_eccentricity).powi(2));
        let detail = (n.sqrt() / (2.0 * f64::from(s.least_sigma))).log2() - 1.0;
        let detail = detail.clamp(0.0, t.levels.len() as f64 - 1.0);
        let weights = Mixture::new(s, nearness(f.major_squared() as f32));
        let in_level = |index: usize| -> [f64; 4] {
            let level = &t.levels[index];
            let [su, sv] = level.frame.scale;
            let (u, v) = (f.u * su - 0.5, f.v * sv - 0.5);
            let reach = (m.sqrt() * weights.radius() * su.max(sv)).ceil() as i32 + 1;
            let (mut sum, mut total) = ([0.0; 4], 0.0);
            for y in v as i32 - reach..=v as i32 + reach {
                for x in u as i32 - reach..=u as i32 + reach {
                    let (dx, dy) = ((f64::from(x) - u) / su, (f64::from(y) - v) / sv);
                    let [cx, cy] = axes.direction;
                    let (along, across) = (dx * cx + dy * cy, dy * cx - dx * cy);
                    let r2 = along * along / m + across * across / n;
                    let w = f64::from(weights.weight(r2 as f32));
                    total += w;
                    let texel = level.texel(x, y, t.wrap);
                    (0..4).for_each(|c| sum[c] += w * f64::from(texel[c]));
                }
            }
            sum.map(|v| v / total)
        };
        let fine = in_level(detail as usize);
        if detail.fract() == 0.0 {
            return fine;
        }
        let coarse = in_level(detail as usize + 1);
        core::array::from_fn(|c| fine[c] + (coarse[c] - fine[c]) * detail.fract())
    }

    #[test]
    fn forward_differences_agree_with_a_direct_evaluation() {
        let t = texture();
        let enhanced = Sampler::CLASSIC;
        let original = Sampler { kernel: Kernel::Gaussian, magnify: Magnify::None, ..enhanced };
        for s in [enhanced, original, Sampler { kernel: Kernel::Lanczos3, ..enhanced }] {
            for i in 0..120 {
                let at = |k: f64| (f64::from(i) * k) % 1.0;
                let size = if i % 3 == 0 { 1.0 } else { 12.0 };
                let j = Matrix2::new(at(0.37), 0.6 * at(0.71), 0.7 * at(0.59), 0.3 * at(0.13));
                let jacobian = Matrix2::new(j.a * size, j.b * size, j.c * size, j.d * size);
                let f = Footprint { u: 96.0 * at(0.618), v: 80.0 * at(0.414), jacobian };
                let (found, truth) = (Classic::new(&s).sample(&t, &f), direct(&t, &f, &s));
                for (a, b) in found.iter().zip(truth) {
                    assert!((f64::from(*a) - b).abs() < 2e-5, "{s:?} {f:?}: {found:?} {truth:?}");
                }
            }
        }
    }

    #[test]
    fn forward_differences_hold_to_the_end_of_a_long_ellipse() {
        // 128×2, slanted.
        let s = Sampler { max_eccentricity: 64.0, ..Sampler::CLASSIC };
        let jacobian = Matrix2::new(104.0, -1.0, 74.0, 1.5);
        let shape = Classic::new(&s).shape(&jacobian);
        let walk = Walk::new(&Footprint { u: 0.3, v: 0.8, jacobian }, &shape, [1.0; 2], 1.0);
        assert!(walk.texels() > 20_000);
        let mut worst = 0.0f64;
        walk.each(|x, y, r2| {
            let (dx, dy) = (f64::from(x) - walk.centre[0], f64::from(y) - walk.centre[1]);
            let direct = walk.a * dx * dx + 2.0 * walk.b * dx * dy + walk.d * dy * dy;
            worst = worst.max((r2 - direct).abs());
        });
        assert!(worst < 1e-9, "{worst:e}");
    }
}
