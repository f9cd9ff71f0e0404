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
use super::steps::Steps;
use crate::area::{CHUNK, Reach, eight_areas, eight_right, splat};
use crate::fixed::{floor, low_bits};
use alloc::vec::Vec;
use core::ops::Range;
use fearless_simd::{Simd, f64x8, prelude::*};
use scumble_geometry::FillRule;

/// The heights of the edges that run up are counted this far beyond those that run down.
const UP: u32 = 32;

/// What is added to a group that is not plain.
const NOT_PLAIN: u64 = 1 << UP | 1;

/// An edge ends in the pixel of its end even if that was computed a little too far left: edges that
/// follow each other touch a common pixel.
const A_LITTLE: f64 = 1.0 / (1 << 26) as f64;

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
    /// The areas of the chunks that are knots, from left to right.
    untied: Vec<[f64; 8]>,
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
    }

    /// Whether no edge matters to the row.
    pub(super) fn is_empty(&self) -> bool {
        self.met.is_empty() && self.passed.is_empty()
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
        self.met.push(Met { edge: place, first, last });
        let height = ((to - from) as u64) << if winding > 0 { 0 } else { UP };
        let weight = f64::from(winding);
        let (from_x, to_x) = (first.max(self.x0), last.min(right - 1));
        let (column, end) = ((from_x - self.x0) as usize, (to_x - self.x0) as usize);
        // What goes on beyond the right side is not known to be plain.
        let cut = if last >= right { NOT_PLAIN } else { 0 };
        self.heights[column] += height + cut;
        self.mark(column, end);
        self.add_long(simd, (column, end), reach, weight);
    }

    /// Adds what lies left of all pixels to the winding number there.
    pub(super) fn pass(&self, left: &mut Steps) {
        for &(from, to, winding) in &self.passed {
            left.add(from, winding);
            left.add(to, -winding);
        }
    }

    /// Adds an edge that touches some pixels.
    #[inline(always)]
    fn add_long<S: Simd>(
        &mut self,
        simd: S,
        (column, end): (usize, usize),
        reach: &Reach,
        weight: f64,
    ) {
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
            self.heights[column] += NOT_PLAIN;
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
            self.heights[0] += NOT_PLAIN;
            self.touched[0] |= 1;
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

    pub(super) fn is_knot(&self, chunk: usize) -> bool {
        self.knots[chunk / 64] >> (chunk % 64) & 1 == 1
    }

    /// The first pixel of a chunk.
    pub(super) fn first_pixel(&self, chunk: usize) -> i32 {
        self.x0 + chunk as i32 * CHUNK
    }

    /// Takes a chunk for a plain one after all.
    pub(super) fn calm(&mut self, chunk: usize) {
        self.knots[chunk / 64] &= !(1 << (chunk % 64));
    }

    /// Unties the next knot.
    pub(super) fn untie(&mut self, areas: [f64; 8]) {
        self.untied.push(areas);
    }

    /// Sums from left to right, and hands on what is covered. `base` is the mean winding number at
    /// the left side.
    #[inline(always)]
    pub(super) fn sweep<S: Simd>(
        &mut self,
        simd: S,
        polygon: &Polygon,
        base: f64,
        (areas, out): (&mut Vec<f32>, &mut impl Stretches),
    ) {
        if areas.len() < self.chunks * 8 {
            areas.resize(self.chunks * 8, 0.0);
        }
        let mut base = base;
        let mut untied = 0;
        // From where on all is `base`, and the touched stretch under way.
        let mut stretch = 0..0usize;
        for word in 0..self.chunks.div_ceil(8) {
            let mut bits = core::mem::take(&mut self.touched[word]);
            self.joined[word] = 0;
            while bits != 0 {
                let byte = bits.trailing_zeros() as usize / 8;
                let here = (bits >> (byte * 8)) as u8;
                bits &= !(0xff << (byte * 8));
                let chunk = word * 8 + byte;
                if chunk * 8 > stretch.end.next_multiple_of(8) || stretch.is_empty() {
                    self.hand_on(areas, stretch.clone(), out);
                    let first = chunk * 8 + here.trailing_zeros() as usize;
                    if polygon.is_inside(base as i32) {
                        out.full(self.pixel(stretch.end), self.pixel(first));
                    }
                    stretch.start = first;
                }
                stretch.end = chunk * 8 + 8 - here.leading_zeros() as usize;
                let means = self.sum_chunk(chunk, &mut base);
                let knot = self.is_knot(chunk).then(|| self.untied[untied]);
                untied += usize::from(knot.is_some());
                let sums = match knot {
                    Some(areas) => f64x8::from_slice(simd, &areas),
                    None => from_means(simd, polygon.rule, &means),
                };
                areas[chunk * 8..chunk * 8 + 8].copy_from_slice(&eight_areas(simd, sums));
            }
        }
        self.knots[..self.chunks.div_ceil(64)].fill(0);
        self.untied.clear();
        self.steps[self.chunks * 8..self.chunks * 8 + 16].fill(0.0);
        self.hand_on(areas, stretch.clone(), out);
        if polygon.is_inside(base as i32) {
            out.full(self.pixel(stretch.end), self.pixel(self.chunks * 8));
        }
    }

    fn pixel(&self, column: usize) -> i32 {
        self.x0 + column as i32
    }

    #[inline(always)]
    fn hand_on(&self, areas: &[f32], columns: Range<usize>, out: &mut impl Stretches) {
        if !columns.is_empty() {
            out.areas(self.pixel(columns.start), &areas[columns]);
        }
    }

    /// The sums of a chunk, from that of the pixel before; and the sum of the pixel after it.
    #[inline(always)]
    fn sum_chunk(&mut self, chunk: usize, sum: &mut f64) -> [f64; 8] {
        let steps = &mut self.steps[chunk * 8..chunk * 8 + 9];
        let mut s = [0.0; 9];
        s.copy_from_slice(steps);
        steps.fill(0.0);
        // In pairs, so that hardly one waits for another.
        let (a, b, c, d) = (s[0] + s[1], s[2] + s[3], s[4] + s[5], s[6] + s[7]);
        let (low, middle) = (*sum, *sum + (a + b));
        *sum = middle + ((c + d) + s[8]);
        [
            low + s[0],
            low + a,
            low + (a + s[2]),
            middle,
            middle + s[4],
            middle + c,
            middle + (c + s[6]),
            middle + (c + d),
        ]
    }
}

/// The areas that follow from mean winding numbers.
#[inline(always)]
fn from_means<S: Simd>(simd: S, rule: FillRule, means: &[f64; 8]) -> f64x8<S> {
    let means = f64x8::from_slice(simd, means);
    match rule {
        FillRule::NonZero => means.abs(),
        // How far it is from an even number.
        FillRule::EvenOdd => {
            let half = means * splat(simd, 0.5);
            let whole = (half + splat(simd, ROUNDER)) - splat(simd, ROUNDER);
            (half - whole).abs() * splat(simd, 2.0)
        }
    }
}

/// 1.5 × 2⁵²: adding it and taking it away again rounds to the nearest whole number.
const ROUNDER: f64 = 6_755_399_441_055_744.0;

/// Receives a row from left to right.
pub(super) trait Stretches {
    /// The pixels from `x0` up to `x1` are inside; they may be none.
    fn full(&mut self, x0: i32, x1: i32);

    /// The areas of the pixels from `x0` on.
    fn areas(&mut self, x0: i32, areas: &[f32]);
}
