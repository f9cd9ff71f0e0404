use crate::SampleMask;
use scumble_geometry::IntRect;

/// Receives the covered samples of one shape.
///
/// The order of the calls is not specified, but it is the same in every run. One call of
/// [`Shape::rasterize`](crate::Shape::rasterize) names each sample of each pixel at most once.
/// A fully covered pixel comes in a `block` or a `run`, never in `pixel`, so that a shader need not
/// look at masks there.
pub trait Sink {
    /// Every sample of every pixel in `rect`, which is not empty.
    fn block(&mut self, rect: IntRect) {
        for y in rect.y0..rect.y1 {
            self.run(y, rect.x0, rect.x1);
        }
    }

    /// Every sample of the pixels `x0..x1` of row `y`; `x0 < x1`.
    fn run(&mut self, y: i32, x0: i32, x1: i32);

    /// Some samples of one pixel: at least one, not all.
    fn pixel(&mut self, x: i32, y: i32, mask: SampleMask);

    /// Whether small triangles and the rims of large ones are to come in squares of 8 × 8 pixels, by
    /// [`whole`](Self::whole) and [`parts`](Self::parts). That is by far the quickest for a sink that
    /// can take them in vectors; one that pays for each call it makes is better off without. It
    /// is a wish: what is no triangle, and patterns of other than one or four samples, come in the
    /// other calls all the same.
    const SQUARES: bool = false;

    /// Every sample of some of the 8 × 8 pixels from (`x`, `y`) on: bit 8·r + c of `pixels`, which
    /// is not 0, is the pixel (x + c, y + r). Comes only with a pattern of one sample.
    #[inline]
    fn whole(&mut self, x: i32, y: i32, pixels: u64) {
        for (row, y) in pixels.to_le_bytes().into_iter().zip(y..) {
            each_run(u32::from(row), |from, to| self.run(y, x + from, x + to));
        }
    }

    /// Some samples of some of the 8 × 8 pixels from (`x`, `y`) on: bit 4·c + s of `rows[r]` is
    /// sample s of the pixel (x + c, y + r); a pixel may have all of them. At least one bit is set.
    /// Comes only with a pattern of four samples.
    #[inline]
    fn parts(&mut self, x: i32, y: i32, rows: &[u32; 8]) {
        for (row, y) in rows.iter().zip(y..) {
            let nibble = |c: i32| row >> (4 * c) & 0xf;
            let full = (0..8).fold(0, |full, c| full | u32::from(nibble(c) == 0xf) << c);
            each_run(full, |from, to| self.run(y, x + from, x + to));
            for c in (0..8).filter(|&c| nibble(c) % 0xf != 0) {
                self.pixel(x + c, y, SampleMask(u64::from(nibble(c))));
            }
        }
    }
}

/// The stretches of bits that are set, from the lowest.
fn each_run(mut bits: u32, mut run: impl FnMut(i32, i32)) {
    while bits != 0 {
        let from = bits.trailing_zeros();
        let to = from + (bits >> from).trailing_ones();
        bits &= !((1 << to) - 1);
        run(from as i32, to as i32);
    }
}

/// Receives the covered area of one shape, pixel by pixel.
///
/// As with [`Sink`], the order of the calls is not specified but always the same, and each pixel is
/// named at most once per call of [`Shape::rasterize_area`](crate::Shape::rasterize_area).
///
/// A simple sink has `run` and `pixel`; a quick one has `row` as well, which takes the pixels along
/// an edge in one go. Which call a pixel comes in depends on the clip, its area does not: `row` may
/// hold pixels that are covered whole, and some that are not covered at all.
pub trait AreaSink {
    /// Every pixel in `rect`, which is not empty, is covered whole.
    fn block(&mut self, rect: IntRect) {
        for y in rect.y0..rect.y1 {
            self.run(y, rect.x0, rect.x1);
        }
    }

    /// The pixels `x0..x1` of row `y` are covered whole; `x0 < x1`.
    fn run(&mut self, y: i32, x0: i32, x1: i32);

    /// The pixels `x0..x1` of row `y` are covered by the same part; `x0 < x1`, 0 < `area` < 1.
    fn span(&mut self, y: i32, x0: i32, x1: i32, area: f32) {
        for x in x0..x1 {
            self.pixel(x, y, area);
        }
    }

    /// The pixels of row `y` from `x0` on are covered by these parts, 0 ≤ `area` ≤ 1 each; there is
    /// at least one.
    fn row(&mut self, y: i32, x0: i32, areas: &[f32]) {
        for (x, &area) in (x0..).zip(areas) {
            if area > 0.0 {
                self.pixel(x, y, area);
            }
        }
    }

    /// A part of one pixel is covered, 0 < `area` ≤ 1. Comes from the other methods only.
    fn pixel(&mut self, x: i32, y: i32, area: f32);
}
