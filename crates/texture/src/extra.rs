//! The samplers beside the fast ones: other kernels, magnification, probes, the classic method.
//!
//! Some footprints at a time; what the fast path can do of them it does.

use crate::batch::WORTH;
use crate::classic::Classic;
use crate::covariance::{products, single};
use crate::engine::{Engine, Scalar, Vector};
use crate::magnify::patch::Spotted;
use crate::radial::Radial;
use crate::run::{Listed, Run};
use crate::square::Square;
use crate::texture::point_mode;
use crate::{Footprint, Kernel, LevelMode, Magnify, PixelFilter, Sampler, Separable, Texture};
use crate::{place, point, probes};
use fearless_simd::dispatch;
use scumble_pixel::Premul;

/// Pixels at a time: the fast path has a start-up cost.
const BATCH: usize = 64;

/// The footprints of a batch: all of them, because the fast path sets up as many whatever it writes.
type Footprints = [Footprint; BATCH];

/// Whether a sampler is for this module.
#[inline(always)]
pub(crate) fn takes(s: &Sampler) -> bool {
    match s.pixel {
        PixelFilter::Nearest | PixelFilter::Bilinear => false,
        PixelFilter::Ewa => s.kernel != Kernel::Gaussian || matches!(s.magnify, Magnify::Radial(_)),
        PixelFilter::Separable(_) | PixelFilter::Probes | PixelFilter::Classic => true,
    }
}

/// Samples a run of footprints, compiled for the texture's instructions.
pub(crate) fn fill(t: &Texture, run: impl Run, s: &Sampler, out: &mut [Premul]) {
    match t.simd.0 {
        None => fill_impl(Scalar, t, run, s, out),
        Some(level) => dispatch!(level, simd => fill_impl(Vector(simd), t, run, s, out)),
    }
}

#[inline(always)]
fn fill_impl(engine: impl Engine, t: &Texture, run: impl Run, s: &Sampler, out: &mut [Premul]) {
    let area = Area::new(s);
    if let Area::Square(square) = &area
        && s.takes_squares()
        && fill_squares(engine, t, run, square, out)
    {
        return;
    }
    for (chunk, out) in out.chunks_mut(BATCH).enumerate() {
        let mut footprints = [Footprint::point(0.0, 0.0); BATCH];
        for (i, f) in footprints[..out.len()].iter_mut().enumerate() {
            *f = run.at(chunk * BATCH + i);
        }
        area.fill(engine, t, &footprints, s, out);
    }
}

/// A filter, made ready.
enum Area {
    Radial(Radial),
    Square(Square),
    Classic(Classic),
    /// At most so many.
    Probes(u32),
    /// None: a filter of the place.
    Separable(Separable),
}

impl Area {
    #[inline(always)]
    fn new(s: &Sampler) -> Self {
        match s.pixel {
            PixelFilter::Separable(kernel) => return Self::Separable(kernel),
            PixelFilter::Classic => return Self::Classic(Classic::new(s)),
            PixelFilter::Probes => {
                // In this order a NaN becomes 1.
                let ratio = s.max_eccentricity.max(1.0);
                return Self::Probes((2.0 * ratio.min(512.0) - 1.0) as u32);
            }
            _ => (),
        }
        match (s.kernel, s.magnify) {
            (_, Magnify::Radial(_)) => Self::Radial(Radial::new(s)),
            (Kernel::Box, _) => Self::Square(Square::new(s)),
            _ => Self::Radial(Radial::new(s)),
        }
    }

    /// How much of a footprint's colour is what is magnified apart.
    #[inline(always)]
    fn nearness(&self, magnify: Magnify, f: &Footprint) -> f32 {
        match (self, magnify) {
            (Self::Separable(_), _) => 0.0,
            // They are of the Gaussian.
            (_, Magnify::Taps) => 0.0,
            _ => magnify.nearness(products(single(&f.jacobian))),
        }
    }

    /// The filter of the area, and of the place where that is magnified.
    #[inline(always)]
    fn fill(
        &self,
        engine: impl Engine,
        t: &Texture,
        footprints: &Footprints,
        s: &Sampler,
        out: &mut [Premul],
    ) {
        let mut near = [0.0f32; BATCH];
        if s.magnify.is_apart() {
            for (near, f) in near.iter_mut().zip(footprints) {
                *near = self.nearness(s.magnify, f);
            }
        }
        let near = &near[..out.len()];
        if near.iter().any(|n| *n < 1.0) {
            self.fill_area(engine, t, footprints, s, out);
        }
        let mut magnified = [Premul::TRANSPARENT; BATCH];
        let magnified = &mut magnified[..out.len()];
        fill_magnified(t, footprints, s.magnify, near, magnified);
        for ((out, magnified), &near) in out.iter_mut().zip(magnified).zip(near) {
            if near > 0.0 {
                *out = if near < 1.0 { mix(t, *out, *magnified, near) } else { *magnified };
            }
        }
    }

    #[inline(always)]
    fn fill_area(
        &self,
        engine: impl Engine,
        t: &Texture,
        footprints: &Footprints,
        s: &Sampler,
        out: &mut [Premul],
    ) {
        match self {
            Self::Separable(kernel) => {
                let mode = point_mode(s);
                for (out, f) in out.iter_mut().zip(footprints) {
                    let f = t.nearer(f);
                    let color = || t.within_range(place::sample(t, &f, mode, *kernel));
                    *out = if f.is_finite() { color() } else { t.average() };
                }
            }
            Self::Radial(radial) => each(t, footprints, out, |f| radial.sample(engine, t, f)),
            Self::Square(square) => {
                if !fill_squares(engine, t, Listed(footprints), square, out) {
                    each(t, footprints, out, |f| square.sample(t, f));
                }
            }
            Self::Classic(classic) => each(t, footprints, out, |f| classic.sample(t, f)),
            Self::Probes(most) => {
                let mode = point_mode(s);
                each(t, footprints, out, |f| probes::sample(t, f, mode, *most));
            }
        }
    }
}

/// The means over a run of squares, if there is a way that is quicker than one by one.
#[inline(always)]
fn fill_squares(
    engine: impl Engine,
    t: &Texture,
    run: impl Run,
    square: &Square,
    out: &mut [Premul],
) -> bool {
    out.len() >= WORTH && !t.levels[0].is_float() && engine.squares(t, run, square, out)
}

/// Samples each footprint that is bounded; the others are the mean of the texture.
#[inline(always)]
fn each(
    t: &Texture,
    footprints: &Footprints,
    out: &mut [Premul],
    sample: impl Fn(&Footprint) -> [f32; 4],
) {
    for (out, f) in out.iter_mut().zip(footprints) {
        let f = t.nearer(f);
        *out =
            if f.is_finite() && f.is_bounded() { t.within_range(sample(&f)) } else { t.average() };
    }
}

/// The magnified texture under those footprints of a batch that are `near`.
#[inline(always)]
fn fill_magnified(
    t: &Texture,
    footprints: &Footprints,
    magnify: Magnify,
    near: &[f32],
    out: &mut [Premul],
) {
    if near.iter().all(|n| *n <= 0.0) {
        return;
    }
    if magnify == Magnify::Bilinear {
        let s = Sampler::DEFAULT.with(PixelFilter::Bilinear, LevelMode::Zero);
        return t.fill_fast(Listed(footprints), &s, out);
    }
    for ((out, f), &near) in out.iter_mut().zip(footprints).zip(near) {
        if near > 0.0 {
            *out = t.within_range(magnified(t, f, magnify));
        }
    }
}

/// The magnified texture under a footprint.
#[inline(always)]
fn magnified(t: &Texture, f: &Footprint, magnify: Magnify) -> [f32; 4] {
    let f = t.nearer(f);
    if !f.is_finite() {
        return t.average().0;
    }
    let level = &t.levels[0];
    magnify.sample(level, t.wrap, &Spotted::new(level, f.u, f.v, &f.jacobian))
}

/// a + (b − a)·part, no brighter than its alpha.
#[inline(always)]
fn mix(t: &Texture, a: Premul, b: Premul, part: f32) -> Premul {
    t.within_range(point::lerp(a.0, b.0, part))
}

/// Texels that a sample reads, those of weight 0 included; the centre has been brought near.
pub(crate) fn cost(t: &Texture, f: &Footprint, s: &Sampler) -> usize {
    let area = Area::new(s);
    if let Area::Separable(kernel) = area {
        return place::cost(t, f, point_mode(s), kernel);
    }
    let near = area.nearness(s.magnify, f);
    let magnified = if near > 0.0 { s.magnify.texels() } else { 0 };
    if near >= 1.0 {
        return magnified;
    }
    if !f.is_bounded() {
        return 0;
    }
    magnified
        + match area {
            Area::Separable(_) => 0,
            Area::Radial(radial) => radial.cost(t, f),
            Area::Square(square) => square.cost(t, f),
            Area::Classic(classic) => classic.cost(t, f),
            Area::Probes(most) => probes::cost(t, f, point_mode(s), most),
        }
}
