use crate::ewa::Limits;
use crate::level::Level;
use crate::points::Points;
use crate::run::Run;
use crate::square::Square;
use crate::walk::Walk;
use crate::{LevelMode, Texture, Wrap};
use fearless_simd::Simd;
use scumble_pixel::Premul;

/// The inner loops, in scalar code or in vectors: the same bits from each.
pub(crate) trait Engine: Copy {
    /// Calls a function, compiled for the instructions; it and the closures in it are to be inlined.
    fn call<R>(self, f: impl FnOnce() -> R) -> R;

    /// The weighted average of the texels in an ellipse.
    fn walk(self, level: &Level, wrap: Wrap, w: &Walk) -> [f32; 4];

    /// Samples a run of footprints by a filter of a place, if there is a way that is quicker than one by
    /// one.
    fn points(
        self,
        t: &Texture,
        run: impl Run,
        mode: LevelMode,
        filter: impl Points,
        out: &mut [Premul],
    ) -> bool;

    /// Samples a run of footprints with the level chosen by the ellipse, if there is a way that is
    /// quicker than one by one.
    fn ellipses(self, t: &Texture, run: impl Run, limits: &Limits, out: &mut [Premul]) -> bool;

    /// The same for the mean over the pixel's square.
    fn squares(self, t: &Texture, run: impl Run, square: &Square, out: &mut [Premul]) -> bool;
}

/// The definition.
#[derive(Clone, Copy)]
pub(crate) struct Scalar;

/// Vectors of an instruction set, inside a function compiled for it.
#[derive(Clone, Copy)]
pub(crate) struct Vector<S>(pub(crate) S);

impl Engine for Scalar {
    #[inline(always)]
    fn call<R>(self, f: impl FnOnce() -> R) -> R {
        f()
    }

    #[inline(always)]
    fn walk(self, level: &Level, wrap: Wrap, w: &Walk) -> [f32; 4] {
        crate::walk::walk(level, wrap, w)
    }

    fn points(
        self,
        _: &Texture,
        _: impl Run,
        _: LevelMode,
        _: impl Points,
        _: &mut [Premul],
    ) -> bool {
        false
    }

    fn ellipses(self, _: &Texture, _: impl Run, _: &Limits, _: &mut [Premul]) -> bool {
        false
    }

    fn squares(self, _: &Texture, _: impl Run, _: &Square, _: &mut [Premul]) -> bool {
        false
    }
}

impl<S: Simd> Engine for Vector<S> {
    #[inline(always)]
    fn call<R>(self, f: impl FnOnce() -> R) -> R {
        self.0.vectorize(f)
    }

    #[inline(always)]
    fn walk(self, level: &Level, wrap: Wrap, w: &Walk) -> [f32; 4] {
        // A function of its own, compiled once for the instruction set.
        self.call(
            #[inline(always)]
            || crate::walk_simd::walk(self.0, level, wrap, w),
        )
    }

    #[inline(always)]
    fn points(
        self,
        t: &Texture,
        run: impl Run,
        mode: LevelMode,
        filter: impl Points,
        out: &mut [Premul],
    ) -> bool {
        self.call(
            #[inline(always)]
            || crate::points::fill(self.0, t, run, mode, filter, out),
        );
        true
    }

    #[inline(always)]
    fn ellipses(self, t: &Texture, run: impl Run, limits: &Limits, out: &mut [Premul]) -> bool {
        self.call(
            #[inline(always)]
            || crate::batch::fill(self.0, t, run, limits, out),
        );
        true
    }

    #[inline(always)]
    fn squares(self, t: &Texture, run: impl Run, square: &Square, out: &mut [Premul]) -> bool {
        self.call(
            #[inline(always)]
            || crate::square::lanes::fill(self.0, t, run, square, out),
        );
        true
    }
}
