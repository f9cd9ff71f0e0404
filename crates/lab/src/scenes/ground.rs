//! The picture at the head of the README.

use crate::math::{cos, sin};
use crate::svg::{Point, Profile, Svg, number, points};
use std::f64::consts::TAU;

/// Focal length in pixels.
const FOCAL: f64 = 640.0;
/// The eye's height over the ground, in units of one tile.
const EYE: f64 = 1.7;
/// Where the horizon meets the middle of the canvas.
const CENTRE: Point = (400.0, 205.0);

/// A point of space as the camera sees it: x right, `up` over the ground, z ahead.
fn project(x: f64, up: f64, z: f64) -> Point {
    (CENTRE.0 + FOCAL * x / z, CENTRE.1 + FOCAL * (EYE - up) / z)
}

const ABOUT: &str = "ground: a tiled plane that recedes to its horizon, with a block and a panel on it. \
    The plane's own coordinates are (x, z) on the ground; its matrix3d projects them. \
    sc:wrap=\"repeat\" on a texture (clamp, repeat or mirror; clamp is the default) says what lies \
    beyond the unit square of its uvs";

pub(crate) fn draw() -> String {
    let mut svg = Svg::new(Profile::Svg, 800, 600, ABOUT);
    svg.texture("tile", "repeat");
    svg.texture("brick", "repeat");
    svg.texture("checker", "clamp");
    sky(&mut svg);
    plane(&mut svg);
    panel(&mut svg);
    block(&mut svg);
    svg.finish()
}

fn sky(svg: &mut Svg) {
    let (top, low) = ([0.29, 0.51, 0.76, 1.0], [0.93, 0.92, 0.87, 1.0]);
    let y = CENTRE.1 + 2.0;
    svg.colortri(&[(0.0, 0.0), (800.0, 0.0), (0.0, y)], &[top, top, low]);
    svg.colortri(&[(800.0, 0.0), (800.0, y), (0.0, y)], &[top, low, low]);
    for (base, height, color) in [(0.9, 46.0, "#a9b8c4"), (2.3, 26.0, "#8fa3ab")] {
        let mut hills: Vec<Point> = (0..=80)
            .map(|i| {
                let x = f64::from(i) * 10.0;
                let rise = 0.5 + 0.28 * sin(x * 0.011 + base) + 0.22 * sin(x * 0.029 + 2.0 * base);
                (x, CENTRE.1 - height * rise)
            })
            .collect();
        hills.extend([(800.0, y), (0.0, y)]);
        svg.polygon(&hills, &format!("fill=\"{color}\""));
    }
}

/// The block's footprint: corners on the ground, counter-clockwise as seen from above.
fn footprint() -> [Point; 4] {
    let (cx, cz, half, turn) = (0.55, 5.6, 0.8, 0.09 * TAU);
    let (s, c) = (sin(turn), cos(turn));
    [(-half, -half), (half, -half), (half, half), (-half, half)]
        .map(|(x, z)| (cx + c * x - s * z, cz + s * x + c * z))
}

fn plane(svg: &mut Svg) {
    const NEAR: f64 = 2.6;
    const FAR: f64 = 1300.0;
    let n = |v| number(v, 2);
    svg.open(&format!(
        "g transform=\"matrix3d({} 0 0 0  {} {} 0 1  0 0 1 0  0 {} 0 0)\"",
        n(FOCAL),
        n(CENTRE.0),
        n(CENTRE.1),
        n(FOCAL * EYE)
    ));
    // As wide as the canvas at every depth, with a little to spare.
    let half = |z: f64| 0.64 * z;
    let corners = [(-half(FAR), FAR), (half(FAR), FAR), (half(NEAR), NEAR), (-half(NEAR), NEAR)];
    svg.texquad(&corners, &corners, "tile");
    // The light comes from the left: the shadow is the footprint and its shift to the right.
    let shift = |(x, z): Point| (x + 1.5, z + 0.35);
    let f = footprint();
    let shadow = [f[0], shift(f[0]), shift(f[1]), shift(f[2]), f[2], f[3]];
    svg.polygon(&shadow, "fill=\"#101418\" fill-opacity=\"0.5\"");
    let foot = [(-2.6, 7.6), (-1.0, 8.3), (0.4, 8.65), (-1.1, 7.95)];
    svg.polygon(&foot, "fill=\"#101418\" fill-opacity=\"0.4\"");
    svg.close("g");
}

/// A portrait on a standing panel, seen at an angle.
fn panel(svg: &mut Svg) {
    let (left, right) = ((-2.6, 7.6), (-1.0, 8.3));
    let quad = |grow: f64| {
        let dx = (right.0 - left.0) * grow;
        let dz = (right.1 - left.1) * grow;
        [
            project(left.0 - dx, 2.35 + grow, left.1 - dz),
            project(right.0 + dx, 2.35 + grow, right.1 + dz),
            project(right.0 + dx, 0.0, right.1 + dz),
            project(left.0 - dx, 0.0, left.1 - dz),
        ]
    };
    svg.polygon(&quad(0.05), "fill=\"#2a2622\"");
    let inner = {
        let q = quad(0.0);
        let [tl, tr] = [q[0], q[1]];
        [tl, tr, project(right.0, 0.08, right.1), project(left.0, 0.08, left.1)]
    };
    svg.element(&format!(
        "image width=\"384\" height=\"512\" href=\"textures/portrait.png\" \
         preserveAspectRatio=\"none\" sc:quad=\"{}\"",
        points(&inner)
    ));
}

fn block(svg: &mut Svg) {
    const HEIGHT: f64 = 1.15;
    let f = footprint();
    let low = f.map(|(x, z)| project(x, 0.0, z));
    let high = f.map(|(x, z)| project(x, HEIGHT, z));
    let faces = [
        ("the left face, in the light", [high[3], high[0], low[0], low[3]], "brick", 0.0),
        ("the front, in the shade", [high[0], high[1], low[1], low[0]], "brick", 0.42),
        ("the top", [high[3], high[2], high[1], high[0]], "checker", 0.0),
    ];
    for (what, quad, texture, dark) in faces {
        let repeat = if texture == "brick" { (1.6, 1.15) } else { (1.0, 1.0) };
        svg.line(&format!("<!-- {what} -->"));
        svg.open(&format!("g sc:box=\"0 0 1 1\" sc:quad=\"{}\"", points(&quad)));
        let square = [(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0)];
        svg.texquad(&square, &square.map(|(u, v)| (u * repeat.0, v * repeat.1)), texture);
        if dark > 0.0 {
            svg.element(&format!(
                "rect width=\"1\" height=\"1\" fill=\"#0c1020\" fill-opacity=\"{dark}\""
            ));
        }
        svg.close("g");
    }
}
