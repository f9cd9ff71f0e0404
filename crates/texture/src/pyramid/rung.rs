//! The rows of one level on their way to the next.

use crate::TextureError;
use crate::decimate::Taps;
use crate::memory::zeroed;
use crate::pyramid::plan::{LevelPlan, Span};
use crate::texel::Cell;
use alloc::vec::Vec;

/// The last rows of a level that have come, and where its outputs stand.
///
/// Rows have numbers that may lie outside the level: a level that is made in a circle begins somewhere
/// and goes on beyond its last row with its first ones.
#[derive(Debug, Clone)]
pub(crate) struct Rung<T> {
    /// Columns that are made.
    columns: Span,
    /// Row `j` stands in place j mod `room`.
    ring: Vec<T>,
    room: usize,
    /// The first rows that came, for the end of a circle.
    head: Vec<T>,
    heads: usize,
    /// Rows that come, and the next of them.
    rows: [i32; 2],
    next: i32,
    /// Rows of the next level that are made of them, the next of them first.
    outputs: [i32; 2],
    /// Rows of the whole level.
    height: i32,
}

/// Which rows come, and which are made of them.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Course {
    pub(crate) rows: [i32; 2],
    pub(crate) outputs: [i32; 2],
    /// Whether rows beyond the last that comes are the first ones.
    pub(crate) circular: bool,
}

impl<T: Cell> Rung<T> {
    pub(crate) fn new(level: &LevelPlan, course: Course) -> Result<Self, TextureError> {
        let width = level.made[0].len();
        let height = level.size[1];
        let taps = level.taps.as_ref().map_or(0, |[_, rows]| rows.count);
        let room = (taps + 1).max(2);
        let heads = if course.circular { taps.min(height) } else { 0 };
        Ok(Self {
            columns: level.made[0],
            ring: zeroed(room.saturating_mul(width))?,
            room,
            head: zeroed(heads.saturating_mul(width))?,
            heads,
            rows: course.rows,
            next: course.rows[0],
            outputs: course.outputs,
            height: height as i32,
        })
    }

    /// Columns that are made.
    pub(crate) fn columns(&self) -> Span {
        self.columns
    }

    /// Where the next row is to be put.
    pub(crate) fn slot(&mut self) -> &mut [T] {
        let place = self.next.rem_euclid(self.room as i32) as usize;
        let width = self.columns.len();
        &mut self.ring[place * width..][..width]
    }

    /// Whether all rows have come.
    pub(crate) fn is_full(&self) -> bool {
        self.next >= self.rows[1]
    }

    /// Which row of the level the next one is.
    pub(crate) fn index(&self) -> usize {
        self.next.rem_euclid(self.height) as usize
    }

    /// Says that the next row has been put.
    pub(crate) fn advance(&mut self) {
        let (width, number) = (self.columns.len(), (self.next - self.rows[0]) as usize);
        if number < self.heads {
            let place = self.next.rem_euclid(self.room as i32) as usize;
            self.head[number * width..][..width]
                .copy_from_slice(&self.ring[place * width..][..width]);
        }
        self.next += 1;
    }

    /// The next row of the next level that can be made now.
    pub(crate) fn ready(&self, taps: &Taps) -> Option<i32> {
        let [output, end] = self.outputs;
        if output >= end {
            return None;
        }
        let first = taps.first(output);
        let last = first + taps.count as i32;
        // What lies above a mirror stands as far below it.
        let needed = if taps.mirrors() { last.max(-first) } else { last };
        (self.next >= needed.min(self.rows[1])).then_some(output)
    }

    /// Says that it has been made.
    pub(crate) fn made(&mut self) {
        self.outputs[0] += 1;
    }

    /// Row `j`, one of those that an output needs.
    pub(crate) fn row(&self, j: i32, taps: &Taps) -> &[T] {
        let width = self.columns.len();
        let j = if taps.mirrors() { taps.resolve(j) as i32 } else { j };
        if j >= self.rows[1] && self.heads > 0 {
            let number = (j - self.rows[0]).rem_euclid(self.height) as usize;
            return self.head.get(number * width..(number + 1) * width).unwrap_or(&[]);
        }
        &self.ring[j.rem_euclid(self.room as i32) as usize * width..][..width]
    }
}
