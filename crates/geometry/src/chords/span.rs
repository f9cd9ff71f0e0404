//! A cubic curve, and what its chords are held to.

use crate::DVec2;
use crate::math::sqrt;

/// B(t) = `from` + t·(`linear` + t·(`square` + t·`cube`)).
pub(super) struct Cubic {
    from: DVec2,
    linear: DVec2,
    square: DVec2,
    cube: DVec2,
    pub(super) to: DVec2,
    end_velocity: DVec2,
}

/// Where a chord begins or ends.
#[derive(Debug, Clone, Copy)]
pub(super) struct Vertex {
    t: f64,
    /// The curve there, and its derivatives.
    point: DVec2,
    velocity: DVec2,
    acceleration: DVec2,
    /// How far beside the curve the vertex lies, to the right of the velocity and times it.
    aside: f64,
}

impl Vertex {
    pub(super) fn position(&self) -> DVec2 {
        self.point + self.velocity.perp() * self.aside
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

    fn velocity(&self, t: f64) -> DVec2 {
        self.linear + (self.square * 2.0 + self.cube * (3.0 * t)) * t
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

    /// How much of the second derivative is across the curve, and by what angle the curve turns per
    /// unit of the parameter; 0 where it has no direction.
    pub(super) fn bend(&self, t: f64) -> (f64, f64) {
        let velocity = self.velocity(t);
        let across = velocity.perp_dot(self.acceleration(t)).abs();
        let squared = velocity.length_squared();
        if squared > 0.0 { (across / sqrt(squared), across / squared) } else { (0.0, 0.0) }
    }

    pub(super) fn start(&self) -> Vertex {
        let acceleration = self.acceleration(0.0);
        Vertex { t: 0.0, point: self.from, velocity: self.linear, acceleration, aside: 0.0 }
    }

    pub(super) fn end(&self) -> Vertex {
        let acceleration = self.acceleration(1.0);
        Vertex { t: 1.0, point: self.to, velocity: self.end_velocity, acceleration, aside: 0.0 }
    }

    /// Half a sagitta outside the curve, for steps of which the product is given, but no farther than
    /// the tolerance.
    #[inline(always)]
    pub(super) fn vertex(&self, t: f64, steps: f64, tolerance: f64) -> Vertex {
        let (velocity, acceleration) = (self.velocity(t), self.acceleration(t));
        let squared = velocity.length_squared();
        let mut aside = velocity.perp_dot(acceleration) / squared * (steps * (-1.0 / 16.0));
        if aside * aside * squared > tolerance * tolerance {
            aside = (tolerance / sqrt(squared)).copysign(aside);
        }
        Vertex { t, point: self.at(t), velocity, acceleration, aside }
    }
}

/// A chord and the part of the curve for which it stands.
pub(super) struct Span<'a> {
    pub(super) from: &'a Vertex,
    pub(super) to: &'a Vertex,
}

impl Span<'_> {
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
    pub(super) fn holds(&self, tolerance: f64) -> bool {
        let Self { from, to } = self;
        let (run, range) = (to.point - from.point, to.t - from.t);
        let chord = to.position() - from.position();
        let squared = chord.length_squared();

        let along = [from, to].map(|v| v.velocity.dot(chord));
        let middle = 3.0 * run.dot(chord) - (along[0] + along[1]) * range;
        let runs_along = (along[0] >= 0.0) & (along[1] >= 0.0) & (middle >= 0.0) & (squared > 0.0);

        let ahead = [from, to].map(|v| v.velocity.perp_dot(chord) * v.aside);
        let ahead = larger(larger(ahead[0], -ahead[1]), 0.0);
        // NaN, which nothing is within, if there is no room.
        let room = sqrt(tolerance * tolerance * squared - ahead * ahead);

        let across = [from, to].map(|v| chord.perp_dot(v.acceleration) * (range * range / 24.0));
        let mut bulges = [2.0 * across[0] + across[1], across[0] + 2.0 * across[1]];
        let mut ends = [-from.aside * along[0], -to.aside * along[1]];
        let sign = if across[0] + across[1] < 0.0 { -1.0 } else { 1.0 };
        (bulges, ends) = (bulges.map(|b| b * sign), ends.map(|e| e * sign));
        runs_along && (is_even(ends, bulges, room) || is_near(ends, bulges, room))
    }
}

/// As [`f64::max`], but for NaN, and quicker.
fn larger(a: f64, b: f64) -> f64 {
    if a > b { a } else { b }
}

/// A quick test that tells most of what [`is_near`] does: as if the larger of the two bulges were all
/// along.
#[inline(always)]
fn is_even([a, b]: [f64; 2], [s0, s1]: [f64; 2], room: f64) -> bool {
    // The largest 4s·x·(1 − x) − a·(1 − x) − b·x is s − (a + b)/2 + (b − a)²/(16·s).
    let (s, difference) = (larger(s0, s1), b - a);
    let inside = (s - 0.5 * (a + b) - room) * s * 16.0 + difference * difference <= 0.0;
    inside & (s0 >= 0.0) & (s1 >= 0.0) & (larger(a, b) <= room) & (larger(-a, -b) <= room)
}

/// Whether no 4·(s₀·(1 − x) + s₁·x)·x·(1 − x) − a·(1 − x) − b·x for x from 0 to 1 is beyond ±`room`, if
/// s₀ + s₁ is not negative.
#[cold]
fn is_near([a, b]: [f64; 2], [s0, s1]: [f64; 2], room: f64) -> bool {
    // With x = (1 + y)/2 it is (m + d·y)·(1 − y²) − e·y − (a + b)/2.
    let (m, d, e) = (0.5 * (s0 + s1), 0.5 * (s1 - s0), 0.5 * (b - a));
    let value = |y: f64| {
        let y = y.clamp(-1.0, 1.0);
        (m + d * y) * (1.0 - y * y) - e * y - 0.5 * (a + b)
    };
    // Where that is level. If it is nowhere, the ends are all that counts, and no other value does harm.
    let sum = m + sqrt((m * m + 3.0 * d * (d - e)).max(0.0));
    let [highest, lowest] = [(d - e) / sum, sum / (-3.0 * d)].map(value);
    lowest.min(-a).min(-b) >= -room && highest.max(-a).max(-b) <= room
}
