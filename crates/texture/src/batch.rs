//! Runs of pixels through the elliptical filter: the set-up of sixteen at a time.
//!
//! The formulas are those of single samples, called in loops over arrays that hold no branch and no
//! call, so that the compiler makes vectors of them. What is rare is redone one by one.

use crate::covariance::Covariance;
use crate::engine::Engine;
use crate::ewa::{Limits, Outline, auto_pick, walk_in};
use crate::lod::Pick;
use crate::point::lerp;
use crate::texture::into_range;
use crate::{Footprint, Texture};
use scumble_pixel::Premul;

/// Pixels set up together.
const BATCH: usize = 16;

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
    usable: [f32; BATCH],
}

/// The level of each ellipse, as the loops need it.
#[derive(Default)]
struct Chosen {
    pick: [Pick; BATCH],
    scale: [[f64; BATCH]; 2],
    blurred: [[f64; BATCH]; 2],
    most: [[f64; BATCH]; 2],
}

/// [`Outline`]s, by field.
#[derive(Default)]
struct Outlines {
    x0: [f64; BATCH],
    y0: [f64; BATCH],
    fx: [f32; BATCH],
    fy: [f32; BATCH],
    first: [f32; BATCH],
    rise: [f32; BATCH],
    run: [f32; BATCH],
    slope: [f32; BATCH],
    row_scale: [f32; BATCH],
    run_scale: [f32; BATCH],
    /// 1 where the ellipse needs mending, else 0.
    rare: [f32; BATCH],
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
    for (chunk, out) in out.chunks_mut(BATCH).enumerate() {
        let first = chunk * BATCH;
        let ellipses = Ellipses::new(
            t,
            limits,
            #[inline(always)]
            |i| at(first + i),
        );
        let chosen = Chosen::new(t, &ellipses, limits);
        let outlines = Outlines::new(&ellipses, &chosen, limits);
        for (i, out) in out.iter_mut().enumerate() {
            *out = if ellipses.usable[i] == 0.0 {
                t.average()
            } else {
                finish(t, engine, &ellipses, &chosen.pick[i], &outlines, i, limits)
            };
        }
    }
}

/// The walks of one pixel.
#[inline(always)]
fn finish(
    t: &Texture,
    engine: impl Engine,
    ellipses: &Ellipses,
    pick: &Pick,
    outlines: &Outlines,
    i: usize,
    limits: &Limits,
) -> Premul {
    let level = &t.levels[pick.level];
    let fine = if outlines.rare[i] == 0.0 {
        engine.walk(level, t.wrap, &outlines.get(i, limits).walk())
    } else {
        filter(t, engine, ellipses, i, pick.level, limits)
    };
    if pick.coarser == 0.0 {
        return into_range(fine);
    }
    let coarse = filter(t, engine, ellipses, i, pick.level + 1, limits);
    into_range(lerp(fine, coarse, pick.coarser))
}

/// One walk, set up alone.
#[inline(always)]
fn filter(
    t: &Texture,
    engine: impl Engine,
    ellipses: &Ellipses,
    i: usize,
    index: usize,
    limits: &Limits,
) -> [f32; 4] {
    let level = &t.levels[index];
    let sigma = ellipses.get(i).at_level(level.scale, level.blurred);
    engine.walk(level, t.wrap, &walk_in(t, index, ellipses.u[i], ellipses.v[i], sigma, limits))
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
            e.usable[i] = if f.is_finite() & f.is_bounded() { 1.0 } else { 0.0 };
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
        let mut chosen = Self::default();
        for i in 0..BATCH {
            let pick = auto_pick(e.minor[i], t.levels.len() - 1, limits.blend);
            let level = &t.levels[pick.level];
            chosen.pick[i] = pick;
            for axis in 0..2 {
                chosen.scale[axis][i] = level.scale[axis];
                chosen.blurred[axis][i] = level.blurred[axis];
                chosen.most[axis][i] = level.most[axis];
            }
        }
        chosen
    }
}

impl Outlines {
    #[inline(always)]
    fn new(e: &Ellipses, chosen: &Chosen, limits: &Limits) -> Self {
        let mut o = Self::default();
        for i in 0..BATCH {
            let both = |v: &[[f64; BATCH]; 2]| [v[0][i], v[1][i]];
            let scale = both(&chosen.scale);
            let sigma = e.get(i).at_level(scale, both(&chosen.blurred));
            let rare = sigma.needs_mending(both(&chosen.most), limits);
            let outline = Outline::new(e.u[i], e.v[i], scale, &sigma, limits);
            o.x0[i] = outline.x0;
            o.y0[i] = outline.y0;
            o.fx[i] = outline.fx;
            o.fy[i] = outline.fy;
            o.first[i] = outline.first;
            o.rise[i] = outline.rise;
            o.run[i] = outline.run;
            o.slope[i] = outline.slope;
            o.row_scale[i] = outline.row_scale;
            o.run_scale[i] = outline.run_scale;
            o.rare[i] = if rare { 1.0 } else { 0.0 };
        }
        o
    }

    #[inline(always)]
    fn get(&self, i: usize, limits: &Limits) -> Outline {
        Outline {
            x0: self.x0[i],
            y0: self.y0[i],
            fx: self.fx[i],
            fy: self.fy[i],
            first: self.first[i],
            rise: self.rise[i],
            run: self.run[i],
            slope: self.slope[i],
            row_scale: self.row_scale[i],
            run_scale: self.run_scale[i],
            cut: limits.cut,
        }
    }
}
