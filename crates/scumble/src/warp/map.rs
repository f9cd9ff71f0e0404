use crate::geometry::{Affine, DVec2, Homography};
use crate::texture::Footprint;

/// Where a position of the output lies in the source, and how the source runs under the pixel there.
///
/// Positions are continuous on both sides: pixel (i, j) of the output covers [i, i+1) × [j, j+1), so its
/// centre is (i + ½, j + ½), and so it is with the texels of the source. [`Homography`] and [`Affine`]
/// are maps, and so is every function of a position:
///
/// ```
/// use scumble::geometry::{DVec2, Matrix2};
/// use scumble::texture::Footprint;
/// use scumble::warp::Map;
///
/// // Rows that swing: u = x + 8y²/100², v = y.
/// let swing = |p: DVec2| {
///     let jacobian = Matrix2::new(1.0, 16.0 * p.y / 1e4, 0.0, 1.0);
///     Some(Footprint { u: p.x + 8.0 * p.y * p.y / 1e4, v: p.y, jacobian })
/// };
/// assert_eq!(Map::at(&swing, DVec2::new(3.0, 50.0)).map(|f| f.u), Some(5.0));
/// ```
pub trait Map: Sync {
    /// The footprint of the pixel whose centre is `p`: its centre in texels of the source, and the
    /// Jacobian ∂(u, v)/∂(x, y) there. `None` where there is nothing, as behind a horizon.
    ///
    /// A derivative that is not the map's own gives a picture that is blurred or aliased, never
    /// anything worse. What is not finite counts as infinitely far.
    fn at(&self, p: DVec2) -> Option<Footprint>;

    /// The same map as a homography, if it is one: rows of pixels are set up together then.
    fn homography(&self) -> Option<Homography> {
        None
    }
}

impl<F: Fn(DVec2) -> Option<Footprint> + Sync> Map for F {
    fn at(&self, p: DVec2) -> Option<Footprint> {
        self(p)
    }
}

/// From the output to texels of the source; where w ≤ 0 there is nothing.
impl Map for Homography {
    fn at(&self, p: DVec2) -> Option<Footprint> {
        (self.project_homogeneous(p).z > 0.0).then(|| Footprint::at(self, p))
    }

    fn homography(&self) -> Option<Homography> {
        Some(*self)
    }
}

/// From the output to texels of the source.
impl Map for Affine {
    fn at(&self, p: DVec2) -> Option<Footprint> {
        Map::at(&Homography::from(*self), p)
    }

    fn homography(&self) -> Option<Homography> {
        Some(Homography::from(*self))
    }
}
