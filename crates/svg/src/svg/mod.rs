//! SVG through usvg.
//!
//! usvg resolves styles, units, `use`, viewports and shapes, but it drops what it does not know.
//! So a first pass rewrites the document ([`rewrite`]): whatever usvg cannot carry becomes a
//! placeholder that it can, a path or a matrix with an index in its numbers, which survives even
//! `use`, where identifiers do not. A second pass ([`walk`]) goes over usvg's tree and puts back
//! what the placeholders stand for.

mod css;
mod expand;
mod layer;
mod origin;
mod paint;
mod placeholder;
mod quad;
mod rewrite;
mod selectors;
mod sheet;
mod walk;

use crate::Limits;
use crate::error::{ErrorKind, Fault};
use crate::images::Images;
use crate::warning::Warnings;
use roxmltree::Node;
use scumble_geometry::DVec2;
use scumble_scene::{Scene, View};
use std::sync::Arc;

/// Reads a checked document.
pub(crate) fn read(
    root: Node<'_, '_>,
    limits: &Limits,
    mut images: Images<'_>,
    warnings: &mut Warnings,
) -> Result<Scene, Fault> {
    expand::check(root, limits)?;
    let rewritten = rewrite::rewrite(root, &mut images, warnings)?;
    let sizes = rewritten.placeholders.images.iter().map(|&id| images.size(id)).collect();
    let tree = usvg::Tree::from_str(&rewritten.xml, &usvg_options(sizes))
        .map_err(|e| usvg_error(root, &e))?;
    let commands = walk::walk(&tree, &rewritten, &mut images, warnings)?;
    let size = if rewritten.has_size {
        DVec2::new(f64::from(tree.size().width()), f64::from(tree.size().height()))
    } else {
        let message = "the root has no size: the scene ends where the drawing does";
        warnings.add(root.range().start, message);
        paint::extent(&commands)
            .ok_or_else(|| size_error(root, "it gives none, and nothing is drawn"))?
    };
    Ok(Scene { view: View::Fit { size }, background: None, images: images.into_vec(), commands })
}

/// Options that keep usvg away from files, and answer for our images with a header alone.
fn usvg_options(sizes: Vec<(usize, usize)>) -> usvg::Options<'static> {
    usvg::Options {
        image_href_resolver: usvg::ImageHrefResolver {
            resolve_data: Box::new(|_, _, _| None),
            resolve_string: Box::new(move |href, _| {
                let index = placeholder::image_index(href)?;
                let header = placeholder::image_header(index, *sizes.get(index)?);
                Some(usvg::ImageKind::PNG(Arc::new(header)))
            }),
        },
        ..usvg::Options::default()
    }
}

fn size_error(root: Node<'_, '_>, message: &str) -> Fault {
    Fault::at(root.range().start, ErrorKind::Size(message.into()))
}

fn usvg_error(root: Node<'_, '_>, error: &usvg::Error) -> Fault {
    match error {
        usvg::Error::InvalidSize => {
            size_error(root, "`width`, `height` or `viewBox` is not positive")
        }
        usvg::Error::ElementsLimitReached
        | usvg::Error::ParsingFailed(roxmltree::Error::NodesLimitReached) => {
            Fault::from(ErrorKind::Limit("the document has too many elements for SVG".into()))
        }
        _ => Fault::from(ErrorKind::Xml(error.to_string())),
    }
}
