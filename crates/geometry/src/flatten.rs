//! Flattening under a projective map.
//!
//! A Bézier curve under a homography is a rational Bézier curve: its control points are the
//! images (X, Y, w) of the control points. De Casteljau's halving works on those as on any
//! others, so the curve is cut in halves in homogeneous space, and a piece is straight enough when
//! its *projected* control points lie so close to its projected chord that the curve, which is a
//! mean of them with positive weights, lies within the tolerance. No estimate of the curvature is
//! needed. Without perspective there are better places for the points ([`crate::chords`]).
//!
//! Only + − × ÷ √ and comparisons are used, so that the same path gives the same points everywhere,
//! and the reversed path the same in reverse.

use crate::chords::Chords;
use crate::path::Cursor;
use crate::{Contours, DVec2, DVec3, Homography, Path, PathElement, clip_polygon};
use alloc::vec::Vec;
use core::ops::{Add, Mul};

impl Path {
    /// How often a curve is halved at most: it becomes at most 4096 edges.
    pub const MAX_DEPTH: u32 = 12;

    /// The number of points after which [`Path::flatten`] draws the remaining curves as straight
    /// lines, to bound time and memory on hostile input.
    pub const MAX_POINTS: usize = 1 << 20;

    /// The path's contours on the screen, as closed polygons, for a fill.
    ///
    /// Curves become chords that leave the projected curve by at most `tolerance_px` (a tenth of a
    /// pixel is not visible; values below 2⁻¹⁰, NaN included, count as 2⁻¹⁰), within
    /// [`Path::MAX_DEPTH`] and [`Path::MAX_POINTS`]. Without perspective they do so on either side:
    /// the points within a curve lie outside its bend, which takes fewer of them than points on the
    /// curve, and comes nearer to its area. What lies entirely beyond ±2²¹ pixels on one
    /// side is not refined. Where a contour reaches behind the eye it is clipped at
    /// w = [`Homography::near_w`], and vanishes if nothing of it is in front.
    ///
    /// Contours of fewer than three points enclose nothing and are left out, as are those with a
    /// coordinate that is not finite.
    #[must_use]
    pub fn flatten(&self, transform: &Homography, tolerance_px: f64) -> Contours {
        let mut out = Contours::new();
        self.flatten_into(transform, tolerance_px, &mut out);
        out
    }

    /// As [`Path::flatten`], appended to contours, whose memory can be used again and again.
    pub fn flatten_into(&self, transform: &Homography, tolerance_px: f64, out: &mut Contours) {
        let tolerance = tolerance_px.max(LEAST_TOLERANCE_PX);
        out.finish();
        let limit = out.points.len() + Self::MAX_POINTS;
        if has_perspective(transform) {
            return self.walk(&mut Projected::new(transform, tolerance, limit, out));
        }
        let begin = out.points.len();
        let chords = Chords::new(tolerance, 0.0, |_, _| true);
        self.walk(&mut Flat { transform, chords, limit, begin, out });
    }

    /// Draws all contours.
    fn walk(&self, pen: &mut impl Pen) {
        let mut cursor = Cursor::default();
        for element in self.elements() {
            let from = cursor.advance(element);
            match *element {
                PathElement::MoveTo(_) => pen.finish(),
                PathElement::LineTo(to) => pen.line(from, to),
                PathElement::QuadTo(c, to) => pen.curve(&[from, c, to]),
                PathElement::CubicTo(c0, c1, to) => pen.curve(&[from, c0, c1, to]),
                PathElement::Close => {
                    pen.start(from);
                    pen.finish();
                }
            }
        }
        pen.finish();
    }
}

/// Screen coordinates beyond which nothing is refined: outside every picture.
const FAR_PX: f64 = (1u32 << 21) as f64;

/// The least tolerance that is honoured: a quarter of the grid to which a rasterizer snaps.
const LEAST_TOLERANCE_PX: f64 = 1.0 / 1024.0;

/// Projects the contours from the given point and end on. In perspective they are clipped, and left
/// out if they are not finite; else all are left out if one is not.
pub(crate) fn project(out: &mut Contours, (point, end): (usize, usize), transform: &Homography) {
    if !has_perspective(transform) {
        let mut finite = true;
        for p in &mut out.points[point..] {
            *p = at(transform, *p);
            finite &= p.is_finite();
        }
        if !finite {
            out.points.truncate(point);
            out.ends.truncate(end);
        }
        return;
    }
    let (points, ends) = (out.points.split_off(point), out.ends.split_off(end));
    let mut pen = Projected::new(transform, LEAST_TOLERANCE_PX, 0, out);
    let mut begin = point;
    for end in ends {
        for pair in points[begin - point..end - point].windows(2) {
            pen.line(pair[0], pair[1]);
        }
        pen.finish();
        begin = end;
    }
}

/// Whether w differs from point to point, or puts all points behind the eye.
fn has_perspective(transform: &Homography) -> bool {
    !(transform.is_affine() && transform.project_homogeneous(DVec2::ZERO).z >= transform.near_w())
}

/// The image of a point without perspective.
fn at(transform: &Homography, p: DVec2) -> DVec2 {
    let p = transform.project_homogeneous(p);
    p.truncate() / p.z
}

/// What draws contours on the screen.
trait Pen {
    /// Begins a contour, unless one is under way.
    fn start(&mut self, from: DVec2);
    fn line(&mut self, from: DVec2, to: DVec2);
    fn curve<const N: usize>(&mut self, curve: &[DVec2; N]);
    /// Ends the contour under way, if there is one.
    fn finish(&mut self);
}

/// Draws without perspective.
struct Flat<'a, F> {
    transform: &'a Homography,
    chords: Chords<F>,
    /// How many points there may be.
    limit: usize,
    /// Where the contour under way begins.
    begin: usize,
    out: &'a mut Contours,
}

impl<F: Fn(DVec2, DVec2) -> bool> Pen for Flat<'_, F> {
    fn start(&mut self, from: DVec2) {
        if self.out.points.len() == self.begin {
            self.out.points.push(at(self.transform, from));
        }
    }

    fn line(&mut self, from: DVec2, to: DVec2) {
        self.start(from);
        self.out.points.push(at(self.transform, to));
    }

    fn curve<const N: usize>(&mut self, curve: &[DVec2; N]) {
        self.start(curve[0]);
        let curve = curve.map(|p| at(self.transform, p));
        if is_far(&curve) {
            return self.out.points.push(curve[N - 1]);
        }
        let room = self.limit.saturating_sub(self.out.points.len());
        self.chords.push(&curve, room, &mut self.out.points);
    }

    fn finish(&mut self) {
        let contour = &self.out.points[self.begin..];
        if contour.len() >= 3 && contour.iter().all(|p| p.is_finite()) {
            self.out.finish();
        } else {
            self.out.points.truncate(self.begin);
        }
        self.begin = self.out.points.len();
    }
}

/// Draws in perspective.
struct Projected<'a> {
    transform: &'a Homography,
    flatness: Flatness,
    /// How many points there may be.
    limit: usize,
    /// The contour under way, in homogeneous screen coordinates.
    contour: Vec<DVec3>,
    clipped: Vec<DVec3>,
    out: &'a mut Contours,
}

impl<'a> Projected<'a> {
    fn new(transform: &'a Homography, tolerance: f64, limit: usize, out: &'a mut Contours) -> Self {
        let flatness = Flatness { tolerance, near_w: transform.near_w() };
        Self { transform, flatness, limit, contour: Vec::new(), clipped: Vec::new(), out }
    }

    fn at(&self, p: DVec2) -> DVec3 {
        self.transform.project_homogeneous(p)
    }
}

impl Pen for Projected<'_> {
    fn start(&mut self, from: DVec2) {
        if self.contour.is_empty() {
            self.contour.push(self.at(from));
        }
    }

    fn line(&mut self, from: DVec2, to: DVec2) {
        self.start(from);
        self.contour.push(self.at(to));
    }

    fn curve<const N: usize>(&mut self, curve: &[DVec2; N]) {
        self.start(curve[0]);
        let (flatness, curve) = (self.flatness, curve.map(|p| self.at(p)));
        let limit = self.limit.saturating_sub(self.out.points.len());
        subdivide(&curve, 0, &|c| flatness.allows(c), limit, &mut self.contour);
    }

    /// Clips the contour, projects it, appends it.
    fn finish(&mut self) {
        let near_w = self.flatness.near_w;
        let finite = self.contour.iter().all(|p| p.is_finite());
        if self.contour.iter().any(|p| p.z < near_w) {
            clip_polygon(&self.contour, near_w, &mut self.clipped);
            core::mem::swap(&mut self.contour, &mut self.clipped);
        }
        let points = self.contour.iter().map(|p| p.truncate() / p.z);
        if finite && self.contour.len() >= 3 && points.clone().all(|p| p.is_finite()) {
            self.out.push(points);
        }
        self.contour.clear();
    }
}

/// When a chord can stand for a curve.
#[derive(Debug, Clone, Copy)]
struct Flatness {
    tolerance: f64,
    near_w: f64,
}

impl Flatness {
    fn allows<const N: usize>(&self, curve: &[DVec3; N]) -> bool {
        if curve.iter().any(|p| !p.is_finite()) || curve.iter().all(|p| p.z < self.near_w) {
            return true;
        }
        if curve.iter().any(|p| p.z < self.near_w) {
            return false;
        }
        let points = curve.map(|p| p.truncate() / p.z);
        if is_far(&points) {
            return true;
        }
        let (from, to) = (points[0], points[N - 1]);
        let share = inner_share::<N>() * weight_ratio(curve);
        let share = share / (share + 1.0 - inner_share::<N>());
        let reach = self.tolerance / share;
        points[1..N - 1].iter().all(|&p| distance_squared(p, from, to) <= reach * reach)
    }
}

/// The largest sum that the weights of a Bézier curve's inner control points reach: ½ of a
/// quadratic curve, ¾ of a cubic one. Since a distance is convex, the curve is at most this part
/// of the way from the chord to the farthest of them.
pub(crate) const fn inner_share<const N: usize>() -> f64 {
    if N == 3 { 0.5 } else { 0.75 }
}

/// By how much the inner control points of a rational curve may weigh more than its ends.
fn weight_ratio<const N: usize>(curve: &[DVec3; N]) -> f64 {
    let inner = curve[1..N - 1].iter().fold(0.0f64, |max, p| max.max(p.z));
    inner / curve[0].z.min(curve[N - 1].z)
}

/// Points of which means can be taken.
pub(crate) trait Vector: Copy + Add<Output = Self> + Mul<f64, Output = Self> {}

impl Vector for DVec2 {}
impl Vector for DVec3 {}

/// Pushes the points of a curve after its first, halving it until its chord is flat, but not
/// beyond `limit` points in all.
pub(crate) fn subdivide<P: Vector, const N: usize>(
    curve: &[P; N],
    depth: u32,
    is_flat: &impl Fn(&[P; N]) -> bool,
    limit: usize,
    out: &mut Vec<P>,
) {
    if depth >= Path::MAX_DEPTH || out.len() >= limit || is_flat(curve) {
        out.push(curve[N - 1]);
        return;
    }
    let (first, second) = halve(curve);
    subdivide(&first, depth + 1, is_flat, limit, out);
    subdivide(&second, depth + 1, is_flat, limit, out);
}

/// De Casteljau at ½.
pub(crate) fn halve<P: Vector, const N: usize>(curve: &[P; N]) -> ([P; N], [P; N]) {
    let (mut first, mut second) = (*curve, *curve);
    for (round, end) in first.iter_mut().enumerate() {
        *end = second[0];
        // The next round of means replaces this one in the first places.
        for i in 0..N - 1 - round {
            second[i] = (second[i] + second[i + 1]) * 0.5;
        }
    }
    (first, second)
}

/// Whether all points lie beyond [`FAR_PX`] on one and the same side.
fn is_far(points: &[DVec2]) -> bool {
    let all = |f: fn(&DVec2) -> f64| points.iter().all(|p| f(p) > FAR_PX);
    all(|p| p.x) || all(|p| -p.x) || all(|p| p.y) || all(|p| -p.y)
}

/// The squared distance of a point from a segment.
pub(crate) fn distance_squared(p: DVec2, from: DVec2, to: DVec2) -> f64 {
    let (chord, offset) = (to - from, p - from);
    let t = (offset.dot(chord) / chord.length_squared()).clamp(0.0, 1.0);
    // A chord of length zero gives NaN: then its one point is the nearest.
    let nearest = if t.is_nan() { offset } else { offset - chord * t };
    nearest.length_squared()
}
