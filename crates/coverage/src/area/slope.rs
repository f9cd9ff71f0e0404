//! One edge within one row: the definition of its part in each pixel.

use crate::fixed::{floor, low_bits};
use fearless_simd::{Simd, f64x8, prelude::*};

/// An edge from top to bottom, in pixels.
///
/// It is kept so that it runs right: one that runs left is seen in the mirror (x → −x, so that
/// pixel c becomes pixel −c − 1).
#[derive(Debug, Clone, Copy)]
pub(crate) struct Slope {
    /// −1 in the mirror, else +1.
    pub(crate) sign: f64,
    pub(crate) x0: f64,
    pub(crate) y0: f64,
    /// |Δx/Δy|.
    pub(crate) run: f64,
    /// ½ |Δy/Δx|; 0 for a vertical edge, which is never on its way through a pixel.
    pub(crate) half_rise: f64,
}

impl Slope {
    /// From (x0, y0) down to (x1, y1) in 1/256 pixel, y0 < y1.
    #[inline(always)]
    pub(crate) fn new(x0: i32, y0: i32, x1: i32, y1: i32) -> Self {
        let sign = if x1 < x0 { -1.0 } else { 1.0 };
        let dx = (f64::from(x1) - f64::from(x0)).abs();
        let dy = f64::from(y1) - f64::from(y0);
        let x = f64::from(x0) * (1.0 / 256.0);
        Self {
            sign,
            x0: sign * x,
            y0: f64::from(y0) * (1.0 / 256.0),
            run: dx / dy,
            half_rise: if dx == 0.0 { 0.0 } else { 0.5 * dy / dx },
        }
    }

    /// (Mirrored) x at a height in pixels.
    #[inline(always)]
    pub(crate) fn along(&self, y: f64) -> f64 {
        self.x0 + (y - self.y0) * self.run
    }

    /// x at a height in pixels.
    #[inline(always)]
    pub(crate) fn at(&self, y: f64) -> f64 {
        self.sign * self.along(y)
    }

    /// The edge from `start`, the height at which it enters the row (the row's top or its own),
    /// down to `y` within the same row.
    #[inline(always)]
    pub(crate) fn reach(&self, start: f64, y: f64) -> Reach {
        Reach {
            sign: self.sign,
            from: self.along(start),
            to: self.along(y),
            height: y - start,
            half_rise: self.half_rise,
        }
    }
}

/// An edge within one row of pixels, from where it enters it down to some height.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Reach {
    pub(crate) sign: f64,
    /// The (mirrored) x at both ends, `from` ≤ `to`.
    pub(crate) from: f64,
    pub(crate) to: f64,
    pub(crate) height: f64,
    pub(crate) half_rise: f64,
}

/// The first and the last pixel between two x, held to one beyond `x0..x1`.
#[inline(always)]
pub(crate) fn touched([left, right]: [f64; 2], x0: i32, x1: i32) -> (i32, i32) {
    // Held while still real: the numbers may be far outside.
    let (low, high) = (f64::from(x0) - 1.0, f64::from(x1));
    let column = |x: f64| low_bits(floor(smaller(larger(x, low), high)));
    (column(left), column(right))
}

// One instruction each, as they need not care about NaN.
#[inline(always)]
fn smaller(a: f64, b: f64) -> f64 {
    if a < b { a } else { b }
}

#[inline(always)]
fn larger(a: f64, b: f64) -> f64 {
    if a > b { a } else { b }
}

/// From left to right: two (mirrored) x of an edge.
#[inline(always)]
pub(crate) fn extent(sign: f64, from: f64, to: f64) -> [f64; 2] {
    let (a, b) = (sign * from, sign * to);
    [smaller(a, b), larger(a, b)]
}

impl Reach {
    /// Of no height.
    pub(crate) const NONE: Self =
        Self { sign: 1.0, from: 0.0, to: 0.0, height: 0.0, half_rise: 0.0 };

    /// The leftmost and the rightmost x.
    #[inline(always)]
    pub(crate) fn extent(&self) -> [f64; 2] {
        extent(self.sign, self.from, self.to)
    }

    /// ∫ clamp(c + 1 − x(t), 0, 1) dt for a (mirrored) pixel c: the definition.
    ///
    /// With u₀ and u₁ the sides of the pixel, held to the ends of the edge, all of the pixel is right
    /// of the edge until u₀ and less and less of it until u₁. That makes
    /// ½ rise (u₁ − u₀)(u₀ + u₁ − 2·from) left of u₁, and what lies beyond the end of the edge is
    /// right of it all the time.
    ///
    /// A function of the edge, the row, the pixel and the height, which changes by whole units once
    /// the edge has left the pixel: so it does not matter at which heights a sum is cut.
    #[cfg(test)]
    pub(crate) fn part(&self, c: f64) -> f64 {
        let end = c + 1.0;
        let before = smaller(larger(c, self.from), self.to);
        let after = smaller(larger(end, self.from), self.to);
        let within = self.half_rise * (after - before);
        let sum = (before - self.from) + (after - self.from);
        let beyond = smaller(larger(end - self.to, 0.0), 1.0);
        (within * sum + self.height * beyond + ROUNDER) - ROUNDER
    }

    /// What lies right of the edge in pixel `x`.
    #[cfg(test)]
    pub(crate) fn right(&self, x: f64) -> f64 {
        // What is left behind in the mirror lies left of the edge: the rest is right of it.
        let (c, all) = mirrored(self.sign, x, self.height);
        all + self.sign * self.part(c)
    }
}

/// 1.5 × 2²⁰ leaves 32 bits after the point: adding it to |v| < 2¹⁹ and taking it away again rounds
/// to the nearest multiple of 2⁻³².
const ROUNDER: f64 = 1_572_864.0;

/// [`Reach::part`] of eight pixels, whose left sides are `c`.
///
/// `half_rise` and `height` may carry a sign, which the result takes on.
#[inline(always)]
pub(crate) fn eight_parts<S: Simd>(
    simd: S,
    c: f64x8<S>,
    [from, to]: [f64; 2],
    height: f64,
    half_rise: f64,
) -> f64x8<S> {
    let ends = [splat(simd, from), splat(simd, to)];
    rounded_parts(simd, c, ends, splat(simd, height), splat(simd, half_rise))
}

/// [`eight_parts`] of an edge each.
#[inline(always)]
pub(crate) fn rounded_parts<S: Simd>(
    simd: S,
    c: f64x8<S>,
    [from, to]: [f64x8<S>; 2],
    height: f64x8<S>,
    half_rise: f64x8<S>,
) -> f64x8<S> {
    let end = c + splat(simd, 1.0);
    let before = c.max(from).min(to);
    let after = end.max(from).min(to);
    let within = half_rise * (after - before);
    let sum = (before - from) + (after - from);
    let beyond = (end - to).max(splat(simd, 0.0)).min(splat(simd, 1.0));
    (within * sum + height * beyond + splat(simd, ROUNDER)) - splat(simd, ROUNDER)
}

/// For a `sign` of −1 the mirror of pixel `x`, and what is to be added to the part left behind there:
/// `all`. For +1 the pixel itself, and nothing. (Without a branch, which nobody could foresee.)
#[inline(always)]
pub(crate) fn mirrored(sign: f64, x: f64, all: f64) -> (f64, f64) {
    let is_mirrored = 0.5 - 0.5 * sign;
    (sign * x - is_mirrored, is_mirrored * all)
}

/// [`mirrored`] of an edge and a pixel each.
#[inline(always)]
pub(crate) fn mirrored_eight<S: Simd>(
    simd: S,
    sign: f64x8<S>,
    x: f64x8<S>,
    all: f64x8<S>,
) -> (f64x8<S>, f64x8<S>) {
    let is_mirrored = splat(simd, 0.5) - splat(simd, 0.5) * sign;
    (sign * x - is_mirrored, is_mirrored * all)
}

/// Eight times the same. (A function, as a closure would not be compiled for the instruction set.)
#[inline(always)]
pub(crate) fn splat<S: Simd>(simd: S, v: f64) -> f64x8<S> {
    f64x8::splat(simd, v)
}

/// Eight areas, held to 0..=1.
#[inline(always)]
pub(crate) fn eight_areas<S: Simd>(simd: S, sums: f64x8<S>) -> [f32; 8] {
    let mut held = [0.0; 8];
    sums.max(splat(simd, 0.0)).min(splat(simd, 1.0)).store_slice(&mut held);
    let mut areas = [0.0; 8];
    for (area, v) in areas.iter_mut().zip(held) {
        *area = v as f32;
    }
    areas
}
