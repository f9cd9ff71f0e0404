use crate::{Cover, Shape};
use scumble_geometry::IntRect;

impl Shape {
    /// Conservative coverage, by squares of `cell` pixels aligned to multiples of `cell` (at least
    /// 1).
    ///
    /// Every cell of `clip` in which the shape may own a sample is visited once: as part of a
    /// rectangle of whole cells with [`Cover::Full`] if it certainly owns all of them, or by itself
    /// with [`Cover::Partial`]. All that is visited is the outer coverage, what is `Full` the inner
    /// one, for any pattern. Cells that reach beyond `clip` are cut to it.
    ///
    /// With the size of a tile this sorts shapes into tiles; with 1 it is conservative
    /// rasterization by pixels. Rectangles are divided only where an edge may pass through.
    pub fn visit_cells(&self, clip: IntRect, cell: u32, mut visit: impl FnMut(IntRect, Cover)) {
        let region = clip.intersect(&self.bounds());
        if region.is_empty() {
            return;
        }
        // Bounds lie within ±2²¹ pixels, so a larger cell than 2²² is the same as that.
        let cell = cell.clamp(1, 1 << 22) as i32;
        let cells = IntRect::new(
            region.x0.div_euclid(cell),
            region.y0.div_euclid(cell),
            (region.x1 - 1).div_euclid(cell) + 1,
            (region.y1 - 1).div_euclid(cell) + 1,
        );
        let pixels = |c: IntRect| {
            IntRect::new(c.x0 * cell, c.y0 * cell, c.x1 * cell, c.y1 * cell).intersect(&clip)
        };
        self.divide(cells, &pixels, &mut visit);
    }

    fn divide(
        &self,
        cells: IntRect,
        pixels: &impl Fn(IntRect) -> IntRect,
        visit: &mut impl FnMut(IntRect, Cover),
    ) {
        let rect = pixels(cells);
        let cover = self.covers(rect);
        let (width, height) = (cells.width(), cells.height());
        match cover {
            Cover::None => {}
            Cover::Partial if width > 1 || height > 1 => {
                let (mut first, mut second) = (cells, cells);
                if width >= height {
                    first.x1 = cells.x0 + (width / 2) as i32;
                    second.x0 = first.x1;
                } else {
                    first.y1 = cells.y0 + (height / 2) as i32;
                    second.y0 = first.y1;
                }
                self.divide(first, pixels, visit);
                self.divide(second, pixels, visit);
            }
            Cover::Partial | Cover::Full => visit(rect, cover),
        }
    }
}
