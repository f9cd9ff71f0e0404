//! `sc:quad` and `sc:box`: a box laid onto four points.

use super::placeholder::Quad;
use crate::error::ErrorKind;
use crate::extension::{NAMESPACE, faulty};
use crate::numbers;
use roxmltree::Node;
use scumble_geometry::{DVec2, Homography, Rect};

/// The `sc:quad` of an element, if it has one.
pub(super) fn read(node: Node<'_, '_>, name: &str) -> Result<Option<Quad>, ErrorKind> {
    let Some(text) = node.attribute((NAMESPACE, "quad")) else { return Ok(None) };
    let to = numbers::points::<4, 8>(text)
        .ok_or_else(|| faulty(node, "`sc:quad` is not four points"))?;
    let from = match node.attribute((NAMESPACE, "box")) {
        Some(text) => {
            let [x, y, width, height] = numbers::exactly(text)
                .ok_or_else(|| faulty(node, "`sc:box` is not four numbers"))?;
            Some(Rect::from_size(x, y, width, height))
        }
        // What holds others has no box of its own: the viewport is its sheet of paper.
        None if matches!(name, "g" | "a" | "switch" | "svg") => Some(
            viewport(node)
                .ok_or_else(|| faulty(node, "there is no `viewBox`: give an `sc:box`"))?,
        ),
        None => None,
    };
    if from.is_some_and(|rect| rect.is_empty()) {
        return Err(faulty(node, "`sc:box` has no area"));
    }
    Ok(Some(Quad { to, from }))
}

/// The map that a quad makes of a box.
pub(super) fn homography(from: Rect, to: [DVec2; 4]) -> Result<Homography, ErrorKind> {
    Homography::from_points(from.corners(), to)
        .map_err(|e| ErrorKind::Element { element: "sc:quad".into(), message: e.to_string() })
}

/// The viewport that an element is in: the `viewBox` of the nearest `svg` or `symbol` around it,
/// or else its `width` and `height`.
pub(super) fn viewport(node: Node<'_, '_>) -> Option<Rect> {
    let holder = node
        .ancestors()
        .skip(1)
        .chain([node])
        .find(|n| matches!(crate::extension::svg_name(*n), Some("svg" | "symbol")))?;
    if let Some([x, y, width, height]) = holder.attribute("viewBox").and_then(numbers::exactly::<4>)
    {
        return Some(Rect::from_size(x, y, width, height)).filter(|r| !r.is_empty());
    }
    let side = |name| {
        let text = holder.attribute(name)?;
        numbers::leading(text).filter(|_| !text.contains('%'))
    };
    Some(Rect::from_size(0.0, 0.0, side("width")?, side("height")?)).filter(|r| !r.is_empty())
}
