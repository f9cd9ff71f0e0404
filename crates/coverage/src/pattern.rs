use crate::{CoverageError, SampleMask};
use alloc::vec::Vec;
use scumble_geometry::DVec2;

/// Where the samples of a pixel lie: up to 64 offsets from its top left corner, in 1/256 pixel.
///
/// Sample i of pixel (x, y) stands at (x + offset.x / 256, y + offset.y / 256) exactly.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct SamplePattern {
    offsets: Vec<[u8; 2]>,
    rows: Vec<SampleRow>,
    /// The samples' indices, those of one row together.
    by_row: Vec<u8>,
    /// The offsets by axis, filled up with copies of the first.
    lanes: [[i32; 64]; 2],
    /// By axis, in 1/256 pixel from the corner of the first: one sample for each of 2 × 8 pixels,
    /// or four for each of 8.
    square: [[i32; 32]; 2],
    /// The smallest and the largest offset by axis.
    extent: [[u8; 2]; 2],
}

/// The samples of a pattern that share one y.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct SampleRow {
    pub(crate) y: u8,
    first: u8,
    end: u8,
}

/// Standard positions in 1/16 pixel from the centre, as Direct3D 11 (§19.2.4) prints them and
/// Vulkan's `standardSampleLocations` requires.
const STANDARD_2: &[[i8; 2]] = &[[4, 4], [-4, -4]];
const STANDARD_4: &[[i8; 2]] = &[[-2, -6], [6, -2], [-6, 2], [2, 6]];
const STANDARD_8: &[[i8; 2]] =
    &[[1, -3], [-1, 3], [5, 1], [-3, -5], [-5, 5], [-7, -1], [3, 7], [7, -7]];
const STANDARD_16: &[[i8; 2]] = &[
    [1, 1],
    [-1, -3],
    [-3, 2],
    [4, -1],
    [-5, -2],
    [2, 5],
    [5, 3],
    [3, -5],
    [-2, 6],
    [0, -7],
    [-4, -6],
    [-6, 4],
    [-8, 0],
    [7, -4],
    [6, 7],
    [-7, -8],
];

/// One sample, at the centre.
impl Default for SamplePattern {
    fn default() -> Self {
        Self::build(alloc::vec![[128, 128]])
    }
}

impl SamplePattern {
    /// The standard positions of Direct3D and Vulkan for 1, 2, 4, 8 or 16 samples.
    ///
    /// # Errors
    /// [`CoverageError::SampleCount`] for any other number.
    pub fn standard(samples: usize) -> Result<Self, CoverageError> {
        let positions = match samples {
            1 => &[[0, 0]],
            2 => STANDARD_2,
            4 => STANDARD_4,
            8 => STANDARD_8,
            16 => STANDARD_16,
            _ => return Err(CoverageError::SampleCount(samples)),
        };
        let to_offset = |v: i8| ((v + 8) as u8) * 16;
        Ok(Self::build(positions.iter().map(|p| p.map(to_offset)).collect()))
    }

    /// The regular grid of k × k samples at ((a + ½)/k, (b + ½)/k), row by row, for
    /// `samples` = k² in 1, 4, 9, 16, 25, 36, 49, 64.
    ///
    /// Where k does not divide 128, the offset is the nearest 1/256: for k = 3, 43, 128, 213.
    ///
    /// # Errors
    /// [`CoverageError::SampleCount`] for any other number.
    pub fn grid(samples: usize) -> Result<Self, CoverageError> {
        let side = (1..=8).find(|k| k * k == samples).ok_or(CoverageError::SampleCount(samples))?;
        // round(256 (i + ½) / k) in whole numbers.
        let at = |i: usize| ((256 * (2 * i + 1) + side) / (2 * side)) as u8;
        Ok(Self::build((0..samples).map(|s| [at(s % side), at(s / side)]).collect()))
    }

    /// Any 1 to 64 offsets in 1/256 pixel, x first.
    ///
    /// # Errors
    /// [`CoverageError::SampleCount`] if there are none or more than 64.
    pub fn custom(offsets: &[[u8; 2]]) -> Result<Self, CoverageError> {
        if offsets.is_empty() || offsets.len() > 64 {
            return Err(CoverageError::SampleCount(offsets.len()));
        }
        Ok(Self::build(offsets.to_vec()))
    }

    fn build(offsets: Vec<[u8; 2]>) -> Self {
        let mut by_row: Vec<u8> = (0..offsets.len() as u8).collect();
        by_row.sort_by_key(|&s| (offsets[usize::from(s)][1], s));
        let mut rows: Vec<SampleRow> = Vec::new();
        for (i, &s) in by_row.iter().enumerate() {
            let y = offsets[usize::from(s)][1];
            match rows.last_mut() {
                Some(row) if row.y == y => row.end = i as u8 + 1,
                _ => rows.push(SampleRow { y, first: i as u8, end: i as u8 + 1 }),
            }
        }
        let axis = |k: usize| {
            let lane = |s: usize| i32::from(offsets.get(s).unwrap_or(&offsets[0])[k]);
            core::array::from_fn(lane)
        };
        let corner = |pick: fn(u8, u8) -> u8| {
            offsets.iter().fold(offsets[0], |p, o| [pick(p[0], o[0]), pick(p[1], o[1])])
        };
        let (lanes, extent) = ([axis(0), axis(1)], [corner(u8::min), corner(u8::max)]);
        let square = square_lanes(&offsets);
        Self { offsets, rows, by_row, lanes, square, extent }
    }

    /// How many samples, 1 to 64.
    // A pattern is never empty, so there is no `is_empty` to go with it.
    #[allow(clippy::len_without_is_empty)]
    #[must_use]
    pub fn len(&self) -> usize {
        self.offsets.len()
    }

    /// The offsets from the pixel's top left corner, x first, in 1/256 pixel.
    #[must_use]
    pub fn offsets(&self) -> &[[u8; 2]] {
        &self.offsets
    }

    /// The mask of every sample.
    #[must_use]
    pub fn full_mask(&self) -> SampleMask {
        SampleMask::full(self.len())
    }

    /// The mean of the offsets of some samples, in pixels: where a colour is evaluated that only what is
    /// covered may tell (centroid sampling). The middle of the pixel if there are none.
    ///
    /// ```
    /// use scumble_coverage::{DVec2, SampleMask, SamplePattern};
    ///
    /// let pattern = SamplePattern::grid(4)?;
    /// assert_eq!(pattern.centroid(SampleMask(0b0011)), DVec2::new(0.5, 0.25));
    /// # Ok::<(), scumble_coverage::CoverageError>(())
    /// ```
    #[must_use]
    pub fn centroid(&self, mask: SampleMask) -> DVec2 {
        let (mut sum, mut count) = (DVec2::ZERO, 0.0);
        for (i, offset) in (0..).zip(&self.offsets) {
            if mask.contains(i) {
                sum += DVec2::from(offset.map(f64::from));
                count += 1.0;
            }
        }
        if count > 0.0 { sum / (256.0 * count) } else { DVec2::splat(0.5) }
    }

    /// The distinct heights of the samples, from the top.
    pub(crate) fn rows(&self) -> &[SampleRow] {
        &self.rows
    }

    /// The offsets by axis, x first, filled up with copies of the first sample.
    pub(crate) fn lanes(&self) -> &[[i32; 64]; 2] {
        &self.lanes
    }

    /// By axis, x first: where the samples of some pixels lie from the corner of the first. With four
    /// samples those of eight pixels, else the first sample of two rows of eight.
    pub(crate) fn square_lanes(&self) -> &[[i32; 32]; 2] {
        &self.square
    }

    /// The corners of the samples' bounding box.
    pub(crate) fn extent(&self) -> [[u8; 2]; 2] {
        self.extent
    }

    /// The samples of one row: their indices.
    pub(crate) fn samples_of(&self, row: &SampleRow) -> &[u8] {
        &self.by_row[usize::from(row.first)..usize::from(row.end)]
    }
}

fn square_lanes(offsets: &[[u8; 2]]) -> [[i32; 32]; 2] {
    let lane = |axis: usize, i: usize| {
        let (sample, pixel) =
            if offsets.len() == 4 { (i % 4, [i / 4, 0]) } else { (0, [i % 8, i / 8]) };
        i32::from(offsets[sample][axis]) + 256 * pixel[axis] as i32
    };
    core::array::from_fn(|axis| core::array::from_fn(|i| lane(axis, i)))
}
