use super::Bends;
use crate::chords::Chords;
use crate::math::sqrt;
use crate::path::Cursor;
use crate::{DVec2, Path, PathElement};
use alloc::vec::Vec;

/// Segments for which there is room at once: to grow step by step takes longer.
const ROOM: usize = 32;

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
        sqrt(self.length_squared())
    }

    pub(super) fn length_squared(&self) -> f64 {
        (self.to - self.from).length_squared()
    }

    /// Whether it has no length.
    pub(super) fn is_point(&self) -> bool {
        self.from == self.to
    }
}

/// A contour in straight pieces, each beginning where the one before ends; at least one.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Chain {
    pub(super) segments: Vec<Segment>,
    pub(super) closed: bool,
}

impl Chain {
    /// Draws the contours of a path, one after the other.
    pub(super) fn each_of_path(path: &Path, bends: Bends, draw: impl FnMut(&Self)) {
        let fits = |tangent, chord| bends.end_fits(tangent, chord);
        let mut builder = Builder {
            chords: Chords::new(bends.tolerance, bends.radius, fits),
            points: Vec::new(),
            chain: Self { segments: Vec::with_capacity(ROOM), closed: false },
            start: None,
            draw,
            count: 0,
        };
        let mut cursor = Cursor::default();
        for element in path.elements() {
            let from = cursor.advance(element);
            builder.step(from, element);
        }
        builder.finish(false);
    }

    fn is_finite(&self) -> bool {
        let finite =
            |s: &Segment| s.from.is_finite() && s.to.is_finite() && s.direction.is_finite();
        self.segments.iter().all(finite)
    }
}

struct Builder<F, D> {
    chords: Chords<F>,
    /// The points of a curve.
    points: Vec<DVec2>,
    /// The contour under way.
    chain: Chain,
    /// Where it began, once something was drawn.
    start: Option<DVec2>,
    draw: D,
    /// Segments of all finished contours.
    count: usize,
}

impl<F: Fn(DVec2, DVec2) -> bool, D: FnMut(&Chain)> Builder<F, D> {
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
            self.chain.segments.push(Segment { from, to, direction, smooth });
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
            self.chain.segments.push(Segment { from: at, to: at, direction, smooth });
        }
    }

    fn curve<const N: usize>(&mut self, curve: &[DVec2; N]) {
        let (first, last) = (curve[0], curve[N - 1]);
        if curve.iter().all(|&p| p == first) {
            return;
        }
        let room = Path::MAX_POINTS.saturating_sub(self.count + self.chain.segments.len());
        let mut points = core::mem::take(&mut self.points);
        self.chords.push(curve, room, &mut points);

        self.tangent(first, curve[1..].iter(), 1.0, false);
        let mut from = first;
        for &to in &points {
            self.line(from, to, true);
            from = to;
        }
        self.tangent(last, curve[..N - 1].iter().rev(), -1.0, true);
        points.clear();
        self.points = points;
    }

    fn finish(&mut self, closed: bool) {
        let segments = &mut self.chain.segments;
        self.count += segments.len();
        if let Some(start) = self.start.take() {
            if segments.is_empty() {
                // Drawn to nowhere: a dot, which lies along x.
                let direction = DVec2::X;
                segments.push(Segment { from: start, to: start, direction, smooth: false });
            }
            let is_dot = segments.iter().all(Segment::is_point);
            self.chain.closed = closed && !is_dot;
            if self.chain.is_finite() {
                (self.draw)(&self.chain);
            }
        }
        self.chain.segments.clear();
    }
}

/// The unit vector of a direction, without overflow or underflow on the way.
pub(super) fn unit(v: DVec2) -> DVec2 {
    let squared = v.length_squared();
    if squared > f64::MIN_POSITIVE / f64::EPSILON && squared < f64::MAX {
        return v / sqrt(squared);
    }
    let scaled = v / v.abs().max_element();
    scaled / scaled.length()
}
