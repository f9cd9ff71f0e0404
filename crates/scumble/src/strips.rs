//! Outlines by exact area, found once for a whole row of tiles.
//!
//! To find an outline's area in a tile takes a look at all edges beside it. So what crosses several
//! tiles of a band is rasterized over all of them at once, kept as a strip of stretches and areas,
//! and painted from there. A strip holds what the tile would have found by itself, to the bit; so
//! it does not matter which outlines get one, and none is made where there is no memory for it.

use crate::plan::{Form, Plan};
use scumble_coverage::{AreaSink, Scratch, Shape};
use scumble_geometry::{IntRect, TileGrid};
use std::sync::atomic::{AtomicU64, Ordering};

/// The most bytes that the strips of a group of bands take.
pub(crate) const MAX_BYTES: u64 = 32 << 20;

/// Triangles are found so quickly that keeping them is no gain.
const LEAST_EDGES: usize = 4;

/// What a pixel may take: its area, and a piece of its own.
const PIXEL_BYTES: u64 = (size_of::<f32>() + size_of::<Piece>()) as u64;

/// No piece.
const NONE: u32 = u32::MAX;

/// The areas of one outline in a band.
#[derive(Debug)]
pub(crate) struct Strip {
    /// Where tiles begin, and how wide they are.
    origin: i32,
    side: u32,
    /// By column of tiles: its first and its last piece.
    columns: Vec<(u32, u32)>,
    pieces: Vec<Piece>,
    areas: Vec<f32>,
}

/// Pixels of one tile that are all covered whole, or a stretch of a row with areas.
#[derive(Debug)]
struct Piece {
    rect: IntRect,
    /// Where its areas begin; none if it is covered whole.
    areas: Option<u32>,
    /// The next piece of the same column.
    next: u32,
}

/// An outline to be found in a band.
pub(crate) struct Wanted<'a> {
    /// Its place among the primitives.
    pub(crate) draw: u32,
    shape: &'a Shape,
    clip: IntRect,
    pub(crate) strip: Option<Strip>,
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
            let column_of = |x: i32| (x.abs_diff(band.x0) / grid.side()) as usize;
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
        let most = width.saturating_mul(height).saturating_mul(PIXEL_BYTES);
        let take = |left: u64| left.checked_sub(most);
        if most > MAX_BYTES
            || spare.fetch_update(Ordering::Relaxed, Ordering::Relaxed, take).is_err()
        {
            return;
        }
        let mut strip = Strip {
            origin: grid.area().x0,
            side: grid.side(),
            columns: vec![(NONE, NONE); grid.columns()],
            pieces: Vec::new(),
            areas: Vec::new(),
        };
        self.shape.rasterize_area(self.clip, scratch, &mut strip);
        spare.fetch_add(most.saturating_sub(strip.bytes()), Ordering::Relaxed);
        self.strip = Some(strip);
    }
}

impl Strip {
    fn bytes(&self) -> u64 {
        let pieces = self.pieces.capacity() * size_of::<Piece>();
        (pieces + self.areas.capacity() * size_of::<f32>() + self.columns.len() * 8) as u64
    }

    fn column(&self, x: i32) -> usize {
        (x.abs_diff(self.origin) / self.side) as usize
    }

    /// Keeps a rectangle; `areas` is where its areas begin.
    fn push(&mut self, mut rect: IntRect, mut areas: Option<u32>) {
        while !rect.is_empty() {
            let column = self.column(rect.x0);
            let end = self.origin.saturating_add_unsigned((column as u32 + 1) * self.side);
            let width = end.min(rect.x1) - rect.x0;
            let index = self.pieces.len() as u32;
            let piece = IntRect { x1: rect.x0 + width, ..rect };
            self.pieces.push(Piece { rect: piece, areas, next: NONE });
            let (first, last) = &mut self.columns[column];
            match self.pieces.get_mut(*last as usize) {
                Some(before) => before.next = index,
                None => *first = index,
            }
            *last = index;
            rect.x0 += width;
            areas = areas.map(|at| at + width as u32);
        }
    }

    /// Hands on what lies in `clip`, which lies in one tile.
    pub(crate) fn replay(&self, clip: IntRect, sink: &mut impl AreaSink) {
        if clip.is_empty() {
            return;
        }
        let mut index = self.columns.get(self.column(clip.x0)).map_or(NONE, |column| column.0);
        while let Some(piece) = self.pieces.get(index as usize) {
            index = piece.next;
            let rect = piece.rect.intersect(&clip);
            if rect.is_empty() {
                continue;
            }
            match piece.areas {
                None => sink.block(rect),
                Some(at) => {
                    let from = at as usize + (rect.x0 - piece.rect.x0) as usize;
                    sink.row(rect.y0, rect.x0, &self.areas[from..from + rect.width() as usize]);
                }
            }
        }
    }
}

impl AreaSink for Strip {
    fn block(&mut self, rect: IntRect) {
        self.push(rect, None);
    }

    fn run(&mut self, y: i32, x0: i32, x1: i32) {
        self.push(IntRect { x0, y0: y, x1, y1: y + 1 }, None);
    }

    fn row(&mut self, y: i32, x0: i32, areas: &[f32]) {
        let at = self.areas.len() as u32;
        self.areas.extend_from_slice(areas);
        self.push(IntRect { x0, y0: y, x1: x0 + areas.len() as i32, y1: y + 1 }, Some(at));
    }

    fn pixel(&mut self, x: i32, y: i32, area: f32) {
        self.row(y, x, &[area]);
    }
}
