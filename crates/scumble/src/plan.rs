//! From a scene to primitives: transformed, flattened, snapped, with textures built.

use crate::paint::{Paint, Textured};
use crate::{Antialias, Interpolation, Settings};
use scumble_coverage::Shape;
use scumble_geometry::{
    Affine, Contours, DVec2, DVec3, FillRule, Homography, IntRect, Path, PathElement, Ramp, Rect,
    clip_segment, line_quad,
};
use scumble_pixel::{Premul, Straight};
use scumble_scene::{
    Command, Fill, GouraudTriangle, Hairline, ImageId, ImageQuad, Point, Scene, Stroke,
    TexturedTriangle,
};
use scumble_texture::{LevelMode, PixelFilter, Sampler, Texture};

/// An image of the scene, ready to be sampled.
#[derive(Debug)]
pub(crate) struct Surface {
    pub(crate) texture: Texture,
    /// Whether every texel is opaque, so that every average of them is.
    pub(crate) opaque: bool,
}

/// How far, in pixels, a chord may lie from its curve: a sixty-fourth is an error of about one
/// grey level in 255 on a pixel that the curve crosses. Halving it costs 1.4 times the points.
const FLATNESS: f64 = 1.0 / 64.0;

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
    pub(crate) draws: Vec<Draw>,
    /// By draw: the pixels of the canvas that it may touch. Apart from the rest, since it is asked
    /// for much more often.
    pub(crate) bounds: Vec<IntRect>,
    pub(crate) layers: Vec<Layer>,
    /// About what the outlines take, in bytes.
    pub(crate) outline_bytes: u64,
    /// By image index; `None` where no command uses the image.
    pub(crate) surfaces: &'a [Option<Surface>],
}

/// Makes the primitives of a scene for given settings.
pub(crate) fn build<'a>(
    scene: &Scene,
    settings: &'a Settings,
    surfaces: &'a [Option<Surface>],
) -> Plan<'a> {
    let canvas = IntRect::new(0, 0, settings.width as i32, settings.height as i32);
    let mut planner = Planner {
        settings,
        view: scene.view.homography(settings.width, settings.height),
        canvas,
        layer: 0,
        last: None,
        plan: Plan {
            draws: Vec::with_capacity(scene.commands.len()),
            bounds: Vec::with_capacity(scene.commands.len()),
            outline_bytes: 0,
            layers: vec![Layer { parent: 0, opacity: 1.0, depth: 1 }],
            surfaces,
        },
    };
    for command in &scene.commands {
        planner.command(command);
        if planner.plan.outline_bytes > settings.max_memory {
            break; // The caller refuses the plan; no need to make more of it.
        }
    }
    planner.layer = 0;
    for ends in scene.view.frame(settings.width, settings.height).into_iter().flatten() {
        planner.hairline_on_canvas(ends, Straight::BLACK);
    }
    planner.plan
}

struct Planner<'a> {
    settings: &'a Settings,
    view: Homography,
    canvas: IntRect,
    layer: u32,
    /// The last transform, and what came of it: most have the one of the primitive before.
    last: Option<(Homography, Homography)>,
    plan: Plan<'a>,
}

impl Planner<'_> {
    fn command(&mut self, command: &Command) {
        match command {
            Command::PushLayer { opacity } => self.push_layer(*opacity),
            Command::PopLayer => {
                self.layer = self.plan.layers[self.layer as usize].parent;
            }
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
        let depth = self.plan.layers[self.layer as usize].depth + 1;
        let layer = Layer { parent: self.layer, opacity: opacity.clamp(0.0, 1.0), depth };
        self.layer = self.plan.layers.len() as u32;
        self.plan.layers.push(layer);
    }

    fn canvas_map(&mut self, transform: &Homography) -> Homography {
        match self.last {
            Some((last, to_canvas)) if last == *transform => to_canvas,
            _ => self.last.insert((*transform, self.view * *transform)).1,
        }
    }

    fn import(&self, color: Straight) -> Premul {
        self.settings.space.import(color)
    }

    fn push(&mut self, form: Form, bounds: IntRect, paint: Paint) {
        let bounds = bounds.intersect(&self.canvas);
        if bounds.is_empty() {
            return;
        }
        let effect = match &paint {
            _ if self.layer != 0 || !paint.is_opaque() => Effect::Blends,
            _ if self.settings.antialias == Antialias::Area => Effect::Blends,
            Paint::Solid(_) => Effect::Flat,
            _ if self.settings.per_sample() => Effect::Blends,
            Paint::Gouraud(ramp) if ramp.plane().is_some() => Effect::Ramps,
            _ => Effect::Hides,
        };
        self.plan.bounds.push(bounds);
        self.plan.draws.push(Draw { form, paint, layer: self.layer, effect });
    }

    /// Coordinates that are not finite draw nothing: readers refuse them long before.
    fn push_shape(&mut self, shape: Option<Shape>, paint: Paint) {
        if let Some(shape) = shape {
            let bounds = shape.bounds();
            self.push(Form::Shape(shape), bounds, paint);
        }
    }

    fn push_contours(&mut self, contours: &Contours, rule: FillRule, paint: Paint) {
        self.plan.outline_bytes += contours.points.len() as u64 * EDGE_BYTES;
        let shape = Shape::polygon(contours.iter(), rule).ok().flatten();
        self.push_shape(shape, paint);
    }

    fn fill(&mut self, fill: &Fill) {
        let to_canvas = self.canvas_map(&fill.transform);
        let paint = Paint::Solid(self.import(fill.color));
        if let Some(corners) = triangle(&fill.path) {
            let corners = corners.map(|p| to_canvas.project_homogeneous(p));
            return self.push_shape(Shape::projective(&corners, to_canvas.near_w()), paint);
        }
        let contours = fill.path.flatten(&to_canvas, FLATNESS);
        self.push_contours(&contours, fill.rule, paint);
    }

    fn stroke(&mut self, stroke: &Stroke) {
        let to_canvas = self.canvas_map(&stroke.transform);
        let outline =
            stroke.path.stroke(&stroke.style, FLATNESS / stroke.largest_scale(&to_canvas));
        let paint = Paint::Solid(self.import(stroke.color));
        self.push_contours(&outline.flatten(&to_canvas, FLATNESS), FillRule::NonZero, paint);
    }

    fn gouraud(&mut self, triangle: &GouraudTriangle) {
        let to_canvas = self.canvas_map(&triangle.transform);
        let corners = triangle.points.map(|p| to_canvas.project_homogeneous(p));
        let [a, b, c] = triangle.colors;
        let paint = if a == b && b == c {
            Some(Paint::Solid(self.import(a)))
        } else {
            let colors = triangle.colors.map(|color| self.import(color).0);
            Ramp::new(self.attribute_corners(corners), colors)
                .ok()
                .map(|ramp| Paint::Gouraud(Box::new(ramp)))
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
        let source = quad.source;
        let texels = Rect::new(
            source.x0 * size.x,
            source.y0 * size.y,
            source.x1 * size.x,
            source.y1 * size.y,
        );
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
            self.hairline_on_canvas(ends.map(divide), line.color);
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
        let Surface { texture, .. } = self.plan.surfaces.get(image.0)?.as_ref()?;
        Some(DVec2::new(texture.width() as f64, texture.height() as f64))
    }

    fn texture_paint(
        &self,
        image: ImageId,
        map: Homography,
        sampler: Sampler,
        opacity: f32,
    ) -> Paint {
        let surface = self.plan.surfaces.get(image.0).and_then(Option::as_ref);
        let opaque = opacity >= 1.0 && surface.is_some_and(|surface| surface.opaque);
        Paint::Textured(Box::new(Textured { map, surface: image.0, sampler, opacity, opaque }))
    }
}

/// The corners of a path that is a triangle and nothing else.
fn triangle(path: &Path) -> Option<[DVec2; 3]> {
    use PathElement::{Close, LineTo, MoveTo};
    match *path.elements() {
        [MoveTo(a), LineTo(b), LineTo(c)] | [MoveTo(a), LineTo(b), LineTo(c), Close] => {
            Some([a, b, c])
        }
        _ => None,
    }
}

fn divide(p: DVec3) -> DVec2 {
    DVec2::new(p.x / p.z, p.y / p.z)
}
