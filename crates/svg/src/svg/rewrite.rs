//! The first pass: a document that usvg understands as a whole, with placeholders for the rest.

use super::placeholder::{self, Leaf, LeafKind, LocalMap, Placeholders};
use super::sheet::{self, InlineStyle, affine_text, placeholder_text, read_transform};
use super::{css, origin, quad};
use crate::course::href;
use crate::error::{ErrorKind, Fault};
use crate::extension::{ColorTriangle, TexturedTriangle, Textures, svg_name};
use crate::images::Images;
use crate::numbers;
use crate::warning::Warnings;
use roxmltree::Node;
use scumble_geometry::{Affine, DVec2, Homography};
use scumble_scene::ImageWrap;

/// The outcome of the first pass.
pub(super) struct Rewritten {
    /// The document for usvg.
    pub(super) xml: String,
    pub(super) placeholders: Placeholders,
    pub(super) textures: Textures,
    /// Whether the root says how large it is.
    pub(super) has_size: bool,
    /// Where the first gradient stands, in bytes.
    pub(super) gradient: Option<usize>,
    /// Where the first nested viewport stands.
    pub(super) viewport: Option<usize>,
}

pub(super) fn rewrite(
    root: Node<'_, '_>,
    images: &mut Images<'_>,
    warnings: &mut Warnings,
) -> Result<Rewritten, Fault> {
    let textures = Textures::collect(root).map_err(|(offset, kind)| Fault::at(offset, kind))?;
    let mut writer = Writer {
        images,
        warnings,
        out: Rewritten {
            xml: String::new(),
            placeholders: Placeholders::default(),
            textures,
            has_size: has_size(root),
            gradient: None,
            viewport: None,
        },
    };
    writer.document(root)?;
    Ok(writer.out)
}

/// Whether `viewBox`, or both sides in absolute units, are there.
fn has_size(root: Node<'_, '_>) -> bool {
    let absolute = |name| {
        let text: Option<&str> = root.attribute::<&str>(name);
        text.is_some_and(|v| numbers::leading(v).is_some() && !v.contains('%'))
    };
    root.has_attribute("viewBox") || (absolute("width") && absolute("height"))
}

/// Properties that keep markers away, whatever a style sheet says.
const NO_MARKERS: &str =
    "marker-start:none!important;marker-mid:none!important;marker-end:none!important";

/// Properties that keep a placeholder whole, whatever it would inherit.
const PLACEHOLDER_STYLE: &str = "fill:#000!important;stroke:none!important;\
    marker-start:none!important;marker-mid:none!important;marker-end:none!important";

/// What is written for an element that usvg must not see, so that selectors still count it.
const NOTHING: &str = "<metadata/>";

/// What an element becomes.
enum Plan {
    /// Nothing.
    Drop,
    /// Itself, with its children.
    Element,
    /// Itself, with a style sheet inside.
    Style,
    /// A path that stands for it.
    Leaf(LeafKind),
    /// A gradient of one colour.
    Pattern,
}

struct Writer<'a, 'r> {
    images: &'a mut Images<'r>,
    warnings: &'a mut Warnings,
    out: Rewritten,
}

impl Writer<'_, '_> {
    /// Writes an element and everything in it, with an explicit stack of what is still to close.
    fn document(&mut self, root: Node<'_, '_>) -> Result<(), Fault> {
        let mut open: Vec<(Option<Node<'_, '_>>, String, bool)> = Vec::new();
        let mut next = Some(root);
        loop {
            let in_marker = open.last().is_some_and(|o| o.2);
            if let Some(node) = next {
                next = node.next_sibling().filter(|_| node != root);
                if !node.is_element() {
                    continue;
                }
                let entered = self
                    .element(node, in_marker)
                    .map_err(|kind| Fault::at(node.range().start, kind))?;
                if let Some(closing) = entered {
                    let in_marker = in_marker || svg_name(node) == Some("marker");
                    open.push((next, closing, in_marker));
                    next = node.first_child();
                }
            } else if let Some((sibling, closing, _)) = open.pop() {
                self.out.xml.push_str(&closing);
                next = sibling;
            } else {
                return Ok(());
            }
        }
    }

    /// Writes the beginning of an element, and gives its end if its children are to come between.
    fn element(
        &mut self,
        node: Node<'_, '_>,
        in_marker: bool,
    ) -> Result<Option<String>, ErrorKind> {
        let offset = node.range().start;
        let name = svg_name(node).unwrap_or_default();
        match self.plan(node, name, in_marker)? {
            Plan::Drop => self.out.xml.push_str(NOTHING),
            Plan::Pattern => self.pattern(node),
            Plan::Style => {
                let text: String = sheet::texts(node).collect();
                let placeholders = &mut self.out.placeholders;
                let css = sheet::rewrite_sheet(&text, offset, placeholders, self.warnings);
                self.out.xml.push_str("<style>");
                push_escaped(&mut self.out.xml, &css);
                self.out.xml.push_str("</style>");
            }
            Plan::Leaf(kind) => {
                let index = self.out.placeholders.leaves.len();
                self.out.placeholders.leaves.push(Leaf { kind, offset });
                self.open_tag(node, "path", in_marker, Some(index))?;
                self.out.xml.push_str("/>");
            }
            Plan::Element => {
                let wrapped = self.open_tag(node, name, in_marker, None)?;
                self.out.xml.push('>');
                let end = if wrapped { "</g>" } else { "" };
                return Ok(Some(format!("</{name}>{end}")));
            }
        }
        Ok(None)
    }

    fn plan(&mut self, node: Node<'_, '_>, name: &str, in_marker: bool) -> Result<Plan, ErrorKind> {
        let offset = node.range().start;
        Ok(match name {
            "textri" => Plan::Leaf(LeafKind::Textured(TexturedTriangle::read(node)?)),
            "colortri" => Plan::Leaf(LeafKind::Color(ColorTriangle::read(node)?)),
            "text" => Plan::Leaf(LeafKind::NotDrawn("`text` is not drawn")),
            "foreignObject" => Plan::Leaf(LeafKind::NotDrawn("`foreignObject` is not drawn")),
            "image" => self.image(node)?,
            "style" if !matches!(node.attribute("type"), None | Some("text/css")) => Plan::Drop,
            "style" => Plan::Style,
            "pattern" => {
                self.warnings.add(offset, "`pattern` is not drawn: mid-grey stands for it");
                Plan::Pattern
            }
            "animate" | "animateTransform" | "animateMotion" | "set" => {
                self.warnings.add(offset, format!("`{name}` is not played"));
                Plan::Drop
            }
            "use" if in_marker => {
                self.warnings.add(offset, "`use` inside `marker` is not drawn");
                Plan::Drop
            }
            "svg" | "symbol" => {
                if node.parent_element().is_some() {
                    self.out.viewport.get_or_insert(offset);
                }
                Plan::Element
            }
            "linearGradient" | "radialGradient" => {
                self.out.gradient.get_or_insert(offset);
                Plan::Element
            }
            "g" | "a" | "defs" | "switch" | "use" | "rect" | "circle" | "ellipse" | "line"
            | "polyline" | "polygon" | "path" | "stop" | "marker" => Plan::Element,
            // Foreign elements, and those that draw nothing.
            "" | "title" | "desc" | "metadata" | "texture" | "script" | "view" | "mask"
            | "clipPath" | "filter" => Plan::Drop,
            _ => {
                let message = format!("`{}` is not drawn: it is not known", short(name));
                self.warnings.add(offset, message);
                Plan::Drop
            }
        })
    }

    /// Loads an image, so that its size is known; pictures in SVG are not read.
    fn image(&mut self, node: Node<'_, '_>) -> Result<Plan, ErrorKind> {
        let Some(href) = href(node).map(str::trim) else { return Ok(Plan::Drop) };
        let path = href.split(['?', '#']).next().unwrap_or_default().to_ascii_lowercase();
        let is_svg = path.starts_with("data:image/svg") || path.ends_with(".svg");
        if is_svg || path.ends_with(".svgz") && !path.starts_with("data:") {
            return Ok(Plan::Leaf(LeafKind::NotDrawn("`image` of a picture in SVG is not drawn")));
        }
        let id = self.images.load(href, ImageWrap::Clamp)?;
        self.out.placeholders.images.push(id);
        Ok(Plan::Element)
    }

    fn pattern(&mut self, node: Node<'_, '_>) {
        self.out.xml.push_str("<linearGradient");
        if let Some(id) = node.attribute("id") {
            push_attribute(&mut self.out.xml, "id", id);
        }
        self.out.xml.push_str("><stop offset=\"0\" stop-color=\"#808080\"/></linearGradient>");
    }

    /// Writes a tag as far as its `>`, and says whether a group had to be put around it.
    ///
    /// A placeholder for leaf `leaf` leaves out what only that element understands.
    fn open_tag(
        &mut self,
        node: Node<'_, '_>,
        tag: &str,
        in_marker: bool,
        leaf: Option<usize>,
    ) -> Result<bool, ErrorKind> {
        let offset = node.range().start;
        let style = node.attribute("style").unwrap_or_default();
        let mut inline = sheet::split_inline(style, offset, in_marker, self.warnings);
        let transform = self.transform(node, &mut inline)?;
        // usvg multiplies more into the transforms of these, which a placeholder must not meet.
        let is_root = node.parent_element().is_none();
        let wrapped = transform.is_placeholder && matches!(tag, "use" | "svg") && !is_root;
        if wrapped {
            self.out.xml.push_str("<g");
            push_attribute(&mut self.out.xml, "transform", &transform.text);
            self.out.xml.push('>');
        }
        self.out.xml.push('<');
        self.out.xml.push_str(tag);
        if is_root {
            push_attribute(&mut self.out.xml, "xmlns", "http://www.w3.org/2000/svg");
        }
        self.attributes(node, tag, in_marker, leaf.is_some());
        if !wrapped && !transform.text.is_empty() {
            if transform.from_style {
                css::prepend(&mut inline.css, &format!("transform:{}", transform.text));
            } else {
                push_attribute(&mut self.out.xml, "transform", &transform.text);
            }
        }
        if let Some(index) = leaf {
            push_attribute(&mut self.out.xml, "d", &placeholder::leaf_path(index));
            css::prepend(&mut inline.css, PLACEHOLDER_STYLE);
        } else if in_marker || tag == "marker" {
            css::prepend(&mut inline.css, NO_MARKERS);
        }
        if !inline.css.is_empty() {
            push_attribute(&mut self.out.xml, "style", &inline.css);
        }
        Ok(wrapped)
    }

    /// Writes the attributes that need no thought.
    fn attributes(&mut self, node: Node<'_, '_>, tag: &str, in_marker: bool, is_leaf: bool) {
        let offset = node.range().start;
        for attribute in node.attributes().filter(|a| a.namespace().is_none()) {
            let (name, value) = (attribute.name(), attribute.value());
            if let Some(instead) = sheet::undrawn(name, value.trim()) {
                if !instead.is_empty() && name != "mix-blend-mode" {
                    self.warnings.add(offset, instead);
                }
                continue;
            }
            let value = match name {
                "transform" | "transform-origin" | "style" | "href" => continue,
                "points" | "uvs" | "colors" | "texid" | "d" if is_leaf => continue,
                _ if in_marker && name.starts_with("marker") => continue,
                // usvg takes these words only from style; as an attribute it knows an older one.
                "image-rendering" if matches!(value.trim(), "pixelated" | "crisp-edges") => {
                    "optimizeSpeed"
                }
                _ => value,
            };
            push_attribute(&mut self.out.xml, name, value);
        }
        if is_leaf {
            return;
        }
        if tag == "image" {
            let index = self.out.placeholders.images.len().saturating_sub(1);
            push_attribute(&mut self.out.xml, "href", &placeholder::image_href(index));
        } else if let Some(href) = href(node) {
            push_attribute(&mut self.out.xml, "href", href);
        }
    }

    /// The `transform` of an element, from its style or else its attribute, with its origin and
    /// `sc:quad`.
    fn transform(
        &mut self,
        node: Node<'_, '_>,
        inline: &mut InlineStyle,
    ) -> Result<Transform, ErrorKind> {
        let offset = node.range().start;
        let is_root = node.parent_element().is_none();
        let from_style = inline.transform.is_some();
        let text = inline.transform.as_deref().or_else(|| node.attribute("transform"));
        let origin = inline.origin.as_deref().or_else(|| node.attribute("transform-origin"));
        let quad = quad::read(node, svg_name(node).unwrap_or_default())?;
        if text.is_none() && quad.is_none() {
            // The origin may belong to a transform in a style sheet.
            if let Some(origin) = origin {
                css::prepend(&mut inline.css, &format!("transform-origin:{origin}"));
            }
            return Ok(Transform::default());
        }
        let mut map =
            text.map_or(Homography::IDENTITY, |t| read_transform(t, offset, self.warnings));
        if let Some(origin) = origin {
            map = self.about_origin(node, map, origin);
            if is_root {
                // Else usvg would turn the root about its middle.
                css::prepend(&mut inline.css, "transform-origin:0 0");
            }
        }
        let affine = map.to_affine().filter(|_| quad.is_none());
        if is_root && affine.is_none() {
            let message = "the root's transform is ignored: put a perspective one on a group";
            self.warnings.add(offset, message);
            return Ok(Transform::default());
        }
        let text = match affine {
            Some(affine) => affine_text(affine),
            None => {
                let map = LocalMap { transform: map, quad, offset };
                placeholder_text(map, &mut self.out.placeholders)
            }
        };
        Ok(Transform { text, from_style, is_placeholder: affine.is_none() })
    }

    /// The same map with another fixed point.
    fn about_origin(&mut self, node: Node<'_, '_>, map: Homography, text: &str) -> Homography {
        let viewport =
            quad::viewport(node).map_or(DVec2::ZERO, |r| DVec2::new(r.width(), r.height()));
        let Some(p) = origin::parse(text, viewport) else {
            let message = "`transform-origin` is ignored: it is not lengths or percentages";
            self.warnings.add(node.range().start, message);
            return map;
        };
        Homography::from(Affine::translate(p.x, p.y))
            * map
            * Homography::from(Affine::translate(-p.x, -p.y))
    }
}

/// A transform as usvg gets to see it; empty for none.
#[derive(Default)]
struct Transform {
    text: String,
    from_style: bool,
    is_placeholder: bool,
}

/// Writes ` name="value"`, escaped.
fn push_attribute(out: &mut String, name: &str, value: &str) {
    out.extend([" ", name, "=\""]);
    push_escaped(out, value);
    out.push('"');
}

fn push_escaped(out: &mut String, text: &str) {
    for c in text.chars() {
        match c {
            '<' => out.push_str("&lt;"),
            '>' => out.push_str("&gt;"),
            '&' => out.push_str("&amp;"),
            '"' => out.push_str("&quot;"),
            '\n' => out.push_str("&#10;"),
            '\r' => out.push_str("&#13;"),
            '\t' => out.push_str("&#9;"),
            c => out.push(c),
        }
    }
}

/// A name fit for a message.
fn short(name: &str) -> String {
    crate::images::shorten(name)
}
