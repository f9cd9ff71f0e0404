//! What usvg cannot carry, and the things that it can which stand for it meanwhile.

use crate::extension::{ColorTriangle, TexturedTriangle};
use scumble_geometry::{Affine, DVec2, Homography, Rect};
use scumble_scene::ImageId;
use usvg::Transform;
use usvg::tiny_skia_path::PathSegment;

/// The things that placeholders of a document stand for.
#[derive(Debug, Default)]
pub(super) struct Placeholders {
    pub(super) leaves: Vec<Leaf>,
    pub(super) maps: Vec<LocalMap>,
    pub(super) images: Vec<ImageId>,
}

/// An element without children.
#[derive(Debug)]
pub(super) struct Leaf {
    pub(super) kind: LeafKind,
    /// Where it stands in the document, in bytes.
    pub(super) offset: usize,
}

#[derive(Debug)]
pub(super) enum LeafKind {
    Textured(TexturedTriangle),
    Color(ColorTriangle),
    /// An element that is only named, in these words, where it would be drawn.
    NotDrawn(&'static str),
}

impl LeafKind {
    /// The corners of what is drawn, in the element's own units.
    pub(super) fn points(&self) -> Option<&[DVec2; 3]> {
        match self {
            Self::Textured(t) => Some(&t.points),
            Self::Color(t) => Some(&t.points),
            Self::NotDrawn(_) => None,
        }
    }
}

/// The map of an element that no affine transform can express.
#[derive(Debug)]
pub(super) struct LocalMap {
    /// `transform`, with its origin.
    pub(super) transform: Homography,
    /// `sc:quad`, inside the transform.
    pub(super) quad: Option<Quad>,
    /// Where the element stands in the document, in bytes.
    pub(super) offset: usize,
}

/// `sc:quad`: the corners that a box goes to.
#[derive(Debug)]
pub(super) struct Quad {
    pub(super) to: [DVec2; 4],
    /// `sc:box`; `None` is the element's own bounding box.
    pub(super) from: Option<Rect>,
}

/// The corners of a leaf's path; the index takes the place of the middle one's x.
const SIGNATURE: [[f32; 2]; 3] = [[-811.25, 409.5], [0.0, -203.75], [102.125, 50.0625]];

/// The `d` of the path that stands for leaf `index`. Indices up to 2²⁴ survive single precision.
pub(super) fn leaf_path(index: usize) -> String {
    let [[x0, y0], [_, y1], [x2, y2]] = SIGNATURE;
    format!("M{x0} {y0}L{index} {y1}L{x2} {y2}Z")
}

/// The index in a path made by [`leaf_path`].
pub(super) fn leaf_index(path: &usvg::tiny_skia_path::Path) -> Option<usize> {
    if path.len() != 4 {
        return None;
    }
    let mut segments = path.segments();
    let mut at = |i: usize| match segments.next()? {
        PathSegment::MoveTo(p) | PathSegment::LineTo(p) => {
            let [x, y] = SIGNATURE[i];
            (p.y == y && (i == 1 || p.x == x)).then_some(p.x)
        }
        _ => None,
    };
    at(0)?;
    let x = at(1)?;
    at(2)?;
    (x >= 0.0 && x.fract() == 0.0).then_some(x as usize)
}

/// One step of single precision above 1, doubled.
const STEP: f64 = 1.0 / 4_194_304.0;

/// What marks a matrix as a placeholder: its second scale.
const MARK: f64 = 1.0 + 341.0 / 8_388_608.0;

/// The transform that stands for map `index`: a scale so near 1 that any number of them inside one
/// another stay in range, exact in single precision up to 2²² indices.
pub(super) fn map_matrix(index: usize) -> String {
    format!("matrix({} 0 0 {MARK} 0 0)", 1.0 + (index + 1) as f64 * STEP)
}

/// The index in a matrix made by [`map_matrix`], and the translation that usvg has multiplied
/// from the right (the `x` and `y` of a `use`).
pub(super) fn map_index(t: Transform) -> Option<(usize, Affine)> {
    if t.kx != 0.0 || t.ky != 0.0 || f64::from(t.sy) != MARK {
        return None;
    }
    let index = (f64::from(t.sx) - 1.0) / STEP - 1.0;
    if !(index >= 0.0 && index.fract() == 0.0) {
        return None;
    }
    let (x, y) = (f64::from(t.tx / t.sx), f64::from(t.ty / t.sy));
    Some((index as usize, Affine::translate(x, y)))
}

const IMAGE_SCHEME: &str = "scumble-image:";

/// The `href` that stands for image `index`.
pub(super) fn image_href(index: usize) -> String {
    format!("{IMAGE_SCHEME}{index}")
}

/// The index in an `href` made by [`image_href`].
pub(super) fn image_index(href: &str) -> Option<usize> {
    href.strip_prefix(IMAGE_SCHEME)?.parse().ok()
}

/// Bytes that usvg takes for a PNG of this size, with the index behind.
pub(super) fn image_header(index: usize, (width, height): (usize, usize)) -> Vec<u8> {
    let mut bytes = b"\x89PNG\r\n\x1a\n\0\0\0\rIHDR".to_vec();
    bytes.extend((width as u32).to_be_bytes());
    bytes.extend((height as u32).to_be_bytes());
    bytes.extend((index as u64).to_be_bytes());
    bytes
}

/// The index in bytes made by [`image_header`].
pub(super) fn header_index(bytes: &[u8]) -> Option<usize> {
    let index = u64::from_be_bytes(bytes.get(24..32)?.try_into().ok()?);
    usize::try_from(index).ok()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn maps_survive_single_precision() {
        for index in [0, 1, 2, 3, 1000, 999_999, 4_000_000] {
            let text = map_matrix(index);
            let t: svgtypes::Transform = text.parse().unwrap();
            let t = Transform::from_row(t.a as f32, 0.0, 0.0, t.d as f32, 0.0, 0.0);
            assert_eq!(map_index(t), Some((index, Affine::IDENTITY)));
            let (_, offset) = map_index(t.pre_translate(10.0, 20.0)).unwrap();
            assert!((offset.e - 10.0).abs() < 1e-5 && (offset.f - 20.0).abs() < 1e-5);
        }
        assert_eq!(map_index(Transform::default()), None);
        assert_eq!(map_index(Transform::from_scale(2.0, 2.0)), None);
    }

    #[test]
    fn headers_are_what_usvg_reads_sizes_from() {
        let header = image_header(7, (300, 20));
        assert_eq!(header_index(&header), Some(7));
        assert_eq!(header_index(&header[..20]), None);
        assert_eq!(image_index(&image_href(12)), Some(12));
        assert_eq!(image_index("a.png"), None);
    }
}
