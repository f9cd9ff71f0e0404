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
        prop_assert_eq!(contours.len(), 1);
        for i in 0..=200 {
            let t = f64::from(i) / 200.0;
            let s = 1.0 - t;
            let p = p0 * (s * s * s) + p1 * (3.0 * s * s * t) + p2 * (3.0 * s * t * t) + p3 * (t * t * t);
            let image = map.project(p).unwrap();
            prop_assert!(distance_to(&contours.points, image) <= tolerance + 1e-9);
        }
    }

    #[test]
    fn hostile_paths_end(
        p in prop::collection::vec(any::<f64>(), 0..40), kinds in prop::collection::vec(0..5u8, 0..12),
        m in prop::array::uniform3(any::<f64>()), tolerance in any::<f64>(),
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
            prop_assert!((-1e-9..0.01).contains(&(inner - outer)), "{bounds:?} {fine:?}");
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
}
