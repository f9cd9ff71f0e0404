use crate::canvas::Canvas;
use crate::math::octaves;

/// Grey noise with a 1/f spectrum: seven octaves, each half as high, so that every scale carries
/// the same contrast and any aliasing shows as grain. Repeats without a seam.
pub(crate) fn draw() -> Canvas {
    Canvas::paint(256, 256, 1, |x, y| {
        let v = octaves(x / 64.0, y / 64.0, 4, 7, 0.62, 41);
        [((v - 0.5) * 1.9 + 0.5).clamp(0.0, 1.0); 3]
    })
}
