//! Eight pixels in which so many edges cross that following them all would take too long: samples.

use super::strips::{AreaEdge, Place};
use crate::fixed::{floor, low_bits};

/// Rows of samples in a pixel.
const HEIGHTS: usize = 16;

/// Columns of samples in a pixel, and in all eight.
const COLUMNS: usize = 8;
const ALL: usize = 8 * COLUMNS;

/// By what part of the distance between two columns each row of samples is shifted, so that no two
/// samples of a pixel have the same x: the bits of its number, reversed.
const SHIFTS: [f64; HEIGHTS] = {
    let mut shifts = [0.0; HEIGHTS];
    let mut i = 0;
    while i < HEIGHTS {
        let reversed = (i as u8).reverse_bits() as usize * HEIGHTS / 256;
        shifts[i] = (reversed as f64 + 0.5) / HEIGHTS as f64;
        i += 1;
    }
    shifts
};

/// The areas of the eight pixels by 128 samples each. A straight edge alone would be right to about
/// 1/64.
pub(super) fn areas(place: Place<'_>, edges: &[AreaEdge]) -> [f64; 8] {
    const STEP: i32 = 256 / HEIGHTS as i32;
    let (x, y) = (f64::from(place.x), f64::from(place.y));
    // By how much the winding number changes at each sample, from the left.
    let mut changes = [[0i32; ALL + 1]; HEIGHTS];
    for e in edges {
        // The samples stand half a step below the top of the row, and then one step apart.
        let row = |height: i32| ((height + STEP / 2 - 1) / STEP) as usize;
        // In columns of samples, so that the first column of a row of samples at or right of the edge is
        // the next whole number.
        let slope = &e.slope;
        let start = (slope.at(y) - x) * COLUMNS as f64;
        let run = slope.sign * slope.run * (COLUMNS as f64 / HEIGHTS as f64);
        for i in row(e.from)..row(e.to) {
            let at = start + (i as f64 + 0.5) * run - SHIFTS[i];
            let first = -floor(-at.clamp(0.0, ALL as f64));
            changes[i][low_bits(first) as usize] += e.winding;
        }
    }
    let mut counts = [0u32; 8];
    let mut left = place.left.iter().peekable();
    let mut winding = place.left.top;
    for (i, changes) in changes.iter().enumerate() {
        while let Some(step) = left.next_if(|step| step.0 <= i as i32 * STEP + STEP / 2) {
            winding += step.1;
        }
        let mut here = winding;
        for (count, changes) in counts.iter_mut().zip(changes.chunks_exact(COLUMNS)) {
            for change in changes {
                here += change;
                *count += u32::from(place.polygon.is_inside(here));
            }
        }
    }
    counts.map(|n| f64::from(n) * (1.0 / (HEIGHTS * COLUMNS) as f64))
}
