//! What the edges of one row of pixels come to, eight pixels at a time.
//!
//! The sum of what lies right of all edges is the mean winding number of each pixel. Where the
//! winding number takes but two neighbouring values, the area follows from its mean; where it does
//! not, the eight pixels are a knot that someone else has to untie.
//!
//! To tell, the pixels that edges touch are joined into groups, wherever an edge touches two
//! neighbours. No edge passes between two groups, so that the winding number there is the same from
//! the top of the row to its bottom. If all edges of a group run down, and there is exactly one at
//! each height, then the winding number rises by one from the left of the group to its right, and
//! so it does at every height in between: the group is plain. The same holds upwards.

use super::Polygon;
use super::eights::A_LITTLE;
use super::steps::Steps;
use crate::area::{CHUNK, Reach, eight_right, splat};
use crate::fixed::{WHOLE, floor, low_bits};
use alloc::vec::Vec;
use core::ops::Range;
use fearless_simd::{Simd, f64x8, prelude::*};
use scumble_geometry::FillRule;

/// The heights of the edges that run up are counted this far beyond those that run down.
const UP: u32 = 32;

/// What is added to a group that is not plain.
const NOT_PLAIN: u64 = 1 << UP | 1;

/// The pixels that an edge touches in a row.
#[derive(Debug, Clone, Copy)]
pub(super) struct Met {
    /// Its place among the gathered edges.
    pub(super) edge: u32,
    pub(super) first: i32,
    pub(super) last: i32,
}

/// Sums of one row of pixels, from left to right. Everything is zero between rows.
#[derive(Debug, Clone, Default)]
pub(super) struct RowSums {
    /// The leftmost pixel, a multiple of [`CHUNK`], and how many chunks there are.
    x0: i32,
    chunks: usize,
    /// Per pixel: by how much the sum exceeds that of the pixel before.
    steps: Vec<f64>,
    /// The chunks that are knots, from left to right, and their areas.
    untied: Vec<(usize, [f64; 8])>,
    /// Per pixel: the heights of the edges that begin there, those that run up shifted by [`UP`].
    heights: Vec<u64>,
    /// One bit per pixel: whether an edge touches it, and whether one touches the pixel before
    /// it as well.
    touched: Vec<u64>,
    joined: Vec<u64>,
    /// One bit per chunk.
    knots: Vec<u64>,
    /// The edges that matter.
    pub(super) met: Vec<Met>,
    /// Whether the mean winding number is known to tell the area wherever edges are.
    pub(super) proven: bool,
    /// Whether anything was added since the last row.
    used: bool,
    /// The heights of edges left of all pixels, if it is known.
    pub(super) before: f64,
    /// What lies left of all pixels: heights in 1/256 pixel from the top of the row, and the winding
    /// number between them.
    passed: Vec<(i32, i32, i32)>,
}

impl RowSums {
    /// Makes ready for a row of the pixels `x0..x1`; `x0` is a multiple of [`CHUNK`].
    pub(super) fn start(&mut self, x0: i32, x1: i32) {
        let chunks = ((x1 - x0 + CHUNK - 1) / CHUNK) as usize;
        (self.x0, self.chunks) = (x0, chunks);
        // Only growth needs filling.
        if chunks > self.touched.len() * 8 {
            let room = chunks.next_multiple_of(8);
            // An edge is added to as many pixels beyond its end as fill eight.
            self.steps.resize(room * 8 + 16, 0.0);
            self.heights.resize(room * 8, 0);
            self.touched.resize(room / 8, 0);
            self.joined.resize(room / 8, 0);
            self.knots.resize(room.div_ceil(64), 0);
        }
    }

    /// Forgets the edges of the row before.
    pub(super) fn clear(&mut self) {
        self.met.clear();
        self.passed.clear();
        self.used = false;
        self.before = 0.0;
    }

    /// Whether no edge matters to the row.
    pub(super) fn is_empty(&self) -> bool {
        !self.used && self.passed.is_empty()
    }

    /// Adds what there is of an edge in the row: its place among all edges and the winding number that it
    /// adds, between which heights (1/256 pixel from the top of the row) and how it runs there.
    #[inline(always)]
    pub(super) fn add<S: Simd>(
        &mut self,
        simd: S,
        (place, winding): (u32, i32),
        (from, to): (i32, i32),
        reach: &Reach,
    ) {
        let right = self.x0 + self.chunks as i32 * CHUNK;
        let [low, high] = reach.extent();
        let first = low_bits(floor(low));
        let last = low_bits(floor(high + A_LITTLE));
        if first >= right {
            return;
        }
        if last < self.x0 {
            self.passed.push((from, to, winding));
            return;
        }
        self.used = true;
        self.met.push(Met { edge: place, first, last });
        let height = ((to - from) as u64) << if winding > 0 { 0 } else { UP };
        // What goes on beyond the right side is not known to be plain.
        let cut = if last >= right { NOT_PLAIN } else { 0 };
        self.heights[(first.max(self.x0) - self.x0) as usize] += height + cut;
        self.add_long(simd, (first, last), reach, f64::from(winding));
    }

    /// Adds what lies left of all pixels to the winding number there.
    pub(super) fn pass(&self, left: &mut Steps) {
        for &(from, to, winding) in &self.passed {
            left.add(from, winding);
            left.add(to, -winding);
        }
    }

    /// Adds the `rises` of an edge that touches a pixel, and one `more` or none, if the row has them, to a
    /// row of which all is known; else says `false`.
    #[inline(always)]
    pub(super) fn add_short(&mut self, (first, more): (i32, i32), rises: [f64; 3]) -> bool {
        let column = first.wrapping_sub(self.x0) as u32 as usize;
        let two = more as u32;
        if two > 1 || column + two as usize >= self.chunks * 8 {
            return false;
        }
        self.used = true;
        let steps: &mut [f64] = &mut self.steps[column..column + 3];
        for (step, rise) in steps.iter_mut().zip(rises) {
            *step += rise;
        }
        let (word, bit) = (column / 64, column % 64);
        self.touched[word] |= (1 | u64::from(two) << 1) << bit;
        if two != 0 && bit == 63 {
            self.touched[word + 1] |= 1;
        }
        true
    }

    /// Adds an edge that touches the pixels from `first` to `last` to a row of which all is known; its
    /// heights carry its winding number.
    #[inline(always)]
    pub(super) fn add_known<S: Simd>(&mut self, simd: S, (first, last): (i32, i32), reach: &Reach) {
        let right = self.x0 + self.chunks as i32 * CHUNK;
        if first >= right {
            return;
        }
        self.used = true;
        if last < self.x0 {
            self.before += reach.height;
            return;
        }
        self.add_long(simd, (first, last), reach, 1.0);
    }

    /// Adds an edge that touches the pixels from `first` to `last`, some of them here.
    #[inline(always)]
    fn add_long<S: Simd>(
        &mut self,
        simd: S,
        (first, last): (i32, i32),
        reach: &Reach,
        weight: f64,
    ) {
        let (first, last) = (first - self.x0, last - self.x0);
        let column = first.max(0) as usize;
        let end = last.min(self.chunks as i32 * CHUNK - 1) as usize;
        self.mark(column, end);
        // The last is the area of the pixel before. Beyond the edge all are the same.
        let mut before = splat(simd, 0.0);
        for at in (column..end + 2).step_by(8) {
            let here = eight_right(simd, self.pixel(at), reach, weight);
            let rises = here - before.slide::<7>(here);
            let steps = &mut self.steps[at..at + 8];
            (f64x8::from_slice(simd, steps) + rises).store_slice(steps);
            before = here;
        }
    }

    /// Adds a level edge inside the row, of which the winding number changes all along.
    pub(super) fn add_level(&mut self, left: i32, right: i32) {
        let end = self.x0 + self.chunks as i32 * CHUNK - 1;
        if left <= end && right >= self.x0 {
            let column = (left.max(self.x0) - self.x0) as usize;
            if !self.proven {
                self.heights[column] += NOT_PLAIN;
            }
            self.mark(column, (right.min(end) - self.x0) as usize);
        }
    }

    /// Marks pixels that one edge touches.
    #[inline(always)]
    fn mark(&mut self, first: usize, last: usize) {
        let (from, to) = (first / 64, last / 64);
        let low = u64::MAX << (first % 64);
        let high = u64::MAX >> (63 - last % 64);
        if from == to {
            self.touched[from] |= low & high;
            self.joined[from] |= (low << 1) & high;
            return;
        }
        self.touched[from] |= low;
        self.joined[from] |= low << 1;
        for word in from + 1..to {
            self.touched[word] = u64::MAX;
            self.joined[word] = u64::MAX;
        }
        self.touched[to] |= high;
        self.joined[to] |= high;
    }

    /// Finds the chunks that are knots (all that are touched, if not `PLAIN`), and whether there are
    /// any.
    #[inline(always)]
    pub(super) fn find_knots<const PLAIN: bool>(&mut self, left: &Steps) -> bool {
        if !left.is_constant() {
            self.touched[0] |= 1;
        }
        if self.proven {
            return false;
        }
        if !left.is_constant() {
            self.heights[0] += NOT_PLAIN;
        }
        let mut any = false;
        // The group under way: where it begins and ends, and its heights.
        let (mut begin, mut end, mut heights) = (0, 0, 256);
        for word in 0..self.chunks.div_ceil(8) {
            let mut bits = self.touched[word];
            let joined = self.joined[word];
            while bits != 0 {
                let bit = bits.trailing_zeros() as usize;
                bits &= bits - 1;
                let column = word * 64 + bit;
                if joined >> bit & 1 == 0 {
                    any |= self.end_group::<PLAIN>(begin, end, heights);
                    (begin, heights) = (column, 0);
                }
                heights += core::mem::take(&mut self.heights[column]);
                end = column;
            }
        }
        any | self.end_group::<PLAIN>(begin, end, heights)
    }

    #[inline(always)]
    fn end_group<const PLAIN: bool>(&mut self, begin: usize, end: usize, heights: u64) -> bool {
        if PLAIN && (heights == 256 || heights == 256 << UP) {
            return false;
        }
        for chunk in begin / 8..=end / 8 {
            self.knots[chunk / 64] |= 1 << (chunk % 64);
        }
        true
    }

    /// The knot from `chunk` on.
    #[inline(always)]
    pub(super) fn next_knot(&self, chunk: usize) -> Option<usize> {
        let mut word = chunk / 64;
        let mut bits = *self.knots.get(word)? & (u64::MAX << (chunk % 64));
        while bits == 0 {
            word += 1;
            bits = *self.knots.get(word)?;
        }
        Some(word * 64 + bits.trailing_zeros() as usize)
    }

    /// The first pixel of a chunk.
    pub(super) fn first_pixel(&self, chunk: usize) -> i32 {
        self.x0 + chunk as i32 * CHUNK
    }

    /// Takes a chunk for a plain one after all.
    pub(super) fn calm(&mut self, chunk: usize) {
        self.knots[chunk / 64] &= !(1 << (chunk % 64));
    }

    /// Unties the knot `chunk`; knots come from left to right.
    pub(super) fn untie(&mut self, chunk: usize, areas: [f64; 8]) {
        self.untied.push((chunk, areas));
    }

    /// Sums from left to right, and hands on what is covered. `base` is the mean winding number at
    /// the left side.
    #[inline(always)]
    pub(super) fn sweep(
        &mut self,
        polygon: &Polygon,
        base: f64,
        (areas, out): (&mut Vec<f32>, &mut impl Stretches),
    ) {
        match polygon.rule {
            FillRule::NonZero => self.sweep_by::<false>(polygon, base, (areas, out)),
            FillRule::EvenOdd => self.sweep_by::<true>(polygon, base, (areas, out)),
        }
    }

    #[inline(always)]
    fn sweep_by<const EVEN_ODD: bool>(
        &mut self,
        polygon: &Polygon,
        base: f64,
        (areas, out): (&mut Vec<f32>, &mut impl Stretches),
    ) {
        let columns = self.chunks * 8;
        if areas.len() < columns {
            areas.resize(columns, 0.0);
        }
        let mut sum = base;
        // The touched stretch under way, and how many knots lie left of it.
        let mut stretch = 0..0usize;
        let mut untied = 0;
        for word in 0..self.chunks.div_ceil(8) {
            let mut bits = core::mem::take(&mut self.touched[word]);
            self.joined[word] = 0;
            while bits != 0 {
                let low = bits.trailing_zeros();
                let count = (bits >> low).trailing_ones();
                bits &= u64::MAX.checked_shl(low + count).unwrap_or(0);
                let from = word * 64 + low as usize;
                let to = from + count as usize;
                if from > stretch.end + GAP {
                    self.hand_on((areas, &mut untied), stretch.clone(), out);
                    if polygon.is_inside(sum as i32) {
                        out.full(self.pixel(stretch.end), self.pixel(from));
                    }
                    stretch.start = from;
                } else if from > stretch.end {
                    areas[stretch.end..from].fill(area::<EVEN_ODD>(sum));
                }
                stretch.end = to;
                for (step, area_here) in self.steps[from..to].iter_mut().zip(&mut areas[from..to]) {
                    sum += core::mem::take(step);
                    *area_here = area::<EVEN_ODD>(sum);
                }
                sum += core::mem::take(&mut self.steps[to]);
            }
        }
        self.hand_on((areas, &mut untied), stretch.clone(), out);
        if !self.untied.is_empty() {
            self.knots[..self.chunks.div_ceil(64)].fill(0);
            self.untied.clear();
        }
        self.steps[columns..columns + 16].fill(0.0);
        if polygon.is_inside(sum as i32) {
            out.full(self.pixel(stretch.end), self.pixel(columns));
        }
    }

    fn pixel(&self, column: usize) -> i32 {
        self.x0 + column as i32
    }

    /// Hands on the areas of a stretch, the next one; `untied` of the knots lie left of it.
    #[inline(always)]
    fn hand_on(
        &self,
        (areas, untied): (&mut [f32], &mut usize),
        stretch: Range<usize>,
        out: &mut impl Stretches,
    ) {
        while let Some((chunk, knot)) = self.untied.get(*untied)
            && chunk * 8 < stretch.end
        {
            for (column, area) in (chunk * 8..).zip(knot) {
                if stretch.contains(&column) {
                    areas[column] = held(*area);
                }
            }
            if chunk * 8 + 8 > stretch.end {
                // The rest of it lies in the next.
                break;
            }
            *untied += 1;
        }
        if !stretch.is_empty() {
            out.areas(self.pixel(stretch.start), &areas[stretch]);
        }
    }
}

/// Groups of pixels that are touched and no further apart than this are handed on together: that takes
/// less than to hand on what is between them by itself.
const GAP: usize = 4;

/// The area that follows from a mean winding number.
#[inline(always)]
fn area<const EVEN_ODD: bool>(mean: f64) -> f32 {
    if EVEN_ODD {
        // How far it is from an even number: twice the nearest whole number.
        let half = mean * 0.5;
        let whole = (half + WHOLE) - WHOLE;
        return held((half - whole).abs() * 2.0);
    }
    held(mean.abs())
}

#[inline(always)]
fn held(area: f64) -> f32 {
    area.clamp(0.0, 1.0) as f32
}

/// Receives a row from left to right.
pub(super) trait Stretches {
    /// The pixels from `x0` up to `x1` are inside; they may be none.
    fn full(&mut self, x0: i32, x1: i32);

    /// The areas of the pixels from `x0` on.
    fn areas(&mut self, x0: i32, areas: &[f32]);
}
