//! Pyramids made on several threads, each a band of rows of all the finer levels.
//!
//! A band makes again what its neighbours have made of the rows near its ends, and stores only what is
//! its own: bands know nothing of each other, and their rows are those of one thread.

use crate::decode::Decoder;
use crate::engine::{Scalar, Vector};
use crate::format::{Alpha, Channels};
use crate::level::{APRON, Level};
use crate::pyramid::cascade::{Cascade, Kept, Sink};
use crate::pyramid::plan::{Plan, Span};
use crate::pyramid::rung::Course;
use crate::store::Strip;
use crate::texel::Cell;
use crate::{Simd, TextureError};
use alloc::vec::Vec;
use fearless_simd::dispatch;
use rayon::prelude::*;
use scumble_pixel::ImageView;

/// The level down to which bands go: beyond it little is left to do. Or the first that is kept, if that
/// is coarser.
const DEEPEST: usize = 3;

/// Bands for each thread, so that none waits long for the last.
const BANDS: usize = 4;

/// The least rows of a band, in its coarsest level: it makes about seven more.
const LEAST: usize = 16;

/// The rows of the kept levels that are a band's own.
struct Part<'a, T> {
    first: usize,
    /// For each level its rows, their distance, and their memory with the apron.
    levels: Vec<(Span, usize, Strip<'a, T>)>,
}

impl<T: Cell> Sink<T> for Part<'_, T> {
    fn put(&mut self, level: usize, y: usize, from: usize, texels: &[T]) {
        if let Some((rows, stride, strip)) = self.levels.get_mut(level.wrapping_sub(self.first))
            && rows.holds(y)
        {
            strip.put((y - rows.start) * *stride + APRON + from, texels);
        }
    }
}

/// How the rows of a plan without a window are cut.
struct Cuts<'a> {
    plan: &'a Plan,
    /// The coarsest level of the bands.
    deepest: usize,
    /// Rows of a band in it.
    rows: usize,
}

impl<'a> Cuts<'a> {
    /// None if bands are not worth it.
    fn new(plan: &'a Plan, threads: usize) -> Option<Self> {
        let deepest = plan.first.max(DEEPEST).min(plan.levels.len() - 1);
        let height = plan.levels[deepest].size[1];
        let rows = height.div_ceil(BANDS * threads).max(LEAST);
        (threads > 1 && height > rows).then_some(Self { plan, deepest, rows })
    }

    fn count(&self) -> usize {
        self.plan.levels[self.deepest].size[1].div_ceil(self.rows)
    }

    /// The rows of a level that are a band's own; together they are all.
    fn own(&self, band: usize, level: usize) -> Span {
        let height = self.plan.levels[level].size[1];
        let cut = |band: usize| match band {
            band if band == self.count() => height,
            band => (band * self.rows) << (self.deepest - level),
        };
        Span { start: cut(band), end: cut(band + 1) }
    }

    /// The course of a band through the levels.
    fn courses(&self, band: usize) -> Vec<Course> {
        let mut outputs = [0; 2];
        let course = |l: usize| {
            let own = self.own(band, l);
            let mut rows = [own.start as i32, own.end as i32];
            if l < self.deepest
                && let Some([_, taps]) = &self.plan.levels[l].taps
            {
                let needed = taps.rows_of(outputs);
                rows = [rows[0].min(needed[0]), rows[1].max(needed[1])];
            }
            let course = Course { rows, outputs, circular: false };
            outputs = rows;
            course
        };
        let mut courses: Vec<Course> = (0..=self.deepest).rev().map(course).collect();
        courses.reverse();
        courses
    }

    /// The memory of the levels, cut.
    fn parts<'b, T: Cell>(&self, levels: &'b mut [Level]) -> Vec<Part<'b, T>> {
        let first = self.plan.first;
        let part = |_| Part { first, levels: Vec::new() };
        let mut parts: Vec<Part<'b, T>> = (0..self.count()).map(part).collect();
        for (l, level) in (first..=self.deepest).zip(levels) {
            let stride = level.stride;
            let (_, mut rest) = Strip::of(&mut level.texels).split_at(APRON * stride);
            for (band, part) in parts.iter_mut().enumerate() {
                let rows = self.own(band, l);
                let (own, others) = rest.split_at(rows.len() * stride);
                part.levels.push((rows, stride, own));
                rest = others;
            }
        }
        parts
    }
}

/// Fills the levels of a plan without a window on all threads of the pool; says whether it has, or has
/// left them alone because it is not worth it.
pub(crate) fn fill<T: Cell, P: Channels, A: Alpha>(
    view: ImageView<'_, P>,
    decoder: &Decoder<P, A>,
    plan: &Plan,
    levels: &mut [Level],
) -> Result<bool, TextureError> {
    let Some(cuts) = Cuts::new(plan, rayon::current_num_threads()) else { return Ok(false) };
    let make = |(band, mut part): (usize, Part<'_, T>)| {
        let mut cascade = Cascade::<T>::new(plan, 0, &cuts.courses(band))?;
        while let Some(y) = cascade.next() {
            let row = view.row(y);
            match Simd::best().0 {
                None => cascade.push(Scalar, plan, &mut part, decoder, row),
                Some(level) => dispatch!(level, simd => {
                    cascade.push(Vector(simd), plan, &mut part, decoder, row);
                }),
            }
        }
        Ok(())
    };
    cuts.parts::<T>(levels).into_par_iter().enumerate().try_for_each(make)?;
    rest::<T>(plan, cuts.deepest, levels)?;
    Ok(true)
}

/// Fills the levels from the one that follows `base` on.
fn rest<T: Cell>(plan: &Plan, base: usize, levels: &mut [Level]) -> Result<(), TextureError> {
    let (done, levels) = levels.split_at_mut((base + 1 - plan.first).min(levels.len()));
    let Some(source) = done.last_mut() else { return Ok(()) };
    if levels.is_empty() {
        return Ok(());
    }
    let mut cascade = Cascade::<T>::new(plan, base, &plan.courses(base))?;
    let mut kept = Kept { first: base + 1, levels };
    while let Some(y) = cascade.next() {
        let row = source.row::<T>(y).unwrap_or(&[]);
        match Simd::best().0 {
            None => cascade.push_texels(Scalar, plan, &mut kept, row),
            Some(level) => dispatch!(level, simd => {
                cascade.push_texels(Vector(simd), plan, &mut kept, row);
            }),
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use crate::{Decimation, Levels, Storage, Texture, TextureOptions, Wrap};
    use proptest::prelude::*;
    use scumble_pixel::Image;

    /// A texture made on so many threads.
    fn on(threads: usize, image: &Image<[u8; 4]>, options: &TextureOptions) -> Texture {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| Texture::new(image.view(), options)).unwrap()
    }

    proptest! {
        #![proptest_config(ProptestConfig { cases: ProptestConfig::default().cases.min(64), ..ProptestConfig::default() })]
        #[test]
        fn threads_change_nothing(
            (w, h) in (1usize..40, 1usize..1200),
            seed: u8,
            first in 0usize..6,
            all: bool,
            storage in prop::sample::select(vec![Storage::Compact, Storage::Float]),
            decimation in prop::sample::select(vec![Decimation::Kaiser, Decimation::Box]),
            wrap in prop::sample::select(vec![Wrap::Clamp, Wrap::Repeat]),
        ) {
            let levels = if all { Levels::All } else { Levels::Range { first, last: first + 2 } };
            let options =
                TextureOptions { levels, storage, decimation, wrap, ..TextureOptions::default() };
            let image = Image::from_fn(w, h, |x, y| {
                let v = (x * 7919 + y * 104_729 + usize::from(seed)) % 251;
                [v as u8, (v * y) as u8, (v * x) as u8, (255 - v) as u8]
            });
            let image = image.unwrap();
            let one = on(1, &image, &options);
            for threads in [2, 5] {
                let many = on(threads, &image, &options);
                for l in 0..one.level_count() {
                    prop_assert_eq!(one.level(l), many.level(l), "level {} on {}", l, threads);
                }
            }
        }
    }
}
