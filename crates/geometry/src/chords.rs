//! Chords for a Bézier curve in the plane.
//!
//! A chord over a range h of the parameter leaves the curve, at each parameter, by at most h²/8 times the
//! curve's largest second derivative, which is d(d − 1) times the largest second difference of the control
//! points, d being the degree (Wang, Chen, "Computing the subdivision number of Bézier curves"). But
//! what lies along the chord moves points on it and does not lead away from it. So only what lies across
//! counts in full; what lies along counts by the sine of the angle that a chord may turn from that of the
//! whole curve, since it is then across.
//!
//! One count holds for all of the curve, with equal steps of the parameter. Where its halves take fewer
//! chords together, it is cut in two, and each half is looked at by itself.

use crate::flatten::halve;
use crate::math::sqrt;
use crate::{DVec2, Path};

/// A curve of no more chords than this is not cut in two.
const FEW: u32 = 2;

/// Pushes the points of a curve after its first, so that chords leave it by no more than `tolerance`,
/// but no more than `room` of them. Those of the reversed curve are the same to the bit.
pub(crate) fn push_chords<const N: usize>(
    curve: &[DVec2; N],
    tolerance: f64,
    room: u32,
    push: &mut impl FnMut(DVec2),
) {
    let most = 1 << Path::MAX_DEPTH;
    let count = chords(curve, tolerance, most);
    if count > room {
        // Evenly, so that all of a curve that there is no room for becomes coarse, and not its end.
        return step_evenly(curve, room.max(1), push);
    }
    cut(curve, count, (tolerance, most), push);
}

/// Cuts a curve of `count` chords in two as long as that saves some.
fn cut<const N: usize>(
    curve: &[DVec2; N],
    count: u32,
    (tolerance, most): (f64, u32),
    push: &mut impl FnMut(DVec2),
) {
    if count > FEW {
        let (first, second) = halve(curve);
        let most = most / 2;
        let counts = [chords(&first, tolerance, most), chords(&second, tolerance, most)];
        if counts[0] + counts[1] < count {
            cut(&first, counts[0], (tolerance, most), push);
            return cut(&second, counts[1], (tolerance, most), push);
        }
    }
    step_evenly(curve, count, push);
}

/// Into how many pieces of equal parameter range a curve is cut, so that their chords can stand for
/// them: 1 to `most`.
fn chords<const N: usize>(curve: &[DVec2; N], tolerance: f64, most: u32) -> u32 {
    let order = ((N - 1) * (N - 2)) as f64 / 8.0;
    let squared = order * sqrt(bend_squared(curve)) / tolerance;
    // Numbers beyond all bounds end here as well.
    if !squared.is_finite() {
        return 1;
    }
    let count = sqrt(squared).min(f64::from(most));
    let whole = count as u32;
    (whole + u32::from(f64::from(whole) < count)).max(1)
}

/// The square of the largest second difference of the control points, as far as it leads away from
/// chords.
fn bend_squared<const N: usize>(curve: &[DVec2; N]) -> f64 {
    let chord = curve[N - 1] - curve[0];
    // How far the curve goes along the chord, at the least, and across it, at the most.
    let (mut along, mut across) = (f64::INFINITY, 0.0f64);
    for leg in curve.windows(2) {
        let leg = leg[1] - leg[0];
        if leg == DVec2::ZERO {
            // It has no direction that the curve could take.
            continue;
        }
        along = along.min(leg.dot(chord));
        across = across.max(leg.perp_dot(chord).abs());
    }
    // The tangent of the largest angle to the chord, which is no less than its sine. A curve that turns
    // back counts in full.
    let sine = if along > across { across / along } else { 1.0 };
    let length_squared = chord.length_squared();
    let mut most = 0.0f64;
    for p in curve.windows(3) {
        let bend = (p[0] + p[2]) - p[1] * 2.0;
        let all = bend.length_squared();
        let away = bend.perp_dot(chord).abs() + bend.dot(chord).abs() * sine;
        let away = away * away / length_squared;
        // A chord without length gives NaN.
        most = most.max(if away < all { away } else { all });
    }
    most
}

/// Pushes the points of a curve after its first, at equal steps of the parameter. Those of the
/// reversed curve are the same to the bit: all weights are whole numbers.
fn step_evenly<const N: usize>(curve: &[DVec2; N], pieces: u32, push: &mut impl FnMut(DVec2)) {
    let n = f64::from(pieces);
    let share = if N == 3 { 1.0 / (n * n) } else { 1.0 / (n * n * n) };
    for i in 1..pieces {
        let (t, s) = (f64::from(i), f64::from(pieces - i));
        let sum = if N == 3 {
            (curve[0] * (s * s) + curve[2] * (t * t)) + curve[1] * (2.0 * s * t)
        } else {
            (curve[0] * (s * s * s) + curve[N - 1] * (t * t * t))
                + (curve[1] * (s * t * s) + curve[2] * (s * t * t)) * 3.0
        };
        push(sum * share);
    }
    push(curve[N - 1]);
}

#[cfg(test)]
mod tests {
    use super::*;
    use alloc::vec::Vec;
    use proptest::prelude::*;

    fn chords_of<const N: usize>(curve: &[DVec2; N], tolerance: f64, room: u32) -> Vec<DVec2> {
        let mut points = vec![curve[0]];
        push_chords(curve, tolerance, room, &mut |p| points.push(p));
        points
    }

    fn at<const N: usize>(curve: &[DVec2; N], t: f64) -> DVec2 {
        let mut points = *curve;
        for round in 1..N {
            for i in 0..N - round {
                points[i] = points[i].lerp(points[i + 1], t);
            }
        }
        points[0]
    }

    fn check<const N: usize>(curve: &[DVec2; N], tolerance: f64) -> Result<(), TestCaseError> {
        let points = chords_of(curve, tolerance, u32::MAX);
        let distance = |p: DVec2| {
            let squared = |pair: &[DVec2]| crate::flatten::distance_squared(p, pair[0], pair[1]);
            points.windows(2).map(squared).fold(f64::INFINITY, f64::min).sqrt()
        };
        for i in 0..=300 {
            prop_assert!(distance(at(curve, f64::from(i) / 300.0)) <= tolerance + 1e-9);
        }
        let mut reversed = *curve;
        reversed.reverse();
        let mut back = chords_of(&reversed, tolerance, u32::MAX);
        back.reverse();
        prop_assert_eq!(points, back);
        Ok(())
    }

    proptest! {
        #[test]
        fn curves_stay_within_the_tolerance(
            p in prop::array::uniform8(-60.0..60.0f64),
            tolerance in 0.01..1.0f64,
            slow in any::<bool>(),
        ) {
            let mut curve: [DVec2; 4] = core::array::from_fn(|i| DVec2::new(p[2 * i], p[2 * i + 1]));
            if slow {
                // It sets out without speed.
                curve[1] = curve[0];
            }
            check(&curve, tolerance)?;
            check(&[curve[0], curve[1], curve[3]], tolerance)?;
            check(&[curve[0], curve[2], curve[3]], tolerance)?;
        }

        #[test]
        fn there_are_no_more_chords_than_room(
            p in prop::array::uniform8(-60.0..60.0f64), room in 0..40u32,
        ) {
            let curve: [DVec2; 4] = core::array::from_fn(|i| DVec2::new(p[2 * i], p[2 * i + 1]));
            let points = chords_of(&curve, 0.001, room);
            prop_assert!(points.len() <= room.max(1) as usize + 1);
            prop_assert_eq!(points.last(), Some(&curve[3]));
        }
    }

    #[test]
    fn straight_is_one_chord_however_it_is_run_through() {
        let [a, b] = [DVec2::new(1.0, 2.0), DVec2::new(9.0, 6.0)];
        assert_eq!(chords_of(&[a, a, b, b], 0.01, 99).len(), 2);
        assert_eq!(chords_of(&[a, a.lerp(b, 0.9), b], 0.01, 99).len(), 2);
        // There and back again has to be followed.
        assert!(chords_of(&[a, b, a], 0.01, 99).len() > 2);
    }
}
