//! Nearest and bilinear, sixteen pixels abreast: the same numbers as in [`crate::point`].

use crate::batch::{lanes, place};
use crate::level::Level;
use crate::lod;
use crate::point::{Bilinear, Nearest, Point};
use crate::run::{ABREAST, Run, Sixteen};
use crate::store::{CODE_BITS, Code, Store, Stored};
use crate::texel::Texel;
use crate::walk_simd::expand;
use crate::{LevelMode, Texture};
use fearless_simd::{
    Simd, f32x8, f32x16, f64x4, i16x8, i16x16, i32x16, mask32x16, prelude::*, u8x16, u8x64, u32x4,
};
use scumble_pixel::Premul;

/// Colours whose channels lie side by side in a vector.
const FOUR: usize = 4;

/// Sixteen colours.
type Colors<S> = [f32x16<S>; ABREAST / FOUR];

/// Takes the last of the four numbers of 32 bits in a block of sixteen bytes four times.
const ALPHA: [u8; 64] = {
    let mut bytes = [0; 64];
    let mut i = 0;
    while i < 64 {
        bytes[i] = (12 + i % 4) as u8;
        i += 1;
    }
    bytes
};

/// A [`Point`] that reads four places at once.
pub(crate) trait Points: Point {
    /// The colours, in the level's unit, at four rests from the texels of these indices.
    fn four<S: Simd, T: Read>(
        simd: S,
        texels: &[T],
        stride: usize,
        at: &[i32; FOUR],
        rest: [&[f32; FOUR]; 2],
    ) -> f32x16<S>;
}

/// A texel as it is read into lanes, from an index which is 0 or holds.
pub(crate) trait Read: Stored {
    /// Four of them, from anywhere.
    fn four<S: Simd>(simd: S, texels: &[Self], at: &[i32; FOUR]) -> f32x16<S>;

    /// Two side by side.
    fn two<S: Simd>(simd: S, texels: &[Self], at: usize) -> f32x8<S>;
}

impl Read for Texel {
    #[inline(always)]
    fn four<S: Simd>(simd: S, texels: &[Self], at: &[i32; FOUR]) -> f32x16<S> {
        let mut bits = [0.0; FOUR];
        for (bits, at) in bits.iter_mut().zip(at) {
            let [r, g, b, a] =
                texels.get(*at as u32 as usize).unwrap_or(&[0; 4]).map(i16::cast_unsigned);
            let (low, high) =
                (u64::from(g) << 16 | u64::from(r), u64::from(a) << 16 | u64::from(b));
            *bits = f64::from_bits(high << 32 | low);
        }
        floats(f64x4::load_array(simd, bits).bitcast())
    }

    #[inline(always)]
    fn two<S: Simd>(simd: S, texels: &[Self], at: usize) -> f32x8<S> {
        let run = texels.get(at..at + 2).unwrap_or(&[[0; 4]; 2]);
        let (low, high) = i16x8::from_slice(simd, run.as_flattened()).widen();
        low.combine(high).to_float()
    }
}

impl Read for Code {
    #[inline(always)]
    fn four<S: Simd>(simd: S, texels: &[Self], at: &[i32; FOUR]) -> f32x16<S> {
        let mut codes = [[0; 4]; FOUR];
        for (codes, at) in codes.iter_mut().zip(at) {
            *codes = *texels.get(*at as u32 as usize).unwrap_or(&[0; 4]);
        }
        let bits = codes.map(u32::from_le_bytes);
        let (low, high) = u32x4::load_array(simd, bits).bitcast::<u8x16<S>>().widen();
        floats((low.combine(high) << CODE_BITS).bitcast())
    }

    #[inline(always)]
    fn two<S: Simd>(simd: S, texels: &[Self], at: usize) -> f32x8<S> {
        let run = texels.get(at..at + 2).unwrap_or(&[[0; 4]; 2]);
        let mut codes = [[0; 4]; 4];
        codes[..2].copy_from_slice(run);
        let (low, _) = u8x16::from_slice(simd, codes.as_flattened()).widen();
        let (low, high) = (low << CODE_BITS).bitcast::<i16x8<S>>().widen();
        low.combine(high).to_float()
    }
}

/// Numbers of 16 bits as floats.
#[inline(always)]
fn floats<S: Simd>(v: i16x16<S>) -> f32x16<S> {
    let (low, high) = v.widen();
    low.combine(high).to_float()
}

impl Read for [f32; 4] {
    #[inline(always)]
    fn four<S: Simd>(simd: S, texels: &[Self], at: &[i32; FOUR]) -> f32x16<S> {
        let mut four = [[0.0; 4]; FOUR];
        for (texel, at) in four.iter_mut().zip(at) {
            *texel = *texels.get(*at as u32 as usize).unwrap_or(&[0.0; 4]);
        }
        f32x16::from_slice(simd, four.as_flattened())
    }

    #[inline(always)]
    fn two<S: Simd>(simd: S, texels: &[Self], at: usize) -> f32x8<S> {
        let run = texels.get(at..at + 2).unwrap_or(&[[0.0; 4]; 2]);
        f32x8::from_slice(simd, run.as_flattened())
    }
}

impl Points for Nearest {
    #[inline(always)]
    fn four<S: Simd, T: Read>(
        simd: S,
        texels: &[T],
        _: usize,
        at: &[i32; FOUR],
        _: [&[f32; FOUR]; 2],
    ) -> f32x16<S> {
        T::four(simd, texels, at)
    }
}

impl Points for Bilinear {
    #[inline(always)]
    fn four<S: Simd, T: Read>(
        simd: S,
        texels: &[T],
        stride: usize,
        at: &[i32; FOUR],
        [x, y]: [&[f32; FOUR]; 2],
    ) -> f32x16<S> {
        // Of each place the left and the right texel.
        let (a, b) = columns(simd, texels, stride, [at[0], at[1]], [y[0], y[1]]).split();
        let (c, d) = columns(simd, texels, stride, [at[2], at[3]], [y[2], y[3]]).split();
        let ([(a, e), (b, f)], [(c, g), (d, h)]) = ([a.split(), b.split()], [c.split(), d.split()]);
        let left = a.combine(b).combine(c.combine(d));
        let right = e.combine(f).combine(g.combine(h));
        left + (right - left) * expand(simd, *x)
    }
}

/// Of two places, both columns of texels.
#[inline(always)]
fn columns<S: Simd, T: Read>(
    simd: S,
    texels: &[T],
    stride: usize,
    at: [i32; 2],
    [y0, y1]: [f32; 2],
) -> f32x16<S> {
    let [first, second] = at.map(|at| at as u32 as usize);
    let top = T::two(simd, texels, first).combine(T::two(simd, texels, second));
    let [first, second] = [first + stride, second + stride];
    let bottom = T::two(simd, texels, first).combine(T::two(simd, texels, second));
    top + (bottom - top) * f32x8::splat(simd, y0).combine(f32x8::splat(simd, y1))
}

/// Samples a run of footprints.
#[inline(always)]
pub(crate) fn fill<S: Simd>(
    simd: S,
    t: &Texture,
    run: impl Run,
    mode: LevelMode,
    filter: impl Points,
    out: &mut [Premul],
) {
    let mut held = Held::at(t, 0);
    for (chunk, out) in out.chunks_mut(ABREAST).enumerate() {
        let spots = run.sixteen(simd, t, chunk * ABREAST);
        let asked = (1u64 << out.len()) - 1;
        let finite = spots.finite.to_bitmask() & asked;
        let step = lod::longest_step_squared(spots.jacobian);
        let [level, coarser] = lod::levels(step, mode, t.range().map(|level| level as f32));
        let batch = Batch { simd, t, filter, spots: &spots };
        let mut colors = [f32x16::splat(simd, 0.0); ABREAST / FOUR];
        let (levels, mut rest) = (level.to_int::<i32x16<S>>(), finite);
        while rest != 0 {
            let mut same = levels.simd_eq(held.index).to_bitmask() & rest;
            if same == 0 {
                held = Held::at(t, levels.to_array()[rest.trailing_zeros() as usize % ABREAST]);
                same = levels.simd_eq(held.index).to_bitmask() & rest;
            }
            let own = batch.fill(&held, coarser, same);
            colors = if rest == finite { own } else { chosen(simd, same, own, colors) };
            rest &= !same;
        }
        if let Some(all) = out.first_chunk_mut() {
            finish(simd, t, colors, all);
        } else {
            let mut all = [Premul::TRANSPARENT; ABREAST];
            finish(simd, t, colors, &mut all);
            out.copy_from_slice(&all[..out.len()]);
        }
        for i in lanes(asked & !finite) {
            out[i] = t.average();
        }
    }
}

/// The levels that were read last, which the next places most likely read too: known before these are,
/// they need not be waited for.
struct Held<'a> {
    index: i32,
    fine: Option<Grid<'a>>,
    /// The next.
    coarse: Option<Grid<'a>>,
}

impl<'a> Held<'a> {
    #[inline(always)]
    fn at(t: &'a Texture, index: i32) -> Self {
        let grid = |index: usize| t.levels.get(index).map(Grid::new);
        Self { index, fine: grid(index as usize), coarse: grid(index as usize + 1) }
    }
}

/// A level, and its texels at hand.
#[derive(Clone, Copy)]
struct Grid<'a> {
    level: &'a Level,
    texels: Texels<'a>,
}

/// The slices of a [`Store`].
#[derive(Clone, Copy)]
enum Texels<'a> {
    Steps(&'a [Texel]),
    Codes(&'a [Code]),
    Floats(&'a [[f32; 4]]),
}

impl<'a> Grid<'a> {
    #[inline(always)]
    fn new(level: &'a Level) -> Self {
        let texels = match &level.texels {
            Store::Steps(texels) => Texels::Steps(texels),
            Store::Codes(texels) => Texels::Codes(texels),
            Store::Floats(texels) => Texels::Floats(texels),
        };
        Self { level, texels }
    }
}

/// Of two colours in each lane the first where its bit is set.
#[inline(always)]
fn chosen<S: Simd>(simd: S, bits: u64, yes: Colors<S>, no: Colors<S>) -> Colors<S> {
    let flags = mask32x16::from_bitmask(simd, bits)
        .select(f32x16::splat(simd, 1.0), f32x16::splat(simd, 0.0))
        .to_array();
    let mut colors = no;
    for ((color, yes), flags) in colors.iter_mut().zip(yes).zip(flags.as_chunks().0) {
        *color = expand(simd, *flags).simd_gt(0.0).select(yes, *color);
    }
    colors
}

/// Sixteen places on their way.
struct Batch<'a, S: Simd, P> {
    simd: S,
    t: &'a Texture,
    filter: P,
    spots: &'a Sixteen<S>,
}

impl<S: Simd, P: Points> Batch<'_, S, P> {
    /// The colours of the lanes whose bits are set, which read this level and, where `coarser` is above 0,
    /// so much of the next; of other lanes anything.
    #[inline(always)]
    fn fill(&self, held: &Held<'_>, coarser: f32x16<S>, wanted: u64) -> Colors<S> {
        let Some(grid) = held.fine else { return [f32x16::splat(self.simd, 0.0); ABREAST / FOUR] };
        let mut own = self.in_level(grid, wanted);
        let blends = coarser.simd_gt(0.0).to_bitmask() & wanted;
        if blends != 0
            && let Some(grid) = held.coarse
        {
            let next = self.in_level(grid, blends);
            let coarser = coarser.to_array();
            for ((own, next), coarser) in own.iter_mut().zip(next).zip(coarser.as_chunks().0) {
                let coarser = expand(self.simd, *coarser);
                let both = *own + (next - *own) * coarser;
                *own = coarser.simd_gt(0.0).select(both, *own);
            }
        }
        own
    }

    /// The colours in one level, in its unit.
    #[inline(always)]
    fn in_level(&self, Grid { level, texels }: Grid<'_>, wanted: u64) -> Colors<S> {
        let simd = self.simd;
        let [su, sv] = level.frame.scale;
        let (x0, fx) = place(self.spots.u, su, P::SHIFT);
        let (y0, fy) = place(self.spots.v, sv, P::SHIFT);
        let inside = level.reads(simd, [x0, y0], [x0 + (P::SIDE - 1), y0 + (P::SIDE - 1)]);
        let here = inside & mask32x16::from_bitmask(simd, wanted);
        let at = level.places(simd, [P::SIDE; 2]).index([x0, y0]);
        let at = here.select(at, i32x16::splat(simd, 0)).to_array();
        let rest = [fx.to_array(), fy.to_array()];
        let mut colors = match texels {
            Texels::Steps(texels) => self.read(texels, level.stride, &at, &rest),
            Texels::Codes(texels) => self.read(texels, level.stride, &at, &rest),
            Texels::Floats(texels) => self.read(texels, level.stride, &at, &rest),
        };
        let beyond = wanted & !here.to_bitmask();
        if beyond != 0 {
            // In memory of its own, so that the others need none.
            let mut all = [[[0.0; 4]; FOUR]; ABREAST / FOUR];
            for (all, colors) in all.iter_mut().zip(colors) {
                colors.store_slice(all.as_flattened_mut());
            }
            for i in lanes(beyond) {
                let (at, rest) = ([x0.to_array()[i], y0.to_array()[i]], [rest[0][i], rest[1][i]]);
                all[i / FOUR][i % FOUR] = self.filter.color(level, self.t.wrap, at, rest);
            }
            for (colors, all) in colors.iter_mut().zip(&all) {
                *colors = f32x16::from_slice(simd, all.as_flattened());
            }
        }
        colors
    }

    #[inline(always)]
    fn read<T: Read>(
        &self,
        texels: &[T],
        stride: usize,
        at: &[i32; ABREAST],
        [x, y]: &[[f32; ABREAST]; 2],
    ) -> Colors<S> {
        let mut colors = [f32x16::splat(self.simd, 0.0); ABREAST / FOUR];
        let rest = x.as_chunks().0.iter().zip(y.as_chunks().0);
        for ((color, at), (x, y)) in colors.iter_mut().zip(at.as_chunks().0).zip(rest) {
            *color = P::four(self.simd, texels, stride, at, [x, y]);
        }
        colors
    }
}

/// [`Texture::within_range`] of colours in the levels' unit.
#[inline(always)]
fn finish<S: Simd>(simd: S, t: &Texture, colors: Colors<S>, out: &mut [Premul; ABREAST]) {
    let unit = t.levels[0].unit();
    let (zero, one) = (f32x16::splat(simd, 0.0), f32x16::splat(simd, 1.0));
    let out = out.as_chunks_mut::<FOUR>().0;
    if !t.bounded {
        for (out, four) in out.iter_mut().zip(colors) {
            let four = (four * unit).to_array();
            for (out, color) in out.iter_mut().zip(four.as_chunks().0) {
                *out = t.within_range(*color);
            }
        }
        return;
    }
    for (out, four) in out.iter_mut().zip(colors) {
        let colors = (four * unit).max(zero);
        let alpha = colors.min(one).swizzle_dyn_within_blocks(u8x64::load_array(simd, ALPHA));
        for (out, color) in out.iter_mut().zip(colors.min(alpha).to_array().as_chunks().0) {
            *out = Premul(*color);
        }
    }
}
