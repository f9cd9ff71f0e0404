//! Runs of footprints: one by one, and sixteen in lanes.

use crate::wrap::FAR;
use crate::{Footprint, Texture};
use fearless_simd::{Simd, f32x16, f64x8, mask32x16, prelude::*};
use scumble_geometry::{DVec2, Homography, Matrix2};

/// How many.
pub(crate) const ABREAST: usize = 16;

/// Their numbers, in two halves.
const NUMBERS: [[f64; 8]; 2] =
    [[0., 1., 2., 3., 4., 5., 6., 7.], [8., 9., 10., 11., 12., 13., 14., 15.]];

/// Footprints, by number from 0 on.
pub(crate) trait Run: Copy {
    /// One of them.
    fn at(&self, i: usize) -> Footprint;

    /// The same of eight, from `first` on. Some may be asked for that are not there.
    fn eight<S: Simd>(&self, simd: S, first: usize, numbers: f64x8<S>) -> Eight<S>;

    /// Sixteen, from `first` on.
    #[inline(always)]
    fn sixteen<S: Simd>(&self, simd: S, t: &Texture, first: usize) -> Sixteen<S> {
        let [low, high] = NUMBERS;
        let low = f64x8::load_array(simd, low) + first as f64;
        let high = f64x8::load_array(simd, high) + first as f64;
        let low = self.eight(simd, first, low);
        Sixteen::new(simd, t, &low, &self.eight(simd, first + 8, high))
    }
}

/// Footprints whose centres lie in lanes: u and v, and the Jacobian by rows.
#[derive(Clone, Copy)]
pub(crate) struct Eight<S: Simd> {
    centre: [f64x8<S>; 2],
    jacobian: [f64x8<S>; 4],
}

/// Pixels of a row under a homography.
#[derive(Clone, Copy)]
pub(crate) struct InRow<'a> {
    pub(crate) map: &'a Homography,
    pub(crate) start: DVec2,
}

impl Run for InRow<'_> {
    #[inline(always)]
    fn at(&self, i: usize) -> Footprint {
        Footprint::at(self.map, DVec2::new(self.start.x + i as f64, self.start.y))
    }

    /// [`Footprint::at`].
    #[inline(always)]
    fn eight<S: Simd>(&self, simd: S, _: usize, numbers: f64x8<S>) -> Eight<S> {
        let (x, y) = (numbers + self.start.x, self.start.y);
        let [r0, r1, r2] = &self.map.m;
        let z = row(x, y, r2);
        let w = f64x8::splat(simd, 1.0) / z;
        let w = z.simd_gt(0.0).select(w, f64x8::splat(simd, f64::NAN));
        let (u, v) = (row(x, y, r0) * w, row(x, y, r1) * w);
        let jacobian = [
            entry(simd, r0[0], u * r2[0], w),
            entry(simd, r0[1], u * r2[1], w),
            entry(simd, r1[0], v * r2[0], w),
            entry(simd, r1[1], v * r2[1], w),
        ];
        Eight { centre: [u, v], jacobian }
    }
}

/// A row of a homography times (x, y, 1).
#[inline(always)]
fn row<S: Simd>(x: f64x8<S>, y: f64, r: &[f64; 3]) -> f64x8<S> {
    (x * r[0] + r[1] * y) + r[2]
}

/// A derivative of a homography.
#[inline(always)]
fn entry<S: Simd>(simd: S, r: f64, along: f64x8<S>, w: f64x8<S>) -> f64x8<S> {
    (f64x8::splat(simd, r) - along) * w
}

/// Footprints in memory.
#[derive(Clone, Copy)]
pub(crate) struct Listed<'a>(pub(crate) &'a [Footprint]);

impl Run for Listed<'_> {
    #[inline(always)]
    fn at(&self, i: usize) -> Footprint {
        self.0.get(i).copied().unwrap_or(Footprint::point(0.0, 0.0))
    }

    #[inline(always)]
    fn eight<S: Simd>(&self, simd: S, first: usize, _: f64x8<S>) -> Eight<S> {
        let mut numbers = [[0.0; 8]; 6];
        for i in 0..8 {
            let Footprint { u, v, jacobian: Matrix2 { a, b, c, d } } = self.at(first + i);
            for (lanes, number) in numbers.iter_mut().zip([u, v, a, b, c, d]) {
                lanes[i] = number;
            }
        }
        // A map of the array would be calls that leave the instruction set.
        let [u, v, a, b, c, d] = &numbers;
        Eight {
            centre: [f64x8::load_array_ref(simd, u), f64x8::load_array_ref(simd, v)],
            jacobian: [
                f64x8::load_array_ref(simd, a),
                f64x8::load_array_ref(simd, b),
                f64x8::load_array_ref(simd, c),
                f64x8::load_array_ref(simd, d),
            ],
        }
    }
}

impl<S: Simd> Eight<S> {
    /// The same as [`Texture::nearer`] has them; anything at all for a centre that is not finite.
    #[inline(always)]
    fn near(&self, simd: S, t: &Texture) -> Self {
        let ([u, v], [near_u, near_v]) = (self.centre, &t.nearer);
        let [u, v] = [near_u.bring_lanes(simd, u), near_v.bring_lanes(simd, v)];
        let (Some((u, along_u)), Some((v, along_v))) =
            (near_u.before_mirror_lanes(simd, u), near_v.before_mirror_lanes(simd, v))
        else {
            return Self { centre: [u, v], jacobian: self.jacobian };
        };
        let [a, b, c, d] = self.jacobian;
        let jacobian = [a * along_u, b * along_u, c * along_v, d * along_v];
        Self { centre: [u, v], jacobian }
    }

    /// 0 where the centre is finite, else a NaN.
    #[inline(always)]
    fn lost(&self) -> f64x8<S> {
        let [u, v] = self.centre;
        u * 0.0 + v * 0.0
    }

    #[inline(always)]
    fn determinant(&self) -> f64x8<S> {
        let [a, b, c, d] = self.jacobian;
        a * d - b * c
    }
}

/// Sixteen footprints, brought near, in two halves; and what single precision is enough for.
#[derive(Clone, Copy)]
pub(crate) struct Sixteen<S: Simd> {
    pub(crate) u: [f64x8<S>; 2],
    pub(crate) v: [f64x8<S>; 2],
    /// The Jacobian, by rows, and its determinant.
    pub(crate) jacobian: [f32x16<S>; 4],
    pub(crate) determinant: f32x16<S>,
    /// Whether the centre is finite.
    pub(crate) finite: mask32x16<S>,
    /// Whether all of it is finite and within what the formulas hold.
    pub(crate) usable: mask32x16<S>,
}

impl<S: Simd> Sixteen<S> {
    #[inline(always)]
    fn new(simd: S, t: &Texture, low: &Eight<S>, high: &Eight<S>) -> Self {
        let lost = low.lost().narrow(high.lost());
        let (low, high) = (low.near(simd, t), high.near(simd, t));
        let ([a0, b0, c0, d0], [a1, b1, c1, d1]) = (low.jacobian, high.jacobian);
        let [a, b, c, d] = [a0.narrow(a1), b0.narrow(b1), c0.narrow(c1), d0.narrow(d1)];
        // As in Footprint::is_bounded; a NaN stays one.
        let sum = (a.abs() + b.abs()) + (c.abs() + d.abs());
        Self {
            u: [low.centre[0], high.centre[0]],
            v: [low.centre[1], high.centre[1]],
            jacobian: [a, b, c, d],
            determinant: low.determinant().narrow(high.determinant()),
            finite: lost.simd_eq(0.0),
            usable: (sum + lost).simd_le(FAR as f32),
        }
    }
}
