//! Geometry and coverage together: whoever cuts a polygon into triangles, and however, every
//! sample belongs to exactly one of them.

use proptest::prelude::*;
use scumble::coverage::{SamplePattern, Shape};
use scumble::geometry::{DVec2, FillRule, IntRect, triangulate};
use scumble_tests::{Ownership, Tally, samples_of};

const CANVAS: IntRect = IntRect::new(-4, -4, 44, 44);

/// Points are whole 256ths of a pixel, so that snapping moves nothing.
type Fixed = [i64; 2];

fn to_point(p: Fixed) -> DVec2 {
    DVec2::new(p[0] as f64 / 256.0, p[1] as f64 / 256.0)
}

fn triangle(p: [Fixed; 3]) -> Option<Shape> {
    Shape::triangle(p.map(to_point)).expect("finite corners")
}

fn polygon(points: &[Fixed], rule: FillRule) -> Option<Shape> {
    let contour: Vec<DVec2> = points.iter().map(|&p| to_point(p)).collect();
    Shape::polygon([&contour[..]], rule).expect("finite corners")
}

/// Twice the signed area.
fn area(a: Fixed, b: Fixed, c: Fixed) -> i64 {
    (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])
}

fn any_point() -> impl Strategy<Value = Fixed> {
    // Now and then on whole and half pixels, where samples and edges coincide.
    let coordinate = prop_oneof![
        3 => 0..10_240_i64,
        1 => (0..40_i64).prop_map(|v| v * 256),
        1 => (0..80_i64).prop_map(|v| v * 128),
    ];
    [coordinate.clone(), coordinate]
}

fn any_pattern() -> impl Strategy<Value = SamplePattern> {
    let standard = prop::sample::select(vec![1, 2, 4, 8, 16])
        .prop_map(|n| SamplePattern::standard(n).expect("a standard pattern"));
    let grid = prop::sample::select(vec![1, 4, 9, 16])
        .prop_map(|n| SamplePattern::grid(n).expect("a grid"));
    prop_oneof![standard, grid]
}

/// Cuts a triangle at points within it, over and over: each point that falls in a triangle of the
/// list splits it in three, or in two where it falls on an edge (with a third of no area).
fn split(corners: [Fixed; 3], points: &[Fixed]) -> Vec<[Fixed; 3]> {
    let mut pieces = vec![corners];
    for &p in points {
        let within = |t: &[Fixed; 3]| {
            let [a, b, c] = *t;
            let sides = [area(a, b, p), area(b, c, p), area(c, a, p)];
            sides.iter().all(|&s| s >= 0) || sides.iter().all(|&s| s <= 0)
        };
        if let Some(at) = pieces.iter().position(within) {
            let [a, b, c] = pieces.swap_remove(at);
            pieces.extend([[a, b, p], [b, c, p], [c, a, p]]);
        }
    }
    pieces
}

fn tally(pieces: &[[Fixed; 3]], pattern: &SamplePattern) -> Tally {
    let mut tally = Tally::new(CANVAS, pattern);
    for &piece in pieces {
        tally.add(&samples_of(triangle(piece).as_ref(), CANVAS, pattern));
    }
    tally
}

/// What the triangles of a triangulation own together.
fn tally_of_triangulation(
    contours: &[Vec<DVec2>],
    rule: FillRule,
    pattern: &SamplePattern,
) -> Tally {
    let mut tally = Tally::new(CANVAS, pattern);
    for triangle in triangulate(contours.iter().map(Vec::as_slice), rule) {
        let shape = Shape::triangle(triangle).expect("finite corners");
        tally.add(&samples_of(shape.as_ref(), CANVAS, pattern));
    }
    tally
}

fn any_rule() -> impl Strategy<Value = FillRule> {
    prop::sample::select(vec![FillRule::NonZero, FillRule::EvenOdd])
}

/// A star about the middle of the canvas: it never crosses itself, however its radii vary. They
/// are in 256ths of a pixel.
fn star(radii: &[i64]) -> Vec<DVec2> {
    let n = radii.len() as f64;
    let corner = |(i, &radius): (usize, &i64)| {
        let (sin, cos) = (std::f64::consts::TAU * i as f64 / n).sin_cos();
        let at = |unit: f64| 20.0 + (unit * radius as f64).round() / 256.0;
        DVec2::new(at(cos), at(sin))
    };
    radii.iter().enumerate().map(corner).collect()
}

/// The distance from `p` to the nearest segment of closed contours.
fn distance(p: DVec2, contours: &[Vec<DVec2>]) -> f64 {
    let segments = contours.iter().flat_map(|c| c.iter().zip(c.iter().cycle().skip(1)));
    let to_segment = |(&a, &b): (&DVec2, &DVec2)| {
        let (along, from) = (b - a, p - a);
        let t = (from.dot(along) / along.dot(along)).clamp(0.0, 1.0);
        (from - along * if t.is_nan() { 0.0 } else { t }).length()
    };
    segments.map(to_segment).fold(f64::INFINITY, f64::min)
}

proptest! {
    #[test]
    fn a_simple_polygon_owns_what_its_triangles_own(
        outer in prop::collection::vec(1_500..4_600_i64, 3..40),
        inner in prop::collection::vec(100..700_i64, 3..20),
        mirrored in any::<bool>(),
        pattern in any_pattern(),
    ) {
        // A hole for the even-odd rule either way round; for nonzero if it runs against the rim.
        let mut contours = vec![star(&outer), star(&inner)];
        if mirrored {
            contours[1].reverse();
        }
        for rule in [FillRule::NonZero, FillRule::EvenOdd] {
            let shape = Shape::polygon(contours.iter().map(Vec::as_slice), rule);
            let whole = samples_of(shape.expect("finite").as_ref(), CANVAS, &pattern);
            let tally = tally_of_triangulation(&contours, rule, &pattern);
            prop_assert_eq!(&tally.union, &whole);
            prop_assert_eq!(tally.repeated, Ownership::empty(CANVAS, &pattern));
        }
    }

    #[test]
    fn a_polygon_that_crosses_itself_is_cut_without_overlap_and_near_its_outline_only(
        points in prop::collection::vec(any_point(), 3..14),
        pattern in any_pattern(),
        rule in any_rule(),
    ) {
        let contours = vec![points.iter().map(|&p| to_point(p)).collect::<Vec<_>>()];
        let whole = samples_of(polygon(&points, rule).as_ref(), CANVAS, &pattern);
        let tally = tally_of_triangulation(&contours, rule, &pattern);
        prop_assert_eq!(&tally.repeated, &Ownership::empty(CANVAS, &pattern));
        for (x, y) in (CANVAS.y0..CANVAS.y1).flat_map(|y| (CANVAS.x0..CANVAS.x1).map(move |x| (x, y))) {
            let differ = whole.mask(x, y) ^ tally.union.mask(x, y);
            for (bit, offset) in pattern.offsets().iter().enumerate() {
                if differ >> bit & 1 == 1 {
                    let at = |i: i32, o: u8| f64::from(i) + f64::from(o) / 256.0;
                    let sample = DVec2::new(at(x, offset[0]), at(y, offset[1]));
                    // A rounded corner moves an edge by less than 1/256 pixel.
                    prop_assert!(distance(sample, &contours) <= 1.0 / 256.0, "{}", sample);
                }
            }
        }
    }

    #[test]
    fn a_triangle_cut_anyhow_shares_out_its_samples(
        corners in [any_point(), any_point(), any_point()],
        points in prop::collection::vec(any_point(), 0..12),
        pattern in any_pattern(),
    ) {
        let whole = samples_of(triangle(corners).as_ref(), CANVAS, &pattern);
        let tally = tally(&split(corners, &points), &pattern);
        prop_assert_eq!(&tally.union, &whole);
        prop_assert_eq!(tally.repeated, Ownership::empty(CANVAS, &pattern));
    }

    #[test]
    fn a_mesh_covers_its_square_once(
        jitter in prop::collection::vec(-255..255_i64, 2 * 7 * 7),
        flips in prop::collection::vec(any::<bool>(), 36),
        pattern in any_pattern(),
    ) {
        // Six by six cells of 1,024, their inner nodes moved by less than a quarter of one, so
        // that cells stay convex and either diagonal cuts them.
        let node = |i: usize, j: usize| -> Fixed {
            let move_by = |k: usize, at: usize| if at.is_multiple_of(6) { 0 } else { jitter[k] };
            let k = 2 * (7 * j + i);
            [1024 * i as i64 + move_by(k, i), 1024 * j as i64 + move_by(k + 1, j)]
        };
        let mut pieces = Vec::new();
        for (cell, flip) in flips.into_iter().enumerate() {
            let (i, j) = (cell % 6, cell / 6);
            let (a, b, c, d) = (node(i, j), node(i + 1, j), node(i + 1, j + 1), node(i, j + 1));
            // Either diagonal, either winding.
            pieces.extend(if flip { [[a, b, c], [a, d, c]] } else { [[b, d, a], [b, c, d]] });
        }
        let tally = tally(&pieces, &pattern);
        let square = [[0, 0], [6144, 0], [6144, 6144], [0, 6144]];
        let whole = samples_of(polygon(&square, FillRule::NonZero).as_ref(), CANVAS, &pattern);
        prop_assert_eq!(&tally.union, &whole);
        prop_assert_eq!(whole.count() as usize, 24 * 24 * pattern.len());
        prop_assert_eq!(tally.repeated, Ownership::empty(CANVAS, &pattern));
    }

    #[test]
    fn a_triangle_is_a_polygon_of_three(
        corners in [any_point(), any_point(), any_point()],
        turn in 0..3_usize,
        mirrored in any::<bool>(),
        pattern in any_pattern(),
    ) {
        let mut order = corners;
        order.rotate_left(turn);
        if mirrored {
            order.reverse();
        }
        let expected = samples_of(triangle(corners).as_ref(), CANVAS, &pattern);
        let turned = samples_of(triangle(order).as_ref(), CANVAS, &pattern);
        prop_assert_eq!(&turned, &expected);
        for rule in [FillRule::NonZero, FillRule::EvenOdd] {
            let shape = polygon(&order, rule);
            prop_assert_eq!(&samples_of(shape.as_ref(), CANVAS, &pattern), &expected);
        }
    }

    #[test]
    fn whole_pixels_move_samples_and_nothing_else(
        points in prop::collection::vec(any_point(), 3..9),
        dx in -300_000..300_000_i32,
        dy in -300_000..300_000_i32,
        pattern in any_pattern(),
        rule in any_rule(),
    ) {
        let by = |p: &Fixed| [p[0] + 256 * i64::from(dx), p[1] + 256 * i64::from(dy)];
        let moved: Vec<Fixed> = points.iter().map(by).collect();
        let there = IntRect::new(CANVAS.x0 + dx, CANVAS.y0 + dy, CANVAS.x1 + dx, CANVAS.y1 + dy);
        let here = samples_of(polygon(&points, rule).as_ref(), CANVAS, &pattern);
        let there = samples_of(polygon(&moved, rule).as_ref(), there, &pattern);
        for y in CANVAS.y0..CANVAS.y1 {
            for x in CANVAS.x0..CANVAS.x1 {
                prop_assert_eq!(here.mask(x, y), there.mask(x + dx, y + dy), "at {}, {}", x, y);
            }
        }
    }
}
