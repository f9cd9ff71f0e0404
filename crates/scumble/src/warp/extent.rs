//! How large a map's footprints are and where they lie, before any is sampled: which levels the pyramid
//! must have, and which part of the source.

use super::Map;
use super::view::View;
use crate::geometry::{DVec2, DVec3, Homography, IntRect, Matrix2, Rect};
use crate::texture::{Footprint, Levels, Outline, Sampler};

/// Cells along each axis into which the output is cut for the bounds.
const CELLS: u32 = 32;

/// How many times as far away the farthest of a cell may be as the nearest, for close bounds.
const FURTHER: f64 = 1.2;

/// How often a cell is halved at most to come to that.
const HALVINGS: usize = 5;

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

    /// The parts of a source that some pixels of the output read; `None` where they may be anywhere. The
    /// source either ends at its edge or goes on with the texels there.
    pub(super) fn parts(
        map: &Homography,
        area: IntRect,
        (source, ends): ([usize; 2], bool),
        sampler: &Sampler,
    ) -> Option<Parts> {
        let mut read = Read::new(source);
        let view = View::new(*map, ends.then_some(source));
        for corners in cells(area).flat_map(|cell| divided(map, cell)) {
            let ends = corners.map(|p| map.project_homogeneous(p));
            let behind = ends.iter().any(|p| p.z <= 0.0);
            read.horizon |= behind;
            if view.misses(&corners) {
                continue;
            }
            if behind {
                return None;
            }
            let extent = Self::before_eye(map, &ends);
            let major = extent.most[0];
            let jacobian = Matrix2::new(major, 0.0, 0.0, major);
            let [across, down] = sampler.reach(&Footprint { u: 0.0, v: 0.0, jacobian });
            let reach = DVec2::new(across, down);
            let places = ends.map(|p| DVec2::new(p.x / p.z, p.y / p.z));
            let around = Rect::bounding(places.iter().flat_map(|p| [*p - reach, *p + reach]))?;
            read.add(around, sampler.levels_for(extent.least, extent.most));
        }
        Some(read.parts())
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

/// The parts of a source that are read; none for all of it, or most.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Parts {
    pub(super) window: Option<IntRect>,
    /// Of the finest levels, from level 0 on.
    pub(super) outlines: [Option<Outline>; 3],
}

/// What has been found to be read of a source.
#[derive(Debug)]
struct Read {
    source: [usize; 2],
    /// In texels, each coordinate cut to the source.
    all: Option<IntRect>,
    levels: [Outline; 3],
    /// Whether the horizon may be seen.
    horizon: bool,
}

impl Read {
    fn new(source: [usize; 2]) -> Self {
        Self { source, all: None, levels: [Outline::new(source[1]); 3], horizon: false }
    }

    /// Adds a part that is read in some levels.
    fn add(&mut self, part: Rect, levels: Levels) {
        let [width, height] = self.source;
        let (first, last) = match levels {
            Levels::BaseOnly => (0, 0),
            Levels::Range { first, last } => (first, last),
            Levels::All => (0, usize::MAX),
        };
        // What asks for a coarser level than there is reads the last.
        let first = first.min(width.max(height).max(1).ilog2() as usize);
        // From the texel nearest to the one end to the one nearest to the other.
        let span = |low: f64, high: f64, n: usize| {
            // In this form a NaN and a side of nothing are no panic, and a NaN is the whole. Sides of
            // textures are below 2²⁹.
            let n = n as f64;
            let low = low.floor().max(0.0).min(n - 1.0);
            (low as i32, high.ceil().max(low + 1.0).min(n) as i32)
        };
        let ((x0, x1), (y0, y1)) = (span(part.x0, part.x1, width), span(part.y0, part.y1, height));
        let part = IntRect::new(x0, y0, x1, y1);
        self.all = Some(self.all.map_or(part, |all| {
            IntRect::new(all.x0.min(x0), all.y0.min(y0), all.x1.max(x1), all.y1.max(y1))
        }));
        let read = self.levels.iter_mut().enumerate().filter(|(l, _)| (first..=last).contains(l));
        read.for_each(|(_, outline)| outline.add(part));
    }

    fn parts(&self) -> Parts {
        let [width, height] = self.source.map(|n| n as f64);
        let window = self.all.unwrap_or(IntRect::new(0, 0, 1, 1));
        let texels = f64::from(window.width()) * f64::from(window.height());
        let window = (texels < WORTH * width * height).then_some(window);
        // At the horizon the mean of all that is kept is seen.
        let outlines = self.levels.map(|outline| (!self.horizon).then_some(outline));
        Parts { window, outlines }
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

/// The parts of a cell in which everything is about as far away, by halving it across.
fn divided(map: &Homography, cell: [DVec2; 4]) -> Vec<[DVec2; 4]> {
    let mut parts = vec![cell];
    for _ in 0..HALVINGS {
        let split = |part: [DVec2; 4]| {
            let [a, b, c, d] = part;
            let far = part.map(|p| map.project_homogeneous(p).z);
            let (least, most) =
                far.iter().fold((f64::INFINITY, 0.0f64), |(l, m), z| (l.min(*z), m.max(*z)));
            if most < FURTHER * least || least <= 0.0 {
                return [Some(part), None];
            }
            if (far[1] - far[0]).abs() > (far[3] - far[0]).abs() {
                let (top, bottom) = ((a + b) * 0.5, (c + d) * 0.5);
                return [Some([a, top, bottom, d]), Some([top, b, c, bottom])];
            }
            let (left, right) = ((a + d) * 0.5, (b + c) * 0.5);
            [Some([a, b, right, left]), Some([left, right, c, d])]
        };
        let count = parts.len();
        parts = parts.into_iter().flat_map(split).flatten().collect();
        if parts.len() == count {
            break;
        }
    }
    parts
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
            let sampler = Sampler::DEFAULT;
            let parts = Extent::parts(&map, all_of(output), (source, true), &sampler);
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
                    let Some(Parts { window, outlines }) = parts.filter(|_| inside) else {
                        continue;
                    };
                    let (u, v) = (f.u as i32, f.v as i32);
                    prop_assert!(window.is_none_or(|w| w.contains(u, v)), "{f:?} {window:?}");
                    let axes = [axes.major, axes.minor];
                    let (first, last) = match sampler.levels_for(axes, axes) {
                        Levels::BaseOnly => (0, 0),
                        Levels::Range { first, last } => (first, last),
                        Levels::All => (0, usize::MAX),
                    };
                    for (l, outline) in outlines.iter().flatten().enumerate() {
                        let columns = outline.columns(v, v + 1);
                        let read = columns.is_some_and(|[x0, x1]| (x0..x1).contains(&u));
                        prop_assert!(read || !(first..=last).contains(&l), "{l} {f:?} {outline:?}");
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
            let source = ([1000, 1000], true);
            Extent::parts(map, all_of([100, 50]), source, &Sampler::DEFAULT)?.window
        };
        let found = window(&part).unwrap();
        assert!(found.x0 > 490 && found.y1 < 615 && found.contains(509, 604), "{found:?}");
        assert_eq!(window(&Homography::IDENTITY).map(|w| (w.x0, w.y0)), Some((0, 0)));
        let whole = Homography::new([[10.0, 0.0, 0.0], [0.0, 20.0, 0.0], [0.0, 0.0, 1.0]]);
        assert_eq!(window(&whole), None);
    }
}
