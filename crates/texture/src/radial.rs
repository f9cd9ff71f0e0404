//! The elliptical weighted average with any radial kernel, in scalar code.
//!
//! The fast path of this crate knows one kernel, the Gaussian, and takes it as a polynomial in
//! vectors; here is the general form, which reads like the definition:
//!
//! 1. The Jacobian's singular values are the axes of the ellipse that the unit circle of the pixel
//!    becomes. The kernel's [`Footing`] widens them by what the texels need.
//! 2. The minor axis chooses the level, as in the fast path.
//! 3. Row by row, over the texels of each that lie inside, Σ w(r²)·t / Σ w(r²), where r² is the
//!    squared distance from the centre in units of the ellipse.

use crate::covariance::Covariance;
use crate::engine::Engine;
use crate::ewa::{BUDGET, Limits, auto_pick};
use crate::kernel::{Footing, TOGETHER};
use crate::level::Level;
use crate::lod::{self, Pick};
use crate::magnify::{Magnify, nearness};
use crate::math::{ceil, floor, sqrt};
use crate::mixture::{Mixture, Sums};
use crate::point::lerp;
use crate::store::{Store, of_code};
use crate::texel::color;
use crate::{Footprint, LevelMode, Sampler, Texture};
use core::convert::identity;
use scumble_geometry::Matrix2;

/// Variance of bilinear reconstruction, in squared texels.
const RECONSTRUCTION: f64 = 1.0 / 6.0;

/// A kernel, or two that are blended inside one ellipse, made ready for many samples.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Radial {
    sampler: Sampler,
    footing: Footing,
    /// A σ is half a unit of the ellipse, as the Gaussian's is; so the radius is twice the kernel's.
    limits: Limits,
    mode: LevelMode,
}

impl Radial {
    pub(crate) fn new(s: &Sampler) -> Self {
        let limits = Limits::new(s);
        // The larger of two kernels, whichever it is on the spot: the level's budget is for both.
        let radius = 2.0 * Mixture::new(s, 0.5).radius();
        let circle = core::f64::consts::PI * radius * radius;
        let ratio = sqrt(f64::from(limits.inverse_ratio));
        let widest = 4.0 / (f64::from(limits.inverse_least) * ratio);
        let axes = widest.max(BUDGET / circle);
        let limits = Limits {
            radius: radius as f32,
            radius_squared: (radius * radius) as f32,
            most_det: (axes * axes) as f32,
            ..limits
        };
        // Two kernels share one ellipse, so it must suit any.
        let footing = match s.magnify {
            Magnify::Radial(_) => Footing::Grid,
            _ => s.kernel.footing(),
        };
        Self { sampler: *s, footing, limits, mode: s.level }
    }

    /// The colour of one footprint, its centre brought near and its Jacobian bounded.
    #[inline(always)]
    pub(crate) fn sample(&self, engine: impl Engine, t: &Texture, f: &Footprint) -> [f32; 4] {
        let weights = Mixture::new(&self.sampler, nearness(f.major_squared() as f32));
        let average = |level: &Level, e: &Ellipse| {
            engine.call(
                #[inline(always)]
                || Self::average(level, t, e, &weights),
            )
        };
        self.over_levels(t, f, average, lerp)
    }

    /// Texels that [`Radial::sample`] reads.
    pub(crate) fn cost(&self, t: &Texture, f: &Footprint) -> usize {
        self.over_levels(t, f, |_, rows| rows.texels(), |a, b, _| a + b)
    }

    /// What `each` makes of the ellipse in one level, or `join` of two.
    #[inline(always)]
    fn over_levels<R>(
        &self,
        t: &Texture,
        f: &Footprint,
        each: impl Fn(&Level, &Ellipse) -> R,
        join: impl FnOnce(R, R, f32) -> R,
    ) -> R {
        let (sigma, minor) = self.unit(&f.jacobian);
        let Pick { level, coarser } = match self.mode {
            LevelMode::Auto => {
                auto_pick(minor * self.limits.inverse_least, t.range(), self.limits.blend)
            }
            mode => lod::pick(f, mode, t.range()),
        };
        let within = |index: usize| {
            let level = &t.levels[index];
            let [su, sv] = level.frame.scale;
            let sigma = if self.mode == LevelMode::Auto {
                sigma.at_level(&level.frame)
            } else {
                // The footprint rescaled, as if that level were the texture.
                let Matrix2 { a, b, c, d } = f.jacobian;
                self.unit(&Matrix2::new(a * su, b * su, c * sv, d * sv)).0
            };
            let limits = &self.limits;
            let rare = sigma.needs_mending(&level.frame, limits);
            let sigma = if rare { sigma.mend(&level.frame, limits) } else { sigma };
            let centre = [f.u * su - 0.5, f.v * sv - 0.5];
            each(level, &Ellipse::new(centre, &sigma, 0.5 * f64::from(limits.radius)))
        };
        let fine = within(level);
        if coarser > 0.0 { join(fine, within(level + 1), coarser) } else { fine }
    }

    /// The unit circle in texels, as the covariance of something with a σ of one half; and its
    /// variance along the minor axis.
    #[inline(always)]
    fn unit(&self, jacobian: &Matrix2) -> (Covariance, f32) {
        let axes = jacobian.axes();
        let widen = |s: f64| match self.footing {
            Footing::Variance(v) => s * s + RECONSTRUCTION / v,
            Footing::Grid => (s * s).max(1.0),
        };
        let v1 = 0.25 * widen(axes.major);
        let v2 = (0.25 * widen(axes.minor)).max(v1 * f64::from(self.limits.inverse_ratio));
        let [x, y] = axes.direction;
        let sigma = Covariance {
            uu: (v1 * x * x + v2 * y * y) as f32,
            uv: ((v1 - v2) * x * y) as f32,
            vv: (v1 * y * y + v2 * x * x) as f32,
            det: (v1 * v2) as f32,
        };
        (sigma, v2 as f32)
    }

    /// The weighted average over an ellipse, about the texel nearest to its centre, so that a
    /// constant comes out exact.
    #[inline(always)]
    fn average(level: &Level, t: &Texture, e: &Ellipse, weights: &Mixture) -> [f32; 4] {
        let [u, v] = e.centre;
        let centre = level.texel(floor(u + 0.5) as i32, floor(v + 0.5) as i32, t.wrap);
        let mut sums = Sums::new(centre);
        for y in e.rows() {
            let row = e.row(y);
            let Row { first, last, .. } = row;
            if first > last || !level.holds([first, y], [last, y]) {
                row.add(
                    #[inline(always)]
                    |i| level.texel(first + i as i32, y, t.wrap),
                    weights,
                    &mut sums,
                );
                continue;
            }
            // Asked once a row how texels are kept, and not for each.
            let place = level.index(first, y);
            match &level.texels {
                Store::Steps(kept) => row.add_kept(&kept[place..], color, weights, &mut sums),
                Store::Floats(kept) => row.add_kept(&kept[place..], identity, weights, &mut sums),
                Store::Codes(kept) => row.add_kept(
                    &kept[place..],
                    #[inline(always)]
                    |code| color(of_code(code)),
                    weights,
                    &mut sums,
                ),
            }
        }
        sums.finish()
    }
}

/// An ellipse in the index space of a level, where texels have whole numbers.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Ellipse {
    centre: [f64; 2],
    /// How the middle of a row moves with the row.
    slope: f64,
    /// Half of its height, and of its width along the row through the centre.
    rise: f64,
    run: f64,
    /// r² = `row_scale`·dv² + `run_scale`·dx².
    row_scale: f64,
    run_scale: f64,
}

impl Ellipse {
    /// From the covariance of the unit circle (σ = ½) and the kernel's radius.
    #[inline(always)]
    fn new(centre: [f64; 2], sigma: &Covariance, radius: f64) -> Self {
        let [uv, vv, det] = [sigma.uv, sigma.vv, sigma.det].map(f64::from);
        let slope = uv / vv;
        let (vv, across) = (4.0 * vv, 4.0 * det / vv);
        Self {
            centre,
            slope,
            rise: radius * sqrt(vv),
            run: radius * sqrt(across),
            row_scale: 1.0 / vv,
            run_scale: 1.0 / across,
        }
    }

    /// Rows that have a texel inside.
    #[inline(always)]
    fn rows(&self) -> core::ops::RangeInclusive<i32> {
        let v = self.centre[1];
        ceil(v - self.rise) as i32..=floor(v + self.rise) as i32
    }

    /// What of row `y` is inside.
    #[inline(always)]
    fn row(&self, y: i32) -> Row {
        let dv = f64::from(y) - self.centre[1];
        let middle = self.centre[0] + self.slope * dv;
        let part = dv / self.rise;
        let half = self.run * sqrt((1.0 - part * part).max(0.0));
        Row {
            first: ceil(middle - half) as i32,
            last: floor(middle + half) as i32,
            middle,
            base: (self.row_scale * dv * dv) as f32,
            scale: self.run_scale as f32,
        }
    }

    /// Texels inside.
    fn texels(&self) -> usize {
        self.rows().map(|y| self.row(y).count()).sum()
    }
}

/// A row of an ellipse.
#[derive(Debug, Clone, Copy)]
struct Row {
    /// Its first texel and its last.
    first: i32,
    last: i32,
    /// Where its middle is.
    middle: f64,
    /// r² = `base` + `scale`·dx².
    base: f32,
    scale: f32,
}

impl Row {
    /// How many texels it has.
    #[inline(always)]
    fn count(&self) -> usize {
        usize::try_from(self.last - self.first + 1).unwrap_or(0)
    }

    /// Adds its texels, which are kept side by side.
    #[inline(always)]
    fn add_kept<T: Copy>(
        &self,
        texels: &[T],
        color: impl Fn(T) -> [f32; 4],
        weights: &Mixture,
        sums: &mut Sums,
    ) {
        let texels = &texels[..self.count()];
        self.add(
            #[inline(always)]
            |i| color(texels[i]),
            weights,
            sums,
        );
    }

    /// Adds its texels, given the colour of each, counted from the first.
    #[inline(always)]
    fn add(&self, color: impl Fn(usize) -> [f32; 4], weights: &Mixture, sums: &mut Sums) {
        let count = self.count();
        for from in (0..count).step_by(TOGETHER) {
            let x = f64::from(self.first + from as i32);
            let mut these = [0.0; TOGETHER];
            for (k, r2) in these.iter_mut().enumerate() {
                let dx = (x + k as f64 - self.middle) as f32;
                *r2 = self.base + self.scale * (dx * dx);
            }
            weights.weigh(&mut these);
            for (k, weight) in these.iter().enumerate().take(count - from) {
                sums.add(*weight, color(from + k));
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::TextureOptions;
    use crate::engine::Scalar;
    use scumble_pixel::Image;

    #[test]
    fn the_gaussian_is_that_of_the_fast_path() {
        let image = Image::from_fn(64, 48, |x, y| {
            let v = ((x * 7919 + y * 104_729) % 256) as u8;
            [v, v / 2, 255 - v, 255]
        });
        let t = Texture::new(image.unwrap().view(), &TextureOptions::default()).unwrap();
        let s = Sampler { magnify: Magnify::None, ..Sampler::DEFAULT };
        let radial = Radial::new(&s);
        for i in 0..400 {
            let at = |k: f64| (f64::from(i) * k) % 1.0;
            let jacobian = Matrix2::new(9.0 * at(0.37), 4.0 * at(0.71), 5.0 * at(0.59), at(0.13));
            let f = Footprint { u: 64.0 * at(0.618), v: 48.0 * at(0.414), jacobian };
            let (found, fast) = (radial.sample(Scalar, &t, &f), t.sample(&f, &s).0);
            for (a, b) in found.iter().zip(fast) {
                assert!((a.clamp(0.0, 1.0) - b).abs() < 2e-4, "{f:?}: {found:?} {fast:?}");
            }
        }
    }
}
