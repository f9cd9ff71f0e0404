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
