//! Functions whose last bit is the same on every machine: only + − × ÷ √ and floor.

use std::f64::consts::{FRAC_1_SQRT_2, FRAC_PI_2, LN_2, LN_10, PI, SQRT_2};

/// Sine by its Taylor series after reduction to [−π/2, π/2]; error below 1e−13 for |x| < 1e4.
pub(crate) fn sin(x: f64) -> f64 {
    let turns = (x / PI + 0.5).floor();
    let r = x - turns * PI;
    let r2 = r * r;
    let mut term = r;
    let mut sum = r;
    let mut k = 1.0;
    while k < 21.0 {
        term = -term * r2 / ((k + 1.0) * (k + 2.0));
        sum += term;
        k += 2.0;
    }
    let odd = turns - 2.0 * (turns / 2.0).floor();
    if odd == 0.0 { sum } else { -sum }
}

/// Cosine, with the error of [`sin`].
pub(crate) fn cos(x: f64) -> f64 {
    sin(x + FRAC_PI_2)
}

/// eˣ by its Taylor series after halving the exponent until it is small; error below 1e−13 of the
/// value for −700 < x < 700, and 0 below.
pub(crate) fn exp(x: f64) -> f64 {
    if x < -700.0 {
        return 0.0;
    }
    let mut halvings = 0;
    let mut t = x;
    while t.abs() > 0.5 && halvings < 12 {
        t /= 2.0;
        halvings += 1;
    }
    let sum = (1..20).rev().fold(1.0, |sum, k| 1.0 + sum * t / f64::from(k));
    (0..halvings).fold(sum, |value, _| value * value)
}

/// log₁₀ x by the series of artanh after halving or doubling to [√½, √2]; error below 1e−14 of
/// the larger of 1 and the value, for a finite x > 0; −∞ for 0 and below.
pub(crate) fn log10(x: f64) -> f64 {
    if x <= 0.0 {
        return f64::NEG_INFINITY;
    }
    let (mut rest, mut octaves) = (x, 0.0);
    while rest > SQRT_2 && octaves < 1100.0 {
        rest /= 2.0;
        octaves += 1.0;
    }
    while rest < FRAC_1_SQRT_2 {
        rest *= 2.0;
        octaves -= 1.0;
    }
    // ln r = 2 artanh((r − 1)/(r + 1)), and |z| < 0.172.
    let z = (rest - 1.0) / (rest + 1.0);
    let sum = (0..12).rev().fold(0.0, |sum, k| 1.0 / f64::from(2 * k + 1) + z * z * sum);
    (2.0 * z * sum + octaves * LN_2) / LN_10
}

/// The angle of (x, y) in turns, 0…1 from the +x axis towards +y, by a rational approximation
/// good to 1e−3 turns: it places ornaments, it measures nothing.
pub(crate) fn turns(x: f64, y: f64) -> f64 {
    let (ax, ay) = (x.abs(), y.abs());
    let big = ax.max(ay);
    if big == 0.0 {
        return 0.0;
    }
    let z = ax.min(ay) / big;
    // atan(z) ≈ z·(π/4 + 0.273·(1 − z)) on [0, 1].
    let octant = z * (PI / 4.0 + 0.273 * (1.0 - z)) / (2.0 * PI);
    let quadrant = if ay > ax { 0.25 - octant } else { octant };
    match (x < 0.0, y < 0.0) {
        (false, false) => quadrant,
        (true, false) => 0.5 - quadrant,
        (true, true) => 0.5 + quadrant,
        (false, true) => 1.0 - quadrant,
    }
}

/// 0 below `a`, 1 above `b`, and 3t² − 2t³ between.
pub(crate) fn smoothstep(a: f64, b: f64, x: f64) -> f64 {
    let t = ((x - a) / (b - a)).clamp(0.0, 1.0);
    t * t * (3.0 - 2.0 * t)
}

/// `a` at t = 0, `b` at t = 1.
pub(crate) fn lerp(a: f64, b: f64, t: f64) -> f64 {
    a + (b - a) * t
}

/// The remainder after whole ones are taken away, in [0, 1).
pub(crate) fn fract(x: f64) -> f64 {
    x - x.floor()
}

/// A hash of two integers and a seed, 32 well-mixed bits.
pub(crate) fn hash(x: i64, y: i64, seed: u32) -> u32 {
    let mut h = (x as u64).wrapping_mul(0x9e37_79b9_7f4a_7c15)
        ^ (y as u64).wrapping_mul(0xc2b2_ae3d_27d4_eb4f)
        ^ u64::from(seed).wrapping_mul(0x1656_67b1_9e37_79f9);
    for _ in 0..2 {
        h ^= h >> 29;
        h = h.wrapping_mul(0xbf58_476d_1ce4_e5b9);
        h ^= h >> 32;
    }
    (h >> 16) as u32
}

/// A hash as a number in [0, 1).
pub(crate) fn random(x: i64, y: i64, seed: u32) -> f64 {
    f64::from(hash(x, y, seed)) / 4_294_967_296.0
}

/// Value noise in [0, 1) over the integer lattice, smoothly interpolated; it repeats after
/// `period` cells in x and y.
pub(crate) fn noise(x: f64, y: f64, period: i64, seed: u32) -> f64 {
    let (fx, fy) = (x.floor(), y.floor());
    let (tx, ty) = (smoothstep(0.0, 1.0, x - fx), smoothstep(0.0, 1.0, y - fy));
    let at = |dx: i64, dy: i64| {
        random((fx as i64 + dx).rem_euclid(period), (fy as i64 + dy).rem_euclid(period), seed)
    };
    lerp(lerp(at(0, 0), at(1, 0), tx), lerp(at(0, 1), at(1, 1), tx), ty)
}

/// Noise summed over octaves, each of half the size and `gain` times the height, in [0, 1).
pub(crate) fn octaves(x: f64, y: f64, period: i64, count: u32, gain: f64, seed: u32) -> f64 {
    let (mut sum, mut total, mut height) = (0.0, 0.0, 1.0);
    let mut scale = 1_i64;
    for octave in 0..count {
        let s = scale as f64;
        sum += height * noise(x * s, y * s, period * scale, seed + octave);
        total += height;
        height *= gain;
        scale *= 2;
    }
    sum / total
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sine_and_cosine_follow_the_library() {
        for i in -2000..2000 {
            let x = f64::from(i) * 0.037;
            assert!((sin(x) - x.sin()).abs() < 1e-12, "{x}");
            assert!((cos(x) - x.cos()).abs() < 1e-12, "{x}");
        }
    }

    #[test]
    fn the_exponential_follows_the_library() {
        for i in -600..600 {
            let x = f64::from(i) * 0.37;
            assert!((exp(x) / x.exp() - 1.0).abs() < 1e-12, "{x}");
            assert_eq!(exp(-700.1 - x * x), 0.0);
        }
    }

    #[test]
    fn the_logarithm_follows_the_library() {
        for i in 1..2000 {
            let x = f64::from(i) * 0.0137;
            for x in [x, 1.0 / x, x * x * x, x / 1e9] {
                let truth = x.log10();
                assert!((log10(x) - truth).abs() < 1e-14 * truth.abs().max(1.0), "{x}");
            }
        }
        assert_eq!(
            [log10(1.0), log10(0.0), log10(-1.0)],
            [0.0, f64::NEG_INFINITY, f64::NEG_INFINITY]
        );
    }

    #[test]
    fn turns_go_once_around() {
        for i in 0..360 {
            let angle = f64::from(i) / 360.0;
            let found = turns(cos(2.0 * PI * angle), sin(2.0 * PI * angle));
            let off = (found - angle).abs();
            assert!(off.min(1.0 - off) < 1e-3, "{angle}: {found}");
        }
    }

    #[test]
    fn noise_stays_in_range_and_repeats() {
        for i in 0..500 {
            let (x, y) = (f64::from(i) * 0.31, f64::from(i) * 0.17);
            let v = octaves(x, y, 8, 4, 0.5, 7);
            assert!((0.0..1.0).contains(&v));
            assert!((octaves(x + 8.0, y - 16.0, 8, 4, 0.5, 7) - v).abs() < 1e-9);
        }
    }
}
