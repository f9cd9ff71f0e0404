//! What one shape covers of a row of tiles, kept.

use crate::AreaSink;
use alloc::{vec, vec::Vec};
use scumble_geometry::IntRect;

/// No piece.
const NONE: u32 = u32::MAX;

/// The areas of one shape over a row of tiles, found once and handed out tile by tile.
///
/// To find an outline's area in a tile takes a look at all edges beside it. What crosses several tiles
/// is better rasterized over all of them at once, with a strip for a sink, and painted from there: a strip
/// holds what the tile would have found by itself, to the bit. What lies beside the tiles is dropped.
///
/// ```
/// use scumble_coverage::{AreaSink, AreaStrip, IntRect};
///
/// let mut strip = AreaStrip::new(0, 8, 2);
/// strip.row(3, 6, &[0.25, 0.5, 0.75]);
/// #[derive(Default)]
/// struct Sum(f32);
/// impl AreaSink for Sum {
///     fn run(&mut self, _: i32, x0: i32, x1: i32) {
///         self.0 += (x1 - x0) as f32;
///     }
///     fn pixel(&mut self, _: i32, _: i32, area: f32) {
///         self.0 += area;
///     }
/// }
/// let mut second = Sum::default();
/// strip.replay(IntRect::new(8, 0, 16, 8), &mut second);
/// assert_eq!(second.0, 0.75);
/// ```
#[derive(Debug, Clone)]
pub struct AreaStrip {
    /// Where tiles begin, and how wide they are.
    origin: i32,
    side: u32,
    /// By column of tiles: its first and its last piece.
    columns: Vec<(u32, u32)>,
    pieces: Vec<Piece>,
    areas: Vec<f32>,
}

/// Pixels of one tile that are all covered whole, or a stretch of a row with areas.
#[derive(Debug, Clone)]
struct Piece {
    rect: IntRect,
    /// Where its areas begin; none if it is covered whole.
    areas: Option<u32>,
    /// The next piece of the same column.
    next: u32,
}

impl AreaStrip {
    /// An empty strip over so many tiles of `side` columns each, the first from column `x0` on.
    #[must_use]
    pub fn new(x0: i32, side: u32, tiles: usize) -> Self {
        Self {
            origin: x0,
            side: side.max(1),
            columns: vec![(NONE, NONE); tiles],
            pieces: Vec::new(),
            areas: Vec::new(),
        }
    }

    /// The most bytes that a pixel takes.
    pub const PIXEL_BYTES: usize = size_of::<f32>() + size_of::<Piece>();

    /// The bytes that it takes.
    #[must_use]
    pub fn bytes(&self) -> u64 {
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
            if column >= self.columns.len() {
                return;
            }
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

    /// Hands on what lies in `clip`, which lies in one tile: what its shape would have handed out there.
    pub fn replay(&self, clip: IntRect, sink: &mut impl AreaSink) {
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

impl AreaSink for AreaStrip {
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
