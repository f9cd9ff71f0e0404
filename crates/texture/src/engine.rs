use crate::abreast::{ABREAST, IDLE, Sheet, Walks};
use crate::level::Level;
use crate::point;
use crate::texel::Texel;
use crate::walk::Walk;
use crate::{Texture, Wrap};
use fearless_simd::{Simd, f32x8, i16x8, prelude::*};

/// The inner loops, in scalar code or in vectors: the same bits from each.
pub(crate) trait Engine: Copy {
    /// The weighted average of the texels in an ellipse.
    fn walk(self, level: &Level, wrap: Wrap, w: &Walk) -> [f32; 4];

    /// The bilinear mean of two rows of two texels, in steps.
    fn bilinear(self, top: &[Texel; 2], bottom: &[Texel; 2], fx: f32, fy: f32) -> [f32; 4];

    /// Sixteen walks, of those that are not idle.
    fn walk_all(self, t: &Texture, walks: &Walks, sheet: &mut Sheet, out: &mut [[f32; 4]; ABREAST]);
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

    fn walk_all(self, t: &Texture, walks: &Walks, _: &mut Sheet, out: &mut [[f32; 4]; ABREAST]) {
        for i in (0..ABREAST).filter(|i| walks.how[*i] != IDLE) {
            out[i] = self.walk(&t.levels[walks.level[i] as usize], t.wrap, &walks.get(i));
        }
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
    fn walk_all(
        self,
        t: &Texture,
        walks: &Walks,
        sheet: &mut Sheet,
        out: &mut [[f32; 4]; ABREAST],
    ) {
        self.0.vectorize(
            #[inline(always)]
            || crate::abreast::walk_all(self.0, t, walks, sheet, out),
        );
    }
}

/// Two texels in steps.
#[inline(always)]
fn steps<S: Simd>(simd: S, texels: &[Texel; 2]) -> f32x8<S> {
    let (a, b) = i16x8::from_slice(simd, texels.as_flattened()).widen();
    a.combine(b).to_float::<f32x8<S>>()
}
