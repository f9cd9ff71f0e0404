//! Blocks of very large triangles, in 64 bits.

use super::tiled::{BLOCK, Block};
use crate::edge::Edge;
use crate::{SampleMask, SamplePattern, Sink};
use scumble_geometry::IntRect;

/// A triangle with an edge too long for 32 bits inside a block.
pub(super) struct Wide<'a> {
    edges: &'a [Edge; 3],
    pattern: &'a SamplePattern,
    /// E at each sample relative to its pixel's corner.
    offsets: &'a [[i64; 64]; 3],
}

impl<'a> Wide<'a> {
    pub(super) fn new(
        edges: &'a [Edge; 3],
        pattern: &'a SamplePattern,
        offsets: &'a mut [[i64; 64]; 3],
    ) -> Self {
        for (e, offsets) in edges.iter().zip(offsets.iter_mut()) {
            for (out, o) in offsets.iter_mut().zip(pattern.offsets()) {
                *out = e.a * i64::from(o[0]) + e.b * i64::from(o[1]);
            }
        }
        Self { edges, pattern, offsets }
    }

    #[inline(always)]
    fn mask(&self, v: [i64; 3]) -> SampleMask {
        let mut mask = 0;
        let [o0, o1, o2] = self.offsets;
        for s in 0..self.pattern.len() {
            // Negative as soon as one of them is.
            let outside = ((v[0] + o0[s]) | (v[1] + o1[s]) | (v[2] + o2[s])) < 0;
            mask |= u64::from(!outside) << s;
        }
        SampleMask(mask)
    }
}

impl Block for Wide<'_> {
    #[inline(always)]
    fn block(&self, rect: IntRect, sink: &mut impl Sink) {
        debug_assert!(rect.x1 - rect.x0 <= BLOCK);
        let full = self.pattern.full_mask();
        for y in rect.y0..rect.y1 {
            let mut run = None;
            for x in rect.x0..rect.x1 {
                let (px, py) = (i64::from(x) << 8, i64::from(y) << 8);
                let mask = self.mask(self.edges.map(|e| e.at(px, py)));
                if mask == full {
                    // A row of a triangle is one stretch.
                    run = Some((run.map_or(x, |(from, _)| from), x + 1));
                } else if !mask.is_empty() {
                    sink.pixel(x, y, mask);
                }
            }
            if let Some((from, to)) = run {
                sink.run(y, from, to);
            }
        }
    }
}
