//! An index of edges: which of them meet a band of rows.

use super::PolygonEdge;
use super::gather::LeftSide;
use alloc::{vec, vec::Vec};
use scumble_geometry::IntRect;

/// The least height of a band: 2⁴ rows.
pub(super) const LEAST_SHIFT: u32 = 4;

/// How many bands and how many edges listed again a polygon may have beside one for each edge.
const SLACK: usize = 64;

/// The edges of a polygon, listed by bands of rows. An edge is listed in each band that it meets.
///
/// A polygon has no more bands than edges (and a few), and as many edges listed again: where long
/// edges would need more, the bands are higher.
#[derive(Debug, Clone)]
pub(super) struct Bands {
    /// Band b has the rows y with y >> `shift` = `first` + b.
    shift: u32,
    first: i32,
    /// Per band, where its edges begin in the list, and the end of them all.
    starts: Vec<u32>,
    edges: Vec<PolygonEdge>,
    /// Only of a wide polygon with many edges in low bands.
    columns: Option<Columns>,
}

/// In a polygon no wider than this, in pixels, it takes less time to look at all edges of a band
/// for each tile than to sort them.
const NARROW: u32 = 512;

/// As many edges of a band are looked at for each tile rather than sorted.
const CROWD: usize = 256;

/// Edges of a band between two marks, at least; more where the steps to keep are more.
const STRIDE: usize = 32;

/// An index of the edges of each band from left to right: by their rightmost x.
#[derive(Debug, Clone)]
struct Columns {
    /// Per band, where its marks begin in the list, and the end of them all.
    starts: Vec<u32>,
    /// In the order of the edges, and one at the end of them.
    marks: Vec<Mark>,
    /// The changes of the winding number (height in 1/256 pixel, change) right of all edges before
    /// a mark, mark after mark.
    steps: Vec<(i32, i32)>,
}

/// A place in the list of edges.
#[derive(Debug, Clone, Copy)]
struct Mark {
    edge: u32,
    /// Where its steps begin.
    step: u32,
    /// The leftmost x of the edges from here on, to the end of the band.
    left: i32,
}

impl Columns {
    /// Sorts the edges of each band.
    fn new(shift: u32, first: i32, starts: &[u32], edges: &mut [PolygonEdge]) -> Option<Self> {
        let crowded = starts.windows(2).any(|s| (s[1] - s[0]) as usize > CROWD);
        if shift != LEAST_SHIFT || !crowded {
            return None;
        }
        let mut columns =
            Self { starts: Vec::with_capacity(starts.len()), marks: Vec::new(), steps: Vec::new() };
        let mut side = LeftSide::default();
        for (b, range) in starts.windows(2).enumerate() {
            let top = (first + b as i32) << (8 + shift);
            columns.starts.push(columns.marks.len() as u32);
            let band = &mut edges[range[0] as usize..range[1] as usize];
            band.sort_unstable_by_key(PolygonEdge::right);
            columns.mark(band, range[0], top, &mut side);
        }
        columns.starts.push(columns.marks.len() as u32);
        columns.push_mark(edges.len() as u32, i32::MAX);
        Some(columns)
    }

    fn push_mark(&mut self, edge: u32, left: i32) {
        self.marks.push(Mark { edge, step: self.steps.len() as u32, left });
    }

    /// Marks a band that begins at height `top` and at edge `first` of the list.
    fn mark(&mut self, band: &[PolygonEdge], first: u32, top: i32, side: &mut LeftSide) {
        side.clear();
        let from = self.marks.len();
        self.push_mark(first, i32::MAX);
        let (mut marked, mut wanted) = (0, STRIDE);
        for (i, e) in band.iter().enumerate() {
            if i == wanted {
                let before = self.steps.len();
                self.push_mark(first + i as u32, i32::MAX);
                side.each(|height, change| self.steps.push((height + top, change)));
                // So that there are no more steps than edges.
                if self.steps.len() - before > i - marked {
                    self.steps.truncate(before);
                    self.marks.pop();
                } else {
                    marked = i;
                }
                wanted += STRIDE;
            }
            side.add_edge(e, top, top + LeftSide::HEIGHT);
        }
        let mut left = i32::MAX;
        let mut end = band.len();
        for mark in self.marks[from..].iter_mut().rev() {
            let start = (mark.edge - first) as usize;
            left = band[start..end].iter().map(PolygonEdge::left).fold(left, i32::min);
            (mark.left, end) = (left, start);
        }
    }
}

impl Bands {
    /// Lists edges that lie within `bounds`.
    pub(super) fn new(edges: Vec<PolygonEdge>, bounds: IntRect) -> Self {
        let IntRect { y0, y1, .. } = bounds;
        let is_wide = bounds.width() > NARROW;
        let shift = shift(&edges, y0, y1);
        let first = y0 >> shift;
        let count = (((y1 - 1) >> shift) - first + 1) as usize;
        if count == 1 {
            return Self::sorted(shift, first, vec![0, edges.len() as u32], edges, is_wide);
        }
        let range = |e: &PolygonEdge| {
            let band = |y: i32| ((y >> (8 + shift)) - first) as usize;
            band(e.y0)..band(e.y1 - 1) + 1
        };
        let mut starts = vec![0u32; count + 1];
        for e in &edges {
            starts[range(e)].iter_mut().for_each(|n| *n += 1);
        }
        let mut total = 0;
        for start in &mut starts {
            total += core::mem::replace(start, total);
        }
        // Each is filled from its start on; so in the end each start is the next one's.
        let mut listed = vec![PolygonEdge::default(); total as usize];
        for e in &edges {
            for place in &mut starts[range(e)] {
                listed[*place as usize] = *e;
                *place += 1;
            }
        }
        starts.rotate_right(1);
        starts[0] = 0;
        Self::sorted(shift, first, starts, listed, is_wide)
    }

    fn sorted(
        shift: u32,
        first: i32,
        starts: Vec<u32>,
        mut edges: Vec<PolygonEdge>,
        is_wide: bool,
    ) -> Self {
        let columns = if is_wide { Columns::new(shift, first, &starts, &mut edges) } else { None };
        Self { shift, first, starts, edges, columns }
    }

    /// Edges among which are all that meet the heights from `top` on, to the end of the band, and do not
    /// lie wholly left of `left` or right of `right`; and the changes of the winding number (height,
    /// change) of those that do lie left of `left` and are not among them.
    pub(super) fn between(
        &self,
        top: i32,
        (left, right): (i32, i32),
    ) -> (&[PolygonEdge], &[(i32, i32)]) {
        let b = ((top >> (8 + self.shift)) - self.first) as usize;
        let Some(columns) = &self.columns else {
            return (&self.edges[self.starts[b] as usize..self.starts[b + 1] as usize], &[]);
        };
        let (from, end) = (columns.starts[b] as usize, columns.starts[b + 1] as usize);
        let passed = |mark: &Mark| self.edges[mark.edge as usize - 1].right() < left;
        let from = from + columns.marks[from + 1..end].partition_point(passed);
        let to = from + columns.marks[from..end].partition_point(|mark| mark.left <= right);
        let [from, next, to] = [from, from + 1, to].map(|i| &columns.marks[i]);
        let edges = &self.edges[from.edge as usize..to.edge as usize];
        (edges, &columns.steps[from.step as usize..next.step as usize])
    }

    /// Hands on each edge that meets the heights `top..bottom` (1/256 pixel) once, in no order,
    /// as long as it is wanted.
    #[inline(always)]
    pub(super) fn each_in(
        &self,
        top: i32,
        bottom: i32,
        mut wants: impl FnMut(&PolygonEdge) -> bool,
    ) {
        let shift = 8 + self.shift;
        let count = self.starts.len() as i32 - 1;
        let band = |y: i32| ((y >> shift) - self.first).clamp(0, count - 1) as usize;
        let (from, to) = (band(top), band(bottom - 1));
        for b in from..=to {
            // Those that begin above it were listed in the band before.
            let begin = if b == from { i32::MIN } else { (self.first + b as i32) << shift };
            for e in &self.edges[self.starts[b] as usize..self.starts[b + 1] as usize] {
                if e.y0 >= begin && e.y0 < bottom && e.y1 > top && !wants(e) {
                    return;
                }
            }
        }
    }
}

/// The height of the bands: the least that keeps the index small.
fn shift(edges: &[PolygonEdge], y0: i32, y1: i32) -> u32 {
    let most = (edges.len() + SLACK) as u64;
    let rows: u64 = edges.iter().map(|e| (e.y1.abs_diff(e.y0) >> 8) as u64).sum();
    // Each begins in one band and may end in one more.
    let fits = |shift: u32| (rows >> shift).max(u64::from(y1.abs_diff(y0) >> shift)) <= most;
    (LEAST_SHIFT..31).find(|&shift| fits(shift)).unwrap_or(31)
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn each_edge_is_found_once(
            ends in prop::collection::vec((-90_000..90_000i32, 1..90_000i32), 1..40),
            stretch in 0..10u32,
            (top, height) in (-100_000..100_000i32, 1..50_000i32),
        ) {
            let edges: Vec<_> = (0..).zip(&ends).map(|(i, &(y0, height))| {
                let (y0, y1) = (y0 << stretch, (y0 + height) << stretch);
                PolygonEdge { x0: i, y0, x1: i, y1, winding: 1 }
            }).collect();
            let y0 = edges.iter().map(|e| e.y0 >> 8).min().unwrap_or(0);
            let y1 = edges.iter().map(|e| ((e.y1 - 1) >> 8) + 1).max().unwrap_or(0);
            let bands = Bands::new(edges.clone(), IntRect::new(0, y0, 40, y1));
            prop_assert!(bands.edges.len() <= 3 * edges.len() + SLACK);
            let (top, bottom) = (top << stretch, (top + height) << stretch);
            let mut found = Vec::new();
            bands.each_in(top, bottom, |e| {
                found.push(e.x0);
                true
            });
            found.sort_unstable();
            let expected: Vec<_> =
                edges.iter().filter(|e| e.y0 < bottom && e.y1 > top).map(|e| e.x0).collect();
            prop_assert_eq!(found, expected);
        }
    }
}
