//! The Gaussian pixel over bilinear reconstruction where the pixel sees about a texel or less.
//!
//! There the elliptical filter's one weakness shows: it puts a Gaussian of variance 1/6 in the place
//! of the bilinear tent, and when the pixel's own σ is a fraction of a texel the difference in shape
//! is most of the filter. Instead the integral ∫ g(x)·B(c + Jx) dx of the bilinear surface B is taken
//! as a sum over a few places: four by four across the pixel. Their texels are few, 4×5, and so
//! the weights of the texels are found first.
//!
//! The places are even steps of 1.2095 σ, their weights a Gaussian's, and the step is such that their
//! variance is exactly the pixel's. Gauss and Hermite's four are exact on polynomials of degree seven,
//! but B is none: it has a crease at every texel, and what counts is how far apart the places lie.
//! Measured on a ground plane, the even ones are 2 to 5 dB nearer, and 10 to 30 dB nearer than the
//! ellipse below one texel per pixel along the major axis; on white noise the two meet at 1, on pictures at 1¼ to 1½.

use super::patch::{Patch, Spot, WEIGHT};
use crate::number::Number;

/// Where along an axis, in σ.
const NODES: [f32; 4] = [-INNER * 3.0, -INNER, INNER, INNER * 3.0];

/// Half a step.
const INNER: f32 = 0.604_775_8;

/// Weights of [`NODES`].
const WEIGHTS: [f32; 4] = [OUTER_WEIGHT, 0.5 - OUTER_WEIGHT, 0.5 - OUTER_WEIGHT, OUTER_WEIGHT];

/// That of the outer two: INNER²·(1 + 16w) = 1 makes the variance 1.
const OUTER_WEIGHT: f32 = 0.108_38;

/// Texels per pixel, as the root of the mean square of both axes, up to which the taps are taken alone.
/// The major axis by itself would count a long thin footprint as a round one, for which the ellipse is
/// better sooner.
pub(crate) const FROM: f32 = 0.6;

/// And from which on not at all.
pub(crate) const TO: f32 = 0.775;

/// Columns and rows of texels that hold all places up to [`TO`]: those lie within 3.63 σ, which is at most
/// √½·[`TO`], along columns, and within √2 times as much along rows.
pub(crate) const COLUMNS: usize = 4;
pub(crate) const ROWS: usize = 5;

/// Rows that hold the places of most pixels: those that lie less than so many, less one, below the first, by a
/// margin for rounding.
pub(crate) const FEW_ROWS: usize = 3;
pub(crate) const FEW: f32 = (FEW_ROWS - 1) as f32 - 0.01;

const _: () =
    assert!(2.0 * NODES[3] * core::f32::consts::FRAC_1_SQRT_2 * TO < (COLUMNS - 2) as f32);
const _: () = assert!(2.0 * NODES[3] * TO < (ROWS - 2) as f32);

/// The sixteen places of a footprint: the spot + p·`first` + q·(0, `second`).
///
/// The two columns are half of a triangular root L of JJᵀ = LLᵀ, which any two Jacobians of the same
/// ellipse have in common, and which takes one root to find. The ellipse's own axes would serve no
/// better.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Places<N> {
    /// The texel that the first place lies in, from the spot's: whole numbers.
    low: [N; 2],
    /// The spot, from there.
    centre: [N; 2],
    first: [N; 2],
    second: N,
}

impl<N: Number> Places<N> {
    #[inline(always)]
    pub(crate) fn new(spot: &Spot<N>) -> Self {
        let [a, b, c, d] = spot.jacobian;
        let zero = spot.x.all(0.0);
        let root = (a * a + b * b).sqrt();
        let inverse = root.if_positive(root.all(0.5) / root, zero);
        let along = [root * 0.5, inverse * (a * c + b * d)];
        // Without a first row there is only the second.
        let other = (c * c + d * d).sqrt() * 0.5;
        let second = root.if_positive(inverse * spot.determinant.abs(), other);
        let far = NODES[3];
        let low =
            [(spot.x - along[0] * far).floor(), (spot.y - (along[1].abs() + second) * far).floor()];
        Self { low, centre: [spot.x - low[0], spot.y - low[1]], first: along, second }
    }

    /// How far below the first row of texels the last place lies.
    #[inline(always)]
    pub(crate) fn last(&self) -> N {
        self.centre[1] + (self.first[1].abs() + self.second) * NODES[3]
    }

    /// The weights of the texels. A place beyond them counts as the nearest.
    ///
    /// A place between two texels gives to those from the second on what it is beyond the first. So
    /// the shares of all texels from one on are ramps, and a texel's own is the difference of two; and
    /// four places share a column.
    #[inline(always)]
    pub(crate) fn patch<const R: usize>(&self) -> Patch<N, COLUMNS, R> {
        let zero = self.second.all(0.0);
        let mut weights = [[zero; COLUMNS]; R];
        for (p, weight) in NODES.into_iter().zip(WEIGHTS) {
            let x = self.centre[0] + self.first[0] * p;
            let y = self.centre[1] + self.first[1] * p;
            let rows = self.rows::<R>(y);
            let columns: [N; COLUMNS] = shares(
                #[inline(always)]
                |c| (x - c).within_unit() * (weight * WEIGHT),
                zero.all(weight * WEIGHT),
            );
            for r in 0..R {
                for c in 0..COLUMNS {
                    weights[r][c] = weights[r][c] + rows[r] * columns[c];
                }
            }
        }
        Patch { low: self.low, weights }
    }

    /// The shares of rows in the four places about (·, y).
    #[inline(always)]
    fn rows<const R: usize>(&self, y: N) -> [N; R] {
        let [outer, inner, ..] = WEIGHTS;
        let (far, near) = (self.second * NODES[3], self.second * NODES[2]);
        let [a, b, c, d] = [y - far, y - near, y + near, y + far];
        shares(
            #[inline(always)]
            |r| {
                let ends = (a - r).within_unit() + (d - r).within_unit();
                let middle = (b - r).within_unit() + (c - r).within_unit();
                ends * outer + middle * inner
            },
            y.all(1.0),
        )
    }
}

/// The shares of so many texels in a row, from the share of all those behind each, and that of all.
#[inline(always)]
fn shares<N: Number, const M: usize>(beyond: impl Fn(f32) -> N, all: N) -> [N; M] {
    let mut shares = [all; M];
    let mut rest = all;
    for (i, share) in shares.iter_mut().enumerate().take(M - 1) {
        let next = beyond(i as f32);
        *share = rest - next;
        rest = next;
    }
    shares[M - 1] = rest;
    shares
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_places_have_the_variance_of_a_gaussian_and_its_weights() {
        let sum = |power: i32| -> f64 {
            NODES.iter().zip(WEIGHTS).map(|(x, w)| f64::from(*x).powi(power) * f64::from(w)).sum()
        };
        assert!((sum(0) - 1.0).abs() < 1e-7);
        assert!((sum(2) - 1.0).abs() < 1e-7, "{}", sum(2));
        // One Gaussian through both weights; a little narrower than 1, for it is cut off.
        let ratio = f64::from(WEIGHTS[1] / WEIGHTS[0]).ln();
        let variance = 0.5 * 8.0 * f64::from(INNER * INNER) / ratio;
        assert!((1.0..1.2).contains(&variance), "{variance}");
        assert_eq!(WEIGHTS.iter().sum::<f32>(), 1.0);
    }
}
