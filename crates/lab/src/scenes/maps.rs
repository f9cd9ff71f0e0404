//! The world over many textured triangles.

use super::Scene;
use super::solid::{turn_x, turn_y};
use crate::math::{cos, sin};
use crate::svg::{Point, Profile, Svg, regular};
use std::f64::consts::TAU;

pub(crate) fn all() -> Vec<Scene> {
    vec![("map", map()), ("globe", globe())]
}

/// A sheet of 26 by 18 cells, waving like a flag.
fn map() -> String {
    const COLUMNS: i32 = 26;
    const ROWS: i32 = 18;
    let mut svg = Svg::new(
        Profile::Course,
        640,
        400,
        "map: the world on a waving sheet of 936 textured triangles",
    );
    svg.texture("world", "clamp");
    let uv = |i: i32, j: i32| (f64::from(i) / f64::from(COLUMNS), f64::from(j) / f64::from(ROWS));
    let node = |i: i32, j: i32| -> Point {
        let (u, v) = uv(i, j);
        let wave = sin(u * TAU * 1.3 + v * 1.1);
        let swell = cos(u * TAU * 0.9 - v * 2.0);
        (30.0 + 580.0 * u + 16.0 * swell, 45.0 + 300.0 * v + 30.0 * wave - 14.0 * swell * v)
    };
    for j in 0..ROWS {
        for i in 0..COLUMNS {
            let cell = [(i, j), (i + 1, j), (i + 1, j + 1), (i, j + 1)];
            let corners = cell.map(|(i, j)| node(i, j));
            svg.texquad(&corners, &cell.map(|(i, j)| uv(i, j)), "world");
        }
    }
    svg.finish()
}

/// The half of a sphere that faces the eye, in cells of ten degrees.
fn globe() -> String {
    let mut svg = Svg::new(
        Profile::Svg,
        480,
        480,
        "globe: the near half of a sphere as some 600 textured triangles before a night sky",
    );
    svg.element("rect width=\"480\" height=\"480\" fill=\"#0b1420\"");
    for i in 0..90 {
        let at = |seed| crate::math::random(i, 3, seed) * 480.0;
        let radius = if i % 7 == 0 { "1.2" } else { "0.6" };
        let (x, y) = (crate::svg::number(at(1), 1), crate::svg::number(at(2), 1));
        svg.element(&format!("circle cx=\"{x}\" cy=\"{y}\" r=\"{radius}\" fill=\"#dfe8f0\""));
    }
    for i in 0..10 {
        let radius = 206.0 - f64::from(i);
        svg.polygon(
            &regular(90, 240.0, 240.0, radius, 0.0),
            "fill=\"#6fb7e8\" fill-opacity=\"0.06\"",
        );
    }
    svg.texture("world", "clamp");
    let uv = |i: i32, j: i32| (f64::from(i) / 36.0, f64::from(j) / 18.0);
    let node = |i: i32, j: i32| {
        let (lon, lat) = (f64::from(i) * TAU / 36.0, (f64::from(j) - 9.0) * TAU / 36.0);
        let p = [cos(lat) * sin(lon), sin(lat), cos(lat) * cos(lon)];
        turn_x(turn_y(p, 0.03), 0.06)
    };
    for j in 0..18 {
        for i in 0..36 {
            let cell = [(i, j), (i + 1, j), (i + 1, j + 1), (i, j + 1)];
            let nodes = cell.map(|(i, j)| node(i, j));
            if nodes.iter().any(|n| n[2] > 0.0) {
                continue;
            }
            let flat = nodes.map(|n| (240.0 + 200.0 * n[0], 240.0 + 200.0 * n[1]));
            let uvs = cell.map(|(i, j)| uv(i, j));
            // At the poles one side of the cell is a point and one triangle is enough.
            match j {
                0 => svg.textri(&[flat[0], flat[2], flat[3]], &[uvs[0], uvs[2], uvs[3]], "world"),
                17 => svg.textri(&[flat[0], flat[1], flat[2]], &[uvs[0], uvs[1], uvs[2]], "world"),
                _ => svg.texquad(&flat, &uvs, "world"),
            }
        }
    }
    svg.finish()
}
