//! Draws everything under `assets/`: the textures and the scenes, from nothing but code.
//!
//! # Conventions
//!
//! - Every byte is a function of this source: integer hashes for noise, and of floating point only
//!   + − × ÷ √ and floor, so that the files are the same on every machine.
//! - Textures are sRGB-encoded PNGs under `scenes/textures`, beside the scenes that use them: a
//!   scene may read only what lies in its own folder or below.
//! - Scenes are written to be read: one element or rule each, with a comment that says which.
//!
//! # Example
//!
//! ```
//! let files = lab::assets()?;
//! assert!(files.iter().any(|f| f.path == "scenes/ground.svg"));
//! # Ok::<(), lab::LabError>(())
//! ```

mod canvas;
pub mod driver;
pub mod exchange;
pub mod gallery;
pub mod map;
mod math;
pub mod peers;
pub mod quality;
mod scenes;
mod svg;
mod textures;
pub mod timing;
mod views;
pub mod workloads;

pub use views::ViewError;

use std::path::{Path, PathBuf};

/// A file of the assets folder.
pub struct Asset {
    /// Where it stands, relative to the assets folder, with forward slashes.
    pub path: String,
    /// Its content.
    pub bytes: Vec<u8>,
}

/// Why the assets could not be drawn, written or checked.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum LabError {
    /// A picture could not be encoded.
    #[error("cannot encode a picture: {0}")]
    Encode(#[from] image::ImageError),
    /// A file or folder could not be read or written.
    #[error("{}: {source}", path.display())]
    Io {
        /// Which.
        path: PathBuf,
        /// Why.
        source: std::io::Error,
    },
    /// Files that are missing, stale or not ours.
    #[error("the files differ from what the code draws:\n  {}", .0.join("\n  "))]
    Different(Vec<String>),
}

fn io(path: &Path, source: std::io::Error) -> LabError {
    LabError::Io { path: path.to_owned(), source }
}

/// Draws every asset, in the order of their paths.
///
/// # Errors
/// [`LabError::Encode`] if a picture cannot be encoded.
pub fn assets() -> Result<Vec<Asset>, LabError> {
    let mut files = Vec::new();
    for (name, canvas) in textures::all() {
        let bytes = canvas.to_png()?;
        files.push(Asset { path: format!("scenes/textures/{name}.png"), bytes });
    }
    let emblem = textures::emblem().to_png()?;
    for (name, text) in scenes::all(&emblem) {
        files.push(Asset { path: format!("scenes/{name}.svg"), bytes: text.into_bytes() });
    }
    files.sort_by(|a, b| a.path.cmp(&b.path));
    Ok(files)
}

/// Writes every asset below `folder`.
///
/// # Errors
/// [`LabError::Io`] with the path that could not be written.
pub fn write(folder: &Path, files: &[Asset]) -> Result<(), LabError> {
    for file in files {
        let path = folder.join(&file.path);
        if let Some(parent) = path.parent() {
            std::fs::create_dir_all(parent).map_err(|e| io(parent, e))?;
        }
        std::fs::write(&path, &file.bytes).map_err(|e| io(&path, e))?;
    }
    Ok(())
}

/// Compares some files below `folder` with what the code draws; what else stands there is no matter.
///
/// # Errors
/// [`LabError::Different`] names every missing and stale file.
pub fn check_files(folder: &Path, files: &[Asset]) -> Result<(), LabError> {
    let wrong = stale(folder, files);
    if wrong.is_empty() { Ok(()) } else { Err(LabError::Different(wrong)) }
}

/// A line for every file that is missing or has another content.
fn stale(folder: &Path, files: &[Asset]) -> Vec<String> {
    let differs = |file: &Asset| match std::fs::read(folder.join(&file.path)) {
        Ok(found) if found == file.bytes => None,
        Ok(_) => Some(format!("{}: stale", file.path)),
        Err(_) => Some(format!("{}: missing", file.path)),
    };
    files.iter().filter_map(differs).collect()
}

/// Compares what stands below `folder` with what the code draws, byte for byte, both ways: a file
/// that nothing draws is a difference too.
///
/// # Errors
/// [`LabError::Different`] names every missing, stale and foreign file.
pub fn check(folder: &Path, files: &[Asset]) -> Result<(), LabError> {
    let mut wrong = stale(folder, files);
    for found in list(folder)? {
        if !files.iter().any(|f| f.path == found) {
            wrong.push(format!("{found}: nothing draws it"));
        }
    }
    if wrong.is_empty() { Ok(()) } else { Err(LabError::Different(wrong)) }
}

/// Every file below `folder`, relative to it, with forward slashes, sorted.
fn list(folder: &Path) -> Result<Vec<String>, LabError> {
    let mut found = Vec::new();
    let mut open = vec![PathBuf::new()];
    while let Some(relative) = open.pop() {
        let here = folder.join(&relative);
        let at = |e| io(&here, e);
        for entry in std::fs::read_dir(&here).map_err(at)? {
            let entry = entry.map_err(at)?;
            let path = relative.join(entry.file_name());
            if entry.file_type().map_err(at)?.is_dir() {
                open.push(path);
            } else {
                let parts: Vec<_> = path.iter().map(|p| p.to_string_lossy().into_owned()).collect();
                found.push(parts.join("/"));
            }
        }
    }
    found.sort();
    Ok(found)
}
