//! Runs of pixels through the elliptical filter: the set-up of sixteen at a time.
//!
//! The formulas are those of single samples, called in loops over arrays that hold no branch and no
//! call, so that the compiler makes vectors of them. What is rare is redone one by one.

use crate::covariance::Covariance;
use crate::engine::{Engine, Job};
use crate::ewa::{Limits, auto_pick, walk_in};
use crate::level::Frame;
use crate::lod::Pick;
use crate::point::lerp;
use crate::texture::into_range;
use crate::walk::Walk;
use crate::walk_simd::Scratch;
use crate::{Footprint, Texture};
use scumble_pixel::Premul;

/// Pixels set up together.
const BATCH: usize = 16;

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
}

/// [`Walk`]s, by field.
#[derive(Default)]
struct Walks {
    x0: [i32; BATCH],
    y0: [i32; BATCH],
    fx: [f32; BATCH],
    fy: [f32; BATCH],
    first: [i32; BATCH],
    blocks: [i32; BATCH],
    groups: [i32; BATCH],
    run: [f32; BATCH],
    slope: [f32; BATCH],
    row_scale: [f32; BATCH],
    run_scale: [f32; BATCH],
    inside: [i32; BATCH],
    small: [i32; BATCH],
    /// 1 where the ellipse needs mending, else 0.
    rare: [i32; BATCH],
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
    let mut scratch = Scratch::default();
    let mut jobs = [Job::default(); 2 * BATCH];
    let mut colors = [[0.0; 4]; 2 * BATCH];
    for (chunk, out) in out.chunks_mut(BATCH).enumerate() {
        let first = chunk * BATCH;
        let ellipses = Ellipses::new(
            t,
            limits,
            #[inline(always)]
            |i| at(first + i),
        );
        let chosen = Chosen::new(t, &ellipses, limits);
        // To collect the frames of several levels takes longer than all the rest.
        let frame = |i: usize| &t.levels[chosen.pick[i].level].frame;
        let walks = if chosen.same {
            let frame = *frame(0);
            Walks::new(&ellipses, |_| &frame, limits)
        } else {
            Walks::new(&ellipses, frame, limits)
        };
        let count = list(t, &ellipses, &chosen, &walks, limits, &mut jobs[..], out.len());
        engine.walk_all(t, &jobs[..count], &mut scratch, &mut colors[..count]);
        let mut colors = colors.iter();
        for (i, out) in out.iter_mut().enumerate() {
            *out = if ellipses.usable[i] == 0 {
                t.average()
            } else {
                let mut next = || colors.next().copied().unwrap_or_default();
                let fine = next();
                let coarser = chosen.pick[i].coarser;
                into_range(if coarser > 0.0 { lerp(fine, next(), coarser) } else { fine })
            };
        }
    }
}

/// The walks of the first `pixels` pixels: none for the unusable, two for those that blend. Returns
/// how many.
#[inline(always)]
fn list(
    t: &Texture,
    ellipses: &Ellipses,
    chosen: &Chosen,
    walks: &Walks,
    limits: &Limits,
    jobs: &mut [Job],
    pixels: usize,
) -> usize {
    let mut count = 0;
    for i in (0..pixels).filter(|i| ellipses.usable[*i] != 0) {
        let Pick { level, coarser } = chosen.pick[i];
        let alone = |level: usize| {
            let sigma = ellipses.get(i).at_level(&t.levels[level].frame);
            walk_in(t, level, ellipses.u[i], ellipses.v[i], sigma, limits)
        };
        let job = &mut jobs[count];
        job.level = level;
        if walks.rare[i] == 0 {
            walks.put(i, limits, &mut job.walk);
        } else {
            job.walk = alone(level);
        }
        count += 1;
        if coarser > 0.0 {
            jobs[count] = Job { level: level + 1, walk: alone(level + 1) };
            count += 1;
        }
    }
    count
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
        }
        chosen
    }
}

impl Walks {
    #[inline(always)]
    fn new<'a>(e: &Ellipses, frame: impl Fn(usize) -> &'a Frame, limits: &Limits) -> Self {
        let mut o = Self::default();
        for i in 0..BATCH {
            let frame = frame(i);
            let sigma = e.get(i).at_level(frame);
            let w = Walk::new(e.u[i], e.v[i], frame, &sigma, limits);
            o.x0[i] = w.x0;
            o.y0[i] = w.y0;
            o.fx[i] = w.fx;
            o.fy[i] = w.fy;
            o.first[i] = w.first;
            o.blocks[i] = w.blocks;
            o.groups[i] = w.groups;
            o.run[i] = w.run;
            o.slope[i] = w.slope;
            o.row_scale[i] = w.row_scale;
            o.run_scale[i] = w.run_scale;
            o.inside[i] = w.inside;
            o.small[i] = w.small;
            o.rare[i] = i32::from(sigma.needs_mending(frame, limits));
        }
        o
    }

    /// Field by field: a copy of the whole would wait for the fields' stores.
    #[inline(always)]
    fn put(&self, i: usize, limits: &Limits, w: &mut Walk) {
        w.x0 = self.x0[i];
        w.y0 = self.y0[i];
        w.fx = self.fx[i];
        w.fy = self.fy[i];
        w.first = self.first[i];
        w.blocks = self.blocks[i];
        w.groups = self.groups[i];
        w.run = self.run[i];
        w.slope = self.slope[i];
        w.row_scale = self.row_scale[i];
        w.run_scale = self.run_scale[i];
        w.cut = limits.cut;
        w.inside = self.inside[i];
        w.small = self.small[i];
    }
}
