use crate::IntRect;
use alloc::{vec, vec::Vec};

/// How a rectangle of pixels is cut into square tiles, from its top left corner on; the last column
/// and the last row of them may be narrower. Rows of tiles are called bands.
///
/// ```
/// use scumble_geometry::{IntRect, TileGrid};
///
/// let grid = TileGrid::new(IntRect::new(10, 0, 110, 50), 32);
/// assert_eq!((grid.columns(), grid.bands()), (4, 2));
/// assert_eq!(grid.tile(3, 1), IntRect::new(106, 32, 110, 50));
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct TileGrid {
    area: IntRect,
    width: u32,
    height: u32,
}

impl TileGrid {
    /// Cuts `area` into tiles of `side` pixels. A side of 0 counts as 1.
    #[must_use]
    pub fn new(area: IntRect, side: u32) -> Self {
        Self::with_size(area, side, side)
    }

    /// Cuts `area` into tiles of `width` × `height` pixels, each at least 1.
    #[must_use]
    pub fn with_size(area: IntRect, width: u32, height: u32) -> Self {
        Self { area, width: width.max(1), height: height.max(1) }
    }

    /// All pixels.
    #[must_use]
    pub fn area(&self) -> IntRect {
        self.area
    }

    /// Columns of pixels of a whole tile.
    #[must_use]
    pub fn width(&self) -> u32 {
        self.width
    }

    /// Rows of pixels of a whole tile.
    #[must_use]
    pub fn height(&self) -> u32 {
        self.height
    }

    /// Tiles side by side.
    #[must_use]
    pub fn columns(&self) -> usize {
        self.area.width().div_ceil(self.width) as usize
    }

    /// Rows of tiles.
    #[must_use]
    pub fn bands(&self) -> usize {
        self.area.height().div_ceil(self.height) as usize
    }

    /// The pixels of the tile at a column of a band; empty if there is no such tile.
    #[must_use]
    pub fn tile(&self, column: usize, band: usize) -> IntRect {
        let range = |index: usize, side: u32, [low, high]: [i32; 2]| {
            let at = |index: usize| {
                let offset = index as i64 * i64::from(side);
                (i64::from(low) + offset).min(i64::from(high)) as i32
            };
            (at(index), at(index.saturating_add(1)))
        };
        let (x0, x1) = range(column.min(self.columns()), self.width, [self.area.x0, self.area.x1]);
        let (y0, y1) = range(band.min(self.bands()), self.height, [self.area.y0, self.area.y1]);
        IntRect { x0, y0, x1, y1 }
    }
}

/// The first and the last of the tiles, along one axis, that `low..high` touches; it lies in the area,
/// which begins at `origin`, and is not empty.
fn span(side: u32, origin: i32, low: i32, high: i32) -> [u32; 2] {
    [low, high - 1].map(|v| v.abs_diff(origin) / side)
}

/// Which of many rectangles touch which tile, band by band from the top, so that memory does not
/// grow with the number of bands.
///
/// ```
/// use scumble_geometry::{IntRect, TileBins, TileGrid};
///
/// let grid = TileGrid::new(IntRect::new(0, 0, 64, 64), 32);
/// let rects = [IntRect::new(0, 0, 40, 9), IntRect::new(5, 30, 6, 34)];
/// let mut bins = TileBins::new(grid, &rects);
/// let mut lists = vec![Vec::new(); grid.columns()];
/// bins.fill(0, &mut lists);
/// assert_eq!(lists, [vec![0, 1], vec![0]]);
/// bins.fill(1, &mut lists);
/// assert_eq!(lists, [vec![1], vec![]]);
/// ```
#[derive(Debug, Clone)]
pub struct TileBins {
    /// In the order of their numbers.
    parts: Vec<BandStarts>,
    /// Those that touch the band at hand, in their order.
    active: Vec<Entry>,
}

/// Some of the rectangles of [`TileBins`], by the band in which they begin: parts of a long list can
/// be made side by side.
#[derive(Debug, Clone)]
pub struct BandStarts {
    bands: Vec<Vec<Entry>>,
}

/// The tiles that a rectangle touches. Kept with its number, since the rectangles of a band lie all
/// over the list of all.
#[derive(Debug, Clone, Copy)]
struct Entry {
    index: u32,
    columns: [u32; 2],
    last_band: u32,
}

impl BandStarts {
    /// Prepares rectangles, which have numbers from `first` on; what lies outside the grid is left
    /// out.
    #[must_use]
    pub fn new(grid: TileGrid, first: u32, rects: &[IntRect]) -> Self {
        let mut bands = vec![Vec::new(); grid.bands()];
        for (index, rect) in (first..).zip(rects) {
            let rect = rect.intersect(&grid.area);
            if !rect.is_empty() {
                let columns = span(grid.width, grid.area.x0, rect.x0, rect.x1);
                let [first_band, last_band] = span(grid.height, grid.area.y0, rect.y0, rect.y1);
                bands[first_band as usize].push(Entry { index, columns, last_band });
            }
        }
        Self { bands }
    }
}

impl TileBins {
    /// Prepares rectangles, up to 2³² of them; what lies outside the grid is left out.
    #[must_use]
    pub fn new(grid: TileGrid, rects: &[IntRect]) -> Self {
        Self::from_parts(vec![BandStarts::new(grid, 0, rects)])
    }

    /// The same from parts of one grid, in rising order of their numbers.
    ///
    /// ```
    /// use scumble_geometry::{BandStarts, IntRect, TileBins, TileGrid};
    ///
    /// let grid = TileGrid::new(IntRect::new(0, 0, 64, 32), 32);
    /// let rects = [IntRect::new(0, 0, 40, 9), IntRect::new(5, 30, 6, 32)];
    /// let part = |i: usize| BandStarts::new(grid, i as u32, &rects[i..=i]);
    /// let mut bins = TileBins::from_parts(vec![part(0), part(1)]);
    /// let mut lists = vec![Vec::new(); grid.columns()];
    /// bins.fill(0, &mut lists);
    /// assert_eq!(lists, [vec![0, 1], vec![0]]);
    /// ```
    #[must_use]
    pub fn from_parts(parts: Vec<BandStarts>) -> Self {
        Self { parts, active: Vec::new() }
    }

    /// Fills one list for each tile of a band with the numbers of the rectangles that touch it, in
    /// rising order. Bands must be asked for from the top on, each once.
    pub fn fill(&mut self, band: usize, lists: &mut [Vec<u32>]) {
        self.active.retain(|entry| entry.last_band as usize >= band);
        let kept = self.active.len();
        for part in &mut self.parts {
            if let Some(starting) = part.bands.get_mut(band) {
                self.active.append(starting);
            }
        }
        if kept > 0 {
            // Two sorted runs: the standard sort finds and merges them in linear time.
            self.active.sort_by_key(|entry| entry.index);
        }
        lists.iter_mut().for_each(Vec::clear);
        for &Entry { index, columns: [first, last], .. } in &self.active {
            for list in lists.iter_mut().take(last as usize + 1).skip(first as usize) {
                list.push(index);
            }
        }
    }
}
