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
    /// Where its areas begin; [`NONE`] if it is covered whole.
    areas: u32,
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
            // Few need less, and to grow takes longer than to fill.
            pieces: Vec::with_capacity(128),
            areas: Vec::with_capacity(512),
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

    #[inline]
    fn column(&self, x: i32) -> usize {
        (x.abs_diff(self.origin) / self.side) as usize
    }

    /// Keeps a rectangle; `areas` is where its areas begin, or [`NONE`].
    #[inline]
    fn push(&mut self, rect: IntRect, areas: u32) {
        let column = self.column(rect.x0);
        let end = self.origin.saturating_add_unsigned((column as u32 + 1) * self.side);
        if rect.x1 <= end {
            return self.push_piece(column, rect, areas);
        }
        self.push_pieces((column, end), rect, areas);
    }

    /// Keeps a rectangle that begins in a column which ends at `end`.
    #[inline(never)]
    fn push_pieces(&mut self, (mut column, mut end): (usize, i32), mut rect: IntRect, areas: u32) {
        let mut at = areas;
        while rect.x0 < rect.x1 && column < self.columns.len() {
            let piece = IntRect { x1: end.min(rect.x1), ..rect };
            self.push_piece(column, piece, at);
            at = if areas == NONE { NONE } else { at + piece.width() };
            rect.x0 = end;
            column += 1;
            end = end.saturating_add_unsigned(self.side);
        }
    }

    /// Keeps a rectangle of one column.
    #[inline]
    fn push_piece(&mut self, column: usize, rect: IntRect, areas: u32) {
        let index = self.pieces.len() as u32;
        let Some((first, last)) = self.columns.get_mut(column) else { return };
        match self.pieces.get_mut(*last as usize) {
            // Rows of the same whole pixels are one block.
            Some(Piece { rect: before, areas: NONE, .. })
                if areas == NONE
                    && (before.x0, before.x1, before.y1) == (rect.x0, rect.x1, rect.y0) =>
            {
                before.y1 = rect.y1;
                return;
            }
            Some(before) => before.next = index,
            None => *first = index,
        }
        *last = index;
        self.pieces.push(Piece { rect, areas, next: NONE });
    }

    /// Whether all of `clip`, which lies in one tile, is covered whole and came as one rectangle or as
    /// rows that are alike. `false` if the strip does not know at a glance.
    #[must_use]
    pub fn fills(&self, clip: IntRect) -> bool {
        let first = self.columns.get(self.column(clip.x0)).map_or(NONE, |column| column.0);
        self.pieces
            .get(first as usize)
            .is_some_and(|piece| piece.areas == NONE && piece.rect.intersect(&clip) == clip)
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
                NONE => sink.block(rect),
                at => {
                    let from = at as usize + (rect.x0 - piece.rect.x0) as usize;
                    sink.row(rect.y0, rect.x0, &self.areas[from..from + rect.width() as usize]);
                }
            }
        }
    }
}

impl AreaSink for AreaStrip {
    fn block(&mut self, rect: IntRect) {
        self.push(rect, NONE);
    }

    fn run(&mut self, y: i32, x0: i32, x1: i32) {
        self.push(IntRect { x0, y0: y, x1, y1: y + 1 }, NONE);
    }

    fn row(&mut self, y: i32, x0: i32, areas: &[f32]) {
        let at = self.areas.len() as u32;
        self.areas.extend_from_slice(areas);
        self.push(IntRect { x0, y0: y, x1: x0 + areas.len() as i32, y1: y + 1 }, at);
    }

    fn pixel(&mut self, x: i32, y: i32, area: f32) {
        self.row(y, x, &[area]);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Counts calls, and adds areas up.
    #[derive(Default)]
    struct Calls {
        blocks: Vec<IntRect>,
        area: f32,
    }

    impl AreaSink for Calls {
        fn block(&mut self, rect: IntRect) {
            self.blocks.push(rect);
        }
        fn run(&mut self, _: i32, _: i32, _: i32) {
            unreachable!("whole pixels come in blocks");
        }
        fn pixel(&mut self, _: i32, _: i32, area: f32) {
            self.area += area;
        }
    }

    #[test]
    fn rows_of_whole_pixels_become_blocks() {
        let mut strip = AreaStrip::new(-8, 8, 3);
        for y in 0..8 {
            strip.row(y, -3, &[0.5, 0.5]);
            strip.run(y, -1, 12 + y);
        }
        let tile = |column: i32| IntRect::new(8 * column - 8, 0, 8 * column, 8);
        assert!(!strip.fills(tile(0)) && strip.fills(tile(1)) && !strip.fills(tile(2)));
        let mut calls = Calls::default();
        strip.replay(tile(1), &mut calls);
        assert_eq!(calls.blocks, [tile(1)]);
        strip.replay(IntRect::new(1, 2, 5, 4), &mut calls);
        assert_eq!(calls.blocks[1], IntRect::new(1, 2, 5, 4));
        strip.replay(tile(0), &mut calls);
        // Beside areas each row comes by itself.
        assert_eq!((calls.area, calls.blocks.len()), (8.0, 10));
        // Beyond the tiles nothing is kept.
        strip.replay(IntRect::new(16, 0, 24, 8), &mut calls);
        assert_eq!(calls.blocks.len(), 10);
    }

    #[test]
    fn a_row_of_areas_is_shared_out() {
        let mut strip = AreaStrip::new(0, 2, 3);
        strip.row(1, 1, &[0.5, 0.25, 0.125, 1.0, 0.0625]);
        let area = |x: i32| {
            let mut calls = Calls::default();
            strip.replay(IntRect::new(x, 0, x + 2, 4), &mut calls);
            calls.area
        };
        assert_eq!([area(0), area(2), area(4)], [0.5, 0.375, 1.0625]);
    }
}
