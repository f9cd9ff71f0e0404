//! Interpolation and conservative coverage.
#![allow(missing_docs)]

mod common;
use common::*;
use proptest::prelude::*;
use scumble_coverage::*;

fn sum(v: [f64; 3]) -> f64 {
    v[0] + v[1] + v[2]
}

proptest! {
    #[test]
    fn coordinates_sum_to_one_and_give_the_point_back(
        p in [point(18), point(18), point(18)],
        x in -40..60i32,
        y in -40..60i32,
        offset in any::<[u8; 2]>(),
    ) {
        let corners = to_points(&p);
        let corners = [corners[0], corners[1], corners[2]];
        let Some(b) = Barycentric::new(corners) else { return Ok(()) };
        let found = b.at(x, y, offset);
        let size = found.iter().fold(1.0, |m, v| f64::max(m, v.abs()));
        prop_assert!((sum(found) - 1.0).abs() < 1e-14 * size);
        let at = DVec2::new(
            f64::from(x) + f64::from(offset[0]) / 256.0,
            f64::from(y) + f64::from(offset[1]) / 256.0,
        );
        let back = corners[0] * found[0] + corners[1] * found[1] + corners[2] * found[2];
        let far = corners.iter().fold(1.0, |m, c| f64::max(m, c.length()));
        prop_assert!((back - at).length() < 1e-13 * size * far, "{} {}", back, at);
        // Where a run begins does not show in a single bit.
        let along: Vec<_> = b.row(x - 7, y, offset).take(8).collect();
        prop_assert_eq!(along[7], found);
    }

    #[test]
    fn perspective_weights_are_those_of_space(
        p in [point(18), point(18), point(18)],
        w in prop::array::uniform3(0.1..50.0f64),
        x in 0..18i32,
        y in 0..18i32,
    ) {
        let corners = to_points(&p);
        let corners = [corners[0], corners[1], corners[2]];
        let Some(perspective) = Perspective::new(corners, w) else { return Ok(()) };
        let pixel = perspective.at(x, y, [128, 128]);
        // The point of space that the weights make is seen at the pixel's centre.
        let size = pixel.weights.iter().fold(1.0, |m, v| f64::max(m, v.abs()));
        prop_assert!((sum(pixel.weights) - 1.0).abs() < 1e-12 * size);
        let mut point = DVec2::ZERO;
        let mut depth = 0.0;
        for i in 0..3 {
            point += corners[i] * (pixel.weights[i] * w[i]);
            depth += pixel.weights[i] * w[i];
        }
        let error = (point - DVec2::new(f64::from(x) + 0.5, f64::from(y) + 0.5) * depth).length();
        prop_assert!(error < 1e-7 * size * (1.0 + depth.abs()), "{}", error);
        prop_assert!((depth * pixel.inverse_w - 1.0).abs() < 1e-9 * size);
        // At the corners themselves the weights are theirs.
        for i in 0..3 {
            let at = |v: f64| ((v.floor()) as i32, ((v - v.floor()) * 256.0) as u8);
            let ((x, ox), (y, oy)) = (at(corners[i].x), at(corners[i].y));
            let found = perspective.at(x, y, [ox, oy]);
            prop_assert!((found.weights[i] - 1.0).abs() < 1e-9);
            prop_assert!((found.inverse_w * w[i] - 1.0).abs() < 1e-9);
        }
    }

    #[test]
    fn cells_hold_the_samples_and_full_ones_all_of_them(
        contours in prop::collection::vec(prop::collection::vec(point(18), 3..7), 1..3),
        rule in rule(),
        cell in 1..9u32,
    ) {
        let corners = [[0, 0], [255, 0], [0, 255], [255, 255], [128, 128]];
        let pattern = SamplePattern::custom(&corners).unwrap();
        for shape in [triangle(&contours[0]), polygon(&contours, rule)].into_iter().flatten() {
            let mut covers = std::collections::BTreeMap::new();
            shape.visit_cells(WINDOW, cell, |rect, cover| {
                assert_ne!(cover, Cover::None);
                for y in rect.y0..rect.y1 {
                    for x in rect.x0..rect.x1 {
                        assert_eq!(covers.insert((x, y), cover), None, "visited twice");
                    }
                }
            });
            let masks = raster(&shape, WINDOW, &pattern).masks;
            prop_assert!(masks.keys().all(|at| covers.contains_key(at)));
            for (at, cover) in covers {
                prop_assert!(WINDOW.contains(at.0, at.1));
                prop_assert!(cover != Cover::Full || masks.get(&at) == Some(&31));
            }
        }
    }
}

#[test]
fn what_has_no_area_or_no_depth_is_refused() {
    let p = |x: f64, y: f64| DVec2::new(x, y);
    let flat = [p(0.0, 0.0), p(4.0, 4.0), p(8.0, 8.0)];
    assert!(Barycentric::new(flat).is_none());
    assert!(Barycentric::new([p(0.0, 0.0), p(f64::NAN, 4.0), p(8.0, 1.0)]).is_none());
    assert!(Barycentric::new([p(0.0, 0.0), p(1e9, 4.0), p(8.0, 1.0)]).is_none());
    let good = [p(0.0, 0.0), p(4.0, 0.0), p(0.0, 4.0)];
    for w in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        assert!(Perspective::new(good, [1.0, w, 1.0]).is_none());
    }
}
