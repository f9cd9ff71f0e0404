use crate::{Command, SceneImage, View};
use scumble_pixel::Straight;

/// Everything that a renderer needs: images, and the commands that paint with them.
#[derive(Debug, Clone, PartialEq)]
pub struct Scene {
    /// How the scene is placed on a canvas.
    pub view: View,
    /// What lies under everything, unless the run says otherwise; `None` is transparent.
    pub background: Option<Straight>,
    /// The images that commands refer to by index.
    pub images: Vec<SceneImage>,
    /// What to paint, bottom to top.
    pub commands: Vec<Command>,
}
