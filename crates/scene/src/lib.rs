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
//!
//! # Conventions
//!
//! - y points down; (0, 0) is the top left corner of the scene, and of the canvas.
//! - Each command carries its own transform, projective like all of them; there is no state but the
//!   open layers.
//! - Positions in images run from (0, 0), the top left corner, to (1, 1), the bottom right one, edge to
//!   edge: not from the centres of the corner texels.
//!
//! # Example
//!
//! ```
//! use scumble_geometry::{DVec2, FillRule, Homography, Path, Rect};
//! use scumble_pixel::Straight;
//! use scumble_scene::{Command, Fill, Scene, View};
//! use std::sync::Arc;
//!
//! // A red square on white, as a group of half the opacity.
//! let square = Path::rect(Rect::new(10.0, 10.0, 30.0, 30.0));
//! let scene = Scene {
//!     view: View::Fit { size: DVec2::new(40.0, 40.0) },
//!     background: Some(Straight::WHITE),
//!     images: vec![],
//!     commands: vec![
//!         Command::PushLayer { opacity: 0.5 },
//!         Command::Fill(Fill {
//!             path: Arc::new(square),
//!             rule: FillRule::NonZero,
//!             transform: Homography::IDENTITY,
//!             color: Straight([1.0, 0.0, 0.0, 1.0]),
//!         }),
//!         Command::PopLayer,
//!     ],
//! };
//! // On a canvas of 80 × 120 pixels it is drawn twice as large, in the middle.
//! let corner = scene.view.transform(80, 120).apply(DVec2::new(10.0, 10.0));
//! assert_eq!(corner, DVec2::new(20.0, 40.0));
//! ```

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
