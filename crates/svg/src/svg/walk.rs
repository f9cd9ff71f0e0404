//! The second pass: usvg's tree into commands.

use super::placeholder::{self, LeafKind, LocalMap};
use super::rewrite::Rewritten;
use super::{layer, paint, quad};
use crate::error::{ErrorKind, Fault};
use crate::extension;
use crate::images::Images;
use crate::warning::Warnings;
use scumble_geometry::{Affine, Homography, Path, PathElement, Rect};
use scumble_pixel::Straight;
use scumble_scene::{Command, Fill, GouraudTriangle, ImageQuad, Stroke, TexturedTriangle};
use std::sync::Arc;
use usvg::{Group, Node, Transform, tiny_skia_path};

pub(super) fn walk(
    tree: &usvg::Tree,
    rewritten: &Rewritten,
    images: &mut Images<'_>,
    warnings: &mut Warnings,
) -> Result<Vec<Command>, Fault> {
    let mut walker = Walker { rewritten, images, warnings, commands: Vec::new() };
    walker.group(tree.root(), Homography::IDENTITY, None)?;
    Ok(walker.commands)
}

struct Walker<'a, 'r> {
    rewritten: &'a Rewritten,
    images: &'a mut Images<'r>,
    warnings: &'a mut Warnings,
    commands: Vec<Command>,
}

impl Walker<'_, '_> {
    /// Draws a group. `clip` cuts images, in the units around the group; it is what usvg makes of
    /// `preserveAspectRatio="… slice"`.
    fn group(&mut self, group: &Group, outer: Homography, clip: Option<Rect>) -> Result<(), Fault> {
        let Some(map) = self.map(group, outer)? else { return Ok(()) };
        let opacity = group.opacity().get();
        if opacity <= 0.0 {
            return Ok(());
        }
        let clip = match clip {
            Some(clip) => Some(clip),
            None => self.clip(group),
        };
        let layer = (opacity < 1.0).then(|| layer::open(&mut self.commands, opacity));
        for child in group.children() {
            match child {
                Node::Group(child) => self.group(child, map, clip)?,
                Node::Path(path) => self.path(path, map)?,
                Node::Image(image) => {
                    let clip = clip.map(|rect| (rect, group.transform()));
                    self.image(image, map, clip);
                }
                Node::Text(_) => {}
            }
        }
        if let Some(start) = layer {
            layer::close(&mut self.commands, start, opacity);
        }
        Ok(())
    }

    /// The map from a group's contents to scene units; `None` where it leaves the numbers.
    fn map(&mut self, group: &Group, outer: Homography) -> Result<Option<Homography>, Fault> {
        // The group that usvg puts around an image carries a scale of its own making.
        let is_image = matches!(group.children(), [Node::Image(_)]);
        let placeholder = placeholder::map_index(group.transform())
            .filter(|_| !is_image)
            .and_then(|(i, after)| Some((self.rewritten.placeholders.maps.get(i)?, after)));
        let own = match placeholder {
            Some((local, after)) => {
                let map = self.local_map(local, group);
                map.map_err(|kind| Fault::at(local.offset, kind))? * Homography::from(after)
            }
            None => affine(group.transform()).into(),
        };
        let map = outer * own;
        if map.is_finite() {
            return Ok(Some(map));
        }
        let offset = placeholder.map(|(local, _)| local.offset);
        let message = "transforms multiply beyond the range of numbers: nothing is drawn there";
        self.warnings.add(offset, message);
        Ok(None)
    }

    fn local_map(&self, local: &LocalMap, group: &Group) -> Result<Homography, ErrorKind> {
        let Some(quad) = &local.quad else { return Ok(local.transform) };
        let from = match quad.from {
            Some(rect) => rect,
            None => {
                self.own_box(group).filter(|r| !r.is_empty()).ok_or_else(|| ErrorKind::Element {
                    element: "sc:quad".into(),
                    message: "the element's own box has no area: give an `sc:box`".into(),
                })?
            }
        };
        Ok(local.transform * quad::homography(from, quad.to)?)
    }

    /// The bounding box of what a group holds, in its own units.
    fn own_box(&self, group: &Group) -> Option<Rect> {
        if let [Node::Path(path)] = group.children()
            && let Some(index) = placeholder::leaf_index(path.data())
        {
            let leaf = self.rewritten.placeholders.leaves.get(index)?;
            return Rect::bounding(*leaf.kind.points()?);
        }
        Some(rect(group.bounding_box()))
    }

    /// The rectangle that a group is clipped to, if it holds nothing but an image; else a clip
    /// that would show is named.
    fn clip(&mut self, group: &Group) -> Option<Rect> {
        let clip = group.clip_path()?;
        let root = clip.root();
        let outline = match root.children() {
            [Node::Path(path)] => rect(path.bounding_box()),
            _ => return None,
        };
        if holds_one_image(group) {
            return Some(outline);
        }
        let inside = rect(group.stroke_bounding_box());
        let shows = !self.rewritten.placeholders.maps.is_empty()
            || inside.x0 < outline.x0
            || inside.y0 < outline.y0
            || inside.x1 > outline.x1
            || inside.y1 > outline.y1;
        if shows {
            let message = "what leaves a nested viewport is drawn too: clips are not applied";
            self.warnings.add(self.rewritten.viewport, message);
        }
        None
    }

    fn path(&mut self, path: &usvg::Path, map: Homography) -> Result<(), Fault> {
        if !path.is_visible() {
            return Ok(());
        }
        if let Some(index) = placeholder::leaf_index(path.data())
            && let Some(leaf) = self.rewritten.placeholders.leaves.get(index)
        {
            return self
                .leaf(&leaf.kind, leaf.offset, map)
                .map_err(|kind| Fault::at(leaf.offset, kind));
        }
        let outline = Arc::new(paint::path(path.data()));
        match path.paint_order() {
            usvg::PaintOrder::FillAndStroke => {
                self.fill(path, &outline, map);
                self.stroke(path, &outline, map);
            }
            usvg::PaintOrder::StrokeAndFill => {
                self.stroke(path, &outline, map);
                self.fill(path, &outline, map);
            }
        }
        Ok(())
    }

    fn fill(&mut self, path: &usvg::Path, outline: &Arc<Path>, transform: Homography) {
        let Some(fill) = path.fill() else { return };
        // Two points enclose nothing.
        if matches!(outline.elements(), [_, PathElement::LineTo(_)]) {
            return;
        }
        let color = self.color(fill.paint(), fill.opacity().get());
        if color.0[3] > 0.0 {
            let (path, rule) = (Arc::clone(outline), paint::fill_rule(fill.rule()));
            self.commands.push(Command::Fill(Fill { path, rule, transform, color }));
        }
    }

    fn stroke(&mut self, path: &usvg::Path, outline: &Arc<Path>, transform: Homography) {
        let Some(stroke) = path.stroke() else { return };
        let mut style = paint::stroke_style(stroke);
        if paint::limit_dashes(&mut style, outline) {
            self.warnings.add(None, "a stroke has too many dashes: it is drawn without");
        }
        let color = self.color(stroke.paint(), stroke.opacity().get());
        if color.0[3] > 0.0 {
            let path = Arc::clone(outline);
            self.commands.push(Command::Stroke(Stroke { path, style, transform, color }));
        }
    }

    /// The colour of a paint; a gradient's mean, with a warning.
    fn color(&mut self, paint: &usvg::Paint, opacity: f32) -> Straight {
        let gradient: &usvg::BaseGradient = match paint {
            usvg::Paint::Color(color) => return paint::color(*color, opacity),
            usvg::Paint::LinearGradient(gradient) => gradient,
            usvg::Paint::RadialGradient(gradient) => gradient,
            // None arrives here: the first pass puts a colour in the place of patterns.
            usvg::Paint::Pattern(_) => return Straight([0.5, 0.5, 0.5, opacity]),
        };
        let message = "a gradient is not drawn: its mean colour stands for it";
        self.warnings.add(self.rewritten.gradient, message);
        paint::mean_color(gradient, opacity)
    }

    fn leaf(
        &mut self,
        kind: &LeafKind,
        offset: usize,
        transform: Homography,
    ) -> Result<(), ErrorKind> {
        match kind {
            LeafKind::Color(triangle) => {
                let (points, colors) = (triangle.points, triangle.colors);
                self.commands.push(Command::Gouraud(GouraudTriangle { points, colors, transform }));
            }
            LeafKind::Textured(triangle) => {
                let texture = self
                    .rewritten
                    .textures
                    .find(&triangle.texid, offset)
                    .ok_or_else(|| extension::unknown_texid(&triangle.texid))?;
                let image = texture.load(self.images)?;
                self.commands.push(Command::Textured(TexturedTriangle {
                    points: triangle.points,
                    uvs: triangle.uvs,
                    image,
                    opacity: 1.0,
                    transform,
                }));
            }
            LeafKind::NotDrawn(message) => self.warnings.add(offset, *message),
        }
        Ok(())
    }

    /// Draws an image, one unit a texel. `clip` is a rectangle in the units around the transform
    /// that comes with it.
    fn image(&mut self, image: &usvg::Image, map: Homography, clip: Option<(Rect, Transform)>) {
        let usvg::ImageKind::PNG(header) = image.kind() else { return };
        let id = placeholder::header_index(header)
            .and_then(|i| self.rewritten.placeholders.images.get(i).copied());
        let Some(id) = id.filter(|_| image.is_visible()) else { return };
        let (width, height) = self.images.size(id);
        let (width, height) = (width as f64, height as f64);
        let mut visible = Rect::new(0.0, 0.0, width, height);
        if let Some((clip, t)) = clip
            && let Ok(inverse) = affine(t).inverse()
        {
            // Upright on both sides, so two corners say it all.
            let [tl, _, br, _] = clip.corners().map(|p| inverse.apply(p));
            visible.x0 = visible.x0.max(tl.x.min(br.x));
            visible.y0 = visible.y0.max(tl.y.min(br.y));
            visible.x1 = visible.x1.min(tl.x.max(br.x));
            visible.y1 = visible.y1.min(tl.y.max(br.y));
        }
        if visible.is_empty() {
            return;
        }
        let source = Rect::new(
            visible.x0 / width,
            visible.y0 / height,
            visible.x1 / width,
            visible.y1 / height,
        );
        use usvg::ImageRendering as R;
        let pixelated =
            matches!(image.rendering_mode(), R::OptimizeSpeed | R::CrispEdges | R::Pixelated);
        self.commands.push(Command::Image(ImageQuad {
            image: id,
            rect: visible,
            source,
            pixelated,
            opacity: 1.0,
            transform: map,
        }));
    }
}

/// Whether a group is what usvg makes of a sliced image: a group in a group, and nothing else.
fn holds_one_image(group: &Group) -> bool {
    let [Node::Group(inner)] = group.children() else { return false };
    matches!(inner.children(), [Node::Image(_)]) && inner.clip_path().is_none()
}

fn affine(t: Transform) -> Affine {
    let [a, b, c, d, e, f] = [t.sx, t.ky, t.kx, t.sy, t.tx, t.ty].map(f64::from);
    Affine::new(a, b, c, d, e, f)
}

fn rect(r: tiny_skia_path::Rect) -> Rect {
    let [x0, y0, x1, y1] = [r.left(), r.top(), r.right(), r.bottom()].map(f64::from);
    Rect::new(x0, y0, x1, y1)
}
