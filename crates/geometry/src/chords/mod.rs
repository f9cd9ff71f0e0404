//! Chords for a Bézier curve in the plane.
//!
//! With vertices *on* the curve all of it lies on one side of its chords, away by up to the sagitta:
//! h²/8 times the second derivative across the chord, for a range h of the parameter. With vertices
//! half a sagitta *outside*, the chords leave it by as much on either side. So the same tolerance
//! allows a sagitta twice as large, hence 0.71 times the chords, and the area that they add on one
//! side makes up for most of what they take on the other.
//!
//! Where the vertices go is estimated: at equal parts of the integral of √(second derivative across
//! the curve) ([`Density`]). That the chords keep the tolerance is not: each is looked at ([`Span`]).
//! If one fails there are some more of them, and then two halves, each by itself.

#[cfg(test)]
mod definition;
mod density;
mod span;
mod wide;

use crate::flatten::halve;
use crate::math::sqrt;
use crate::{DVec2, Path};
use alloc::vec::Vec;
use density::{Density, END_STEP, count};
use fearless_simd::{Level, Simd, dispatch, f64x8, prelude::*};
use span::{Cubic, Spans, Vertices};
use wide::{LANES, lanes, splat};

/// Finds chords for curves, one after the other in the same memory.
pub(crate) struct Chords<F> {
    tolerance: f64,
    /// Half the width of the stroke, 0 for a fill. Its sides turn by so little at each point that they
    /// keep about as near to theirs as the chords to the curve.
    radius: f64,
    /// Tells of a tangent at either end of a curve, and of the chord there, whether that will do.
    fits: F,
    level: Level,
    places: Vec<f64>,
    /// Where chords end, first by first, and then as many more as fill vectors.
    xs: Vec<f64>,
    ys: Vec<f64>,
}

/// Whether a piece of a curve begins and ends where the whole does.
type Ends = [bool; 2];

impl<F: Fn(DVec2, DVec2) -> bool> Chords<F> {
    pub(crate) fn new(tolerance: f64, radius: f64, fits: F) -> Self {
        #[cfg(feature = "std")]
        let level = Level::new();
        #[cfg(not(feature = "std"))]
        let level = Level::baseline();
        Self::with_level(tolerance, radius, fits, level)
    }

    fn with_level(tolerance: f64, radius: f64, fits: F, level: Level) -> Self {
        let (places, xs, ys) = Default::default();
        Self { tolerance, radius, fits, level, places, xs, ys }
    }

    /// Pushes the points of a curve after its first. Its chords leave it, and it leaves its chords, by
    /// no more than the tolerance, unless that takes more points than there is `room` for. Those of
    /// the reversed curve are the same to the bit.
    pub(crate) fn push<const N: usize>(
        &mut self,
        curve: &[DVec2; N],
        room: usize,
        out: &mut Vec<DVec2>,
    ) {
        let (begin, most) = (out.len(), room.clamp(1, 1 << Path::MAX_DEPTH));
        let mut curve = as_cubic(curve);
        let end = curve[3];
        // Always in the direction that has the lesser start.
        let is_reversed = key(&curve) > key(&[curve[3], curve[2], curve[1], curve[0]]);
        if is_reversed {
            curve.reverse();
        }
        self.push_piece(&curve, [true; 2], most as u32, out);
        if is_reversed {
            out.pop();
            out[begin..].reverse();
            out.push(end);
        }
    }

    /// Pushes the points of a piece after its first, but no more than `most`.
    fn push_piece(&mut self, curve: &[DVec2; 4], ends: Ends, most: u32, out: &mut Vec<DVec2>) {
        let cubic = Cubic::new(curve);
        // With even steps h, curve and chord are h²/16 times the largest second derivative apart.
        let even = sqrt(cubic.largest_acceleration() / (16.0 * self.tolerance));
        let even_count = count(even);
        let is_flat = || even_count <= 1 && self.ends_fit(curve, ends, [curve[3], curve[0]]);
        // Numbers beyond all bounds end here as well.
        if most == 1 || !even.is_finite() || is_flat() {
            return out.push(curve[3]);
        }
        let density = self.density(&cubic);
        let least = count(density.steps());
        // Rather all of a curve coarser than its end, if there are too many.
        if least > most || self.radius == 0.0 && least >= even_count {
            return step_evenly(&cubic, even_count.min(most), out);
        }
        for count in [least, least + 1 + least / 8] {
            if count <= most && self.place(&cubic, &density, count) {
                let inner = count as usize - 1;
                let at = |i: usize| DVec2::new(self.xs[i], self.ys[i]);
                let last = inner.checked_sub(1).map_or(curve[0], at);
                let first = if inner > 0 { at(0) } else { curve[3] };
                if self.ends_fit(curve, ends, [first, last]) {
                    out.extend((0..inner).map(at));
                    return out.push(curve[3]);
                }
            }
        }
        let (first, second) = halve(curve);
        self.push_piece(&first, [ends[0], false], most / 2, out);
        self.push_piece(&second, [false, ends[1]], most - most / 2, out);
    }

    /// Whether the chords at the ends of a piece will do, of which one ends at the first point and one
    /// begins at the second.
    fn ends_fit(&self, curve: &[DVec2; 4], ends: Ends, [to, from]: [DVec2; 2]) -> bool {
        let [p0, p1, p2, p3] = *curve;
        let fits = |end: DVec2, others: [DVec2; 3], chord: DVec2| {
            let ahead = others.into_iter().find(|&p| p != end).unwrap_or(end);
            (self.fits)(ahead - end, chord - end)
        };
        (!ends[0] || fits(p0, [p1, p2, p3], to)) && (!ends[1] || fits(p3, [p2, p1, p0], from))
    }

    fn density(&self, cubic: &Cubic) -> Density {
        let Self { tolerance, radius, .. } = *self;
        dispatch!(self.level, simd => Density::new(simd, cubic, tolerance, radius))
    }

    /// Puts the vertices of so many chords where the density tells. Tells whether all chords hold.
    fn place(&mut self, cubic: &Cubic, density: &Density, count: u32) -> bool {
        dispatch!(self.level, simd => self.place_by(simd, cubic, density, count))
    }

    #[inline(always)]
    fn place_by<S: Simd>(&mut self, simd: S, cubic: &Cubic, density: &Density, count: u32) -> bool {
        density.places(simd, count, &mut self.places);
        let count = count as usize;
        let room = count.next_multiple_of(LANES);
        if self.xs.len() < room {
            self.xs.resize(room, 0.0);
            self.ys.resize(room, 0.0);
        }
        let mut before = cubic.start(simd);
        for first in (0..count).step_by(LANES) {
            // Where the chord `first` ends, and those after it.
            let places = &self.places[first..first + LANES + 2];
            let from = f64x8::from_slice(simd, &places[..LANES]);
            let t = f64x8::from_slice(simd, &places[1..=LANES]);
            let to = f64x8::from_slice(simd, &places[2..]);
            let mut ends = cubic.vertices(simd, t, (t - from) * (to - t), self.tolerance);
            let mut is_chord = simd.splat_mask64x8(true);
            if first + LANES >= count {
                let (chord, last) = (lanes(simd), splat(simd, (count - 1 - first) as f64));
                ends = Vertices::select(chord.simd_eq(last), &cubic.end(simd), &ends);
                is_chord = chord.simd_le(last);
            }
            let positions = ends.position();
            positions.x.store_slice(&mut self.xs[first..first + LANES]);
            positions.y.store_slice(&mut self.ys[first..first + LANES]);
            let spans = Spans { from: before.slide(&ends), to: ends };
            if (is_chord & !spans.hold(simd, self.tolerance)).any_true() {
                return false;
            }
            before = ends;
        }
        true
    }
}

/// The same curve as one of degree three.
fn as_cubic<const N: usize>(curve: &[DVec2; N]) -> [DVec2; 4] {
    let inner = |p: DVec2| if N == 3 { (p + curve[1] * 2.0) * (1.0 / 3.0) } else { p };
    let [c0, c1] = if N == 3 { [0, 2] } else { [1, 2] };
    [curve[0], inner(curve[c0]), inner(curve[c1]), curve[N - 1]]
}

/// What orders a curve and its reverse.
fn key(curve: &[DVec2; 4]) -> [f64; 4] {
    [curve[0].x, curve[0].y, curve[1].x, curve[1].y]
}

/// Pushes so many points at equal steps h of the parameter, h²/16 times the second derivative outside.
///
/// Between two of them, for x from −1 to 1, curve and chord are m·(2x² − 1) + d·x·(1 + 2x²)/3 apart,
/// m ± d being what they are at the points: no component is larger than it is at one of those. Neither
/// is it in a step that is [`END_STEP`] times as long and ends on the curve.
fn step_evenly(cubic: &Cubic, count: u32, out: &mut Vec<DVec2>) {
    let step = 1.0 / (f64::from(count) - 2.0 + 2.0 * END_STEP);
    for i in 1..count {
        let t = (f64::from(i - 1) + END_STEP) * step;
        out.push(cubic.at(t) - cubic.acceleration(t) * (step * step / 16.0));
    }
    out.push(cubic.to);
}

#[cfg(test)]
mod tests;
