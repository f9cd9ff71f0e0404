//! Frames of the driver, measured as those of other rasterizers are.

use crate::timing::{self, Times};
use scumble::scene::{ImageWrap, Scene, SceneImage};
use scumble::texture::{LevelMode, Levels, Texture, TextureError, TextureOptions, Wrap};
use scumble::{Control, ImageSink, RenderError, Settings, render};
use std::convert::Infallible;
use std::hint::black_box;

/// What frames took.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FrameTimes {
    /// All of a frame but its textures: set-up, bins, tiles, and the rows' way into an image.
    pub drawing: Times,
    /// The textures alone, on one thread.
    pub textures: Times,
}

/// Renders a scene up to `frames` times into a sink that is kept from frame to frame.
///
/// Every primitive is set up anew in each frame. The driver builds the textures anew as well, which
/// others do once, before the clock: so each frame is followed by a building of the textures alone,
/// and what that takes is taken off.
///
/// # Errors
/// Those of the driver.
pub fn measure(
    scene: &Scene,
    settings: &Settings,
    frames: usize,
    sink: &mut ImageSink,
) -> Result<FrameTimes, RenderError<Infallible>> {
    let [drawing, textures] = timing::frames(frames, || {
        let frame = timing::clock(|| render(scene, settings, sink, &Control::default()))?;
        let textures = timing::clock(|| textures(&scene.images, settings))?;
        Ok([frame - textures, textures])
    })?;
    Ok(FrameTimes { drawing, textures })
}

/// Builds the textures as the driver does.
fn textures(images: &[SceneImage], settings: &Settings) -> Result<(), RenderError<Infallible>> {
    for (index, image) in images.iter().enumerate() {
        let texture =
            texture(image, settings).map_err(|source| RenderError::Texture { index, source })?;
        black_box(texture);
    }
    Ok(())
}

fn texture(image: &SceneImage, settings: &Settings) -> Result<Texture, TextureError> {
    let options = TextureOptions {
        space: settings.space,
        wrap: match image.wrap {
            ImageWrap::Clamp => Wrap::Clamp,
            ImageWrap::Repeat => Wrap::Repeat,
            ImageWrap::Mirror => Wrap::Mirror,
        },
        levels: match settings.sampler.level {
            LevelMode::Zero => Levels::BaseOnly,
            _ => Levels::All,
        },
        ..TextureOptions::default()
    };
    Texture::new(image.pixels.view(), &options)
}
