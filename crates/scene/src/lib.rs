//! The display list: what a reader hands to the renderer. Plain data, everything resolved.
//!
//! # What a reader guarantees
//!
//! - Commands stand in painting order; later ones lie on top. There is no depth.
//! - Every [`ImageId`] is the index of an image of the scene, and no image is empty.
//! - Every [`Command::PushLayer`] has its [`Command::PopLayer`], properly nested.
//! - Transforms take the command's own coordinates to *scene units*; [`View::transform`] takes
//!   scene units to pixels. Both are finite.
//! - Colours are sRGB-encoded with straight alpha, each component in 0…1.
//!
//! A renderer survives a scene that breaks these, but what it draws is not defined.

mod command;
mod image;
mod scene;
mod view;

pub use command::{
    Command, Fill, GouraudTriangle, Hairline, ImageQuad, Point, Stroke, TexturedTriangle,
};
pub use image::{ImageId, ImageWrap, SceneImage};
pub use scene::Scene;
pub use view::View;
