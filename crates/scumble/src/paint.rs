//! What colour a primitive has at a position: the one thing that a tile asks of it.

use crate::painter::centre;
use crate::plan::Surface;
use scumble_framebuffer::Gradient;
use scumble_geometry::{DVec2, Homography, IntRect, Matrix2, Ramp};
use scumble_pixel::Premul;
use scumble_texture::{Footprint, Sampler, Texture};

/// How a primitive is coloured, in the working space.
#[derive(Debug, Clone)]
pub(crate) enum Paint {
    /// One colour.
    Solid(Premul),
    /// Colours interpolated between three corners.
    Gouraud(Box<Ramp<4>>),
    /// An image.
    Textured(Box<Textured>),
}

/// An image laid over the screen by a projective map.
#[derive(Debug, Clone)]
pub(crate) struct Textured {
    /// From pixels to texels of level 0.
    pub(crate) map: Homography,
    /// Which surface of the plan.
    pub(crate) surface: usize,
    /// How it is filtered.
    pub(crate) sampler: Sampler,
    /// Opacity of the whole.
    pub(crate) opacity: f32,
    /// Whether every texel is opaque, so that every pixel is.
    pub(crate) opaque: bool,
}

impl Textured {
    fn texture<'a>(&self, surfaces: &'a [Option<Surface>]) -> Option<&'a Texture> {
        surfaces.get(self.surface)?.as_ref().map(|surface| &surface.texture)
    }

    fn row(&self, surfaces: &[Option<Surface>], start: DVec2, out: &mut [Premul]) {
        let Some(texture) = self.texture(surfaces) else { return out.fill(Premul::TRANSPARENT) };
        texture.sample_row(&self.map, start, &self.sampler, out);
        self.finish(out);
    }

    /// The colour at one position over a footprint `share` times as wide as a pixel's.
    fn share(&self, surfaces: &[Option<Surface>], p: DVec2, share: f64) -> Premul {
        let Some(texture) = self.texture(surfaces) else { return Premul::TRANSPARENT };
        let mut footprint = Footprint::at(&self.map, p);
        footprint.jacobian = footprint.jacobian * Matrix2::new(share, 0.0, 0.0, share);
        let mut color = [texture.sample(&footprint, &self.sampler)];
        self.finish(&mut color);
        color[0]
    }

    fn finish(&self, colors: &mut [Premul]) {
        for color in colors {
            if self.opacity < 1.0 {
                *color = color.scaled(self.opacity);
            }
            // What lies under an opaque primitive may not have been drawn at all, so not the
            // last bit of it may shine through.
            if self.opaque {
                color.0[3] = 1.0;
            }
        }
    }

    /// Whether a position lies before the eye, so that the map means something there.
    fn sees(&self, p: DVec2) -> bool {
        self.map.project_homogeneous(p).z > 0.0
    }
}

impl Paint {
    /// Whether every pixel is opaque.
    pub(crate) fn is_opaque(&self) -> bool {
        match self {
            Self::Solid(color) => color.alpha() >= 1.0,
            Self::Gouraud(ramp) => ramp.low()[3] >= 1.0,
            Self::Textured(textured) => textured.opaque,
        }
    }

    /// The colour over the tile whose top left pixel is `origin`, of what has one that changes evenly.
    pub(crate) fn gradient(&self, origin: (i32, i32)) -> Gradient {
        let plane = match self {
            Self::Solid(color) => return Gradient::constant(*color),
            Self::Gouraud(ramp) => ramp.plane(),
            Self::Textured(_) => None,
        };
        let Some(p) = plane else { return Gradient::constant(Premul::TRANSPARENT) };
        let (x, y) = p.pixel();
        let from = (x.wrapping_sub(origin.0), y.wrapping_sub(origin.1));
        Gradient::new(from, [p.here(), p.right(), p.below()], [p.low(), p.high()])
    }

    /// Whether the centres of all pixels of a rectangle have a colour: whether none lies behind the
    /// eye.
    pub(crate) fn sees_all(&self, rect: IntRect) -> bool {
        let (x, y) = ([rect.x0, rect.x1 - 1], [rect.y0, rect.y1 - 1]);
        match self {
            Self::Textured(t) => x.iter().all(|&x| y.iter().all(|&y| t.sees(centre(x, y)))),
            _ => true,
        }
    }

    /// The corner of a pixel that lies farthest before the eye: in a pixel on the horizon, part of
    /// what is covered.
    pub(crate) fn nearest_corner(&self, x: i32, y: i32) -> DVec2 {
        let corners = [(0, 0), (1, 0), (0, 1), (1, 1)]
            .map(|(dx, dy)| DVec2::new(f64::from(x + dx), f64::from(y + dy)));
        let height = |p: &DVec2| match self {
            Self::Textured(textured) => textured.map.project_homogeneous(*p).z,
            _ => 0.0,
        };
        let farther = |a: DVec2, b: DVec2| if height(&b) > height(&a) { b } else { a };
        corners.into_iter().fold(corners[0], farther)
    }

    /// The colours at `start`, `start` + (1, 0), and so on.
    pub(crate) fn row(&self, surfaces: &[Option<Surface>], start: DVec2, out: &mut [Premul]) {
        match self {
            Self::Solid(color) => out.fill(*color),
            Self::Gouraud(ramp) => ramp.fill(start, out, Premul),
            Self::Textured(textured) => textured.row(surfaces, start, out),
        }
    }

    /// The colour at the position of a sample whose share of the pixel is `share` wide.
    pub(crate) fn sample(&self, surfaces: &[Option<Surface>], p: DVec2, share: f64) -> Premul {
        match self {
            Self::Solid(color) => *color,
            Self::Gouraud(ramp) => Premul(ramp.at(p)),
            Self::Textured(textured) => textured.share(surfaces, p, share),
        }
    }

    /// The colour at one position, or at `fallback` where the first lies behind the eye: the
    /// centre of a pixel on the horizon, whose covered samples do not.
    pub(crate) fn at(
        &self,
        surfaces: &[Option<Surface>],
        p: DVec2,
        fallback: impl FnOnce() -> DVec2,
    ) -> Premul {
        let p = match self {
            Self::Textured(textured) if !textured.sees(p) => fallback(),
            _ => p,
        };
        let mut color = [Premul::TRANSPARENT];
        self.row(surfaces, p, &mut color);
        color[0]
    }
}
