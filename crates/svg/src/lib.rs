//! SVG, and the course's dialect of it, into a display list.
//!
//! [`parse`] takes a document and gives a [`Scene`](scumble_scene::Scene), in which everything is
//! resolved: styles, transforms, images. Nothing is painted here.
//!
//! # Two profiles
//!
//! - [`Profile::Svg`]: what a person means by SVG, plus elements for coloured and textured
//!   triangles and transforms in perspective.
//! - [`Profile::Course`]: the scenes of a rasterizer course, as its reference draws them: their
//!   own view with a margin and a frame, strokes one pixel wide, nothing inherited. Chosen by the
//!   caller or by `sc:profile="course"` on the root, where `sc` is bound to
//!   `https://scumble.rs/ns/1`.
//!
//! `docs/scene-format.md` describes both in full, `docs/unsupported.md` what is left out and why.
//!
//! # Conventions
//!
//! - Scene units are the root's user units before its `viewBox`; y points down.
//! - This crate reads no file. Images come from the [`Resources`] that the caller gives.
//! - What cannot be read is a [`SvgError`] with its line and column. What can be read but is not
//!   drawn as written is named in a [`Warning`].
//! - Hostile documents meet [`Limits`]: on size, nesting, expansion and images, checked before
//!   the memory is taken.
//!
//! # Example
//!
//! ```
//! use scumble_svg::{Options, Profile, parse};
//! let document = br##"<svg xmlns="http://www.w3.org/2000/svg" width="20" height="10"
//!     xmlns:sc="https://scumble.rs/ns/1" sc:profile="course">
//!     <polygon points="1,1 19,1 10,9" fill="#c00000"/>
//!     <circle r="3"/>
//! </svg>"##;
//! let parsed = parse(document, &Options::default())?;
//! assert_eq!(parsed.profile, Profile::Course);
//! assert_eq!(parsed.scene.commands.len(), 1);
//! assert!(parsed.warnings[0].to_string().starts_with("4:5: `circle` is not drawn"));
//! # Ok::<(), scumble_svg::SvgError>(())
//! ```

mod course;
mod data_uri;
mod error;
mod extension;
mod images;
mod input;
mod matrix4;
mod numbers;
mod options;
mod parse;
mod position;
mod resources;
mod svg;
mod transform;
mod trig;
mod warning;

pub use error::{ErrorKind, SvgError};
pub use options::{Limits, Options, Profile, ProfileChoice};
pub use parse::{Parsed, parse};
pub use position::Position;
pub use resources::{NoResources, ResourceError, Resources};
pub use warning::Warning;
