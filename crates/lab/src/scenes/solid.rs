//! Solids drawn as their visible faces, projected here.

use super::Scene;
use crate::math::{cos, sin};
use crate::svg::{Point, Profile, Svg, css};
use std::f64::consts::TAU;

pub(crate) fn all() -> Vec<Scene> {
    vec![("cube", cube())]
}

/// A point of space: x right, y down, z away from the eye.
pub(crate) type Solid = [f64; 3];

/// Turns about the vertical axis, angle in turns.
pub(crate) fn turn_y([x, y, z]: Solid, turns: f64) -> Solid {
    let (s, c) = (sin(turns * TAU), cos(turns * TAU));
    [c * x + s * z, y, c * z - s * x]
}

/// Tips about the level axis, angle in turns.
pub(crate) fn turn_x([x, y, z]: Solid, turns: f64) -> Solid {
    let (s, c) = (sin(turns * TAU), cos(turns * TAU));
    [x, c * y - s * z, s * y + c * z]
}

/// Six faces of nine by nine triangle pairs, in painter's order, flat shaded; the pairs tint.
fn cube() -> String {
    let mut svg = Svg::new(
        Profile::Course,
        400,
        400,
        "cube: three faces of flat triangles in perspective, each pair sharing its diagonal",
    );
    let place = |p: Solid| -> Point {
        let [x, y, z] = turn_x(turn_y(p, 0.09), 0.075);
        let depth = 4.4 + z;
        (200.0 + 480.0 * x / depth, 195.0 + 480.0 * y / depth)
    };
    type Face = (fn(f64, f64) -> Solid, [f64; 3], f64);
    let faces: [Face; 3] = [
        (|s, t| [s, -1.0, -t], [0.98, 0.80, 0.38], 1.0),
        (|s, t| [s, t, -1.0], [0.86, 0.36, 0.24], 0.9),
        (|s, t| [1.0, t, s], [0.26, 0.42, 0.62], 0.8),
    ];
    const N: i32 = 6;
    for (face, color, light) in faces {
        for j in 0..N {
            for i in 0..N {
                let at = |di: i32, dj: i32| {
                    let s = f64::from(i + di) * 2.0 / f64::from(N) - 1.0;
                    let t = f64::from(j + dj) * 2.0 / f64::from(N) - 1.0;
                    place(face(s, t))
                };
                let tint = light * if (i + j) % 2 == 0 { 1.0 } else { 0.86 };
                let fill = |k: f64| format!("fill=\"{}\"", css(color.map(|v| v * tint * k)));
                svg.polygon(&[at(0, 0), at(1, 0), at(0, 1)], &fill(1.0));
                svg.polygon(&[at(1, 0), at(1, 1), at(0, 1)], &fill(0.96));
            }
        }
    }
    svg.finish()
}
