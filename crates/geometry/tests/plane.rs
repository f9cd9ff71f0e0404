//! 2×2 matrices, clipping, contours and lines.
#![allow(missing_docs)]

use proptest::prelude::*;
use scumble_geometry::{
    Affine, Contours, DVec2, DVec3, GeometryError, IntRect, Matrix2, Rect, clip_polygon,
    clip_polygon_to_rect, line_quad, line_quad_square,
};

fn v(x: f64, y: f64) -> DVec2 {
    DVec2::new(x, y)
}

fn area(polygon: &[DVec2]) -> f64 {
    let next = polygon.iter().cycle().skip(1);
    polygon.iter().zip(next).map(|(a, b)| a.perp_dot(*b)).sum::<f64>() / 2.0
}

proptest! {
    #[test]
    fn axes_are_the_singular_values(
        angle in 0.0..7.0f64, turn in 0.0..7.0f64, major in 0.01..100.0f64, ratio in 1.0..1e6f64,
        exponent in -400..400i32,
    ) {
        let rotation = |t: f64| Matrix2::new(t.cos(), -t.sin(), t.sin(), t.cos());
        let (major, minor) = (major * 2f64.powi(exponent), major / ratio * 2f64.powi(exponent));
        let m = rotation(angle) * Matrix2::new(major, 0.0, 0.0, minor) * rotation(turn);
        let axes = m.axes();
        prop_assert!((axes.major / major - 1.0).abs() < 1e-14 * 8.0);
        // The product's own rounding is ε of the major axis.
        prop_assert!((axes.minor - minor).abs() < 8e-16 * major);
        prop_assert!(axes.minor <= axes.major);
        let [x, y] = axes.direction;
        prop_assert!((x * x + y * y - 1.0).abs() < 1e-14);
        let off = (x * angle.sin() - y * angle.cos()).abs();
        prop_assert!(off < 1e-14 / (1.0 - 1.0 / ratio).max(1e-14), "{off}");
    }

    #[test]
    fn axes_never_panic(m in prop::array::uniform4(any::<f64>())) {
        let axes = Matrix2::new(m[0], m[1], m[2], m[3]).axes();
        prop_assert!(!axes.major.is_nan() && !axes.minor.is_nan());
        prop_assert!(axes.direction.iter().all(|d| d.is_finite()));
    }

    #[test]
    fn matrix_algebra(m in prop::array::uniform4(-9.0..9.0f64), p in prop::array::uniform2(-9.0..9.0f64)) {
        let m = Matrix2::new(m[0], m[1], m[2], m[3]);
        prop_assume!(m.determinant().abs() > 0.1);
        let p = v(p[0], p[1]);
        let back = m.inverse().unwrap().apply(m.apply(p));
        prop_assert!((back - p).length() < 1e-9);
        prop_assert_eq!((m * m).apply(p).round(), m.apply(m.apply(p)).round());
        prop_assert_eq!(m.transpose().transpose(), m);
    }

    #[test]
    fn neighbours_are_clipped_alike(p in prop::array::uniform12(-8.0..8.0f64), min_w in 0.01..2.0f64) {
        let mut p: Vec<DVec3> = p.chunks(3).map(|c| DVec3::new(c[0], c[1], c[2])).collect();
        // The shared edge crosses the boundary.
        p[0].z = min_w + p[0].z.abs();
        p[1].z = min_w - 0.001 - p[1].z.abs();
        let clip = |polygon: &[DVec3]| {
            let mut out = Vec::new();
            clip_polygon(polygon, min_w, &mut out);
            out
        };
        // The crossing of the shared edge p0–p1 stands in both, though it runs the other way.
        let (left, right) = (clip(&[p[0], p[1], p[2]]), clip(&[p[1], p[0], p[3]]));
        let on_edge = |polygon: &[DVec3]| {
            let on = polygon.iter().filter(|q| q.z == min_w);
            on.copied().collect::<Vec<_>>()
        };
        let shared = on_edge(&left).iter().any(|q| on_edge(&right).contains(q));
        prop_assert!(shared, "{left:?} {right:?}");
        prop_assert!(left.iter().all(|q| q.z >= min_w));
    }

    #[test]
    fn clipping_to_a_rectangle_keeps_what_is_inside(p in prop::collection::vec(-20.0..20.0f64, 6..20)) {
        let polygon: Vec<DVec2> = p.chunks_exact(2).map(|c| v(c[0], c[1])).collect();
        let rect = Rect::new(-7.0, -5.0, 9.0, 6.0);
        let mut clipped = polygon.clone();
        clip_polygon_to_rect(&mut clipped, rect, &mut Vec::new());
        let inside = |p: &DVec2| p.x >= rect.x0 && p.x <= rect.x1 && p.y >= rect.y0 && p.y <= rect.y1;
        prop_assert!(clipped.iter().all(inside));
        for i in 0..100 {
            let q = v(f64::from(i % 10) * 1.5 - 6.9 + 1e-3, f64::from(i / 10) - 4.7 + 1e-3);
            prop_assert_eq!(winding(&polygon, q), winding(&clipped, q));
        }
    }
}

/// How often a polygon winds around a point.
fn winding(polygon: &[DVec2], p: DVec2) -> i32 {
    let next = polygon.iter().cycle().skip(1);
    polygon
        .iter()
        .zip(next)
        .map(|(a, b)| {
            let left = (*b - *a).perp_dot(p - *a) > 0.0;
            match (a.y <= p.y, b.y <= p.y) {
                (true, false) if left => 1,
                (false, true) if !left => -1,
                _ => 0,
            }
        })
        .sum()
}

#[test]
fn affine_maps() {
    let map =
        Affine::rect_to_rect(Rect::new(0.0, 0.0, 4.0, 2.0), Rect::new(10.0, 20.0, 18.0, 21.0));
    assert_eq!(map.apply(v(0.0, 0.0)), v(10.0, 20.0));
    assert_eq!(map.apply(v(4.0, 2.0)), v(18.0, 21.0));
    assert_eq!(map.determinant(), 1.0);
    assert_eq!((map.inverse().unwrap() * map), Affine::IDENTITY);
    let product = Affine::translate(1.0, 2.0) * Affine::scale(3.0, 4.0);
    assert_eq!(product.apply(v(1.0, 1.0)), v(4.0, 6.0));
    assert_eq!(product.linear(), Matrix2::new(3.0, 0.0, 0.0, 4.0));
    assert_eq!(Affine::scale(0.0, 1.0).inverse(), Err(GeometryError::Singular));
    assert!(Affine::scale(f64::NAN, 1.0).inverse().is_err());
    let empty = Rect::new(1.0, 1.0, 1.0, 1.0);
    assert!(!Affine::rect_to_rect(empty, Rect::new(0.0, 0.0, 1.0, 1.0)).is_finite());
}

#[test]
fn rectangles() {
    assert_eq!(Rect::bounding([]), None);
    assert_eq!(Rect::bounding([v(1.0, f64::NAN), v(2.0, 3.0)]), None);
    assert!(Rect::new(0.0, 0.0, f64::NAN, 1.0).is_empty());
    let a = IntRect::new(0, 0, 10, 10);
    let b = IntRect::new(5, -5, 15, 5);
    assert_eq!(a.intersect(&b), IntRect::new(5, 0, 10, 5));
    assert!(a.intersect(&IntRect::new(10, 0, 20, 5)).is_empty());
    assert!(a.contains(0, 9) && !a.contains(10, 0));
    assert_eq!(IntRect::new(i32::MIN, 0, i32::MAX, 1).width(), u32::MAX);
}

#[test]
fn axes_of_special_matrices() {
    let axes = Matrix2::new(0.0, 0.0, 0.0, 0.0).axes();
    assert_eq!((axes.major, axes.minor, axes.direction), (0.0, 0.0, [1.0, 0.0]));
    let axes = Matrix2::new(3.0, 0.0, 0.0, -3.0).axes();
    assert_eq!((axes.major, axes.minor, axes.direction), (3.0, 3.0, [1.0, 0.0]));
    let axes = Matrix2::new(1.0, 0.0, 0.0, 5.0).axes();
    assert_eq!((axes.major, axes.minor, axes.direction), (5.0, 1.0, [0.0, 1.0]));
    let axes = Matrix2::new(1.0, 1.0, 1.0, 1.0).axes();
    assert!((axes.major - 2.0).abs() < 1e-15 && axes.minor == 0.0);
    // Aspect 10⁴, where the quadratic formula would have lost the minor axis.
    let axes = Matrix2::new(1e4, 1e4, 1.0, -1.0).axes();
    assert!((axes.major * axes.minor / 2e4 - 1.0).abs() < 1e-15);
    assert!(Matrix2::new(f64::NAN, 0.0, 0.0, 1.0).axes().major.is_infinite());
}

#[test]
fn contours_behind_the_eye_vanish() {
    let mut out = vec![DVec3::ZERO];
    clip_polygon(&[DVec3::NEG_Z, DVec3::X - DVec3::Z, DVec3::Y - DVec3::Z], 0.1, &mut out);
    assert!(out.is_empty());
    clip_polygon(&[], 0.1, &mut out);
    assert!(out.is_empty());
    let whole = [DVec3::Z, DVec3::X + DVec3::Z, DVec3::Y + DVec3::Z];
    clip_polygon(&whole, 0.1, &mut out);
    assert_eq!(out, whole);
    clip_polygon(&[DVec3::Z, DVec3::NAN, DVec3::Y], 0.1, &mut out);
    assert!(out.is_empty());
    clip_polygon(&[DVec3::Z, DVec3::NEG_Z, DVec3::splat(f64::MAX)], 0.1, &mut out);
    assert!(out.iter().all(|p| p.is_finite()));
}

#[test]
fn huge_polygons_are_clipped_to_the_rectangle() {
    let mut polygon = vec![v(-1e300, -1e300), v(1e300, -1e300), v(1e300, 1e300), v(-1e300, 1e300)];
    let rect = Rect::new(0.0, 0.0, 4.0, 3.0);
    clip_polygon_to_rect(&mut polygon, rect, &mut Vec::new());
    assert_eq!(area(&polygon).abs(), 12.0);
    let mut polygon = vec![v(f64::MIN, f64::MIN), v(f64::MAX, 0.0), v(0.0, f64::MAX)];
    clip_polygon_to_rect(&mut polygon, Rect::new(-1e308, -1e308, 1.7e308, 1.0), &mut Vec::new());
    assert!(polygon.iter().all(|p| p.is_finite()));
}

#[test]
fn contours_are_slices() {
    let mut contours = Contours::new();
    contours.push([]);
    assert!(contours.is_empty());
    contours.push([v(1.0, 2.0), v(3.0, 4.0)]);
    contours.push([v(5.0, 6.0)]);
    let slices: Vec<_> = contours.iter().collect();
    assert_eq!(slices, [&[v(1.0, 2.0), v(3.0, 4.0)][..], &[v(5.0, 6.0)]]);
    assert_eq!(contours.bounds(), Some(Rect::new(1.0, 2.0, 5.0, 6.0)));
    let broken = Contours { points: vec![v(0.0, 0.0)], ends: vec![7, 3] };
    assert!(broken.iter().all(|c| c.is_empty()));
}

#[test]
fn lines_are_quads() {
    let (a, b) = (v(1.0, 2.0), v(4.0, 6.0));
    let quad = line_quad(a, b, 2.0).unwrap();
    assert!((area(&quad) - 10.0).abs() < 1e-12);
    let square = line_quad_square(a, b, 2.0).unwrap();
    assert!((area(&square) - 14.0).abs() < 1e-12);
    let flipped = line_quad(b, a, 2.0).unwrap();
    assert_eq!([flipped[2], flipped[3], flipped[0], flipped[1]], quad);
    assert_eq!(line_quad(a, a, 2.0), None);
    assert_eq!(line_quad(a, b, 0.0), None);
    assert_eq!(line_quad(a, b, f64::NAN), None);
    assert_eq!(line_quad(a, v(f64::INFINITY, 0.0), 1.0), None);
    let tiny = line_quad(v(0.0, 0.0), v(1e-200, 0.0), 1.0).unwrap();
    assert_eq!((tiny[0].y, tiny[2].y), (-0.5, 0.5));
    assert!(line_quad(v(-1e30, 0.0), v(1e30, 1.0), 1.0).is_some());
}
