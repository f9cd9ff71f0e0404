//! The tone curve of one channel of an ICC profile, and its inverse.

use moxcms::ToneReprCurve;

/// Intervals of the table, so that every code of 16 bits, and so of 8, is an entry.
const INTERVALS: usize = 65_535;

/// Buckets of light in which the search for an entry starts.
const BUCKETS: usize = 4096;

/// Intervals at the curve's end from which it is continued.
const END: usize = 1024;

/// A rising curve from encoded numbers to light.
///
/// On 0…1 it is a table with lines between its entries, and the inverse undoes just those. Beyond 1 it
/// goes on as the power of x that it ends as, below 0 as its own mirror image, so that floats out of
/// range come back.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Curve {
    /// Light at i/65535, rising.
    table: Vec<f32>,
    /// For each bucket of light the first entry that is not below it.
    buckets: Vec<u32>,
    /// The exponent beyond 1.
    power: f64,
}

impl Curve {
    /// The curve of a profile; none if it falls or is flat.
    pub(super) fn new(curve: &ToneReprCurve) -> Option<Self> {
        match curve {
            ToneReprCurve::Lut(table) => match table[..] {
                [] => Self::of(|x| x),
                [gamma] => Self::of(|x| libm::pow(x, f64::from(gamma) / 256.0)),
                _ => Self::of(|x| interpolated(table, x)),
            },
            ToneReprCurve::Parametric(parameters) => {
                let formula = Formula::new(parameters)?;
                Self::of(|x| formula.at(x))
            }
        }
    }

    /// The table of a function on 0…1.
    fn of(f: impl Fn(f64) -> f64) -> Option<Self> {
        let mut table: Vec<f32> =
            (0..=INTERVALS).map(|i| f(i as f64 / INTERVALS as f64) as f32).collect();
        if !table.iter().all(|v| v.is_finite()) {
            return None;
        }
        // Where a profile's curve falls, its inverse would be anybody's guess.
        for i in 1..=INTERVALS {
            table[i] = table[i].max(table[i - 1]);
        }
        let (bottom, top) = (table[0], table[INTERVALS]);
        if !(top > 0.0 && bottom < top) {
            return None;
        }
        let near = INTERVALS - END;
        let fall = libm::log(f64::from(table[near]) / f64::from(top));
        let power = fall / libm::log(near as f64 / INTERVALS as f64);
        let power = if power.is_finite() && power > 0.0 { power } else { 1.0 };
        let buckets = (0..=BUCKETS).map(|b| {
            let light = bottom + (top - bottom) * (b as f32 / BUCKETS as f32);
            table.partition_point(|&t| t < light) as u32
        });
        Some(Self { buckets: buckets.collect(), power, table })
    }

    /// A number as light. NaN stays NaN.
    pub(crate) fn decode(&self, x: f32) -> f32 {
        let [bottom, .., top] = self.table[..] else { return x };
        if x < 0.0 {
            2.0 * bottom - self.decode(-x)
        } else if x < 1.0 {
            let at = f64::from(x) * INTERVALS as f64;
            let i = at as usize;
            let part = at - i as f64;
            let [a, b] = [self.table[i], self.table[i + 1]].map(f64::from);
            (a + (b - a) * part) as f32
        } else if x == 1.0 {
            top
        } else {
            (f64::from(top) * libm::pow(f64::from(x), self.power)) as f32
        }
    }

    /// Light as a number. NaN stays NaN.
    pub(crate) fn encode(&self, light: f32) -> f32 {
        let [bottom, .., top] = self.table[..] else { return light };
        if light < bottom {
            -self.encode(2.0 * bottom - light)
        } else if light < top {
            self.inside(light, bottom, top)
        } else if light == top {
            1.0
        } else {
            libm::pow(f64::from(light) / f64::from(top), 1.0 / self.power) as f32
        }
    }

    /// The number of a light that the table holds.
    fn inside(&self, light: f32, bottom: f32, top: f32) -> f32 {
        let bucket = (light - bottom) / (top - bottom) * BUCKETS as f32;
        let bucket = (bucket as usize).min(BUCKETS - 1);
        // One more on either side for what the quotient rounds.
        let first = (self.buckets[bucket] as usize).saturating_sub(1);
        let last = (self.buckets[bucket + 1] as usize + 1).min(INTERVALS);
        let above = first + self.table[first..=last].partition_point(|&t| t <= light);
        let above = above.clamp(1, INTERVALS);
        let [a, b] = [self.table[above - 1], self.table[above]].map(f64::from);
        let part = if b > a { (f64::from(light) - a) / (b - a) } else { 0.0 };
        ((above - 1) as f64 + part) as f32 / INTERVALS as f32
    }

    /// Whether it differs nowhere from `f` by more than `most`.
    pub(super) fn is_like(&self, f: fn(f32) -> f32, most: f32) -> bool {
        (0..=255).all(|code| {
            let x = code as f32 / 255.0;
            (self.decode(x) - f(x)).abs() <= most
        })
    }
}

/// A sampled curve (ICC.1:2022, 10.6) between its samples.
fn interpolated(table: &[u16], x: f64) -> f64 {
    let at = x * (table.len() - 1) as f64;
    let i = (at as usize).min(table.len() - 2);
    let [a, b] = [table[i], table[i + 1]].map(f64::from);
    (a + (b - a) * (at - i as f64)) / 65535.0
}

/// A parametric curve (ICC.1:2022, 10.18): (a·x + b)^g + e from d on, c·x + f below.
struct Formula {
    g: f64,
    a: f64,
    b: f64,
    c: f64,
    d: f64,
    e: f64,
    f: f64,
}

impl Formula {
    fn new(parameters: &[f32]) -> Option<Self> {
        let p: Vec<f64> = parameters.iter().copied().map(f64::from).collect();
        let (g, a, b, c, d, e, f) = match p[..] {
            [g] => (g, 1.0, 0.0, 0.0, 0.0, 0.0, 0.0),
            [g, a, b] => (g, a, b, 0.0, -b / a, 0.0, 0.0),
            [g, a, b, c] => (g, a, b, 0.0, -b / a, c, c),
            [g, a, b, c, d] => (g, a, b, c, d, 0.0, 0.0),
            [g, a, b, c, d, e, f] => (g, a, b, c, d, e, f),
            _ => return None,
        };
        Some(Self { g, a, b, c, d, e, f })
    }

    fn at(&self, x: f64) -> f64 {
        if x < self.d {
            self.c * x + self.f
        } else {
            libm::pow((self.a * x + self.b).max(0.0), self.g) + self.e
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;
    use scumble::pixel::srgb;

    fn gamma(g: f32) -> Curve {
        Curve::new(&ToneReprCurve::Parametric(vec![g])).unwrap()
    }

    const SRGB: [f32; 5] = [2.4, 1.0 / 1.055, 0.055 / 1.055, 1.0 / 12.92, 0.04045];

    #[test]
    fn a_power_is_that_power_within_and_beyond() {
        let curve = gamma(2.2);
        for x in [0.0, 0.001, 0.25, 0.5, 0.999, 1.0, 1.5, 4.0] {
            let expected = libm::pow(f64::from(x), 2.2) as f32;
            assert!((curve.decode(x) - expected).abs() <= 1e-5 * expected + 1e-9, "{x}");
        }
        assert_eq!(curve.decode(-0.5), -curve.decode(0.5));
        assert!(curve.decode(f32::NAN).is_nan() && curve.encode(f32::NAN).is_nan());
    }

    #[test]
    fn srgb_is_known_in_every_spelling() {
        let formula = Curve::new(&ToneReprCurve::Parametric(SRGB.to_vec())).unwrap();
        let codes = |n: u32| (0..n).map(move |i| srgb::decode(i as f32 / (n - 1) as f32));
        let table = codes(1024).map(|v| (v * 65535.0 + 0.5) as u16).collect();
        let table = Curve::new(&ToneReprCurve::Lut(table)).unwrap();
        for curve in [&formula, &table] {
            assert!(curve.is_like(srgb::decode, 1.0 / 4096.0));
        }
        assert!(!gamma(2.2).is_like(srgb::decode, 1.0 / 4096.0));
        let gamma = Curve::new(&ToneReprCurve::Lut(vec![2 * 256])).unwrap();
        assert!((gamma.decode(0.5) - 0.25).abs() < 1e-6);
        assert_eq!(Curve::new(&ToneReprCurve::Lut(vec![])).unwrap().decode(0.3), 0.3);
    }

    #[test]
    fn what_is_no_curve_is_refused() {
        for parameters in [vec![], vec![f32::NAN], vec![0.0], vec![1.0, -1.0, 1.0], vec![1.0; 6]] {
            let found = Curve::new(&ToneReprCurve::Parametric(parameters.clone()));
            assert!(parameters.len() == 6 || found.is_none(), "{parameters:?}");
        }
        assert!(Curve::new(&ToneReprCurve::Lut(vec![9, 9, 9])).is_none());
        assert!(Curve::new(&ToneReprCurve::Lut(vec![9, 0])).is_none());
    }

    #[test]
    fn every_code_comes_back() {
        for curve in [gamma(1.8), gamma(2.2), gamma(1.0)] {
            for code in 0..=65535_u16 {
                let x = f32::from(code) / 65535.0;
                let back = curve.encode(curve.decode(x)) * 65535.0;
                // Powers of codes near 0 are zero to a float; the first few share their light.
                assert!((back - f32::from(code)).abs() < 0.1, "{code} {back}");
            }
        }
    }

    proptest! {
        #[test]
        fn floats_come_back(x in -4.0_f32..8.0, g in 0.5_f32..3.0) {
            let curve = gamma(g);
            let back = curve.encode(curve.decode(x));
            prop_assert!((back - x).abs() <= 1e-4 * x.abs().max(0.05), "{x} {back}");
        }

        #[test]
        fn no_table_breaks_it(table in proptest::collection::vec(any::<u16>(), 0..40), x in any::<f32>()) {
            if let Some(curve) = Curve::new(&ToneReprCurve::Lut(table)) {
                let _ = curve.encode(curve.decode(x));
                let _ = curve.encode(x);
            }
        }
    }
}
