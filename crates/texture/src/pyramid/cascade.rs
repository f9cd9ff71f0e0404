//! From rows of the image to the rows of all levels, in one go.

use crate::TextureError;
use crate::decode::Decoder;
use crate::format::{Alpha, Channels};
use crate::level::Level;
use crate::memory::zeroed;
use crate::pyramid::filter::{self, Lanes, Line};
use crate::pyramid::plan::{Plan, Span};
use crate::pyramid::rung::{Course, Rung};
use crate::texel::Cell;
use alloc::vec::Vec;

/// Where the rows of the levels go that are kept.
pub(crate) trait Sink<T> {
    /// Takes texels of row `y` of a level, from so many of the columns that are kept on, if the row is kept
    /// here.
    fn put(&mut self, level: usize, y: usize, from: usize, texels: &[T]);
}

/// The levels that a texture keeps, whole.
pub(crate) struct Kept<'a> {
    pub(crate) first: usize,
    pub(crate) levels: &'a mut [Level],
}

impl<T: Cell> Sink<T> for Kept<'_> {
    fn put(&mut self, level: usize, y: usize, from: usize, texels: &[T]) {
        if let Some(level) = self.levels.get_mut(level.wrapping_sub(self.first)) {
            level.put(y, from, texels);
        }
    }
}

/// The rows of all levels that are still needed.
#[derive(Debug, Clone)]
pub(crate) struct Cascade<T> {
    /// The level of the rows that come.
    base: usize,
    rungs: Vec<Rung<T>>,
    line: Line,
}

impl<T: Cell> Cascade<T> {
    /// A cascade for the rows of level `base`, with a course for it and each level that follows.
    pub(crate) fn new(plan: &Plan, base: usize, courses: &[Course]) -> Result<Self, TextureError> {
        let levels = plan.levels[base..].iter();
        let rungs = levels.zip(courses).map(|(level, course)| Rung::new(level, *course));
        let rungs: Vec<Rung<T>> = rungs.collect::<Result<_, _>>()?;
        let longest = plan.levels[base..].iter().map(Line::length).max().unwrap_or(0);
        Ok(Self { base, rungs, line: Line(zeroed(longest)?) })
    }

    /// Which row comes next; none if all have come.
    pub(crate) fn next(&self) -> Option<usize> {
        let rung = self.rungs.first()?;
        (!rung.is_full()).then(|| rung.index())
    }

    /// Takes the next row of the image.
    #[inline(always)]
    pub(crate) fn push<P: Channels, A: Alpha>(
        &mut self,
        lanes: impl Lanes,
        plan: &Plan,
        sink: &mut impl Sink<T>,
        decoder: &Decoder<P, A>,
        row: &[P],
    ) {
        let Some(rung) = self.rungs.first_mut() else { return };
        let Span { start, end } = rung.columns();
        decoder.row(lanes, row.get(start..end).unwrap_or(&[]), rung.slot());
        self.settle(lanes, plan, sink, 0);
    }

    /// Takes the next row of a level as its texels.
    #[cfg(feature = "parallel")]
    #[inline(always)]
    pub(crate) fn push_texels(
        &mut self,
        lanes: impl Lanes,
        plan: &Plan,
        sink: &mut impl Sink<T>,
        row: &[T],
    ) {
        let Some(rung) = self.rungs.first_mut() else { return };
        for (slot, texel) in rung.slot().iter_mut().zip(row) {
            *slot = *texel;
        }
        self.settle(lanes, plan, sink, 0);
    }

    /// Keeps the row that has been put at a rung, and makes what can be made of it.
    #[inline(always)]
    fn settle(&mut self, lanes: impl Lanes, plan: &Plan, sink: &mut impl Sink<T>, at: usize) {
        // A stack of its own for the levels that have come into motion: the rung, again and again.
        let mut at = at;
        self.keep(plan, sink, at);
        loop {
            let level = &plan.levels[self.base + at];
            let ready = level.taps.as_ref().and_then(|[columns, rows]| {
                let output = self.rungs[at].ready(rows)?;
                Some((columns, rows, output))
            });
            match (ready, self.rungs.get_mut(at..at + 2)) {
                (Some((columns, rows, output)), Some([fine, coarse])) => {
                    let to = coarse.columns();
                    filter::make(
                        lanes,
                        fine,
                        [columns, rows],
                        output,
                        &mut self.line,
                        to,
                        coarse.slot(),
                    );
                    fine.made();
                    at += 1;
                    self.keep(plan, sink, at);
                }
                _ if at > 0 => at -= 1,
                _ => return,
            }
        }
    }

    /// Stores the row that has been put at a rung, if it is kept.
    #[inline(always)]
    fn keep(&mut self, plan: &Plan, sink: &mut impl Sink<T>, at: usize) {
        let rung = &mut self.rungs[at];
        let (level, y) = (self.base + at, rung.index());
        if let Some([columns, _]) = plan.levels[level].kept
            && let Some(stored) = plan.levels[level].stored(y)
        {
            let from = stored.start - rung.columns().start;
            let texels = &rung.slot()[from..from + stored.len()];
            sink.put(level, y, stored.start - columns.start, texels);
        }
        rung.advance();
    }
}
