//! Styles: what of them usvg may see.

use super::css::{self, Verdict};
use super::placeholder::{LocalMap, Placeholders, map_matrix};
use crate::transform;
use crate::warning::Warnings;
use roxmltree::Node;
use scumble_geometry::{Affine, Homography};

/// The SVG spelling of a map, or the placeholder of one that is not affine.
pub(super) fn matrix_text(
    map: Homography,
    offset: usize,
    placeholders: &mut Placeholders,
) -> String {
    match map.to_affine() {
        Some(affine) => affine_text(affine),
        None => placeholder_text(LocalMap { transform: map, quad: None, offset }, placeholders),
    }
}

pub(super) fn affine_text(t: Affine) -> String {
    format!("matrix({} {} {} {} {} {})", t.a, t.b, t.c, t.d, t.e, t.f)
}

/// Keeps a map and gives the matrix that stands for it.
pub(super) fn placeholder_text(map: LocalMap, placeholders: &mut Placeholders) -> String {
    placeholders.maps.push(map);
    map_matrix(placeholders.maps.len() - 1)
}

/// Reads a `transform`, and warns and takes the identity if it is none.
pub(super) fn read_transform(text: &str, offset: usize, warnings: &mut Warnings) -> Homography {
    transform::parse(text).unwrap_or_else(|message| {
        warnings.add(offset, format!("`transform` is ignored: {message}"));
        Homography::IDENTITY
    })
}

/// Whether a property is one that is not drawn yet, with what happens instead. Such properties
/// never reach usvg.
pub(super) fn undrawn(name: &str, value: &str) -> Option<&'static str> {
    let (default, instead) = match name {
        "clip-path" => ("none", "`clip-path` is not applied: all of the element is drawn"),
        "mask" => ("none", "`mask` is not applied: all of the element is drawn"),
        "filter" => ("none", "`filter` is not applied: the element is drawn without"),
        "mix-blend-mode" => ("normal", "`mix-blend-mode` is not applied: normal is taken"),
        "vector-effect" => ("none", "`vector-effect` is not applied: strokes scale"),
        _ => return None,
    };
    Some(if matches!(value, v if v == default || v == "inherit" || v.is_empty()) {
        ""
    } else {
        instead
    })
}

/// Keeps a property, or drops and names it if it is not drawn yet.
fn unless_undrawn(name: &str, value: &str, offset: usize, warnings: &mut Warnings) -> Verdict {
    let Some(instead) = undrawn(name, value) else { return Verdict::Keep };
    if !instead.is_empty() {
        warnings.add(offset, instead);
    }
    Verdict::Drop
}

/// The texts in a `style` element; comments are none.
pub(super) fn texts<'a, 'input: 'a>(
    node: Node<'a, 'input>,
) -> impl Iterator<Item = &'a str> + use<'a, 'input> {
    node.children().filter(Node::is_text).filter_map(|n| n.text())
}

/// The text of a `style` element, with transforms in SVG's spelling and without what is not drawn.
pub(super) fn rewrite_sheet(
    text: &str,
    offset: usize,
    placeholders: &mut Placeholders,
    warnings: &mut Warnings,
) -> String {
    let mut has_origin = false;
    let maps_before = placeholders.maps.len();
    let out = css::rewrite(text, false, |name, value| match name {
        "transform" => {
            let map = read_transform(value, offset, warnings);
            Verdict::Replace(matrix_text(map, offset, placeholders))
        }
        "transform-origin" => {
            has_origin = true;
            Verdict::Keep
        }
        // Without `!important`, so that it yields inside markers.
        "marker" | "marker-start" | "marker-mid" | "marker-end" => Verdict::Weaken,
        _ => unless_undrawn(name, value, offset, warnings),
    });
    if has_origin && placeholders.maps.len() > maps_before {
        let message = "`transform-origin` in a style sheet does not reach perspective transforms";
        warnings.add(offset, message);
    }
    out
}

/// What of an inline `style` matters here.
#[derive(Debug, Default)]
pub(super) struct InlineStyle {
    /// The declarations that usvg may see.
    pub(super) css: String,
    pub(super) transform: Option<String>,
    pub(super) origin: Option<String>,
}

/// Takes a `style` attribute apart.
pub(super) fn split_inline(
    style: &str,
    offset: usize,
    in_marker: bool,
    warnings: &mut Warnings,
) -> InlineStyle {
    let (mut transform, mut origin) = (None, None);
    let css = css::rewrite(style, true, |name, value| match name {
        "transform" => {
            transform = Some(value.to_owned());
            Verdict::Drop
        }
        "transform-origin" => {
            origin = Some(value.to_owned());
            Verdict::Drop
        }
        name if in_marker && name.starts_with("marker") => Verdict::Drop,
        _ => unless_undrawn(name, value, offset, warnings),
    });
    InlineStyle { css, transform, origin }
}
