//! Runs of pixels through the elliptical filter, sixteen abreast: the same numbers as in
//! [`crate::covariance`], [`crate::ewa`] and [`crate::walk`], with a lane for each pixel. What is rare is
//! done one by one.

use crate::abreast::{Sheet, Walks};
use crate::covariance::{Covariance, LEAST_VARIANCE, PIXEL_VARIANCE, RECONSTRUCTION, products};
use crate::engine::{Engine, Vector};
use crate::ewa::{BAND, BAND_START, Limits, walk_in};
use crate::level::{Frame, Level};
use crate::magnify::patch::{Spot, Spotted};
use crate::math::WHOLE;
use crate::point::lerp;
use crate::run::{ABREAST, Run, Sixteen};
use crate::walk::{ASIDE, FARTHEST, LANES, SMALL};
use crate::{Texture, abreast};
use fearless_simd::{Simd, f32x4, f32x16, f64x8, i32x16, mask32x16, prelude::*};
use scumble_pixel::Premul;

/// Pixels from which on a batch is quicker than one by one.
pub(crate) const WORTH: usize = 4;

/// Sixteen colours.
pub(crate) type Colors = [[f32; 4]; ABREAST];

/// Samples a run of footprints with the level chosen by the ellipse.
#[inline(always)]
pub(crate) fn fill<S: Simd>(
    simd: S,
    t: &Texture,
    run: impl Run,
    limits: &Limits,
    out: &mut [Premul],
) {
    let mut sheet = Sheet::default();
    for (chunk, out) in out.chunks_mut(ABREAST).enumerate() {
        let spots = run.sixteen(simd, t, chunk * ABREAST);
        let near = limits.magnify.nearness(products(spots.jacobian));
        let asked = (1u64 << out.len()) - 1;
        let usable = spots.usable.to_bitmask() & asked;
        let far = near.simd_lt(1.0).to_bitmask() & usable;
        let close = near.simd_gt(0.0).to_bitmask() & usable;
        let mut batch = Batch { simd, t, limits, spots: &spots, sheet: &mut sheet };
        let mut colors = [[0.0; 4]; ABREAST];
        if far != 0 {
            batch.filter(far, &mut colors);
        }
        if close != 0 {
            batch.magnify(close, far, &near.to_array(), &mut colors);
        }
        finish(simd, t, &colors, usable, out);
    }
}

/// Makes pixels of colours; of those whose bits are not set, the mean of the texture.
#[inline(always)]
pub(crate) fn finish<S: Simd>(
    simd: S,
    t: &Texture,
    colors: &Colors,
    usable: u64,
    out: &mut [Premul],
) {
    for (out, color) in out.iter_mut().zip(colors) {
        *out = within(simd, *color);
    }
    for i in lanes(((1u64 << out.len()) - 1) & !usable) {
        out[i] = t.average();
    }
}

/// Calls `f` for each level that lanes whose bits are set are in, with the bits of those.
#[inline(always)]
pub(crate) fn by_level<S: Simd>(level: i32x16<S>, wanted: u64, mut f: impl FnMut(usize, u64)) {
    let levels = level.to_array();
    let mut rest = wanted;
    while rest != 0 {
        let index = levels[rest.trailing_zeros() as usize % ABREAST];
        let same = level.simd_eq(index).to_bitmask() & rest;
        rest &= !same;
        f(index as usize, same);
    }
}

/// [`Spotted`] places.
pub(crate) struct Spots<S: Simd> {
    pub(crate) base: [i32x16<S>; 2],
    pub(crate) spot: Spot<f32x16<S>>,
}

impl<S: Simd> Spots<S> {
    /// [`Spotted::new`].
    #[inline(always)]
    pub(crate) fn new(spots: &Sixteen<S>, level: &Level) -> Self {
        let [su, sv] = level.frame.scale;
        let (x0, x) = place(spots.u, su, CENTRE);
        let (y0, y) = place(spots.v, sv, CENTRE);
        let Sixteen { jacobian, determinant, .. } = *spots;
        Self { base: [x0, y0], spot: Spot { x, y, jacobian, determinant }.scaled([su, sv]) }
    }

    /// The texel so many whole columns and rows from the one that a spot counts from.
    #[inline(always)]
    pub(crate) fn texel(&self, [x, y]: [f32x16<S>; 2]) -> [i32x16<S>; 2] {
        let [x0, y0] = self.base;
        [x0 + x.to_int::<i32x16<S>>(), y0 + y.to_int::<i32x16<S>>()]
    }

    #[inline(always)]
    pub(crate) fn get(&self, i: usize) -> Spotted {
        let spot = Spot {
            x: self.spot.x.to_array()[i],
            y: self.spot.y.to_array()[i],
            jacobian: self.spot.jacobian.map(|lanes| lanes.to_array()[i]),
            determinant: self.spot.determinant.to_array()[i],
        };
        Spotted { base: self.base.map(|lanes| lanes.to_array()[i]), spot }
    }
}

/// [`into_range`](crate::texture::into_range).
#[inline(always)]
fn within<S: Simd>(simd: S, color: [f32; 4]) -> Premul {
    let zero = f32x4::splat(simd, 0.0);
    let alpha = f32x4::splat(simd, color[3]).max(zero).min(f32x4::splat(simd, 1.0));
    Premul(f32x4::load_array(simd, color).max(zero).min(alpha).to_array())
}

/// The numbers of the bits that are set.
#[inline(always)]
pub(crate) fn lanes(bits: u64) -> impl Iterator<Item = usize> {
    let mut rest = bits;
    core::iter::from_fn(
        #[inline(always)]
        move || {
            let lane = rest.trailing_zeros() as usize;
            rest &= rest.wrapping_sub(1);
            (lane < ABREAST).then_some(lane)
        },
    )
}

/// [`Covariance`]s in texels of the image.
#[derive(Clone, Copy)]
struct Ellipses<S: Simd> {
    uu: f32x16<S>,
    uv: f32x16<S>,
    vv: f32x16<S>,
    det: f32x16<S>,
}

impl<S: Simd> Ellipses<S> {
    /// [`Covariance::of`].
    #[inline(always)]
    fn of(simd: S, spots: &Sixteen<S>, limits: &Limits) -> (Self, f32x16<S>) {
        let zero = f32x16::splat(simd, 0.0);
        let [p, q, r] = products(spots.jacobian);
        let (x, y) = (p - r, q * 2.0);
        let h = (x * x + y * y).sqrt();
        let s1 = (p + r + h) * 0.5;
        let s2 = spots.determinant * spots.determinant / s1;
        let s2 = s1.simd_gt(zero).select(s2, zero);
        let v1 = s1 * PIXEL_VARIANCE + RECONSTRUCTION;
        let v2 = s2 * PIXEL_VARIANCE + RECONSTRUCTION;
        let least = v1 * limits.inverse_ratio;
        let wide = v2.simd_gt(least).select(v2, least);
        let k = (wide - v2) * 0.5 / h;
        let k = h.simd_gt(zero).select(k, zero);
        let sigma = Self {
            uu: (p * PIXEL_VARIANCE + RECONSTRUCTION) + k * (h - x),
            uv: q * PIXEL_VARIANCE - k * y,
            vv: (r * PIXEL_VARIANCE + RECONSTRUCTION) + k * (h + x),
            det: v1 * wide,
        };
        (sigma, wide)
    }

    /// [`Covariance::at_level`].
    #[inline(always)]
    fn at_level(&self, frame: &Frame) -> Self {
        let ([ss_u, ss_uv, ss_v, all], [mu, mv]) = (frame.products, frame.blurred);
        Self {
            uu: (self.uu - mu) * ss_u,
            uv: self.uv * ss_uv,
            vv: (self.vv - mv) * ss_v,
            det: ((self.det - self.vv * mu) - (self.uu - mu) * mv) * all,
        }
    }

    /// [`Covariance::needs_mending`].
    #[inline(always)]
    fn needs_mending(&self, frame: &Frame, limits: &Limits) -> mask32x16<S> {
        let sum = self.uu + self.vv;
        let least = self.det - (sum - LEAST_VARIANCE) * LEAST_VARIANCE;
        let thin = least.simd_lt(0.0) | sum.simd_lt(2.0 * LEAST_VARIANCE);
        thin | self.is_too_large(frame, limits)
    }

    /// [`Covariance::is_too_large`].
    #[inline(always)]
    fn is_too_large(&self, frame: &Frame, limits: &Limits) -> mask32x16<S> {
        let [u, v] = frame.most;
        self.det.simd_gt(limits.most_det)
            | (self.uu * limits.radius_squared).simd_gt(u * u)
            | (self.vv * limits.radius_squared).simd_gt(v * v)
    }

    #[inline(always)]
    fn get(&self, i: usize) -> Covariance {
        Covariance {
            uu: self.uu.to_array()[i],
            uv: self.uv.to_array()[i],
            vv: self.vv.to_array()[i],
            det: self.det.to_array()[i],
        }
    }
}

/// The levels that are read.
pub(crate) struct Picks<S: Simd> {
    /// Counted from the first that is kept.
    pub(crate) level: i32x16<S>,
    pub(crate) coarser: f32x16<S>,
}

impl<S: Simd> Picks<S> {
    /// [`auto_pick`](crate::ewa::auto_pick).
    #[inline(always)]
    pub(crate) fn new(simd: S, minor: f32x16<S>, t: &Texture, blend: bool) -> Self {
        let [first, last] = t.range();
        let first = i32x16::splat(simd, first as i32);
        let last = i32x16::splat(simd, last as i32);
        let zero = i32x16::splat(simd, 0);
        let level = ((minor.bitcast::<i32x16<S>>() >> 23) - 127).max(zero) >> 1;
        let level = level.max(first).min(last);
        if !blend {
            return Self { level: level - first, coarser: f32x16::splat(simd, 0.0) };
        }
        let ratio = minor * ((-(level << 1) + 127) << 23).bitcast::<f32x16<S>>();
        let x = (ratio - BAND_START) * BAND;
        let blends = level.simd_lt(last) & x.simd_gt(0.0);
        let coarser = x * x * (-(x * 2.0) + 3.0);
        Self { level: level - first, coarser: blends.select(coarser, f32x16::splat(simd, 0.0)) }
    }
}

/// Sixteen pixels on their way.
struct Batch<'a, S: Simd> {
    simd: S,
    t: &'a Texture,
    limits: &'a Limits,
    spots: &'a Sixteen<S>,
    sheet: &'a mut Sheet,
}

impl<S: Simd> Batch<'_, S> {
    /// The colours of the ellipses of the lanes whose bits are set.
    #[inline(always)]
    fn filter(&mut self, wanted: u64, colors: &mut Colors) {
        let (simd, limits) = (self.simd, self.limits);
        let (ellipses, minor) = Ellipses::of(simd, self.spots, limits);
        let picks = Picks::new(simd, minor * limits.inverse_least, self.t, limits.blend);
        self.fill(&ellipses, picks.level, wanted, colors);
        let blends = picks.coarser.simd_gt(0.0).to_bitmask() & wanted;
        if blends != 0 {
            let mut next = [[0.0; 4]; ABREAST];
            self.fill(&ellipses, picks.level + 1, blends, &mut next);
            let coarser = picks.coarser.to_array();
            for i in lanes(blends) {
                colors[i] = lerp(colors[i], next[i], coarser[i]);
            }
        }
    }

    /// Those of lanes in a level each.
    #[inline(always)]
    fn fill(&mut self, ellipses: &Ellipses<S>, level: i32x16<S>, wanted: u64, out: &mut Colors) {
        by_level(
            level,
            wanted,
            #[inline(always)]
            |index, same| self.fill_level(ellipses, index, same, out),
        );
    }

    /// The colours of lanes that read the same level.
    #[inline(always)]
    fn fill_level(&mut self, ellipses: &Ellipses<S>, index: usize, wanted: u64, out: &mut Colors) {
        let simd = self.simd;
        let Some(level) = self.t.levels.get(index) else { return };
        let sigma = ellipses.at_level(&level.frame);
        let (walks, easy) = self.walks(level, sigma);
        let easy = easy.to_bitmask() & wanted;
        if easy != 0 {
            abreast::walk_all(simd, self.t, level, &walks, easy, self.sheet, out);
        }
        for i in lanes(wanted & !easy) {
            let u = self.spots.u[i / 8].to_array()[i % 8];
            let v = self.spots.v[i / 8].to_array()[i % 8];
            let walk = walk_in(self.t, index, u, v, sigma.get(i), self.limits);
            out[i] = Vector(simd).walk(level, self.t.wrap, &walk);
        }
    }

    /// Puts what is magnified apart in the place of colours, or, of those that are `far` too, so much of
    /// it beside them.
    #[inline(always)]
    fn magnify(&mut self, close: u64, far: u64, near: &[f32; ABREAST], colors: &mut Colors) {
        let mut magnified = [[0.0; 4]; ABREAST];
        self.fill_magnified(close, &mut magnified);
        for i in lanes(close & !far) {
            colors[i] = magnified[i];
        }
        for i in lanes(close & far) {
            let (one, other) = (within(self.simd, colors[i]), within(self.simd, magnified[i]));
            colors[i] = lerp(one.0, other.0, near[i]);
        }
    }

    /// [`Magnify::sample`](crate::Magnify::sample) in the first level that is kept.
    #[inline(always)]
    fn fill_magnified(&mut self, wanted: u64, out: &mut Colors) {
        let (simd, magnify) = (self.simd, self.limits.magnify);
        let Some(level) = self.t.levels.first() else { return };
        let at = Spots::new(self.spots, level);
        let done = magnify.average_all(simd, level, &at.spot, at.base, wanted, self.sheet, out);
        for i in lanes(wanted & !done) {
            out[i] = magnify.sample(level, self.t.wrap, &at.get(i));
        }
    }

    /// [`walk_in`] the level for each lane; and those where nothing needs mending and all that is read
    /// can be read in place.
    #[inline(always)]
    fn walks(&self, level: &Level, sigma: Ellipses<S>) -> (Walks<S>, mask32x16<S>) {
        let (simd, limits, frame) = (self.simd, self.limits, &level.frame);
        let [scale_u, scale_v] = frame.scale;
        let (mut x0, mut fx) = place(self.spots.u, scale_u, CENTRE);
        let (mut y0, mut fy) = place(self.spots.v, scale_v, CENTRE);
        let mut s = sigma;
        let (mut wide, mut tall) = (reach(simd, s.uu, limits), reach(simd, s.vv, limits));
        let mut amiss = s.needs_mending(frame, limits);
        if frame.ends {
            let [last_x, last_y] = frame.last;
            let x = beyond(simd, &mut x0, &mut wide, last_x);
            let y = beyond(simd, &mut y0, &mut tall, last_y);
            let out = x | y;
            if out.any_true() {
                let (zero, thin) = (f32x16::splat(simd, 0.0), f32x16::splat(simd, limits.thin));
                fx = x.select(zero, fx);
                fy = y.select(zero, fy);
                let least = f32x16::splat(simd, LEAST_VARIANCE);
                let uu = x.select(thin, s.uu.simd_gt(least).select(s.uu, least));
                let vv = y.select(thin, s.vv.simd_gt(least).select(s.vv, least));
                s.uu = out.select(uu, s.uu);
                s.vv = out.select(vv, s.vv);
                s.uv = out.select(zero, s.uv);
                s.det = out.select(uu * vv, s.det);
                amiss = (amiss & !out) | s.is_too_large(frame, limits);
            }
        }
        // A texel more takes care of rounding, and the last quad's own length.
        let last = [x0 + wide + LANES as i32, y0 + tall + 1];
        let inside = level.reads(simd, [x0 - wide, y0 - tall], last);
        let inverse_vv = f32x16::splat(simd, 1.0) / s.vv;
        let across = s.det * inverse_vv;
        let run = across.sqrt() * limits.radius;
        let groups = ((run * 0.5).floor() + 1.0).to_int::<i32x16<S>>();
        let walks = Walks {
            x0,
            y0,
            fx,
            fy,
            slope: s.uv * inverse_vv,
            row_scale: inverse_vv * (0.5 * limits.unit),
            run_scale: f32x16::splat(simd, 0.5 * limits.unit) / across,
            row_width: s.vv * (2.0 / limits.unit),
            run_width: across * (2.0 / limits.unit),
            cut: f32x16::splat(simd, limits.cut),
            groups,
            small: s.det.simd_le(SMALL),
        };
        (walks, inside & !amiss)
    }
}

/// [`walk::reach`](crate::walk::reach).
#[inline(always)]
fn reach<S: Simd>(simd: S, variance: f32x16<S>, limits: &Limits) -> i32x16<S> {
    let reach = variance.sqrt() * limits.radius;
    let most = f32x16::splat(simd, FARTHEST);
    reach.simd_lt(most).select(reach, most).to_int::<i32x16<S>>() + 1
}

/// Puts the ellipses that lie wholly beyond the texels 0 to `last` of an axis beside them. Which.
#[inline(always)]
fn beyond<S: Simd>(simd: S, at: &mut i32x16<S>, reach: &mut i32x16<S>, last: i32) -> mask32x16<S> {
    let (before, after) = ((*at + *reach).simd_lt(-1), (*at - *reach).simd_gt(last));
    let out = before | after;
    let aside = i32x16::splat(simd, last + ASIDE);
    let aside = before.select(i32x16::splat(simd, -1 - ASIDE), aside);
    *at = out.select(aside, *at);
    // What is left reaches less than a texel.
    *reach = out.select(i32x16::splat(simd, 1), *reach);
    out
}

/// From the corner of a texel to its centre.
const CENTRE: f64 = 0.5;

/// One axis of [`Place::new`](crate::walk::Place::new): the whole part and the rest of a place in a level,
/// counted from so far into its first texel.
#[inline(always)]
pub(crate) fn place<S: Simd>(at: [f64x8<S>; 2], scale: f64, shift: f64) -> (i32x16<S>, f32x16<S>) {
    let [low, high] = at;
    let (low, high) = (low * scale - shift, high * scale - shift);
    let (low0, high0) = (low.floor(), high.floor());
    let rest = (low - low0).narrow(high - high0);
    let low = (low0 + WHOLE).bitcast::<i32x16<S>>();
    (low.unzip_low((high0 + WHOLE).bitcast::<i32x16<S>>()), rest)
}
