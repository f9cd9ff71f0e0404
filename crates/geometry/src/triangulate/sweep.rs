//! Do the rings cross or touch? If not, which of them bound what is filled?
//!
//! Shamos & Hoey's sweep (1976): a line goes from top to bottom over the vertices and keeps the
//! edges that it crosses in order; two edges are tested as they become neighbours. All in exact
//! arithmetic, so that the order is never wrong as long as nothing has crossed yet.

use super::grid::{GridPoint, orient};
use super::rings::Rings;
use crate::FillRule;
use alloc::vec::Vec;

/// Rings with the neighbours of each vertex at hand. Edge i goes from vertex i to the next.
pub(super) struct Mesh<'a> {
    pub(super) points: &'a [GridPoint],
    next: Vec<u32>,
    previous: Vec<u32>,
}

/// What the sweep line meets at a vertex, with the edges concerned, from left to right.
pub(super) enum Event {
    /// Two edges begin.
    Open(u32, u32),
    /// The first edge ends, the second takes its place.
    Pass(u32, u32),
    /// Two edges end. Not in order.
    Close(u32, u32),
}

impl<'a> Mesh<'a> {
    pub(super) fn new(rings: &'a Rings) -> Self {
        let count = rings.points.len() as u32;
        let mut next: Vec<u32> = (1..=count).collect();
        let mut previous: Vec<u32> = (0..count).map(|i| i.wrapping_sub(1)).collect();
        for (start, ring) in rings.iter() {
            let last = start + ring.len() - 1;
            next[last] = start as u32;
            previous[start] = last as u32;
        }
        Self { points: &rings.points, next, previous }
    }

    /// All vertices in the order of the sweep; `None` if two of them coincide.
    pub(super) fn order(&self) -> Option<Vec<u32>> {
        let mut order: Vec<u32> = (0..self.points.len() as u32).collect();
        let at = |i: u32| self.points[i as usize];
        order.sort_unstable_by_key(|&i| at(i));
        let distinct = order.windows(2).all(|w| at(w[0]) != at(w[1]));
        distinct.then_some(order)
    }

    pub(super) fn point(&self, vertex: u32) -> GridPoint {
        self.points[vertex as usize]
    }

    fn ends(&self, edge: u32) -> (u32, u32) {
        (edge, self.next[edge as usize])
    }

    /// The ends of an edge, upper first.
    fn span(&self, edge: u32) -> (GridPoint, GridPoint) {
        let (a, b) = self.ends(edge);
        let (a, b) = (self.point(a), self.point(b));
        (a.min(b), a.max(b))
    }

    /// Positive if the point is left of the edge, negative if right, 0 if on its line.
    pub(super) fn side(&self, edge: u32, p: GridPoint) -> i64 {
        let (upper, lower) = self.span(edge);
        orient(upper, lower, p)
    }

    /// Whether the edge goes down, in its own direction.
    fn is_down(&self, edge: u32) -> bool {
        let (a, b) = self.ends(edge);
        self.point(a) < self.point(b)
    }

    pub(super) fn event(&self, vertex: u32) -> Event {
        let (before, after) = (self.previous[vertex as usize], vertex);
        let p = self.point(vertex);
        let from_above = self.point(before) < p;
        let to_below = p < self.point(self.next[vertex as usize]);
        match (from_above, to_below) {
            (true, true) => Event::Pass(before, after),
            (false, false) => Event::Pass(after, before),
            (true, false) => Event::Close(before, after),
            (false, true) => {
                let (_, lower) = self.span(before);
                // The one whose lower end lies left of the other.
                if self.side(after, lower) > 0 {
                    Event::Open(before, after)
                } else {
                    Event::Open(after, before)
                }
            }
        }
    }

    /// Whether two edges have a point in common other than a vertex that they share.
    fn conflict(&self, e: u32, f: u32) -> bool {
        let ((a, b), (c, d)) = (self.ends(e), self.ends(f));
        if a == d || b == c {
            return false;
        }
        let ((a, b), (c, d)) = (self.span(e), self.span(f));
        let sides = [orient(a, b, c), orient(a, b, d), orient(c, d, a), orient(c, d, b)];
        if sides == [0; 4] {
            return a.max(c) <= b.min(d);
        }
        let apart = |p: i64, q: i64| (p > 0 && q > 0) || (p < 0 && q < 0);
        !apart(sides[0], sides[1]) && !apart(sides[2], sides[3])
    }
}

/// The edges that the sweep line crosses, from left to right.
struct Status<'a> {
    mesh: &'a Mesh<'a>,
    edges: Vec<u32>,
}

impl Status<'_> {
    /// Where a vertex falls: the first edge that is not strictly to its left.
    fn locate(&self, p: GridPoint) -> usize {
        self.edges.partition_point(|&e| self.mesh.side(e, p) < 0)
    }

    /// Whether the point is strictly left of the edge at `index`, if there is one.
    fn is_left_of(&self, p: GridPoint, index: usize) -> bool {
        self.edges.get(index).is_none_or(|&e| self.mesh.side(e, p) > 0)
    }

    /// Whether the edges at `index − 1` and `index` meet.
    fn neighbours_conflict(&self, index: usize) -> bool {
        let left = index.checked_sub(1).and_then(|i| self.edges.get(i));
        let pair = left.zip(self.edges.get(index));
        pair.is_some_and(|(&e, &f)| self.mesh.conflict(e, f))
    }

    /// Goes past a vertex; `None` if a crossing or a touch came to light.
    fn advance(&mut self, vertex: u32) -> Option<()> {
        let p = self.mesh.point(vertex);
        let i = self.locate(p);
        let sound = match self.mesh.event(vertex) {
            Event::Open(left, right) => {
                let free = self.is_left_of(p, i);
                self.edges.splice(i..i, [left, right]);
                free && !self.neighbours_conflict(i) && !self.neighbours_conflict(i + 2)
            }
            Event::Pass(above, below) => {
                let free = self.edges.get(i) == Some(&above) && self.is_left_of(p, i + 1);
                if free {
                    self.edges[i] = below;
                }
                free && !self.neighbours_conflict(i) && !self.neighbours_conflict(i + 1)
            }
            Event::Close(e, f) => {
                let pair = self.edges.get(i..i + 2);
                let free = pair == Some(&[e, f]) || pair == Some(&[f, e]);
                let free = free && self.is_left_of(p, i + 2);
                if free {
                    self.edges.drain(i..i + 2);
                }
                free && !self.neighbours_conflict(i)
            }
        };
        sound.then_some(())
    }

    /// How often the rings wind around the region left of the edge at `index`.
    fn winding(&self, index: usize) -> i64 {
        let turn = |&e: &u32| if self.mesh.is_down(e) { 1 } else { -1 };
        self.edges[..index].iter().map(turn).sum()
    }
}

/// The rings that have what is filled on one side only; `None` if any two edges cross or touch.
pub(super) fn visible_rings(rings: &Rings, rule: FillRule) -> Option<Rings> {
    if rings.points.len() > u32::MAX as usize {
        return None;
    }
    let mesh = Mesh::new(rings);
    let order = mesh.order()?;
    let mut status = Status { mesh: &mesh, edges: Vec::new() };
    let mut visible: Vec<Option<bool>> = alloc::vec![None; rings.ends.len()];
    for vertex in order {
        let ring = rings.ends.partition_point(|&end| end <= vertex as usize);
        if visible[ring].is_none() {
            // Its topmost vertex: the winding outside it is that of the region it opens in.
            let index = status.locate(mesh.point(vertex));
            let outside = status.winding(index);
            status.advance(vertex)?;
            let inside = status.winding(index + 1);
            visible[ring] = Some(rule.is_inside(outside) != rule.is_inside(inside));
        } else {
            status.advance(vertex)?;
        }
    }
    let mut out = Rings::default();
    for ((_, ring), visible) in rings.iter().zip(visible) {
        if visible == Some(true) {
            out.push(ring);
        }
    }
    Some(out)
}
