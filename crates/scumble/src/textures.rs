use crate::plan::Surface;
use crate::render::check_limit;
use crate::{RenderError, Settings};
use scumble_pixel::WorkingSpace;
use scumble_scene::{Command, ImageId, ImageQuad, ImageWrap, Scene, SceneImage, TexturedTriangle};
use scumble_texture::{LevelMode, Levels, Texels, Texture, TextureOptions, Wrap};
use std::convert::Infallible;

/// The textures of a scene, with their pyramids: what [`render`](crate::render) builds before each
/// picture, kept for [`render_with`](crate::render_with).
#[derive(Debug)]
pub struct Textures {
    /// By image index; `None` where no command uses the image.
    pub(crate) surfaces: Vec<Option<Surface>>,
    space: WorkingSpace,
    levels: Levels,
}

impl Textures {
    /// Builds the textures of the images that a scene's commands use. They serve any settings of
    /// the same [`space`](Settings::space) whose [`sampler`](Settings::sampler) reads the same levels
    /// (level zero alone, or all).
    ///
    /// # Errors
    /// [`RenderError::Memory`] beyond the limit of the settings, [`RenderError::Texture`] for an
    /// image that cannot become one.
    pub fn new(scene: &Scene, settings: &Settings) -> Result<Self, RenderError<Infallible>> {
        Self::build(scene, settings)
    }

    /// Bytes of texels.
    #[must_use]
    pub fn memory(&self) -> usize {
        self.surfaces.iter().flatten().map(|surface| surface.texture.memory()).sum()
    }

    pub(crate) fn build<E>(scene: &Scene, settings: &Settings) -> Result<Self, RenderError<E>> {
        let used = used(scene);
        let wanted = || scene.images.iter().zip(&used).map(|(image, used)| used.then_some(image));
        let needed = wanted().flatten().try_fold(0u64, |sum, image| {
            let options = texture_options(image, settings);
            let (width, height) = (image.pixels.width(), image.pixels.height());
            sum.checked_add(Texture::memory_for(width, height, &options)? as u64)
        });
        check_limit(needed.unwrap_or(u64::MAX), settings)?;
        let surfaces: Result<_, _> = wanted()
            .enumerate()
            .map(|(index, image)| {
                let Some(image) = image else { return Ok(None) };
                let texture = Texture::new(image.pixels.view(), &texture_options(image, settings))
                    .map_err(|source| RenderError::Texture { index, source })?;
                let opaque = Texels::straight(image.pixels.view()).is_opaque();
                Ok(Some(Surface { texture, opaque }))
            })
            .collect();
        Ok(Self { surfaces: surfaces?, space: settings.space, levels: levels(settings) })
    }

    /// Whether every image that the scene uses is there, as these settings want it.
    pub(crate) fn serve(&self, scene: &Scene, settings: &Settings) -> bool {
        let made = |(i, image): (usize, &SceneImage)| match self.surfaces.get(i) {
            Some(Some(surface)) => {
                let texture = &surface.texture;
                (texture.width(), texture.height()) == (image.pixels.width(), image.pixels.height())
            }
            _ => false,
        };
        let needed = scene.images.iter().enumerate().zip(used(scene)).filter(|(_, used)| *used);
        self.space == settings.space
            && self.levels == levels(settings)
            && needed.map(|(image, _)| image).all(made)
    }
}

/// Which images commands use.
fn used(scene: &Scene) -> Vec<bool> {
    let mut used = vec![false; scene.images.len()];
    if used.is_empty() {
        return used;
    }
    for command in &scene.commands {
        if let Command::Textured(TexturedTriangle { image: ImageId(i), .. })
        | Command::Image(ImageQuad { image: ImageId(i), .. }) = command
            && let Some(flag) = used.get_mut(*i)
        {
            *flag = true;
        }
    }
    used
}

/// The levels that a sampler reads.
fn levels(settings: &Settings) -> Levels {
    match settings.sampler.level {
        LevelMode::Zero => Levels::BaseOnly,
        _ => Levels::All,
    }
}

fn texture_options(image: &SceneImage, settings: &Settings) -> TextureOptions {
    TextureOptions {
        space: settings.space,
        wrap: match image.wrap {
            ImageWrap::Clamp => Wrap::Clamp,
            ImageWrap::Repeat => Wrap::Repeat,
            ImageWrap::Mirror => Wrap::Mirror,
        },
        levels: levels(settings),
        ..TextureOptions::default()
    }
}
