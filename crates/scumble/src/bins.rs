//! Which primitives each tile must look at.

use crate::plan::Draw;
use scumble_geometry::IntRect;

/// How a canvas, or a crop of it, is cut into tiles. Rows of tiles are called bands.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Grid {
    /// The pixels to render.
    pub(crate) area: IntRect,
    /// Side of a tile.
    pub(crate) tile: u32,
}

impl Grid {
    pub(crate) fn columns(&self) -> usize {
        self.area.width().div_ceil(self.tile) as usize
    }

    pub(crate) fn bands(&self) -> usize {
        self.area.height().div_ceil(self.tile) as usize
    }

    /// The pixels of the tile at a column of a band.
    pub(crate) fn tile_rect(&self, column: usize, band: usize) -> IntRect {
        let tile = self.tile as usize;
        // Both products stay below the area's size, which is an i32.
        let x0 = self.area.x0 + (column * tile) as i32;
        let y0 = self.area.y0 + (band * tile) as i32;
        let side = self.tile as i32;
        let full = IntRect::new(x0, y0, x0.saturating_add(side), y0.saturating_add(side));
        full.intersect(&self.area)
    }

    /// The first and the last of the tiles, along one axis, that `low..high` touches; the range
    /// must not be empty and lie in the area.
    fn span(&self, origin: i32, low: i32, high: i32) -> std::ops::RangeInclusive<usize> {
        let index = |v: i32| (v.abs_diff(origin) / self.tile) as usize;
        index(low)..=index(high - 1)
    }
}

/// The primitives that touch the band at hand, kept up to date from band to band. Lists are made
/// a band at a time, so that their memory does not grow with the height of the picture.
#[derive(Debug)]
pub(crate) struct Bins {
    grid: Grid,
    /// Per band: the primitives that begin in it, in drawing order.
    starting: Vec<Vec<u32>>,
    /// The primitives that touch the band at hand, in drawing order.
    active: Vec<u32>,
}

impl Bins {
    pub(crate) fn new(grid: Grid, draws: &[Draw]) -> Self {
        let mut starting = vec![Vec::new(); grid.bands()];
        for (i, draw) in draws.iter().enumerate() {
            let rect = draw.bounds.intersect(&grid.area);
            if !rect.is_empty() {
                let band = *grid.span(grid.area.y0, rect.y0, rect.y1).start();
                starting[band].push(i as u32);
            }
        }
        Self { grid, starting, active: Vec::new() }
    }

    /// Fills one list for each tile of a band. Bands must be asked for in order.
    pub(crate) fn fill(&mut self, band: usize, draws: &[Draw], lists: &mut [Vec<u32>]) {
        let top = self.grid.tile_rect(0, band).y0;
        self.active.retain(|&i| draws[i as usize].bounds.y1 > top);
        self.active.extend(std::mem::take(&mut self.starting[band]));
        // Two sorted runs: the standard sort finds and merges them in linear time.
        self.active.sort();

        for list in &mut *lists {
            list.clear();
        }
        for &i in &self.active {
            let rect = draws[i as usize].bounds.intersect(&self.grid.area);
            for column in self.grid.span(self.grid.area.x0, rect.x0, rect.x1) {
                lists[column].push(i);
            }
        }
    }
}
