//! One scene for each element of the course's dialect.

use super::Scene;
use crate::math::{cos, random, sin};
use crate::svg::{Point, Profile, Svg, css, hue, number, points, polar, regular};
use std::f64::consts::TAU;

pub(crate) fn all(data: &str) -> Vec<Scene> {
    vec![
        ("course_line", line()),
        ("course_polyline", polyline()),
        ("course_polygon", polygon()),
        ("course_rect", rect()),
        ("course_point", point()),
        ("course_image", image(data)),
        ("course_opacity", opacity()),
        ("course_transform", transform()),
        ("course_textri", textri()),
        ("wheel", wheel()),
        ("robot", robot()),
    ]
}

fn course(width: u32, height: u32, about: &str) -> Svg {
    Svg::new(Profile::Course, width, height, about)
}

fn stroke_line(svg: &mut Svg, a: Point, b: Point, color: &str) {
    let n = |v| number(v, 2);
    svg.element(&format!(
        "line x1=\"{}\" y1=\"{}\" x2=\"{}\" y2=\"{}\" stroke=\"{color}\"",
        n(a.0),
        n(a.1),
        n(b.0),
        n(b.1)
    ));
}

fn line() -> String {
    let mut svg = course(400, 400, "line: every slope, and two families whose envelope is a curve");
    for i in 0..72 {
        let turn = f64::from(i) / 72.0;
        let inner = polar(200.0, 200.0, 20.0, turn);
        stroke_line(&mut svg, inner, polar(200.0, 200.0, 110.0, turn), &css(hue(turn)));
    }
    for i in 0..=25 {
        let t = f64::from(i) * 8.0;
        stroke_line(&mut svg, (0.0, t), (t, 200.0), "#204060");
        stroke_line(&mut svg, (400.0, 400.0 - t), (400.0 - t, 200.0), "#204060");
        stroke_line(&mut svg, (200.0 + t, 0.0), (400.0, t), "#803020");
        stroke_line(&mut svg, (200.0 - t, 400.0), (0.0, 400.0 - t), "#803020");
    }
    svg.line("<!-- without a stroke nothing is drawn -->");
    svg.element("line x1=\"0\" y1=\"0\" x2=\"400\" y2=\"400\"");
    svg.finish()
}

fn polyline() -> String {
    let mut svg = course(400, 400, "polyline: open chains; the ends are not joined");
    for (k, color) in ["#1f6f8b", "#c8553d", "#588b3a"].iter().enumerate() {
        let phase = k as f64 * 0.7;
        let chain: Vec<Point> = (0..=240)
            .map(|i| {
                let t = f64::from(i) / 240.0 * 0.97 * TAU;
                (200.0 + 180.0 * sin(3.0 * t + phase), 200.0 + 180.0 * sin(2.0 * t + phase * 0.3))
            })
            .collect();
        svg.element(&format!("polyline points=\"{}\" stroke=\"{color}\"", points(&chain)));
    }
    svg.finish()
}

fn polygon() -> String {
    let mut svg = course(
        480,
        360,
        "polygon: convex, concave and crossing itself; the fill, then the outline",
    );
    for (i, n) in (3..9).enumerate() {
        let (column, row) = ((i % 3) as f64, (i / 3) as f64);
        let corners = regular(n, 60.0 + column * 100.0, 60.0 + row * 100.0, 45.0, -0.25);
        let color = css(hue(i as f64 / 6.0).map(|v| 0.35 + 0.55 * v));
        svg.polygon(&corners, &format!("fill=\"{color}\" stroke=\"#203040\""));
    }
    let star = regular(5, 390.0, 70.0, 65.0, -0.25);
    let crossing: Vec<Point> = (0..5).map(|i| star[i * 2 % 5]).collect();
    svg.polygon(&crossing, "fill=\"#e0a020\" stroke=\"#402000\"");
    let gear: Vec<Point> = (0..48)
        .map(|i| {
            let radius = if (i / 2) % 2 == 0 { 68.0 } else { 48.0 };
            polar(390.0, 220.0, radius, f64::from(i) / 48.0)
        })
        .collect();
    svg.polygon(&gear, "fill=\"#607890\"");
    svg.line("<!-- no fill is black -->");
    svg.polygon(
        &[(20.0, 240.0), (300.0, 240.0), (260.0, 340.0), (160.0, 270.0), (60.0, 340.0)],
        "",
    );
    svg.finish()
}

fn rect() -> String {
    let mut svg =
        course(400, 400, "rect: a mosaic, then outlines, then one that lies across a pixel grid");
    for row in 0..8 {
        for column in 0..8 {
            let tone = random(column, row, 9);
            let color = css([0.25 + 0.6 * tone, 0.45 + 0.2 * tone, 0.75 - 0.5 * tone]);
            let outline = if (row + column) % 5 == 0 { " stroke=\"#101820\"" } else { "" };
            svg.element(&format!(
                "rect x=\"{}\" y=\"{}\" width=\"44\" height=\"44\" fill=\"{color}\"{outline}",
                column * 50 + 3,
                row * 50 + 3
            ));
        }
    }
    svg.element("rect x=\"100.3\" y=\"150.7\" width=\"199.5\" height=\"98.25\" fill=\"#fffaf0\" stroke=\"#c02020\"");
    svg.finish()
}

fn point() -> String {
    let mut svg =
        course(400, 400, "point: a rect without width and height colours the one pixel it lies in");
    // The golden angle in turns: 1 − 1/φ.
    let golden = 0.381_966_011_250_105;
    for i in 0..1400 {
        let radius = 5.2 * f64::from(i).sqrt();
        let (x, y) = polar(200.0, 200.0, radius, f64::from(i) * golden);
        let color = css(hue(f64::from(i) / 1400.0).map(|v| v * 0.8));
        let (x, y) = (number(x, 2), number(y, 2));
        svg.element(&format!("rect x=\"{x}\" y=\"{y}\" width=\"0\" height=\"0\" fill=\"{color}\""));
    }
    svg.finish()
}

fn image(data: &str) -> String {
    let mut svg = course(400, 300, "image: one picture inside the file, drawn in five sizes");
    let boxes = [
        (10.0, 10.0, 220.0, 220.0),
        (240.0, 10.0, 64.0, 64.0),
        (320.0, 10.0, 32.0, 32.0),
        (365.0, 10.0, 16.0, 16.0),
        (240.0, 90.0, 150.0, 60.0),
        (240.0, 165.0, 60.0, 125.0),
    ];
    for (x, y, w, h) in boxes {
        svg.element(&format!(
            "image x=\"{x}\" y=\"{y}\" width=\"{w}\" height=\"{h}\" xlink:href=\"{data}\""
        ));
    }
    svg.finish()
}

fn opacity() -> String {
    let mut svg = course(400, 400, "fill-opacity and stroke-opacity: the order of drawing shows");
    for i in 0..12 {
        let turn = f64::from(i) / 12.0;
        let (x, y) = polar(200.0, 200.0, 90.0, turn);
        let color = css(hue(turn));
        let corners = regular(40, x, y, 85.0, 0.0);
        svg.polygon(
            &corners,
            &format!(
                "fill=\"{color}\" fill-opacity=\"0.3\" stroke=\"#000000\" stroke-opacity=\"0.5\""
            ),
        );
    }
    svg.finish()
}

fn transform() -> String {
    let mut svg =
        course(420, 280, "transform: each kind once over the same arrow, and a list of three");
    let kinds = [
        "translate(60,60)",
        "translate(200 70) scale(1.6)",
        "translate(340,60) scale(1.5,0.6)",
        "translate(60 200) rotate(40)",
        "rotate(-30,200,200) translate(200,200)",
        "translate(320,200) skewX(30)",
        "translate(380,200) skewY(-25) scale(.7)",
        "matrix(0.6 0.6 -0.9 0.3 130 130)",
    ];
    for (i, kind) in kinds.iter().enumerate() {
        let color = css(hue(i as f64 / 8.0).map(|v| 0.2 + 0.6 * v));
        svg.open(&format!("g transform=\"{kind}\""));
        svg.polygon(
            &[(-40.0, -10.0), (10.0, -10.0), (10.0, 10.0), (-40.0, 10.0)],
            &format!("fill=\"{color}\""),
        );
        svg.polygon(
            &[(8.0, -25.0), (40.0, 0.0), (8.0, 25.0)],
            &format!("fill=\"{color}\" stroke=\"#202020\""),
        );
        svg.close("g");
    }
    svg.finish()
}

fn textri() -> String {
    let mut svg = course(
        400,
        400,
        "textri: the corners of the uv square are the centres of the corner texels",
    );
    svg.line("<!-- used before it is declared -->");
    svg.texquad(
        &[(140.0, 90.0), (260.0, 90.0), (260.0, 250.0), (140.0, 250.0)],
        &[(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0)],
        "portrait",
    );
    svg.texture("portrait", "clamp");
    svg.texture("chart", "clamp");
    svg.texture("brick", "clamp");
    for i in 0..12 {
        let (a, b) = (f64::from(i) / 12.0, f64::from(i + 1) / 12.0);
        let texture = if i % 2 == 0 { "chart" } else { "brick" };
        svg.textri(
            &[
                polar(200.0, 190.0, 180.0, a),
                polar(200.0, 190.0, 180.0, b),
                polar(200.0, 190.0, 118.0, (a + b) / 2.0),
            ],
            &[(0.0, 0.0), (1.0, 0.0), (0.5, 1.0)],
            texture,
        );
    }
    svg.finish()
}

fn wheel() -> String {
    let mut svg =
        course(400, 400, "colortri: a colour wheel, its colours blended from corner to corner");
    const SPOKES: u32 = 24;
    let opaque = |c: [f64; 3]| [c[0], c[1], c[2], 1.0];
    for i in 0..SPOKES {
        let (a, b) = (f64::from(i) / f64::from(SPOKES), f64::from(i + 1) / f64::from(SPOKES));
        let (outer, inner) = (190.0, 110.0);
        let at = |r: f64, t: f64| polar(200.0, 200.0, r, t);
        let dark = |t: f64| opaque(hue(t).map(|v| v * 0.25));
        let full = |t: f64| opaque(hue(t));
        svg.colortri(&[(200.0, 200.0), at(inner, a), at(inner, b)], &[[1.0; 4], full(a), full(b)]);
        svg.colortri(&[at(inner, a), at(outer, a), at(outer, b)], &[full(a), dark(a), dark(b)]);
        svg.colortri(&[at(inner, a), at(outer, b), at(inner, b)], &[full(a), dark(b), full(b)]);
    }
    svg.line("<!-- alpha is blended too -->");
    svg.colortri(
        &[(0.0, 0.0), (90.0, 0.0), (0.0, 90.0)],
        &[[0.0, 0.0, 0.0, 1.0], [1.0, 0.0, 0.0, 0.0], [0.0, 0.0, 1.0, 0.0]],
    );
    svg.finish()
}

/// A box about the origin as the course draws one: two triangles.
fn unit_box(svg: &mut Svg, color: &str) {
    svg.polygon(&[(-1.0, -1.0), (1.0, -1.0), (-1.0, 1.0)], &format!("fill=\"{color}\""));
    svg.polygon(&[(-1.0, 1.0), (1.0, -1.0), (1.0, 1.0)], &format!("fill=\"{color}\""));
}

fn limb(svg: &mut Svg, place: &str, length: f64, bend: f64, color: &str, hand: &str) {
    let half = number(length / 2.0, 2);
    svg.open(&format!("g transform=\"{place}\""));
    svg.open(&format!("g transform=\"translate(0 {half}) scale(9 {half})\""));
    unit_box(svg, color);
    svg.close("g");
    svg.open(&format!("g transform=\"translate(0 {}) rotate({bend})\"", number(length + 4.0, 2)));
    svg.open(&format!("g transform=\"translate(0 {half}) scale(8 {half})\""));
    unit_box(svg, color);
    svg.close("g");
    svg.open(&format!(
        "g transform=\"translate(0 {}) rotate(45) scale(9)\"",
        number(length + 6.0, 2)
    ));
    unit_box(svg, hand);
    svg.close("g");
    svg.close("g");
    svg.close("g");
}

fn robot() -> String {
    let (body, joint) = ("#c23b2e", "#2b3a55");
    let mut svg =
        course(400, 400, "robot: every part of it one unit box, placed by nested transforms");
    svg.open("g transform=\"translate(200 185)\"");
    limb(&mut svg, "translate(-52 -55) rotate(125)", 58.0, -30.0, "#8f9bb3", joint);
    limb(&mut svg, "translate(52 -55) rotate(-40)", 58.0, -65.0, "#8f9bb3", joint);
    limb(&mut svg, "translate(-26 62) rotate(14)", 60.0, -4.0, "#8f9bb3", joint);
    limb(&mut svg, "translate(26 62) rotate(-38)", 60.0, 62.0, "#8f9bb3", joint);
    svg.open("g transform=\"scale(46 64)\"");
    unit_box(&mut svg, body);
    svg.close("g");
    svg.open("g transform=\"translate(0 -20) scale(28 22)\"");
    unit_box(&mut svg, "#f3d9a4");
    svg.close("g");
    svg.open("g transform=\"translate(0 -72) rotate(8)\"");
    svg.open("g transform=\"scale(10 12)\"");
    unit_box(&mut svg, joint);
    svg.close("g");
    svg.open("g transform=\"translate(0 -40) scale(34 30)\"");
    unit_box(&mut svg, body);
    for x in ["-.42", ".42"] {
        svg.open(&format!("g transform=\"translate({x} -.2) scale(.22)\""));
        unit_box(&mut svg, "#ffffff");
        svg.open("g transform=\"translate(.3 .1) rotate(45) scale(.45)\"");
        unit_box(&mut svg, "#101820");
        svg.close("g");
        svg.close("g");
    }
    svg.open("g transform=\"translate(0 .5) skewX(-20) scale(.5 .12)\"");
    unit_box(&mut svg, "#101820");
    svg.close("g");
    svg.close("g");
    svg.element("line x1=\"0\" y1=\"-70\" x2=\"14\" y2=\"-104\" stroke=\"#2b3a55\"");
    svg.open("g transform=\"translate(14 -106) rotate(45) scale(5)\"");
    unit_box(&mut svg, "#e8b21e");
    svg.close("g");
    svg.close("g");
    svg.close("g");
    let floor: Vec<Point> =
        (0..=40).map(|i| (f64::from(i) * 10.0, 388.0 + 4.0 * cos(f64::from(i) * 0.5))).collect();
    svg.element(&format!("polyline points=\"{}\" stroke=\"#607080\"", points(&floor)));
    svg.finish()
}
