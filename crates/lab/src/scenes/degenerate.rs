//! Triangles that hardly are: what a rasterizer leaks through.

use super::Scene;
use crate::math::random;
use crate::svg::{Point, Profile, Svg, css, hue, polar};

pub(crate) fn all() -> Vec<Scene> {
    vec![("degenerate_fan", fan()), ("degenerate_mesh", mesh()), ("thin", thin())]
}

/// Needles from one corner of a square to its two far sides.
fn fan() -> String {
    const STEPS: i32 = 180;
    let mut svg = Svg::new(
        Profile::Course,
        500,
        500,
        "two fans of 360 needles each: no white may show between them, and near the apex no needle \
         is a sample wide",
    );
    let rim = |i: i32| -> Point {
        let t = f64::from(i) * 500.0 / f64::from(STEPS);
        if i <= STEPS { (500.0, t) } else { (1000.0 - t, 500.0) }
    };
    for i in 0..2 * STEPS {
        let color = if i % 2 == 0 { "#10202c".to_owned() } else { css(hue(f64::from(i) / 360.0)) };
        svg.polygon(&[(0.0, 0.0), rim(i), rim(i + 1)], &format!("fill=\"{color}\""));
    }
    // The second fan has its apex on a pixel corner within the first, and thinner needles.
    let ring = |i: i32| polar(330.0, 330.0, 120.0, f64::from(i) / 360.0);
    for i in 0..360 {
        let color = if i % 2 == 0 { "#f4e7c5" } else { "#a03b2a" };
        svg.polygon(&[(330.0, 330.0), ring(i), ring(i + 1)], &format!("fill=\"{color}\""));
    }
    svg.finish()
}

/// A mesh whose every edge also carries triangles without area.
fn mesh() -> String {
    const N: i64 = 14;
    let mut svg = Svg::new(
        Profile::Course,
        500,
        500,
        "a mesh of 392 slivers that covers the square; on its edges lie triangles of zero area in \
         red, which own no sample and must not show",
    );
    let node = |i: i64, j: i64| -> Point {
        let inner = |k: i64| k > 0 && k < N;
        // Rows nearly meet in pairs, so that every second row of triangles is a strip of slivers.
        let squeeze = if j % 2 == 1 { 34.0 } else { 0.0 };
        let jitter = |seed| random(i, j, seed) - 0.5;
        let x = i as f64 * 500.0 / N as f64 + if inner(i) { 20.0 * jitter(1) } else { 0.0 };
        let y =
            j as f64 * 500.0 / N as f64 + if inner(j) { squeeze + 0.9 * jitter(2) } else { 0.0 };
        (x, y)
    };
    for j in 0..N {
        for i in 0..N {
            let (a, b, c, d) = (node(i, j), node(i + 1, j), node(i + 1, j + 1), node(i, j + 1));
            let tone = |seed| 0.35 + 0.3 * random(i, j, seed);
            let blue = |t: f64| format!("fill=\"{}\"", css([t * 0.5, t * 0.9, t * 1.3]));
            svg.polygon(&[a, b, d], &blue(tone(5)));
            svg.polygon(&[b, c, d], &blue(tone(6)));
        }
    }
    for j in 0..N {
        for i in 0..N {
            let (a, b) = (node(i, j), node(i + 1, j + 1));
            let red = "fill=\"#ff0000\"";
            svg.polygon(&[a, node(i + 1, j), a], red);
            svg.polygon(&[a, a, a], red);
            let middle = ((a.0 + b.0) / 2.0, a.1);
            svg.polygon(&[(a.0, a.1), middle, (b.0, a.1)], red);
        }
    }
    svg.finish()
}

/// Spokes from a fiftieth of a pixel to four pixels wide.
fn thin() -> String {
    let mut svg = Svg::new(
        Profile::Course,
        400,
        400,
        "thin triangles: spokes from a fiftieth of a pixel to four pixels at the rim, and wedges \
         that close to nothing",
    );
    for i in 0..96 {
        let turn = f64::from(i) / 96.0;
        let width = 0.02 + 4.0 * turn * turn;
        let tip = polar(200.0, 200.0, 30.0, turn);
        let rim = polar(200.0, 200.0, 180.0, turn);
        let across = polar(0.0, 0.0, width / 2.0, turn + 0.25);
        let color = css(hue(turn).map(|v| v * 0.75));
        svg.polygon(
            &[tip, (rim.0 + across.0, rim.1 + across.1), (rim.0 - across.0, rim.1 - across.1)],
            &format!("fill=\"{color}\""),
        );
    }
    for i in 0..20 {
        let y = f64::from(i) * 20.0 + 10.0;
        let height = 0.05 + 0.12 * f64::from(i);
        svg.polygon(&[(0.0, y), (15.0, y), (0.0, y + height)], "fill=\"#203040\"");
        svg.polygon(&[(400.0, y), (385.0, y + height), (400.0, y + height)], "fill=\"#203040\"");
    }
    svg.finish()
}
