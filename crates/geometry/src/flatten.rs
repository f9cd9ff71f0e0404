//! Flattening under a projective map.
//!
//! A Bézier curve under a homography is a rational Bézier curve: its control points are the
//! images (X, Y, w) of the control points. De Casteljau's halving works on those as on any
//! others, so the curve is cut in halves in homogeneous space, and a piece is straight enough when
//! its *projected* control points lie so close to its projected chord that the curve, which is a
//! mean of them with positive weights, lies within the tolerance. No estimate of the curvature is
//! needed. Without perspective there is a good one ([`crate::chords`]). Only + − × ÷ √ and comparisons are used, so that the same path
//! gives the same points everywhere, and the reversed path the same in reverse.

use crate::chords::push_chords;
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
    /// [`Path::MAX_DEPTH`] and [`Path::MAX_POINTS`]. What lies entirely beyond ±2²¹ pixels on one
    /// side is not refined. Where a contour reaches behind the eye it is clipped at
    /// w = [`Homography::near_w`], and vanishes if nothing of it is in front.
    ///
    /// Contours of fewer than three points enclose nothing and are left out, as are those with a
    /// coordinate that is not finite.
    #[must_use]
    pub fn flatten(&self, transform: &Homography, tolerance_px: f64) -> Contours {
        let mut flattener = Flattener::new(transform, tolerance_px);
        let mut cursor = Cursor::default();
        for element in self.elements() {
            let from = cursor.advance(element);
            if matches!(element, PathElement::MoveTo(_)) {
                flattener.finish();
                continue;
            }
            flattener.step(from, element);
            if matches!(element, PathElement::Close) {
                flattener.finish();
            }
        }
        flattener.finish();
        flattener.out
    }
}

/// Screen coordinates beyond which nothing is refined: outside every picture.
const FAR_PX: f64 = (1u32 << 21) as f64;

/// The least tolerance that is honoured: a quarter of the grid to which a rasterizer snaps.
const LEAST_TOLERANCE_PX: f64 = 1.0 / 1024.0;

struct Flattener<'a> {
    transform: &'a Homography,
    flatness: Flatness,
    /// The contour under way, in homogeneous screen coordinates.
    contour: Vec<DVec3>,
    clipped: Vec<DVec3>,
    out: Contours,
}

impl<'a> Flattener<'a> {
    fn new(transform: &'a Homography, tolerance_px: f64) -> Self {
        let tolerance = tolerance_px.max(LEAST_TOLERANCE_PX);
        Self {
            transform,
            flatness: Flatness { tolerance, near_w: transform.near_w() },
            contour: Vec::new(),
            clipped: Vec::new(),
            out: Contours::new(),
        }
    }

    fn step(&mut self, from: DVec2, element: &PathElement) {
        let start = self.at(from);
        if self.contour.is_empty() {
            self.contour.push(start);
        }
        match *element {
            PathElement::QuadTo(c, to) => {
                let curve = [start, self.at(c), self.at(to)];
                self.curve(&curve);
            }
            PathElement::CubicTo(c0, c1, to) => {
                let curve = [start, self.at(c0), self.at(c1), self.at(to)];
                self.curve(&curve);
            }
            PathElement::LineTo(to) => {
                let to = self.at(to);
                self.contour.push(to);
            }
            PathElement::MoveTo(_) | PathElement::Close => {}
        }
    }

    fn at(&self, p: DVec2) -> DVec3 {
        self.transform.project_homogeneous(p)
    }

    /// Pushes the points of a curve after its first.
    fn curve<const N: usize>(&mut self, curve: &[DVec3; N]) {
        let (flatness, contour) = (self.flatness, &mut self.contour);
        let room = Path::MAX_POINTS.saturating_sub(contour.len() + self.out.points.len());
        let limit = contour.len() + room;
        let w = curve[0].z;
        if w >= flatness.near_w && curve.iter().all(|p| p.z == w) {
            if is_far(&curve.map(|p| p.truncate() / w)) {
                return contour.push(curve[N - 1]);
            }
            let (curve, tolerance) = (curve.map(DVec3::truncate), flatness.tolerance * w);
            let mut push = |p: DVec2| contour.push(p.extend(w));
            return push_chords(&curve, tolerance, room.max(1) as u32, &mut push);
        }
        subdivide(curve, 0, &|c| flatness.allows(c), limit, contour);
    }

    /// Ends the contour under way: clips it, projects it, appends it.
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
