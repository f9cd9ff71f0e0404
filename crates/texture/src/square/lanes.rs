//! Runs of pixels, sixteen abreast: the same numbers as in [`super`], with a lane for each pixel.

use crate::abreast::{Gather, QUAD, Sheet, pair};
use crate::batch::{Colors, Picks, Spots, by_level, finish, lanes};
use crate::covariance::{minor_squared, products};
use crate::level::Level;
use crate::lod;
use crate::point::lerp;
use crate::run::{ABREAST, Run, Sixteen};
use crate::square::shape::{COARSE, FINE, Rule, Shape};
use crate::square::{Square, VARIANCE, average, nearest};
use crate::walk::LANES;
use crate::{LevelMode, Texture};
use fearless_simd::{Simd, f32x16, i32x16, mask32x16, prelude::*};
use scumble_pixel::Premul;

/// Samples a run of footprints.
#[inline(always)]
pub(crate) fn fill<S: Simd>(
    simd: S,
    t: &Texture,
    run: impl Run,
    square: &Square,
    out: &mut [Premul],
) {
    let mut sheet = Sheet::default();
    for (chunk, out) in out.chunks_mut(ABREAST).enumerate() {
        let spots = run.sixteen(simd, t, chunk * ABREAST);
        let asked = (1u64 << out.len()) - 1;
        let usable = spots.usable.to_bitmask() & asked;
        let (level, coarser) = square.picks(simd, t, &spots);
        let mut batch = Batch { simd, t, spots: &spots, sheet: &mut sheet };
        let mut colors = [[0.0; 4]; ABREAST];
        batch.fill(level, usable, &mut colors);
        let blends = coarser.simd_gt(0.0).to_bitmask() & usable;
        if blends != 0 {
            let mut next = [[0.0; 4]; ABREAST];
            batch.fill(level + 1, blends, &mut next);
            let coarser = coarser.to_array();
            for i in lanes(blends) {
                colors[i] = lerp(colors[i], next[i], coarser[i]);
            }
        }
        finish(simd, t, &colors, usable, out);
    }
}

impl Square {
    /// [`Square::pick`] for each lane.
    #[inline(always)]
    fn picks<S: Simd>(&self, simd: S, t: &Texture, spots: &Sixteen<S>) -> (i32x16<S>, f32x16<S>) {
        if self.mode != LevelMode::Auto {
            let step = lod::longest_step_squared(spots.jacobian);
            let [level, coarser] = lod::levels(step, self.mode, t.range().map(|l| l as f32));
            return (level.to_int(), coarser);
        }
        let Sixteen { jacobian, determinant, .. } = *spots;
        let minor = minor_squared(products(jacobian), determinant, self.limits.inverse_ratio);
        let minor = minor * VARIANCE * self.limits.inverse_least;
        let Picks { level, coarser } = Picks::new(simd, minor, t, self.limits.blend);
        (level, coarser)
    }
}

/// Sixteen pixels on their way.
struct Batch<'a, S: Simd> {
    simd: S,
    t: &'a Texture,
    spots: &'a Sixteen<S>,
    sheet: &'a mut Sheet,
}

impl<S: Simd> Batch<'_, S> {
    /// The colours of the lanes whose bits are set, in a level each.
    #[inline(always)]
    fn fill(&mut self, level: i32x16<S>, wanted: u64, out: &mut Colors) {
        by_level(
            level,
            wanted,
            #[inline(always)]
            |index, same| {
                if let Some(level) = self.t.levels.get(index) {
                    self.fill_level(level, same, out);
                }
            },
        );
    }

    /// Of lanes that read the same level.
    #[inline(always)]
    fn fill_level(&mut self, level: &Level, wanted: u64, out: &mut Colors) {
        let at = Spots::new(self.spots, level);
        let shape = Shape::new(&at.spot);
        let [low, [last, bottom]] = [shape.low, shape.high].map(
            #[inline(always)]
            |place| at.texel(place),
        );
        let inside = level.reads(self.simd, low, [last + (LANES as i32 - 1), bottom]);
        let easy = inside.to_bitmask() & wanted;
        let fine = shape.flat.simd_gt(0.0).to_bitmask() & easy;
        if easy & !fine != 0 {
            self.weigh(level, &at, &shape, &COARSE, easy & !fine, out);
        }
        if fine != 0 {
            self.weigh(level, &at, &shape, &FINE, fine, out);
        }
        for i in lanes(wanted & !easy) {
            out[i] = average(level, self.t.wrap, &at.get(i));
        }
    }

    /// Of lanes whose texels can all be read in place.
    #[inline(always)]
    fn weigh<const K: usize>(
        &mut self,
        level: &Level,
        at: &Spots<S>,
        shape: &Shape<f32x16<S>>,
        rule: &Rule<K>,
        wanted: u64,
        out: &mut Colors,
    ) {
        let simd = self.simd;
        let lane = mask32x16::from_bitmask(simd, wanted);
        let zero = i32x16::splat(simd, 0);
        let places = level.places(simd, QUAD);
        let mut gather = Gather::new(simd, level.texels.whole(), wanted, false, self.sheet);
        let [_, low] = shape.low;
        let count = (shape.high[1] - low).to_int::<i32x16<S>>() + 1;
        for r in 0..lane.select(count, zero).reduce_max() {
            let y = low + r as f32;
            let row = shape.row(rule, y);
            let [first, y] = at.texel([row.first, y]);
            let quads = (lane & count.simd_gt(r)).select(row.quads.to_int::<i32x16<S>>(), zero);
            for q in 0..quads.reduce_max() {
                let shift = LANES as i32 * q;
                let [a, b, c, d] = row.weights(row.first + shift as f32);
                let listed = quads.simd_gt(q);
                let pairs = [pair(simd, a, b), pair(simd, c, d)].map(
                    #[inline(always)]
                    |pair| listed.select(pair, zero),
                );
                gather.put(pairs, places.index([first + shift, y]));
            }
        }
        for i in lanes(gather.finish(out)) {
            out[i] = nearest(level, self.t.wrap, &at.get(i));
        }
    }
}
