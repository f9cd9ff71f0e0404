//! Homographies, Jacobians and interpolation under perspective.
#![allow(missing_docs)]

use proptest::prelude::*;
use scumble_geometry::{Affine, DVec2, DVec3, GeometryError, Homography, Interpolator};

fn v(x: f64, y: f64) -> DVec2 {
    DVec2::new(x, y)
}

const UNIT: [DVec2; 4] =
    [DVec2::new(0.0, 0.0), DVec2::new(1.0, 0.0), DVec2::new(1.0, 1.0), DVec2::new(0.0, 1.0)];

/// Quads with four corners in four separate boxes, so that all are convex and well conditioned,
/// at any place and size.
fn quad() -> impl Strategy<Value = [DVec2; 4]> {
    let jitter = prop::array::uniform8(-0.2..0.2f64);
    (jitter, -1e4..1e4f64, -1e4..1e4f64, 2..12i32, any::<bool>()).prop_map(
        |(j, x, y, exponent, mirror)| {
            let size = 2f64.powi(exponent);
            let mut quad =
                core::array::from_fn(|i| v(x, y) + (UNIT[i] + v(j[2 * i], j[2 * i + 1])) * size);
            if mirror {
                quad.reverse();
            }
            quad
        },
    )
}

fn size(quad: &[DVec2; 4]) -> f64 {
    (quad[2] - quad[0]).length()
}

/// A number and its derivative in one direction.
#[derive(Clone, Copy)]
struct Dual(f64, f64);

impl Dual {
    fn linear(self, a: f64, other: Self, b: f64, c: f64) -> Self {
        Self(a * self.0 + b * other.0 + c, a * self.1 + b * other.1)
    }

    fn over(self, other: Self) -> Self {
        let q = self.0 / other.0;
        Self(q, (self.1 - q * other.1) / other.0)
    }
}

fn dual_project(h: &Homography, p: [Dual; 2]) -> [Dual; 2] {
    let [x, y, w] = h.m.map(|r| p[0].linear(r[0], p[1], r[1], r[2]));
    [x.over(w), y.over(w)]
}

proptest! {
    #[test]
    fn four_points_go_to_four_points(from in quad(), to in quad()) {
        let map = Homography::from_points(from, to).unwrap();
        // The coordinates themselves are known to ε of their offset, and no better.
        let bound = 1e-12 * size(&to).max(to[0].length()) * (1.0 + from[0].length() / size(&from));
        for i in 0..4 {
            let image = map.project(from[i]).unwrap();
            prop_assert!((image - to[i]).length() <= bound, "{image} {} {bound}", to[i]);
        }
    }

    #[test]
    fn inverse_undoes_and_keeps_the_sign_of_w(
        from in quad(), to in quad(), s in 0.0..1.0f64, t in 0.0..1.0f64,
    ) {
        let map = Homography::from_points(from, to).unwrap();
        let square = Homography::unit_square_to_quad(from).unwrap();
        let p = square.project(v(s, t)).unwrap();
        // How far away the quads lie, in their own sizes. Inverting a matrix squares it.
        let condition = (1.0 + from[0].length() / size(&from)) * (1.0 + to[0].length() / size(&to));
        prop_assume!(condition < 1e6);
        // In front on all of the source quad, because both quads are convex.
        let q = map.project(p).unwrap();
        let inverse = map.inverse().unwrap();
        prop_assert!(inverse.project_homogeneous(q).z > 0.0);
        let back = inverse.project(q).unwrap();
        prop_assert!((back - p).length() <= 1e-14 * size(&from) * condition * condition);
    }

    #[test]
    fn jacobian_is_the_dual_number(from in quad(), to in quad(), s in 0.0..1.0f64, t in 0.0..1.0f64) {
        // The composition of two maps, differentiated step by step, against the product's Jacobian.
        let a = Homography::unit_square_to_quad(to).unwrap();
        let b = Homography::unit_square_to_quad(from).unwrap().inverse().unwrap();
        let p = Homography::unit_square_to_quad(from).unwrap().project(v(s, t)).unwrap();
        let jacobian = (a * b).jacobian(p);
        let dx = dual_project(&a, dual_project(&b, [Dual(p.x, 1.0), Dual(p.y, 0.0)]));
        let dy = dual_project(&a, dual_project(&b, [Dual(p.x, 0.0), Dual(p.y, 1.0)]));
        let scale = size(&to) / size(&from);
        let bound = 1e-9 * scale * (1.0 + from[0].length() / size(&from)) * (1.0 + to[0].length() / size(&to));
        let pairs = [(jacobian.a, dx[0].1), (jacobian.c, dx[1].1), (jacobian.b, dy[0].1), (jacobian.d, dy[1].1)];
        for (ours, dual) in pairs {
            prop_assert!((ours - dual).abs() <= bound, "{ours} {dual}");
        }
        // And the chain rule.
        let inner = b.jacobian(p);
        let chain = a.jacobian(b.project(p).unwrap()) * inner;
        prop_assert!((chain.a - jacobian.a).abs() <= bound && (chain.d - jacobian.d).abs() <= bound);
    }

    #[test]
    fn jacobian_is_the_limit_of_differences(to in quad(), s in 0.1..0.9f64, t in 0.1..0.9f64) {
        let to = to.map(|p| p - to[0]);
        let map = Homography::unit_square_to_quad(to).unwrap();
        let step = 1e-5;
        let jacobian = map.jacobian(v(s, t));
        let at = |x: f64, y: f64| map.project(v(x, y)).unwrap();
        let dx = (at(s + step, t) - at(s - step, t)) / (2.0 * step);
        let dy = (at(s, t + step) - at(s, t - step)) / (2.0 * step);
        let bound = 1e-6 * size(&to);
        prop_assert!((dx - v(jacobian.a, jacobian.c)).length() < bound);
        prop_assert!((dy - v(jacobian.b, jacobian.d)).length() < bound);
    }

    #[test]
    fn triangle_map_agrees_with_space(
        xs in prop::array::uniform9(-10.0..10.0f64), uv in prop::array::uniform6(-2.0..2.0f64),
        b in prop::array::uniform3(0.05..1.0f64),
    ) {
        // Vertices anywhere, in front or behind; w within ±3.
        let mut p: [DVec3; 3] = core::array::from_fn(|i| {
            DVec3::new(xs[3 * i] * 30.0, xs[3 * i + 1] * 30.0, xs[3 * i + 2] * 0.25 + 0.5)
        });
        let values: [DVec2; 3] = core::array::from_fn(|i| v(uv[2 * i], uv[2 * i + 1]));
        let det = p[0].dot(p[1].cross(p[2]));
        prop_assume!(det.abs() > 100.0);
        // A point of the triangle in space, and what it shows.
        let sum = b[0] + b[1] + b[2];
        let mut point = (p[0] * b[0] + p[1] * b[1] + p[2] * b[2]) / sum;
        if point.z < 0.0 {
            // The same on the screen, in front of the eye.
            (p, point) = (p.map(|v| -v), -point);
        }
        prop_assume!(point.z > 0.01);
        let value = (values[0] * b[0] + values[1] * b[1] + values[2] * b[2]) / sum;
        let screen = point.truncate() / point.z;

        let map = Homography::from_triangle(p, values).unwrap();
        let seen = map.project(screen).unwrap();
        prop_assert!((seen - value).length() < 1e-7, "{seen} {value}");
        let w = 1.0 / map.project_homogeneous(screen).z;
        prop_assert!((w - point.z).abs() < 1e-7);

        let interpolator = Interpolator::new(p).unwrap();
        let bary = interpolator.barycentrics(screen);
        for i in 0..3 {
            prop_assert!((bary[i] - b[i] / sum).abs() < 1e-7);
        }
        prop_assert!((bary.iter().sum::<f64>() - 1.0).abs() < 1e-12);
        prop_assert_eq!(interpolator.interpolate(screen, &[[0.7, -3.0]; 3]), [0.7, -3.0]);
        let [u] = interpolator.interpolate(screen, &values.map(|v| [v.x]));
        prop_assert!((u - value.x).abs() < 1e-7);
    }

    #[test]
    fn nothing_panics(m in prop::array::uniform9(any::<f64>()), x in any::<f64>(), y in any::<f64>()) {
        let map = Homography::new([[m[0], m[1], m[2]], [m[3], m[4], m[5]], [m[6], m[7], m[8]]]);
        if let Some(p) = map.project(v(x, y)) {
            prop_assert!(p.is_finite());
        }
        if let Ok(inverse) = map.inverse() {
            prop_assert!(inverse.is_finite());
        }
        let _ = map.jacobian(v(x, y)).axes();
        let quad = [v(m[0], m[1]), v(m[2], m[3]), v(m[4], m[5]), v(m[6], m[7])];
        if let Ok(map) = Homography::from_points(UNIT, quad) {
            prop_assert!(map.is_finite());
        }
        if let Ok(map) = Homography::from_points(quad, UNIT) {
            prop_assert!(map.is_finite());
        }
        let triangle = [0, 3, 6].map(|i| DVec3::new(m[i], m[i + 1], m[i + 2]));
        let uv = [v(x, y), v(0.0, 1.0), v(1.0, 0.0)];
        if let Ok(map) = Homography::from_triangle(triangle, uv) {
            prop_assert!(map.is_finite());
        }
    }
}

#[test]
fn degenerate_quads_are_refused() {
    let degenerate = [
        [v(0.0, 0.0); 4],
        [v(5.0, 5.0), v(5.0, 5.0), v(9.0, 9.0), v(2.0, 7.0)],
        [v(0.0, 0.0), v(1.0, 1.0), v(2.0, 2.0), v(0.0, 2.0)],
        // Collinear up to the rounding of decimals, and far from the origin.
        [v(0.1, 0.1), v(0.2, 0.2), v(0.3, 0.3), v(0.0, 0.2)],
        [v(1e6 + 0.1, 0.1), v(1e6 + 0.2, 0.2), v(1e6 + 0.3, 0.3), v(1e6, 0.2)],
    ];
    for quad in degenerate {
        let mut rotated = quad;
        for _ in 0..4 {
            rotated.rotate_left(1);
            assert_eq!(Homography::from_points(UNIT, rotated), Err(GeometryError::DegenerateQuad));
            assert_eq!(Homography::from_points(rotated, UNIT), Err(GeometryError::DegenerateQuad));
        }
    }
    let infinite = [v(0.0, 0.0), v(f64::INFINITY, 0.0), v(1.0, 1.0), v(0.0, 1.0)];
    let error = Homography::unit_square_to_quad(infinite);
    assert_eq!(error, Err(GeometryError::NotFinite(infinite[1])));
}

#[test]
fn thin_and_tiny_and_huge_quads_are_not_degenerate() {
    for (width, height) in [(1.0, 1e-9), (1e-100, 1e-100), (1e100, 1e100), (1e-9, 1.0)] {
        let quad = UNIT.map(|p| v(p.x * width, p.y * height));
        let map = Homography::from_points(quad, UNIT).unwrap();
        for i in 0..4 {
            assert!((map.project(quad[i]).unwrap() - UNIT[i]).length() < 1e-12);
        }
    }
}

#[test]
fn parallelograms_are_affine() {
    let quad = [v(3.0, 4.0), v(7.0, 5.0), v(9.0, 11.0), v(5.0, 10.0)];
    let map = Homography::unit_square_to_quad(quad).unwrap();
    assert_eq!(map.to_affine(), Some(Affine::new(4.0, 1.0, 2.0, 6.0, 3.0, 4.0)));
}

#[test]
fn equal_w_gives_an_exactly_affine_map() {
    for w in [1.0, 0.3, 7.0] {
        let p = [v(10.0, 20.0), v(90.0, 33.0), v(41.0, 77.0)].map(|p| (p * w).extend(w));
        let map = Homography::from_triangle(p, [v(0.0, 0.0), v(1.0, 0.0), v(0.0, 1.0)]).unwrap();
        assert_eq!(map.m[2], [0.0, 0.0, 1.0]);
        assert!((map.project(v(90.0, 33.0)).unwrap() - v(1.0, 0.0)).length() < 1e-14);
    }
}

#[test]
fn flat_triangles_have_no_map() {
    let edge_on = [DVec3::new(0.0, 0.0, 1.0), DVec3::new(1.0, 1.0, 1.0), DVec3::new(2.0, 2.0, 1.0)];
    assert_eq!(Interpolator::new(edge_on), Err(GeometryError::Singular));
    let nan = [DVec3::NAN, DVec3::X, DVec3::Y];
    assert!(matches!(Interpolator::new(nan), Err(GeometryError::NotFinite(_))));
}

#[test]
fn a_singular_map_has_no_inverse() {
    let squeeze = Homography::new([[1.0, 2.0, 0.0], [2.0, 4.0, 0.0], [0.0, 0.0, 1.0]]);
    assert_eq!(squeeze.inverse(), Err(GeometryError::Singular));
    // Composed with its inverse a map is the identity, scale included.
    let map = Homography::new([[2.0, 1.0, 30.0], [0.0, 3.0, -4.0], [0.001, 0.002, -2.0]]);
    let product = map * map.inverse().unwrap();
    for (row, expected) in product.m.iter().zip(&Homography::IDENTITY.m) {
        for (a, b) in row.iter().zip(expected) {
            assert!((a - b).abs() < 1e-13);
        }
    }
}
