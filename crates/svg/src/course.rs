//! The course's dialect: a few elements, its own view, nothing inherited.

use crate::error::{ErrorKind, Fault};
use crate::extension::{self, ColorTriangle, TexturedTriangle, Textures, svg_name};
use crate::images::Images;
use crate::warning::Warnings;
use crate::{numbers, transform};
use roxmltree::Node;
use scumble_geometry::{DVec2, FillRule, Homography, Path, Rect};
use scumble_pixel::Straight;
use scumble_scene::{
    Command, Fill, GouraudTriangle, Hairline, ImageId, ImageQuad, ImageWrap, Point, Scene, View,
};
use std::sync::Arc;

/// Reads a checked document.
pub(crate) fn read(
    root: Node<'_, '_>,
    mut images: Images<'_>,
    warnings: &mut Warnings,
) -> Result<Scene, Fault> {
    let size = size(root)?;
    let textures = Textures::collect(root).map_err(|(offset, kind)| Fault::at(offset, kind))?;
    let mut reader = Reader { textures, images: &mut images, warnings, commands: Vec::new() };
    reader.children(root)?;
    let commands = reader.commands;
    Ok(Scene {
        view: View::Course { size },
        background: Some(Straight::WHITE),
        images: images.into_vec(),
        commands,
    })
}

/// The root's `width` and `height`; `viewBox` does not matter here.
fn size(root: Node<'_, '_>) -> Result<DVec2, Fault> {
    let side = |name: &str| {
        let bad = |message: String| Fault::at(root.range().start, ErrorKind::Size(message));
        let text = root
            .attribute(name)
            .ok_or_else(|| bad(format!("the course profile needs a `{name}` on the root")))?;
        match numbers::leading(text) {
            Some(n) if n > 0.0 => Ok(n),
            _ => Err(bad(format!("`{name}` is not a positive number"))),
        }
    };
    Ok(DVec2::new(side("width")?, side("height")?))
}

struct Reader<'a, 'r> {
    textures: Textures,
    images: &'a mut Images<'r>,
    warnings: &'a mut Warnings,
    commands: Vec<Command>,
}

impl Reader<'_, '_> {
    /// Reads the children of `root` and of its groups, in order. An explicit stack holds, for
    /// each open group, its next child and the map of its contents.
    fn children(&mut self, root: Node<'_, '_>) -> Result<(), Fault> {
        let mut stack = vec![(root.first_child(), Homography::IDENTITY)];
        while let Some((next, outer)) = stack.last_mut() {
            let Some(node) = *next else {
                stack.pop();
                continue;
            };
            *next = node.next_sibling();
            let outer = *outer;
            let Some(name) = svg_name(node) else { continue };
            let Some(map) = self.transform(node, outer) else { continue };
            if name == "g" {
                stack.push((node.first_child(), map));
            } else {
                self.element(node, name, map)
                    .map_err(|kind| Fault::at(node.range().start, kind))?;
            }
        }
        Ok(())
    }

    /// The map from a node's own units to scene units; `None` where it leaves the numbers.
    fn transform(&mut self, node: Node<'_, '_>, outer: Homography) -> Option<Homography> {
        let Some(text) = node.attribute("transform") else { return Some(outer) };
        let own = match transform::parse(text) {
            Ok(own) => own,
            Err(message) => {
                let message = format!("`transform` is ignored: {message}");
                self.warnings.add(node.range().start, message);
                Homography::IDENTITY
            }
        };
        let map = outer * own;
        if map.is_finite() {
            return Some(map);
        }
        let message = "transforms multiply beyond the range of numbers: nothing is drawn there";
        self.warnings.add(node.range().start, message);
        None
    }

    fn element(
        &mut self,
        node: Node<'_, '_>,
        name: &str,
        map: Homography,
    ) -> Result<(), ErrorKind> {
        match name {
            "line" => {
                let end = |x, y| DVec2::new(self.number(node, x), self.number(node, y));
                let ends = [end("x1", "y1"), end("x2", "y2")];
                self.outline(node, &ends, false, map);
            }
            "polyline" => {
                let points = self.points(node);
                self.outline(node, &points, false, map);
            }
            "polygon" => {
                let points = self.points(node);
                self.fill(node, &points, map);
                self.outline(node, &points, true, map);
            }
            "rect" => self.rect(node, map),
            "image" => self.image(node, map)?,
            "colortri" => {
                let ColorTriangle { points, colors } = ColorTriangle::read(node)?;
                let triangle = GouraudTriangle { points, colors, transform: map };
                self.commands.push(Command::Gouraud(triangle));
            }
            "textri" => self.textri(node, map)?,
            "texture" | "title" | "desc" | "metadata" | "defs" => {}
            _ => {
                let message = format!("`{name}` is not drawn: the course's dialect has none");
                self.warnings.add(node.range().start, message);
            }
        }
        Ok(())
    }

    fn rect(&mut self, node: Node<'_, '_>, map: Homography) {
        let number = |name| self.number(node, name);
        let rect = Rect::from_size(number("x"), number("y"), number("width"), number("height"));
        let position = DVec2::new(rect.x0, rect.y0);
        if number("width") == 0.0 && number("height") == 0.0 {
            if let Some(color) = self.color(node, "fill", Some(Straight::BLACK)) {
                self.commands.push(Command::Point(Point { position, color, transform: map }));
            }
        } else if position.is_finite() && rect.x1.is_finite() && rect.y1.is_finite() {
            self.fill(node, &rect.corners(), map);
            self.outline(node, &rect.corners(), true, map);
        }
    }

    fn image(&mut self, node: Node<'_, '_>, map: Homography) -> Result<(), ErrorKind> {
        let href = href(node).ok_or_else(|| extension::faulty(node, "it has no `href`"))?;
        let image = self.images.load(href, ImageWrap::Clamp)?;
        let (columns, rows) = self.images.size(image);
        let length = |name, natural: usize| match node.attribute(name) {
            Some(_) => self.number(node, name),
            None => natural as f64,
        };
        let (width, height) = (length("width", columns), length("height", rows));
        let rect = Rect::from_size(self.number(node, "x"), self.number(node, "y"), width, height);
        if rect.is_empty() || !(rect.x1.is_finite() && rect.y1.is_finite()) {
            self.warnings.add(node.range().start, "`image` without area is not drawn");
            return Ok(());
        }
        self.commands.push(Command::Image(ImageQuad {
            image,
            rect,
            source: Rect::new(0.0, 0.0, 1.0, 1.0),
            pixelated: false,
            opacity: 1.0,
            transform: map,
        }));
        Ok(())
    }

    fn textri(&mut self, node: Node<'_, '_>, map: Homography) -> Result<(), ErrorKind> {
        let TexturedTriangle { points, uvs, texid } = TexturedTriangle::read(node)?;
        let texture = self
            .textures
            .find(&texid, node.range().start)
            .ok_or_else(|| extension::unknown_texid(&texid))?;
        let image = texture.load(self.images)?;
        let uvs = self.align_corners(uvs, image);
        self.commands.push(Command::Textured(scumble_scene::TexturedTriangle {
            points,
            uvs,
            image,
            opacity: 1.0,
            transform: map,
        }));
        Ok(())
    }

    /// The course's (0, 0) and (1, 1) are the *centres* of the corner texels, a scene's are the
    /// corners of the image.
    fn align_corners(&self, uvs: [DVec2; 3], image: ImageId) -> [DVec2; 3] {
        let (width, height) = self.images.size(image);
        let size = DVec2::new(width as f64, height as f64);
        uvs.map(|uv| (uv * (size - DVec2::ONE) + DVec2::splat(0.5)) / size)
    }

    /// Fills an outline in the `fill` colour, black if there is none.
    fn fill(&mut self, node: Node<'_, '_>, points: &[DVec2], map: Homography) {
        let Some(color) = self.color(node, "fill", Some(Straight::BLACK)) else { return };
        if points.len() < 3 {
            return;
        }
        self.commands.push(Command::Fill(Fill {
            path: Arc::new(Path::polyline(points.iter().copied(), true)),
            rule: FillRule::NonZero,
            transform: map,
            color,
        }));
    }

    /// Draws hairlines from point to point in the `stroke` colour, if there is one.
    fn outline(&mut self, node: Node<'_, '_>, points: &[DVec2], closed: bool, map: Homography) {
        let Some(color) = self.color(node, "stroke", None) else { return };
        let back = match points {
            [first, .., last] if closed => Some([*last, *first]),
            _ => None,
        };
        let ends = points.windows(2).map(|pair| [pair[0], pair[1]]).chain(back);
        let line = |[from, to]: [DVec2; 2]| {
            Command::Hairline(Hairline { from, to, color, transform: map })
        };
        self.commands.extend(ends.map(line));
    }

    /// The colour of `fill` or `stroke` with its opacity; `None` for `none`.
    fn color(
        &mut self,
        node: Node<'_, '_>,
        attribute: &str,
        default: Option<Straight>,
    ) -> Option<Straight> {
        let mut color = match node.attribute(attribute).map(str::trim) {
            None | Some("") => default?,
            Some("none" | "transparent") => return None,
            Some(text) => parse_color(text).unwrap_or_else(|| {
                let message = format!("`{attribute}` is not a colour: black is taken");
                self.warnings.add(node.range().start, message);
                Straight::BLACK
            }),
        };
        let opacity = node.attribute(format!("{attribute}-opacity").as_str());
        if let Some(opacity) = opacity.and_then(numbers::leading) {
            color.0[3] = opacity.clamp(0.0, 1.0) as f32;
        }
        Some(color)
    }

    /// A number; 0 if the attribute is missing, or is no number, which is said.
    fn number(&self, node: Node<'_, '_>, attribute: &str) -> f64 {
        node.attribute(attribute).and_then(numbers::leading).unwrap_or(0.0)
    }

    /// The points of a polyline or polygon, up to the first thing that is no number.
    fn points(&mut self, node: Node<'_, '_>) -> Vec<DVec2> {
        let (numbers, complete) = numbers::list(node.attribute("points").unwrap_or_default());
        if !complete || numbers.len() % 2 != 0 {
            let message = "`points` is drawn up to where it is not pairs of numbers";
            self.warnings.add(node.range().start, message);
        }
        numbers.as_chunks().0.iter().map(|&[x, y]| DVec2::new(x, y)).collect()
    }
}

/// A colour as SVG writes it, or six hexadecimal digits without their `#`.
fn parse_color(text: &str) -> Option<Straight> {
    let color = text
        .parse::<svgtypes::Color>()
        .or_else(|_| format!("#{text}").parse::<svgtypes::Color>())
        .ok()?;
    let channel = |v: u8| f32::from(v) / 255.0;
    let [r, g, b, a] = [color.red, color.green, color.blue, color.alpha].map(channel);
    Some(Straight([r, g, b, a]))
}

/// The `href` of an element: SVG 2's, or else XLink's.
pub(crate) fn href<'a>(node: Node<'a, '_>) -> Option<&'a str> {
    const XLINK: &str = "http://www.w3.org/1999/xlink";
    let plain = node.attributes().find(|a| a.name() == "href" && a.namespace().is_none());
    let linked = || node.attributes().find(|a| a.name() == "href" && a.namespace() == Some(XLINK));
    plain.or_else(linked).map(|a| a.value())
}
