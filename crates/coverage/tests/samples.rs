//! Sampled coverage against its definition.
#![allow(missing_docs)]

mod common;
use common::*;
use proptest::prelude::*;
use scumble_coverage::*;

fn covered(p: &[[i64; 2]], clip: IntRect, pattern: &SamplePattern) -> Collected {
    match triangle(p) {
        Some(shape) => raster(&shape, clip, pattern),
        None => Collected::new(pattern),
    }
}

proptest! {
    #[test]
    fn a_triangle_owns_the_samples_of_its_definition(
        p in [point(18), point(18), point(18)],
        pattern in any_pattern(),
    ) {
        let expected = oracle(&[p.to_vec()], FillRule::NonZero, WINDOW, &pattern);
        prop_assert_eq!(covered(&p, WINDOW, &pattern), expected);
    }

    #[test]
    fn a_polygon_owns_the_samples_of_its_definition(
        contours in prop::collection::vec(prop::collection::vec(point(18), 1..9), 1..4),
        rule in rule(),
        pattern in any_pattern(),
    ) {
        let expected = oracle(&contours, rule, WINDOW, &pattern);
        let actual = polygon(&contours, rule)
            .map_or_else(|| Collected::new(&pattern), |s| raster(&s, WINDOW, &pattern));
        prop_assert_eq!(actual, expected);
    }

    #[test]
    fn tiles_of_any_size_give_the_same(
        p in [point(18), point(18), point(18)],
        tile in (1..12, 1..12),
        origin in (-20..-3, -20..-2),
        pattern in any_pattern(),
    ) {
        let polygon = polygon(&[p.to_vec()], FillRule::EvenOdd);
        for shape in [triangle(&p), polygon].into_iter().flatten() {
            let whole = raster(&shape, WINDOW, &pattern);
            let mut parts = Collected::new(&pattern);
            let mut scratch = Scratch::new();
            for y in (origin.1..WINDOW.y1).step_by(tile.1 as usize) {
                for x in (origin.0..WINDOW.x1).step_by(tile.0 as usize) {
                    let clip = IntRect::new(x, y, x + tile.0, y + tile.1).intersect(&WINDOW);
                    shape.rasterize(clip, &pattern, &mut scratch, &mut parts);
                }
            }
            prop_assert_eq!(parts, whole);
        }
    }

    #[test]
    fn covers_tells_the_truth(
        contours in prop::collection::vec(prop::collection::vec(point(18), 3..7), 1..3),
        rule in rule(),
        corner in (-6..20, -6..20),
        size in (1..9, 1..9),
    ) {
        let rect = IntRect::new(corner.0, corner.1, corner.0 + size.0, corner.1 + size.1);
        // The corners of the pixels too: what is certain holds for any pattern.
        let pattern = SamplePattern::custom(&[[0, 0], [255, 0], [0, 255], [255, 255], [128, 128]]).unwrap();
        let shapes = [triangle(&contours[0]), polygon(&contours, rule)];
        for shape in shapes.into_iter().flatten() {
            let masks = raster(&shape, rect, &pattern).masks;
            match shape.covers(rect) {
                Cover::None => prop_assert!(masks.is_empty()),
                Cover::Full => {
                    prop_assert_eq!(masks.len() as i32, size.0 * size.1);
                    prop_assert!(masks.values().all(|&m| m == 31));
                }
                Cover::Partial => {}
            }
            let all = raster(&shape, WINDOW, &pattern).masks;
            let bounds = shape.bounds();
            prop_assert!(all.keys().all(|&(x, y)| bounds.contains(x, y)));
        }
    }
}

proptest! {
    /// Beyond the guard band the edges are rounded where they cross its border, so that a sample
    /// closer than 1/256 pixel to an edge may go either way. All others must not.
    #[test]
    fn huge_shapes_are_right_near_the_origin(
        p in prop::array::uniform3(prop::array::uniform2(-(1i64 << 44)..1 << 44)),
        near in point(4),
        swap in 0..4usize,
    ) {
        let mut p = p;
        if let Some(corner) = p.get_mut(swap) {
            *corner = near;
        }
        let pattern = SamplePattern::standard(4).unwrap();
        let found = covered(&p, IntRect::new(-3, -3, 8, 8), &pattern);
        for ((x, y), s) in (-3..8).flat_map(|y| (-3..8).map(move |x| (x, y))).zip((0..4).cycle()) {
            let o = pattern.offsets()[s].map(i64::from);
            let at = [i64::from(x) * 256 + o[0], i64::from(y) * 256 + o[1]];
            let close = (0..3).any(|i| {
                let (a, b) = (p[i], p[(i + 1) % 3]);
                let (dx, dy) = ((b[0] - a[0]) as f64, (b[1] - a[1]) as f64);
                let e = i128::from(b[0] - a[0]) * i128::from(at[1] - a[1])
                    - i128::from(b[1] - a[1]) * i128::from(at[0] - a[0]);
                (e as f64).abs() <= dx.hypot(dy)
            });
            let inside = winding(&[p.to_vec()], at[0], at[1]) != 0;
            let mask = found.masks.get(&(x, y)).copied().unwrap_or(0);
            prop_assert!(close || (mask >> s & 1 == 1) == inside, "{} {} {}", x, y, s);
        }
    }
}

#[test]
fn a_square_on_the_grid_is_seen_exactly() {
    let square = vec![[0, 0], [20 * 256, 0], [20 * 256, 18 * 256], [0, 18 * 256]];
    let shape = polygon(&[square], FillRule::NonZero).unwrap();
    assert_eq!(shape.bounds(), IntRect::new(0, 0, 20, 18));
    assert_eq!(shape.covers(IntRect::new(0, 0, 20, 18)), Cover::Full);
    assert_eq!(shape.covers(IntRect::new(0, 0, 21, 18)), Cover::Partial);
    assert_eq!(shape.covers(IntRect::new(20, 0, 21, 18)), Cover::None);
    // A level edge through the rectangle is not overlooked.
    let low = vec![[-256, 300], [2560, 300], [2560, 4000], [-256, 4000]];
    let shape = polygon(&[low], FillRule::NonZero).unwrap();
    assert_eq!(shape.covers(IntRect::new(0, 1, 2, 2)), Cover::Partial);
    assert_eq!(shape.covers(IntRect::new(0, 2, 2, 4)), Cover::Full);
}

#[test]
fn huge_coordinates_are_clipped_and_bad_ones_refused() {
    let pattern = SamplePattern::standard(4).unwrap();
    let clip = IntRect::new(0, 0, 16, 16);
    let big = 1e30;
    let shape =
        Shape::triangle([DVec2::new(-big, -big), DVec2::new(big, -big), DVec2::new(0.0, big)]);
    let shape = shape.unwrap().unwrap();
    assert_eq!(shape.covers(clip), Cover::Full);
    assert_eq!(raster(&shape, clip, &pattern).masks.len(), 256);
    for bad in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
        let p = [DVec2::new(0.0, 0.0), DVec2::new(1.0, bad), DVec2::new(0.0, 1.0)];
        assert!(matches!(Shape::triangle(p), Err(CoverageError::NotFinite(_))));
        assert!(Shape::polygon([&p[..]], FillRule::EvenOdd).is_err());
    }
    let empty = IntRect::new(5, 5, 5, 9);
    assert!(raster(&shape, empty, &pattern).masks.is_empty());
    let inverted = IntRect::new(9, 9, 0, 0);
    assert!(raster(&shape, inverted, &pattern).masks.is_empty());
    let everything = IntRect::new(i32::MIN, 3, i32::MAX, 4);
    assert_eq!(shape.covers(everything), Cover::Partial);
    let small = triangle(&[[0, 0], [2560, 0], [0, 2560]]).unwrap();
    assert_eq!(small.covers(IntRect::new(i32::MIN, i32::MIN, i32::MAX, i32::MAX)), Cover::Partial);
}

#[test]
fn no_area_is_no_shape() {
    let p = |x: f64, y: f64| DVec2::new(x, y);
    assert!(Shape::triangle([p(0.0, 0.0), p(5.0, 5.0), p(9.0, 9.0)]).unwrap().is_none());
    assert!(Shape::triangle([p(1.0, 1.0); 3]).unwrap().is_none());
    let line = [p(0.0, 0.0), p(5.0, 5.0), p(9.0, 9.0), p(2.0, 2.0)];
    assert!(Shape::polygon([&line[..], &[]], FillRule::NonZero).unwrap().is_none());
    assert!(Shape::polygon([], FillRule::NonZero).unwrap().is_none());
}
