//! The elements that SVG does not have: `texture`, `textri` and `colortri`.

use crate::error::ErrorKind;
use crate::images::Images;
use crate::numbers;
use roxmltree::Node;
use scumble_geometry::DVec2;
use scumble_pixel::Straight;
use scumble_scene::{ImageId, ImageWrap};
use std::cell::Cell;
use std::collections::HashMap;

/// The namespace of our attributes, usually with the prefix `sc`.
pub(crate) const NAMESPACE: &str = "https://scumble.rs/ns/1";

const SVG: &str = "http://www.w3.org/2000/svg";

/// The name of an element of SVG (or of no namespace, as much of the course's material); `None`
/// for foreign elements and for text.
pub(crate) fn svg_name<'a>(node: Node<'a, '_>) -> Option<&'a str> {
    let name = node.tag_name();
    (node.is_element() && matches!(name.namespace(), None | Some(SVG))).then(|| name.name())
}

/// A `textri` before its texture is looked up.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct TexturedTriangle {
    pub(crate) points: [DVec2; 3],
    pub(crate) uvs: [DVec2; 3],
    pub(crate) texid: String,
}

/// A `colortri`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct ColorTriangle {
    pub(crate) points: [DVec2; 3],
    pub(crate) colors: [Straight; 3],
}

impl TexturedTriangle {
    pub(crate) fn read(node: Node<'_, '_>) -> Result<Self, ErrorKind> {
        Ok(Self {
            points: corners(node, "points")?,
            uvs: corners(node, "uvs")?,
            texid: required(node, "texid")?.to_owned(),
        })
    }
}

impl ColorTriangle {
    pub(crate) fn read(node: Node<'_, '_>) -> Result<Self, ErrorKind> {
        let points = corners(node, "points")?;
        let text = required(node, "colors")?;
        let n = numbers::exactly::<12>(text)
            .ok_or_else(|| faulty(node, "`colors` is not 12 numbers, r g b a of three corners"))?;
        let color =
            |i: usize| Straight(core::array::from_fn(|k| n[4 * i + k].clamp(0.0, 1.0) as f32));
        Ok(Self { points, colors: [color(0), color(1), color(2)] })
    }
}

/// The `texture` declarations of a document.
///
/// A use finds the last declaration before it, or else the first after it.
#[derive(Debug, Default)]
pub(crate) struct Textures {
    by_id: HashMap<String, Vec<Texture>>,
}

/// One `texture`.
#[derive(Debug)]
pub(crate) struct Texture {
    filename: String,
    wrap: ImageWrap,
    /// Where it stands in the document, in bytes.
    offset: usize,
    /// The image, once it was loaded: a name can be a data URI, too long to look up each time.
    image: Cell<Option<ImageId>>,
}

impl Texture {
    /// The image, loaded when it is first asked for.
    pub(crate) fn load(&self, images: &mut Images<'_>) -> Result<ImageId, ErrorKind> {
        if let Some(image) = self.image.get() {
            return Ok(image);
        }
        let image = images.load(&self.filename, self.wrap)?;
        self.image.set(Some(image));
        Ok(image)
    }
}

impl Textures {
    /// Collects the declarations of a document, wherever they stand. On error, the byte offset of
    /// the culprit comes along.
    pub(crate) fn collect(root: Node<'_, '_>) -> Result<Self, (usize, ErrorKind)> {
        let mut by_id: HashMap<String, Vec<Texture>> = HashMap::new();
        for node in root.descendants().filter(|&n| svg_name(n) == Some("texture")) {
            let offset = node.range().start;
            let (texid, texture) = read_texture(node, offset).map_err(|e| (offset, e))?;
            by_id.entry(texid.to_owned()).or_default().push(texture);
        }
        Ok(Self { by_id })
    }

    /// The texture that `texid` means at byte `offset` of the document.
    pub(crate) fn find(&self, texid: &str, offset: usize) -> Option<&Texture> {
        let all = self.by_id.get(texid)?;
        let before = all.partition_point(|t| t.offset < offset);
        all.get(before.saturating_sub(1))
    }
}

fn read_texture<'a>(node: Node<'a, '_>, offset: usize) -> Result<(&'a str, Texture), ErrorKind> {
    let texid = required(node, "texid")?;
    let filename = required(node, "filename")?.to_owned();
    let wrap = match node.attribute((NAMESPACE, "wrap")).map(str::trim) {
        None | Some("clamp") => ImageWrap::Clamp,
        Some("repeat") => ImageWrap::Repeat,
        Some("mirror") => ImageWrap::Mirror,
        Some(_) => return Err(faulty(node, "`wrap` is not `clamp`, `repeat` or `mirror`")),
    };
    Ok((texid, Texture { filename, wrap, offset, image: Cell::new(None) }))
}

/// Three points: six numbers.
fn corners(node: Node<'_, '_>, attribute: &str) -> Result<[DVec2; 3], ErrorKind> {
    let text = required(node, attribute)?;
    numbers::points::<3, 6>(text)
        .ok_or_else(|| faulty(node, &format!("`{attribute}` is not 6 numbers")))
}

fn required<'a>(node: Node<'a, '_>, attribute: &str) -> Result<&'a str, ErrorKind> {
    node.attribute(attribute).ok_or_else(|| faulty(node, &format!("it has no `{attribute}`")))
}

pub(crate) fn faulty(node: Node<'_, '_>, message: &str) -> ErrorKind {
    ErrorKind::Element { element: node.tag_name().name().to_owned(), message: message.to_owned() }
}

pub(crate) fn unknown_texid(texid: &str) -> ErrorKind {
    ErrorKind::Element {
        element: "textri".into(),
        message: format!("no `texture` has the texid `{}`", crate::images::shorten(texid)),
    }
}
