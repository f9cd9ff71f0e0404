use crate::Case;
use image::RgbaImage;
use scumble::render_image;
use scumble_svg::{Options, Parsed, ResourceError, Resources, parse};
use std::path::{Component, Path, PathBuf};

/// `assets/scenes`.
#[must_use]
pub fn scenes_folder() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../assets/scenes")
}

/// The file names of all scenes, sorted.
///
/// # Errors
/// If the folder cannot be read.
pub fn scene_names() -> Result<Vec<String>, String> {
    let folder = scenes_folder();
    let at = |e: std::io::Error| format!("{}: {e}", folder.display());
    let mut names = Vec::new();
    for entry in std::fs::read_dir(&folder).map_err(at)? {
        let name = entry.map_err(at)?.file_name().to_string_lossy().into_owned();
        if name.ends_with(".svg") {
            names.push(name);
        }
    }
    names.sort();
    Ok(names)
}

/// The files beside the scenes and below, and no others.
struct Beside(PathBuf);

impl Resources for Beside {
    fn load(&self, href: &str) -> Result<Vec<u8>, ResourceError> {
        let path = Path::new(href);
        if !path.components().all(|part| matches!(part, Component::Normal(_))) {
            return Err(ResourceError::Refused("it leaves the scene's folder".into()));
        }
        std::fs::read(self.0.join(path)).map_err(|_| ResourceError::NotFound)
    }
}

/// Reads the scene of a case.
///
/// # Errors
/// If it cannot be read.
pub fn load(case: &Case) -> Result<Parsed, String> {
    let folder = scenes_folder();
    let path = folder.join(&case.scene);
    let text = std::fs::read(&path).map_err(|e| format!("{}: {e}", path.display()))?;
    let beside = Beside(folder);
    let options = Options::default().with_profile(case.profile).with_resources(&beside);
    parse(&text, &options).map_err(|e| format!("{}: {e}", case.scene))
}

/// Renders a case into a picture.
///
/// # Errors
/// If the scene cannot be read or rendered, or gives other than the expected number of warnings.
pub fn picture(case: &Case) -> Result<RgbaImage, String> {
    let parsed = load(case)?;
    if parsed.warnings.len() != case.warnings {
        let list: Vec<String> = parsed.warnings.iter().map(ToString::to_string).collect();
        return Err(format!("{} warnings expected, given: {list:#?}", case.warnings));
    }
    let settings = case.settings(parsed.profile)?;
    let image = render_image(&parsed.scene, &settings).map_err(|e| e.to_string())?;
    let (width, height) = (image.width() as u32, image.height() as u32);
    let bytes = image.into_vec().into_flattened();
    RgbaImage::from_raw(width, height, bytes).ok_or_else(|| "an image of another size".to_owned())
}

/// One of the textures beside the scenes, decoded.
///
/// # Errors
/// If there is none of that name.
pub fn texture(name: &str) -> Result<RgbaImage, String> {
    let path = scenes_folder().join("textures").join(format!("{name}.png"));
    Ok(image::open(&path).map_err(|e| format!("{}: {e}", path.display()))?.to_rgba8())
}
