use scumble_geometry::{DVec2, IntRect};

/// The one-pixel line of the digital differential analyser: from the left end, one pixel for each
/// whole step along the longer axis, at the floor of the position.
///
/// With |Δx| ≥ |Δy| the steps are x₀, x₀ + 1, … up to x₁; else they are y₀, y₀ ± 1, … towards y₁,
/// from the same end. A horizontal line goes on to the column that holds x₁. Of a vertical line,
/// `a` is the left end. Only pixels inside `clip` are visited, and only those steps are walked, so
/// a line of any length ends soon. An end that is not finite draws nothing.
pub fn hairline(a: DVec2, b: DVec2, clip: IntRect, mut visit: impl FnMut(i32, i32)) {
    if !(a.is_finite() && b.is_finite()) || clip.is_empty() {
        return;
    }
    let (from, to) = if a.x <= b.x { (a, b) } else { (b, a) };
    // Halves, so that the difference of two huge numbers stays finite.
    let half = to * 0.5 - from * 0.5;
    if half.x.abs() >= half.y.abs() {
        // The last step is the last one in the column of x₁ that has not passed y₁: a horizontal
        // line, which never passes it, may go up to a pixel beyond x₁.
        let to =
            if half.y == 0.0 { DVec2::new(from.x + floor(to.x) - floor(from.x), to.y) } else { to };
        walk(from, to, (clip.x0, clip.x1), (clip.y0, clip.y1), visit);
    } else {
        let swap = |p: DVec2| DVec2::new(p.y, p.x);
        walk(swap(from), swap(to), (clip.y0, clip.y1), (clip.x0, clip.x1), |y, x| visit(x, y));
    }
}

/// Walks x from `from.x` towards `to.x` by ones, within the half-open ranges `xs` and `ys`.
fn walk(from: DVec2, to: DVec2, xs: (i32, i32), ys: (i32, i32), mut visit: impl FnMut(i32, i32)) {
    let half = to * 0.5 - from * 0.5;
    let slope = if half.x == 0.0 { 0.0 } else { half.y / half.x };
    let start = floor(from.x);
    // Step t stands at from.x ± t, and so in column start ± t; these are the t inside `xs`.
    let (sign, low, high) = if half.x >= 0.0 {
        (1.0, f64::from(xs.0) - start, f64::from(xs.1) - 1.0 - start)
    } else {
        (-1.0, start - (f64::from(xs.1) - 1.0), start - f64::from(xs.0))
    };
    let last = floor(half.x.abs() * 2.0);
    let mut step = low.max(0.0);
    while step <= high.min(last) {
        let y = floor(from.y + sign * step * slope);
        if y >= f64::from(ys.0) && y < f64::from(ys.1) {
            visit((start + sign * step) as i32, y as i32);
        }
        step += 1.0;
    }
}

/// `f64::floor` for any finite number, without the standard library.
fn floor(v: f64) -> f64 {
    if v.abs() < 2_251_799_813_685_248.0 { crate::fixed::floor(v) } else { v }
}
