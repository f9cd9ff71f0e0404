use scumble_geometry::DVec2;

/// The guard band: coordinates are kept within ±2²¹ pixels, in 1/256 pixel.
pub(crate) const GUARD: i32 = 1 << 29;

/// A point in 24.8 fixed point: whole numbers of 1/256 pixel.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub struct FixedPoint {
    /// Column × 256.
    pub x: i32,
    /// Row × 256.
    pub y: i32,
}

impl FixedPoint {
    /// The nearest point of the grid: floor(256 v + ½) in each coordinate. `None` if that lies
    /// beyond ±2²¹ pixels or is not a number.
    #[must_use]
    pub fn snap(p: DVec2) -> Option<Self> {
        Some(Self { x: snap(p.x)?, y: snap(p.y)? })
    }
}

/// floor(256 v + ½) as a real number: no bounds yet.
pub(crate) fn snap_real(v: f64) -> f64 {
    let scaled = v * 256.0;
    // From 2⁵² on every f64 is whole, and adding ½ would round.
    if scaled.abs() < 4_503_599_627_370_496.0 { floor(scaled + 0.5) } else { scaled }
}

fn snap(v: f64) -> Option<i32> {
    let snapped = snap_real(v);
    // A NaN fails the comparison.
    (snapped.abs() <= f64::from(GUARD)).then_some(snapped as i32)
}

/// `f64::floor` for |v| < 2⁵³, without the standard library.
pub(crate) fn floor(v: f64) -> f64 {
    let whole = v as i64 as f64;
    if whole > v { whole - 1.0 } else { whole }
}
