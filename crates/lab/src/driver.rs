//! Frames of the driver, measured as those of other rasterizers are.

use crate::timing::{self, Times};
use scumble::scene::Scene;
use scumble::{Control, ImageSink, RenderError, Settings, Textures, render_with};
use std::convert::Infallible;

/// What frames took.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FrameTimes {
    /// All of a frame but its textures: set-up, bins, tiles, and the rows' way into an image.
    pub drawing: Times,
    /// The textures, built once before the frames: in milliseconds.
    pub textures: f64,
}

/// Renders a scene up to `frames` times into a sink that is kept from frame to frame, as are its
/// textures. Every primitive is set up anew in each frame.
///
/// # Errors
/// Those of the driver.
pub fn measure(
    scene: &Scene,
    settings: &Settings,
    frames: usize,
    sink: &mut ImageSink,
) -> Result<FrameTimes, RenderError<Infallible>> {
    let mut textures = None;
    let building = timing::clock(|| {
        textures = Some(Textures::new(scene, settings)?);
        Ok(())
    })?;
    let Some(textures) = textures else { return Err(RenderError::Textures) };
    let [drawing] = timing::frames(frames, || {
        let draw = || render_with(scene, &textures, settings, sink, &Control::default());
        Ok([timing::clock(draw)?])
    })?;
    Ok(FrameTimes { drawing, textures: building })
}
