//! Exact area of polygons under a fill rule.
//!
//! Summing signed areas is only right where the winding number is 0 or 1. So an edge adds to the
//! sums with a weight: +1 where the inside begins, −1 where it ends, 0 between inside and inside.
//!
//! The edges of a row of pixels fall into clusters, one beside the other, between which the winding
//! number is the same from the top of the row to its bottom. In most of them the weights are plain:
//! an edge through the whole row, a chain of edges one below the other, or edges side by side that
//! do not cross. The others are cut into strips (see [`super::strips`]).

use super::gather::{Gathered, ROWS};
use super::{Polygon, PolygonEdge, PolygonScratch};
use crate::AreaSink;
use crate::area::{CHUNK, GAP, ROW_CELLS, Reach, Slope, touched};
use alloc::vec::Vec;
use core::cmp::Ordering;
use fearless_simd::{Level, Simd, dispatch};
use scumble_geometry::IntRect;

/// With more edges than this in one row of pixels, the heights where they begin and end are rounded
/// to a power of two times 1/256 pixel, so that the work in a row stays within edges × log(edges).
/// Each edge's part in such a crowded row is then off by no more than that height.
const CROWD: usize = 4096;

/// An edge that meets the current row.
#[derive(Debug, Clone, Copy)]
pub(super) struct AreaEdge {
    pub(super) slope: Slope,
    pub(super) winding: i32,
    /// Within the row, in 1/256 pixel from its top.
    from: i32,
    to: i32,
    pub(super) reach: Reach,
    /// The leftmost and the rightmost x.
    extent: [f64; 2],
    pub(super) pixels: (i32, i32),
}

/// An edge that crosses rows.
#[derive(Debug, Clone, Copy)]
pub(super) struct Source {
    slope: Slope,
    /// Heights in 1/256 pixel.
    top: i32,
    bottom: i32,
    winding: i32,
}

impl From<PolygonEdge> for Source {
    #[inline(always)]
    fn from(e: PolygonEdge) -> Self {
        let slope = Slope::new(e.x0, e.y0, e.x1, e.y1);
        Self { slope, top: e.y0, bottom: e.y1, winding: e.winding }
    }
}

impl Source {
    /// What there is of it in row `y` within the columns of `rect`; heights are rounded to `grain`.
    #[inline(always)]
    fn enter(&self, y: i32, grain: i32, rect: IntRect) -> AreaEdge {
        let within = |height: i32| (height - y * 256).clamp(0, 256);
        let rounded = |height: i32| (within(height) + grain / 2) / grain * grain;
        let rounded = |height: i32| if grain == 1 { within(height) } else { rounded(height) };
        let (from, to) = (rounded(self.top), rounded(self.bottom));
        let (start, end) = heights(y, from, to);
        let reach = self.slope.reach(start, end);
        let extent = reach.extent();
        let pixels = touched(extent, rect.x0, rect.x1);
        AreaEdge { slope: self.slope, winding: self.winding, from, to, reach, extent, pixels }
    }
}

/// Heights in 1/256 pixel from the top of row `y`, in pixels.
#[inline(always)]
fn heights(y: i32, from: i32, to: i32) -> (f64, f64) {
    let height = |within: i32| f64::from(y) + f64::from(within) * (1.0 / 256.0);
    (height(from), height(to))
}

impl AreaEdge {
    /// The heights in pixels between which it runs in row `y`.
    #[inline(always)]
    pub(super) fn heights(&self, y: i32) -> (f64, f64) {
        heights(y, self.from, self.to)
    }

    /// From left to right at `self.from`, those that meet there as they go on; the same for two
    /// edges between the same heights at their bottom.
    fn is_left_of(&self, other: &Self) -> bool {
        let ends = |e: &Self| (e.reach.sign * e.reach.from, e.reach.sign * e.reach.to);
        let (a, b) = (ends(self), ends(other));
        a.0 <= b.0 && a.1 <= b.1
    }
}

/// The edges of a row.
#[derive(Debug, Clone, Default)]
pub(super) struct Entered {
    /// From left to right.
    met: Vec<AreaEdge>,
    unsorted: Vec<AreaEdge>,
    /// The leftmost x and the place of each.
    order: Vec<(f64, u32)>,
}

/// At which heights inside a row the winding number right of the edges so far differs from that at
/// its top.
#[derive(Debug, Clone)]
pub(super) struct Crossings {
    /// By how much it changes at each height, in 1/256 pixel from the top.
    changes: [i32; 257],
    /// How many of them are not 0.
    count: usize,
}

impl Default for Crossings {
    fn default() -> Self {
        Self { changes: [0; 257], count: 0 }
    }
}

impl Crossings {
    #[inline(always)]
    fn add(&mut self, height: i32, change: i32) {
        if height > 0 && height < 256 {
            let at = &mut self.changes[height as usize];
            self.count -= usize::from(*at != 0);
            *at += change;
            self.count += usize::from(*at != 0);
        }
    }

    #[inline(always)]
    fn add_edge(&mut self, e: &AreaEdge) {
        self.add(e.from, e.winding);
        self.add(e.to, -e.winding);
    }

    /// Forgets what the clip has left open.
    fn clear(&mut self) {
        if self.count > 0 {
            *self = Self::default();
        }
    }
}

/// A polygon within a clip that is narrow enough for the sums of a row.
struct Clipped<'a> {
    polygon: &'a Polygon,
    rect: IntRect,
}

impl Polygon {
    /// `region` lies within the bounds and is not empty.
    pub(crate) fn rasterize_area(
        &self,
        region: IntRect,
        level: Level,
        scratch: &mut PolygonScratch,
        sink: &mut impl AreaSink,
    ) {
        let mut x = region.x0;
        while x < region.x1 {
            let end = region.x1.min(x + ROW_CELLS);
            let clipped = Clipped { polygon: self, rect: IntRect { x0: x, x1: end, ..region } };
            dispatch!(level, simd => clipped.rasterize::<_, true>(simd, scratch, sink));
            x = end;
        }
    }
}

impl Clipped<'_> {
    /// With `PLAIN`, plain clusters take the short way; without it all are cut into strips, which
    /// gives the same to the bit.
    #[inline(always)]
    fn rasterize<S: Simd, const PLAIN: bool>(
        &self,
        simd: S,
        scratch: &mut PolygonScratch,
        sink: &mut impl AreaSink,
    ) {
        let rect = self.rect;
        scratch.area.start(rect.x0, rect.x1);
        // Rows that are wholly inside are handed on together.
        let mut inside_from = None;
        let mut y = rect.y0;
        while y < rect.y1 {
            // The bands of the index begin at multiples of their height.
            let end = ((y | (ROWS as i32 - 1)) + 1).min(rect.y1);
            scratch.gathered.start(self.polygon, IntRect { y0: y, y1: end, ..rect });
            let mut left = 0;
            for row in 0..(end - y) as usize {
                scratch.steps.clear();
                left += scratch.gathered.left_side(row, &mut scratch.steps);
                let next = left + scratch.steps.iter().map(|s| s.1).sum::<i32>();
                let y = y + row as i32;
                let calm = scratch.gathered.rows[row].is_empty() && scratch.steps.is_empty();
                if calm && self.polygon.is_inside(left) {
                    inside_from.get_or_insert(y);
                } else if let Some(from) = inside_from.take() {
                    sink.block(IntRect { y0: from, y1: y, ..rect });
                }
                if !calm {
                    self.row::<S, PLAIN>(simd, y, left, row, scratch, sink);
                }
                left = next;
            }
            y = end;
        }
        if let Some(from) = inside_from {
            sink.block(IntRect { y0: from, ..rect });
        }
    }

    /// The edges of row `y`, from left to right.
    #[inline(always)]
    fn enter_row(&self, y: i32, row: usize, gathered: &Gathered, entered: &mut Entered) {
        let places = &gathered.rows[row];
        let grain = (places.len() / CROWD).max(1).next_power_of_two().min(256) as i32;
        let Entered { met, unsorted, order } = entered;
        met.clear();
        let (mut sorted, mut before) = (true, f64::NEG_INFINITY);
        for &i in places {
            let edge = gathered.edges[i as usize].enter(y, grain, self.rect);
            sorted &= before <= edge.extent[0];
            before = edge.extent[0];
            met.push(edge);
        }
        if sorted {
            return;
        }
        // The edges are large: only their places are moved about.
        core::mem::swap(met, unsorted);
        order.clear();
        order.extend((0..).zip(&*unsorted).map(|(i, e)| (e.extent[0], i)));
        sort(order, |a: &(f64, u32), b| a.0.total_cmp(&b.0));
        met.clear();
        met.extend(order.iter().map(|&(_, i)| unsorted[i as usize]));
    }

    /// Hands on row `y`, summed cluster by cluster; `left` is the winding number at the left side of
    /// its top.
    #[inline(always)]
    fn row<S: Simd, const PLAIN: bool>(
        &self,
        simd: S,
        y: i32,
        left: i32,
        row: usize,
        scratch: &mut PolygonScratch,
        sink: &mut impl AreaSink,
    ) {
        let PolygonScratch { gathered, entered, steps, area, crossings, strips, .. } = scratch;
        self.enter_row(y, row, gathered, entered);
        let mut winding = left;
        area.begin(if steps.is_empty() && self.polygon.is_inside(winding) { 1.0 } else { 0.0 });
        for &(height, change) in &*steps {
            crossings.add(height, change);
        }
        let mut edges = &entered.met[..];
        let mut steps = &steps[..];
        while !edges.is_empty() || !steps.is_empty() {
            let (cluster, others) = edges.split_at(cluster(edges, crossings));
            let after = winding + net(cluster);
            let plain = PLAIN && steps.is_empty();
            let weights = plain.then(|| self.weights(cluster, winding, crossings.count == 0));
            match weights.flatten() {
                Some([weight, _])
                    if is_lone(cluster, others) && area.is_beyond(cluster[0].pixels.0) =>
                {
                    let e = &cluster[0];
                    if weight != 0 {
                        area.add_lone(simd, y, &e.reach, e.pixels, f64::from(weight), sink);
                    }
                }
                Some(weights) => {
                    for (i, e) in cluster.iter().enumerate() {
                        let weight = if i == 0 { weights[0] } else { weights[1] };
                        if weight != 0 && e.from < e.to {
                            area.open(simd, y, e.pixels, sink);
                            area.add(simd, &e.reach, e.pixels, f64::from(weight));
                        }
                    }
                }
                None => {
                    let last = cluster.iter().map(|e| e.pixels.1).max();
                    if let (Some(first), Some(last)) = (cluster.first(), last) {
                        area.open(simd, y, (first.pixels.0, last), sink);
                    }
                    strips.add(simd, self.polygon, y, (cluster, winding, steps), area);
                }
            }
            (edges, winding, steps) = (others, after, &[]);
        }
        crossings.clear();
        area.finish(simd, y, sink);
    }

    /// The weight of the first edge and that of the others, if the cluster is a plain one.
    #[inline(always)]
    fn weights(&self, cluster: &[AreaEdge], before: i32, complete: bool) -> Option<[i32; 2]> {
        let weight = |from: i32, to: i32| {
            i32::from(self.polygon.is_inside(to)) - i32::from(self.polygon.is_inside(from))
        };
        let (first, others) = cluster.split_first()?;
        let after = before + first.winding;
        if others.is_empty() && (first.from, first.to) == (0, 256) {
            return Some([weight(before, after); 2]);
        }
        if let [second] = others
            && (first.from, first.to) == (second.from, second.to)
        {
            // Side by side; the one that begins further left at its leftmost x need not be the
            // left one.
            let then = after + second.winding;
            if first.is_left_of(second) {
                return Some([weight(before, after), weight(after, then)]);
            }
            if second.is_left_of(first) {
                let between = before + second.winding;
                return Some([weight(between, then), weight(before, between)]);
            }
            return None;
        }
        // One below the other: in a complete cluster, edges of one winding that fill the height of
        // the row leave no gap and do not overlap.
        let height: i32 = cluster.iter().map(|e| e.to - e.from).sum();
        (complete && height == 256 && others.iter().all(|e| e.winding == first.winding))
            .then(|| [weight(before, after); 2])
    }
}

/// How many edges make the next cluster: as many as it takes until no edge crosses a later one, and
/// until the winding number right of them is the same all the way down.
#[inline(always)]
fn cluster(edges: &[AreaEdge], crossings: &mut Crossings) -> usize {
    let mut right = f64::NEG_INFINITY;
    for (i, e) in edges.iter().enumerate() {
        if e.extent[0] >= right && crossings.count == 0 && i > 0 {
            return i;
        }
        crossings.add_edge(e);
        right = right.max(e.extent[1]);
    }
    edges.len()
}

/// Whether the cluster is a single edge that touches few pixels, and no edge comes next to it.
#[inline(always)]
fn is_lone(cluster: &[AreaEdge], others: &[AreaEdge]) -> bool {
    let [e] = cluster else { return false };
    let (first, last) = e.pixels;
    last - first < CHUNK && others.first().is_none_or(|o| o.pixels.0 > last + GAP)
}

/// By how much the winding number right of the edges differs from that left of them, at the top of
/// the row.
#[inline(always)]
fn net(edges: &[AreaEdge]) -> i32 {
    edges.iter().filter(|e| e.from == 0 && e.to > 0).map(|e| e.winding).sum()
}

/// Sorts what is nearly sorted.
#[inline(always)]
pub(super) fn sort<T: Copy>(values: &mut [T], order: impl Fn(&T, &T) -> Ordering) {
    // Few, or hardly any out of place: insertion. Otherwise not.
    if values.len() > 32 {
        if !values.is_sorted_by(|a, b| order(a, b).is_le()) {
            values.sort_unstable_by(order);
        }
        return;
    }
    for i in 1..values.len() {
        let value = values[i];
        let mut j = i;
        while j > 0 && order(&values[j - 1], &value).is_gt() {
            values[j] = values[j - 1];
            j -= 1;
        }
        values[j] = value;
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::FixedPoint;
    use alloc::vec::Vec;
    use proptest::prelude::*;
    use scumble_geometry::FillRule;

    /// What a sink hears of each pixel.
    #[derive(Default, PartialEq, Debug)]
    struct Areas(Vec<(i32, i32, f32)>);

    impl AreaSink for Areas {
        fn run(&mut self, y: i32, x0: i32, x1: i32) {
            (x0..x1).for_each(|x| self.pixel(x, y, 1.0));
        }
        fn pixel(&mut self, x: i32, y: i32, area: f32) {
            self.0.push((x, y, area));
        }
    }

    proptest! {
        #[test]
        fn the_short_way_gives_the_same_bits(
            contours in prop::collection::vec(
                prop::collection::vec((-600..5000i32, -200..2500i32), 3..9),
                1..4,
            ),
            even_odd in any::<bool>(),
            grid in 0..8u32,
        ) {
            let mut builder = Polygon::builder();
            for contour in &contours {
                contour
                    .iter()
                    .for_each(|p| builder.push(FixedPoint { x: p.0 >> grid << grid, y: p.1 >> grid << grid }));
                builder.close();
            }
            let rule = if even_odd { FillRule::EvenOdd } else { FillRule::NonZero };
            let Some(polygon) = builder.finish(rule) else { return Ok(()) };
            for rect in [polygon.bounds(), IntRect::new(3, 0, 11, 8)] {
                let rect = rect.intersect(&polygon.bounds());
                if rect.is_empty() {
                    continue;
                }
                let clipped = Clipped { polygon: &polygon, rect };
                let mut scratch = PolygonScratch::default();
                let (mut short, mut long) = (Areas::default(), Areas::default());
                dispatch!(Level::new(), simd => {
                    clipped.rasterize::<_, true>(simd, &mut scratch, &mut short);
                    clipped.rasterize::<_, false>(simd, &mut scratch, &mut long);
                });
                prop_assert_eq!(short, long);
            }
        }

        #[test]
        fn a_clip_of_many_edges_changes_nothing(
            points in prop::collection::vec((-600..200_000i32, -200..9000i32), 100..300),
            reach in 1..20_000i32,
            even_odd in any::<bool>(),
            (width, height, dx, dy) in (20..90i32, 5..40i32, 0..5i32, 0..5i32),
        ) {
            // Short edges and long ones.
            let mut builder = Polygon::builder();
            let mut at = FixedPoint { x: 0, y: 0 };
            for (i, p) in points.iter().enumerate() {
                let near = |from: i32, to: i32| from + (to - from).clamp(-reach, reach);
                at = if i % 50 == 0 {
                    FixedPoint { x: p.0, y: p.1 }
                } else {
                    FixedPoint { x: near(at.x, p.0), y: near(at.y, p.1) }
                };
                builder.push(at);
            }
            builder.close();
            let rule = if even_odd { FillRule::EvenOdd } else { FillRule::NonZero };
            let Some(polygon) = builder.finish(rule) else { return Ok(()) };
            let bounds = polygon.bounds();
            let mut scratch = PolygonScratch::default();
            let mut areas = |regions: &mut dyn Iterator<Item = IntRect>| {
                let mut all = Areas::default();
                for region in regions.filter(|r| !r.is_empty()) {
                    polygon.rasterize_area(region, Level::new(), &mut scratch, &mut all);
                }
                all.0.retain(|p| p.2 > 0.0);
                all.0.sort_by_key(|p| (p.1, p.0));
                all
            };
            let whole = areas(&mut core::iter::once(bounds));
            let mut tiles = Vec::new();
            for y in (bounds.y0 - dy..bounds.y1).step_by(height as usize) {
                for x in (bounds.x0 - dx..bounds.x1).step_by(width as usize) {
                    tiles.push(IntRect::new(x, y, x + width, y + height).intersect(&bounds));
                }
            }
            prop_assert_eq!(whole, areas(&mut tiles.into_iter()));
        }
    }
}
