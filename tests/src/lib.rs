//! What the tests of this package share: cases found on disk, pictures compared exactly, scenes
//! read as a user would read them.
//!
//! # Conventions
//!
//! - A case is a text file of `key = value` lines under `cases/`, one for each picture; its name
//!   is the file's. [`Case`] lists the keys.
//! - A reference is `golden/NAME.png`. Pictures are compared as decoded pixels, exactly: the same
//!   input gives the same bytes on every machine, so a tolerance would only hide a change.
//! - Errors are text: what fails here is read by a person.

mod case;
mod compare;
mod golden;
mod grid;
mod scene;

pub use case::Case;
pub use compare::{Comparison, compare, triptych};
pub use golden::{Golden, Mode};
pub use grid::{Ownership, Tally, samples_of};
pub use scene::{load, picture, scene_names, scenes_folder, texture};

/// The README's examples compile and hold.
#[cfg(doctest)]
#[doc = include_str!("../../README.md")]
struct Readme;
