//! Rectangles before synthetic cameras, found again in their photos.
#![allow(missing_docs)]

use proptest::prelude::*;
use scumble_geometry::{DVec2, DVec3, GeometryError, Rectified, Winding};

const PHOTO: DVec2 = DVec2::new(4000.0, 3000.0);

fn v(x: f64, y: f64) -> DVec2 {
    DVec2::new(x, y)
}

/// A pinhole camera before a page in its own plane, which is turned and pushed away.
#[derive(Debug, Clone, Copy)]
struct Scene {
    page: DVec2,
    focal: f64,
    /// About the camera's x, y and z axes.
    turns: [f64; 3],
    at: DVec3,
}

impl Scene {
    fn photo(&self, on_page: DVec2) -> DVec2 {
        let [x, y, z] = self.turns;
        let turn = |a: f64, p: f64, q: f64| (p * a.cos() - q * a.sin(), p * a.sin() + q * a.cos());
        let p = on_page - self.page * 0.5;
        let (px, py) = turn(z, p.x, p.y);
        let (py, pz) = turn(x, py, 0.0);
        let (px, pz) = turn(y, px, pz);
        let p = DVec3::new(px, py, pz) + self.at;
        PHOTO * 0.5 + v(p.x, p.y) * (self.focal / p.z)
    }

    fn corners(&self) -> [DVec2; 4] {
        let DVec2 { x, y } = self.page;
        [v(0.0, 0.0), v(x, 0.0), v(x, y), v(0.0, y)].map(|p| self.photo(p))
    }
}

fn scene() -> impl Strategy<Value = Scene> {
    let tilt = || prop_oneof![-0.7..-0.25f64, 0.25..0.7f64];
    let at = (-0.4..0.4f64, -0.4..0.4f64, 3.0..5.0f64);
    (0.5..2.0f64, 2500.0..6000.0f64, tilt(), tilt(), -0.1..0.1f64, at).prop_map(
        |(width, focal, x, y, z, at)| Scene {
            page: v(width, 1.0),
            focal,
            turns: [x, y, z],
            at: DVec3::new(at.0, at.1, at.2),
        },
    )
}

proptest! {
    #[test]
    fn the_page_and_the_camera_are_found(scene in scene(), s in 0.0..1.0f64, t in 0.0..1.0f64) {
        let found = Rectified::new(scene.corners(), PHOTO).unwrap();
        let focal = found.focal.unwrap();
        prop_assert!((focal / scene.focal - 1.0).abs() < 1e-6, "{focal} {scene:?}");
        let ratio = found.size.x / found.size.y;
        prop_assert!((ratio / scene.page.x - 1.0).abs() < 1e-6, "{ratio} {scene:?}");
        // Every point of the page is where it was.
        let size = found.size;
        let seen = found.map(size.x, size.y).project(v(s * size.x, t * size.y)).unwrap();
        let truth = scene.photo(v(s * scene.page.x, t * scene.page.y));
        prop_assert!((seen - truth).length() < 1e-6, "{seen} {truth}");
        // And nothing of the photo is lost.
        let [a, b, c, d] = scene.corners();
        let long = |p: DVec2, q: DVec2| (p - q).length();
        prop_assert!(size.x >= long(a, b).max(long(d, c)) * 0.999_999);
        prop_assert!(size.y >= long(a, d).max(long(b, c)) * 0.999_999);
    }

    #[test]
    fn corners_that_are_a_pixel_off_do_little_harm(
        scene in scene(), jitter in prop::array::uniform8(-1.0..1.0f64),
    ) {
        let mut corners = scene.corners();
        for (i, corner) in corners.iter_mut().enumerate() {
            *corner += v(jitter[2 * i], jitter[2 * i + 1]);
        }
        let found = Rectified::new(corners, PHOTO).unwrap();
        let ratio = found.size.x / found.size.y;
        // Two million cases stay within this; the worst of them that was looked at was off by an eighth.
        prop_assert!((ratio / scene.page.x - 1.0).abs() < 0.15, "{ratio} {scene:?}");
    }
}

#[test]
fn an_ordinary_page() {
    let at = DVec3::new(0.1, -0.2, 4.0);
    let scene = Scene { page: v(0.7, 1.0), focal: 3800.0, turns: [0.5, -0.4, 0.1], at };
    let found = Rectified::new(scene.corners(), PHOTO).unwrap();
    assert!((found.focal.unwrap() - 3800.0).abs() < 1e-4);
    assert!((found.size.x / found.size.y - 0.7).abs() < 1e-8);
}

#[test]
fn without_perspective_the_sides_speak() {
    let straight = [v(100.0, 50.0), v(500.0, 50.0), v(500.0, 250.0), v(100.0, 250.0)];
    let found = Rectified::new(straight, PHOTO).unwrap();
    assert_eq!((found.focal, found.size), (None, v(400.0, 200.0)));
    // Tilted about one axis only: two sides stay parallel.
    let tilted = [v(1500.0, 1000.0), v(2500.0, 1000.0), v(2700.0, 2000.0), v(1300.0, 2000.0)];
    let found = Rectified::new(tilted, PHOTO).unwrap();
    assert_eq!(found.focal, None);
    assert!(found.size.is_finite() && found.size.x >= 1400.0);
}

#[test]
fn quads_that_no_camera_sees_are_refused() {
    let quad = |p: [(f64, f64); 4]| p.map(|(x, y)| v(x, y));
    let crossed = quad([(0.0, 0.0), (10.0, 10.0), (10.0, 0.0), (0.0, 10.0)]);
    let dart = quad([(0.0, 0.0), (10.0, 0.0), (3.0, 3.0), (0.0, 10.0)]);
    for bad in [crossed, dart] {
        assert_eq!(Rectified::new(bad, PHOTO), Err(GeometryError::NotConvex));
    }
    let line = quad([(0.0, 0.0), (5.0, 0.0), (10.0, 0.0), (0.0, 10.0)]);
    assert_eq!(Winding::of_convex(line), Err(GeometryError::DegenerateQuad));
    let nan = quad([(f64::NAN, 0.0), (5.0, 0.0), (10.0, 9.0), (0.0, 10.0)]);
    assert!(matches!(Winding::of_convex(nan), Err(GeometryError::NotFinite(_))));
    let mut square = quad([(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0)]);
    assert_eq!(Winding::of_convex(square), Ok(Winding::Clockwise));
    square.reverse();
    assert_eq!(Winding::of_convex(square), Ok(Winding::Counterclockwise));
}
