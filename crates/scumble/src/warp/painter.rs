//! From pixels of the output to colours: the one place that samples.

use super::border::{Border, Edge};
use super::view::View;
use super::{Map, Warp};
use crate::geometry::DVec2;
use crate::pixel::Premul;
use crate::texture::{Footprint, PixelFilter, Sampler, Texture};

/// Footprints of a map of one's own that are sampled together.
const BATCH: usize = 64;

/// A warp, ready to be asked for pixels.
#[derive(Debug)]
pub(super) struct Painter<'a, M> {
    map: &'a M,
    texture: &'a Texture,
    sampler: Sampler,
    /// If the map is a homography.
    view: Option<View>,
    /// The edge of the source, if it is to be drawn.
    edge: Option<Edge>,
    /// What lies beyond it.
    ground: Premul,
}

/// The middle of a pixel.
pub(super) fn centre(x: i32, y: i32) -> DVec2 {
    DVec2::new(f64::from(x) + 0.5, f64::from(y) + 0.5)
}

impl<'a, M: Map> Painter<'a, M> {
    /// `opaque` says whether the source is: whether the texture's alpha is the share of the source.
    pub(super) fn new(warp: &'a Warp<M>, texture: &'a Texture, opaque: bool) -> Self {
        let size = [texture.width(), texture.height()];
        // The nearest texel has no edge but its own.
        let drawn = opaque && warp.border.ends() && warp.sampler.pixel != PixelFilter::Nearest;
        let ground = match warp.border {
            Border::Constant(color) => warp.space.import(color),
            _ => Premul::TRANSPARENT,
        };
        Self {
            map: &warp.map,
            texture,
            sampler: warp.sampler,
            view: warp.map.homography().map(|map| View::new(map, drawn.then_some(size))),
            edge: drawn.then(|| Edge::new(size, &warp.sampler)),
            ground,
        }
    }

    /// What lies beyond the edge of the source.
    pub(super) fn ground(&self) -> Premul {
        self.ground
    }

    /// The colours of a run of pixels of row `y` from column `x` on.
    pub(super) fn row(&self, x: i32, y: i32, out: &mut [Premul]) {
        match (&self.view, self.map.homography()) {
            (Some(view), Some(map)) => {
                let (start, count) = (centre(x, y), out.len());
                out.fill(Premul::TRANSPARENT);
                if view.is_blind() {
                    return;
                }
                if self.edge.is_some() {
                    out[view.ahead(start, count)].fill(self.ground);
                }
                let clear = view.clear(start, count);
                let first = DVec2::new(start.x + clear.start as f64, start.y);
                let run = &mut out[clear.clone()];
                self.texture.sample_row(&map, first, &self.sampler, run);
                if self.edge.is_some() {
                    for (i, color) in run.iter_mut().enumerate() {
                        if color.alpha() < 1.0 {
                            let p = DVec2::new(first.x + i as f64, first.y);
                            *color = self.finish(*color, &Footprint::at(&map, p));
                        }
                    }
                }
                for i in view.near(start, count) {
                    out[i] = self.pixel(DVec2::new(start.x + i as f64, start.y));
                }
            }
            _ => {
                for (chunk, out) in out.chunks_mut(BATCH).enumerate() {
                    self.batch(
                        DVec2::new(f64::from(x) + (chunk * BATCH) as f64 + 0.5, f64::from(y) + 0.5),
                        out,
                    );
                }
            }
        }
    }

    /// Some pixels under a map of one's own.
    fn batch(&self, start: DVec2, out: &mut [Premul]) {
        let mut footprints = [None; BATCH];
        let mut sampled = [Footprint::point(0.0, 0.0); BATCH];
        for (i, (footprint, sampled)) in
            footprints.iter_mut().zip(&mut sampled).enumerate().take(out.len())
        {
            *footprint = self.map.at(DVec2::new(start.x + i as f64, start.y));
            *sampled = footprint.unwrap_or(*sampled);
        }
        self.texture.sample_footprints(&sampled, &self.sampler, out);
        for (out, footprint) in out.iter_mut().zip(&footprints) {
            *out = footprint.map_or(Premul::TRANSPARENT, |f| self.finish(*out, &f));
        }
    }

    /// The colour of the pixel whose centre is `p`: what [`Painter::row`] gives, one by one.
    pub(super) fn pixel(&self, p: DVec2) -> Premul {
        let (at, share) = self.view.as_ref().map_or((p, 1.0), |view| view.part(p));
        let footprint = if share > 0.0 { self.map.at(at) } else { None };
        let Some(f) = footprint else { return Premul::TRANSPARENT };
        // The footprints next to the horizon have no end, and would reach the source from anywhere.
        let color = if self.view.as_ref().is_some_and(|view| view.misses(&[p])) {
            self.ground
        } else {
            self.finish(self.texture.sample(&f, &self.sampler), &f)
        };
        if share < 1.0 { color.scaled(share as f32) } else { color }
    }

    /// A sample with the edge of the source drawn: what of it lies inside, as the colour of as much of
    /// the pixel as lies there.
    fn finish(&self, sample: Premul, f: &Footprint) -> Premul {
        let Some(edge) = &self.edge else { return sample };
        if sample.alpha() >= 1.0 {
            return sample;
        }
        let share = edge.coverage(f) as f32;
        if sample.alpha() <= 0.0 || share <= 0.0 {
            return self.ground;
        }
        let opaque = sample.scaled(1.0 / sample.alpha());
        let [r, g, b, _] = opaque.0;
        Premul([r, g, b, 1.0]).scaled(share).over(self.ground)
    }
}
