//! Rings that meet, into trapezoids: horizontal beams between the heights of vertices and
//! crossings.
//!
//! Within a beam no edges cross, so their order at its top and its bottom is the same, and
//! rounding keeps it. Where two edges cross between two heights of the grid, the beam is 1/256
//! pixel high; a rasterizer whose samples lie on the grid has samples at its top only, so nothing
//! is lost by undoing the crossing at its bottom.

use super::grid::GridPoint;
use super::rings::Rings;
use crate::FillRule;
use alloc::vec::Vec;
use core::cmp::Ordering;

/// How many edges may be visited in beams that exist because of crossings.
const CROSSING_BUDGET: usize = 1 << 22;

/// An edge from its upper end down.
#[derive(Debug, Clone, Copy)]
struct Edge {
    top: GridPoint,
    bottom: GridPoint,
    /// +1 if the ring goes down it, −1 if up.
    turn: i64,
}

/// Where an edge is at some height: `whole` + `part`/`height`, with 0 ≤ `part` < `height`.
#[derive(Debug, Clone, Copy)]
struct Position {
    whole: i64,
    part: i64,
    height: i64,
}

impl Position {
    /// Exact: parts and heights are below 2³¹.
    fn cmp(&self, other: &Self) -> Ordering {
        let parts = || (self.part * other.height).cmp(&(other.part * self.height));
        self.whole.cmp(&other.whole).then_with(parts)
    }

    /// The nearest whole number; a half rounds up.
    fn round(&self) -> i64 {
        self.whole + i64::from(2 * self.part >= self.height)
    }
}

impl Edge {
    fn at(&self, y: i64) -> Position {
        let height = self.bottom.y - self.top.y;
        // Below 2³⁰ each, so the product fits.
        let run = (self.bottom.x - self.top.x) * (y - self.top.y);
        let whole = self.top.x + run.div_euclid(height);
        Position { whole, part: run.rem_euclid(height), height }
    }

    /// The height at which two edges that cross do so: rounded down, and whether that is exact.
    fn crossing(&self, other: &Self) -> Option<(i64, bool)> {
        // x = top.x + run·(y − top.y)/rise for both, solved for y over a common denominator.
        let parts = |e: &Self| {
            let (run, rise) = (e.bottom.x - e.top.x, e.bottom.y - e.top.y);
            (i128::from(run), i128::from(rise), i128::from(e.top.x), i128::from(e.top.y))
        };
        let ((run0, rise0, x0, y0), (run1, rise1, x1, y1)) = (parts(self), parts(other));
        let denominator = run0 * rise1 - run1 * rise0;
        if denominator == 0 {
            return None;
        }
        let numerator = (x1 - x0) * rise0 * rise1 + run0 * rise1 * y0 - run1 * rise0 * y1;
        // Of a positive denominator, so that rounding is downwards.
        let (n, d) = (numerator * denominator.signum(), denominator.abs());
        i64::try_from(n.div_euclid(d)).ok().map(|y| (y, n.rem_euclid(d) == 0))
    }
}

/// An edge in a beam, with its exact positions at the top and the bottom.
#[derive(Debug, Clone, Copy)]
struct Strand {
    edge: Edge,
    top: Position,
    bottom: Position,
}

impl Strand {
    fn new(edge: Edge, y0: i64, y1: i64) -> Self {
        Self { edge, top: edge.at(y0), bottom: edge.at(y1) }
    }

    fn order(&self, other: &Self) -> Ordering {
        self.top.cmp(&other.top).then_with(|| self.bottom.cmp(&other.bottom))
    }
}

/// The triangles of what the rings enclose, one after the other.
pub(super) fn triangulate(rings: &Rings, rule: FillRule, mut emit: impl FnMut([GridPoint; 3])) {
    let edges = edges(rings);
    let mut heights: Vec<i64> = rings.points.iter().map(|p| p.y).collect();
    heights.sort_unstable();
    heights.dedup();

    let mut coming = edges.into_iter().peekable();
    let mut active: Vec<Edge> = Vec::new();
    let mut budget = CROSSING_BUDGET;
    let (mut strands, mut cuts) = (Vec::new(), Vec::new());
    for beam in heights.windows(2) {
        let (y0, y1) = (beam[0], beam[1]);
        active.retain(|e| e.bottom.y > y0);
        while let Some(edge) = coming.next_if(|e| e.top.y <= y0) {
            active.push(edge);
        }
        find_crossings(&active, (y0, y1), &mut strands, &mut cuts);
        if cuts.len().saturating_mul(active.len()) > budget {
            cuts.clear();
        }
        budget -= cuts.len() * active.len();
        cuts.push(y1);
        let mut top = y0;
        for &cut in &cuts {
            // Without crossings the strands are in order already.
            if cuts.len() > 1 {
                arrange(&active, (top, cut), &mut strands);
            }
            trapezoids(&strands, (top, cut), rule, &mut emit);
            top = cut;
        }
        // In the order of the sweep line: the next beam has little left to sort.
        active.clear();
        active.extend(strands.iter().map(|s| s.edge));
    }
}

/// All edges that are not level, by their upper ends.
fn edges(rings: &Rings) -> Vec<Edge> {
    let mut edges = Vec::with_capacity(rings.points.len());
    for (_, ring) in rings.iter() {
        for (&a, &b) in ring.iter().zip(ring.iter().cycle().skip(1)) {
            match a.y.cmp(&b.y) {
                Ordering::Less => edges.push(Edge { top: a, bottom: b, turn: 1 }),
                Ordering::Greater => edges.push(Edge { top: b, bottom: a, turn: -1 }),
                Ordering::Equal => {}
            }
        }
    }
    edges.sort_by_key(|e| e.top.y);
    edges
}

/// The strands of a beam from left to right.
fn arrange(active: &[Edge], (y0, y1): (i64, i64), strands: &mut Vec<Strand>) {
    strands.clear();
    strands.extend(active.iter().map(|&e| Strand::new(e, y0, y1)));
    strands.sort_by(Strand::order);
}

/// Arranges a beam, and finds the heights that cut it so that no two edges cross in a piece more
/// than one unit high. Empty if none do.
fn find_crossings(
    active: &[Edge],
    (y0, y1): (i64, i64),
    strands: &mut Vec<Strand>,
    cuts: &mut Vec<i64>,
) {
    cuts.clear();
    arrange(active, (y0, y1), strands);
    if strands.is_sorted_by(|a, b| a.bottom.cmp(&b.bottom).is_le()) || y1 - y0 == 1 {
        return;
    }
    // As many heights as there can be, and as many again before they are sorted.
    let limit = 2 * (y1 - y0) as usize + 1024;
    let mut settled: Vec<Strand> = Vec::with_capacity(strands.len());
    // Insertion by the order at the bottom passes exactly the edges that are crossed.
    for strand in strands.iter() {
        let place = settled.partition_point(|s| s.bottom.cmp(&strand.bottom).is_le());
        for crossed in &settled[place..] {
            if let Some((y, exact)) = crossed.edge.crossing(&strand.edge) {
                cuts.push(y);
                cuts.extend((!exact).then_some(y + 1));
            }
        }
        settled.insert(place, *strand);
        if cuts.len() > limit {
            tidy(cuts, (y0, y1));
        }
    }
    tidy(cuts, (y0, y1));
}

/// Sorts heights, and keeps one of each that lies inside the beam.
fn tidy(cuts: &mut Vec<i64>, (y0, y1): (i64, i64)) {
    cuts.retain(|&y| y0 < y && y < y1);
    cuts.sort_unstable();
    cuts.dedup();
}

/// Emits what is filled in a beam.
fn trapezoids(
    strands: &[Strand],
    (y0, y1): (i64, i64),
    rule: FillRule,
    emit: &mut impl FnMut([GridPoint; 3]),
) {
    let mut bottoms: Vec<i64> = strands.iter().map(|s| s.bottom.round()).collect();
    // Changes nothing unless edges cross in this beam.
    bottoms.sort_unstable();
    let mut winding = 0;
    let mut left = (0, 0);
    for (strand, &bottom) in strands.iter().zip(&bottoms) {
        let here = (strand.top.round(), bottom);
        let was_inside = rule.is_inside(winding);
        winding += strand.edge.turn;
        match (was_inside, rule.is_inside(winding)) {
            (false, true) => left = here,
            (true, false) => trapezoid(left, here, (y0, y1), emit),
            _ => {}
        }
    }
}

/// Emits a trapezoid, given its left and right side by their x at the top and the bottom.
fn trapezoid(
    left: (i64, i64),
    right: (i64, i64),
    (y0, y1): (i64, i64),
    emit: &mut impl FnMut([GridPoint; 3]),
) {
    let at = |x: i64, y: i64| GridPoint { x, y };
    if right.0 > left.0 {
        emit([at(left.0, y0), at(right.0, y0), at(right.1, y1)]);
    }
    if right.1 > left.1 {
        emit([at(left.0, y0), at(right.1, y1), at(left.1, y1)]);
    }
}
