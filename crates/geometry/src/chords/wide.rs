//! Numbers and points of the plane, eight side by side.

use crate::DVec2;
use core::ops::{Add, Mul, Sub};
use fearless_simd::{Simd, f64x8, mask64x8, prelude::*};

pub(super) const LANES: usize = 8;

/// 0 to 7.
#[inline(always)]
pub(super) fn lanes<S: Simd>(simd: S) -> f64x8<S> {
    f64x8::from_slice(simd, &[0.0, 1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0])
}

/// Eight times the same. (Functions, as closures would not be compiled for the instruction set.)
#[inline(always)]
pub(super) fn splat<S: Simd>(simd: S, v: f64) -> f64x8<S> {
    f64x8::splat(simd, v)
}

#[inline(always)]
pub(super) fn spread<S: Simd>(simd: S, [a, b, c, d]: [f64; 4]) -> [f64x8<S>; 4] {
    [splat(simd, a), splat(simd, b), splat(simd, c), splat(simd, d)]
}

/// The larger of two, or `b` if they cannot be compared.
#[inline(always)]
pub(super) fn larger<S: Simd>(a: f64x8<S>, b: f64x8<S>) -> f64x8<S> {
    a.simd_gt(b).select(a, b)
}

/// Eight points or vectors.
#[derive(Debug, Clone, Copy)]
pub(super) struct Points<S: Simd> {
    pub(super) x: f64x8<S>,
    pub(super) y: f64x8<S>,
}

impl<S: Simd> Points<S> {
    #[inline(always)]
    pub(super) fn splat(simd: S, p: DVec2) -> Self {
        Self { x: splat(simd, p.x), y: splat(simd, p.y) }
    }

    #[inline(always)]
    pub(super) fn dot(self, other: Self) -> f64x8<S> {
        self.x * other.x + self.y * other.y
    }

    #[inline(always)]
    pub(super) fn perp_dot(self, other: Self) -> f64x8<S> {
        self.x * other.y - self.y * other.x
    }

    #[inline(always)]
    pub(super) fn length_squared(self) -> f64x8<S> {
        self.dot(self)
    }

    /// To the right of a vector, as the eye sees it.
    #[inline(always)]
    pub(super) fn perp(self) -> Self {
        Self { x: -self.y, y: self.x }
    }

    #[inline(always)]
    pub(super) fn select(mask: mask64x8<S>, a: Self, b: Self) -> Self {
        Self { x: mask.select(a.x, b.x), y: mask.select(a.y, b.y) }
    }

    /// The last of these, then all but the last of the others.
    #[inline(always)]
    pub(super) fn slide(self, other: Self) -> Self {
        Self { x: self.x.slide::<7>(other.x), y: self.y.slide::<7>(other.y) }
    }
}

impl<S: Simd> Add for Points<S> {
    type Output = Self;

    #[inline(always)]
    fn add(self, other: Self) -> Self {
        Self { x: self.x + other.x, y: self.y + other.y }
    }
}

impl<S: Simd> Sub for Points<S> {
    type Output = Self;

    #[inline(always)]
    fn sub(self, other: Self) -> Self {
        Self { x: self.x - other.x, y: self.y - other.y }
    }
}

impl<S: Simd> Mul<f64x8<S>> for Points<S> {
    type Output = Self;

    #[inline(always)]
    fn mul(self, scale: f64x8<S>) -> Self {
        Self { x: self.x * scale, y: self.y * scale }
    }
}
