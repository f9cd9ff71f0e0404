//! Sheets of pictures with words on them, as scenes for the renderer.
//!
//! The face is our own: every character is a few strokes of a pen, drawn by the same rasterizer as
//! all else. So there is no font file, no licence beside the project's, and the same pixels everywhere.
//!
//! # Conventions
//!
//! - Positions and sizes are in pixels, y down. Pictures lie on whole pixels and are shown as they are,
//!   each pixel as a square of `scale` pixels.
//! - The size of text is from line to line. Capitals are 0.7 of it high; it is readable from 12 on.
//! - Text is printable ASCII and a few signs more; what else there is becomes an empty box.
//!
//! # Example
//!
//! ```
//! use scumble_geometry::DVec2;
//! use scumble_pixel::Image;
//! use scumble_sheet::{Anchor, Cell, Drawing, INK, contact_sheet};
//!
//! let mut drawing = Drawing::new(200, 40);
//! drawing.text(DVec2::new(100.0, 25.0), 14.0, Anchor::Middle, "in the middle", INK);
//! assert_eq!(drawing.into_scene().commands.len(), 1);
//!
//! let picture = Image::filled(64, 48, [200, 60, 20, 255])?;
//! let cells = ["one", "two"].map(|word| Cell::new(picture.clone(), [word]));
//! let sheet = contact_sheet(&cells, 2, 1);
//! assert!(sheet.width() > 128 && sheet.height() > 48);
//! # Ok::<(), scumble_pixel::ImageError>(())
//! ```

mod contact;
mod drawing;
mod font;

pub use contact::{Cell, contact_sheet};
pub use drawing::{Anchor, Drawing, INK};
pub use font::text_width;
