//! The gallery: what the literature draws, drawn by us.
//!
//! One page for each document, each picture with what is to be seen on it. Everything is a function of
//! this source: the same bytes on every run.

mod anisotropic;
mod ellipses;
mod enhanced_ewa;
#[cfg(test)]
mod errata;
mod ewa;
mod ink;
mod lecture;
mod page;
mod plot;
mod rasterizer;
mod stage;

use crate::Asset;
use scumble_pixel::Image;
use std::sync::atomic::{AtomicUsize, Ordering};

/// Why the gallery could not be drawn.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum GalleryError {
    /// A picture could not be rendered.
    #[error("a picture: {0}")]
    Render(#[from] scumble::RenderError<std::convert::Infallible>),
    /// An image has no such size.
    #[error("an image: {0}")]
    Image(#[from] scumble_pixel::ImageError),
    /// A triangle or a pattern could not be made.
    #[error("a shape: {0}")]
    Coverage(#[from] scumble::coverage::CoverageError),
    /// A filter could not be made.
    #[error("a filter: {0}")]
    Signal(#[from] scumble_signal::SignalError),
    /// The assets could not be drawn.
    #[error("the assets: {0}")]
    Assets(#[from] crate::LabError),
    /// There is no such asset or picture.
    #[error("there is no {0}")]
    Missing(String),
    /// A scene could not be read.
    #[error("a scene: {0}")]
    Scene(#[from] scumble_svg::SvgError),
    /// A texture could not be made.
    #[error("a texture: {0}")]
    Texture(#[from] scumble::texture::TextureError),
    /// A view could not be set up.
    #[error("a view: {0}")]
    View(#[from] crate::views::ViewError),
    /// A picture could not be encoded.
    #[error("cannot encode a picture: {0}")]
    Encode(#[from] png::EncodingError),
}

/// A finished picture.
type Picture = Image<[u8; 4]>;

/// What a picture becomes, or why it does not.
type Drawn = Result<Picture, GalleryError>;

/// One picture with its words.
struct Figure {
    /// The file's name without its ending.
    name: &'static str,
    title: &'static str,
    /// What to look at, in Markdown.
    look: &'static str,
    draw: fn() -> Drawn,
}

/// A page about one document.
struct Page {
    /// The file's name without its ending, and the folder of its pictures.
    name: &'static str,
    title: &'static str,
    /// What stands before the pictures, in Markdown.
    intro: &'static str,
    figures: &'static [Figure],
}

const PAGES: [&Page; 5] =
    [&lecture::PAGE, &rasterizer::PAGE, &ewa::PAGE, &anisotropic::PAGE, &enhanced_ewa::PAGE];

/// Every page and picture, relative to the gallery's folder.
///
/// # Errors
/// [`GalleryError`], if a picture cannot be drawn or encoded.
pub fn files() -> Result<Vec<Asset>, GalleryError> {
    let mut files = vec![page::index(&PAGES)];
    files.extend(PAGES.iter().map(|page| page::page(page)));
    files.extend(pictures("")?);
    Ok(files)
}

/// The pictures whose path, as in `lecture/moire.png`, begins with something: of one page, or one alone.
///
/// # Errors
/// As [`files`]; [`GalleryError::Missing`], if there is none.
pub fn pictures(begin: &str) -> Result<Vec<Asset>, GalleryError> {
    let all = PAGES.iter().flat_map(|page| {
        page.figures.iter().map(|figure| (format!("{}/{}.png", page.name, figure.name), figure))
    });
    let chosen: Vec<(String, &Figure)> = all.filter(|(path, _)| path.starts_with(begin)).collect();
    if chosen.is_empty() {
        return Err(GalleryError::Missing(begin.to_owned()));
    }
    draw(&chosen).into_iter().collect()
}

/// The files of figures, sorted, each drawn by the next thread that is free.
fn draw(figures: &[(String, &Figure)]) -> Vec<Result<Asset, GalleryError>> {
    let next = AtomicUsize::new(0);
    let work = || {
        let mut mine = Vec::new();
        while let Some((path, figure)) = figures.get(next.fetch_add(1, Ordering::Relaxed)) {
            let bytes = (figure.draw)().and_then(|picture| ink::encode(&picture));
            mine.push((path, bytes));
        }
        mine
    };
    let threads = std::thread::available_parallelism().map_or(1, usize::from);
    let mut all = std::thread::scope(|scope| {
        let others: Vec<_> = (1..threads).map(|_| scope.spawn(work)).collect();
        let mut all = work();
        for thread in others {
            match thread.join() {
                Ok(more) => all.extend(more),
                Err(panic) => std::panic::resume_unwind(panic),
            }
        }
        all
    });
    all.sort_by_key(|(path, _)| *path);
    all.into_iter().map(|(path, bytes)| Ok(Asset { path: path.clone(), bytes: bytes? })).collect()
}
