//! The sums of one row of pixels.

use super::{CHUNK, Reach, eight_parts};
use crate::AreaSink;
use alloc::vec::Vec;
use fearless_simd::{Simd, f64x8, prelude::*};

const LANES: usize = CHUNK as usize;

/// Groups of edges that are no further apart than this (in pixels) are handed on together: a sink
/// pays more for a call than for a few pixels.
const GAP: i32 = 4;

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
    cells: Vec<[f64; LANES]>,
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
        self.cells.resize(room, [0.0; LANES]);
        self.onward.resize(room, 0.0);
        self.out.resize(room * LANES, 0.0);
    }

    /// Begins a row; `base` is the area at its left side.
    #[inline(always)]
    pub(crate) fn begin(&mut self, base: f64) {
        self.from = self.x0;
        self.base = base;
        (self.first, self.end) = (self.x0, self.x0);
    }

    /// Adds to all pixels, as long as no group has been ended.
    pub(crate) fn add_left(&mut self, area: f64) {
        self.base += area;
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
        if self.first < self.end && first <= self.end + GAP {
            self.end = self.end.max(end);
        } else {
            self.flush(simd, y, sink);
            (self.first, self.end) = (first.max(self.x0), end);
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
        let whole = weight * reach.height;
        self.onward[to + 1] += whole;
        // What is left behind in the mirror lies left of the edge: the rest is right of it.
        let (all, sign, step) =
            if reach.mirrored { (whole, -weight, -1.0) } else { (0.0, weight, 1.0) };
        let (height, half_rise) = (sign * reach.height, sign * reach.half_rise);
        let lanes = f64x8::from_slice(simd, &COLUMNS) * f64x8::splat(simd, step);
        let mut at = f64::from(self.first + from as i32 * CHUNK);
        for cells in &mut self.cells[from..=to] {
            let corner = if reach.mirrored { -1.0 - at } else { at };
            let c = lanes + f64x8::splat(simd, corner);
            let parts = eight_parts(simd, c, [reach.from, reach.to], height, half_rise);
            let sum = f64x8::from_slice(simd, cells) + f64x8::splat(simd, all) + parts;
            sum.store_slice(cells);
            at += f64::from(CHUNK);
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
        let (zero, one) = (f64x8::splat(simd, 0.0), f64x8::splat(simd, 1.0));
        let chunks = (width - 1) / LANES + 1;
        for ((cells, onward), out) in self.cells[..chunks]
            .iter_mut()
            .zip(&mut self.onward)
            .zip(self.out.chunks_exact_mut(LANES))
        {
            self.base += core::mem::take(onward);
            let v = f64x8::from_slice(simd, cells) + f64x8::splat(simd, self.base);
            zero.store_slice(cells);
            let mut values = [0.0; LANES];
            v.max(zero).min(one).store_slice(&mut values);
            for (out, v) in out.iter_mut().zip(values) {
                *out = v as f32;
            }
        }
        self.base += core::mem::take(&mut self.onward[chunks]);
        let values = &self.out[..width];
        let (left, right) = (held(before), held(self.base));
        let low = values.iter().take_while(|&&v| v == left).count();
        if low == width && left == right {
            return;
        }
        emit(y, self.from, self.first + low as i32, before, sink);
        let values = &values[low..];
        let high = values.len() - values.iter().rev().take_while(|&&v| v == right).count();
        let x = self.first + low as i32;
        if high > 0 {
            sink.row(y, x, &values[..high]);
        }
        self.from = x + high as i32;
    }
}

pub(super) const COLUMNS: [f64; LANES] = [0.0, 1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0];

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
