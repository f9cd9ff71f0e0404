//! Clipping to the guard band.
//!
//! What lies beyond ±2²¹ pixels is pushed onto the border of that square, each coordinate clamped by
//! itself. The push moves no point across the inside of the square, so the winding number of
//! everything inside stays. A straight segment becomes a chain: it bends where it crosses one of
//! the four border lines. The chain is a function of the segment alone, taken in a canonical
//! order of its ends, so two shapes that share a segment share the chain.

use crate::FixedPoint;
use crate::fixed::{GUARD, snap_real};
use scumble_geometry::DVec2;

/// Calls `emit` with the points of the clamped chain from `a` (included) to `b` (left out).
pub(crate) fn clamp_segment(a: DVec2, b: DVec2, mut emit: impl FnMut(FixedPoint)) {
    if let Some(p) = FixedPoint::snap(a)
        && FixedPoint::snap(b).is_some()
    {
        emit(p);
        return;
    }
    emit(clamp(a));
    let forward = (a.x, a.y) < (b.x, b.y);
    let (from, to) = if forward { (a, b) } else { (b, a) };
    let bends = bends(from, to);
    let in_order = |i: usize| if forward { bends[i] } else { bends[3 - i] };
    for bend in (0..4).filter_map(in_order) {
        emit(bend);
    }
}

fn clamp(p: DVec2) -> FixedPoint {
    let guard = f64::from(GUARD);
    FixedPoint {
        x: snap_real(p.x).clamp(-guard, guard) as i32,
        y: snap_real(p.y).clamp(-guard, guard) as i32,
    }
}

/// Where the segment crosses the border lines, in order along it.
fn bends(a: DVec2, b: DVec2) -> [Option<FixedPoint>; 4] {
    let guard = f64::from(GUARD) / 256.0;
    let mut found: [Option<(f64, FixedPoint)>; 4] = [None; 4];
    for (i, slot) in found.iter_mut().enumerate() {
        let line = if i % 2 == 0 { -guard } else { guard };
        let vertical = i < 2;
        let (from, to) = if vertical { (a.x, b.x) } else { (a.y, b.y) };
        if (from < line) == (to < line) {
            continue;
        }
        // Halves, so that the difference of two huge numbers stays finite.
        let t = (line * 0.5 - from * 0.5) / (to * 0.5 - from * 0.5);
        let at = |p: f64, q: f64| p * (1.0 - t) + q * t;
        let p =
            if vertical { DVec2::new(line, at(a.y, b.y)) } else { DVec2::new(at(a.x, b.x), line) };
        *slot = Some((t, clamp(p)));
    }
    found.sort_by(|p, q| {
        let key = |v: &Option<(f64, FixedPoint)>| v.map_or(2.0, |(t, _)| t);
        key(p).total_cmp(&key(q))
    });
    found.map(|v| v.map(|(_, p)| p))
}
