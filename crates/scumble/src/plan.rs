//! From a scene to primitives: transformed, flattened, snapped, with textures built.

use crate::paint::{Paint, Textured};
use crate::rows::Pool;
use crate::{Antialias, Interpolation, Settings};
use scumble_coverage::Shape;
use scumble_framebuffer::Tile;
use scumble_geometry::{
    Affine, BandStarts, Contours, DVec2, DVec3, FillRule, Homography, IntRect, Ramp, Rect,
    TileBins, TileGrid, clip_segment, line_quad,
};
use scumble_pixel::{Premul, Straight};
use scumble_scene::{
    Command, Fill, GouraudTriangle, Hairline, ImageId, ImageQuad, Point, Scene, Stroke,
    TexturedTriangle, View,
};
use scumble_texture::{LevelMode, PixelFilter, Sampler, Texture};
use std::sync::atomic::{AtomicU64, Ordering};

/// An image of the scene, ready to be sampled.
#[derive(Debug)]
pub(crate) struct Surface {
    pub(crate) texture: Texture,
    /// Whether every texel is opaque, so that every average of them is.
    pub(crate) opaque: bool,
}

/// How far, in pixels, a chord may lie from its curve. A sixty-fourth is an error of four grey levels
/// in 255 at the worst, and of one to two on most pixels that the curve crosses (measured on discs
/// of 20 and 200 pixels: 2.9 and 4.1 at the worst, 1.1 and 1.6 on average). It goes either way, and
/// three tenths of it are left on average, inwards. Halving it costs 1.4 times the points.
const FLATNESS: f64 = 1.0 / 64.0;

/// How many edges an outline has, in the mean, if tiles are to be wide; and how many times wider and
/// lower they are then: of all shapes tried the quickest.
const INTRICATE: u64 = 16;
const STRETCH: [u32; 2] = [16, 2];

/// What a point of an outline takes, at the most, with the edge that it begins.
const EDGE_BYTES: u64 = 64;

/// A primitive, ready to be drawn: a line of the cache, since a tile finds its primitives all over
/// memory.
#[derive(Debug)]
#[repr(align(64))]
pub(crate) struct Draw {
    pub(crate) form: Form,
    pub(crate) paint: Paint,
    /// Which layer it is painted on.
    pub(crate) layer: u32,
    pub(crate) effect: Effect,
}

/// What becomes of the samples that a primitive covers.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) enum Effect {
    /// One opaque colour is seen there.
    Flat,
    /// An opaque colour is seen there that changes evenly.
    Ramps,
    /// The primitive is seen there, and nothing through it.
    Hides,
    /// One colour is laid over all or a part of each pixel.
    Inlays,
    /// Anything else.
    Blends,
}

/// Which samples a primitive owns.
#[derive(Debug)]
pub(crate) enum Form {
    /// Those inside an outline.
    Shape(Shape),
    /// The pixels of a one-pixel line.
    Chain(Box<[DVec2; 2]>),
    /// All of one pixel, the one at the top left of the bounds.
    Pixel,
}

/// A group with an opacity of its own. Layer 0 is the canvas.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Layer {
    pub(crate) parent: u32,
    pub(crate) opacity: f32,
    /// How many layers are open while it is, itself and the canvas among them.
    pub(crate) depth: u64,
}

/// What the tiles replay.
#[derive(Debug)]
pub(crate) struct Plan<'a> {
    parts: Vec<Part>,
    pub(crate) layers: Vec<Layer>,
    /// By image index; `None` where no command uses the image.
    pub(crate) surfaces: &'a [Option<Surface>],
}

/// The primitives of some commands that follow each other.
#[derive(Debug, Default)]
struct Part {
    /// The number of the first.
    first: u32,
    draws: Vec<Draw>,
    /// By draw: the pixels of the canvas that it may touch. Apart from the rest, since it is asked
    /// for much more often.
    bounds: Vec<IntRect>,
    /// The layers that the commands opened.
    layers: Vec<Layer>,
    /// Whether a command opens or closes a layer, which takes knowing what came before.
    layered: bool,
    /// About what the outlines take, in bytes.
    outline_bytes: u64,
}

/// The fewest commands that are worth a part of their own.
const LEAST_PART: usize = 1024;

/// Parts for each thread: enough that a heavy one does not leave the others idle.
const PARTS_PER_THREAD: usize = 4;

/// The most parts: each has a list for every band.
const MOST_PARTS: usize = 32;

/// Makes the primitives of a scene for given settings, part by part where there are threads.
pub(crate) fn build<'a>(
    scene: &Scene,
    settings: &Settings,
    surfaces: &'a [Option<Surface>],
    pool: &Pool,
) -> Plan<'a> {
    let commands = &scene.commands[..];
    let planner = || Planner::new(scene, settings, surfaces);
    let mut parts = Vec::new();
    if pool.threads() > 1 {
        let count = (pool.threads() * PARTS_PER_THREAD).min(MOST_PARTS);
        let step = commands.len().div_ceil(count).max(LEAST_PART);
        let (whole, spent) = (step >= commands.len(), AtomicU64::new(0));
        let make = |commands| planner().part(commands, whole, &spent);
        parts = pool.map(commands.chunks(step).collect(), make);
    }
    if pool.threads() <= 1 || parts.len() > 1 && parts.iter().any(|part| part.layered) {
        parts = vec![planner().part(commands, true, &AtomicU64::new(0))];
    }
    parts.push(planner().frame(&scene.view));
    let mut first = 0;
    for part in &mut parts {
        part.first = first;
        first += part.draws.len() as u32;
    }
    let mut layers = vec![CANVAS];
    layers.extend(parts.iter_mut().flat_map(|part| part.layers.drain(..)));
    Plan { parts, layers, surfaces }
}

impl Plan<'_> {
    /// How many primitives there are.
    pub(crate) fn len(&self) -> usize {
        self.parts.iter().map(|part| part.draws.len()).sum()
    }

    /// What the primitives take, in bytes; their outlines about.
    pub(crate) fn bytes(&self) -> u64 {
        let of = |part: &Part| {
            let draws = size_of_val(&part.draws[..]) + size_of_val(&part.bounds[..]);
            draws as u64 + part.outline_bytes
        };
        self.parts.iter().map(of).fold(0, u64::saturating_add)
    }

    /// How the picture is cut into tiles.
    pub(crate) fn grid(&self, area: IntRect, settings: &Settings) -> TileGrid {
        let side = settings.tile_size;
        let edges = self.parts.iter().map(|part| part.outline_bytes).sum::<u64>() / EDGE_BYTES;
        // An outline of many edges takes less to find along a row than tile by tile.
        let wide = settings.antialias == Antialias::Area
            && edges > INTRICATE * self.len() as u64
            && self.parts.iter().flat_map(|p| &p.draws).all(|d| d.effect <= Effect::Inlays);
        if !wide {
            return TileGrid::new(area, side);
        }
        TileGrid::with_size(area, (side * STRETCH[0]).min(Tile::MAX_SIDE), side / STRETCH[1])
    }

    /// The tiles that each primitive touches.
    pub(crate) fn bins(&self, grid: TileGrid, pool: &Pool) -> TileBins {
        let parts = self.parts.iter().collect();
        let starts = |part: &Part| BandStarts::new(grid, part.first, &part.bounds);
        TileBins::from_parts(pool.map(parts, starts))
    }

    /// Primitives by their numbers, which rise, each with its bounds.
    pub(crate) fn draws(&self, list: &[u32]) -> impl Iterator<Item = (&Draw, IntRect)> {
        let mut parts = &self.parts[..];
        list.iter().map(move |&number| {
            while let [_, next, ..] = parts
                && next.first <= number
            {
                parts = &parts[1..];
            }
            let place = (number - parts[0].first) as usize;
            (&parts[0].draws[place], parts[0].bounds[place])
        })
    }
}

/// Layer 0.
const CANVAS: Layer = Layer { parent: 0, opacity: 1.0, depth: 1 };

struct Planner<'a> {
    settings: &'a Settings,
    surfaces: &'a [Option<Surface>],
    view: Homography,
    canvas: IntRect,
    layer: u32,
    /// The last transform, and what came of it: most have the one of the primitive before.
    last: Option<(Homography, Homography)>,
    /// Empty, but for the outline in hand: its memory serves one after the other.
    contours: Contours,
    part: Part,
}

impl<'a> Planner<'a> {
    fn new(scene: &Scene, settings: &'a Settings, surfaces: &'a [Option<Surface>]) -> Self {
        Self {
            settings,
            surfaces,
            view: scene.view.homography(settings.width, settings.height),
            canvas: IntRect::new(0, 0, settings.width as i32, settings.height as i32),
            layer: 0,
            last: None,
            contours: Contours::new(),
            part: Part::default(),
        }
    }

    /// The primitives of some commands: of the `whole` scene, or else up to the first that does
    /// something to layers. `spent` counts what all parts take for outlines.
    fn part(mut self, commands: &[Command], whole: bool, spent: &AtomicU64) -> Part {
        self.part.draws.reserve_exact(commands.len());
        self.part.bounds.reserve_exact(commands.len());
        for command in commands {
            let before = self.part.outline_bytes;
            self.command(command);
            let more = self.part.outline_bytes - before;
            // With too much the caller refuses the plan; no need to make more of it.
            let refused = more > 0
                && spent.fetch_add(more, Ordering::Relaxed) + more > self.settings.max_memory;
            if refused || self.part.layered && !whole {
                break;
            }
        }
        self.part
    }

    /// The frame of a view, over everything.
    fn frame(mut self, view: &View) -> Part {
        for ends in view.frame(self.settings.width, self.settings.height).into_iter().flatten() {
            self.hairline_on_canvas(ends, Straight::BLACK);
        }
        self.part
    }

    fn command(&mut self, command: &Command) {
        match command {
            Command::PushLayer { opacity } => self.push_layer(*opacity),
            Command::PopLayer => self.pop_layer(),
            Command::Fill(fill) => self.fill(fill),
            Command::Stroke(stroke) => self.stroke(stroke),
            Command::Gouraud(triangle) => self.gouraud(triangle),
            Command::Textured(triangle) => self.textured(triangle),
            Command::Image(quad) => self.image(quad),
            Command::Hairline(line) => self.hairline(line),
            Command::Point(point) => self.point(point),
        }
    }

    fn push_layer(&mut self, opacity: f32) {
        let depth = self.layer().depth + 1;
        let layer = Layer { parent: self.layer, opacity: opacity.clamp(0.0, 1.0), depth };
        self.part.layers.push(layer);
        self.layer = self.part.layers.len() as u32;
        self.part.layered = true;
    }

    fn pop_layer(&mut self) {
        self.layer = self.layer().parent;
        self.part.layered = true;
    }

    /// The open layer.
    fn layer(&self) -> Layer {
        match self.layer {
            0 => CANVAS,
            layer => self.part.layers[layer as usize - 1],
        }
    }

    fn canvas_map(&mut self, transform: &Homography) -> Homography {
        match self.last {
            Some((last, to_canvas)) if last == *transform => to_canvas,
            _ => self.last.insert((*transform, self.view * *transform)).1,
        }
    }

    // Inlined, or four numbers would be written and read again as one, which has to wait for them.
    #[inline(always)]
    fn import(&self, color: Straight) -> Premul {
        self.settings.space.import(color)
    }

    fn push(&mut self, form: Form, bounds: IntRect, paint: Paint) {
        let bounds = bounds.intersect(&self.canvas);
        if bounds.is_empty() {
            return;
        }
        let area = self.settings.antialias == Antialias::Area;
        let is_triangle = matches!(&form, Form::Shape(shape) if shape.edge_count() == 3);
        let effect = match &paint {
            _ if self.layer != 0 => Effect::Blends,
            // Small triangles fill hardly a pixel whole, and what they sum is quicker without.
            Paint::Solid(_) if area && !is_triangle => Effect::Inlays,
            _ if area || !paint.is_opaque() => Effect::Blends,
            Paint::Solid(_) => Effect::Flat,
            _ if self.settings.per_sample() => Effect::Blends,
            Paint::Gouraud(ramp) if ramp.plane().is_some() => Effect::Ramps,
            _ => Effect::Hides,
        };
        self.part.bounds.push(bounds);
        self.part.draws.push(Draw { form, paint, layer: self.layer, effect });
    }

    /// Coordinates that are not finite draw nothing: readers refuse them long before.
    fn push_shape(&mut self, shape: Option<Shape>, paint: Paint) {
        if let Some(shape) = shape {
            let bounds = shape.bounds();
            self.push(Form::Shape(shape), bounds, paint);
        }
    }

    fn push_contours(&mut self, rule: FillRule, paint: Paint) {
        self.part.outline_bytes += self.contours.points.len() as u64 * EDGE_BYTES;
        self.push_shape(Shape::polygon(self.contours.iter(), rule).ok().flatten(), paint);
        self.contours.clear();
    }

    fn fill(&mut self, fill: &Fill) {
        let to_canvas = self.canvas_map(&fill.transform);
        let paint = Paint::Solid(self.import(fill.color));
        if let Some(corners) = fill.path.triangle() {
            let corners = corners.map(|p| to_canvas.project_homogeneous(p));
            return self.push_shape(Shape::projective(&corners, to_canvas.near_w()), paint);
        }
        fill.path.flatten_into(&to_canvas, FLATNESS, &mut self.contours);
        self.push_contours(fill.rule, paint);
    }

    fn stroke(&mut self, stroke: &Stroke) {
        let to_canvas = self.canvas_map(&stroke.transform);
        let tolerance = FLATNESS / stroke.largest_scale(&to_canvas);
        stroke.path.stroke_into(&stroke.style, tolerance, &to_canvas, &mut self.contours);
        self.push_contours(FillRule::NonZero, Paint::Solid(self.import(stroke.color)));
    }

    fn gouraud(&mut self, triangle: &GouraudTriangle) {
        let to_canvas = self.canvas_map(&triangle.transform);
        let corners = triangle.points.map(|p| to_canvas.project_homogeneous(p));
        let [a, b, c] = triangle.colors;
        let paint = if a == b && b == c {
            Some(Paint::Solid(self.import(a)))
        } else {
            let colors = triangle.colors.map(|color| self.import(color).0);
            let ramp = Ramp::new(self.attribute_corners(corners), colors);
            ramp.ok().map(|ramp| Paint::Gouraud(Box::new(ramp)))
        };
        if let Some(paint) = paint {
            self.push_shape(Shape::projective(&corners, to_canvas.near_w()), paint);
        }
    }

    fn textured(&mut self, triangle: &TexturedTriangle) {
        let to_canvas = self.canvas_map(&triangle.transform);
        let TexturedTriangle { points, uvs, image, opacity, .. } = *triangle;
        self.textured_corners(&to_canvas, points, uvs, image, opacity);
    }

    fn textured_corners(
        &mut self,
        to_canvas: &Homography,
        points: [DVec2; 3],
        uvs: [DVec2; 3],
        image: ImageId,
        opacity: f32,
    ) {
        let Some(size) = self.texture_size(image) else { return };
        let corners = points.map(|p| to_canvas.project_homogeneous(p));
        let texels = uvs.map(|uv| uv * size);
        let Ok(map) = Homography::from_triangle(self.attribute_corners(corners), texels) else {
            return;
        };
        let paint = self.texture_paint(image, map, self.settings.sampler, opacity);
        self.push_shape(Shape::projective(&corners, to_canvas.near_w()), paint);
    }

    fn image(&mut self, quad: &ImageQuad) {
        let to_canvas = self.canvas_map(&quad.transform);
        if self.settings.interpolation == Interpolation::Affine && !to_canvas.is_affine() {
            let (corners, uvs) = (quad.rect.corners(), quad.source.corners());
            for half in [[0, 1, 2], [0, 2, 3]] {
                let (points, uvs) = (half.map(|i: usize| corners[i]), half.map(|i| uvs[i]));
                self.textured_corners(&to_canvas, points, uvs, quad.image, quad.opacity);
            }
            return;
        }
        let Some(size) = self.texture_size(quad.image) else { return };
        let Ok(from_canvas) = to_canvas.inverse() else { return };
        let [x0, x1] = [quad.source.x0, quad.source.x1].map(|x| x * size.x);
        let [y0, y1] = [quad.source.y0, quad.source.y1].map(|y| y * size.y);
        let texels = Rect::new(x0, y0, x1, y1);
        let map = Homography::from(Affine::rect_to_rect(quad.rect, texels)) * from_canvas;
        let sampler = if quad.pixelated {
            Sampler { pixel: PixelFilter::Nearest, level: LevelMode::Zero, ..self.settings.sampler }
        } else {
            self.settings.sampler
        };
        let paint = self.texture_paint(quad.image, map, sampler, quad.opacity);
        let corners = quad.rect.corners().map(|p| to_canvas.project_homogeneous(p));
        self.push_shape(Shape::projective(&corners, to_canvas.near_w()), paint);
    }

    fn hairline(&mut self, line: &Hairline) {
        let to_canvas = self.canvas_map(&line.transform);
        let ends = [line.from, line.to].map(|p| to_canvas.project_homogeneous(p));
        if let Some(ends) = clip_segment(ends, to_canvas.near_w()) {
            self.hairline_on_canvas(ends.map(|p| p.truncate() / p.z), line.color);
        }
    }

    /// One sample: a chain of pixels. More: a quad one pixel wide, antialiased like all else.
    fn hairline_on_canvas(&mut self, [a, b]: [DVec2; 2], color: Straight) {
        let paint = Paint::Solid(self.import(color));
        if self.settings.antialias == Antialias::Area || self.settings.samples() > 1 {
            let shape = line_quad(a, b, 1.0)
                .and_then(|quad| Shape::polygon([&quad[..]], FillRule::NonZero).ok().flatten());
            return self.push_shape(shape, paint);
        }
        let Some(rect) = Rect::bounding([a, b]) else { return };
        // Saturating casts: what lies off the canvas is cut by `push`.
        let bounds = IntRect::new(
            rect.x0.floor() as i32,
            rect.y0.floor() as i32,
            (rect.x1.floor() as i32).saturating_add(1),
            (rect.y1.floor() as i32).saturating_add(1),
        );
        self.push(Form::Chain(Box::new([a, b])), bounds, paint);
    }

    fn point(&mut self, point: &Point) {
        let Some(p) = self.canvas_map(&point.transform).project(point.position) else { return };
        let (x, y) = (p.x.floor() as i32, p.y.floor() as i32);
        let bounds = IntRect::new(x, y, x.saturating_add(1), y.saturating_add(1));
        let paint = Paint::Solid(self.import(point.color));
        self.push(Form::Pixel, bounds, paint);
    }

    /// Where attributes are fixed for interpolation: the corners themselves, or, for the affine
    /// mistake, their images on the screen.
    fn attribute_corners(&self, corners: [DVec3; 3]) -> [DVec3; 3] {
        let affine = self.settings.interpolation == Interpolation::Affine;
        if affine && corners.iter().all(|c| c.z > 0.0) {
            return corners.map(|c| DVec3::new(c.x / c.z, c.y / c.z, 1.0));
        }
        corners
    }

    fn texture_size(&self, image: ImageId) -> Option<DVec2> {
        let Surface { texture, .. } = self.surfaces.get(image.0)?.as_ref()?;
        Some(DVec2::new(texture.width() as f64, texture.height() as f64))
    }

    fn texture_paint(
        &self,
        image: ImageId,
        map: Homography,
        sampler: Sampler,
        opacity: f32,
    ) -> Paint {
        let surface = self.surfaces.get(image.0).and_then(Option::as_ref);
        let opaque = opacity >= 1.0 && surface.is_some_and(|surface| surface.opaque);
        Paint::Textured(Box::new(Textured { map, surface: image.0, sampler, opacity, opaque }))
    }
}
