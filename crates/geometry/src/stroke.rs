use crate::{DVec2, Path, PathElement};
use alloc::vec::Vec;

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
    /// The outline of the path's stroke, to be filled with
    /// [`FillRule::NonZero`](crate::FillRule::NonZero). `tolerance` is how far, in the path's
    /// units, curves may be from the true offset curve.
    ///
    /// Empty if the width is not positive or a number is not finite.
    #[must_use]
    pub fn stroke(&self, style: &StrokeStyle, tolerance: f64) -> Self {
        if !(style.width > 0.0 && style.width.is_finite() && self.is_finite()) {
            return Self::new();
        }
        let cap = match style.cap {
            Cap::Butt => kurbo::Cap::Butt,
            Cap::Round => kurbo::Cap::Round,
            Cap::Square => kurbo::Cap::Square,
        };
        let join = match style.join {
            Join::Miter => kurbo::Join::Miter,
            Join::Round => kurbo::Join::Round,
            Join::Bevel => kurbo::Join::Bevel,
        };
        let pattern = style.dashes.iter().copied();
        let stroke = kurbo::Stroke::new(style.width)
            .with_caps(cap)
            .with_join(join)
            .with_miter_limit(style.miter_limit)
            .with_dashes(style.dash_offset, pattern);
        let elements = self.elements().iter().map(|&e| e.into());
        kurbo::stroke(elements, &stroke, &kurbo::StrokeOpts::default(), tolerance).into()
    }
}

fn to_kurbo(p: DVec2) -> kurbo::Point {
    kurbo::Point::new(p.x, p.y)
}

fn from_kurbo(p: kurbo::Point) -> DVec2 {
    DVec2::new(p.x, p.y)
}

impl From<kurbo::BezPath> for Path {
    fn from(path: kurbo::BezPath) -> Self {
        let mut out = Self::new();
        for element in path.iter() {
            out.push(element.into());
        }
        out
    }
}

impl From<PathElement> for kurbo::PathEl {
    fn from(element: PathElement) -> Self {
        match element {
            PathElement::MoveTo(p) => Self::MoveTo(to_kurbo(p)),
            PathElement::LineTo(p) => Self::LineTo(to_kurbo(p)),
            PathElement::QuadTo(c, p) => Self::QuadTo(to_kurbo(c), to_kurbo(p)),
            PathElement::CubicTo(c0, c1, p) => {
                Self::CurveTo(to_kurbo(c0), to_kurbo(c1), to_kurbo(p))
            }
            PathElement::Close => Self::ClosePath,
        }
    }
}

impl From<kurbo::PathEl> for PathElement {
    fn from(element: kurbo::PathEl) -> Self {
        match element {
            kurbo::PathEl::MoveTo(p) => Self::MoveTo(from_kurbo(p)),
            kurbo::PathEl::LineTo(p) => Self::LineTo(from_kurbo(p)),
            kurbo::PathEl::QuadTo(c, p) => Self::QuadTo(from_kurbo(c), from_kurbo(p)),
            kurbo::PathEl::CurveTo(c0, c1, p) => {
                Self::CubicTo(from_kurbo(c0), from_kurbo(c1), from_kurbo(p))
            }
            kurbo::PathEl::ClosePath => Self::Close,
        }
    }
}
