//! The edges of a clip, row of pixels by row of pixels, for sampled coverage.

use super::{Polygon, PolygonEdge};
use crate::polygon::area::Knots;
use crate::polygon::gather::Gathered;
use crate::polygon::samples::RowWinding;
use crate::polygon::steps::Steps;
use crate::polygon::sums::RowSums;
use alloc::vec::Vec;
use scumble_geometry::IntRect;

/// Working memory of the polygon rasterizers.
#[derive(Debug, Clone, Default)]
pub(crate) struct PolygonScratch {
    pub(super) rows: Rows,
    pub(super) winding: RowWinding,
    pub(super) gathered: Gathered,
    /// The winding number at the left side of a row.
    pub(super) left: Steps,
    /// The sums of a few rows.
    pub(super) sums: Vec<RowSums>,
    /// The areas of a row.
    pub(super) areas: Vec<f32>,
    pub(super) knots: Knots,
}

/// The edges that matter to a clip, walked from the top.
///
/// Those wholly left of the clip only tell the winding number at its left side: they become a step
/// function of the height. Those right of it do not matter.
#[derive(Debug, Clone, Default)]
pub(super) struct Rows {
    /// Height and change of the winding number at the clip's left side, by rising height.
    steps: Vec<(i32, i32)>,
    /// How many of them lie above the current row.
    passed: usize,
    /// How many lie above the next row.
    passing: usize,
    /// The winding number at the clip's left side, at the top of the row.
    pub(super) left: i32,
    /// Edges within the clip's columns, by rising y0, and how many have been taken.
    edges: Vec<PolygonEdge>,
    taken: usize,
    /// Those that meet the current row.
    pub(super) active: Vec<PolygonEdge>,
}

impl Rows {
    /// Collects the edges for `clip`, which is not empty.
    pub(super) fn start(&mut self, polygon: &Polygon, clip: IntRect) {
        let (top, bottom) = (clip.y0 * 256, clip.y1 * 256);
        *self = Self {
            steps: core::mem::take(&mut self.steps),
            edges: core::mem::take(&mut self.edges),
            active: core::mem::take(&mut self.active),
            ..Self::default()
        };
        self.steps.clear();
        self.edges.clear();
        self.active.clear();
        polygon.bands.each_in(top, bottom, |e| {
            if e.right() <= clip.x0 * 256 {
                self.steps.push((e.y0, e.winding));
                self.steps.push((e.y1, -e.winding));
            } else if e.left() < clip.x1 * 256 {
                self.edges.push(*e);
            }
            true
        });
        self.edges.sort_unstable_by_key(|e| e.y0);
        self.steps.sort_unstable();
        merge(&mut self.steps);
    }

    /// Moves on to row `y`; rows must rise.
    pub(super) fn advance(&mut self, y: i32) {
        let (top, bottom) = (y * 256, y * 256 + 256);
        self.active.retain(|e| e.y1 > top);
        while let Some(e) = self.edges.get(self.taken).filter(|e| e.y0 < bottom) {
            if e.y1 > top {
                self.active.push(*e);
            }
            self.taken += 1;
        }
        while let Some(step) = self.steps.get(self.passed).filter(|s| s.0 <= top) {
            self.left += step.1;
            self.passed += 1;
        }
        self.passing = self.passed;
        while self.steps.get(self.passing).is_some_and(|s| s.0 < bottom) {
            self.passing += 1;
        }
    }

    /// The changes at the left side strictly inside the row.
    pub(super) fn steps(&self) -> &[(i32, i32)] {
        &self.steps[self.passed..self.passing]
    }

    /// The first row from `y` on, up to `end`, in which anything changes along it: the rows before
    /// that are all inside or all outside.
    pub(super) fn calm_until(&self, y: i32, end: i32) -> i32 {
        if !self.active.is_empty() || self.passing > self.passed {
            return y;
        }
        let edge = self.edges.get(self.taken).map_or(end, |e| e.y0 >> 8);
        let step = self.steps.get(self.passed).map_or(end, |s| s.0 >> 8);
        edge.min(step).clamp(y, end)
    }
}

/// Joins the changes at one height and drops those that cancel.
fn merge(steps: &mut Vec<(i32, i32)>) {
    let mut kept = 0;
    for i in 0..steps.len() {
        let (height, change) = steps[i];
        if kept > 0 && steps[kept - 1].0 == height {
            steps[kept - 1].1 += change;
        } else {
            kept -= usize::from(kept > 0 && steps[kept - 1].1 == 0);
            steps[kept] = (height, change);
            kept += 1;
        }
    }
    kept -= usize::from(kept > 0 && steps[kept - 1].1 == 0);
    steps.truncate(kept);
}
