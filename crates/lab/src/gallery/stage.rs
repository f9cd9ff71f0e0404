//! Scenes of the assets, rendered.

use super::{Drawn, GalleryError};
use crate::Asset;
use scumble::scene::Scene;
use scumble_svg::{Options, ResourceError, Resources};
use std::sync::OnceLock;

/// The assets, drawn once.
fn assets() -> Result<&'static [Asset], GalleryError> {
    static ASSETS: OnceLock<Vec<Asset>> = OnceLock::new();
    if let Some(drawn) = ASSETS.get() {
        return Ok(drawn);
    }
    let drawn = crate::assets()?;
    Ok(ASSETS.get_or_init(|| drawn))
}

fn bytes(path: &str) -> Result<&'static [u8], GalleryError> {
    let found = assets()?.iter().find(|asset| asset.path == path);
    found.map(|asset| asset.bytes.as_slice()).ok_or_else(|| GalleryError::Missing(path.to_owned()))
}

/// What lies beside the scenes.
struct Beside;

impl Resources for Beside {
    fn load(&self, href: &str) -> Result<Vec<u8>, ResourceError> {
        bytes(&format!("scenes/{href}")).map(<[u8]>::to_vec).map_err(|_| ResourceError::NotFound)
    }
}

/// A scene of the assets by its name.
pub(super) fn scene(name: &str) -> Result<Scene, GalleryError> {
    let text = bytes(&format!("scenes/{name}.svg"))?;
    Ok(scumble_svg::parse(text, &Options::default().with_resources(&Beside))?.scene)
}

/// A part of a scene on a canvas, by settings that are changed from the default.
pub(super) fn shot(
    scene: &Scene,
    [width, height]: [u32; 2],
    crop: [i32; 4],
    change: impl FnOnce(&mut scumble::Settings) -> Result<(), GalleryError>,
) -> Drawn {
    let mut settings = scumble::Settings::new(width, height);
    let [x, y, w, h] = crop;
    settings.crop = Some(scumble::coverage::IntRect::new(x, y, x + w, y + h));
    change(&mut settings)?;
    Ok(scumble::render_image(scene, &settings)?)
}
