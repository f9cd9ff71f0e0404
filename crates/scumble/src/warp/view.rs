//! What of a homography can be seen: the horizon, and the lines that bound the source.

use crate::geometry::{DVec2, Homography};
use std::ops::Range;

/// A line a·x + b·y + c = 0 of the output, by its coefficients.
pub(super) type Line = [f64; 3];

/// Pixels around a line within which pixels are looked at one by one.
const MARGIN: f64 = 4.0;

/// How the source lies in the output under a homography from the output.
#[derive(Debug, Clone)]
pub(super) struct View {
    map: Homography,
    /// Positive before the eye, in pixels; `None` if all of the output lies there.
    horizon: Option<Line>,
    /// Positive up to some pixels outside of the source; none if it has no end.
    bounds: Vec<Line>,
}

impl View {
    /// The view of a source, which may have no end.
    pub(super) fn new(map: Homography, size: Option<[usize; 2]>) -> Self {
        let [u, v, w] = map.m;
        let up_to = |edge: usize, row: Line| {
            let edge = edge as f64;
            core::array::from_fn(|k| edge * w[k] - row[k])
        };
        let bounds = size.map_or(Vec::new(), |[width, height]| {
            let edges = [u, v, up_to(width, u), up_to(height, v)];
            edges.into_iter().map(|line| moved(line, MARGIN)).collect()
        });
        let length = length(&w);
        let horizon = (length > 0.0).then(|| w.map(|c| c / length));
        Self { map, horizon, bounds }
    }

    /// Whether the eye sees nothing at all.
    pub(super) fn is_blind(&self) -> bool {
        let ahead = self.map.m[2][2] > 0.0;
        self.horizon.is_none() && !ahead
    }

    /// Of `count` pixels of a row from `start` on, those that may see something of the source and are
    /// not near the horizon.
    pub(super) fn clear(&self, start: DVec2, count: usize) -> Range<usize> {
        let ahead = self.ahead(start, count);
        self.bounds.iter().map(|line| positive(line, start, count)).fold(ahead, intersect)
    }

    /// Those that lie well before the horizon.
    pub(super) fn ahead(&self, start: DVec2, count: usize) -> Range<usize> {
        match &self.horizon {
            Some(line) => positive(&moved(*line, -MARGIN), start, count),
            None => 0..count,
        }
    }

    /// Those that lie near the horizon and are not wholly behind it.
    pub(super) fn near(&self, start: DVec2, count: usize) -> Range<usize> {
        let Some(line) = &self.horizon else { return 0..0 };
        let (seen, ahead) = (positive(&moved(*line, 0.5), start, count), self.ahead(start, count));
        // Both end, or both begin, where the row does.
        if ahead.is_empty() {
            seen
        } else if ahead.start > seen.start {
            seen.start..ahead.start
        } else {
            ahead.end..seen.end
        }
    }

    /// Where to sample a pixel whose centre is `p`, and how much of it lies before the horizon: in a
    /// pixel that the horizon cuts, the middle of that part.
    pub(super) fn part(&self, p: DVec2) -> (DVec2, f64) {
        let Some(line) = &self.horizon else { return (p, 1.0) };
        let share = (at(line, p) + 0.5).clamp(0.0, 1.0);
        (p + DVec2::new(line[0], line[1]) * (0.5 * (1.0 - share)), share)
    }

    /// Whether no pixel with its centre between some corners sees anything of the source.
    pub(super) fn misses(&self, corners: &[DVec2]) -> bool {
        self.bounds.iter().any(|line| corners.iter().all(|p| at(line, *p) <= 0.0))
    }
}

fn at(line: &Line, p: DVec2) -> f64 {
    line[0] * p.x + line[1] * p.y + line[2]
}

fn length(line: &Line) -> f64 {
    (line[0] * line[0] + line[1] * line[1]).sqrt()
}

/// The line, so many pixels further out.
fn moved(line: Line, by: f64) -> Line {
    let [a, b, c] = line;
    [a, b, c + by * length(&line)]
}

/// Of `count` pixels from `start` on, those on the positive side of a line. Rounded sums and products
/// of what grows grow as well, so there is one place where the sign changes.
fn positive(line: &Line, start: DVec2, count: usize) -> Range<usize> {
    let value = |i: usize| at(line, DVec2::new(start.x + i as f64, start.y));
    let falls = line[0] < 0.0;
    let (mut low, mut high) = (0, count);
    while low < high {
        let middle = low.midpoint(high);
        if (value(middle) > 0.0) == falls { low = middle + 1 } else { high = middle }
    }
    if falls { 0..low } else { low..count }
}

fn intersect(a: Range<usize>, b: Range<usize>) -> Range<usize> {
    let start = a.start.max(b.start);
    start..a.end.min(b.end).max(start)
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn runs_are_the_pixels_on_one_side(
            line in prop::array::uniform3(-2.0..2.0f64), x in -50..50i32, y in -50..50i32,
            count in 0..200usize, level in any::<bool>(),
        ) {
            let line = if level { [0.0, line[1], line[2]] } else { line };
            let start = DVec2::new(f64::from(x) + 0.5, f64::from(y) + 0.5);
            let run = positive(&line, start, count);
            for i in 0..count {
                let value = at(&line, DVec2::new(start.x + i as f64, start.y));
                prop_assert_eq!(run.contains(&i), value > 0.0, "{} {:?}", i, run);
            }
        }

        #[test]
        fn near_and_ahead_are_what_is_before_the_horizon(
            g in -0.1..0.1f64, h in -0.1..0.1f64, k in -2.0..2.0f64, y in 0..50i32,
        ) {
            let map = Homography::new([[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [g, h, k]]);
            let view = View::new(map, None);
            let start = DVec2::new(0.5, f64::from(y) + 0.5);
            let (near, ahead) = (view.near(start, 100), view.ahead(start, 100));
            for i in 0..100 {
                let p = DVec2::new(start.x + i as f64, start.y);
                let seen = view.part(p).1 > 0.0;
                prop_assert!(!(near.contains(&i) && ahead.contains(&i)));
                // The last bit may differ where both are as good as 0.
                let close = (map.project_homogeneous(p).z / g.hypot(h) + 0.5).abs() < 1e-9;
                prop_assert!(close || seen == (near.contains(&i) || ahead.contains(&i)), "{}", i);
                if ahead.contains(&i) {
                    prop_assert_eq!(view.part(p), (p, 1.0));
                }
            }
        }
    }
}
