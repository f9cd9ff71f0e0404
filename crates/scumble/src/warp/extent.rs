//! How large a map's footprints are and where they lie, before any is sampled: which levels the pyramid
//! must have, and which part of the source.

use super::Map;
use super::view::View;
use crate::geometry::{DVec2, DVec3, Homography, IntRect, Matrix2, Rect};
use crate::texture::{Footprint, Sampler};

/// Cells along each axis into which the output is cut for the bounds.
const CELLS: u32 = 32;

/// The part of a source from which on all of it is taken.
const WORTH: f64 = 0.5;

/// By how much the axes of a map of one's own, which is only looked at in places, may exceed what was
/// seen there, or fall short of it.
const DOUBT: f64 = 2.0;

/// Lower and upper bounds of the axes of footprints, the major first, in texels per pixel.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Extent {
    pub(super) least: [f64; 2],
    pub(super) most: [f64; 2],
}

impl Extent {
    /// Nothing is seen.
    const NONE: Self = Self { least: [f64::INFINITY; 2], most: [0.0; 2] };

    /// Of all pixels of an output of the given size. `source` is its size if only what it covers
    /// counts.
    pub(super) fn of<M: Map>(map: &M, output: [u32; 2], source: Option<[usize; 2]>) -> Self {
        match map.homography() {
            Some(h) => Self::projective(&h, output, source),
            None => Self::seen(map, output),
        }
    }

    fn and(&mut self, other: Self) {
        for (most, other) in self.most.iter_mut().zip(other.most) {
            *most = most.max(other);
        }
        for (least, other) in self.least.iter_mut().zip(other.least) {
            *least = least.min(other);
        }
    }

    /// Bounds that hold for every pixel before the eye.
    fn projective(map: &Homography, output: [u32; 2], source: Option<[usize; 2]>) -> Self {
        let view = View::new(*map, source);
        let mut all = Self::NONE;
        for corners in cells(all_of(output)) {
            if !view.misses(&corners) {
                let ends = corners.map(|p| map.project_homogeneous(p));
                let (ahead, behind) =
                    (ends.iter().all(|p| p.z > 0.0), ends.iter().all(|p| p.z <= 0.0));
                let endless = Self { least: [0.0; 2], most: [f64::INFINITY; 2] };
                match (ahead, behind) {
                    (true, _) => all.and(Self::before_eye(map, &ends)),
                    (false, true) => (),
                    (false, false) => all.and(endless),
                }
            }
        }
        all
    }

    /// The part of a source that some pixels of the output read; `None` for all of it, or most. The
    /// source either ends at its edge or goes on with the texels there.
    pub(super) fn window(
        map: &Homography,
        area: IntRect,
        (source, ends): ([usize; 2], bool),
        sampler: &Sampler,
    ) -> Option<IntRect> {
        let mut read: Option<Rect> = None;
        let view = View::new(*map, ends.then_some(source));
        for corners in cells(area) {
            if view.misses(&corners) {
                continue;
            }
            let ends = corners.map(|p| map.project_homogeneous(p));
            if ends.iter().any(|p| p.z <= 0.0) {
                return None;
            }
            let major = Self::before_eye(map, &ends).most[0];
            let jacobian = Matrix2::new(major, 0.0, 0.0, major);
            let [across, down] = sampler.reach(&Footprint { u: 0.0, v: 0.0, jacobian });
            let reach = DVec2::new(across, down);
            let places = ends.map(|p| DVec2::new(p.x / p.z, p.y / p.z));
            let around = places.iter().flat_map(|p| [*p - reach, *p + reach]);
            let seen = read.into_iter().flat_map(|r| r.corners());
            read = Some(Rect::bounding(around.chain(seen))?);
        }
        let [width, height] = source.map(|n| n as f64);
        let read = read.unwrap_or(Rect::new(0.0, 0.0, 1.0, 1.0));
        // From the texel nearest to the one end to the one nearest to the other.
        let span = |low: f64, high: f64, n: f64| {
            // In this form a NaN and a side of nothing are no panic.
            let low = low.floor().max(0.0).min(n - 1.0);
            (low, high.ceil().max(low + 1.0).min(n))
        };
        let ((x0, x1), (y0, y1)) = (span(read.x0, read.x1, width), span(read.y0, read.y1, height));
        // A NaN is the whole. Sides of textures are below 2²⁹.
        let part = (x1 - x0) * (y1 - y0) < WORTH * width * height;
        part.then(|| IntRect::new(x0 as i32, y0 as i32, x1 as i32, y1 as i32))
    }

    /// By interval arithmetic: position and w are between those at the corners, the Jacobian's entries
    /// follow, and its determinant is det H/w³.
    fn before_eye(map: &Homography, corners: &[DVec3; 4]) -> Self {
        let w = Interval::of(corners.map(|p| p.z));
        let places = [corners.map(|p| p.x / p.z), corners.map(|p| p.y / p.z)].map(Interval::of);
        let [rows @ .., last] = map.m;
        let entry = |r: usize, c: usize| places[r].scaled(-last[c]).plus(rows[r][c]).over(w);
        let [a, b, c, d] = [entry(0, 0), entry(0, 1), entry(1, 0), entry(1, 1)];
        let sum = a.squared().and(b.squared()).and(c.squared()).and(d.squared());
        // The squared major axis is between half of that sum and all of it.
        let difference = a.squared().and(b.squared()).less(c.squared().and(d.squared()));
        let cross = a.times(c).and(b.times(d)).scaled(2.0);
        let root = difference.squared().and(cross.squared()).root();
        let major = sum.and(root).scaled(0.5).root();
        let determinant = map.determinant().abs();
        let minor = determinant / (w.low * w.low * w.low) / major.low;
        let least = determinant / (w.high * w.high * w.high) / major.high;
        // In this order a NaN becomes the major axis, and nothing.
        Self { least: [major.low, least.max(0.0)], most: [major.high, minor.min(major.high)] }
    }

    /// What is seen at the middles and corners of the cells, and some doubt.
    fn seen<M: Map>(map: &M, output: [u32; 2]) -> Self {
        let mut all = Self::NONE;
        for corners in cells(all_of(output)) {
            let middle = (corners[0] + corners[2]) * 0.5;
            for f in [middle, corners[0]].into_iter().filter_map(|p| map.at(p)) {
                let axes = f.jacobian.axes();
                let axes = [axes.major, axes.minor];
                let least = axes.map(|a| a * (1.0 / DOUBT));
                all.and(Self { least, most: axes.map(|a| a * DOUBT) });
            }
        }
        all
    }
}

/// The pixels of an output.
fn all_of([width, height]: [u32; 2]) -> IntRect {
    // Outputs are at most 2³⁰ − 1 pixels on a side.
    IntRect::new(0, 0, width as i32, height as i32)
}

/// The corners of cells that hold the centres of all pixels, in order around each.
fn cells(area: IntRect) -> impl Iterator<Item = [DVec2; 4]> {
    let (width, height) = (area.width(), area.height());
    let (columns, rows) = (CELLS.min(width), CELLS.min(height));
    // The first and the last line go through the centres at the edge.
    let line = |from: i32, i: u32, n: u32, side: u32| {
        f64::from(from) + 0.5 + f64::from(side - 1) * f64::from(i) / f64::from(n)
    };
    (0..rows).flat_map(move |j| {
        (0..columns).map(move |i| {
            let x = [i, i + 1].map(|i| line(area.x0, i, columns, width));
            let y = [j, j + 1].map(|j| line(area.y0, j, rows, height));
            [(0, 0), (1, 0), (1, 1), (0, 1)].map(|(i, j): (usize, usize)| DVec2::new(x[i], y[j]))
        })
    })
}

/// All numbers from one to another.
#[derive(Debug, Clone, Copy)]
struct Interval {
    low: f64,
    high: f64,
}

impl Interval {
    fn of(values: [f64; 4]) -> Self {
        values.iter().fold(Self { low: f64::INFINITY, high: f64::NEG_INFINITY }, |all, &v| Self {
            low: all.low.min(v),
            high: all.high.max(v),
        })
    }

    fn plus(self, v: f64) -> Self {
        Self { low: self.low + v, high: self.high + v }
    }

    fn and(self, other: Self) -> Self {
        Self { low: self.low + other.low, high: self.high + other.high }
    }

    fn less(self, other: Self) -> Self {
        self.and(other.scaled(-1.0))
    }

    fn scaled(self, by: f64) -> Self {
        Self::of([self.low * by, self.high * by, self.low * by, self.high * by])
    }

    fn times(self, other: Self) -> Self {
        let Self { low, high } = other;
        Self::of([self.low * low, self.low * high, self.high * low, self.high * high])
    }

    /// Divided by what is positive.
    fn over(self, w: Self) -> Self {
        self.times(Self { low: 1.0 / w.high, high: 1.0 / w.low })
    }

    fn squared(self) -> Self {
        let (a, b) = (self.low * self.low, self.high * self.high);
        let low = if self.low <= 0.0 && self.high >= 0.0 { 0.0 } else { a.min(b) };
        Self { low, high: a.max(b) }
    }

    /// The root of what is not negative.
    fn root(self) -> Self {
        Self { low: self.low.max(0.0).sqrt(), high: self.high.max(0.0).sqrt() }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn every_pixel_lies_within(
            m in prop::array::uniform8(-1.0..1.0f64), scale in -6..6i32,
        ) {
            let s = 2f64.powi(scale);
            let map = Homography::new([
                [s * (1.0 + m[0]), s * m[1], 50.0 * m[2]],
                [s * m[3], s * (1.0 - m[4]), 50.0 * m[5]],
                [0.02 * m[6], 0.02 * m[7], 1.0],
            ]);
            prop_assume!(map.determinant().abs() > 1e-6);
            let (output, source) = ([70, 90], [30, 40]);
            let all = Extent::of(&map, output, None);
            let visible = Extent::of(&map, output, Some(source));
            let window = Extent::window(&map, all_of(output), (source, true), &Sampler::DEFAULT);
            for y in 0..output[1] {
                for x in 0..output[0] {
                    let p = DVec2::new(f64::from(x) + 0.5, f64::from(y) + 0.5);
                    let Some(f) = map.at(p) else { continue };
                    let axes = f.jacobian.axes();
                    let inside = (0.0..30.0).contains(&f.u) && (0.0..40.0).contains(&f.v);
                    for (bounds, counts) in [(&all, true), (&visible, inside)] {
                        for (k, axis) in [axes.major, axes.minor].into_iter().enumerate() {
                            let within = axis <= bounds.most[k] * (1.0 + 1e-9)
                                && axis >= bounds.least[k] * (1.0 - 1e-9);
                            prop_assert!(within || !counts, "{axis} {bounds:?}");
                        }
                    }
                    if let Some(window) = window && inside {
                        let read = window.contains(f.u as i32, f.v as i32);
                        prop_assert!(read, "{f:?} {window:?}");
                    }
                }
            }
        }
    }

    #[test]
    fn a_plain_scale_is_tight() {
        let map = Homography::new([[4.0, 0.0, 1.0], [0.0, -4.0, 2.0], [0.0, 0.0, 1.0]]);
        let Extent { least, most } = Extent::of(&map, [100, 100], None);
        for bounds in [least, most] {
            assert!(bounds.iter().all(|v| (v - 4.0).abs() < 1e-9), "{bounds:?}");
        }
        let behind = Homography::new(map.m.map(|row| row.map(|v| -v)));
        assert_eq!(Extent::of(&behind, [9, 9], None), Extent::NONE);
    }

    #[test]
    fn the_bounds_are_close_on_a_plane_in_perspective() {
        let map = Homography::new([[20.0, 0.0, -9000.0], [0.0, 20.0, 0.0], [0.0, 0.02, 1.0]]);
        let Extent { most, .. } = Extent::of(&map, [1280, 720], None);
        let mut seen = [0.0f64; 2];
        for p in cells(all_of([1280, 720])).flatten() {
            let axes = map.jacobian(p).axes();
            seen = [seen[0].max(axes.major), seen[1].max(axes.minor)];
        }
        assert!((0..2).all(|k| most[k] < 2.0 * seen[k]), "{most:?} {seen:?}");
    }

    #[test]
    fn a_window_is_what_is_seen() {
        let part = Homography::new([[0.1, 0.0, 500.0], [0.0, 0.1, 600.0], [0.0, 0.0, 1.0]]);
        let window = |map: &Homography| {
            Extent::window(map, all_of([100, 50]), ([1000, 1000], true), &Sampler::DEFAULT)
        };
        let found = window(&part).unwrap();
        assert!(found.x0 > 490 && found.y1 < 615 && found.contains(509, 604), "{found:?}");
        assert_eq!(window(&Homography::IDENTITY).map(|w| (w.x0, w.y0)), Some((0, 0)));
        let whole = Homography::new([[10.0, 0.0, 0.0], [0.0, 20.0, 0.0], [0.0, 0.0, 1.0]]);
        assert_eq!(window(&whole), None);
    }
}
