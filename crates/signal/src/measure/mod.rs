//! Numbers for what eyes complain of: false patterns, and blur.

mod aliasing;
mod edge;
mod mtf;

pub use aliasing::{Fit, RINGS, energy_above, unexplained};
pub use mtf::{Mtf, slanted_edge};
