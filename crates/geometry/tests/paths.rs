//! Flattening and stroking.
#![allow(missing_docs)]
#![cfg(feature = "paths")]

use proptest::prelude::*;
use scumble_geometry::{
    Affine, Cap, Contours, DVec2, Homography, Join, Path, PathElement, Rect, StrokeStyle,
};

fn v(x: f64, y: f64) -> DVec2 {
    DVec2::new(x, y)
}

fn area(contours: &Contours) -> f64 {
    let twice = |c: &[DVec2]| {
        let next = c.iter().cycle().skip(1);
        c.iter().zip(next).map(|(a, b)| a.perp_dot(*b)).sum::<f64>()
    };
    contours.iter().map(twice).sum::<f64>() / 2.0
}

fn distance_to(polygon: &[DVec2], p: DVec2) -> f64 {
    let next = polygon.iter().cycle().skip(1);
    polygon
        .iter()
        .zip(next)
        .map(|(&a, &b)| {
            let d = b - a;
            let t = ((p - a).dot(d) / d.length_squared().max(1e-300)).clamp(0.0, 1.0);
            (p - a - d * t).length()
        })
        .fold(f64::INFINITY, f64::min)
}

proptest! {
    #[test]
    fn chords_stay_within_tolerance_of_the_projected_curve(
        p in prop::array::uniform8(-100.0..100.0f64), tilt in prop::array::uniform2(-0.008..0.008f64),
        tolerance in 0.02..2.0f64,
    ) {
        let [p0, p1, p2, p3] = [0, 2, 4, 6].map(|i| v(p[i], p[i + 1]));
        let mut path = Path::new();
        path.move_to(p0).cubic_to(p1, p2, p3);
        // w stays above 1 − 0.8 − 0.8 < 0 for the worst: such curves are clipped.
        let map = Homography::new([[1.0, 0.2, 5.0], [0.1, 1.0, 3.0], [tilt[0], tilt[1], 1.0]]);
        let corners = [p0, p1, p2, p3].map(|p| map.project_homogeneous(p).z);
        let contours = path.flatten(&map, tolerance);
        prop_assert!(contours.points.iter().all(|p| p.is_finite()));
        prop_assume!(corners.iter().all(|&w| w > 0.05));
        // A curve that is as good as straight encloses nothing.
        let ends = [map.project(p0).unwrap(), map.project(p3).unwrap()];
        let polygon = if contours.is_empty() { &ends[..] } else { &contours.points };
        for i in 0..=200 {
            let t = f64::from(i) / 200.0;
            let s = 1.0 - t;
            let p = p0 * (s * s * s) + p1 * (3.0 * s * s * t) + p2 * (3.0 * s * t * t) + p3 * (t * t * t);
            let image = map.project(p).unwrap();
            prop_assert!(distance_to(polygon, image) <= tolerance + 1e-9);
        }
    }

    #[test]
    fn hostile_paths_end(
        p in prop::collection::vec(any::<f64>(), 0..40), kinds in prop::collection::vec(0..5u8, 0..12),
        m in prop::array::uniform3(any::<f64>()), tolerance in any::<f64>(), width in any::<f64>(),
    ) {
        let mut points = p.chunks_exact(2).map(|c| v(c[0], c[1])).cycle();
        let mut next = || points.next().unwrap_or(DVec2::ZERO);
        let mut path = Path::new();
        for kind in kinds {
            path.push(match kind {
                0 => PathElement::MoveTo(next()),
                1 => PathElement::LineTo(next()),
                2 => PathElement::QuadTo(next(), next()),
                3 => PathElement::CubicTo(next(), next(), next()),
                _ => PathElement::Close,
            });
        }
        let map = Homography::new([[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], m]);
        let contours = path.flatten(&map, tolerance);
        prop_assert!(contours.points.iter().all(|p| p.is_finite()));
        let _ = path.bounds();
        let style = StrokeStyle { width, dashes: vec![p.first().copied().unwrap_or(1.0)], ..Default::default() };
        let outline = path.stroke(&style, tolerance);
        prop_assert!(outline.is_finite());
        let _ = outline.flatten(&map, tolerance);
    }

    #[test]
    fn bounds_hold_the_path_tightly(p in prop::array::uniform8(-100.0..100.0f64)) {
        let [p0, p1, p2, p3] = [0, 2, 4, 6].map(|i| v(p[i], p[i + 1]));
        let mut path = Path::new();
        path.move_to(p0).cubic_to(p1, p2, p3).quad_to(p1, p0);
        let bounds = path.bounds().unwrap();
        let fine = path.flatten(&Homography::IDENTITY, 0.001).bounds().unwrap();
        let pairs = [(bounds.x0, fine.x0), (bounds.y0, fine.y0), (fine.x1, bounds.x1), (fine.y1, bounds.y1)];
        for (outer, inner) in pairs {
            // Vertices may lie outside the curve, by the tolerance.
            prop_assert!((-0.001_001..0.01).contains(&(inner - outer)), "{bounds:?} {fine:?}");
        }
    }
}

#[test]
fn a_circle_is_round() {
    let circle = Path::ellipse(v(50.0, 60.0), v(40.0, 40.0));
    let contours = circle.flatten(&Homography::IDENTITY, 0.05);
    let count = contours.points.len();
    assert!((16..200).contains(&count), "{count}");
    assert!((area(&contours) / (core::f64::consts::PI * 1600.0) - 1.0).abs() < 2e-3);
    let bounds = circle.bounds().unwrap();
    assert!((bounds.x0 - 10.0).abs() < 1e-12 && (bounds.y1 - 100.0).abs() < 1e-12);
    // Finer tolerance, more points: halving it costs about √2.
    let finer = circle.flatten(&Homography::IDENTITY, 0.0125).points.len();
    assert!(finer > count && finer <= 4 * count);
}

#[test]
fn a_plane_through_the_eye_is_clipped() {
    // w = y/10: everything above y = 0 is behind.
    let map = Homography::new([[1.0, 0.0, 0.0], [0.0, 0.0, 1.0], [0.0, 0.1, 0.0]]);
    let disc = Path::ellipse(v(0.0, 0.0), v(10.0, 10.0)).flatten(&map, 0.1);
    assert_eq!(disc.len(), 1);
    assert!(disc.points.iter().all(|p| p.is_finite() && p.y > 0.0));
    assert!(disc.points.len() < 20_000);
    let behind = Path::rect(Rect::new(-5.0, -9.0, 5.0, -1.0)).flatten(&map, 0.1);
    assert!(behind.is_empty());
}

#[test]
fn contours_follow_the_elements() {
    let mut path = Path::new();
    path.line_to(v(5.0, 0.0)).line_to(v(5.0, 5.0)).close();
    // Goes on from the start of the closed contour.
    path.line_to(v(-5.0, 0.0)).line_to(v(-5.0, -5.0));
    path.move_to(v(9.0, 9.0)).line_to(v(8.0, 8.0));
    path.move_to(v(1.0, 1.0)).line_to(v(f64::NAN, 2.0)).line_to(v(3.0, 1.0)).close();
    let contours = path.flatten(&Homography::IDENTITY, 0.1);
    let slices: Vec<_> = contours.iter().map(<[DVec2]>::to_vec).collect();
    let first = vec![v(0.0, 0.0), v(5.0, 0.0), v(5.0, 5.0)];
    let second = vec![v(0.0, 0.0), v(-5.0, 0.0), v(-5.0, -5.0)];
    assert_eq!(slices, [first, second]);
    let moved = path.transform(&Affine::translate(1.0, 2.0));
    assert_eq!(moved.elements()[0], PathElement::LineTo(v(6.0, 2.0)));
}

/// How often contours wind around a point.
fn winding(contours: &Contours, p: DVec2) -> i32 {
    let mut sum = 0;
    for c in contours.iter() {
        for (a, b) in c.iter().zip(c.iter().cycle().skip(1)) {
            let (upper, lower, turn) = if a.y < b.y { (a, b, 1) } else { (b, a, -1) };
            let right = (*lower - *upper).perp_dot(p - *upper) < 0.0;
            // Clockwise to the eye counts +1.
            sum -= if upper.y <= p.y && p.y < lower.y && right { turn } else { 0 };
        }
    }
    sum
}

/// The distance of a point from an open chain.
fn distance_from(chain: &[DVec2], p: DVec2) -> f64 {
    let to_segment = |w: &[DVec2]| distance_to(w, p);
    chain.windows(2).map(to_segment).fold(f64::INFINITY, f64::min)
}

proptest! {
    #[test]
    fn round_strokes_are_what_lies_near_the_path(
        p in prop::array::uniform10(-50.0..50.0f64), width in 0.5..60.0f64, closed in any::<bool>(),
    ) {
        let at = |i: usize| v(p[2 * i], p[2 * i + 1]);
        let mut path = Path::new();
        path.move_to(at(0)).cubic_to(at(1), at(2), at(3)).line_to(at(4)).quad_to(at(1), at(3));
        if closed {
            path.close();
        }
        let style = StrokeStyle { width, join: Join::Round, cap: Cap::Round, ..Default::default() };
        let tolerance = 0.05;
        let outline = path.stroke(&style, tolerance).flatten(&Homography::IDENTITY, 0.01);
        let mut chain = path.flatten(&Homography::IDENTITY, 0.005).points;
        if closed {
            chain.push(chain[0]);
        }
        for i in 0..144 {
            let q = v(f64::from(i % 12) * 15.0 - 88.3, f64::from(i / 12) * 15.0 - 89.1);
            let distance = distance_from(&chain, q);
            // Twice the tolerance: the chords of the path and those of the arcs.
            if distance < width * 0.5 - 2.0 * tolerance - 0.01 {
                prop_assert!(winding(&outline, q) > 0, "{q} {distance}");
            } else if distance > width * 0.5 + 2.0 * tolerance {
                prop_assert_eq!(winding(&outline, q), 0, "{} {}", q, distance);
            }
        }
    }

    #[test]
    fn strokes_of_any_style_never_wind_backwards(
        p in prop::collection::vec((-6..7i32, -6..7i32), 1..9), width in 0.5..9.0f64,
        join in prop::sample::select(vec![Join::Miter, Join::Round, Join::Bevel]),
        cap in prop::sample::select(vec![Cap::Butt, Cap::Round, Cap::Square]),
        dashes in prop::collection::vec(0.0..5.0f64, 0..4), dash_offset in -20.0..20.0f64,
        closed in any::<bool>(),
    ) {
        let points = p.iter().map(|&(x, y)| v(f64::from(x), f64::from(y)));
        let path = Path::polyline(points, closed);
        let style = StrokeStyle { width, join, cap, miter_limit: 4.0, dashes, dash_offset };
        let outline = path.stroke(&style, 0.01).flatten(&Homography::IDENTITY, 0.01);
        let solid = StrokeStyle { dashes: Vec::new(), ..style };
        let solid = path.stroke(&solid, 0.01).flatten(&Homography::IDENTITY, 0.01);
        for i in 0..400 {
            let q = v(f64::from(i % 20) - 9.7, f64::from(i / 20) - 9.3) * 1.03;
            prop_assert!(winding(&outline, q) >= 0);
            // Dashes are part of the whole, but for what their caps add.
            if cap == Cap::Butt && winding(&outline, q) > 0 {
                prop_assert!(winding(&solid, q) > 0);
            }
        }
    }
}

proptest! {
    #[test]
    fn strokes_of_curves_never_wind_backwards(
        p in prop::array::uniform8(-50.0..50.0f64), width in 0.1..60.0f64,
        cap in prop::sample::select(vec![Cap::Butt, Cap::Round, Cap::Square]),
        tolerance in 0.01..0.2f64,
    ) {
        let at = |i: usize| v(p[2 * i], p[2 * i + 1]);
        let mut path = Path::new();
        path.move_to(at(0)).cubic_to(at(1), at(2), at(3)).quad_to(at(2), at(1));
        let style = StrokeStyle { width, cap, ..Default::default() };
        let outline = path.stroke(&style, tolerance).flatten(&Homography::IDENTITY, 0.01);
        let chain = path.flatten(&Homography::IDENTITY, 0.005).points;
        for i in 0..400 {
            let q = v(f64::from(i % 20) * 8.0 - 77.3, f64::from(i / 20) * 8.0 - 77.1);
            prop_assert!(winding(&outline, q) >= 0, "{q}");
            // All but what is near the ends looks like a round stroke.
            let from_ends = [0, 1, 3].map(|i| q.distance(at(i))).into_iter().fold(f64::INFINITY, f64::min);
            if from_ends > width * 2.1 && distance_from(&chain, q) < width * 0.5 - 2.0 * tolerance - 0.01 {
                prop_assert!(winding(&outline, q) > 0, "{q}");
            }
        }
        // Straight on to the screen.
        let map = Homography::new([[1.5, 0.2, 5.0], [0.1, 2.0, 3.0], [0.0, 0.0, 1.0]]);
        let mut contours = Contours::new();
        path.stroke_into(&style, tolerance, &map, &mut contours);
        prop_assert_eq!(contours, path.stroke(&style, tolerance).flatten(&map, 0.01));
    }
}

#[test]
fn contours_are_appended() {
    let disc = Path::ellipse(v(5.0, 5.0), v(4.0, 4.0));
    let style = StrokeStyle::default();
    let tilted = Homography::new([[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.1, 0.3]]);
    for map in [Homography::IDENTITY, tilted] {
        let mut contours = disc.flatten(&map, 0.1);
        let filled = contours.clone();
        disc.stroke_into(&style, 0.1, &map, &mut contours);
        let stroked = disc.stroke(&style, 0.1).flatten(&map, 0.1);
        disc.flatten_into(&map, 0.1, &mut contours);
        let expected: Vec<_> =
            [&filled, &stroked, &filled].into_iter().flat_map(|c| c.iter()).collect();
        assert_eq!(contours.iter().collect::<Vec<_>>(), expected);
    }
}

#[test]
fn ends_of_curves_keep_their_direction() {
    // A wide stroke: the first chord is near enough to the curve long before its sides are.
    let mut path = Path::new();
    path.move_to(v(0.0, 0.0)).quad_to(v(100.0, 0.0), v(100.0, 100.0));
    let style = StrokeStyle { width: 40.0, ..Default::default() };
    let outline = path.stroke(&style, 0.1);
    let bounds = outline.bounds().unwrap();
    assert!(bounds.x0.abs() <= 0.1 && (bounds.y1 - 100.0).abs() <= 0.1, "{bounds:?}");
    assert!(outline.elements().len() < 200, "{}", outline.elements().len());
}

#[test]
fn miters_have_a_limit() {
    let right_angle = Path::polyline([v(0.0, 0.0), v(10.0, 0.0), v(10.0, 10.0)], false);
    let area_at = |miter_limit: f64| {
        let style = StrokeStyle { width: 2.0, miter_limit, ..Default::default() };
        area(&right_angle.stroke(&style, 0.01).flatten(&Homography::IDENTITY, 0.01))
    };
    // Two arms of 10 × 2, a square of 1 × 1 at the tip; its own overlap counts twice here.
    assert!((area_at(1.42) - area_at(1.41) - 0.5).abs() < 1e-9);
    let style = StrokeStyle { width: 2.0, miter_limit: 1.5, ..Default::default() };
    assert_eq!(right_angle.stroke(&style, 0.01).bounds(), Some(Rect::new(0.0, -1.0, 11.0, 10.0)));
}

#[test]
fn dots() {
    let mut dot = Path::new();
    dot.move_to(v(5.0, 5.0)).line_to(v(5.0, 5.0)).move_to(v(50.0, 5.0));
    let bounds = |cap| {
        let style = StrokeStyle { width: 2.0, cap, ..Default::default() };
        dot.stroke(&style, 0.01).bounds()
    };
    assert_eq!(bounds(Cap::Butt), None);
    assert_eq!(bounds(Cap::Square), Some(Rect::new(4.0, 4.0, 6.0, 6.0)));
    assert_eq!(bounds(Cap::Round), Some(Rect::new(4.0, 4.0, 6.0, 6.0)));
}

#[test]
fn dashes_follow_the_pattern() {
    let line = Path::polyline([v(0.0, 0.0), v(4.0, 0.0), v(20.0, 0.0)], false);
    let spans = |dashes: &[f64], dash_offset: f64, path: &Path| {
        let style = StrokeStyle { dashes: dashes.to_vec(), dash_offset, ..Default::default() };
        let outline = path.stroke(&style, 0.01).flatten(&Homography::IDENTITY, 0.01);
        let span = |c: &[DVec2]| Rect::bounding(c.iter().copied()).map(|r| (r.x0, r.x1)).unwrap();
        outline.iter().map(span).collect::<Vec<_>>()
    };
    assert_eq!(spans(&[5.0, 3.0], 0.0, &line), [(0.0, 5.0), (8.0, 13.0), (16.0, 20.0)]);
    assert_eq!(spans(&[5.0, 3.0], 6.0, &line), [(2.0, 7.0), (10.0, 15.0), (18.0, 20.0)]);
    assert_eq!(spans(&[5.0, 3.0], -1.0, &line), [(1.0, 6.0), (9.0, 14.0), (17.0, 20.0)]);
    assert_eq!(spans(&[5.0, 3.0], 8e6 - 1.0, &line), spans(&[5.0, 3.0], -1.0, &line));
    // Odd: 7 on, 7 off.
    assert_eq!(spans(&[7.0], 0.0, &line), [(0.0, 7.0), (14.0, 20.0)]);
    assert_eq!(spans(&[5.0, 5.0], 0.0, &line).len(), 2);
    // No pattern.
    for dashes in [&[][..], &[0.0, 0.0], &[-1.0, 2.0], &[f64::NAN], &[f64::INFINITY], &[1e-9]] {
        assert_eq!(spans(dashes, 0.0, &line), [(0.0, 20.0)]);
    }
    // A gap as long as the line.
    assert_eq!(spans(&[10.0, 30.0], 10.0, &line), []);
    // Dots, the first of them where the line begins.
    let dots = StrokeStyle { dashes: vec![0.0, 5.0], cap: Cap::Square, ..Default::default() };
    let outline = line.stroke(&dots, 0.01).flatten(&Homography::IDENTITY, 0.01);
    let middles = outline
        .iter()
        .map(|c| Rect::bounding(c.iter().copied()).map(|r| 0.5 * (r.x0 + r.x1)).unwrap());
    assert_eq!(middles.collect::<Vec<_>>(), [0.0, 5.0, 10.0, 15.0, 20.0]);
    // Around the seam of a closed contour: 40 long, 6 on and 4 off, from −3 on.
    let square = Path::rect(Rect::new(0.0, 0.0, 10.0, 10.0));
    assert_eq!(spans(&[6.0, 4.0], 3.0, &square).len(), 4);
}

#[test]
fn a_dash_at_a_corner_has_no_join_there() {
    // The second dash begins at the corner (10, 0), the third ends at (10, 10), give or take
    // rounding: each is a plain rectangle of one side.
    for nudge in [0.0, 1e-10, -1e-10] {
        let corner =
            Path::polyline([v(0.0, 0.0), v(10.0, 0.0), v(10.0, 10.0), v(0.0, 10.0)], false);
        let dashes = vec![4.0, 6.0 + nudge, 3.0, 4.0, 3.0, 100.0];
        let style = StrokeStyle { width: 2.0, dashes, ..Default::default() };
        let outline = corner.stroke(&style, 0.01).flatten(&Homography::IDENTITY, 0.01);
        let boxes = outline.iter().map(|c| Rect::bounding(c.iter().copied()).unwrap());
        let boxes: Vec<Rect> = boxes.collect();
        let expected = [
            Rect::new(0.0, -1.0, 4.0, 1.0),
            Rect::new(9.0, 0.0, 11.0, 3.0),
            Rect::new(9.0, 7.0, 11.0, 10.0),
        ];
        assert_eq!(boxes.len(), 3);
        for (r, e) in boxes.iter().zip(&expected) {
            let far = [r.x0 - e.x0, r.y0 - e.y0, r.x1 - e.x1, r.y1 - e.y1];
            assert!(far.iter().all(|d| d.abs() < 1e-6), "{r:?} for {e:?}");
        }
    }
}

#[test]
fn a_dash_that_ends_a_closed_contour_joins_the_one_that_begins_it() {
    // 40 long: 10 on, 5 off, 15 on, 5 off, and 5 on up to the seam.
    let square = Path::rect(Rect::new(0.0, 0.0, 10.0, 10.0));
    for nudge in [0.0, 1e-10, -1e-10] {
        let dashes = vec![10.0, 5.0, 15.0, 5.0, 5.0 + nudge, 3.0];
        let style = StrokeStyle { width: 2.0, dashes, ..Default::default() };
        let outline = square.stroke(&style, 0.01).flatten(&Homography::IDENTITY, 0.01);
        assert_eq!(outline.len(), 2, "{outline:?}");
        let seam = outline.iter().flatten().any(|p| p.distance(v(-1.0, -1.0)) < 1e-6);
        assert!(seam, "the miter at the seam is missing");
        // One dash all around is a closed contour.
        let whole = StrokeStyle { width: 2.0, dashes: vec![40.0 + nudge, 9.0], ..style };
        let plain = StrokeStyle { width: 2.0, ..Default::default() };
        assert_eq!(square.stroke(&whole, 0.01), square.stroke(&plain, 0.01));
    }
}

#[test]
fn strokes_have_the_right_area() {
    let line = Path::polyline([v(0.0, 0.0), v(10.0, 0.0)], false);
    let stroked = |path: &Path, style: &StrokeStyle| {
        area(&path.stroke(style, 0.001).flatten(&Homography::IDENTITY, 0.001)).abs()
    };
    let butt = StrokeStyle { width: 2.0, ..Default::default() };
    assert!((stroked(&line, &butt) - 20.0).abs() < 1e-9);
    let square = StrokeStyle { cap: Cap::Square, ..butt.clone() };
    assert!((stroked(&line, &square) - 24.0).abs() < 1e-9);
    let round = StrokeStyle { cap: Cap::Round, ..butt.clone() };
    assert!((stroked(&line, &round) - 20.0 - core::f64::consts::PI).abs() < 0.02);
    let dashed = StrokeStyle { dashes: vec![1.0, 3.0], ..butt.clone() };
    assert!((stroked(&line, &dashed) - 6.0).abs() < 1e-9);

    let corner = Path::polyline([v(0.0, 0.0), v(10.0, 0.0), v(10.0, 10.0), v(0.0, 10.0)], true);
    let bounds = |join| {
        let style = StrokeStyle { width: 2.0, join, ..Default::default() };
        corner.stroke(&style, 0.01).bounds().unwrap()
    };
    for join in [Join::Miter, Join::Round, Join::Bevel] {
        let b = bounds(join);
        assert!((b.x0 + 1.0).abs() < 1e-9 && (b.y1 - 11.0).abs() < 1e-9, "{b:?}");
    }
    // The inner side turns where its edges cross: nothing is counted twice.
    assert!((stroked(&corner, &butt) - (144.0 - 64.0)).abs() < 1e-9);
}

#[test]
fn inner_sides_of_joins_do_not_cross_themselves() {
    let points = |path: &Path, width: f64| {
        let style = StrokeStyle { width, ..Default::default() };
        path.stroke(&style, 0.01).flatten(&Homography::IDENTITY, 0.01).points.len()
    };
    let bend = Path::polyline([v(0.0, 0.0), v(10.0, 0.0), v(4.0, 8.0)], false);
    // Both ends, the crossing, and the miter between the ends of the outer sides.
    assert_eq!(points(&bend, 2.0), 4 + 1 + 3);
    // Where the stroke is wider than the segments are long, the sides end beyond each other.
    assert_eq!(points(&bend, 30.0), 4 + 3 + 3);
    // Where curves go on into each other, no side goes to the middle and back.
    let mut wave = Path::new();
    wave.move_to(v(0.0, 0.0))
        .quad_to(v(10.0, 10.0), v(20.0, 0.0))
        .quad_to(v(30.0, -10.0), v(40.0, 0.0));
    let outline = wave.stroke(&StrokeStyle::default(), 0.01).flatten(&Homography::IDENTITY, 0.01);
    assert!(outline.points.iter().all(|p| p.distance(v(20.0, 0.0)) > 0.49));
}
