//! Runs of pixels through the elliptical filter: the set-up of sixteen at a time.
//!
//! The formulas are those of single samples, called in loops over arrays that hold no branch and no
//! call, so that the compiler makes vectors of them. What is rare is redone one by one.

use crate::abreast::{ABREAST, ALONE, IDLE, Sheet, Walks};
use crate::covariance::Covariance;
use crate::engine::Engine;
use crate::ewa::{Limits, auto_pick, walk_in};
use crate::level::Frame;
use crate::lod::Pick;
use crate::point::lerp;
use crate::texture::into_range;
use crate::walk::Walk;
use crate::{Footprint, Texture};
use scumble_pixel::Premul;

/// Pixels set up together.
const BATCH: usize = ABREAST;

/// Pixels from which on a batch is quicker than one by one.
pub(crate) const WORTH: usize = 4;

/// Ellipses in level 0.
#[derive(Default)]
struct Ellipses {
    u: [f64; BATCH],
    v: [f64; BATCH],
    uu: [f64; BATCH],
    uv: [f64; BATCH],
    vv: [f64; BATCH],
    det: [f64; BATCH],
    /// V₂/s².
    minor: [f64; BATCH],
    /// 1 where the footprint is finite and bounded, else 0.
    usable: [i32; BATCH],
}

/// The levels of each ellipse.
#[derive(Default)]
struct Chosen {
    pick: [Pick; BATCH],
    /// Whether all read the same.
    same: bool,
    /// Whether one blends two.
    blends: bool,
}

/// Samples a run of footprints with the level chosen by the ellipse.
#[inline(always)]
pub(crate) fn fill(
    t: &Texture,
    engine: impl Engine,
    at: impl Fn(usize) -> Footprint,
    limits: &Limits,
    out: &mut [Premul],
) {
    let mut sheet = Sheet::default();
    for (chunk, out) in out.chunks_mut(BATCH).enumerate() {
        let first = chunk * BATCH;
        // Beyond the end, the last again.
        let last = out.len() - 1;
        let ellipses = Ellipses::new(
            t,
            limits,
            #[inline(always)]
            |i| at(first + i.min(last)),
        );
        let chosen = Chosen::new(t, &ellipses, limits);
        let wanted = |i: usize| (i <= last) & (ellipses.usable[i] != 0);
        let mut colors = [[0.0; 4]; BATCH];
        let mut walks = chosen.walks(t, &ellipses, limits, 0, wanted);
        engine.walk_all(t, &walks, &mut sheet, &mut colors);
        if chosen.blends {
            let mut coarser = [[0.0; 4]; BATCH];
            let blends = |i: usize| wanted(i) & (chosen.pick[i].coarser > 0.0);
            walks = chosen.walks(t, &ellipses, limits, 1, blends);
            engine.walk_all(t, &walks, &mut sheet, &mut coarser);
            for ((color, next), pick) in colors.iter_mut().zip(coarser).zip(&chosen.pick) {
                if pick.coarser > 0.0 {
                    *color = lerp(*color, next, pick.coarser);
                }
            }
        }
        for ((out, color), usable) in out.iter_mut().zip(colors).zip(ellipses.usable) {
            *out = if usable == 0 { t.average() } else { into_range(color) };
        }
    }
}

impl Ellipses {
    #[inline(always)]
    fn new(t: &Texture, limits: &Limits, at: impl Fn(usize) -> Footprint) -> Self {
        let mut e = Self::default();
        for i in 0..BATCH {
            let f = t.nearer(&at(i));
            let (sigma, minor) = Covariance::of(&f.jacobian, limits.inverse_ratio);
            e.u[i] = f.u;
            e.v[i] = f.v;
            e.uu[i] = sigma.uu;
            e.uv[i] = sigma.uv;
            e.vv[i] = sigma.vv;
            e.det[i] = sigma.det;
            e.minor[i] = minor * limits.inverse_least;
            e.usable[i] = i32::from(f.is_finite() & f.is_bounded());
        }
        e
    }

    #[inline(always)]
    fn get(&self, i: usize) -> Covariance {
        Covariance { uu: self.uu[i], uv: self.uv[i], vv: self.vv[i], det: self.det[i] }
    }
}

impl Chosen {
    #[inline(always)]
    fn new(t: &Texture, e: &Ellipses, limits: &Limits) -> Self {
        let mut chosen = Self { same: true, ..Self::default() };
        for i in 0..BATCH {
            chosen.pick[i] = auto_pick(e.minor[i], t.levels.len() - 1, limits.blend);
        }
        for pick in &chosen.pick {
            chosen.same &= pick.level == chosen.pick[0].level;
            chosen.blends |= pick.coarser > 0.0;
        }
        chosen
    }

    /// The walks in the chosen levels, or so many levels on, of those that are wanted.
    #[inline(always)]
    fn walks(
        &self,
        t: &Texture,
        e: &Ellipses,
        limits: &Limits,
        on: usize,
        wanted: impl Fn(usize) -> bool,
    ) -> Walks {
        let last = t.levels.len() - 1;
        let level = |i: usize| &t.levels[(self.pick[i].level + on).min(last)];
        // To collect the frames of several levels takes longer than all the rest.
        let mut walks = Walks { cut: limits.cut, ..Walks::default() };
        let mut rare = [0; BATCH];
        if self.same {
            let frame = level(0).frame;
            fill_walks(e, |_| &frame, limits, &mut walks, &mut rare);
        } else {
            fill_walks(e, |i| &level(i).frame, limits, &mut walks, &mut rare);
        }
        for (i, rare) in rare.into_iter().enumerate() {
            let level = level(i);
            walks.stride[i] = level.stride as i32;
            walks.base[i] = level.base;
            [walks.mask_x[i], walks.mask_y[i]] = level.mask;
            walks.level[i] = (self.pick[i].level + on).min(last) as u32;
            if !wanted(i) {
                walks.how[i] = IDLE;
            } else if rare != 0 {
                let sigma = e.get(i).at_level(&level.frame);
                let index = walks.level[i] as usize;
                let walk = walk_in(t, index, e.u[i], e.v[i], sigma, limits);
                walks.set(i, &walk);
                walks.how[i] = ALONE + walk.inside;
            }
        }
        walks
    }
}

/// The walks over all the ellipses, and 1 for those that need mending.
#[inline(always)]
fn fill_walks<'a>(
    e: &Ellipses,
    frame: impl Fn(usize) -> &'a Frame,
    limits: &Limits,
    o: &mut Walks,
    rare: &mut [i32; BATCH],
) {
    for (i, rare) in rare.iter_mut().enumerate() {
        let frame = frame(i);
        let sigma = e.get(i).at_level(frame);
        let w = Walk::new(e.u[i], e.v[i], frame, &sigma, limits);
        o.set(i, &w);
        o.how[i] = ALONE + w.inside;
        *rare = i32::from(sigma.needs_mending(frame, limits));
    }
}
