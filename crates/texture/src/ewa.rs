//! The elliptical weighted average: from a footprint to an ellipse, a level and a walk.

use crate::covariance::{Covariance, products, single};
use crate::engine::Engine;
use crate::gaussian::{UNIT, widening};
use crate::lod::{self, Pick};
use crate::magnify::patch::Spotted;
use crate::point::lerp;
use crate::walk::{Place, THIN, Walk};
use crate::{Footprint, LevelMode, Magnify, Sampler, Texture, walk_float};
use scumble_geometry::Matrix2;

/// The area of an ellipse, in texels of the level that is read, that is always allowed. A larger
/// one, where no coarser level takes it, is shrunk to this area, which aliases: level zero of a
/// texture minified more than 46 times, or a texture without its pyramid.
pub(crate) const BUDGET: f64 = 16_384.0;

/// The least ratio of V₂/s² to the switch of level at which two levels blend: nearly the last quarter of
/// the octave in σ does, which 4^¾ = 2.83 would be. A picture shrunk four times, for which the default has
/// 2.89, is left out and reads one level.
pub(crate) const BAND_START: f32 = 2.9;

/// One over the rest of the octave.
pub(crate) const BAND: f32 = 1.0 / (4.0 - BAND_START);

/// The numbers of a sampler that the ellipse needs, brought into their ranges.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Limits {
    /// 1/a²: the least ratio of the variances.
    pub(crate) inverse_ratio: f32,
    /// R, and its square.
    pub(crate) radius: f32,
    pub(crate) radius_squared: f32,
    /// The variance of an ellipse along an axis where all texels are the same.
    pub(crate) thin: f32,
    /// 1/s².
    pub(crate) inverse_least: f32,
    /// The determinant of the largest ellipse.
    pub(crate) most_det: f32,
    pub(crate) blend: bool,
    /// [`UNIT`], for exponents of the Gaussian as it is [widened](widening).
    pub(crate) unit: f32,
    /// ½R², in that unit: weights whose exponent is above it are 0.
    pub(crate) cut: f32,
    pub(crate) magnify: Magnify,
}

impl Limits {
    pub(crate) fn new(s: &Sampler) -> Self {
        // `max` and `min` in this order turn a NaN into the lower bound.
        let within = |x: f32, low: f64, high: f64| f64::from(x).max(low).min(high);
        let ratio = within(s.max_eccentricity, 1.0, 1024.0);
        let radius = within(s.radius, 2.0, 4.0);
        let least = within(s.least_sigma, 0.4, 4.0);
        // What the largest ratio and σ allow by themselves, or the budget if that is more.
        let circle = core::f64::consts::PI * radius * radius;
        let axes = (4.0 * least * least * ratio).max(BUDGET / circle);
        let unit = UNIT / widening(radius) as f32;
        Self {
            inverse_ratio: (1.0 / (ratio * ratio)) as f32,
            radius: radius as f32,
            radius_squared: (radius * radius) as f32,
            thin: THIN / (radius * radius) as f32,
            inverse_least: (1.0 / (least * least)) as f32,
            most_det: (axes * axes) as f32,
            blend: s.blend,
            unit,
            cut: (0.5 * radius * radius) as f32 * unit,
            magnify: s.magnify,
        }
    }
}

/// The levels to read for a footprint and what its ellipses are made of. The centre has been brought
/// near, the Jacobian is bounded.
struct Plan<'a> {
    t: &'a Texture,
    f: &'a Footprint,
    limits: &'a Limits,
    pick: Pick,
    /// The ellipse in level 0, where the levels come from it.
    sigma: Option<Covariance>,
    /// How much of the colour is what is magnified apart.
    near: f32,
}

impl<'a> Plan<'a> {
    #[inline(always)]
    fn new(t: &'a Texture, f: &'a Footprint, mode: LevelMode, limits: &'a Limits) -> Self {
        let near = limits.magnify.nearness(products(single(&f.jacobian)));
        if mode != LevelMode::Auto {
            let pick = lod::pick(f, mode, t.range());
            return Self { t, f, limits, pick, sigma: None, near };
        }
        let (sigma, minor) = Covariance::of(&f.jacobian, limits.inverse_ratio);
        let pick = auto_pick(minor * limits.inverse_least, t.range(), limits.blend);
        Self { t, f, limits, pick, sigma: Some(sigma), near }
    }

    /// The walk in one of the levels.
    #[inline(always)]
    fn walk(&self, index: usize) -> Walk {
        let level = &self.t.levels[index];
        let sigma = match self.sigma {
            Some(sigma) => sigma.at_level(&level.frame),
            None => {
                // The footprint rescaled, as if that level were the texture.
                let [su, sv] = level.frame.scale;
                let Matrix2 { a, b, c, d } = self.f.jacobian;
                let jacobian = Matrix2::new(a * su, b * su, c * sv, d * sv);
                Covariance::of(&jacobian, self.limits.inverse_ratio).0
            }
        };
        walk_in(self.t, index, self.f.u, self.f.v, sigma, self.limits)
    }

    #[inline(always)]
    fn filter(&self, engine: impl Engine, index: usize) -> [f32; 4] {
        let (level, walk) = (&self.t.levels[index], self.walk(index));
        if level.is_float() {
            return walk_float::walk(level, self.t.wrap, &walk);
        }
        engine.walk(level, self.t.wrap, &walk)
    }

    /// The colour of the ellipse.
    #[inline(always)]
    fn far(&self, engine: impl Engine) -> [f32; 4] {
        let Pick { level, coarser } = self.pick;
        let fine = self.filter(engine, level);
        if coarser > 0.0 { lerp(fine, self.filter(engine, level + 1), coarser) } else { fine }
    }

    /// What is magnified apart, in the first level that is kept.
    #[inline(always)]
    fn close(&self) -> [f32; 4] {
        let Footprint { u, v, jacobian } = self.f;
        let level = &self.t.levels[0];
        let at = Spotted::new(level, *u, *v, jacobian);
        self.limits.magnify.sample(level, self.t.wrap, &at)
    }
}

/// The colour of one footprint, its centre brought near and its Jacobian bounded.
#[inline(always)]
pub(crate) fn sample(
    t: &Texture,
    engine: impl Engine,
    f: &Footprint,
    mode: LevelMode,
    limits: &Limits,
) -> [f32; 4] {
    let plan = Plan::new(t, f, mode, limits);
    if plan.near >= 1.0 {
        return plan.close();
    }
    let far = plan.far(engine);
    if plan.near > 0.0 {
        // Each within its range, or a halo of the one would eat what is soft in the other.
        let (far, close) = (t.within_range(far), t.within_range(plan.close()));
        return lerp(far.0, close.0, plan.near);
    }
    far
}

/// Texels that [`sample`] reads.
pub(crate) fn cost(t: &Texture, f: &Footprint, mode: LevelMode, limits: &Limits) -> usize {
    let plan = Plan::new(t, f, mode, limits);
    let Pick { level, coarser } = plan.pick;
    let close = if plan.near > 0.0 { limits.magnify.texels() } else { 0 };
    if plan.near >= 1.0 {
        return close;
    }
    let next = if coarser > 0.0 { plan.walk(level + 1).texels() } else { 0 };
    close + plan.walk(level).texels() + next
}

/// The level where σ of the minor axis is between s and 2s, from V₂/s², and how much of the next; of
/// those from `first` to `last`.
#[inline(always)]
pub(crate) fn auto_pick(minor: f32, [first, last]: [usize; 2], blend: bool) -> Pick {
    // ⌊log₄ x⌋ from the exponent's bits.
    let level = (minor.to_bits() >> 23).saturating_sub(127) as usize / 2;
    let level = level.max(first).min(last);
    // Divided by 4^l, which is exact: levels of pyramids are below 30.
    let ratio = minor * f32::from_bits((127 - 2 * level.min(62) as u32) << 23);
    let x = (ratio - BAND_START) * BAND;
    let blends = blend && level < last && x > 0.0;
    Pick { level: level - first, coarser: if blends { x * x * (3.0 - 2.0 * x) } else { 0.0 } }
}

/// The walk over an ellipse about (u, v), given in texels of the image, the ellipse in those of the
/// level.
#[inline(always)]
pub(crate) fn walk_in(
    t: &Texture,
    index: usize,
    u: f64,
    v: f64,
    sigma: Covariance,
    limits: &Limits,
) -> Walk {
    let frame = &t.levels[index].frame;
    let mut place = Place::new(u, v, frame);
    let (sigma, pulled) = place.pull_in(sigma, frame, limits);
    let amiss =
        if pulled { sigma.is_too_large(frame, limits) } else { sigma.needs_mending(frame, limits) };
    let mended = if amiss { sigma.mend(frame, limits) } else { sigma };
    Walk::new(&place, &mended, limits)
}
