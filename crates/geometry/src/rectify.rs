//! A flat rectangle in a photo, seen at an angle: what its sides were, and the way back.

use crate::homography::check_quad;
use crate::math::sqrt;
use crate::{Affine, DVec2, DVec3, GeometryError, Homography};

/// The way that the corners of a quad run, as the eye sees it with y down.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Winding {
    /// As the hands of a clock.
    Clockwise,
    /// Against them: a picture put onto such a quad is mirrored.
    Counterclockwise,
}

impl Winding {
    /// The winding of a convex quad.
    ///
    /// # Errors
    /// [`GeometryError::NotFinite`] for a NaN or infinite corner, [`GeometryError::DegenerateQuad`] if
    /// three corners lie on a line, [`GeometryError::NotConvex`] if two sides cross or a corner points
    /// inward: no camera sees a rectangle so.
    pub fn of_convex(quad: [DVec2; 4]) -> Result<Self, GeometryError> {
        check_quad(&quad)?;
        let turn = |i: usize| {
            let [a, b, c] = [0, 1, 2].map(|k| quad[(i + k) % 4]);
            // Of unit size, so that no product leaves the range of f64.
            (b - a).normalize_or_zero().perp_dot((c - b).normalize_or_zero())
        };
        let turns = [0, 1, 2, 3].map(turn);
        if turns.iter().all(|t| *t > 0.0) {
            Ok(Self::Clockwise)
        } else if turns.iter().all(|t| *t < 0.0) {
            Ok(Self::Counterclockwise)
        } else {
            Err(GeometryError::NotConvex)
        }
    }
}

/// A rectangle found again in a photo of it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Rectified {
    /// From the unit square to the photo: (0, 0) to the first corner, (1, 0) to the second.
    square: Homography,
    /// Width and height that lose nothing of the photo: each at least as long as the longer of the two
    /// sides of the quad, in the ratio of the rectangle.
    pub size: DVec2,
    /// The focal length of the camera in pixels, if the perspective tells it. If not, the ratio of
    /// [`Rectified::size`] is that of the sides as they appear, means of opposite ones.
    pub focal: Option<f64>,
}

/// Focal lengths that a camera may have, in diagonals of the photo: a field of view of 127° to one of
/// 7°. Perspective that is so weak that it says something else says nothing.
const FOCALS: [f64; 2] = [0.25, 8.0];

impl Rectified {
    /// Finds the rectangle whose corners, top left first and then clockwise, lie at `corners` in an
    /// uncropped photo of the given size.
    ///
    /// A pinhole camera with square pixels and its axis through the middle of the photo is known but
    /// for its focal length f. The two directions of the rectangle are at right angles, which gives f;
    /// with f, the ratio of their lengths follows (Zhang and He, Whiteboard scanning and image
    /// enhancement, Digital Signal Processing 17, 2007, §3). With H = [h₁ h₂ h₃] the map of the unit
    /// square onto the quad in coordinates from the middle, and ω = diag(1/f², 1/f², 1):
    ///
    /// ```text
    /// h₁ᵀωh₂ = 0        (width/height)² = h₁ᵀωh₁ / h₂ᵀωh₂
    /// ```
    ///
    /// If one pair of sides is parallel in the photo f cannot be told.
    ///
    /// # Errors
    /// As for [`Winding::of_convex`].
    ///
    /// ```
    /// use scumble_geometry::{DVec2, Rectified};
    ///
    /// // A page that is tilted away to the upper right.
    /// let corners = [(310.0, 220.0), (890.0, 160.0), (1010.0, 930.0), (180.0, 820.0)];
    /// let page = Rectified::new(corners.map(|(x, y)| DVec2::new(x, y)), DVec2::new(1280.0, 960.0))?;
    /// let (width, height) = (page.size.x.round(), page.size.y.round());
    /// let map = page.map(width, height);
    /// let bottom_right = map.project(DVec2::new(width, height)).ok_or("behind the eye")?;
    /// assert!((bottom_right - DVec2::new(1010.0, 930.0)).length() < 1e-9);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn new(corners: [DVec2; 4], photo: DVec2) -> Result<Self, GeometryError> {
        Winding::of_convex(corners)?;
        let square = Homography::unit_square_to_quad(corners)?;
        let middle = Affine::translate(-0.5 * photo.x, -0.5 * photo.y);
        let directions = directions(&(Homography::from(middle) * square));
        let diagonal = photo.length();
        let focal =
            focal(directions).filter(|f| (FOCALS[0] * diagonal..=FOCALS[1] * diagonal).contains(f));
        let [a, b, c, d] = corners;
        let sides = [(b - a).length(), (c - b).length(), (c - d).length(), (d - a).length()];
        let seen = DVec2::new(sides[0] + sides[2], sides[1] + sides[3]);
        let ratio = focal.map_or(seen.x / seen.y, |f| ratio(directions, f));
        let (width, height) = (sides[0].max(sides[2]), sides[1].max(sides[3]));
        let size = DVec2::new(width.max(height * ratio), height.max(width / ratio));
        Ok(Self { square, size, focal })
    }

    /// From a straight picture of the rectangle, so wide and so high, to the photo.
    #[must_use]
    pub fn map(&self, width: f64, height: f64) -> Homography {
        self.square * Homography::from(Affine::scale(1.0 / width, 1.0 / height))
    }
}

/// The first two columns, of a common unit size.
fn directions(map: &Homography) -> [DVec3; 2] {
    [0, 1].map(|c| DVec3::new(map.m[0][c], map.m[1][c], map.m[2][c]))
}

/// The focal length that makes two directions perpendicular, if there is one.
fn focal([a, b]: [DVec3; 2]) -> Option<f64> {
    let squared = -(a.x * b.x + a.y * b.y) / (a.z * b.z);
    (squared > 0.0 && squared.is_finite()).then(|| sqrt(squared))
}

/// The ratio of the lengths of two directions, seen through a lens.
fn ratio([a, b]: [DVec3; 2], focal: f64) -> f64 {
    let length = |d: DVec3| d.x * d.x + d.y * d.y + focal * focal * d.z * d.z;
    sqrt(length(a) / length(b))
}
