//! The driver: a [`Scene`](scumble_scene::Scene) in, rows of finished pixels out.
//!
//! The canvas is cut into tiles. Every primitive is set up once and listed, in drawing order, by
//! the tiles that it may touch; each tile replays its list into its own sample storage, resolves
//! it, and hands its rows on. So the output does not depend on threads or on the size of the
//! tiles, and memory does not grow with the height of the picture: rows go to a [`Sink`] band by
//! band.
//!
//! This crate composes the others and has no filter, coverage rule or colour arithmetic of its
//! own; it re-exports them, so that one dependency is enough.
#![doc = include_str!("guide.md")]

mod error;
mod paint;
mod painter;
mod plan;
mod render;
mod rows;
mod schedule;
mod settings;
mod strips;
mod textures;
mod tile;
pub mod warp;

pub use error::RenderError;
pub use render::{Stats, render, render_image, render_with};
pub use rows::{Control, ImageSink, Progress, Sink};
pub use scumble_coverage as coverage;
pub use scumble_framebuffer as framebuffer;
pub use scumble_geometry as geometry;
pub use scumble_pixel as pixel;
pub use scumble_scene as scene;
pub use scumble_texture as texture;
pub use settings::{
    Antialias, Background, DEFAULT_MAX_MEMORY, DEFAULT_SAMPLES, DEFAULT_TILE_SIZE, Interpolation,
    Settings, Shading,
};
pub use textures::Textures;
