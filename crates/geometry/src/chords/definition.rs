//! What [`Chords`](super::Chords) does eight at a time, one by one: the definition.

use super::density::{Density, END_STEP, MARGIN, MOST_TURN, RANGES};
use super::span::Cubic;
use crate::DVec2;
use crate::math::sqrt;
use alloc::vec::Vec;

/// Where a chord begins or ends.
#[derive(Debug, Clone, Copy)]
struct Vertex {
    t: f64,
    /// The curve there, and its derivatives.
    point: DVec2,
    velocity: DVec2,
    acceleration: DVec2,
    /// How far beside the curve the vertex lies, to the right of the velocity and times it.
    aside: f64,
}

impl Vertex {
    fn position(&self) -> DVec2 {
        self.point + self.velocity.perp() * self.aside
    }
}

impl Cubic {
    fn velocity(&self, t: f64) -> DVec2 {
        self.linear + (self.square * 2.0 + self.cube * (3.0 * t)) * t
    }

    /// See [`Cubic::vertices`].
    fn vertex(&self, t: f64, steps: f64, tolerance: f64) -> Vertex {
        let (velocity, acceleration) = (self.velocity(t), self.acceleration(t));
        let squared = velocity.length_squared();
        let mut aside = velocity.perp_dot(acceleration) / squared * (steps * (-1.0 / 16.0));
        if aside * aside * squared > tolerance * tolerance {
            aside = (tolerance / sqrt(squared)).copysign(aside);
        }
        Vertex { t, point: self.at(t), velocity, acceleration, aside }
    }

    fn end_vertex(&self, t: f64, point: DVec2, velocity: DVec2) -> Vertex {
        Vertex { t, point, velocity, acceleration: self.acceleration(t), aside: 0.0 }
    }
}

impl Density {
    /// See [`Density::new`].
    pub(super) fn of_one(cubic: &Cubic, tolerance: f64, radius: f64) -> ([f64; RANGES + 1], f64) {
        let scale = MARGIN * MARGIN / (16.0 * tolerance);
        let value = |i| {
            let t = i as f64 / RANGES as f64;
            let velocity = cubic.velocity(t);
            let across = velocity.perp_dot(cubic.acceleration(t)).abs();
            let squared = velocity.length_squared();
            let (across, turn) =
                if squared > 0.0 { (across / sqrt(squared), across / squared) } else { (0.0, 0.0) };
            let turn = turn.min(MOST_TURN);
            sqrt((across + 2.0 * radius * turn * turn) * scale)
        };
        let values: [f64; RANGES + 1] = core::array::from_fn(value);
        let half = 0.5 / RANGES as f64;
        (values, values.windows(2).fold(0.0, |sum, v| sum + (v[0] + v[1]) * half))
    }
}

/// See [`Density::places`].
fn places(values: &[f64; RANGES + 1], steps: f64, count: u32) -> Vec<f64> {
    let step = steps / (f64::from(count) - 2.0 + 2.0 * END_STEP);
    let mut out = vec![0.0];
    for i in 1..count {
        let sum = (f64::from(i - 1) + END_STEP) * step;
        let (mut before, mut range) = (0.0, 0);
        let area = |i: usize| (values[i] + values[i + 1]) * (0.5 / RANGES as f64);
        while range < RANGES - 1 && before + area(range) < sum {
            before += area(range);
            range += 1;
        }
        let (rest, value) = (sum - before, values[range]);
        let slope = (values[range + 1] - value) * RANGES as f64;
        let root = sqrt((value * value + 2.0 * slope * rest).max(0.0));
        out.push(range as f64 / RANGES as f64 + 2.0 * rest / (value + root));
    }
    let last = out[out.len() - 1];
    out.push(last + (1.0 - last) / END_STEP);
    if count > 1 {
        out[0] = out[1] - out[1] / END_STEP;
    }
    out
}

/// The ends of so many chords, or `None` if one of them does not hold.
pub(super) fn place(
    cubic: &Cubic,
    (tolerance, radius): (f64, f64),
    count: u32,
) -> Option<Vec<DVec2>> {
    let (values, steps) = Density::of_one(cubic, tolerance, radius);
    let mut vertices = vec![cubic.end_vertex(0.0, cubic.from, cubic.linear)];
    let vertex = |t: &[f64]| cubic.vertex(t[1], (t[1] - t[0]) * (t[2] - t[1]), tolerance);
    vertices.extend(places(&values, steps, count).windows(3).map(vertex));
    vertices.push(cubic.end_vertex(1.0, cubic.to, cubic.end_velocity));
    let holds = |ends: &[Vertex]| holds(&ends[0], &ends[1], tolerance);
    let all = vertices.windows(2).all(holds);
    all.then(|| vertices[1..].iter().map(Vertex::position).collect())
}

/// See [`Spans::hold`](super::span::Spans::hold).
fn holds(from: &Vertex, to: &Vertex, tolerance: f64) -> bool {
    let (run, range) = (to.point - from.point, to.t - from.t);
    let chord = to.position() - from.position();
    let squared = chord.length_squared();

    let along = [from, to].map(|v| v.velocity.dot(chord));
    let middle = 3.0 * run.dot(chord) - (along[0] + along[1]) * range;
    let runs_along = along[0] >= 0.0 && along[1] >= 0.0 && middle >= 0.0 && squared > 0.0;

    let ahead = [from, to].map(|v| v.velocity.perp_dot(chord) * v.aside);
    let ahead = ahead[0].max(-ahead[1]).max(0.0);
    let room = sqrt(tolerance * tolerance * squared - ahead * ahead);

    let across = [from, to].map(|v| chord.perp_dot(v.acceleration) * (range * range / 24.0));
    let sign = if across[0] + across[1] < 0.0 { -1.0 } else { 1.0 };
    let bulges = [across[0] + across[0] + across[1], across[0] + across[1] + across[1]];
    let ends = [-from.aside * along[0], -to.aside * along[1]];
    runs_along && are_near(ends.map(|e| e * sign), bulges.map(|b| b * sign), room)
}

/// Whether no 4·(s₀·(1 − x) + s₁·x)·x·(1 − x) − a·(1 − x) − b·x for x from 0 to 1 is beyond ±`room`, if
/// s₀ + s₁ is not negative.
fn are_near([a, b]: [f64; 2], [s0, s1]: [f64; 2], room: f64) -> bool {
    // Seen to be near at a glance, or with care.
    let (s, difference) = (s0.max(s1), b - a);
    let inside = (s - 0.5 * (a + b) - room) * s * 16.0 + difference * difference <= 0.0;
    let ends = a.max(b) <= room && a.min(b) >= -room;
    let (m, d, e) = (0.5 * (s0 + s1), 0.5 * (s1 - s0), 0.5 * (b - a));
    let value = |y: f64| {
        let y = y.clamp(-1.0, 1.0);
        (m + d * y) * (1.0 - y * y) - e * y - 0.5 * (a + b)
    };
    let sum = m + sqrt((m * m + 3.0 * d * (d - e)).max(0.0));
    let [highest, lowest] = [(d - e) / sum, sum / (-3.0 * d)].map(value);
    // Where it is level nowhere, the ends are all that counts.
    let near = lowest.min(-a).min(-b) >= -room && highest.max(-a).max(-b) <= room;
    ends && (inside && s0 >= 0.0 && s1 >= 0.0 || near)
}
