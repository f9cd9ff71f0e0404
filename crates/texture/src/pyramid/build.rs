//! Pyramids made of rows that come, or of an image that is there.

use crate::decode::Decoder;
use crate::engine::{Scalar, Vector};
use crate::format::{Alpha, Channels};
use crate::level::Level;
#[cfg(feature = "parallel")]
use crate::pyramid::bands;
use crate::pyramid::cascade::{Cascade, Kept};
use crate::pyramid::plan::{LevelPlan, Plan};
use crate::pyramid::rung::Course;
use crate::store::{Code, has_code};
use crate::texel::Cell;
use crate::{Simd, TextureError, TextureOptions};
use alloc::vec::Vec;
use core::ops::Range;
use fearless_simd::dispatch;
use scumble_pixel::ImageView;

/// A pyramid that takes the rows of its image one after the other.
#[derive(Debug, Clone)]
pub(crate) struct Making<T> {
    plan: Plan,
    cascade: Cascade<T>,
    levels: Vec<Level>,
    simd: Simd,
}

impl<T: Cell> Making<T> {
    /// Of an image that passes [`check`](crate::pyramid::plan::check), in the memory of other levels. `coded`
    /// says that all its texels have codes.
    pub(crate) fn new(
        size: [usize; 2],
        options: &TextureOptions,
        coded: bool,
        old: Vec<Level>,
    ) -> Result<Self, TextureError> {
        let plan = Plan::new(size, options);
        let levels = plan.empty::<T>(options, coded, old)?;
        let cascade = Cascade::new(&plan, 0, &plan.courses(0))?;
        Ok(Self { plan, cascade, levels, simd: Simd::best() })
    }

    /// The row that must come next; none if all have come.
    pub(crate) fn next(&self) -> Option<usize> {
        self.cascade.next()
    }

    /// Takes the row that must come next.
    pub(crate) fn push<P: Channels, A: Alpha>(&mut self, decoder: &Decoder<P, A>, row: &[P]) {
        let Self { plan, cascade, levels, simd } = self;
        let mut kept = Kept { first: plan.first, levels };
        match simd.0 {
            None => cascade.push(Scalar, plan, &mut kept, decoder, row),
            Some(level) => dispatch!(level, simd => {
                cascade.push(Vector(simd), plan, &mut kept, decoder, row);
            }),
        }
    }

    /// The rows of the image that matter.
    pub(crate) fn rows(&self) -> Range<usize> {
        let rows = self.plan.levels[0].made[1];
        rows.start..rows.end
    }

    /// The levels that are kept, once all rows have come.
    pub(crate) fn finish(self) -> Vec<Level> {
        self.levels
    }
}

/// The levels of an image that is there.
pub(crate) fn image<T: Cell, P: Channels, A: Alpha>(
    view: ImageView<'_, P>,
    decoder: &Decoder<P, A>,
    options: &TextureOptions,
    coded: bool,
    old: Vec<Level>,
) -> Result<Vec<Level>, TextureError> {
    let mut making = Making::<T>::new([view.width(), view.height()], options, coded, old)?;
    #[cfg(feature = "parallel")]
    if making.plan.is_whole()
        && bands::fill::<T, P, A>(view, decoder, &making.plan, &mut making.levels)?
    {
        return Ok(making.finish());
    }
    while let Some(y) = making.next() {
        making.push(decoder, view.row(y));
    }
    Ok(making.finish())
}

impl Plan {
    /// The levels to be kept, without meaning yet, in the memory of others. `coded` says that all texels of
    /// the image have codes: what is beyond it must have them too, for its level to be kept in them.
    pub(crate) fn empty<T: Cell>(
        &self,
        options: &TextureOptions,
        coded: bool,
        old: Vec<Level>,
    ) -> Result<Vec<Level>, TextureError> {
        let mut old = old.into_iter();
        let image = self.levels[0].size;
        let coded = coded && has_code(options.wrap.border());
        let level = |(l, plan): (usize, &LevelPlan)| {
            let part = plan.kept?;
            let level = if coded && l == 0 {
                Level::new::<Code>(plan.size, part, old.next())
            } else {
                Level::new::<T>(plan.size, part, old.next())
            };
            Some(level.map(|level| level.over(image, options.decimation.variance())))
        };
        self.levels.iter().enumerate().filter_map(level).collect()
    }

    /// The course of every level from `base` on where all its rows come in turn.
    pub(crate) fn courses(&self, base: usize) -> Vec<Course> {
        let mut begin = 0;
        let course = |(l, level): (usize, &LevelPlan)| {
            let next = self.levels.get(l + 1).map_or(level.made[1], |next| next.made[1]);
            let mut outputs = [next.start as i32, next.end as i32];
            if !self.circular {
                let rows = [level.made[1].start as i32, level.made[1].end as i32];
                return Course { rows, outputs, circular: false };
            }
            let rows = [begin, begin + level.size[1] as i32];
            if let Some([_, taps]) = &level.taps {
                // The first output whose rows have all come yet.
                begin = (0..).find(|i| taps.first(*i) >= rows[0]).unwrap_or(0);
                outputs = [begin, begin + taps.outputs as i32];
                begin %= taps.outputs as i32;
            }
            Course { rows, outputs, circular: true }
        };
        self.levels.iter().enumerate().skip(base).map(course).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::store::Store;
    use crate::texel::Texel;
    use crate::{Decimation, StraightAlpha, TexelFormat, Wrap};
    use proptest::prelude::*;
    use scumble_pixel::WorkingSpace;

    fn levels<P: Channels>(
        [w, h]: [usize; 2],
        pixels: &[P],
        options: &TextureOptions,
        simd: Simd,
    ) -> Vec<Vec<Texel>> {
        let format = TexelFormat::<P, StraightAlpha>::straight();
        let decoder = Decoder::new(format, options.space, w * h);
        let coded = decoder.has_codes(|| !P::ALPHA);
        let mut making = Making::<Texel>::new([w, h], options, coded, Vec::new()).unwrap();
        making.simd = simd;
        while let Some(y) = making.next() {
            making.push(&decoder, &pixels[y * w..][..w]);
        }
        let texels =
            |store: &Store| (0..).map_while(|i| Some(store.whole().run::<1>(i)?[0])).collect();
        making.finish().iter().map(|level| texels(&level.texels)).collect()
    }

    fn agree<P: Channels>(size: [usize; 2], pixels: &[P], options: &TextureOptions) {
        let scalar = levels(size, pixels, options, Simd::SCALAR);
        for simd in Simd::all() {
            assert_eq!(levels(size, pixels, options, simd), scalar, "{simd:?} {options:?}");
        }
    }

    proptest! {
        #[test]
        fn every_instruction_set_makes_the_same_levels(
            (w, h) in prop_oneof![(1usize..80, 1usize..50), Just((64, 64)), Just((136, 12))],
            pixels in prop::collection::vec(any::<[u8; 4]>(), 80 * 64),
            linear: bool,
            kaiser: bool,
            repeat: bool,
        ) {
            let options = TextureOptions {
                space: if linear { WorkingSpace::Linear } else { WorkingSpace::Srgb },
                decimation: if kaiser { Decimation::Kaiser } else { Decimation::Box },
                wrap: if repeat { Wrap::Repeat } else { Wrap::Clamp },
                ..TextureOptions::default()
            };
            let pixels = &pixels[..w * h];
            agree([w, h], pixels, &options);
            let opaque: Vec<[u8; 4]> = pixels.iter().map(|&[r, g, b, _]| [r, g, b, 255]).collect();
            agree([w, h], &opaque, &options);
            let colors: Vec<[u8; 3]> = pixels.iter().map(|&[r, g, b, _]| [r, g, b]).collect();
            agree([w, h], &colors, &options);
            prop_assert_eq!(
                levels([w, h], &opaque, &options, Simd::best()),
                levels([w, h], &colors, &options, Simd::best())
            );
        }
    }
}
