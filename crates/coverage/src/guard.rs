//! Clipping to the guard band.
//!
//! What lies beyond ±2²¹ pixels is pushed onto the border of that square, each coordinate clamped
//! by itself. The push moves no point across the inside of the square, so the winding number of
//! everything inside stays. A straight segment becomes a chain: it bends where it crosses one of
//! the four border lines, at the nearest 1/256 pixel to the exact crossing of the snapped segment.
//! The chain is a function of the segment alone, so two shapes that share a segment share the
//! chain.

use crate::FixedPoint;
use crate::fixed::{GUARD, snap_real};
use crate::wide::Wide;
use scumble_geometry::DVec2;

/// Calls `emit` with the points of the clamped chain from `a` (included) to `b` (left out).
pub(crate) fn clamp_segment(a: DVec2, b: DVec2, mut emit: impl FnMut(FixedPoint)) {
    let first = FixedPoint::snap(a);
    emit(first.unwrap_or_else(|| clamp(a)));
    if first.is_some() && FixedPoint::snap(b).is_some() {
        return;
    }
    // A clamped chain never turns back, so the order of its bends is that of their coordinates.
    let mut bends = bends(a, b);
    let signs = ((b.x < a.x), (b.y < a.y));
    let along = |v: i32, back: bool| if back { -v } else { v };
    bends.sort_unstable_by_key(|p| p.map(|p| (along(p.x, signs.0), along(p.y, signs.1))));
    bends.into_iter().flatten().for_each(emit);
}

fn clamp(p: DVec2) -> FixedPoint {
    let guard = f64::from(GUARD);
    FixedPoint {
        x: snap_real(p.x).clamp(-guard, guard) as i32,
        y: snap_real(p.y).clamp(-guard, guard) as i32,
    }
}

/// Where the segment crosses the border lines, clamped, in no order.
fn bends(a: DVec2, b: DVec2) -> [Option<FixedPoint>; 4] {
    let lines = [(true, -GUARD), (true, GUARD), (false, -GUARD), (false, GUARD)];
    lines.map(|(upright, line)| {
        let turn = |p: DVec2| if upright { p } else { DVec2::new(p.y, p.x) };
        let (a, b) = (turn(a), turn(b));
        let (low, high) = if a.x < b.x { (a, b) } else { (b, a) };
        let at = f64::from(line) / 256.0;
        if !(low.x < at && at < high.x) {
            return None;
        }
        let across = crossing([low.x, low.y], [high.x, high.y], line);
        let (x, y) = if upright { (line, across) } else { (across, line) };
        Some(FixedPoint { x, y })
    })
}

/// y at x = `line` of the snapped segment: floor(y + ½) in 1/256 pixel, held to the guard band.
fn crossing(low: [f64; 2], high: [f64; 2], line: i32) -> i32 {
    // The first y of the band with y + ½ beyond the crossing, between `outside` and `inside`.
    let (mut before, mut found) = (-GUARD - 1, GUARD);
    let beyond = Beyond::new(low.map(Wide::snap), high.map(Wide::snap), line);
    while found - before > 1 {
        let middle = before + (found - before) / 2;
        if beyond.test(middle) {
            found = middle;
        } else {
            before = middle;
        }
    }
    found
}

/// Whether a point of the line lies beyond the crossing: the sign of a determinant.
struct Beyond {
    run: Wide,
    low_y: Wide,
    /// (y₁ − y₀) (line − x₀).
    level: (bool, [u64; Wide::PRODUCT]),
}

impl Beyond {
    /// The ends carry one bit after the point, so that halves are whole.
    fn new(low: [Wide; 2], high: [Wide; 2], line: i32) -> Self {
        let rise = high[1].minus(&low[1]);
        let part = Wide::from_i64(2 * i64::from(line)).minus(&low[0]);
        Self { run: high[0].minus(&low[0]), level: rise.times(&part), low_y: low[1] }
    }

    /// (x₁ − x₀) (y + ½ − y₀) > (y₁ − y₀) (line − x₀)
    fn test(&self, y: i32) -> bool {
        let y = Wide::from_i64(2 * i64::from(y) + 1).minus(&self.low_y);
        let value = self.run.times(&y);
        match (value.0, self.level.0) {
            (false, true) => true,
            (true, false) => false,
            (false, false) => value.1.iter().rev().gt(self.level.1.iter().rev()),
            (true, true) => value.1.iter().rev().lt(self.level.1.iter().rev()),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn chain(a: [f64; 2], b: [f64; 2]) -> Vec<[i32; 2]> {
        let mut out = Vec::new();
        clamp_segment(a.into(), b.into(), |p| out.push([p.x, p.y]));
        out
    }

    #[test]
    fn what_lies_inside_stays() {
        assert_eq!(chain([1.5, -2.0], [3.0, 4.0]), [[384, -512]]);
        let edge = f64::from(GUARD) / 256.0;
        assert_eq!(chain([edge, 0.0], [0.0, -edge]), [[GUARD, 0]]);
    }

    #[test]
    fn diagonals_of_any_length_meet_the_corners_and_the_middle() {
        for far in [3e6, 1e12, 1e17, 1e30, 1e300, 1.7e308] {
            let down = chain([-far, -far], [far, far]);
            assert_eq!(down.first(), Some(&[-GUARD, -GUARD]));
            assert!(down.iter().all(|p| p[0] == p[1]), "{down:?}");
            let up = chain([far, -far], [-far, far]);
            assert!(up.iter().all(|p| p[0] == -p[1]), "{up:?}");
            // Level, and a little off.
            assert_eq!(chain([-far, 7.25], [far, 7.25])[1..], [[-GUARD, 1856], [GUARD, 1856]]);
        }
    }

    #[test]
    fn a_crossing_is_that_of_whole_numbers() {
        let mut state = 1u64;
        let mut random = |bits: u32| {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1);
            ((state >> 16) as i64) % (1 << bits)
        };
        for bits in [32, 36, 40, 44] {
            for _ in 0..200 {
                let low = [-(1 << 29) - 1 - random(bits).abs(), random(bits)];
                let high = [-(1 << 29) + 1 + random(bits).abs(), random(bits)];
                let real = |p: [i64; 2]| p.map(|v| v as f64 / 256.0);
                let found = crossing(real(low), real(high), -GUARD);
                let run = i128::from(high[0] - low[0]);
                let rise = i128::from(high[1] - low[1]) * i128::from(-i64::from(GUARD) - low[0]);
                let exact = i128::from(low[1]) + (2 * rise + run).div_euclid(2 * run);
                let guard = i128::from(GUARD);
                assert_eq!(i128::from(found), exact.clamp(-guard, guard));
            }
        }
    }

    #[test]
    fn a_chain_is_the_same_both_ways() {
        let (a, b) = ([-5e6, 1.3e6], [7e7, -9e6]);
        let mut there = chain(a, b);
        let mut back = chain(b, a);
        there.extend(chain(b, b).first());
        back.extend(chain(a, a).first());
        back.reverse();
        assert_eq!(there, back);
        assert!(there.len() > 2);
    }
}
