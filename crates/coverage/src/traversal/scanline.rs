//! Scanlines: each row of samples meets the triangle in one range, whose ends are the exact
//! crossings.

use crate::edge::Edge;
use crate::{SampleMask, SamplePattern, Sink};
use scumble_geometry::IntRect;

/// Per sample: the pixels from `first` to before `end` own it.
#[derive(Clone, Copy)]
struct Range {
    first: i32,
    end: i32,
}

pub(super) fn rasterize(
    edges: &[Edge; 3],
    region: IntRect,
    pattern: &SamplePattern,
    sink: &mut impl Sink,
) {
    let mut ranges = [Range { first: 0, end: 0 }; 64];
    let ranges = &mut ranges[..pattern.len()];
    for y in region.y0..region.y1 {
        for row in pattern.rows() {
            let (low, high) = crossings(edges, i64::from(y) * 256 + i64::from(row.y));
            for &s in pattern.samples_of(row) {
                let s = usize::from(s);
                // The first pixel whose sample stands at x or beyond, held to the region.
                let pixel = |x: i64| {
                    let first = (x - i64::from(pattern.offsets()[s][0]) + 255) >> 8;
                    first.clamp(i64::from(region.x0), i64::from(region.x1)) as i32
                };
                ranges[s] = Range { first: pixel(low), end: pixel(high) };
            }
        }
        emit_row(y, ranges, sink);
    }
}

/// The half-open range of x in which all edges have E ≥ 0 at this height.
fn crossings(edges: &[Edge; 3], y: i64) -> (i64, i64) {
    // Beyond any region, and far from overflow.
    let (mut low, mut high) = (-(1 << 40), 1 << 40);
    for e in edges {
        let v = e.b * y + e.c;
        if e.a > 0 {
            low = low.max(-v.div_euclid(e.a));
        } else if e.a < 0 {
            high = high.min(v.div_euclid(-e.a) + 1);
        } else if v < 0 {
            high = low;
        }
    }
    (low, high)
}

fn emit_row(y: i32, ranges: &[Range], sink: &mut impl Sink) {
    let (mut any, mut full) = ((i32::MAX, i32::MIN), (i32::MIN, i32::MAX));
    for r in ranges {
        if r.first < r.end {
            any = (any.0.min(r.first), any.1.max(r.end));
        }
        full = (full.0.max(r.first), full.1.min(r.end));
    }
    if full.0 < full.1 {
        sink.run(y, full.0, full.1);
    } else {
        full = (any.1, any.1);
    }
    for x in (any.0..full.0).chain(full.1..any.1) {
        let mut mask = 0;
        for (s, r) in ranges.iter().enumerate() {
            mask |= u64::from(r.first <= x && x < r.end) << s;
        }
        if mask != 0 {
            sink.pixel(x, y, SampleMask(mask));
        }
    }
}
