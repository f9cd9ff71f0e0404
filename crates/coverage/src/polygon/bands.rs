//! An index of edges: which of them meet a band of rows.

use super::PolygonEdge;
use alloc::{vec, vec::Vec};

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
}

impl Bands {
    /// Lists edges that meet the rows `y0..y1` and no others.
    pub(super) fn new(edges: Vec<PolygonEdge>, y0: i32, y1: i32) -> Self {
        let shift = shift(&edges, y0, y1);
        let first = y0 >> shift;
        let count = (((y1 - 1) >> shift) - first + 1) as usize;
        if count == 1 {
            return Self { shift, first, starts: vec![0, edges.len() as u32], edges };
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
        Self { shift, first, starts, edges: listed }
    }

    /// Each edge that meets the heights `top..bottom` (1/256 pixel) once, in no order.
    #[inline(always)]
    pub(super) fn edges_in(&self, top: i32, bottom: i32) -> impl Iterator<Item = &PolygonEdge> {
        let shift = 8 + self.shift;
        let count = self.starts.len() as i32 - 1;
        let band = |y: i32| ((y >> shift) - self.first).clamp(0, count - 1) as usize;
        let (from, to) = (band(top), band(bottom - 1));
        (from..=to).flat_map(move |b| {
            // Those that begin above it were listed in the band before.
            let begin = if b == from { i32::MIN } else { (self.first + b as i32) << shift };
            self.edges[self.starts[b] as usize..self.starts[b + 1] as usize]
                .iter()
                .filter(move |e| e.y0 >= begin && e.y0 < bottom && e.y1 > top)
        })
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
            let bands = Bands::new(edges.clone(), y0, y1);
            prop_assert!(bands.edges.len() <= 3 * edges.len() + SLACK);
            let (top, bottom) = (top << stretch, (top + height) << stretch);
            let mut found: Vec<_> = bands.edges_in(top, bottom).map(|e| e.x0).collect();
            found.sort_unstable();
            let expected: Vec<_> =
                edges.iter().filter(|e| e.y0 < bottom && e.y1 > top).map(|e| e.x0).collect();
            prop_assert_eq!(found, expected);
        }
    }
}
