use crate::Footprint;
use crate::math::{floor, sqrt};
use crate::procedural::Source;
use scumble_pixel::Premul;

/// How the lines of a [`Grid`] meet the footprint.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default)]
pub enum Antialias {
    /// Not at all: on a line or not.
    None,
    /// The usual trick for signed distances, clamp(½ − d/w): d the distance to the nearest line's edge,
    /// w the width of a pixel there. Good while a pixel is narrower than a line and a gap. In the
    /// distance it tends to ½, however thin the lines are.
    Gradient,
    /// The mean of the square wave over the pixel's own parallelogram, exactly, for each of the two
    /// families of lines; together 1 − (1 − a)(1 − b), which is exact where the parallelogram's
    /// sides lie along the lines, and at a distance in the mean.
    #[default]
    Integral,
}

/// Two families of lines, along u and v: the ground of every 3-D viewport.
///
/// ```
/// use scumble_geometry::Matrix2;
/// use scumble_texture::Footprint;
/// use scumble_texture::procedural::{Antialias, Grid};
///
/// // Lines a twentieth of the period wide, seen from so far that a pixel covers 40 of them.
/// let grid = Grid { period: 1.0, width: 0.05, ..Grid::default() };
/// let far = Footprint { u: 0.3, v: 0.7, jacobian: Matrix2::new(40.0, 0.0, 0.0, 40.0) };
/// let coverage = |antialias| Grid { antialias, ..grid }.coverage(&far);
/// assert!((coverage(Antialias::Integral) - 0.0975).abs() < 1e-6);
/// assert!(coverage(Antialias::Gradient) > 0.49);
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Grid {
    /// From the middle of one line to that of the next; a line lies at 0.
    pub period: f64,
    /// Width of a line, in 0…period.
    pub width: f64,
    /// How lines meet the footprint.
    pub antialias: Antialias,
    /// The lines, premultiplied.
    pub line: Premul,
    /// What lies between them, premultiplied.
    pub ground: Premul,
}

impl Default for Grid {
    /// White lines a tenth of the period 1 wide, on black.
    fn default() -> Self {
        Self {
            period: 1.0,
            width: 0.1,
            antialias: Antialias::default(),
            line: Premul([1.0; 4]),
            ground: Premul([0.0, 0.0, 0.0, 1.0]),
        }
    }
}

impl Grid {
    /// The signed distance from (u, v) to the nearest edge of a line, negative inside.
    #[must_use]
    pub fn distance(&self, u: f64, v: f64) -> f64 {
        self.across(u).min(self.across(v))
    }

    /// How much of a footprint the lines cover, in 0…1; 0 for one that is not finite, and for a grid
    /// whose period is not positive and finite.
    #[must_use]
    pub fn coverage(&self, f: &Footprint) -> f64 {
        let usable =
            self.period > 0.0 && self.period.is_finite() && f.u.is_finite() && f.v.is_finite();
        if !usable || !f.jacobian.is_finite() {
            return 0.0;
        }
        let covered = match self.antialias {
            Antialias::None => f64::from(u8::from(self.distance(f.u, f.v) < 0.0)),
            Antialias::Gradient => self.clamped_gradient(f),
            Antialias::Integral => {
                let j = &f.jacobian;
                let (a, b) = (self.mean(f.u, j.a, j.b), self.mean(f.v, j.c, j.d));
                1.0 - (1.0 - a) * (1.0 - b)
            }
        };
        // Written so that a NaN, of numbers near the end of their range, is no line.
        if covered > 0.0 { covered.min(1.0) } else { 0.0 }
    }

    /// The distance to the nearest edge of one family.
    fn across(&self, x: f64) -> f64 {
        let from_line = x - self.period * floor(x / self.period + 0.5);
        from_line.abs() - 0.5 * self.width
    }

    fn clamped_gradient(&self, f: &Footprint) -> f64 {
        let (u, v) = (self.across(f.u), self.across(f.v));
        let j = &f.jacobian;
        // The distance grows across the nearer line, and there a pixel is so wide.
        let (distance, x, y) = if u < v { (u, j.a, j.b) } else { (v, j.c, j.d) };
        let width = sqrt(x * x + y * y);
        if width > 0.0 { 0.5 - distance / width } else { f64::from(u8::from(distance < 0.0)) }
    }

    /// The mean of one family's square wave over a pixel at `x`, whose sides are `a` and `b` across
    /// the lines: over the trapezium that two boxes of these widths make.
    fn mean(&self, x: f64, a: f64, b: f64) -> f64 {
        let duty = (self.width / self.period).clamp(0.0, 1.0);
        let (x, a, b) = (phase(x / self.period), a.abs() / self.period, b.abs() / self.period);
        let (wide, narrow) = if a > b { (a, b) } else { (b, a) };
        if wide + narrow < 1.0 {
            // At most three lines are in sight.
            let line = |middle: f64| {
                let share = |edge| share_before(edge - x, wide, narrow);
                share(middle + 0.5 * duty) - share(middle - 0.5 * duty)
            };
            return line(-1.0) + line(0.0) + line(1.0);
        }
        far_mean(x, wide, narrow, duty)
    }
}

/// How much of the trapezium that boxes of these widths make lies before `s`, from its middle.
fn share_before(s: f64, wide: f64, narrow: f64) -> f64 {
    if s > 0.0 {
        return 1.0 - share_before(-s, wide, narrow);
    }
    let (foot, shoulder) = (0.5 * (wide + narrow), 0.5 * (wide - narrow));
    if s <= -foot {
        0.0
    } else if s < -shoulder {
        (s + foot) * (s + foot) / (2.0 * wide * narrow)
    } else {
        0.5 + s / wide
    }
}

/// The mean of the wave of period 1 over a trapezium at least as wide as the period.
///
/// With F the wave's second integral it is the second difference
/// (F(x + (a+b)/2) − F(x + (a−b)/2) − F(x − (a−b)/2) + F(x − (a+b)/2)) / ab. The wave's mean is taken
/// out first: F without it is periodic, and the work does not grow with the pixel.
fn far_mean(x: f64, wide: f64, narrow: f64, duty: f64) -> f64 {
    if narrow < FLAT * wide {
        let first = |x| first_integral(x, duty);
        return duty + (first(x + 0.5 * wide) - first(x - 0.5 * wide)) / wide;
    }
    let (foot, shoulder) = (0.5 * (wide + narrow), 0.5 * (wide - narrow));
    let second = |x| second_integral(x, duty);
    let outer = second(x + foot) + second(x - foot);
    let inner = second(x + shoulder) + second(x - shoulder);
    duty + (outer - inner) / (wide * narrow)
}

/// The ratio of its boxes below which a trapezium is a box: the second difference would be rounding.
const FLAT: f64 = 1e-6;

/// Where `x` lies in a period about a line, from −½ to ½.
fn phase(x: f64) -> f64 {
    x - floor(x + 0.5)
}

/// The integral of the wave of period 1 less its mean, from a line's middle on: odd, and 0 half a period
/// away.
fn first_integral(x: f64, duty: f64) -> f64 {
    let p = phase(x);
    p.clamp(-0.5 * duty, 0.5 * duty) - duty * p
}

/// The integral of that, from a line's middle on: even.
fn second_integral(x: f64, duty: f64) -> f64 {
    let p = phase(x).abs();
    let half = 0.5 * duty;
    // Within the line p²/2; beyond it grows at the rate of its half-width.
    let wave = if p < half { 0.5 * p * p } else { half * (p - 0.5 * half) };
    wave - 0.5 * duty * p * p
}

impl Source for Grid {
    fn color(&self, f: &Footprint) -> Premul {
        let k = self.coverage(f) as f32;
        let (line, ground) = (self.line.0, self.ground.0);
        Premul(core::array::from_fn(|c| ground[c] + (line[c] - ground[c]) * k))
    }
}
