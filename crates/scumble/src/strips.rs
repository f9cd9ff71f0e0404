//! Outlines by exact area, found once for a whole row of tiles.
//!
//! To find an outline's area in a tile takes a look at all edges beside it. So what crosses several
//! tiles of a band is rasterized over all of them at once, kept as a strip of stretches and areas,
//! and painted from there. A strip holds what the tile would have found by itself, to the bit; so
//! it does not matter which outlines get one, and none is made where there is no memory for it.

use crate::plan::{Form, Plan};
use scumble_coverage::{AreaStrip, Scratch, Shape};
use scumble_geometry::{IntRect, TileGrid};
use std::sync::atomic::{AtomicU64, Ordering};

/// The most bytes that the strips of a group of bands take.
pub(crate) const MAX_BYTES: u64 = 32 << 20;

/// Triangles are found so quickly that keeping them is no gain.
const LEAST_EDGES: usize = 4;

/// An outline to be found in a band.
pub(crate) struct Wanted<'a> {
    /// Its place among the primitives.
    pub(crate) draw: u32,
    shape: &'a Shape,
    clip: IntRect,
    pub(crate) strip: Option<AreaStrip>,
}

/// The outlines of a band that touch more than one tile, by rising place. `lists` has the
/// primitives of each tile.
pub(crate) fn wanted<'a>(
    plan: &'a Plan<'_>,
    grid: &TileGrid,
    band: usize,
    lists: &[Vec<u32>],
) -> Vec<Wanted<'a>> {
    let tiles = grid.tile(0, band);
    let band = IntRect { x1: grid.area().x1, ..tiles };
    let mut wanted = Vec::new();
    for (column, list) in lists.iter().enumerate() {
        for (&number, (draw, bounds)) in list.iter().zip(plan.draws(list)) {
            let clip = bounds.intersect(&band);
            let column_of = |x: i32| (x.abs_diff(band.x0) / grid.width()) as usize;
            // Each is looked at in its leftmost tile.
            if clip.is_empty() || column_of(clip.x0) != column || column_of(clip.x1 - 1) == column {
                continue;
            }
            if let Form::Shape(shape) = &draw.form
                && shape.edge_count() >= LEAST_EDGES
            {
                wanted.push(Wanted { draw: number, shape, clip, strip: None });
            }
        }
    }
    wanted.sort_unstable_by_key(|w| w.draw);
    wanted
}

impl Wanted<'_> {
    /// Finds the strip, if `spare` bytes are enough for it.
    pub(crate) fn find(&mut self, grid: &TileGrid, spare: &AtomicU64, scratch: &mut Scratch) {
        let (width, height) = (u64::from(self.clip.width()), u64::from(self.clip.height()));
        let mut strip = AreaStrip::new(grid.area().x0, grid.width(), grid.columns());
        let pixels = width.saturating_mul(height).saturating_mul(AreaStrip::PIXEL_BYTES as u64);
        let most = pixels.saturating_add(strip.bytes());
        let take = |left: u64| left.checked_sub(most);
        if most > MAX_BYTES
            || spare.fetch_update(Ordering::Relaxed, Ordering::Relaxed, take).is_err()
        {
            return;
        }
        self.shape.rasterize_area(self.clip, scratch, &mut strip);
        spare.fetch_add(most.saturating_sub(strip.bytes()), Ordering::Relaxed);
        self.strip = Some(strip);
    }
}
