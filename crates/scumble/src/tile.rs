//! One tile: replays its primitives in order, then resolves.

use crate::paint::Paint;
use crate::painter::{Coat, Painter, Stamp, centre};
use crate::plan::{Draw, Effect, Form, Plan};
use crate::strips::Wanted;
use crate::{Antialias, Settings};
use scumble_coverage::{AreaSink, AreaStrip, Cover, Scratch, Sink, hairline};
use scumble_framebuffer::{Gradient, Inlay, Palette, Tile, Visibility, encode_row};
use scumble_geometry::IntRect;
use scumble_pixel::Premul;

/// What a worker keeps from tile to tile, so that nothing is allocated in the steady state.
#[derive(Debug, Default)]
pub(crate) struct Workspace {
    pub(crate) scratch: Scratch,
    /// What is seen, while all that is drawn is opaque.
    seen: Visibility,
    /// While all are single colours, each antialiased by itself.
    inlay: Inlay,
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

/// The most edges of an outline that is drawn in pieces without a second thought.
const SIMPLE: usize = 16;

/// What stands for the background where keys tell what is seen; after it come the primitives.
const BACKGROUND: u32 = 0;

/// All that stays the same from tile to tile.
pub(crate) struct Job<'a> {
    pub(crate) plan: &'a Plan<'a>,
    pub(crate) settings: &'a Settings,
    pub(crate) background: Premul,
    /// The bytes that are left for strips.
    pub(crate) spare: u64,
}

impl Job<'_> {
    /// Renders the pixels of `rect` with the primitives of `list` into `rows`; some have a strip.
    pub(crate) fn tile(
        &self,
        work: &mut Workspace,
        rect: IntRect,
        (list, strips): (&[u32], &[Wanted<'_>]),
        rows: &mut [&mut [[u8; 4]]],
    ) {
        if list.is_empty() {
            return self.blank(rows);
        }
        let here = |(&i, (draw, bounds)): (&u32, (_, IntRect))| {
            let found = strips.binary_search_by_key(&i, |wanted| wanted.draw).ok();
            let strip = found.and_then(|at| strips[at].strip.as_ref());
            Local { draw, bounds: bounds.intersect(&rect), strip }
        };
        let locals: Vec<Local> = list.iter().zip(self.plan.draws(list)).map(here).collect();
        let effect = effect(&locals, rect);
        let palette = match effect {
            Effect::Flat | Effect::Inlays => self.palette(&locals),
            _ => Palette::new(self.settings.space),
        };
        let mut all = work.lists.pop().unwrap_or_default();
        all.clear();
        all.extend(0..locals.len() as u32);
        let palette = &palette;
        let mut replay = Replay { job: self, work, rect, locals, effect, palette, layers: vec![0] };
        replay.open(0, self.background);
        replay.part(rect, &all);
        replay.enter(0);
        let Replay { work, locals, .. } = replay;
        work.lists.push(all);
        self.finish(work, rect, (effect, palette), &locals, rows);
    }

    /// Renders pixels that nothing touches.
    fn blank(&self, rows: &mut [&mut [[u8; 4]]]) {
        let code = self.settings.space.export(self.background);
        rows.iter_mut().for_each(|row| row.fill(code));
    }

    /// Makes pixels of what has been drawn.
    fn finish(
        &self,
        work: &mut Workspace,
        rect: IntRect,
        (effect, palette): (Effect, &Palette),
        locals: &[Local<'_>],
        rows: &mut [&mut [[u8; 4]]],
    ) {
        let Workspace { seen, inlay, stack, colors, .. } = work;
        let space = self.settings.space;
        let gradients =
            if effect == Effect::Ramps { self.gradients(rect, locals) } else { Vec::new() };
        colors.clear();
        colors.resize(rect.width() as usize, Premul::TRANSPARENT);
        let shade = |key: u32, place, out: &mut [Premul]| match key.checked_sub(1) {
            None => out.fill(self.background),
            Some(i) => locals[i as usize].draw.paint.row(self.plan.surfaces, place, out),
        };
        for (y, row) in (0..).zip(rows) {
            match effect {
                Effect::Flat => seen.encode_row(y, palette, row),
                Effect::Inlays => inlay.encode_row(y, row),
                Effect::Ramps => seen.encode_gradients(y, &gradients, space, row),
                Effect::Hides => {
                    let place = |x: usize| centre(rect.x0 + x as i32, rect.y0 + y as i32);
                    seen.shade_row(y, colors, |key, x, out| shade(key, place(x), out));
                    encode_row(colors, space, row);
                }
                Effect::Blends => match stack[0].uniform_row(y) {
                    Some(pixels) => encode_row(pixels, space, row),
                    None => {
                        stack[0].resolve_row(y, colors);
                        encode_row(colors, space, row);
                    }
                },
            }
        }
    }

    /// The colours of the background and of primitives, each of which changes evenly.
    fn gradients(&self, rect: IntRect, locals: &[Local<'_>]) -> Vec<Gradient> {
        // They lie all over memory. Looked at with no work in between, many are on their way at once.
        for local in locals {
            std::hint::black_box(local.draw.paint.is_opaque());
        }
        let mut gradients = Vec::with_capacity(1 + locals.len());
        gradients.push(Gradient::constant(self.background));
        gradients.extend(locals.iter().map(|l| l.draw.paint.gradient((rect.x0, rect.y0))));
        gradients
    }

    /// The colours of the background and of primitives that have but one.
    fn palette(&self, locals: &[Local<'_>]) -> Palette {
        let mut palette = Palette::new(self.settings.space);
        let color = |local: &Local<'_>| match local.draw.paint {
            Paint::Solid(color) => color,
            _ => Premul::TRANSPARENT,
        };
        palette.extend(std::iter::once(self.background).chain(locals.iter().map(color)));
        palette
    }
}

/// A primitive in a tile.
struct Local<'a> {
    draw: &'a Draw,
    /// The pixels of the tile that it may touch.
    bounds: IntRect,
    /// Its areas, if they have been found before.
    strip: Option<&'a AreaStrip>,
}

impl Local<'_> {
    /// Whether it may own a sample of a part of the tile.
    fn touches(&self, part: IntRect) -> bool {
        let form = &self.draw.form;
        !self.bounds.intersect(&part).is_empty()
            && (self.strip.is_some()
                || !matches!(form, Form::Shape(shape) if shape.covers(part) == Cover::None))
    }

    /// Whether it hides whatever lies under it in the whole of a part.
    fn hides(&self, part: IntRect) -> bool {
        self.bounds.intersect(&part) == part
            && self.draw.layer == 0
            && self.draw.paint.is_opaque()
            && match (&self.draw.form, self.strip) {
                (_, Some(strip)) => strip.fills(part),
                (Form::Shape(shape), None) => shape.covers(part) == Cover::Full,
                _ => false,
            }
    }

    /// Whether it is opaque and may touch more than half of a part.
    fn is_large(&self, part: IntRect) -> bool {
        let seen = self.bounds.intersect(&part);
        2 * seen.width() * seen.height() > part.width() * part.height()
            && self.draw.paint.is_opaque()
    }

    /// Whether its outline is so long that to draw it in pieces takes more time than to draw over
    /// it.
    fn is_intricate(&self) -> bool {
        matches!(&self.draw.form, Form::Shape(shape) if shape.edge_count() > SIMPLE)
    }
}

/// What all primitives of a tile come to. (Looking at them all, one right after the other, also
/// brings them into the cache much faster than drawing them does.)
fn effect(locals: &[Local<'_>], rect: IntRect) -> Effect {
    let effect = locals.iter().map(|local| local.draw.effect).max().unwrap_or(Effect::Flat);
    // Where a pixel's centre lies behind the eye, its colour depends on what is covered.
    let even = || locals.iter().all(|local| local.draw.paint.sees_all(rect));
    if effect == Effect::Hides && !even() { Effect::Blends } else { effect }
}

struct Replay<'a> {
    job: &'a Job<'a>,
    work: &'a mut Workspace,
    rect: IntRect,
    /// The primitives of the tile; lists hold their places here.
    locals: Vec<Local<'a>>,
    /// What all of them come to: it tells what is drawn on.
    effect: Effect,
    /// The colours of the background and of primitives, where each has but one.
    palette: &'a Palette,
    /// The open layers, from the canvas to the innermost.
    layers: Vec<u32>,
}

impl Replay<'_> {
    /// Clears the tile at a depth of the stack.
    fn open(&mut self, depth: usize, color: Premul) {
        let (width, height) = (self.rect.width(), self.rect.height());
        let samples = self.job.settings.samples();
        match self.effect {
            Effect::Blends => {}
            Effect::Inlays => {
                return self.work.inlay.reset(width, height, BACKGROUND, self.palette);
            }
            _ => return self.work.seen.reset(width, height, samples, BACKGROUND),
        }
        if self.work.stack.len() <= depth {
            self.work.stack.push(Tile::new());
        }
        self.work.stack[depth].reset(width, height, samples, color);
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
        let hides = |&i: &u32| self.locals[i as usize].hides(rect);
        let list = &list[list.iter().rposition(hides).unwrap_or(0)..];
        if !self.worth_dividing(rect, list) {
            for &i in list {
                self.draw(i, rect);
            }
            return;
        }
        let mut touching = self.work.lists.pop().unwrap_or_default();
        for quarter in rect.quarters() {
            touching.clear();
            touching.extend(list.iter().filter(|&&i| self.locals[i as usize].touches(quarter)));
            self.part(quarter, &touching);
        }
        self.work.lists.push(touching);
    }

    /// Whether dividing a part of a tile may hide primitives, and more of them than it costs to draw
    /// the others in pieces. Layers are laid over each other by the whole tile, so it takes a list
    /// without any.
    fn worth_dividing(&self, part: IntRect, list: &[u32]) -> bool {
        if part.width().max(part.height()) <= LEAST_PART {
            return false;
        }
        let (mut large, mut intricate) = (0, 0);
        for local in list.iter().map(|&i| &self.locals[i as usize]) {
            if local.draw.layer != 0 {
                return false;
            }
            if local.is_intricate() {
                intricate += 1;
            } else {
                large += usize::from(local.is_large(part));
            }
        }
        large >= SPLIT_FROM && large >= 2 * intricate
    }

    fn draw(&mut self, index: u32, part: IntRect) {
        let Local { draw, bounds, strip } = self.locals[index as usize];
        let (job, clip, origin) = (self.job, part.intersect(&bounds), (self.rect.x0, self.rect.y0));
        let key = BACKGROUND + 1 + index;
        if self.effect == Effect::Inlays {
            let Workspace { scratch, inlay, .. } = &mut *self.work;
            return lay((&draw.form, strip), clip, scratch, &mut Coat { tile: inlay, origin, key });
        }
        if self.effect != Effect::Blends {
            let Workspace { scratch, seen, .. } = &mut *self.work;
            return cover(job, &draw.form, clip, scratch, &mut Stamp { tile: seen, origin, key });
        }
        self.enter(draw.layer);
        let Workspace { scratch, stack, colors, .. } = &mut *self.work;
        let tile = &mut stack[self.layers.len() - 1];
        let mut painter = Painter { job, paint: &draw.paint, tile, origin, colors };
        if job.settings.antialias == Antialias::Area {
            return lay((&draw.form, strip), clip, scratch, &mut painter);
        }
        cover(job, &draw.form, clip, scratch, &mut painter);
    }
}

/// Hands the areas of a primitive to a sink.
fn lay(
    (form, strip): (&Form, Option<&AreaStrip>),
    clip: IntRect,
    scratch: &mut Scratch,
    sink: &mut impl AreaSink,
) {
    match (form, strip) {
        (_, Some(strip)) => strip.replay(clip, sink),
        (Form::Shape(shape), _) => shape.rasterize_area(clip, scratch, sink),
        (Form::Chain(ends), _) => hairline(ends[0], ends[1], clip, |x, y| sink.run(y, x, x + 1)),
        (Form::Pixel, _) if !clip.is_empty() => sink.block(clip),
        (Form::Pixel, _) => {}
    }
}

/// Hands the samples of a primitive to a sink.
fn cover(job: &Job<'_>, form: &Form, clip: IntRect, scratch: &mut Scratch, sink: &mut impl Sink) {
    match form {
        Form::Shape(shape) => shape.rasterize(clip, &job.settings.pattern, scratch, sink),
        Form::Chain(ends) => hairline(ends[0], ends[1], clip, |x, y| sink.run(y, x, x + 1)),
        Form::Pixel if !clip.is_empty() => sink.block(clip),
        Form::Pixel => {}
    }
}
