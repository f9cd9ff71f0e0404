use crate::ewa::Limits;
use crate::level::Level;
use crate::point;
use crate::run::Run;
use crate::texel::Texel;
use crate::walk::Walk;
use crate::{Texture, Wrap};
use fearless_simd::{Simd, f32x8, i16x8, prelude::*};
use scumble_pixel::Premul;

/// The inner loops, in scalar code or in vectors: the same bits from each.
pub(crate) trait Engine: Copy {
    /// The weighted average of the texels in an ellipse.
    fn walk(self, level: &Level, wrap: Wrap, w: &Walk) -> [f32; 4];

    /// The bilinear mean of two rows of two texels, in steps.
    fn bilinear(self, top: &[Texel; 2], bottom: &[Texel; 2], fx: f32, fy: f32) -> [f32; 4];

    /// Samples a run of footprints with the level chosen by the ellipse, if there is a way that is
    /// quicker than one by one.
    fn ellipses(self, t: &Texture, run: impl Run, limits: &Limits, out: &mut [Premul]) -> bool;
}

/// The definition.
#[derive(Clone, Copy)]
pub(crate) struct Scalar;

/// Vectors of an instruction set, inside a function compiled for it.
#[derive(Clone, Copy)]
pub(crate) struct Vector<S>(pub(crate) S);

impl Engine for Scalar {
    #[inline(always)]
    fn walk(self, level: &Level, wrap: Wrap, w: &Walk) -> [f32; 4] {
        crate::walk::walk(level, wrap, w)
    }

    #[inline(always)]
    fn bilinear(self, top: &[Texel; 2], bottom: &[Texel; 2], fx: f32, fy: f32) -> [f32; 4] {
        point::bilinear(top, bottom, fx, fy)
    }

    fn ellipses(self, _: &Texture, _: impl Run, _: &Limits, _: &mut [Premul]) -> bool {
        false
    }
}

impl<S: Simd> Engine for Vector<S> {
    #[inline(always)]
    fn walk(self, level: &Level, wrap: Wrap, w: &Walk) -> [f32; 4] {
        // A function of its own, compiled once for the instruction set.
        self.0.vectorize(
            #[inline(always)]
            || crate::walk_simd::walk(self.0, level, wrap, w),
        )
    }

    #[inline(always)]
    fn bilinear(self, top: &[Texel; 2], bottom: &[Texel; 2], fx: f32, fy: f32) -> [f32; 4] {
        let top = steps(self.0, top);
        let (left, right) = (top + (steps(self.0, bottom) - top) * fy).split();
        (left + (right - left) * fx).to_array()
    }

    #[inline(always)]
    fn ellipses(self, t: &Texture, run: impl Run, limits: &Limits, out: &mut [Premul]) -> bool {
        self.0.vectorize(
            #[inline(always)]
            || crate::batch::fill(self.0, t, run, limits, out),
        );
        true
    }
}

/// Two texels in steps.
#[inline(always)]
fn steps<S: Simd>(simd: S, texels: &[Texel; 2]) -> f32x8<S> {
    let (a, b) = i16x8::from_slice(simd, texels.as_flattened()).widen();
    a.combine(b).to_float::<f32x8<S>>()
}
