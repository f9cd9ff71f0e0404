//! A few texels in a rectangle and their weights: what every filter of a magnified texture comes to.

use crate::Wrap;
use crate::covariance::single;
use crate::level::Level;
use crate::math::{floor, whole};
use crate::number::Number;
use crate::texel::{ROUNDER, Texel};
use crate::walk::mean;
use scumble_geometry::Matrix2;

/// What weights are counted in. Rounded to whole numbers their sums are exact, in any order; what that
/// takes away is noise at −90 dB.
///
/// A sum fits 31 bits: even Lanczos's weights come to 1.7 of these in magnitude, times texels of at most
/// 20,400.
pub(crate) const WEIGHT: f32 = 16_384.0;

/// A place in a level, or sixteen of them.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Spot<N> {
    /// From the centre of the texel above and to the left, in [0, 1].
    pub(crate) x: N,
    pub(crate) y: N,
    /// The Jacobian, by rows, and its determinant, in texels of the level.
    pub(crate) jacobian: [N; 4],
    pub(crate) determinant: N,
}

/// A spot in a level, and the texel that it counts from.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Spotted {
    pub(crate) base: [i32; 2],
    pub(crate) spot: Spot<f32>,
}

impl Spotted {
    /// Of a place and a Jacobian in texels of the image, the place finite and brought near.
    #[inline(always)]
    pub(crate) fn new(level: &Level, u: f64, v: f64, j: &Matrix2) -> Self {
        let [su, sv] = level.frame.scale;
        let (u, v) = (u * su - 0.5, v * sv - 0.5);
        let (x, y) = (floor(u), floor(v));
        let spot = Spot {
            x: (u - x) as f32,
            y: (v - y) as f32,
            jacobian: single(j),
            determinant: j.determinant() as f32,
        };
        Self { base: [whole(x), whole(y)], spot: spot.scaled([su, sv]) }
    }
}

impl<N: Number> Spot<N> {
    /// With the Jacobian in texels of a level instead of the image's.
    #[inline(always)]
    pub(crate) fn scaled(self, [su, sv]: [f64; 2]) -> Self {
        let [a, b, c, d] = self.jacobian;
        let (x, y, both) = (su as f32, sv as f32, (su * sv) as f32);
        let jacobian = [a * x, b * x, c * y, d * y];
        Self { jacobian, determinant: self.determinant * both, ..self }
    }
}

/// The weights of `R` rows of `C` texels, in [`WEIGHT`]s, and the first texel from the spot's: whole
/// numbers.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Patch<N, const C: usize, const R: usize> {
    pub(crate) low: [N; 2],
    pub(crate) weights: [[N; C]; R],
}

impl<N: Number, const C: usize, const R: usize> Patch<N, C, R> {
    /// The products of the weights of columns and rows.
    #[inline(always)]
    pub(crate) fn product(low: [N; 2], columns: [N; C], rows: [N; R]) -> Self {
        let [zero, _] = low;
        let mut weights = [[zero; C]; R];
        for r in 0..R {
            let row = rows[r] * WEIGHT;
            for c in 0..C {
                weights[r][c] = row * columns[c];
            }
        }
        Self { low, weights }
    }
}

impl<const C: usize, const R: usize> Patch<f32, C, R> {
    /// The colour: the definition.
    #[inline(always)]
    pub(crate) fn average(&self, level: &Level, wrap: Wrap, base: [i32; 2]) -> [f32; 4] {
        let [x, y] = [0, 1].map(|axis| base[axis].wrapping_add(self.low[axis] as i32));
        if level.is_float() {
            return self.average_floats(level, wrap, [x, y]);
        }
        let texels = square::<C, R>(level, wrap, x, y);
        let mut sums = [0i32; 4];
        let mut total = 0;
        for (texels, weights) in texels.iter().zip(&self.weights) {
            for (texel, weight) in texels.iter().zip(weights) {
                let weight = (weight + ROUNDER).to_bits() as i32 - ROUNDER.to_bits() as i32;
                total += weight;
                for (sum, t) in sums.iter_mut().zip(texel) {
                    *sum += weight * i32::from(*t);
                }
            }
        }
        mean(sums.map(f64::from), 1.0 / f64::from(total))
    }

    /// The same of floats, about a texel, so that a constant stays what it is.
    fn average_floats(&self, level: &Level, wrap: Wrap, [x, y]: [i32; 2]) -> [f32; 4] {
        let texel = |c: usize, r: usize| {
            level.texel(x.wrapping_add(c as i32), y.wrapping_add(r as i32), wrap)
        };
        let total: f32 = self.weights.as_flattened().iter().sum();
        let centre = texel(C / 2, R / 2);
        let mut sum = [0.0; 4];
        for (r, weights) in self.weights.iter().enumerate() {
            for (c, weight) in weights.iter().enumerate() {
                let texel = texel(c, r);
                for i in 0..4 {
                    sum[i] += (texel[i] - centre[i]) * weight;
                }
            }
        }
        core::array::from_fn(|i| centre[i] + sum[i] / total)
    }
}

/// `R` rows of `C` texels, the first at (x, y); they may lie outside.
#[inline(always)]
fn square<const C: usize, const R: usize>(
    level: &Level,
    wrap: Wrap,
    x: i32,
    y: i32,
) -> [[Texel; C]; R] {
    // Places are brought near, so that this fits.
    if level.holds([x, y], [x + C as i32 - 1, y + R as i32 - 1]) {
        let first = level.index(x, y);
        let row = |r: usize| level.texels.whole().run(first + r * level.stride);
        if let (Some(_), Some(_)) = (row(0), row(R - 1)) {
            return core::array::from_fn(|r| row(r).unwrap_or([[0; 4]; C]));
        }
    }
    square_across(level, wrap, x, y)
}

/// The same, one by one.
#[cold]
#[inline(never)]
fn square_across<const C: usize, const R: usize>(
    level: &Level,
    wrap: Wrap,
    x: i32,
    y: i32,
) -> [[Texel; C]; R] {
    let texel =
        |c: usize, r: usize| level.stored(x.wrapping_add(c as i32), y.wrapping_add(r as i32), wrap);
    core::array::from_fn(|r| core::array::from_fn(|c| texel(c, r)))
}
