//! The other ways to find what a shape covers: the definition, and the rivals of the tiled way.

mod order;
mod scanline;

pub use order::Order;

use crate::edge::Edge;
use crate::triangle::Triangle;
use crate::{SampleMask, SamplePattern, Sink};
use order::Visit;
use scumble_geometry::IntRect;

/// How to find the samples that a shape covers. All give the same samples; they differ in the time
/// they take and in the order of the calls to the sink.
///
/// [`Shape::rasterize`](crate::Shape::rasterize) is [`Traversal::Tiled`], the one to use. The
/// others are for tests, measurement and teaching. Polygons know two: [`Traversal::BoundingBox`] is
/// their definition, and every other stands for the sweep over crossings.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default)]
pub enum Traversal {
    /// Blocks of 8 × 8 pixels, accepted or rejected whole where possible.
    #[default]
    Tiled,
    /// Every sample in the bounding box, each by itself: the definition in scalar arithmetic.
    BoundingBox,
    /// Per row of samples, the range between the exact crossings of the edges.
    Scanline,
    /// From pixel to pixel, the edge functions carried along by additions (Pineda, "A Parallel
    /// Algorithm for Polygon Rasterization", SIGGRAPH 1988). The sink hears of the pixels one by
    /// one, in the given order.
    Incremental(Order),
}

impl Triangle {
    /// Any way but the tiled one. `region` lies within the bounds and is not empty.
    pub(crate) fn traverse(
        &self,
        traversal: Traversal,
        region: IntRect,
        pattern: &SamplePattern,
        sink: &mut impl Sink,
    ) {
        let edges = self.edges();
        match traversal {
            Traversal::Scanline => scanline::rasterize(&edges, region, pattern, sink),
            Traversal::Incremental(order) => {
                let mut walker = Walker::new(&edges, region, pattern, sink);
                order.visit(region, &mut walker);
            }
            Traversal::BoundingBox | Traversal::Tiled => {
                for y in region.y0..region.y1 {
                    for x in region.x0..region.x1 {
                        emit(sink, pattern, (x, y), direct_mask(&edges, pattern, x, y));
                    }
                }
            }
        }
    }
}

/// The samples of pixel (x, y), by the definition.
fn direct_mask(edges: &[Edge; 3], pattern: &SamplePattern, x: i32, y: i32) -> SampleMask {
    let mut mask = 0;
    for (s, o) in pattern.offsets().iter().enumerate() {
        let sx = i64::from(x) * 256 + i64::from(o[0]);
        let sy = i64::from(y) * 256 + i64::from(o[1]);
        mask |= u64::from(edges.iter().all(|e| e.at(sx, sy) >= 0)) << s;
    }
    SampleMask(mask)
}

/// Names one pixel to the sink.
pub(crate) fn emit(
    sink: &mut impl Sink,
    pattern: &SamplePattern,
    at: (i32, i32),
    mask: SampleMask,
) {
    if mask == pattern.full_mask() {
        sink.run(at.1, at.0, at.0 + 1);
    } else if !mask.is_empty() {
        sink.pixel(at.0, at.1, mask);
    }
}

/// Carries the edge functions from pixel to pixel.
struct Walker<'a, K> {
    edges: &'a [Edge; 3],
    pattern: &'a SamplePattern,
    sink: &'a mut K,
    /// Where it stands, and E at that pixel's corner.
    at: (i32, i32),
    values: [i64; 3],
}

impl<'a, K: Sink> Walker<'a, K> {
    fn new(
        edges: &'a [Edge; 3],
        region: IntRect,
        pattern: &'a SamplePattern,
        sink: &'a mut K,
    ) -> Self {
        let values = edges.map(|e| e.at(i64::from(region.x0) << 8, i64::from(region.y0) << 8));
        Self { edges, pattern, sink, at: (region.x0, region.y0), values }
    }
}

impl<K: Sink> Visit for Walker<'_, K> {
    fn step(&mut self, x: i32, y: i32) -> bool {
        let (dx, dy) = (i64::from(x - self.at.0) << 8, i64::from(y - self.at.1) << 8);
        self.at = (x, y);
        let mut touched = true;
        for (v, e) in self.values.iter_mut().zip(self.edges) {
            *v += dx * e.a + dy * e.b;
            // The largest value in the pixel.
            touched &= *v + 255 * (e.a.max(0) + e.b.max(0)) >= 0;
        }
        touched
    }

    fn look(&mut self) {
        let mut mask = 0;
        for (s, o) in self.pattern.offsets().iter().enumerate() {
            let at = |k: usize| {
                let e = &self.edges[k];
                self.values[k] + e.a * i64::from(o[0]) + e.b * i64::from(o[1])
            };
            mask |= u64::from(at(0) >= 0 && at(1) >= 0 && at(2) >= 0) << s;
        }
        emit(self.sink, self.pattern, self.at, SampleMask(mask));
    }
}
