//! Textures that are a function, not an image.
//!
//! A [`Source`] gives a colour for a [`Footprint`]: any closure is one. What it makes of the footprint
//! is its own affair: nothing, and it aliases; the exact mean over it, and it does not. Between the
//! two stand [`Probes`](crate::Probes), which need of the source only that it can average a round spot.

mod grid;

pub use grid::{Antialias, Grid};

use crate::{Footprint, Sampler, Texture};
use scumble_pixel::Premul;

/// Something that has a colour for every footprint.
///
/// ```
/// use scumble_pixel::Premul;
/// use scumble_texture::{Footprint, Probes, procedural::Source};
///
/// // Stripes that fade to their mean as they get finer than the spot.
/// let stripes = |f: &Footprint| {
///     let contrast = (1.0 - f.jacobian.axes().major / 4.0).clamp(0.0, 1.0) as f32;
///     let wave = if f.u.rem_euclid(4.0) < 2.0 { 0.5 } else { -0.5 };
///     Premul([0.5 + contrast * wave, 0.5, 0.5, 1.0])
/// };
/// let color = Probes::new(16).sample(&Footprint::point(1.0, 1.0), &stripes);
/// assert_eq!(color, stripes.color(&Footprint::point(1.0, 1.0)));
/// ```
pub trait Source {
    /// The colour of a footprint: premultiplied, in whatever space the caller works in.
    fn color(&self, f: &Footprint) -> Premul;
}

impl<F: Fn(&Footprint) -> Premul> Source for F {
    fn color(&self, f: &Footprint) -> Premul {
        self(f)
    }
}

/// A texture under a sampler.
impl Source for (&Texture, Sampler) {
    fn color(&self, f: &Footprint) -> Premul {
        self.0.sample(f, &self.1)
    }
}
