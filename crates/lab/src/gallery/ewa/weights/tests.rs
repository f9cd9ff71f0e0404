use super::*;
use crate::gallery::ellipses::matrix;
use crate::gallery::errata::says;

/// (JJᵀ)⁻¹: the right form of a pixel of σ = 1, without reconstruction.
fn unit(columns: Columns) -> Quadratic {
    let (m, [x, y]) = (matrix(columns), columns);
    let f = m.determinant() * m.determinant();
    let (a, c) = (x.y * x.y + y.y * y.y, x.x * x.x + y.x * y.x);
    Quadratic { a: a / f, b: -(x.x * x.y + y.x * y.y) / f, c: c / f }
}

const SCALE: Columns = [DVec2::new(8.0, 0.0), DVec2::new(0.0, 1.0)];

/// Every texel near the origin.
fn texels() -> impl Iterator<Item = (f64, f64)> {
    (-60..=60).flat_map(|v| (-60..=60).map(move |u| (f64::from(u), f64::from(v))))
}

#[test]
fn a_density_carried_over_sums_to_the_determinant() {
    let columns = JACOBIANS[1].1;
    let form = unit(columns);
    let sum: f64 = texels().map(|(u, v)| form.weight(u, v)).sum::<f64>() / std::f64::consts::TAU;
    assert!((sum - matrix(columns).determinant().abs()).abs() < 1e-3);
    says(&format!("add up to {sum:.1}"));
}

#[test]
fn printed_weights_are_narrow_where_the_footprint_is_long() {
    let sigma = |q: Quadratic| 1.0 / q.a.sqrt();
    let (printed, right) = (sigma(Quadratic::printed(SCALE)), sigma(unit(SCALE)));
    says(&format!("σ = 1/{:.0} along u, where it should be {right:.0}", 1.0 / printed));
    says(&format!("a factor of {:.0}", right / printed));
}

#[test]
fn a_form_is_zero_at_its_centre_alone() {
    let form = unit(JACOBIANS[1].1);
    let below = |bound: f64| {
        let value = |u: f64, v: f64| form.a * u * u + 2.0 * form.b * u * v + form.c * v * v;
        texels().filter(|&(u, v)| value(u, v) <= bound).count()
    };
    says(&format!("= 0 holds for {} texel, ≤ 3² for {}", below(0.0), below(9.0)));
}

#[test]
fn a_quadratic_is_no_weight() {
    let (middle, rim): (f64, f64) = (0.0, 9.0);
    says(&format!("{middle:.0} in the middle and {rim:.0} at three σ"));
    says(&format!("1 and {:.3}", exp(-0.5 * rim)));
}

#[test]
fn the_listing_as_printed_is_bilinear() {
    let map = plane();
    let mut worst = 0.0_f64;
    for (x, y) in (0..HEIGHT).step_by(5).flat_map(|y| (0..WIDTH).step_by(5).map(move |x| (x, y))) {
        let at = DVec2::new(x as f64 + 0.5, y as f64 + 0.5);
        let Some((p, columns)) = columns(&map, at) else { continue };
        let form = Quadratic::printed(columns);
        let (mut sum, mut total) = (0.0, 0.0);
        for (u, v) in texels().filter(|(u, v)| u.abs() <= 15.0 && v.abs() <= 15.0) {
            let weight = form.weight(p.x.floor() + u + 0.5 - p.x, p.y.floor() + v + 0.5 - p.y);
            sum += weight * bilinear(p);
            total += weight;
        }
        if total > 0.0 {
            worst = worst.max((sum / total - bilinear(p)).abs());
        }
    }
    assert!(worst < 1e-12, "{worst:e}");
    says("to 10⁻¹²");
}

#[test]
fn the_cap_cuts_the_filter_off() {
    let cut = 15.0 / 8.0;
    // What of a Gaussian lies beyond, by the trapezoidal rule.
    let step = 1e-4;
    let tail: f64 = (0..100_000).map(|k| exp(-0.5 * (cut + step * f64::from(k)).powi(2))).sum();
    let beyond = 2.0 * step * tail / std::f64::consts::TAU.sqrt();
    says(&format!("at {cut:.1}σ, {:.0} % of it", 100.0 * beyond));
}

#[test]
fn magnified_weights_underflow() {
    // Half the smallest f32: what is below becomes 0.
    let smallest = 0.5 * f64::from(f32::from_bits(1));
    // Half a texel away in u and in v, at A = C = m².
    let weight = |m: u32| exp(-0.25 * f64::from(m * m));
    let first = (1..100).find(|&m| weight(m) < smallest).unwrap();
    says(&format!("from a magnification of {first} on"));
}

#[test]
fn skipping_moves_the_filter_at_a_border() {
    // A Gaussian at the border of a ramp, in σ: where its mean is taken.
    let at = |k: i32| (f64::from(k) + 0.5) * 1e-3;
    let inner = || (0..9000).map(at);
    let weight = |x: f64| exp(-0.5 * x * x);
    let (sum, half): (f64, f64) = (inner().map(|x| x * weight(x)).sum(), inner().map(weight).sum());
    says(&format!("{:.2}σ inside it", sum / half));
    // Clamped, the other half is at the border.
    says(&format!("{:.2}σ by clamping", sum / (2.0 * half)));
}
