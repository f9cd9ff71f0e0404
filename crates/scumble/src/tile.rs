//! One tile: replays its primitives in order, then resolves.

use crate::paint::Paint;
use crate::plan::{Draw, Form, Plan};
use crate::{Settings, Shading};
use scumble_coverage::{Cover, SampleMask, SamplePattern, Scratch, Sink, hairline};
use scumble_framebuffer::{Tile, encode_row};
use scumble_geometry::{DVec2, IntRect};
use scumble_pixel::Premul;

/// What a worker keeps from tile to tile, so that nothing is allocated in the steady state.
#[derive(Debug, Default)]
pub(crate) struct Workspace {
    scratch: Scratch,
    /// The canvas, then one tile for each open layer.
    stack: Vec<Tile>,
    colors: Vec<Premul>,
    /// Lists for the parts of a tile, one for each depth of the division.
    lists: Vec<Vec<u32>>,
}

/// A tile is drawn in parts, halved both ways down to this side, where large opaque primitives lie
/// over one another: a small part is hidden whole more often than a large one.
const LEAST_PART: u32 = 16;

/// How many large opaque primitives make the division worth its while.
const SPLIT_FROM: usize = 3;

/// All that stays the same from tile to tile.
pub(crate) struct Job<'a> {
    pub(crate) plan: &'a Plan,
    pub(crate) settings: &'a Settings,
    pub(crate) background: Premul,
}

impl Job<'_> {
    /// Renders the pixels of `rect` with the primitives of `list` into `rows`.
    pub(crate) fn tile(
        &self,
        work: &mut Workspace,
        rect: IntRect,
        list: &[u32],
        rows: &mut [&mut [[u8; 4]]],
    ) {
        let mut replay = Replay { job: self, work, rect, layers: vec![0] };
        replay.open(0, self.background);
        replay.part(rect, list);
        replay.enter(0);
        self.resolve(work, rect, rows);
    }

    fn draw_of(&self, index: u32) -> &Draw {
        &self.plan.draws[index as usize]
    }

    /// Whether dividing a part of a tile may hide primitives. Layers are laid over each other by
    /// the whole tile, so it takes a list without any.
    fn worth_dividing(&self, rect: IntRect, list: &[u32]) -> bool {
        let large = |draw: &&Draw| {
            let seen = draw.bounds.intersect(&rect);
            draw.paint.is_opaque()
                && 2 * seen.width() * seen.height() > rect.width() * rect.height()
        };
        rect.width().max(rect.height()) > LEAST_PART
            && list.len() >= SPLIT_FROM
            && list.iter().all(|&i| self.draw_of(i).layer == 0)
            && list.iter().map(|&i| self.draw_of(i)).filter(large).take(SPLIT_FROM).count()
                == SPLIT_FROM
    }

    /// Whether a primitive hides whatever lies under it in the whole tile.
    fn hides(&self, draw: &Draw, rect: IntRect) -> bool {
        let Form::Shape(shape) = &draw.form else { return false };
        draw.layer == 0
            && draw.bounds.intersect(&rect) == rect
            && draw.paint.is_opaque()
            && shape.covers(rect) == Cover::Full
    }

    fn resolve(&self, work: &mut Workspace, rect: IntRect, rows: &mut [&mut [[u8; 4]]]) {
        work.colors.clear();
        work.colors.resize(rect.width() as usize, Premul::TRANSPARENT);
        let Some(tile) = work.stack.first() else { return };
        for (y, row) in rows.iter_mut().enumerate() {
            tile.resolve_row(y as u32, &mut work.colors);
            encode_row(&work.colors, self.settings.space, row);
        }
    }
}

struct Replay<'a> {
    job: &'a Job<'a>,
    work: &'a mut Workspace,
    rect: IntRect,
    /// The open layers, from the canvas to the innermost.
    layers: Vec<u32>,
}

impl Replay<'_> {
    /// Clears the tile at a depth of the stack.
    fn open(&mut self, depth: usize, color: Premul) {
        if self.work.stack.len() <= depth {
            self.work.stack.push(Tile::new());
        }
        let samples = self.job.settings.pattern.len() as u32;
        self.work.stack[depth].reset(self.rect.width(), self.rect.height(), samples, color);
    }

    /// Closes and opens layers until `target` is the innermost. A layer's primitives follow each
    /// other in drawing order, so none is entered twice.
    fn enter(&mut self, target: u32) {
        if self.layers.last() == Some(&target) {
            return;
        }
        let mut path = vec![target];
        while let Some(&layer) = path.last()
            && layer != 0
        {
            path.push(self.job.plan.layers[layer as usize].parent);
        }
        path.reverse();
        let common = self.layers.iter().zip(&path).take_while(|(a, b)| a == b).count();
        while self.layers.len() > common {
            self.close();
        }
        for &layer in &path[common..] {
            self.open(self.layers.len(), Premul::TRANSPARENT);
            self.layers.push(layer);
        }
    }

    /// Lays the innermost layer over the one below.
    fn close(&mut self) {
        let Some(layer) = self.layers.pop() else { return };
        let depth = self.layers.len();
        let (below, above) = self.work.stack.split_at_mut(depth);
        if let (Some(below), Some(above)) = (below.last_mut(), above.first()) {
            below.composite(above, self.job.plan.layers[layer as usize].opacity);
        }
    }

    /// Draws a list on a part of the tile, leaving out what is hidden there.
    fn part(&mut self, rect: IntRect, list: &[u32]) {
        let job = self.job;
        let top = list.iter().rposition(|&i| job.hides(job.draw_of(i), rect)).unwrap_or(0);
        let list = &list[top..];
        if !job.worth_dividing(rect, list) {
            for &i in list {
                let draw = job.draw_of(i);
                self.enter(draw.layer);
                self.draw(draw, rect);
            }
            return;
        }
        let mut touching = self.work.lists.pop().unwrap_or_default();
        for quarter in rect.quarters() {
            touching.clear();
            touching.extend(list.iter().filter(|&&i| job.draw_of(i).touches(quarter)));
            self.part(quarter, &touching);
        }
        self.work.lists.push(touching);
    }

    fn draw(&mut self, draw: &Draw, rect: IntRect) {
        let clip = rect.intersect(&draw.bounds);
        let Workspace { scratch, stack, colors, .. } = &mut *self.work;
        let mut painter = Painter {
            job: self.job,
            paint: &draw.paint,
            tile: &mut stack[self.layers.len() - 1],
            origin: (self.rect.x0, self.rect.y0),
            colors,
        };
        match &draw.form {
            Form::Shape(shape) => {
                shape.rasterize(clip, &self.job.settings.pattern, scratch, &mut painter);
            }
            Form::Chain([a, b]) => hairline(*a, *b, clip, |x, y| painter.run(y, x, x + 1)),
            Form::Pixel if !clip.is_empty() => painter.block(clip),
            Form::Pixel => {}
        }
    }
}

/// Colours what a primitive covers.
struct Painter<'a> {
    job: &'a Job<'a>,
    paint: &'a Paint,
    tile: &'a mut Tile,
    /// The tile's top left pixel.
    origin: (i32, i32),
    colors: &'a mut Vec<Premul>,
}

impl Painter<'_> {
    fn local(&self, x: i32, y: i32) -> (u32, u32) {
        (x.abs_diff(self.origin.0), y.abs_diff(self.origin.1))
    }

    fn pattern(&self) -> &SamplePattern {
        &self.job.settings.pattern
    }

    /// Whether colours are evaluated sample by sample. One colour need not be.
    fn per_sample(&self) -> bool {
        self.job.settings.shading == Shading::Sample
            && self.pattern().len() > 1
            && !matches!(self.paint, Paint::Solid(_))
    }

    /// Evaluates and blends the samples of a mask, each at its own position.
    fn samples(&mut self, x: i32, y: i32, mask: u64) {
        let surfaces = &self.job.plan.surfaces;
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
            self.run(y, rect.x0, rect.x1);
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
        self.paint.row(&self.job.plan.surfaces, centre(x0, y), self.colors);
        self.tile.blend_run(x, local_y, self.colors);
    }

    fn pixel(&mut self, x: i32, y: i32, mask: SampleMask) {
        if self.per_sample() {
            return self.samples(x, y, mask.0);
        }
        let color = match self.paint {
            Paint::Solid(color) => *color,
            paint => {
                let fallback = || centroid(x, y, self.pattern(), mask);
                paint.at(&self.job.plan.surfaces, centre(x, y), fallback)
            }
        };
        let (lx, ly) = self.local(x, y);
        self.tile.blend_masked(lx, ly, mask.0, color);
    }
}

fn centre(x: i32, y: i32) -> DVec2 {
    DVec2::new(f64::from(x) + 0.5, f64::from(y) + 0.5)
}

fn position(x: i32, y: i32, offset: [u8; 2]) -> DVec2 {
    let [dx, dy] = offset.map(|v| f64::from(v) / 256.0);
    DVec2::new(f64::from(x) + dx, f64::from(y) + dy)
}

/// The mean of the covered samples.
fn centroid(x: i32, y: i32, pattern: &SamplePattern, mask: SampleMask) -> DVec2 {
    let mut sum = DVec2::ZERO;
    for (i, &offset) in pattern.offsets().iter().enumerate() {
        if mask.0 >> i & 1 == 1 {
            sum += position(x, y, offset);
        }
    }
    sum / f64::from(mask.count())
}
