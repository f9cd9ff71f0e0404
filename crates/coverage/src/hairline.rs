use scumble_geometry::{DVec2, IntRect};

/// The one-pixel line of the digital differential analyser: one pixel per step along the longer
/// axis, from the end with the lower coordinate there, at the floor of the position.
///
/// With |Δx| ≥ |Δy|: x = x₀, x₀ + 1, … while x ≤ x₁, and pixel (⌊x⌋, ⌊y⌋) on the line each time;
/// otherwise the axes swap roles. Only pixels inside `clip` are visited, and only those columns
/// (or rows) are walked, so a line of any length ends soon. An end that is not finite draws nothing.
pub fn hairline(a: DVec2, b: DVec2, clip: IntRect, mut visit: impl FnMut(i32, i32)) {
    if !(a.is_finite() && b.is_finite()) || clip.is_empty() {
        return;
    }
    // Halves, so that the difference of two huge numbers stays finite.
    let half = b * 0.5 - a * 0.5;
    if half.x.abs() >= half.y.abs() {
        let (from, to) = if a.x <= b.x { (a, b) } else { (b, a) };
        let ends = (clip.y0, clip.y1);
        walk(from, to, (clip.x0, clip.x1), ends, visit);
    } else {
        let (from, to) = if a.y <= b.y { (a, b) } else { (b, a) };
        let swap = |p: DVec2| DVec2::new(p.y, p.x);
        let ends = (clip.x0, clip.x1);
        walk(swap(from), swap(to), (clip.y0, clip.y1), ends, |y, x| visit(x, y));
    }
}

/// Walks x from `from.x` to `to.x` by ones, within the half-open ranges `xs` and `ys`.
fn walk(from: DVec2, to: DVec2, xs: (i32, i32), ys: (i32, i32), mut visit: impl FnMut(i32, i32)) {
    let half = to * 0.5 - from * 0.5;
    let slope = if half.x == 0.0 { 0.0 } else { half.y / half.x };
    let start = floor(from.x);
    let fraction = from.x - start;
    let first = start.max(f64::from(xs.0)) as i32;
    for column in first.min(xs.1)..xs.1 {
        let x = f64::from(column) + fraction;
        if x > to.x {
            break;
        }
        let y = floor(from.y + (x - from.x) * slope);
        if y >= f64::from(ys.0) && y < f64::from(ys.1) {
            visit(column, y as i32);
        }
    }
}

/// `f64::floor` for any finite number, without the standard library.
fn floor(v: f64) -> f64 {
    if v.abs() < 2_251_799_813_685_248.0 { crate::fixed::floor(v) } else { v }
}
