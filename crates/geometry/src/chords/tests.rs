use super::*;
use crate::flatten::distance_squared;
use alloc::vec::Vec;
use proptest::prelude::*;

fn chords_of<const N: usize>(curve: &[DVec2; N], tolerance: f64, room: usize) -> Vec<DVec2> {
    let mut points = vec![curve[0]];
    Chords::new(tolerance, 0.0, |_, _| true).push(curve, room, &mut points);
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

/// The curve at equal steps of the parameter.
fn points_of<const N: usize>(curve: &[DVec2; N], steps: u32) -> Vec<DVec2> {
    (0..=steps).map(|i| at(curve, f64::from(i) / f64::from(steps))).collect()
}

fn distance(chain: &[DVec2], p: DVec2) -> f64 {
    let squared = |pair: &[DVec2]| distance_squared(p, pair[0], pair[1]);
    chain.windows(2).map(squared).fold(f64::INFINITY, f64::min).sqrt()
}

/// Twice the area between a chain and the way back from its end to its start.
fn area(chain: &[DVec2]) -> f64 {
    chain.windows(2).map(|pair| (pair[0] - chain[0]).perp_dot(pair[1] - chain[0])).sum()
}

fn check<const N: usize>(curve: &[DVec2; N], tolerance: f64) -> Result<(), TestCaseError> {
    let points = chords_of(curve, tolerance, usize::MAX);
    for p in points_of(curve, 300) {
        prop_assert!(distance(&points, p) <= tolerance * (1.0 + 1e-9));
    }
    // The other way round, with a curve made of chords that are less than a thousandth off.
    let fine = points_of(curve, 1500);
    for pair in points.windows(2) {
        for i in 0..8 {
            let p = pair[0].lerp(pair[1], f64::from(i) / 8.0);
            prop_assert!(distance(&fine, p) <= tolerance + 1e-3);
        }
    }
    let mut reversed = *curve;
    reversed.reverse();
    let mut back = chords_of(&reversed, tolerance, usize::MAX);
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
    fn sharp_turns_stay_within_the_tolerance(
        p in prop::array::uniform6(-60.0..60.0f64),
        (along, aside) in (-3.0..3.0f64, -0.02..0.02f64),
        tolerance in 0.01..1.0f64,
    ) {
        // Legs that cross or nearly do: a cusp, or as good as one.
        let at = |i: usize| DVec2::new(p[2 * i], p[2 * i + 1]);
        let leg = at(1) - at(0);
        let nearly = at(0) + leg * along + leg.perp() * aside;
        check(&[at(0), at(1), nearly, at(2)], tolerance)?;
        check(&[at(0), at(2), at(0) + leg * aside, nearly], tolerance)?;
        check(&[at(0), at(1), nearly], tolerance)?;
    }

    #[test]
    fn eight_at_a_time_they_are_what_they_are_one_by_one(
        p in prop::array::uniform8(-60.0..60.0f64),
        tolerance in 0.01..1.0f64,
        radius in prop_oneof![Just(0.0), 0.1..20.0f64],
        (count, finer) in (1..40u32, any::<bool>()),
        slow in 0..4usize,
    ) {
        let mut curve: [DVec2; 4] = core::array::from_fn(|i| DVec2::new(p[2 * i], p[2 * i + 1]));
        curve[slow] = curve[1];
        let cubic = Cubic::new(&curve);
        for level in [Level::baseline(), Level::new()] {
            let mut chords = Chords::with_level(tolerance, radius, |_, _| true, level);
            let density = chords.density(&cubic);
            let (_, steps) = Density::of_one(&cubic, tolerance, radius);
            prop_assert_eq!(density.steps(), steps);
            // As few as may do, or any number.
            let count = if finer { density::count(steps) + count % 3 } else { count };
            let holds = chords.place(&cubic, &density, count);
            let expected = definition::place(&cubic, (tolerance, radius), count);
            prop_assert_eq!(holds, expected.is_some());
            for (i, p) in expected.iter().flatten().enumerate() {
                prop_assert_eq!([chords.xs[i], chords.ys[i]], [p.x, p.y]);
            }
        }
    }

    #[test]
    fn there_are_no_more_chords_than_room(
        p in prop::array::uniform8(-60.0..60.0f64), room in 0..40usize,
    ) {
        let curve: [DVec2; 4] = core::array::from_fn(|i| DVec2::new(p[2 * i], p[2 * i + 1]));
        let points = chords_of(&curve, 0.001, room);
        prop_assert!(points.len() <= room.max(1) + 1);
        prop_assert_eq!(points.last(), Some(&curve[3]));
    }

    #[test]
    fn any_numbers_end_where_the_curve_does(
        p in prop::array::uniform8(any::<f64>()), tolerance in 1e-3..1e3f64,
    ) {
        let curve: [DVec2; 4] = core::array::from_fn(|i| DVec2::new(p[2 * i], p[2 * i + 1]));
        let points = chords_of(&curve, tolerance, usize::MAX);
        prop_assert!(points.len() <= (1 << Path::MAX_DEPTH) + 1);
        prop_assert!(points.last() == Some(&curve[3]) || curve[3].is_nan());
    }
}

fn quarter_circle(radius: f64) -> [DVec2; 4] {
    let kappa = 0.552_284_75;
    [(1.0, 0.0), (1.0, kappa), (kappa, 1.0), (0.0, 1.0)].map(|(x, y)| DVec2::new(x, y) * radius)
}

#[test]
fn areas_are_hardly_off() {
    // With vertices on the circle, chords would take two thirds of the tolerance off all along.
    for radius in [3.0, 20.0, 200.0] {
        let curve = quarter_circle(radius);
        for tolerance in [0.01, 0.05] {
            let off = area(&chords_of(&curve, tolerance, 999)) - area(&points_of(&curve, 20_000));
            let length = radius * core::f64::consts::FRAC_PI_2;
            let share = 0.5 * off / (length * tolerance);
            assert!((-0.4..0.1).contains(&share), "{share} at {radius}, {tolerance}");
        }
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

#[test]
fn chords_are_as_few_as_they_can_be() {
    // A circle's sagitta may be twice the tolerance: 2·r·(1 − cos(π/(2·2n))), and 0.3 more for the ends.
    for radius in [3.0f64, 20.0, 200.0] {
        let curve = quarter_circle(radius);
        let ideal = core::f64::consts::FRAC_PI_4 / (2.0f64 * 0.02 / radius * 2.0).sqrt();
        let count = chords_of(&curve, 0.02, 999).len() - 1;
        assert!((count as f64) < ideal * 1.1 + 1.3, "{count} for {ideal}");
    }
}
