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
        let last = if half.y == 0.0 { floor(to.x) - floor(from.x) } else { floor(2.0 * half.x) };
        walk(from, half, last, (clip.x0, clip.x1), (clip.y0, clip.y1), visit);
    } else {
        let swap = |p: DVec2| DVec2::new(p.y, p.x);
        let last = floor(2.0 * half.y.abs());
        let (xs, ys) = ((clip.x0, clip.x1), (clip.y0, clip.y1));
        walk(swap(from), swap(half), last, ys, xs, |y, x| visit(x, y));
    }
}

/// Walks `last` steps of one along x, the way that `half` points, and along y in proportion, within
/// the half-open ranges `xs` and `ys`.
fn walk(
    from: DVec2,
    half: DVec2,
    last: f64,
    xs: (i32, i32),
    ys: (i32, i32),
    mut visit: impl FnMut(i32, i32),
) {
    let slope = if half.x == 0.0 { 0.0 } else { half.y / half.x };
    let start = floor(from.x);
    // Step t stands at from.x ± t, and so in column start ± t.
    let sign = if half.x >= 0.0 { 1.0 } else { -1.0 };
    let end = start + sign * last;
    let first = start.min(end).max(f64::from(xs.0)) as i32;
    let beyond = (start.max(end) + 1.0).min(f64::from(xs.1)) as i32;
    for column in first..beyond {
        let y = floor(from.y + (f64::from(column) - start) * slope);
        if y >= f64::from(ys.0) && y < f64::from(ys.1) {
            visit(column, y as i32);
        }
    }
}

/// `f64::floor` for any finite number, without the standard library.
fn floor(v: f64) -> f64 {
    if v.abs() < 2_251_799_813_685_248.0 { crate::fixed::floor(v) } else { v }
}
