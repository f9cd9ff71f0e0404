use super::*;
use crate::gallery::ellipses::{axes, matrix};
use crate::gallery::errata::{random_number, says};
use crate::math::cos;

/// Whether two directions are more than 2.5° apart, whichever way they point.
fn apart(a: DVec2, b: DVec2) -> bool {
    let limit = cos(2.5_f64.to_radians());
    a.dot(b).abs() < limit * a.length() * b.length()
}

fn columns(i: i64) -> Columns {
    let n = |seed| random_number(i, seed);
    [DVec2::new(n(10), n(11)), DVec2::new(n(12), n(13))]
}

#[test]
fn as_printed_half_of_all_axes_are_wrong() {
    const COUNT: i64 = 100_000;
    let wrong = |signs| {
        let off = |&i: &i64| apart(longer(half_axes(columns(i), signs)), axes(columns(i))[0]);
        (0..COUNT).filter(off).count() as f64 / COUNT as f64
    };
    says(&format!("{:.1} % of 100,000", 100.0 * wrong(Signs::PRINTED)));
    // The sine's sign alone, with B as printed.
    says(&format!(
        "{:.1} % of random J get the wrong axis",
        100.0 * wrong(Signs { b: false, ..Signs::RIGHT })
    ));
    assert!(wrong(Signs::RIGHT) < 1e-4);
}

#[test]
fn lengths_are_right_whatever_the_signs() {
    for i in 0..1000 {
        let ([long, _], found) = (axes(columns(i)), longer(half_axes(columns(i), Signs::PRINTED)));
        assert!((found.length() / long.length() - 1.0).abs() < 1e-6);
    }
}

#[test]
fn at_45_degrees_an_ellipse_counts_as_a_circle() {
    let columns: Columns = [DVec2::new(3.6, 1.8), DVec2::new(1.8, 3.6)];
    let [long, short] = axes(columns);
    let [a, b] = half_axes(columns, Signs::PRINTED);
    assert_eq!(a.length(), b.length());
    says(&format!(
        "with half-axes of {:.1} and {:.1} it becomes a circle of {:.1}",
        long.length(),
        short.length(),
        a.length()
    ));
    assert!(!apart(longer(half_axes(columns, Signs::RIGHT)), long));
}

#[test]
fn the_transpose_leans_otherwise() {
    // The second Jacobian of the page on EWA.
    let j = matrix([DVec2::new(5.0, 1.5), DVec2::new(4.0, 3.5)]);
    let degrees = |m: Matrix2| {
        let [x, y] = m.axes().direction;
        y.atan2(x).to_degrees().rem_euclid(180.0)
    };
    says(&format!("{:.0}° off", (degrees(j) - degrees(j.transpose())).abs()));
}

#[test]
fn a_share_of_a_sample_is_none() {
    let n: f64 = 2.5;
    let reach = |count: f64| 100.0 * count / n;
    says(&format!("{:.0} or {:.0} %", reach(n.floor()), reach(n.ceil())));
    let flat: Columns = [DVec2::new(1.0, 2.0), DVec2::new(2.0, 4.0)];
    let [a, b] = half_axes(flat, Signs::PRINTED);
    assert!(!(a.is_finite() && b.is_finite()));
}
