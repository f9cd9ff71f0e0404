use super::*;
use scumble_geometry::DVec2;

fn map(text: &str, x: f64, y: f64) -> (f64, f64) {
    let p = parse(text).unwrap().project(DVec2::new(x, y)).unwrap();
    (p.x, p.y)
}

#[track_caller]
fn near(actual: (f64, f64), expected: (f64, f64)) {
    let d = (actual.0 - expected.0).abs().max((actual.1 - expected.1).abs());
    assert!(d < 1e-12, "{actual:?} {expected:?}");
}

#[test]
fn the_functions_of_svg_in_any_spacing() {
    near(map("", 3.0, 4.0), (3.0, 4.0));
    near(map("none", 3.0, 4.0), (3.0, 4.0));
    near(map("matrix(1 2 3 4 5 6)", 1.0, 10.0), (36.0, 48.0));
    near(map("matrix(1,2,3,4,5,6)", 1.0, 10.0), (36.0, 48.0));
    near(map("translate(10-20)", 0.0, 0.0), (10.0, -20.0));
    near(map("translate(.5.5)", 0.0, 0.0), (0.5, 0.5));
    near(map(" scale ( 2 ) ", 3.0, 4.0), (6.0, 8.0));
    near(map("scale(2,3)translate(1)", 3.0, 4.0), (8.0, 12.0));
    near(map("translate(1),,scale(2)", 3.0, 4.0), (7.0, 8.0));
    near(map("rotate(90)", 1.0, 0.0), (0.0, 1.0));
    near(map("rotate(90 10 10)", 20.0, 10.0), (10.0, 20.0));
    near(map("skewX(45)", 1.0, 2.0), (3.0, 2.0));
    near(map("skewY(45)", 1.0, 2.0), (1.0, 3.0));
}

#[test]
fn css_units() {
    near(map("rotate(90deg) translate(1in, 10px)", 0.0, 0.0), (-10.0, 96.0));
    near(map("rotate(0.25turn)", 1.0, 0.0), (0.0, 1.0));
    near(map("rotate(100grad)", 1.0, 0.0), (0.0, 1.0));
    near(map("scale(50%)", 2.0, 4.0), (1.0, 2.0));
    near(map("translateX(1e2px)", 0.0, 0.0), (100.0, 0.0));
    assert!(parse("translate(50%)").is_err());
    assert!(parse("translate(1em)").is_err());
}

#[test]
fn matrix3d_is_column_major_and_restricted_to_the_plane() {
    // x' = (m11·x + m21·y + m41)/w, w = m14·x + m24·y + m44.
    let text = "matrix3d(2,3,99,0.25, 5,7,99,0.5, 99,99,99,99, 11,13,99,2)";
    let (x, y) = (3.0, 4.0);
    let w = 0.25 * x + 0.5 * y + 2.0;
    near(map(text, x, y), ((2.0 * x + 5.0 * y + 11.0) / w, (3.0 * x + 7.0 * y + 13.0) / w));
}

#[test]
fn perspective_and_turns_compose_in_space() {
    // The top edge tips away from the eye: rotateX(60deg) puts y = -100 at z = -86.6.
    let (x, y) = map("perspective(200px) rotateX(60deg)", 100.0, -100.0);
    let k = 200.0 / (200.0 + 100.0 * 0.75_f64.sqrt());
    near((x, y), (100.0 * k, -50.0 * k));
    // Two half turns are one whole, in space though not in the plane.
    near(map("rotateY(90deg) rotateY(-90deg)", 5.0, 6.0), (5.0, 6.0));
    near(map("perspective(100) translateZ(50px)", 5.0, 6.0), (10.0, 12.0));
    near(map("perspective(none) translateZ(50px)", 5.0, 6.0), (5.0, 6.0));
    near(map("rotate3d(0, 0, 2, 90deg)", 1.0, 0.0), (0.0, 1.0));
    near(map("scale3d(2, 3, 4)", 1.0, 1.0), (2.0, 3.0));
    assert_eq!(parse("rotateX(60deg)").unwrap().m[2], [0.0, 0.0, 1.0]);
}

#[test]
fn what_is_wrong_is_said() {
    for bad in [
        "rotate",
        "rotate(",
        "rotate(1",
        "rotate()",
        "rotate(1,2)",
        "turn(3)",
        "scale(nan)",
        "scale(1e999)",
        "matrix(1 2 3)",
        "(3)",
        "💥",
        "scale(1e200) scale(1e200)",
        "translate(1 2 3 4 5 6 7 8 9 10 11 12 13 14 15 16 17)",
    ] {
        assert!(parse(bad).is_err(), "{bad}");
    }
}
