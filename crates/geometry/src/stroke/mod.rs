mod chain;
mod dash;
mod inner;
mod outline;

use crate::flatten::project;
use crate::{Contours, DVec2, Homography, Path, PathElement};
use alloc::vec::Vec;
use chain::{Chain, unit};
use outline::Outliner;

/// How the corners of a stroke look.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default)]
pub enum Join {
    /// The outer edges run on until they meet, if that is within the miter limit; else as bevel.
    #[default]
    Miter,
    /// A circular arc around the corner.
    Round,
    /// The corner is cut off straight.
    Bevel,
}

/// How the ends of a stroke look.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default)]
pub enum Cap {
    /// The stroke ends at the end point.
    #[default]
    Butt,
    /// A half-disc beyond the end point.
    Round,
    /// Half a square beyond the end point.
    Square,
}

/// How a path is stroked; the default is SVG's: width 1, miter joins with limit 4, butt caps, no
/// dashes.
///
/// ```
/// use scumble_geometry::{Cap, DVec2, Path, Rect, StrokeStyle};
/// let line = Path::polyline([DVec2::new(0.0, 0.0), DVec2::new(10.0, 0.0)], false);
/// let style = StrokeStyle { width: 4.0, cap: Cap::Square, ..StrokeStyle::default() };
/// assert_eq!(line.stroke(&style, 0.01).bounds(), Some(Rect::new(-2.0, -2.0, 12.0, 2.0)));
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct StrokeStyle {
    /// Full width, in the path's units.
    pub width: f64,
    /// The corners.
    pub join: Join,
    /// The ends of open contours and of dashes.
    pub cap: Cap,
    /// Longest miter (corner to corner), in units of the width, as in SVG; at least 1.
    pub miter_limit: f64,
    /// Lengths of dashes and gaps by turns, in the path's units. An odd number is repeated to
    /// make it even. Empty, or with a negative or non-finite length, or all zero: no dashes.
    /// Every contour begins the pattern anew; in a closed one a dash that ends it goes on in one
    /// that begins it. A contour that would become more than 2¹⁶ dashes is not dashed.
    pub dashes: Vec<f64>,
    /// Where in the pattern the stroke starts; may be negative.
    pub dash_offset: f64,
}

impl Default for StrokeStyle {
    fn default() -> Self {
        Self {
            width: 1.0,
            join: Join::default(),
            cap: Cap::default(),
            miter_limit: 4.0,
            dashes: Vec::new(),
            dash_offset: 0.0,
        }
    }
}

impl Path {
    /// The outline of the path's stroke, in straight lines, to be filled with
    /// [`FillRule::NonZero`](crate::FillRule::NonZero).
    ///
    /// Curves, round joins and round caps are drawn by chords within about `tolerance` (in the
    /// path's units) of the true outline; a tolerance below 2⁻¹² of the width, NaN included,
    /// counts as that.
    /// The outline is the sum of one quadrilateral per chord and one wedge per join, all of which
    /// turn the same way, so that it has no holes however tight the curve. A contour without
    /// length becomes a dot if the caps are round or square, as in SVG.
    ///
    /// Only + − × ÷ √ and comparisons are used: the same path gives the same outline everywhere.
    ///
    /// Empty if the width is not positive and finite; contours with a number that is not finite
    /// are left out.
    #[must_use]
    pub fn stroke(&self, style: &StrokeStyle, tolerance: f64) -> Self {
        let mut outline = Contours::new();
        self.outline(style, tolerance, &mut outline);
        let mut path = Self::new();
        for contour in outline.iter() {
            for (i, &p) in contour.iter().enumerate() {
                path.push(if i == 0 { PathElement::MoveTo(p) } else { PathElement::LineTo(p) });
            }
            path.close();
        }
        path
    }

    /// The outline of the path's stroke on the screen, appended to contours, whose memory can be used
    /// again and again: as [`Path::stroke`], which takes the tolerance, and [`Path::flatten`] make it.
    pub fn stroke_into(
        &self,
        style: &StrokeStyle,
        tolerance: f64,
        transform: &Homography,
        out: &mut Contours,
    ) {
        out.finish();
        let begin = (out.points.len(), out.ends.len());
        self.outline(style, tolerance, out);
        project(out, begin, transform);
    }

    /// Appends the outline of the stroke, in the path's units.
    fn outline(&self, style: &StrokeStyle, tolerance: f64, out: &mut Contours) {
        if !(style.width > 0.0 && style.width.is_finite()) {
            return;
        }
        let bends = Bends::new(style.width * 0.5, tolerance.max(style.width / 4096.0));
        let mut outliner = Outliner::new(style, bends, out);
        Chain::each_of_path(self, bends, |chain| match dash::dash(chain, style) {
            Some(dashes) => dashes.iter().for_each(|dash| outliner.draw(dash)),
            None => outliner.draw(chain),
        });
    }
}

/// The least cosine of half the angle between two segments that are joined by one point.
const WIDEST_BEND: f64 = 0.9375;

/// Where the sides of two segments may meet in one point, without an arc.
#[derive(Debug, Clone, Copy)]
struct Bends {
    radius: f64,
    tolerance: f64,
    /// The least cosine of half the angle.
    half_cosine: f64,
}

impl Bends {
    fn new(radius: f64, tolerance: f64) -> Self {
        // The tangents meet radius·(1/cos(θ/2) − 1) beyond the arc.
        let half_cosine = (1.0 / (1.0 + tolerance / radius)).max(WIDEST_BEND);
        Self { radius, tolerance, half_cosine }
    }

    /// Whether the sides of two segments, with these normals and lengths, meet near enough to their
    /// arc, and no sooner on the inner side than the segments are long.
    fn fits(&self, n0: DVec2, n1: DVec2, shorter_squared: f64) -> bool {
        let least_cosine = 2.0 * self.half_cosine * self.half_cosine - 1.0;
        // More than the sides lose on the inner side.
        let lost = (n1 - n0).length_squared() * (self.radius * self.radius);
        n0.dot(n1) >= least_cosine && shorter_squared >= lost
    }

    /// The same for the first or last chord of a curve, which has the sides begin square to the
    /// tangent: as if the curve went on on the other side.
    fn fits_tangent(&self, n0: DVec2, n1: DVec2, length_squared: f64) -> bool {
        let lost = (n1 - n0).length_squared() * (4.0 * self.radius * self.radius);
        n0.dot(n1) >= self.half_cosine && length_squared >= lost
    }

    /// Whether a curve may end with a chord, given its tangent there: if the sides can begin square to
    /// that, or if those of the chord do not stick out beyond the end.
    fn end_fits(&self, tangent: DVec2, chord: DVec2) -> bool {
        let (t, c) = (unit(tangent), unit(chord));
        let sine = t.perp_dot(c).abs();
        let straight = t.dot(c) > 0.0 && sine * self.radius <= self.tolerance;
        straight || self.fits_tangent(t, c, chord.length_squared())
    }
}
