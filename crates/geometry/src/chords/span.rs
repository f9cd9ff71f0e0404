//! A cubic curve, and what its chords are held to.

use super::wide::{Points, larger, splat};
use crate::DVec2;
use crate::math::sqrt;
use fearless_simd::{Simd, f64x8, mask64x8, prelude::*};

/// B(t) = `from` + t·(`linear` + t·(`square` + t·`cube`)).
pub(super) struct Cubic {
    pub(super) from: DVec2,
    pub(super) linear: DVec2,
    pub(super) square: DVec2,
    pub(super) cube: DVec2,
    pub(super) to: DVec2,
    pub(super) end_velocity: DVec2,
}

/// Where chords begin or end.
#[derive(Debug, Clone, Copy)]
pub(super) struct Vertices<S: Simd> {
    t: f64x8<S>,
    /// The curve there, and its derivatives.
    point: Points<S>,
    velocity: Points<S>,
    acceleration: Points<S>,
    /// How far beside the curve each lies, to the right of the velocity and times it.
    aside: f64x8<S>,
}

impl<S: Simd> Vertices<S> {
    #[inline(always)]
    pub(super) fn position(&self) -> Points<S> {
        self.point + self.velocity.perp() * self.aside
    }

    #[inline(always)]
    pub(super) fn select(mask: mask64x8<S>, a: &Self, b: &Self) -> Self {
        Self {
            t: mask.select(a.t, b.t),
            point: Points::select(mask, a.point, b.point),
            velocity: Points::select(mask, a.velocity, b.velocity),
            acceleration: Points::select(mask, a.acceleration, b.acceleration),
            aside: mask.select(a.aside, b.aside),
        }
    }

    /// The last of these, then all but the last of the others.
    #[inline(always)]
    pub(super) fn slide(&self, other: &Self) -> Self {
        Self {
            t: self.t.slide::<7>(other.t),
            point: self.point.slide(other.point),
            velocity: self.velocity.slide(other.velocity),
            acceleration: self.acceleration.slide(other.acceleration),
            aside: self.aside.slide::<7>(other.aside),
        }
    }
}

impl Cubic {
    pub(super) fn new(&[p0, p1, p2, p3]: &[DVec2; 4]) -> Self {
        let bends = [(p0 + p2) - p1 * 2.0, (p1 + p3) - p2 * 2.0];
        Self {
            from: p0,
            linear: (p1 - p0) * 3.0,
            square: bends[0] * 3.0,
            cube: bends[1] - bends[0],
            to: p3,
            end_velocity: (p3 - p2) * 3.0,
        }
    }

    pub(super) fn at(&self, t: f64) -> DVec2 {
        self.from + (self.linear + (self.square + self.cube * t) * t) * t
    }

    /// The second derivative.
    pub(super) fn acceleration(&self, t: f64) -> DVec2 {
        self.square * 2.0 + self.cube * (6.0 * t)
    }

    /// The length of the longest second derivative, which is one of those at the ends.
    pub(super) fn largest_acceleration(&self) -> f64 {
        let squared = [0.0, 1.0].map(|t| self.acceleration(t).length_squared());
        sqrt(squared[0].max(squared[1]))
    }

    /// The first two derivatives.
    #[inline(always)]
    fn derivatives<S: Simd>(&self, simd: S, t: f64x8<S>) -> [Points<S>; 2] {
        let [linear, cube] = [Points::splat(simd, self.linear), Points::splat(simd, self.cube)];
        let twice = Points::splat(simd, self.square * 2.0);
        let velocity = linear + (twice + cube * (splat(simd, 3.0) * t)) * t;
        [velocity, twice + cube * (splat(simd, 6.0) * t)]
    }

    /// How much of the second derivative is across the curve, and by what angle the curve turns per
    /// unit of the parameter; 0 where it has no direction.
    #[inline(always)]
    pub(super) fn bend<S: Simd>(&self, simd: S, t: f64x8<S>) -> (f64x8<S>, f64x8<S>) {
        let [velocity, acceleration] = self.derivatives(simd, t);
        let across = velocity.perp_dot(acceleration).abs();
        let squared = velocity.length_squared();
        let zero = splat(simd, 0.0);
        let moves = squared.simd_gt(zero);
        (moves.select(across / squared.sqrt(), zero), moves.select(across / squared, zero))
    }

    #[inline(always)]
    pub(super) fn start<S: Simd>(&self, simd: S) -> Vertices<S> {
        Vertices {
            t: splat(simd, 0.0),
            point: Points::splat(simd, self.from),
            velocity: Points::splat(simd, self.linear),
            acceleration: Points::splat(simd, self.acceleration(0.0)),
            aside: splat(simd, 0.0),
        }
    }

    #[inline(always)]
    pub(super) fn end<S: Simd>(&self, simd: S) -> Vertices<S> {
        Vertices {
            t: splat(simd, 1.0),
            point: Points::splat(simd, self.to),
            velocity: Points::splat(simd, self.end_velocity),
            acceleration: Points::splat(simd, self.acceleration(1.0)),
            aside: splat(simd, 0.0),
        }
    }

    /// Half a sagitta outside the curve, for steps of which the product is given, but no farther than
    /// the tolerance.
    #[inline(always)]
    pub(super) fn vertices<S: Simd>(
        &self,
        simd: S,
        t: f64x8<S>,
        steps: f64x8<S>,
        tolerance: f64,
    ) -> Vertices<S> {
        let [velocity, acceleration] = self.derivatives(simd, t);
        let squared = velocity.length_squared();
        let half = steps * splat(simd, -1.0 / 16.0);
        let mut aside = velocity.perp_dot(acceleration) / squared * half;
        let is_far = (aside * aside * squared).simd_gt(splat(simd, tolerance * tolerance));
        if is_far.any_true() {
            let most = (splat(simd, tolerance) / squared.sqrt()).copysign(aside);
            aside = is_far.select(most, aside);
        }
        let [from, linear] = [Points::splat(simd, self.from), Points::splat(simd, self.linear)];
        let [square, cube] = [Points::splat(simd, self.square), Points::splat(simd, self.cube)];
        let point = from + (linear + (square + cube * t) * t) * t;
        Vertices { t, point, velocity, acceleration, aside }
    }
}

/// Chords, and the parts of a curve for which they stand.
pub(super) struct Spans<S: Simd> {
    pub(super) from: Vertices<S>,
    pub(super) to: Vertices<S>,
}

impl<S: Simd> Spans<S> {
    /// Whether they lie within the tolerance of each other.
    ///
    /// Cross products with the chord stand for distances from its line, all times its length. That of
    /// the curve is a·(1 − x) + b·x − 4s·x·(1 − x) at a part x of the range of the parameter, where a
    /// and b are those at the ends, and s, which changes evenly, is h²/8 times the second derivative
    /// from a third of the range to two thirds.
    ///
    /// A distance from the line is one from the chord as long as the curve runs along it, as it does
    /// if the legs of its control polygon do. Where a vertex lies ahead of its point on the curve, the
    /// part between sees the vertex instead, which is as much farther off as Pythagoras says. Where it
    /// lies behind, what is between on the chord is no farther from the curve than the vertex.
    #[inline(always)]
    pub(super) fn hold(&self, simd: S, tolerance: f64) -> mask64x8<S> {
        let Self { from, to } = self;
        let zero = splat(simd, 0.0);
        let (run, range) = (to.point - from.point, to.t - from.t);
        let chord = to.position() - from.position();
        let squared = chord.length_squared();

        let along = [from.velocity.dot(chord), to.velocity.dot(chord)];
        let middle = splat(simd, 3.0) * run.dot(chord) - (along[0] + along[1]) * range;
        let runs_along = along[0].simd_ge(zero)
            & along[1].simd_ge(zero)
            & middle.simd_ge(zero)
            & squared.simd_gt(zero);

        let ahead = from.velocity.perp_dot(chord) * from.aside;
        let behind = to.velocity.perp_dot(chord) * to.aside;
        let ahead = larger(larger(ahead, -behind), zero);
        // NaN, which nothing is within, if there is no room.
        let room = (splat(simd, tolerance * tolerance) * squared - ahead * ahead).sqrt();

        let part = range * range / splat(simd, 24.0);
        let first = chord.perp_dot(from.acceleration) * part;
        let last = chord.perp_dot(to.acceleration) * part;
        let one = splat(simd, 1.0);
        let sign = (first + last).simd_lt(zero).select(-one, one);
        let beside = Beside {
            ends: [-from.aside * along[0] * sign, -to.aside * along[1] * sign],
            bulges: [(first + first + last) * sign, (first + last + last) * sign],
            room,
        };
        let even = beside.are_even(simd);
        if (runs_along & !even).any_true() {
            return runs_along & (even | beside.are_near(simd));
        }
        runs_along & even
    }
}

/// How far curves lie beside their chords: 4·(s₀·(1 − x) + s₁·x)·x·(1 − x) − a·(1 − x) − b·x for x from
/// 0 to 1, where s₀ + s₁ is not negative.
struct Beside<S: Simd> {
    /// a and b.
    ends: [f64x8<S>; 2],
    /// s₀ and s₁.
    bulges: [f64x8<S>; 2],
    /// How far they may, in either direction.
    room: f64x8<S>,
}

impl<S: Simd> Beside<S> {
    /// A quick test that tells most of what [`Self::are_near`] does: as if the larger of the two bulges
    /// were all along.
    #[inline(always)]
    fn are_even(&self, simd: S) -> mask64x8<S> {
        let Self { ends: [a, b], bulges: [s0, s1], room } = *self;
        let (zero, half) = (splat(simd, 0.0), splat(simd, 0.5));
        // The largest 4s·x·(1 − x) − a·(1 − x) − b·x is s − (a + b)/2 + (b − a)²/(16·s).
        let (s, difference) = (larger(s0, s1), b - a);
        let beyond = (s - half * (a + b) - room) * s * splat(simd, 16.0) + difference * difference;
        beyond.simd_le(zero)
            & s0.simd_ge(zero)
            & s1.simd_ge(zero)
            & larger(a, b).simd_le(room)
            & larger(-a, -b).simd_le(room)
    }

    /// Whether nothing is beyond the room.
    #[inline(always)]
    fn are_near(&self, simd: S) -> mask64x8<S> {
        let Self { ends: [a, b], bulges: [s0, s1], room } = *self;
        let (half, three) = (splat(simd, 0.5), splat(simd, 3.0));
        // With x = (1 + y)/2 it is (m + d·y)·(1 − y²) − e·y − (a + b)/2.
        let (m, d, e) = (half * (s0 + s1), half * (s1 - s0), half * (b - a));
        let curve = Bulge { m, d, e, mean: half * (a + b) };
        // Where that is level. If it is nowhere, the ends are all that counts, and no other value does harm.
        let sum = m + larger(m * m + three * d * (d - e), splat(simd, 0.0)).sqrt();
        let highest = curve.at(simd, (d - e) / sum);
        let lowest = curve.at(simd, sum / (-three * d));
        !lowest.simd_lt(-room)
            & !highest.simd_gt(room)
            & (-a).simd_ge(-room)
            & (-b).simd_ge(-room)
            & (-a).simd_le(room)
            & (-b).simd_le(room)
    }
}

/// (m + d·y)·(1 − y²) − e·y − `mean`.
struct Bulge<S: Simd> {
    m: f64x8<S>,
    d: f64x8<S>,
    e: f64x8<S>,
    mean: f64x8<S>,
}

impl<S: Simd> Bulge<S> {
    /// The value at the y of −1 to 1 that is nearest.
    #[inline(always)]
    fn at(&self, simd: S, y: f64x8<S>) -> f64x8<S> {
        let one = splat(simd, 1.0);
        let y = y.simd_lt(-one).select(-one, y);
        let y = y.simd_gt(one).select(one, y);
        (self.m + self.d * y) * (one - y * y) - self.e * y - self.mean
    }
}
