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
    #[inline]
    pub fn snap(p: DVec2) -> Option<Self> {
        Some(Self { x: snap(p.x)?, y: snap(p.y)? })
    }
}

/// floor(256 v + ½) as a real number: no bounds yet.
pub(crate) fn snap_real(v: f64) -> f64 {
    let scaled = v * 256.0;
    // From 2⁵² on every f64 is whole, and adding ½ would round.
    if scaled.abs() >= 4_503_599_627_370_496.0 {
        return scaled;
    }
    let raised = scaled + 0.5;
    let whole = raised as i64 as f64;
    if whole > raised { whole - 1.0 } else { whole }
}

#[inline]
fn snap(v: f64) -> Option<i32> {
    const LIMIT: f64 = GUARD as f64;
    let snapped = floor(v * 256.0 + 0.5);
    // A NaN fails the comparison. Beyond the guard band `floor` is of no use, but keeps out as
    // well.
    (snapped.abs() <= LIMIT).then(|| low_bits(snapped))
}

/// 1.5 × 2⁵²: added to a small number, it leaves the nearest whole number in the low bits.
pub(crate) const WHOLE: f64 = 6_755_399_441_055_744.0;

/// The whole number v, |v| ≤ 2³¹. A plain cast would also look for NaN and saturate.
#[inline]
pub(crate) fn low_bits(v: f64) -> i32 {
    whole_bits(v + WHOLE)
}

/// The whole number, |v| ≤ 2³¹, to which [`WHOLE`] was added.
#[inline(always)]
pub(crate) fn whole_bits(v: f64) -> i32 {
    v.to_bits() as i32
}

/// `f64::floor` for |v| < 2⁵¹, without the standard library; beyond it something as large.
#[inline]
pub(crate) fn floor(v: f64) -> f64 {
    let nearest = (v + WHOLE) - WHOLE;
    if nearest > v { nearest - 1.0 } else { nearest }
}
