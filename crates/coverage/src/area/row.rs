//! The sums of one row of pixels.

use super::{CHUNK, LANES, Reach, eight_areas, eight_parts, mirrored, splat};
use crate::AreaSink;
use alloc::vec::Vec;
use fearless_simd::{Simd, f64x8, prelude::*};

/// Groups of edges that are no further apart than this (in pixels) are handed on together: a sink
/// pays more for a call than for a few pixels.
pub(crate) const GAP: i32 = 4;

/// Sums of one row of pixels within a clip, from left to right.
///
/// Edges come in groups: stretches of pixels that they touch. Between the groups the area is the
/// same all along. All numbers are multiples of 2⁻³², so that nothing is rounded.
#[derive(Debug, Clone, Default)]
pub(crate) struct AreaRow {
    x0: i32,
    x1: i32,
    /// From here on, up to the group, all pixels have the area `base`.
    from: i32,
    base: f64,
    /// The pixels of the group; none while `first == end`.
    first: i32,
    end: i32,
    /// Eight pixels each: the area within them. All zero outside of a group.
    cells: Vec<[f64; 8]>,
    /// Per chunk of cells: what they and all pixels right of them get.
    onward: Vec<f64>,
    out: Vec<f32>,
}

impl AreaRow {
    /// Makes ready for rows of the pixels `x0..x1`.
    pub(crate) fn start(&mut self, x0: i32, x1: i32) {
        (self.x0, self.x1) = (x0, x1);
        // A group's last chunk may reach beyond, and what comes after it goes one further.
        let room = self.cells.len().max(((x1 - x0) / CHUNK) as usize + 2);
        self.cells.resize(room, [0.0; 8]);
        self.onward.resize(room, 0.0);
        self.out.resize(room * 8, 0.0);
    }

    /// Begins a row; `base` is the area at its left side.
    #[inline(always)]
    pub(crate) fn begin(&mut self, base: f64) {
        self.from = self.x0;
        self.base = base;
        (self.first, self.end) = (self.x0, self.x0);
    }

    /// Makes room for edges that touch the pixels `first` to `last` (which may be off the clip):
    /// ends the group before if it lies further left. Calls come by rising `first`.
    #[inline(always)]
    pub(crate) fn open<S: Simd>(
        &mut self,
        simd: S,
        y: i32,
        (first, last): (i32, i32),
        sink: &mut impl AreaSink,
    ) {
        if last < self.x0 || first >= self.x1 {
            return;
        }
        let end = last.min(self.x1 - 1) + 1;
        if self.is_beyond(first) {
            self.flush(simd, y, sink);
            (self.first, self.end) = (first.max(self.x0), end);
        } else {
            self.end = self.end.max(end);
        }
    }

    /// Adds `weight` (+1 or −1) times what lies right of an edge that touches the pixels `first` to
    /// `last`, for which a group is open.
    #[inline(always)]
    pub(crate) fn add<S: Simd>(
        &mut self,
        simd: S,
        reach: &Reach,
        (first, last): (i32, i32),
        weight: f64,
    ) {
        if first >= self.x1 {
            return;
        }
        if last < self.x0 {
            self.base += weight * reach.height;
            return;
        }
        let chunk = |x: i32| ((x - self.first) / CHUNK) as usize;
        let (from, to) = (chunk(first.max(self.first)), chunk(last.min(self.end - 1)));
        self.onward[to + 1] += weight * reach.height;
        let mut at = self.first + from as i32 * CHUNK;
        for cells in &mut self.cells[from..=to] {
            let sum = f64x8::from_slice(simd, cells) + eight_right(simd, at, reach, weight);
            sum.store_slice(cells);
            at += CHUNK;
        }
    }

    /// Whether a group from pixel `first` on would be a new one.
    #[inline(always)]
    pub(crate) fn is_beyond(&self, first: i32) -> bool {
        self.first == self.end || first > self.end + GAP
    }

    /// Opens a group for an edge alone, adds it and ends the group: the same as these three, for an
    /// edge that touches no more than [`CHUNK`] pixels and is beyond the group before.
    #[inline(always)]
    pub(crate) fn add_lone<S: Simd>(
        &mut self,
        simd: S,
        y: i32,
        reach: &Reach,
        (first, last): (i32, i32),
        weight: f64,
        sink: &mut impl AreaSink,
    ) {
        self.flush(simd, y, sink);
        self.end = self.first;
        if first >= self.x1 {
            return;
        }
        let before = self.base;
        self.base += weight * reach.height;
        if last >= self.x0 {
            let first = first.max(self.x0);
            let sum = splat(simd, before) + eight_right(simd, first, reach, weight);
            let areas = eight_areas(simd, sum);
            let width = (last.min(self.x1 - 1) + 1 - first) as usize;
            self.from = emit_group(y, self.from, first, &areas[..width], [before, self.base], sink);
        }
    }

    /// Hands on what is left of the row.
    #[inline(always)]
    pub(crate) fn finish<S: Simd>(&mut self, simd: S, y: i32, sink: &mut impl AreaSink) {
        self.flush(simd, y, sink);
        emit(y, self.from, self.x1, self.base, sink);
    }

    /// Ends the group: hands on the stretch before it and its pixels, save those at either end that
    /// are like the stretch beside them.
    #[inline(always)]
    fn flush<S: Simd>(&mut self, simd: S, y: i32, sink: &mut impl AreaSink) {
        let width = (self.end - self.first) as usize;
        if width == 0 {
            return;
        }
        let before = self.base;
        let chunks = (width - 1) / 8 + 1;
        for ((cells, onward), out) in
            self.cells[..chunks].iter_mut().zip(&mut self.onward).zip(self.out.chunks_exact_mut(8))
        {
            self.base += core::mem::take(onward);
            let v = f64x8::from_slice(simd, cells) + splat(simd, self.base);
            *cells = [0.0; 8];
            out.copy_from_slice(&eight_areas(simd, v));
        }
        self.base += core::mem::take(&mut self.onward[chunks]);
        let between = [before, self.base];
        self.from = emit_group(y, self.from, self.first, &self.out[..width], between, sink);
    }
}

/// What lies right of an edge in the eight pixels from `x` on, times `weight`.
#[inline(always)]
pub(crate) fn eight_right<S: Simd>(simd: S, x: i32, reach: &Reach, weight: f64) -> f64x8<S> {
    let ends = [reach.from, reach.to];
    let (sign, weighted) = (reach.sign, reach.sign * weight);
    let (height, half_rise) = (weighted * reach.height, weighted * reach.half_rise);
    // What is left behind in the mirror lies left of the edge: the rest is right of it.
    let (first, all) = mirrored(sign, f64::from(x), weight * reach.height);
    let c = f64x8::from_slice(simd, &LANES) * splat(simd, sign) + splat(simd, first);
    splat(simd, all) + eight_parts(simd, c, ends, height, half_rise)
}

/// Hands on a stretch of equal area from `from` on and the pixels from `first` on, save those at
/// either end that are like the stretch beside them. Tells from where on the next stretch runs.
#[inline(always)]
fn emit_group(
    y: i32,
    from: i32,
    first: i32,
    areas: &[f32],
    [before, after]: [f64; 2],
    sink: &mut impl AreaSink,
) -> i32 {
    let (left, right) = (held(before), held(after));
    let mut low = 0;
    while low < areas.len() && areas[low] == left {
        low += 1;
    }
    if low == areas.len() && left == right {
        return from;
    }
    let x = first + low as i32;
    emit(y, from, x, before, sink);
    let mut high = areas.len();
    while high > low && areas[high - 1] == right {
        high -= 1;
    }
    if low < high {
        sink.row(y, x, &areas[low..high]);
    }
    first + high as i32
}

#[inline(always)]
fn held(area: f64) -> f32 {
    area.clamp(0.0, 1.0) as f32
}

/// Hands a stretch of equal area on.
#[inline(always)]
fn emit(y: i32, x0: i32, x1: i32, area: f64, sink: &mut impl AreaSink) {
    if x0 >= x1 {
        return;
    }
    let area = held(area);
    if area >= 1.0 {
        sink.run(y, x0, x1);
    } else if area > 0.0 {
        sink.span(y, x0, x1, area);
    }
}
