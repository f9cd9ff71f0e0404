use crate::flatten::{distance_squared, inner_share, subdivide};
use crate::path::Cursor;
use crate::{DVec2, Path, PathElement};
use alloc::vec::Vec;

/// A straight piece of a contour.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Segment {
    pub(super) from: DVec2,
    pub(super) to: DVec2,
    /// Unit vector. Kept beside the ends because a segment may have no length: such ones carry
    /// the true direction of a curve at its ends.
    pub(super) direction: DVec2,
    /// Whether it continues the one before smoothly, as part of the same curve.
    pub(super) smooth: bool,
}

impl Segment {
    pub(super) fn length(&self) -> f64 {
        (self.to - self.from).length()
    }
}

/// A contour in straight pieces, each beginning where the one before ends; at least one.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Chain {
    pub(super) segments: Vec<Segment>,
    pub(super) closed: bool,
}

impl Chain {
    /// The contours of a path, for a stroke of the given half-width.
    pub(super) fn of_path(path: &Path, radius: f64, tolerance: f64) -> Vec<Self> {
        let mut builder = Builder {
            radius,
            tolerance,
            segments: Vec::new(),
            start: None,
            chains: Vec::new(),
            count: 0,
        };
        let mut cursor = Cursor::default();
        for element in path.elements() {
            let from = cursor.advance(element);
            builder.step(from, element);
        }
        builder.finish(false);
        builder.chains
    }

    fn is_finite(&self) -> bool {
        let finite =
            |s: &Segment| s.from.is_finite() && s.to.is_finite() && s.direction.is_finite();
        self.segments.iter().all(finite)
    }
}

struct Builder {
    /// Half the width of the stroke.
    radius: f64,
    tolerance: f64,
    segments: Vec<Segment>,
    /// Where the contour under way began, once something was drawn.
    start: Option<DVec2>,
    chains: Vec<Chain>,
    /// Points of all finished contours.
    count: usize,
}

impl Builder {
    fn step(&mut self, from: DVec2, element: &PathElement) {
        if matches!(element, PathElement::MoveTo(_)) {
            self.finish(false);
            return;
        }
        let start = *self.start.get_or_insert(from);
        match *element {
            PathElement::MoveTo(_) => {}
            PathElement::LineTo(to) => self.line(from, to, false),
            PathElement::QuadTo(c, to) => self.curve(&[from, c, to]),
            PathElement::CubicTo(c0, c1, to) => self.curve(&[from, c0, c1, to]),
            PathElement::Close => {
                self.line(from, start, false);
                self.finish(true);
            }
        }
    }

    /// A segment from one point to another, unless they coincide.
    fn line(&mut self, from: DVec2, to: DVec2, smooth: bool) {
        if from != to {
            let direction = unit(to - from);
            self.segments.push(Segment { from, to, direction, smooth });
        }
    }

    /// A segment without length, for its direction: that of the first control point (in the
    /// order given) that does not coincide with the end.
    fn tangent<'a>(
        &mut self,
        at: DVec2,
        mut towards: impl Iterator<Item = &'a DVec2>,
        sign: f64,
        smooth: bool,
    ) {
        if let Some(&other) = towards.find(|&&p| p != at) {
            let direction = unit(other - at) * sign;
            self.segments.push(Segment { from: at, to: at, direction, smooth });
        }
    }

    /// Whether the chord can stand for a piece of a curve, or of its end: there the chord's sides
    /// must not stick out beyond the true end either, by turning away from the tangent.
    fn is_flat<const N: usize>(&self, piece: &[DVec2; N], is_end: bool) -> bool {
        // Non-finite curves are left out later: do not refine them.
        if piece.iter().any(|p| !p.is_finite()) {
            return true;
        }
        let (from, to) = (piece[0], piece[N - 1]);
        let chord = to - from;
        let reach = self.tolerance / inner_share::<N>();
        let near = |&p: &DVec2| distance_squared(p, from, to) <= reach * reach;
        // |sine of the angle| · radius ≤ tolerance.
        let straight = |leg: DVec2| {
            let sine = leg.perp_dot(chord).abs() * self.radius;
            sine <= self.tolerance * leg.length() * chord.length()
        };
        let ends_straight = || straight(piece[1] - from) && straight(to - piece[N - 2]);
        piece[1..N - 1].iter().all(near) && (!is_end || ends_straight())
    }

    fn curve<const N: usize>(&mut self, curve: &[DVec2; N]) {
        let (first, last) = (curve[0], curve[N - 1]);
        if curve.iter().all(|&p| p == first) {
            return;
        }
        let is_flat = |c: &[DVec2; N]| self.is_flat(c, c[0] == first || c[N - 1] == last);
        let limit = Path::MAX_POINTS.saturating_sub(self.count + self.segments.len());
        let mut points = Vec::new();
        subdivide(curve, 0, &is_flat, limit, &mut points);

        self.tangent(first, curve[1..].iter(), 1.0, false);
        let mut from = first;
        for to in points {
            self.line(from, to, true);
            from = to;
        }
        self.tangent(last, curve[..N - 1].iter().rev(), -1.0, true);
    }

    fn finish(&mut self, closed: bool) {
        let mut segments = core::mem::take(&mut self.segments);
        self.count += segments.len();
        let Some(start) = self.start.take() else { return };
        if segments.is_empty() {
            // Drawn to nowhere: a dot, which lies along x.
            segments.push(Segment { from: start, to: start, direction: DVec2::X, smooth: false });
        }
        let is_dot = segments.iter().all(|s| s.from == s.to);
        let chain = Chain { segments, closed: closed && !is_dot };
        if chain.is_finite() {
            self.chains.push(chain);
        }
    }
}

/// The unit vector of a direction, without overflow or underflow on the way.
fn unit(v: DVec2) -> DVec2 {
    let scaled = v / v.abs().max_element();
    scaled / scaled.length()
}
