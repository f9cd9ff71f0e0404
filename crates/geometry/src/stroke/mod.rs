mod chain;
mod dash;
mod outline;

use crate::Path;
use alloc::vec::Vec;
use chain::Chain;
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
    /// The outline is the sum of one rectangle per chord and one wedge per join, all of which
    /// turn the same way, so that it has no holes however tight the curve. A contour without
    /// length becomes a dot if the caps are round or square, as in SVG.
    ///
    /// Only + − × ÷ √ and comparisons are used: the same path gives the same outline everywhere.
    ///
    /// Empty if the width is not positive and finite; contours with a number that is not finite
    /// are left out.
    #[must_use]
    pub fn stroke(&self, style: &StrokeStyle, tolerance: f64) -> Self {
        if !(style.width > 0.0 && style.width.is_finite()) {
            return Self::new();
        }
        let tolerance = tolerance.max(style.width / 4096.0);
        let mut outliner = Outliner::new(style, tolerance);
        for chain in Chain::of_path(self, style.width * 0.5, tolerance) {
            match dash::dash(&chain, style) {
                Some(dashes) => dashes.iter().for_each(|dash| outliner.draw(dash)),
                None => outliner.draw(&chain),
            }
        }
        outliner.finish()
    }
}
