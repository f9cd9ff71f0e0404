use crate::{Affine, DVec2, Rect};
use alloc::vec::Vec;

/// One step of a [`Path`], from the current point on.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum PathElement {
    /// Starts a contour.
    MoveTo(DVec2),
    /// A straight line to the point.
    LineTo(DVec2),
    /// A quadratic Bézier curve: control point, end.
    QuadTo(DVec2, DVec2),
    /// A cubic Bézier curve: two control points, end.
    CubicTo(DVec2, DVec2, DVec2),
    /// A straight line back to the start of the contour, which it joins.
    Close,
}

impl PathElement {
    /// The points of the step, control points included, and their number.
    fn points(&self) -> ([DVec2; 3], usize) {
        match *self {
            Self::MoveTo(p) | Self::LineTo(p) => ([p; 3], 1),
            Self::QuadTo(c, p) => ([c, p, p], 2),
            Self::CubicTo(c0, c1, p) => ([c0, c1, p], 3),
            Self::Close => ([DVec2::ZERO; 3], 0),
        }
    }

    /// The same step with every point moved.
    fn map(&self, f: impl Fn(DVec2) -> DVec2) -> Self {
        match *self {
            Self::MoveTo(p) => Self::MoveTo(f(p)),
            Self::LineTo(p) => Self::LineTo(f(p)),
            Self::QuadTo(c, p) => Self::QuadTo(f(c), f(p)),
            Self::CubicTo(c0, c1, p) => Self::CubicTo(f(c0), f(c1), f(p)),
            Self::Close => Self::Close,
        }
    }
}

/// An outline of lines and Bézier curves, in contours.
///
/// The first element of a contour should be [`PathElement::MoveTo`]; a drawing step without one
/// starts at the start of the contour before, as in SVG, or at (0, 0). Filling closes every
/// contour; stroking only those that end with [`PathElement::Close`].
///
/// ```
/// use scumble_geometry::{DVec2, Homography, Path};
/// let mut drop = Path::new();
/// drop.move_to(DVec2::new(0.0, -10.0))
///     .quad_to(DVec2::new(10.0, 10.0), DVec2::new(0.0, 10.0))
///     .quad_to(DVec2::new(-10.0, 10.0), DVec2::new(0.0, -10.0))
///     .close();
/// let contours = drop.flatten(&Homography::IDENTITY, 0.1);
/// assert_eq!(contours.len(), 1);
/// ```
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Path {
    elements: Vec<PathElement>,
}

impl Path {
    /// A path without elements.
    #[must_use]
    pub const fn new() -> Self {
        Self { elements: Vec::new() }
    }

    /// Starts a contour.
    pub fn move_to(&mut self, p: DVec2) -> &mut Self {
        self.push(PathElement::MoveTo(p))
    }

    /// Draws a straight line.
    pub fn line_to(&mut self, p: DVec2) -> &mut Self {
        self.push(PathElement::LineTo(p))
    }

    /// Draws a quadratic Bézier curve.
    pub fn quad_to(&mut self, control: DVec2, p: DVec2) -> &mut Self {
        self.push(PathElement::QuadTo(control, p))
    }

    /// Draws a cubic Bézier curve.
    pub fn cubic_to(&mut self, control0: DVec2, control1: DVec2, p: DVec2) -> &mut Self {
        self.push(PathElement::CubicTo(control0, control1, p))
    }

    /// Closes the contour.
    pub fn close(&mut self) -> &mut Self {
        self.push(PathElement::Close)
    }

    /// Appends an element.
    pub fn push(&mut self, element: PathElement) -> &mut Self {
        self.elements.push(element);
        self
    }

    /// The chain of straight lines through the points; closed on demand.
    pub fn polyline(points: impl IntoIterator<Item = DVec2>, closed: bool) -> Self {
        let mut path = Self::new();
        for p in points {
            let first = path.elements.is_empty();
            path.push(if first { PathElement::MoveTo(p) } else { PathElement::LineTo(p) });
        }
        if closed && !path.elements.is_empty() {
            path.close();
        }
        path
    }

    /// The outline of a rectangle, clockwise (y down) from its top left corner.
    #[must_use]
    pub fn rect(rect: Rect) -> Self {
        Self::polyline(rect.corners(), true)
    }

    /// The outline of an ellipse with axes along x and y, clockwise (y down) from its rightmost
    /// point, in four cubic curves. Their radius is right to 2.7 parts in 10 000.
    #[must_use]
    pub fn ellipse(center: DVec2, radii: DVec2) -> Self {
        // 4/3·(√2 − 1): the curve's middle then lies on the circle.
        const KAPPA: f64 = 0.552_284_749_830_793_4;
        let at = |x: f64, y: f64| center + radii * DVec2::new(x, y);
        let mut path = Self::new();
        path.move_to(at(1.0, 0.0));
        // Quarter by quarter; (x, y) is the start's direction, (−y, x) the end's.
        for (x, y) in [(1.0, 0.0), (0.0, 1.0), (-1.0, 0.0), (0.0, -1.0)] {
            let (end_x, end_y): (f64, f64) = (-y, x);
            let control0 = at(x + KAPPA * end_x, y + KAPPA * end_y);
            let control1 = at(end_x + KAPPA * x, end_y + KAPPA * y);
            path.cubic_to(control0, control1, at(end_x, end_y));
        }
        path.close();
        path
    }

    /// The elements in order.
    #[must_use]
    pub fn elements(&self) -> &[PathElement] {
        &self.elements
    }

    /// Whether there are no elements.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.elements.is_empty()
    }

    /// Whether all coordinates are finite.
    #[must_use]
    pub fn is_finite(&self) -> bool {
        self.elements.iter().all(|e| e.points().0.iter().all(|p| p.is_finite()))
    }

    /// The same path with every point mapped; exact for curves, because the map is affine.
    #[must_use]
    pub fn transform(&self, map: &Affine) -> Self {
        Self { elements: self.elements.iter().map(|e| e.map(|p| map.apply(p))).collect() }
    }

    /// The corners, if it is a triangle and nothing else, closed or not.
    #[must_use]
    pub fn triangle(&self) -> Option<[DVec2; 3]> {
        use PathElement::{Close, LineTo, MoveTo};
        match *self.elements() {
            [MoveTo(a), LineTo(b), LineTo(c)] | [MoveTo(a), LineTo(b), LineTo(c), Close] => {
                Some([a, b, c])
            }
            _ => None,
        }
    }

    /// The smallest rectangle that holds the path itself (not merely its control points), without
    /// stroke; `None` for a path without points or with a NaN.
    #[must_use]
    pub fn bounds(&self) -> Option<Rect> {
        let mut points = Vec::new();
        let mut cursor = Cursor::default();
        for element in &self.elements {
            let from = cursor.advance(element);
            let (p, n) = element.points();
            points.extend_from_slice(&p[..n]);
            // Control points are not on the path: put the curve's extremes in their place.
            match *element {
                PathElement::QuadTo(c, to) => {
                    points.truncate(points.len() - 2);
                    points.extend_from_slice(&[from, to]);
                    let c0 = from + (c - from) * (2.0 / 3.0);
                    let c1 = to + (c - to) * (2.0 / 3.0);
                    extremes(from, c0, c1, to, &mut points);
                }
                PathElement::CubicTo(c0, c1, to) => {
                    points.truncate(points.len() - 3);
                    points.extend_from_slice(&[from, to]);
                    extremes(from, c0, c1, to, &mut points);
                }
                _ => {}
            }
        }
        Rect::bounding(points)
    }
}

/// Pushes the points of a cubic where its tangent is horizontal or vertical.
fn extremes(p0: DVec2, p1: DVec2, p2: DVec2, p3: DVec2, out: &mut Vec<DVec2>) {
    let (d0, d1, d2) = (p1 - p0, p2 - p1, p3 - p2);
    // d0(1−t)² + 2·d1·t(1−t) + d2·t² = a·t² − 2b·t + d0.
    let (a, b) = (d0 - d1 * 2.0 + d2, d0 - d1);
    for (a, b, c) in [(a.x, b.x, d0.x), (a.y, b.y, d0.y)] {
        let root = crate::math::sqrt((b * b - a * c).max(0.0));
        // The form that does not cancel, and its partner by Vieta.
        let q = if b < 0.0 { b - root } else { b + root };
        for t in [q / a, c / q] {
            if t > 0.0 && t < 1.0 {
                let s = 1.0 - t;
                let ends = p0 * (s * s * s) + p3 * (t * t * t);
                out.push(ends + p1 * (3.0 * s * s * t) + p2 * (3.0 * s * t * t));
            }
        }
    }
}

/// The current point while walking over a path's elements.
#[derive(Debug, Default)]
pub(crate) struct Cursor {
    start: DVec2,
    current: DVec2,
}

impl Cursor {
    /// Takes a step and returns the point from which it went.
    pub(crate) fn advance(&mut self, element: &PathElement) -> DVec2 {
        let from = self.current;
        self.current = match *element {
            PathElement::MoveTo(p) => {
                self.start = p;
                p
            }
            PathElement::LineTo(p) | PathElement::QuadTo(_, p) | PathElement::CubicTo(_, _, p) => p,
            PathElement::Close => self.start,
        };
        from
    }
}
