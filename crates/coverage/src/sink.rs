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
