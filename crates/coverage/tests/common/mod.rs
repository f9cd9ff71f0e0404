//! The definition of coverage, as slowly as it can be said, and helpers around it.
#![allow(dead_code, missing_docs, clippy::unwrap_used)]

pub(crate) mod mesh;

use proptest::prelude::*;
use scumble_coverage::*;
use std::collections::BTreeMap;

/// Collects what a rasterizer names, and insists on what a sink may rely on.
#[derive(Debug, Default, Clone, PartialEq, Eq)]
pub(crate) struct Collected {
    pub(crate) masks: BTreeMap<(i32, i32), u64>,
    pub(crate) full: u64,
}

impl Collected {
    pub(crate) fn new(pattern: &SamplePattern) -> Self {
        Self { masks: BTreeMap::new(), full: pattern.full_mask().0 }
    }
}

impl Sink for Collected {
    fn block(&mut self, rect: IntRect) {
        assert!(!rect.is_empty(), "an empty block {rect:?}");
        for y in rect.y0..rect.y1 {
            self.run(y, rect.x0, rect.x1);
        }
    }
    fn run(&mut self, y: i32, x0: i32, x1: i32) {
        assert!(x0 < x1, "an empty run");
        for x in x0..x1 {
            assert_eq!(self.masks.insert((x, y), self.full), None, "pixel {x}, {y} named twice");
        }
    }
    fn pixel(&mut self, x: i32, y: i32, mask: SampleMask) {
        assert!(mask.0 != 0 && mask.0 != self.full && mask.0 & !self.full == 0, "{mask:?}");
        assert_eq!(self.masks.insert((x, y), mask.0), None, "pixel {x}, {y} named twice");
    }
}

/// The same by squares of pixels, where they can come.
pub(crate) struct BySquares(pub(crate) Collected);

impl Sink for BySquares {
    const SQUARES: bool = true;

    fn block(&mut self, rect: IntRect) {
        self.0.block(rect);
    }
    fn run(&mut self, y: i32, x0: i32, x1: i32) {
        self.0.run(y, x0, x1);
    }
    fn pixel(&mut self, x: i32, y: i32, mask: SampleMask) {
        self.0.pixel(x, y, mask);
    }
    fn whole(&mut self, x: i32, y: i32, pixels: u64) {
        assert!(pixels != 0 && self.0.full == 1, "{pixels:x}");
        self.0.whole(x, y, pixels);
    }
    fn parts(&mut self, x: i32, y: i32, rows: &[u32; 8]) {
        assert!(*rows != [0; 8] && self.0.full == 15, "{rows:x?}");
        self.0.parts(x, y, rows);
    }
}

pub(crate) fn raster(shape: &Shape, clip: IntRect, pattern: &SamplePattern) -> Collected {
    let mut out = Collected::new(pattern);
    shape.rasterize(clip, pattern, &mut Scratch::new(), &mut out);
    out
}

/// The winding number around (x, y) in 1/256 pixel, by rational arithmetic: crossings of the ray
/// to the left, half-open in y, counted if at or left of the point.
pub(crate) fn winding(contours: &[Vec<[i64; 2]>], x: i64, y: i64) -> i32 {
    let mut sum = 0;
    for contour in contours {
        for (i, p) in contour.iter().enumerate() {
            let q = contour[(i + 1) % contour.len()];
            let (top, bottom, w) = if p[1] < q[1] { (*p, q, 1) } else { (q, *p, -1) };
            if !(top[1] <= y && y < bottom[1]) {
                continue;
            }
            // x0 + (y − y0) dx / dy ≤ x, multiplied out.
            let (dx, dy) = (i128::from(bottom[0] - top[0]), i128::from(bottom[1] - top[1]));
            if i128::from(y - top[1]) * dx <= i128::from(x - top[0]) * dy {
                sum += w;
            }
        }
    }
    sum
}

pub(crate) fn oracle(
    contours: &[Vec<[i64; 2]>],
    rule: FillRule,
    clip: IntRect,
    pattern: &SamplePattern,
) -> Collected {
    let mut out = Collected::new(pattern);
    for y in clip.y0..clip.y1 {
        for x in clip.x0..clip.x1 {
            let mut mask = 0;
            for (s, o) in pattern.offsets().iter().enumerate() {
                let at = |p: i32, o: u8| i64::from(p) * 256 + i64::from(o);
                let w = winding(contours, at(x, o[0]), at(y, o[1]));
                let inside = match rule {
                    FillRule::NonZero => w != 0,
                    FillRule::EvenOdd => w % 2 != 0,
                };
                mask |= u64::from(inside) << s;
            }
            if mask != 0 {
                out.masks.insert((x, y), mask);
            }
        }
    }
    out
}

pub(crate) fn to_points(contour: &[[i64; 2]]) -> Vec<DVec2> {
    contour.iter().map(|p| DVec2::new(p[0] as f64 / 256.0, p[1] as f64 / 256.0)).collect()
}

pub(crate) fn triangle(p: &[[i64; 2]]) -> Option<Shape> {
    let p = to_points(p);
    Shape::triangle([p[0], p[1], p[2]]).unwrap()
}

pub(crate) fn polygon(contours: &[Vec<[i64; 2]>], rule: FillRule) -> Option<Shape> {
    let points: Vec<_> = contours.iter().map(|c| to_points(c)).collect();
    Shape::polygon(points.iter().map(Vec::as_slice), rule).unwrap()
}

/// A coordinate in 1/256 pixel near the window, often on pixel corners, centres and sample heights.
pub(crate) fn coordinate(pixels: i64) -> impl Strategy<Value = i64> {
    let span = pixels * 256;
    prop_oneof![
        3 => -256..span + 256,
        2 => (-2..2 * pixels + 2).prop_map(|v| v * 128),
        2 => (-16..16 * pixels + 16).prop_map(|v| v * 16),
        1 => -100 * span..100 * span,
    ]
}

pub(crate) fn point(pixels: i64) -> impl Strategy<Value = [i64; 2]> {
    [coordinate(pixels), coordinate(pixels)]
}

pub(crate) fn any_pattern() -> impl Strategy<Value = SamplePattern> {
    prop_oneof![
        prop::sample::select(vec![1, 2, 4, 8, 16])
            .prop_map(|n| SamplePattern::standard(n).unwrap()),
        prop::sample::select(vec![1, 4, 9, 16, 25, 36, 49, 64])
            .prop_map(|n| SamplePattern::grid(n).unwrap()),
        prop::collection::vec(any::<[u8; 2]>(), 1..=64)
            .prop_map(|o| SamplePattern::custom(&o).unwrap()),
    ]
}

pub(crate) fn rule() -> impl Strategy<Value = FillRule> {
    prop::sample::select(vec![FillRule::NonZero, FillRule::EvenOdd])
}

/// A window away from the origin, so that negative pixels are looked at as well.
pub(crate) const WINDOW: IntRect = IntRect::new(-3, -2, 21, 19);

/// Every instruction set that this machine has.
pub(crate) fn levels() -> Vec<Level> {
    let best = Level::new();
    #[cfg(target_arch = "x86_64")]
    let mut levels: Vec<Level> = [
        best.as_sse2().map(Level::Sse2),
        best.as_sse4_2().map(Level::Sse4_2),
        best.as_avx2().map(Level::Avx2),
    ]
    .into_iter()
    .flatten()
    .collect();
    #[cfg(not(target_arch = "x86_64"))]
    let mut levels = vec![Level::baseline()];
    levels.push(best);
    levels
}
