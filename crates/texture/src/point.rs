//! Nearest and bilinear: filters of a place in one level, or in two that are blended.

use crate::engine::Engine;
use crate::level::Level;
use crate::lod::{self, Pick};
use crate::math::{floor, whole};
use crate::run::Run;
use crate::texel::{Texel, steps};
use crate::{Footprint, LevelMode, Texture, Wrap};
use scumble_pixel::Premul;

/// a + (b − a)·t for each channel; equal ends give themselves.
#[inline(always)]
pub(crate) fn lerp(a: [f32; 4], b: [f32; 4], t: f32) -> [f32; 4] {
    core::array::from_fn(|c| a[c] + (b[c] - a[c]) * t)
}

/// A filter of a place in a level.
pub(crate) trait Point: Copy {
    /// The colours, in the level's unit, at places given in texels of level 0.
    ///
    /// One loop for the indices, which has no branch, and one for the texels.
    fn colors<const N: usize>(
        self,
        engine: impl Engine,
        level: &Level,
        wrap: Wrap,
        places: [&[f64; N]; 2],
    ) -> [[f32; 4]; N];
}

/// The texel that the place lies in.
#[derive(Clone, Copy)]
pub(crate) struct Nearest;

/// The four texels whose centres surround the place.
#[derive(Clone, Copy)]
pub(crate) struct Bilinear;

impl Point for Nearest {
    #[inline(always)]
    fn colors<const N: usize>(
        self,
        _: impl Engine,
        level: &Level,
        wrap: Wrap,
        [u, v]: [&[f64; N]; 2],
    ) -> [[f32; 4]; N] {
        let [su, sv] = level.frame.scale;
        let (mut x, mut y) = ([0; N], [0; N]);
        for i in 0..N {
            x[i] = whole(floor(u[i] * su)) & level.mask[0];
            y[i] = whole(floor(v[i] * sv)) & level.mask[1];
        }
        if level.is_float() {
            return core::array::from_fn(|i| level.texel(x[i], y[i], wrap));
        }
        let mut texels = [[0; 4]; N];
        if holds(level, &x, &y, 1) {
            for i in 0..N {
                texels[i] = level.texels[level.index(x[i], y[i])];
            }
        } else {
            for i in 0..N {
                texels[i] = level.stored(x[i], y[i], wrap);
            }
        }
        let mut colors = [[0.0; 4]; N];
        for (color, t) in colors.as_flattened_mut().iter_mut().zip(texels.as_flattened()) {
            *color = f32::from(*t);
        }
        colors
    }
}

impl Point for Bilinear {
    #[inline(always)]
    fn colors<const N: usize>(
        self,
        engine: impl Engine,
        level: &Level,
        wrap: Wrap,
        [u, v]: [&[f64; N]; 2],
    ) -> [[f32; 4]; N] {
        let [su, sv] = level.frame.scale;
        let (mut x, mut y) = ([0; N], [0; N]);
        let (mut fx, mut fy) = ([0.0; N], [0.0; N]);
        for i in 0..N {
            let (u, v) = (u[i] * su - 0.5, v[i] * sv - 0.5);
            let (x0, y0) = (floor(u), floor(v));
            x[i] = whole(x0);
            y[i] = whole(y0);
            fx[i] = (u - x0) as f32;
            fy[i] = (v - y0) as f32;
        }
        let inside = holds(level, &x, &y, 2);
        let mut colors = [[0.0; 4]; N];
        if level.is_float() {
            for i in 0..N {
                let texel = |down, right| level.texel(x[i] + right, y[i] + down, wrap);
                let left = lerp(texel(0, 0), texel(1, 0), fy[i]);
                let right = lerp(texel(0, 1), texel(1, 1), fy[i]);
                colors[i] = lerp(left, right, fx[i]);
            }
            return colors;
        }
        for i in 0..N {
            let top = level.index(x[i], y[i]);
            let bottom = top.wrapping_add(level.stride);
            let run = |i: usize| level.texels.get(i..)?.first_chunk();
            colors[i] = match (run(top), run(bottom)) {
                (Some(top), Some(bottom)) if inside => engine.bilinear(top, bottom, fx[i], fy[i]),
                _ => {
                    let [top, bottom] = square_across(level, wrap, x[i], y[i]);
                    engine.bilinear(&top, &bottom, fx[i], fy[i])
                }
            };
        }
        colors
    }
}

/// Whether the squares of `side` texels from (x, y) on are kept or in the apron, all of them.
#[inline(always)]
fn holds<const N: usize>(level: &Level, x: &[i32; N], y: &[i32; N], side: i32) -> bool {
    let mut inside = true;
    for i in 0..N {
        // Places are brought near, so that this fits.
        inside &= level.holds([x[i], y[i]], [x[i] + side - 1, y[i] + side - 1]);
    }
    inside
}

/// Two texels of each of two rows, the first at (x, y); they may lie outside.
#[cold]
#[inline(never)]
fn square_across(level: &Level, wrap: Wrap, x: i32, y: i32) -> [[Texel; 2]; 2] {
    [y, y + 1].map(|y| [x, x + 1].map(|x| level.stored(x, y, wrap)))
}

/// The bilinear mean of two rows of two texels, in steps: first down, then along.
#[inline(always)]
pub(crate) fn bilinear(top: &[Texel; 2], bottom: &[Texel; 2], fx: f32, fy: f32) -> [f32; 4] {
    let left = lerp(steps(top[0]), steps(bottom[0]), fy);
    let right = lerp(steps(top[1]), steps(bottom[1]), fy);
    lerp(left, right, fx)
}

/// Pixels set up together.
const BATCH: usize = 16;

/// Samples a run of footprints: sixteen places at a time, in loops without a branch, and then their
/// texels.
#[inline(always)]
pub(crate) fn fill(
    t: &Texture,
    engine: impl Engine,
    run: impl Run,
    mode: LevelMode,
    filter: impl Point,
    out: &mut [Premul],
) {
    let mut chunks = out.chunks_exact_mut(BATCH);
    let mut first = 0;
    for out in &mut chunks {
        let places = Places::<BATCH>::new(
            t,
            mode,
            #[inline(always)]
            |i| run.at(first + i),
        );
        if places.together() {
            places.fill(t, engine, filter, out);
        } else {
            for (i, out) in out.iter_mut().enumerate() {
                places.one(i).fill(t, engine, filter, core::slice::from_mut(out));
            }
        }
        first += BATCH;
    }
    for (i, out) in chunks.into_remainder().iter_mut().enumerate() {
        let place = Places::<1>::new(
            t,
            mode,
            #[inline(always)]
            |_| run.at(first + i),
        );
        place.fill(t, engine, filter, core::slice::from_mut(out));
    }
}

/// Places in level 0 and the levels to read there.
struct Places<const N: usize> {
    u: [f64; N],
    v: [f64; N],
    level: [u32; N],
    /// The weight of the next level.
    coarser: [f32; N],
    blends: bool,
}

impl<const N: usize> Places<N> {
    #[inline(always)]
    fn new(t: &Texture, mode: LevelMode, at: impl Fn(usize) -> Footprint) -> Self {
        let range = t.range();
        let blends = mode == LevelMode::Linear;
        let mut places =
            Self { u: [0.0; N], v: [0.0; N], level: [0; N], coarser: [0.0; N], blends };
        let mut steps = [0.0; N];
        for (i, step) in steps.iter_mut().enumerate() {
            let f = t.nearer(&at(i));
            places.u[i] = f.u;
            places.v[i] = f.v;
            *step = f.longest_step_squared();
        }
        // A loop for each mode: in one for all, every place would pay for the dearest.
        let mut pick = |mode| {
            for (i, step) in steps.iter().enumerate() {
                let detail = if mode == LevelMode::Linear { lod::detail(*step) } else { 0.0 };
                let Pick { level, coarser } = lod::pick(*step, detail, mode, range);
                places.level[i] = level as u32;
                places.coarser[i] = coarser;
            }
        };
        match mode {
            LevelMode::Zero => (),
            LevelMode::Nearest => pick(LevelMode::Nearest),
            LevelMode::Linear | LevelMode::Auto => pick(LevelMode::Linear),
        }
        places
    }

    /// Whether all are finite and read the same levels.
    #[inline(always)]
    fn together(&self) -> bool {
        let mut same = true;
        for i in 0..N {
            same &= (self.level[i] == self.level[0]) & (self.u[i] + self.v[i]).is_finite();
        }
        same
    }

    #[inline(always)]
    fn one(&self, i: usize) -> Places<1> {
        Places {
            u: [self.u[i]],
            v: [self.v[i]],
            level: [self.level[i]],
            coarser: [self.coarser[i]],
            blends: self.blends,
        }
    }

    /// The colours of places that are together.
    #[inline(always)]
    fn fill(&self, t: &Texture, engine: impl Engine, filter: impl Point, out: &mut [Premul]) {
        if N == 1 && !(self.u[0] + self.v[0]).is_finite() {
            out.fill(t.average());
            return;
        }
        let places = [&self.u, &self.v];
        let index = self.level[0] as usize;
        let mut colors = filter.colors(engine, &t.levels[index], t.wrap, places);
        if self.blends
            && let Some(level) = t.levels.get(index + 1)
        {
            let next = filter.colors(engine, level, t.wrap, places);
            for ((color, next), coarser) in colors.iter_mut().zip(next).zip(self.coarser) {
                *color = lerp(*color, next, coarser);
            }
        }
        let unit = t.levels[index].unit();
        for (out, color) in out.iter_mut().zip(colors) {
            *out = t.within_range(color.map(|v| v * unit));
        }
    }
}
