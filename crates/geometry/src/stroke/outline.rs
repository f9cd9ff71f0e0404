use super::chain::{Chain, Segment};
use super::{Cap, Join, StrokeStyle};
use crate::math::sqrt;
use crate::{DVec2, Path, PathElement};
use alloc::vec::Vec;

/// How often an arc is halved at most: a semicircle becomes at most 1024 chords.
const MAX_ARC_DEPTH: u32 = 10;

/// The size of an outline beyond which round joins and caps are drawn straight, to bound time and
/// memory on hostile input.
const MAX_ROUND_POINTS: usize = 1 << 22;

/// The least cosine of half the angle between two segments that are joined by one point.
const WIDEST_BEND: f64 = 0.9375;

/// Draws the outlines of chains.
///
/// A chain's outline runs along its left side and back along its right side. At a join the outer
/// side gets the join's shape and the inner one goes through the corner itself (or past it, where
/// that makes no difference); so the outline is, as a sum of closed curves, one rectangle per
/// segment and one wedge per join, all clockwise to the eye, and winds around every point of the
/// stroke at least once.
pub(super) struct Outliner<'a> {
    style: &'a StrokeStyle,
    radius: f64,
    /// The least cosine between two normals whose chord is near enough to their arc.
    least_cosine: f64,
    /// The least cosine between two normals whose tangents meet near enough to their arc.
    least_bend: f64,
    /// Whether the sides of the segment before end where those of the next one begin.
    bent: bool,
    left: Vec<DVec2>,
    right: Vec<DVec2>,
    out: Path,
}

/// To the left of the direction of travel, as the eye sees it (y down).
fn left_of(v: DVec2) -> DVec2 {
    DVec2::new(v.y, -v.x)
}

impl<'a> Outliner<'a> {
    pub(super) fn new(style: &'a StrokeStyle, tolerance: f64) -> Self {
        let radius = style.width * 0.5;
        // Sagitta of a chord: radius·(1 − cos(θ/2)); and cos θ = 2·cos²(θ/2) − 1.
        let half_cosine = (1.0 - tolerance / radius).clamp(0.0, 1.0);
        let least_cosine = 2.0 * half_cosine * half_cosine - 1.0;
        // The tangents meet radius·(1/cos(θ/2) − 1) beyond the arc.
        let half_cosine = (1.0 / (1.0 + tolerance / radius)).max(WIDEST_BEND);
        let least_bend = 2.0 * half_cosine * half_cosine - 1.0;
        let (left, right) = (Vec::new(), Vec::new());
        Self { style, radius, least_cosine, least_bend, bent: false, left, right, out: Path::new() }
    }

    pub(super) fn finish(self) -> Path {
        self.out
    }

    pub(super) fn draw(&mut self, chain: &Chain) {
        let (Some(first), Some(last)) = (chain.segments.first(), chain.segments.last()) else {
            return;
        };
        self.left.clear();
        self.right.clear();
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
            let (left, right) = (self.left.split_off(0), self.right.split_off(0));
            self.contour(left.into_iter());
            self.contour(right.into_iter().rev());
            return;
        }
        let is_dot = chain.segments.iter().all(|s| s.from == s.to);
        if is_dot && self.style.cap == Cap::Butt {
            return;
        }
        let mut outline = self.left.split_off(0);
        self.cap(last.to, last.direction, &mut outline);
        outline.extend(self.right.drain(..).rev());
        self.cap(first.from, -first.direction, &mut outline);
        self.contour(outline.into_iter());
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
        let (n0, n1) = (left_of(before.direction), left_of(after.direction));
        let cosine = n0.dot(n1);
        // More than the sides lose on the inner side.
        let lost = (n1 - n0).length() * self.radius;
        let fits = cosine >= self.least_bend && before.length() >= lost && after.length() >= lost;
        if !(after.smooth && fits) {
            return false;
        }
        let tip = (n0 + n1) * (self.radius / (1.0 + cosine));
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
        let mut outer = Vec::new();
        match join {
            Join::Bevel => {}
            Join::Round => self.arc(n0, n1, turns_right, 0, &mut |n| outer.push(at(n))),
            Join::Miter => {
                // The tip is at (n0 + n1)/(1 + cos), √(2/(1 + cos)) half-widths away.
                let one_and_cosine = 1.0 + n0.dot(n1);
                let limit = self.style.miter_limit;
                if one_and_cosine * limit * limit >= 2.0 {
                    outer.push(at((n0 + n1) / one_and_cosine));
                }
            }
        }
        let (outer_side, inner_side) = if turns_right {
            (&mut self.left, &mut self.right)
        } else {
            (&mut self.right, &mut self.left)
        };
        outer_side.extend(outer);
        // Where both segments reach beyond the wedge that a shortcut cuts off, they overlap in
        // all of it, and the outline still winds around it once.
        let shortcut = (n1 - n0).length() * self.radius;
        let is_wide = n0.dot(n1) >= 0.0;
        if !(is_wide && before.length() >= shortcut && after.length() >= shortcut) {
            inner_side.push(corner);
        }
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
        let points = self.out.elements().len() + self.left.len() + self.right.len();
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

    /// Appends a closed contour, without repeated points; none if a number overflowed.
    fn contour(&mut self, points: impl Iterator<Item = DVec2>) {
        let mut points: Vec<DVec2> = points.collect();
        points.dedup();
        if points.iter().all(|p| p.is_finite()) && points.len() >= 3 {
            for (i, &p) in points.iter().enumerate() {
                self.out.push(if i == 0 { PathElement::MoveTo(p) } else { PathElement::LineTo(p) });
            }
            self.out.close();
        }
    }
}
