//! What becomes of the samples that a primitive covers: colours, or the number of what is seen.

use crate::paint::Paint;
use crate::tile::Job;
use scumble_coverage::{AreaSink, SampleMask, SamplePattern, Sink};
use scumble_framebuffer::{Inlay, Tile, Visibility};
use scumble_geometry::{DVec2, IntRect};
use scumble_pixel::Premul;

/// A place in a tile, from its top left pixel.
fn local(origin: (i32, i32), x: i32, y: i32) -> (u32, u32) {
    (x.abs_diff(origin.0), y.abs_diff(origin.1))
}

/// Writes down that an opaque primitive is seen.
pub(crate) struct Stamp<'a> {
    pub(crate) tile: &'a mut Visibility,
    /// The tile's top left pixel.
    pub(crate) origin: (i32, i32),
    /// What stands for the primitive.
    pub(crate) key: u32,
}

impl Sink for Stamp<'_> {
    #[inline]
    fn block(&mut self, rect: IntRect) {
        let (x, y) = local(self.origin, rect.x0, rect.y0);
        self.tile.fill_block(x, y, rect.width(), rect.height(), self.key);
    }

    #[inline]
    fn run(&mut self, y: i32, x0: i32, x1: i32) {
        let (x, y) = local(self.origin, x0, y);
        self.tile.fill_run(x, y, x1.abs_diff(x0), self.key);
    }

    #[inline]
    fn pixel(&mut self, x: i32, y: i32, mask: SampleMask) {
        let (x, y) = local(self.origin, x, y);
        self.tile.cover(x, y, mask.0, self.key);
    }

    const SQUARES: bool = true;

    #[inline]
    fn whole(&mut self, x: i32, y: i32, pixels: u64) {
        let (x, y) = local(self.origin, x, y);
        self.tile.fill_pixels(x, y, pixels, self.key);
    }

    #[inline]
    fn parts(&mut self, x: i32, y: i32, rows: &[u32; 8]) {
        let (x, y) = local(self.origin, x, y);
        self.tile.cover_square(x, y, rows, self.key);
    }
}

/// Lays one colour over what a primitive covers.
pub(crate) struct Coat<'a> {
    pub(crate) tile: &'a mut Inlay,
    /// The tile's top left pixel.
    pub(crate) origin: (i32, i32),
    /// What stands for the primitive.
    pub(crate) key: u32,
}

impl AreaSink for Coat<'_> {
    fn block(&mut self, rect: IntRect) {
        let (x, y) = local(self.origin, rect.x0, rect.y0);
        self.tile.fill(x, y, rect.width(), rect.height(), self.key);
    }

    fn run(&mut self, y: i32, x0: i32, x1: i32) {
        self.block(IntRect { x0, y0: y, x1, y1: y + 1 });
    }

    fn span(&mut self, y: i32, x0: i32, x1: i32, area: f32) {
        let place = local(self.origin, x0, y);
        self.tile.blend_area(place, x1.abs_diff(x0), area, self.key);
    }

    fn row(&mut self, y: i32, x0: i32, areas: &[f32]) {
        let (x, y) = local(self.origin, x0, y);
        self.tile.blend_areas(x, y, areas, self.key);
    }

    fn pixel(&mut self, x: i32, y: i32, area: f32) {
        self.row(y, x, &[area]);
    }
}

/// Colours what a primitive covers.
pub(crate) struct Painter<'a> {
    pub(crate) job: &'a Job<'a>,
    pub(crate) paint: &'a Paint,
    pub(crate) tile: &'a mut Tile,
    /// The tile's top left pixel.
    pub(crate) origin: (i32, i32),
    pub(crate) colors: &'a mut Vec<Premul>,
}

impl Painter<'_> {
    fn local(&self, x: i32, y: i32) -> (u32, u32) {
        local(self.origin, x, y)
    }

    fn pattern(&self) -> &SamplePattern {
        &self.job.settings.pattern
    }

    /// Whether colours are evaluated sample by sample. One colour need not be.
    fn per_sample(&self) -> bool {
        self.job.settings.per_sample() && !matches!(self.paint, Paint::Solid(_))
    }

    /// Evaluates and blends the samples of a mask, each at its own position.
    fn samples(&mut self, x: i32, y: i32, mask: u64) {
        let surfaces = self.job.plan.surfaces;
        let share = 1.0 / (self.pattern().len() as f64).sqrt();
        self.colors.clear();
        for (i, &offset) in self.job.settings.pattern.offsets().iter().enumerate() {
            if mask >> i & 1 == 1 {
                self.colors.push(self.paint.sample(surfaces, position(x, y, offset), share));
            }
        }
        let (lx, ly) = self.local(x, y);
        self.tile.blend_samples(lx, ly, mask, self.colors);
    }
}

impl Sink for Painter<'_> {
    fn block(&mut self, rect: IntRect) {
        if let Paint::Solid(color) = self.paint {
            let (x, y) = self.local(rect.x0, rect.y0);
            return self.tile.fill_block(x, y, rect.width(), rect.height(), *color);
        }
        for y in rect.y0..rect.y1 {
            Sink::run(self, y, rect.x0, rect.x1);
        }
    }

    fn run(&mut self, y: i32, x0: i32, x1: i32) {
        let (x, local_y) = self.local(x0, y);
        if let Paint::Solid(color) = self.paint {
            return self.tile.fill_block(x, local_y, x1.abs_diff(x0), 1, *color);
        }
        if self.per_sample() {
            let all = self.pattern().full_mask().0;
            for x in x0..x1 {
                self.samples(x, y, all);
            }
            return;
        }
        self.colors.clear();
        self.colors.resize(x1.abs_diff(x0) as usize, Premul::TRANSPARENT);
        self.paint.row(self.job.plan.surfaces, centre(x0, y), self.colors);
        self.tile.blend_run(x, local_y, self.colors);
    }

    fn pixel(&mut self, x: i32, y: i32, mask: SampleMask) {
        if self.per_sample() {
            return self.samples(x, y, mask.0);
        }
        let color = match self.paint {
            Paint::Solid(color) => *color,
            paint => {
                let middle = centre(x, y);
                let fallback = || middle - 0.5 + self.pattern().centroid(mask);
                paint.at(self.job.plan.surfaces, middle, fallback)
            }
        };
        let (lx, ly) = self.local(x, y);
        self.tile.blend_masked(lx, ly, mask.0, color);
    }
}

impl AreaSink for Painter<'_> {
    fn block(&mut self, rect: IntRect) {
        Sink::block(self, rect);
    }

    fn run(&mut self, y: i32, x0: i32, x1: i32) {
        Sink::run(self, y, x0, x1);
    }

    fn span(&mut self, y: i32, x0: i32, x1: i32, area: f32) {
        if let Paint::Solid(color) = self.paint {
            let (x, y) = self.local(x0, y);
            return self.tile.fill_block(x, y, x1.abs_diff(x0), 1, color.scaled(area));
        }
        for x in x0..x1 {
            self.row(y, x, &[area]);
        }
    }

    fn row(&mut self, y: i32, x0: i32, areas: &[f32]) {
        let (x, local_y) = self.local(x0, y);
        if let Paint::Solid(color) = self.paint {
            return self.tile.blend_areas(x, local_y, areas, *color);
        }
        let x1 = x0 + areas.len() as i32;
        let surfaces = self.job.plan.surfaces;
        self.colors.clear();
        self.colors.resize(areas.len(), Premul::TRANSPARENT);
        if self.paint.sees_all(IntRect { x0, y0: y, x1, y1: y + 1 }) {
            self.paint.row(surfaces, centre(x0, y), self.colors);
        } else {
            for (x, color) in (x0..x1).zip(&mut *self.colors) {
                *color = self.paint.at(surfaces, centre(x, y), || self.paint.nearest_corner(x, y));
            }
        }
        for (color, area) in self.colors.iter_mut().zip(areas) {
            *color = color.scaled(*area);
        }
        self.tile.blend_run(x, local_y, self.colors);
    }

    fn pixel(&mut self, x: i32, y: i32, area: f32) {
        self.row(y, x, &[area]);
    }
}

pub(crate) fn centre(x: i32, y: i32) -> DVec2 {
    DVec2::new(f64::from(x) + 0.5, f64::from(y) + 0.5)
}

fn position(x: i32, y: i32, offset: [u8; 2]) -> DVec2 {
    let [dx, dy] = offset.map(|v| f64::from(v) / 256.0);
    DVec2::new(f64::from(x) + dx, f64::from(y) + dy)
}
