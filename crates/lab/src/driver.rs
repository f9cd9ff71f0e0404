//! Frames of the driver, measured as those of other rasterizers are.

use crate::timing::{self, Times};
use scumble::scene::{Command, ImageId, ImageQuad, Scene, View};
use scumble::{Control, ImageSink, RenderError, Settings, render};
use scumble_geometry::{DVec2, Homography, Rect};
use std::convert::Infallible;

/// What frames took.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FrameTimes {
    /// All of a frame but its textures: set-up, bins, tiles, and the rows' way into an image.
    pub drawing: Times,
    /// The textures alone; zeros for a scene without images.
    pub textures: Times,
}

/// Renders a scene up to `frames` times into a sink that is kept from frame to frame.
///
/// Every primitive is set up anew in each frame. The driver builds the textures anew as well, which
/// others do once, before the clock: so each frame is followed by one that draws nothing with them,
/// and what that takes is taken off (with several threads, some 0.1 ms for their start with it).
///
/// # Errors
/// Those of the driver.
pub fn measure(
    scene: &Scene,
    settings: &Settings,
    frames: usize,
    sink: &mut ImageSink,
) -> Result<FrameTimes, RenderError<Infallible>> {
    let (bare, mut nowhere) = (textures_only(scene), ImageSink::new());
    let small = Settings { width: 1, height: 1, crop: None, ..settings.clone() };
    let [drawing, textures] = timing::frames(frames, || {
        let frame = timing::clock(|| render(scene, settings, sink, &Control::default()))?;
        let textures = if bare.images.is_empty() {
            0.0
        } else {
            timing::clock(|| render(&bare, &small, &mut nowhere, &Control::default()))?
        };
        Ok([frame - textures, textures])
    })?;
    Ok(FrameTimes { drawing, textures })
}

/// A scene of one unit that has the images of another, and draws them where nobody sees it.
fn textures_only(scene: &Scene) -> Scene {
    let aside = |image| {
        Command::Image(ImageQuad {
            image: ImageId(image),
            rect: Rect::new(2.0, 2.0, 3.0, 3.0),
            source: Rect::new(0.0, 0.0, 1.0, 1.0),
            pixelated: false,
            opacity: 1.0,
            transform: Homography::IDENTITY,
        })
    };
    Scene {
        view: View::Fit { size: DVec2::ONE },
        background: None,
        images: scene.images.clone(),
        commands: (0..scene.images.len()).map(aside).collect(),
    }
}
