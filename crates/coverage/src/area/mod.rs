//! Exact area: what part of each pixel of a row lies right of an edge, summed over edges.
//!
//! An edge that runs down from height y₁ to y₂ through a row leaves ∫ clamp(c + 1 − x(t), 0, 1) dt
//! of pixel c on its right. Inside the pixels that it touches this is a trapezoid; further right it
//! is y₂ − y₁, further left nothing. Each trapezoid is computed in f64 from the edge, the row and
//! the pixel alone, rounded to 2⁻³², and such numbers add up without rounding in f64. So the sum
//! depends neither on the order of the edges nor on the clip, the two sides of a shared edge cancel,
//! and what is full is exactly 1.

mod row;
mod slope;
#[cfg(test)]
mod tests;

pub(crate) use row::{AreaRow, GAP, eight_right};
pub(crate) use slope::{
    Reach, Slope, eight_areas, eight_parts, extent, mirrored, mirrored_eight, rounded_parts, splat,
    touched,
};

/// Pixels that are summed side by side.
pub(crate) const CHUNK: i32 = 8;

/// Their places.
pub(crate) const LANES: [f64; 8] = [0.0, 1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0];

/// Columns of a row's sums: what comfortably stays in the cache.
pub(crate) const ROW_CELLS: i32 = 1 << 15;
