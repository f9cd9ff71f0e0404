use crate::plane::{Plane, clamp};
use crate::{DVec2, DVec3, GeometryError, Interpolator};
use alloc::boxed::Box;

/// An attribute of N numbers over a projected triangle, such as a colour, made to be filled in row
/// by row in `f32`.
///
/// It never leaves the range of its corners' values, component by component, not even just outside
/// the triangle, where the centre of a pixel may lie that the triangle covers in part. And its value
/// at a position does not depend on where the row begins.
///
/// ```
/// use scumble_geometry::{DVec2, DVec3, Ramp};
/// let corners = [DVec3::new(0.0, 0.0, 1.0), DVec3::new(4.0, 0.0, 1.0), DVec3::new(0.0, 4.0, 1.0)];
/// let ramp = Ramp::new(corners, [[0.0], [1.0], [0.0]])?;
/// let mut row = [[0.0]; 5];
/// ramp.fill(DVec2::new(1.0, 1.0), &mut row, |value| value);
/// assert_eq!(row, [[0.25], [0.5], [0.75], [1.0], [1.0]]);
/// # Ok::<(), scumble_geometry::GeometryError>(())
/// ```
#[derive(Debug, Clone)]
pub struct Ramp<const N: usize> {
    kind: Kind<N>,
}

#[derive(Debug, Clone)]
enum Kind<const N: usize> {
    /// Without perspective (and near, and not too steep): quick to evaluate.
    Plane(Plane<N>),
    /// Elsewhere, since it is large and rare.
    Other(Box<Other<N>>),
}

#[derive(Debug, Clone)]
struct Other<const N: usize> {
    interpolator: Interpolator,
    values: [[f64; N]; 3],
    low: [f32; N],
    high: [f32; N],
}

/// Pixels up to here from the origin are whole numbers of pixels apart that fit an `i32`.
const FARTHEST: f64 = (1 << 29) as f64;

impl<const N: usize> Ramp<N> {
    /// Values at three vertices in homogeneous screen coordinates (X, Y, w), as for
    /// [`Interpolator::new`].
    ///
    /// # Errors
    /// Those of [`Interpolator::new`].
    pub fn new(positions: [DVec3; 3], values: [[f32; N]; 3]) -> Result<Self, GeometryError> {
        let interpolator = Interpolator::new(positions)?;
        let [a, b, c] = values;
        let low = core::array::from_fn(|i| a[i].min(b[i]).min(c[i]));
        let high = core::array::from_fn(|i| a[i].max(b[i]).max(c[i]));
        let values = values.map(|value| value.map(f64::from));
        // The centre of a pixel, so that from others it is whole numbers away.
        let pixel = (positions[0].truncate() / positions[0].z).floor();
        let origin = pixel + 0.5;
        let is_near = origin.abs().max_element() <= FARTHEST;
        let plane = (is_near && interpolator.is_affine()).then(|| {
            let at = |p| interpolator.interpolate(p, &values);
            let (here, right, below) = (at(origin), at(origin + DVec2::X), at(origin + DVec2::Y));
            let slope = |to: [f64; N]| core::array::from_fn(|i| (to[i] - here[i]) as f32);
            let (right, below) = (slope(right), slope(below));
            let pixel = (pixel.x as i32, pixel.y as i32);
            Plane { pixel, here: here.map(|v| v as f32), right, below, low, high }
        });
        let other = || Kind::Other(Box::new(Other { interpolator, values, low, high }));
        Ok(Self { kind: plane.filter(Plane::is_tame).map_or_else(other, Kind::Plane) })
    }

    /// The least that each component can be.
    #[must_use]
    pub fn low(&self) -> [f32; N] {
        match &self.kind {
            Kind::Plane(plane) => plane.low,
            Kind::Other(other) => other.low,
        }
    }

    /// The same values, pixel by pixel: without perspective, less than 2²⁹ pixels from the origin, and
    /// not so steep that a sum could overflow.
    #[must_use]
    pub fn plane(&self) -> Option<&Plane<N>> {
        match &self.kind {
            Kind::Plane(plane) => Some(plane),
            Kind::Other(_) => None,
        }
    }

    /// The value at one position.
    #[must_use]
    pub fn at(&self, p: DVec2) -> [f32; N] {
        let mut out = [[0.0; N]];
        self.fill(p, &mut out, |value| value);
        out[0]
    }

    /// What `make` makes of the values at `start`, `start` + (1, 0), and so on.
    pub fn fill<T>(&self, start: DVec2, out: &mut [T], make: impl Fn([f32; N]) -> T) {
        let plane = match &self.kind {
            Kind::Plane(plane) => plane,
            Kind::Other(other) => return other.fill(start, out, make),
        };
        let left = plane.left(start.y);
        let mut column = start.x;
        for out in out {
            *out = make(plane.along(left, column));
            column += 1.0;
        }
    }
}

impl<const N: usize> Other<N> {
    fn fill<T>(&self, start: DVec2, out: &mut [T], make: impl Fn([f32; N]) -> T) {
        for (i, out) in out.iter_mut().enumerate() {
            let p = DVec2::new(start.x + i as f64, start.y);
            let value = self.interpolator.interpolate(p, &self.values);
            *out = make(clamp(value.map(|v| v as f32), &self.low, &self.high));
        }
    }
}
