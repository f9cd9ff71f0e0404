//! Rings that do not meet, into triangles: one sweep from top to bottom.
//!
//! Between two neighbouring edges of the sweep line the inside and the outside take turns, so the
//! inside is a row of spans, each with a left and a right edge. A span is triangulated as it
//! grows: it keeps the vertices of one of its sides that still wait for their triangles. Where a
//! span splits, a diagonal goes from its last vertex to the one that splits it; where two spans
//! merge, the diagonal goes from that vertex to the next one of the merged span, and until then
//! it has two parts. (The partition of Lee & Preparata 1977 and the triangulation of Garey et al.
//! 1978, in one pass.)

use super::grid::{GridPoint, orient};
use super::rings::Rings;
use super::sweep::{Event, Mesh};
use alloc::vec::Vec;

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Side {
    Left,
    Right,
}

/// The triangles so far.
struct Output {
    triangles: Vec<[GridPoint; 3]>,
    /// Whether a triangle came out the wrong way round: then the rings were not simple.
    broken: bool,
}

impl Output {
    /// A triangle with `a` above `b` on the given side, and `c` on the other or lower on the same.
    fn push(&mut self, [a, b, c]: [GridPoint; 3], side: Side) {
        let triangle = if side == Side::Right { [a, b, c] } else { [a, c, b] };
        match orient(triangle[0], triangle[1], triangle[2]) {
            // Three vertices in a line: nothing to fill.
            0 => {}
            area => {
                self.broken |= area < 0;
                self.triangles.push(triangle);
            }
        }
    }
}

/// A monotone piece under way.
struct Piece {
    /// The vertices without triangles yet, from top to bottom; never empty. All but perhaps the
    /// first are on `side`.
    waiting: Vec<GridPoint>,
    side: Side,
}

impl Piece {
    fn new(top: GridPoint) -> Self {
        Self { waiting: alloc::vec![top], side: Side::Left }
    }

    /// The vertex that came last.
    fn last(&self) -> GridPoint {
        self.waiting[self.waiting.len() - 1]
    }

    /// The next vertex, on the given side.
    fn add(&mut self, p: GridPoint, side: Side, out: &mut Output) {
        if self.waiting.len() == 1 {
            self.side = side;
        }
        if side == self.side {
            self.cut_corners(p, out);
        } else {
            self.fan(p, out);
            let last = self.last();
            self.waiting.clear();
            self.waiting.push(last);
            self.side = side;
        }
        self.waiting.push(p);
    }

    /// Cuts off the corners that a further vertex on the same side makes convex.
    fn cut_corners(&mut self, p: GridPoint, out: &mut Output) {
        while let [.., a, b] = self.waiting[..] {
            let turn = orient(a, b, p);
            let convex = if self.side == Side::Right { turn > 0 } else { turn < 0 };
            if !convex {
                break;
            }
            out.push([a, b, p], self.side);
            self.waiting.pop();
        }
    }

    /// Joins a vertex opposite, or the last of all, to all that wait.
    fn fan(&self, p: GridPoint, out: &mut Output) {
        for pair in self.waiting.windows(2) {
            out.push([pair[0], pair[1], p], self.side);
        }
    }
}

/// A stretch of the sweep line that is inside.
struct Span {
    left: u32,
    right: u32,
    piece: Piece,
    /// The right part, from a merge until the next vertex; `piece` is the left part then.
    right_piece: Option<Piece>,
}

impl Span {
    fn add_left(&mut self, p: GridPoint, out: &mut Output) {
        if let Some(right) = self.right_piece.take() {
            self.piece.fan(p, out);
            self.piece = right;
        }
        self.piece.add(p, Side::Left, out);
    }

    fn add_right(&mut self, p: GridPoint, out: &mut Output) {
        if let Some(right) = self.right_piece.take() {
            right.fan(p, out);
        }
        self.piece.add(p, Side::Right, out);
    }

    fn close(&self, p: GridPoint, out: &mut Output) {
        self.piece.fan(p, out);
        if let Some(right) = &self.right_piece {
            right.fan(p, out);
        }
    }

    /// Makes two spans of it at a vertex inside, from which two edges go down.
    fn split(self, p: GridPoint, edges: (u32, u32), out: &mut Output) -> [Self; 2] {
        let side = self.piece.side;
        let fresh = Piece::new(self.piece.last());
        let (mut left, mut right) = match (self.right_piece, side) {
            (Some(right), _) => (self.piece, right),
            (None, Side::Left) => (fresh, self.piece),
            (None, Side::Right) => (self.piece, fresh),
        };
        left.add(p, Side::Right, out);
        right.add(p, Side::Left, out);
        [
            Self { left: self.left, right: edges.0, piece: left, right_piece: None },
            Self { left: edges.1, right: self.right, piece: right, right_piece: None },
        ]
    }

    /// Makes one span of two at the vertex where the edges between them meet.
    fn merge(mut self, mut other: Self, p: GridPoint, out: &mut Output) -> Self {
        self.add_right(p, out);
        other.add_left(p, out);
        let right_piece = Some(other.piece);
        Self { left: self.left, right: other.right, piece: self.piece, right_piece }
    }
}

/// The triangles; `None` if the rings turn out to meet.
pub(super) fn triangulate(rings: &Rings) -> Option<Vec<[GridPoint; 3]>> {
    let mesh = Mesh::new(rings);
    let mut out = Output { triangles: Vec::new(), broken: false };
    let mut spans: Vec<Span> = Vec::new();
    for vertex in mesh.order()? {
        advance(&mesh, &mut spans, vertex, &mut out)?;
    }
    (spans.is_empty() && !out.broken).then_some(out.triangles)
}

/// Goes past a vertex; `None` if it does not fit.
fn advance(mesh: &Mesh<'_>, spans: &mut Vec<Span>, vertex: u32, out: &mut Output) -> Option<()> {
    let p = mesh.point(vertex);
    let i = spans.partition_point(|s| mesh.side(s.right, p) < 0);
    match mesh.event(vertex) {
        Event::Open(left, right) => {
            if spans.get(i).is_none_or(|s| mesh.side(s.left, p) > 0) {
                spans.insert(i, Span { left, right, piece: Piece::new(p), right_piece: None });
            } else {
                let halves = spans.remove(i).split(p, (left, right), out);
                spans.splice(i..i, halves);
            }
        }
        Event::Pass(above, below) => {
            let span = spans.get_mut(i)?;
            if span.left == above {
                span.add_left(p, out);
                span.left = below;
            } else if span.right == above {
                span.add_right(p, out);
                span.right = below;
            } else {
                return None;
            }
        }
        Event::Close(e, f) => {
            let span = spans.get(i)?;
            let is_pair = |l: u32, r: u32| (l, r) == (e, f) || (l, r) == (f, e);
            if is_pair(span.left, span.right) {
                spans.remove(i).close(p, out);
            } else if is_pair(span.right, spans.get(i + 1)?.left) {
                let right = spans.remove(i + 1);
                let merged = spans.remove(i).merge(right, p, out);
                spans.insert(i, merged);
            } else {
                return None;
            }
        }
    }
    Some(())
}
