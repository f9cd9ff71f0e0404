//! What area coverage needs to know of a few rows of a clip: the edges that meet each of them, and
//! the winding number at their left side.

use super::Polygon;
use super::area::Source;
use alloc::{vec, vec::Vec};
use core::ops::Range;
use scumble_geometry::IntRect;

/// Rows that are looked at together: as many as the lowest band of the index has.
pub(super) const ROWS: usize = 1 << super::bands::LEAST_SHIFT;

/// Edges that matter to a clip of up to [`ROWS`] rows.
///
/// Those wholly left of the clip only tell the winding number at its left side: they become a step
/// function of the height. Those right of it do not matter.
#[derive(Debug, Clone)]
pub(super) struct Gathered {
    /// Edges within the clip's columns.
    pub(super) edges: Vec<Source>,
    /// Per row, the places of those that meet it.
    pub(super) rows: [Vec<u32>; ROWS],
    left: LeftSide,
}

/// The winding number at the left side of a clip.
#[derive(Debug, Clone)]
struct LeftSide {
    /// By how much it changes at each height, in 1/256 pixel from the top; the last is beyond the
    /// clip.
    changes: Vec<i32>,
    /// One bit for each height at which something was added.
    marked: [u64; ROWS * 4 + 1],
}

impl Default for Gathered {
    fn default() -> Self {
        Self {
            edges: Vec::new(),
            rows: Default::default(),
            left: LeftSide { changes: vec![0; ROWS * 256 + 1], marked: [0; ROWS * 4 + 1] },
        }
    }
}

impl Gathered {
    /// Collects the edges for `clip`, which has no more than [`ROWS`] rows.
    #[inline(always)]
    pub(super) fn start(&mut self, polygon: &Polygon, clip: IntRect) {
        self.edges.clear();
        self.rows.iter_mut().for_each(Vec::clear);
        self.left.clear();
        let (top, bottom) = (clip.y0 * 256, clip.y1 * 256);
        let (left, right) = (clip.x0 * 256, clip.x1 * 256 - 1);
        for e in polygon.bands.edges_in(top, bottom) {
            let (from, to) = (e.y0.max(top) - top, e.y1.min(bottom) - top);
            if e.right() <= left {
                self.left.add(from, e.winding);
                self.left.add(to, -e.winding);
            } else if e.left() <= right {
                let index = self.edges.len() as u32;
                self.edges.push(Source::from(*e));
                let rows = (from >> 8) as usize..((to - 1) >> 8) as usize + 1;
                self.rows[rows].iter_mut().for_each(|row| row.push(index));
            }
        }
    }

    /// The change of the winding number at the top of a row, counted from the first; those strictly
    /// inside it (height in 1/256 pixel from the row's top, change) are appended to `steps`.
    #[inline(always)]
    pub(super) fn left_side(&self, row: usize, steps: &mut Vec<(i32, i32)>) -> i32 {
        let Range { start, end } = row * 4..row * 4 + 4;
        for (word, &bits) in (start..end).zip(&self.left.marked[start..end]) {
            let mut bits = if word == start { bits & !1 } else { bits };
            while bits != 0 {
                let height = word * 64 + bits.trailing_zeros() as usize;
                bits &= bits - 1;
                let change = self.left.changes[height];
                if change != 0 {
                    steps.push(((height - row * 256) as i32, change));
                }
            }
        }
        self.left.changes[row * 256]
    }
}

impl LeftSide {
    #[inline(always)]
    fn add(&mut self, height: i32, change: i32) {
        let height = height as usize;
        self.changes[height] += change;
        self.marked[height / 64] |= 1 << (height % 64);
    }

    fn clear(&mut self) {
        for (word, bits) in self.marked.iter_mut().enumerate() {
            while *bits != 0 {
                self.changes[word * 64 + bits.trailing_zeros() as usize] = 0;
                *bits &= *bits - 1;
            }
        }
    }
}
