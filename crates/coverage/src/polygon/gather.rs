//! What area coverage needs to know of a few rows of a clip: the edges that meet each of them, and
//! the winding number at their left side.

use super::eights::{Eights, Rows};
use super::steps::Steps;
use super::strips::AreaEdge;
use super::sums::RowSums;
use super::{Polygon, PolygonEdge};
use crate::area::{Reach, Slope};
use alloc::{vec, vec::Vec};
use core::ops::Range;
use fearless_simd::Simd;

/// Rows that are looked at together: as many as the lowest band of the index has.
pub(super) const ROWS: usize = 1 << super::bands::LEAST_SHIFT;

/// An edge that crosses rows.
#[derive(Debug, Clone, Copy)]
pub(super) struct Source {
    slope: Slope,
    /// Heights in 1/256 pixel.
    top: i32,
    bottom: i32,
    pub(super) winding: i32,
}

impl From<PolygonEdge> for Source {
    #[inline(always)]
    fn from(e: PolygonEdge) -> Self {
        let slope = Slope::new(e.x0, e.y0, e.x1, e.y1);
        Self { slope, top: e.y0, bottom: e.y1, winding: e.winding }
    }
}

impl Source {
    /// The heights between which it runs in row `y`, which it meets, in 1/256 pixel from the top of
    /// the row.
    #[inline(always)]
    pub(super) fn within(&self, y: i32) -> (i32, i32) {
        let top = y * 256;
        (self.top.max(top) - top, self.bottom.min(top + 256) - top)
    }

    /// What there is of it in row `y`.
    #[inline(always)]
    pub(super) fn area_edge(&self, y: i32) -> AreaEdge {
        let (from, to) = self.within(y);
        AreaEdge { slope: self.slope, winding: self.winding, from, to }
    }

    /// Adds it to the sums of those rows that it meets of which not all is known. `place` is its own
    /// among the gathered edges.
    #[inline(always)]
    fn add<S: Simd>(&self, simd: S, place: u32, rows: &mut Rows<'_>) {
        let y0 = rows.y0;
        let top = self.top.max(y0 * 256);
        let bottom = self.bottom.min((y0 + rows.sums.len() as i32) * 256);
        let height = |y: i32| f64::from(y) * (1.0 / 256.0);
        let mut at = top;
        let mut start = height(top);
        let mut from = self.slope.along(start);
        let [first, last] = [top, bottom - 1].map(|y| ((y >> 8) - y0) as usize);
        for row in first..=last {
            let row_top = at & -256;
            let next = bottom.min(row_top + 256);
            let end = height(next);
            let to = self.slope.along(end);
            let Slope { sign, half_rise, .. } = self.slope;
            let reach = Reach { sign, from, to, height: end - start, half_rise };
            if !rows.sums[row].proven {
                let heights = (at - row_top, next - row_top);
                rows.sums[row].add(simd, (place, self.winding), heights, &reach);
            }
            (at, start, from) = (next, end, to);
        }
    }
}

/// Edges that matter to a clip of up to [`ROWS`] rows.
///
/// Those wholly left of the clip only tell the winding number at its left side: they become a step
/// function of the height. Those right of it do not matter.
#[derive(Debug, Clone, Default)]
pub(super) struct Gathered {
    /// Edges within the clip's columns.
    pub(super) edges: Vec<Source>,
    left: LeftSide,
    eights: Eights,
}

/// How the winding number changes along the left side of a clip.
#[derive(Debug, Clone)]
pub(super) struct LeftSide {
    /// By how much it changes at each height, in 1/256 pixel from the top; the last is beyond the
    /// clip.
    changes: Vec<i32>,
    /// One bit for each height at which something was added.
    marked: [u64; ROWS * 4 + 1],
    /// Whether nothing was: most clips have all of their outline.
    is_empty: bool,
}

impl Default for LeftSide {
    fn default() -> Self {
        let changes = vec![0; Self::HEIGHT as usize + 1];
        Self { changes, marked: [0; ROWS * 4 + 1], is_empty: true }
    }
}

impl Gathered {
    /// Adds the edges of a polygon within two columns to the sums of some rows, the first of them row
    /// `y0`, no more than [`ROWS`].
    #[inline(always)]
    pub(super) fn start<S: Simd>(
        &mut self,
        simd: S,
        polygon: &Polygon,
        (x0, x1): (i32, i32),
        (y0, sums): (i32, &mut [RowSums]),
    ) {
        self.edges.clear();
        self.left.clear();
        let mut rows = Rows { y0, sums };
        let (top, bottom) = (y0 * 256, (y0 + rows.sums.len() as i32) * 256);
        let (left, right) = (x0 * 256, x1 * 256 - 1);
        let (edges, steps) = polygon.bands.between(top, (left, right));
        let all_proven = rows.sums.iter().all(|row| row.proven);
        let any_proven = rows.sums.iter().any(|row| row.proven);
        // Then nothing needs to be asked of each edge.
        let is_whole = polygon.bounds.x0 >= x0 && polygon.bounds.x1 <= x1;
        for e in edges {
            if e.y0 >= bottom || e.y1 <= top {
                continue;
            }
            if !is_whole && e.right() < left {
                self.left.add_edge(e, top, bottom);
            } else if is_whole || e.left() <= right {
                if any_proven {
                    self.eights.push(simd, e, &mut rows);
                }
                if !all_proven {
                    let (source, place) = (Source::from(*e), self.edges.len() as u32);
                    source.add(simd, place, &mut rows);
                    self.edges.push(source);
                }
            }
        }
        self.eights.flush(simd, &mut rows);
        for &(height, change) in steps {
            self.left.add(height.clamp(top, bottom) - top, change);
        }
    }

    /// Adds the changes of the winding number in a row, counted from the first.
    #[inline(always)]
    pub(super) fn left_side(&self, row: usize, steps: &mut Steps) {
        if self.left.is_empty {
            return;
        }
        let Range { start, end } = row * 4..row * 4 + 4;
        for (word, &bits) in (start..end).zip(&self.left.marked[start..end]) {
            let mut bits = bits;
            while bits != 0 {
                let height = word * 64 + bits.trailing_zeros() as usize;
                bits &= bits - 1;
                steps.add((height - row * 256) as i32, self.left.changes[height]);
            }
        }
    }
}

impl LeftSide {
    /// How far it reaches, in 1/256 pixel.
    pub(super) const HEIGHT: i32 = ROWS as i32 * 256;

    #[inline(always)]
    pub(super) fn add(&mut self, height: i32, change: i32) {
        let height = height as usize;
        self.is_empty = false;
        self.changes[height] += change;
        self.marked[height / 64] |= 1 << (height % 64);
    }

    /// Adds an edge between the heights `top` and `bottom`.
    #[inline(always)]
    pub(super) fn add_edge(&mut self, e: &PolygonEdge, top: i32, bottom: i32) {
        self.add(e.y0.max(top) - top, e.winding);
        self.add(e.y1.min(bottom) - top, -e.winding);
    }

    /// Names the heights of all changes but the one at the very end, and forgets those that came to
    /// nothing.
    pub(super) fn each(&mut self, mut name: impl FnMut(i32, i32)) {
        for (word, bits) in self.marked.iter_mut().enumerate().take(ROWS * 4) {
            let mut left = *bits;
            while left != 0 {
                let height = word * 64 + left.trailing_zeros() as usize;
                let change = self.changes[height];
                if change == 0 {
                    *bits &= !(1 << (height % 64));
                } else {
                    name(height as i32, change);
                }
                left &= left - 1;
            }
        }
    }

    pub(super) fn clear(&mut self) {
        if core::mem::replace(&mut self.is_empty, true) {
            return;
        }
        for (word, bits) in self.marked.iter_mut().enumerate() {
            while *bits != 0 {
                self.changes[word * 64 + bits.trailing_zeros() as usize] = 0;
                *bits &= *bits - 1;
            }
        }
    }
}
