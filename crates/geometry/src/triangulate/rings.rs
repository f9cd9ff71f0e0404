use super::grid::{GUARD_PX, GridPoint, orient};
use crate::{DVec2, Rect, clip_polygon_to_rect};
use alloc::vec::Vec;

/// Closed contours on the grid: no two equal points in a row, no three on a line in a row, at
/// least three points each.
#[derive(Debug, Default)]
pub(super) struct Rings {
    pub(super) points: Vec<GridPoint>,
    /// Just past the last point of each ring.
    pub(super) ends: Vec<usize>,
}

impl Rings {
    /// Snaps contours to the grid and takes out what encloses nothing.
    pub(super) fn snap<'a>(contours: impl IntoIterator<Item = &'a [DVec2]>) -> Self {
        let guard = Rect::new(-GUARD_PX, -GUARD_PX, GUARD_PX, GUARD_PX);
        let (mut clipped, mut scratch) = (Vec::new(), Vec::new());
        let mut rings = Self::default();
        for contour in contours {
            // A NaN fails the comparison, and is then seen to by the clipping.
            if contour.iter().all(|p| p.abs().max_element() <= GUARD_PX && !p.is_nan()) {
                rings.push(&cleaned(contour.iter().copied()));
            } else {
                clipped.clear();
                clipped.extend_from_slice(contour);
                clip_polygon_to_rect(&mut clipped, guard, &mut scratch);
                rings.push(&cleaned(clipped.iter().copied()));
            }
        }
        rings
    }

    /// Appends a ring; one that encloses nothing is left out.
    pub(super) fn push(&mut self, ring: &[GridPoint]) {
        if ring.len() >= 3 {
            self.points.extend_from_slice(ring);
            self.ends.push(self.points.len());
        }
    }

    /// The first index and the points of each ring.
    pub(super) fn iter(&self) -> impl Iterator<Item = (usize, &[GridPoint])> {
        let starts = core::iter::once(0).chain(self.ends.iter().copied());
        starts.zip(&self.ends).map(|(start, &end)| (start, &self.points[start..end]))
    }

    /// The ring, if there is only one and it is convex.
    pub(super) fn single_convex(&self) -> Option<&[GridPoint]> {
        (self.ends.len() == 1 && is_convex(&self.points)).then_some(&self.points)
    }
}

/// Whether a ring always turns the same way, and once around only.
fn is_convex(ring: &[GridPoint]) -> bool {
    let n = ring.len();
    let at = |i: usize| ring[i % n];
    let clockwise = orient(ring[0], ring[1], ring[2]) > 0;
    let mut direction_changes = 0;
    for i in 0..n {
        if (orient(at(i), at(i + 1), at(i + 2)) > 0) != clockwise {
            return false;
        }
        // Going forward or backward in the order of the sweep: twice around would change 4 times.
        let forward = |i: usize| at(i) < at(i + 1);
        direction_changes += u32::from(forward(i) != forward(i + 1));
    }
    direction_changes == 2
}

/// The ring without duplicates, straight runs and spikes: none of them encloses anything.
fn cleaned(points: impl Iterator<Item = DVec2>) -> Vec<GridPoint> {
    let mut ring: Vec<GridPoint> = Vec::new();
    for p in points.map(GridPoint::snap) {
        while let [.., a, b] = ring[..]
            && orient(a, b, p) == 0
        {
            ring.pop();
        }
        if ring.last() != Some(&p) {
            ring.push(p);
        }
    }
    // The seam between the last point and the first, which may unravel from both sides.
    let mut first = 0;
    while let [a, b, .., y, z] = ring[first..] {
        if z == a || orient(y, z, a) == 0 {
            ring.pop();
        } else if orient(z, a, b) == 0 {
            first += 1;
        } else {
            break;
        }
    }
    ring.drain(..first);
    let flat = ring.len() < 3 || (ring.len() == 3 && orient(ring[0], ring[1], ring[2]) == 0);
    if flat { Vec::new() } else { ring }
}
