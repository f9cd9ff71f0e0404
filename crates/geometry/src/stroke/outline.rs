use super::chain::{Chain, Segment};
use super::inner::InnerJoins;
use super::{Bends, Cap, Join, StrokeStyle};
use crate::math::sqrt;
use crate::{Contours, DVec2};
use alloc::vec::Vec;

/// How often an arc is halved at most: a semicircle becomes at most 1024 chords.
const MAX_ARC_DEPTH: u32 = 10;

/// The size of an outline beyond which round joins and caps are drawn straight, to bound time and
/// memory on hostile input.
const MAX_ROUND_POINTS: usize = 1 << 22;

/// The part of the tolerance that does not show in any way: points so near are one.
const INVISIBLE: f64 = 1.0 / 64.0;

/// Points of joins and caps for which there is room at once.
const ROOM: usize = 16;

/// Draws the outlines of chains.
///
/// A chain's outline runs along its left side and back along its right side. At a join the outer
/// side gets the join's shape and the inner one goes through the corner itself (or past it, where
/// that makes no difference, [`InnerJoins`]); so the outline is, as a sum of closed curves, one
/// quadrilateral per segment and one wedge per join, all clockwise to the eye, and winds around every
/// point of the stroke at least once.
pub(super) struct Outliner<'a> {
    style: &'a StrokeStyle,
    radius: f64,
    /// The least cosine between two normals whose chord is near enough to their arc.
    least_cosine: f64,
    bends: Bends,
    /// Whether the sides of the segment before end where those of the next one begin.
    bent: bool,
    left: Vec<DVec2>,
    right: Vec<DVec2>,
    /// The joins of which the inner side is the left one, and the others.
    inner: [InnerJoins; 2],
    out: &'a mut Contours,
}

/// To the left of the direction of travel, as the eye sees it (y down).
fn left_of(v: DVec2) -> DVec2 {
    DVec2::new(v.y, -v.x)
}

impl<'a> Outliner<'a> {
    pub(super) fn new(style: &'a StrokeStyle, bends: Bends, out: &'a mut Contours) -> Self {
        // Sagitta of a chord: radius·(1 − cos(θ/2)); and cos θ = 2·cos²(θ/2) − 1.
        let half_cosine = (1.0 - bends.tolerance / bends.radius).clamp(0.0, 1.0);
        let least_cosine = 2.0 * half_cosine * half_cosine - 1.0;
        let (radius, bent) = (bends.radius, false);
        let (left, right, inner) = (Vec::new(), Vec::new(), Default::default());
        Self { style, radius, least_cosine, bends, bent, left, right, inner, out }
    }

    pub(super) fn draw(&mut self, chain: &Chain) {
        let (Some(first), Some(last)) = (chain.segments.first(), chain.segments.last()) else {
            return;
        };
        // Two points a segment, and what joins and caps add, more or less.
        let room = 2 * chain.segments.len() + ROOM;
        for side in [&mut self.left, &mut self.right] {
            side.clear();
            side.reserve(room);
        }
        self.inner.iter_mut().for_each(InnerJoins::clear);
        for pair in chain.segments.windows(2) {
            self.side(&pair[0]);
            self.bent = self.bend(&pair[0], &pair[1]);
            if !self.bent {
                self.join(&pair[0], &pair[1]);
            }
        }
        self.side(last);
        self.bent = false;
        if chain.closed {
            self.join(last, first);
            self.cut();
            contour(self.out, |out| out.append(&mut self.left));
            return contour(self.out, |out| out.extend(self.right.iter().rev()));
        }
        let is_dot = chain.segments.iter().all(Segment::is_point);
        if is_dot && self.style.cap == Cap::Butt {
            return;
        }
        self.cut();
        // The caps' points after the sides that they follow: all the way around.
        let mut side = core::mem::take(&mut self.left);
        self.cap(last.to, last.direction, &mut side);
        self.left = side;
        self.right.reverse();
        let mut side = core::mem::take(&mut self.right);
        self.cap(first.from, -first.direction, &mut side);
        self.right = side;
        contour(self.out, |out| {
            out.append(&mut self.left);
            out.append(&mut self.right);
        });
    }

    /// Cuts the inner joins of both sides.
    fn cut(&mut self) {
        let tolerance = self.bends.tolerance * INVISIBLE;
        for (joins, side) in self.inner.iter().zip([&mut self.left, &mut self.right]) {
            joins.cut(side, tolerance);
        }
    }

    /// The two sides of a segment.
    fn side(&mut self, segment: &Segment) {
        let normal = left_of(segment.direction) * self.radius;
        if !self.bent {
            self.left.push(segment.from + normal);
            self.right.push(segment.from - normal);
        }
        self.left.push(segment.to + normal);
        self.right.push(segment.to - normal);
    }

    /// Joins two segments of a curve by one point on either side, where their sides meet, if that
    /// is as good as the arc. Tells whether it did.
    fn bend(&mut self, before: &Segment, after: &Segment) -> bool {
        if !after.smooth {
            return false;
        }
        let (n0, n1) = (left_of(before.direction), left_of(after.direction));
        let lengths = [before.length_squared(), after.length_squared()];
        let tip = if lengths[0] == 0.0 || lengths[1] == 0.0 {
            // The end of the curve, with its true direction: there the sides begin and end.
            if !self.bends.fits_tangent(n0, n1, lengths[0].max(lengths[1])) {
                return false;
            }
            (if lengths[0] == 0.0 { n0 } else { n1 }) * self.radius
        } else {
            if !self.bends.fits(n0, n1, lengths[0].min(lengths[1])) {
                return false;
            }
            (n0 + n1) * (self.radius / (1.0 + n0.dot(n1)))
        };
        for (side, tip) in [(&mut self.left, tip), (&mut self.right, -tip)] {
            side.pop();
            side.push(after.from + tip);
        }
        true
    }

    /// What lies between the sides of two segments.
    fn join(&mut self, before: &Segment, after: &Segment) {
        let (corner, n0, n1) = (after.from, left_of(before.direction), left_of(after.direction));
        let turns_right = before.direction.perp_dot(after.direction) >= 0.0;
        let join = if after.smooth { Join::Round } else { self.style.join };
        let sign = if turns_right { self.radius } else { -self.radius };
        let at = |n: DVec2| corner + n * sign;
        let (mut arc, mut tip) = (Vec::new(), None);
        match join {
            Join::Bevel => {}
            Join::Round => self.arc(n0, n1, turns_right, 0, &mut |n| arc.push(at(n))),
            Join::Miter => {
                // The tip is at (n0 + n1)/(1 + cos), √(2/(1 + cos)) half-widths away.
                let one_and_cosine = 1.0 + n0.dot(n1);
                let limit = self.style.miter_limit;
                if one_and_cosine * limit * limit >= 2.0 {
                    tip = Some(at((n0 + n1) / one_and_cosine));
                }
            }
        }
        let [left, right] = &mut self.inner;
        let (outer_side, inner_side, joins) = if turns_right {
            (&mut self.left, &mut self.right, right)
        } else {
            (&mut self.right, &mut self.left, left)
        };
        outer_side.extend(arc.into_iter().chain(tip));
        // Where both segments reach beyond the wedge that a shortcut cuts off, they overlap in
        // all of it, and the outline still winds around it once.
        let shortcut = (n1 - n0).length() * self.radius;
        let is_wide = n0.dot(n1) >= 0.0;
        let is_covered = is_wide && before.length() >= shortcut && after.length() >= shortcut;
        joins.push(inner_side, (!is_covered).then_some(corner));
    }

    /// The cap at an end that looks in the given direction, from the left of it to its right.
    fn cap(&self, end: DVec2, direction: DVec2, out: &mut Vec<DVec2>) {
        let normal = left_of(direction);
        match self.style.cap {
            Cap::Butt => {}
            Cap::Round => {
                let radius = self.radius;
                self.arc(normal, -normal, true, 0, &mut |n| out.push(end + n * radius));
            }
            Cap::Square => {
                let ahead = end + direction * self.radius;
                out.extend([ahead + normal * self.radius, ahead - normal * self.radius]);
            }
        }
    }

    /// The unit vectors strictly between two, clockwise or counter-clockwise to the eye, so
    /// close that chords can stand for the arc.
    fn arc(&self, n0: DVec2, n1: DVec2, clockwise: bool, depth: u32, push: &mut dyn FnMut(DVec2)) {
        let cosine = n0.dot(n1);
        let points = self.out.points.len() + self.left.len() + self.right.len();
        if depth >= MAX_ARC_DEPTH || cosine >= self.least_cosine || points >= MAX_ROUND_POINTS {
            return;
        }
        // The sum of the two vanishes as they come to oppose each other, their difference does
        // not; and the middle of the arc stands square to the difference.
        let middle = if cosine >= 0.0 {
            n0 + n1
        } else if clockwise {
            left_of(n1 - n0)
        } else {
            left_of(n0 - n1)
        };
        let middle = middle / sqrt(middle.length_squared());
        self.arc(n0, middle, clockwise, depth + 1, push);
        push(middle);
        self.arc(middle, n1, clockwise, depth + 1, push);
    }
}

/// Appends a contour without repeated points; none if a number overflowed.
fn contour(out: &mut Contours, push: impl FnOnce(&mut Vec<DVec2>)) {
    let begin = out.points.len();
    push(&mut out.points);
    let mut end = begin;
    for i in begin..out.points.len() {
        let p = out.points[i];
        if !p.is_finite() {
            return out.points.truncate(begin);
        }
        if end == begin || out.points[end - 1] != p {
            out.points[end] = p;
            end += 1;
        }
    }
    out.points.truncate(if end - begin >= 3 { end } else { begin });
    out.finish();
}
