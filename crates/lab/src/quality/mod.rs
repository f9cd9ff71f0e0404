//! How good the filters are: tables against brute force, a plot and pictures, as a page.

mod figures;
mod methods;
mod page;
mod plot;
mod sources;
mod speed;
mod study;
pub(crate) mod warps;

use crate::Asset;
use scumble::texture::TextureError;
use scumble_geometry::GeometryError;

pub use page::{Report, measure};
pub(crate) use sources::{SIZE, SOURCES, Source};
pub use speed::times;

/// Why the filters could not be judged.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum QualityError {
    /// An image would not become a texture.
    #[error("a texture: {0}")]
    Texture(#[from] TextureError),
    /// A map could not be made of its points.
    #[error("a map: {0}")]
    Map(#[from] GeometryError),
    /// A view could not be set up.
    #[error("a view: {0}")]
    View(#[from] crate::views::ViewError),
    /// A picture could not be encoded.
    #[error("cannot encode a picture: {0}")]
    Encode(#[from] image::ImageError),
}

/// One place in every square of so many pixels a side: some two thousand on each map.
pub const FULL: usize = 16;

/// The page and everything that it shows, relative to the documentation's folder.
///
/// # Errors
/// [`QualityError::Encode`] if a picture cannot be encoded.
pub fn files(report: &Report) -> Result<Vec<Asset>, QualityError> {
    let mut files = Vec::new();
    let page = report.page().into_bytes();
    files.push(Asset { path: "quality.md".to_owned(), bytes: page });
    files.push(Asset { path: "quality/pareto.svg".to_owned(), bytes: report.plot().into_bytes() });
    for (figure, canvas) in figures::draw()? {
        let path = format!("quality/{}.png", figure.name);
        files.push(Asset { path, bytes: canvas.to_png()? });
    }
    Ok(files)
}
