//! The inner sides of joins, cut where they cross.
//!
//! On the inner side of a join, the side of the segment before ends beyond that of the next one,
//! which begins behind it. To go around by their ends is right, since what lies between these, the
//! corner and the crossing is in both segments: the outline winds around it once for each, and once
//! less for the way around. So it may as well turn at the crossing: it still winds around all of that
//! once, takes fewer edges, and does not cross itself.

use crate::DVec2;
use alloc::vec::Vec;

/// By how much a side may be longer than it is on the other side of the middle line, per unit that these
/// are apart: sides that meet in one point are cut at half the angle of the bend, of which the cosine is
/// [`WIDEST_BEND`](super::WIDEST_BEND) at the least.
const SLANT: f64 = 0.375;

/// Where segments are joined on their inner side, by rising place.
#[derive(Debug, Default)]
pub(super) struct InnerJoins(Vec<Place>);

/// Places in the list of a side's points.
#[derive(Debug, Clone, Copy)]
struct Place {
    /// The end of the side of the segment before.
    end: usize,
    /// Where that of the next one begins.
    begin: usize,
}

impl InnerJoins {
    pub(super) fn clear(&mut self) {
        self.0.clear();
    }

    /// The last point of a side ends one; the next that is pushed begins one. `corner` is pushed in
    /// between, if there is one.
    pub(super) fn push(&mut self, side: &mut Vec<DVec2>, corner: Option<DVec2>) {
        let end = side.len().saturating_sub(1);
        side.extend(corner);
        self.0.push(Place { end, begin: side.len() });
    }

    /// Cuts the joins of a side that is complete; where that is the same for the eye, within `tolerance`.
    /// A place beyond the last point is the first one's.
    pub(super) fn cut(&self, side: &mut [DVec2], tolerance: f64) {
        for place in &self.0 {
            let begin = if place.begin < side.len() { place.begin } else { 0 };
            let (Some(&p), Some(&q)) = (side.get(place.end), side.get(begin)) else { continue };
            // Points may be repeated.
            let from = side[..place.end].iter().rposition(|&a| a != p);
            let to = side[begin..].iter().position(|&b| b != q).map(|skip| begin + skip);
            let (Some(from), Some(to)) = (from, to) else { continue };
            let turn = if (q - p).length_squared() <= tolerance * tolerance {
                Some(p)
            } else {
                crossing([side[from], p], [q, side[to]])
            };
            let Some(turn) = turn else { continue };
            // With the same point repeated the places of the others stay what they are.
            let end = if begin > place.end { begin } else { side.len() };
            side[from + 1..end].fill(turn);
            side[begin..to].fill(turn);
        }
    }
}

/// Where two sides cross, if each ends within the other's segment.
fn crossing([a, p]: [DVec2; 2], [q, b]: [DVec2; 2]) -> Option<DVec2> {
    let (before, after) = (p - a, b - q);
    // How far into a segment a point lies, seen from the far end of the side.
    let is_within =
        |offset: DVec2, side: DVec2| offset.dot(side) >= offset.perp_dot(side).abs() * SLANT;
    if !(is_within(q - a, before) && is_within(p - b, -after)) {
        return None;
    }
    let across = before.perp_dot(after);
    let [s, t] = [after, before].map(|v| (q - a).perp_dot(v) / across);
    let is_part = |v: f64| (0.0..=1.0).contains(&v);
    (is_part(s) && is_part(t)).then(|| a + before * s)
}
