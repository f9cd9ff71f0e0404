//! From an image to its pyramid, rows after rows.
//!
//! A row is decoded to floats, filtered along itself to half its length and kept until the rows of the
//! next level that it has a share in are made: memory is read once and written once. The base is stored
//! on the way to the first level. Sums are of floats; each texel is rounded once, as it is stored.

use crate::Simd;
use crate::decimate::Taps;
use crate::engine::{Scalar, Vector};
use crate::level::Level;
use crate::texel::{self, ONE, Texel};
use crate::{Decimation, Wrap};
use alloc::vec;
use fearless_simd::{dispatch, f32x8, prelude::*};
#[cfg(feature = "parallel")]
use rayon::prelude::*;
use scumble_pixel::srgb::decode8;
use scumble_pixel::{ImageView, WorkingSpace};

/// Rows of a level that are made together. Its neighbours' rows that it needs are filtered again.
const BLOCK: usize = 64;

/// Rows of colours in steps, and where to find them.
pub(crate) trait Rows: Sync {
    /// Texels of a row.
    fn width(&self) -> usize;
    /// Rows.
    fn height(&self) -> usize;
    /// Row `y`, which must exist.
    fn read(&self, y: usize, out: &mut [[f32; 4]]);
}

impl Rows for Level {
    fn width(&self) -> usize {
        self.width
    }

    fn height(&self) -> usize {
        self.height
    }

    #[inline(always)]
    fn read(&self, y: usize, out: &mut [[f32; 4]]) {
        let row = self.row(y).as_flattened();
        for (out, t) in out.as_flattened_mut().iter_mut().zip(row) {
            *out = f32::from(*t);
        }
    }
}

/// Straight-alpha, sRGB-encoded bytes, to be brought into a working space.
pub(crate) struct Bytes<'a> {
    image: ImageView<'a, [u8; 4]>,
    /// The steps of each code in linear light, if that is the space.
    table: Option<[f32; 256]>,
}

impl<'a> Bytes<'a> {
    pub(crate) fn new(image: ImageView<'a, [u8; 4]>, space: WorkingSpace) -> Self {
        let table = match space {
            WorkingSpace::Srgb => None,
            WorkingSpace::Linear => Some(core::array::from_fn(|code| decode8(code as u8) * ONE)),
        };
        Self { image, table }
    }
}

impl Rows for Bytes<'_> {
    fn width(&self) -> usize {
        self.image.width()
    }

    fn height(&self) -> usize {
        self.image.height()
    }

    #[inline(always)]
    fn read(&self, y: usize, out: &mut [[f32; 4]]) {
        let row = self.image.row(y);
        match &self.table {
            None => {
                for (t, &[r, g, b, a]) in out.iter_mut().zip(row) {
                    let alpha = f32::from(a) * (ONE / (255.0 * 255.0));
                    *t = [r, g, b, 255].map(|v| texel::whole(f32::from(v) * alpha));
                }
            }
            Some(table) => {
                for (t, &[r, g, b, a]) in out.iter_mut().zip(row) {
                    let alpha = f32::from(a) * (1.0 / 255.0);
                    let [r, g, b] = [r, g, b].map(|v| table[usize::from(v)]);
                    *t = [r, g, b, ONE].map(|v| texel::whole(v * alpha));
                }
            }
        }
    }
}

/// Stores every row of a source of the level's size.
pub(crate) fn store(source: &impl Rows, level: &mut Level) {
    let (width, stride) = (level.width, level.stride);
    let block = |(i, rows): (usize, &mut [Texel])| {
        compiled(
            #[inline(always)]
            || {
                let mut line = vec![[0.0; 4]; width];
                for (y, row) in rows.chunks_exact_mut(stride).enumerate() {
                    source.read(i * BLOCK + y, &mut line);
                    put(&line, row);
                }
            },
        );
    };
    #[cfg(feature = "parallel")]
    level.texels.par_chunks_mut(BLOCK * stride).enumerate().for_each(block);
    #[cfg(not(feature = "parallel"))]
    block((0, &mut level.texels));
}

/// Makes the level that follows a source.
pub(crate) fn halve(source: &impl Rows, to: &mut Level, filter: Decimation, wrap: Wrap) {
    let halver = Halver::new(source, filter, wrap);
    let stride = to.stride;
    let block = |(i, out): (usize, &mut [Texel])| {
        halver.make(i * BLOCK, out, stride, (&mut [], 0));
    };
    #[cfg(feature = "parallel")]
    to.texels.par_chunks_mut(BLOCK * stride).enumerate().for_each(block);
    #[cfg(not(feature = "parallel"))]
    block((0, &mut to.texels));
}

/// Stores a source of an even height and makes the level that follows it, in one go.
pub(crate) fn store_and_halve(
    source: &impl Rows,
    base: &mut Level,
    to: &mut Level,
    filter: Decimation,
    wrap: Wrap,
) {
    let halver = Halver::new(source, filter, wrap);
    let (stored, stride) = (base.stride, to.stride);
    let block = |(i, (base, out)): (usize, (&mut [Texel], &mut [Texel]))| {
        halver.make(i * BLOCK, out, stride, (base, stored));
    };
    #[cfg(feature = "parallel")]
    base.texels
        .par_chunks_mut(2 * BLOCK * stored)
        .zip(to.texels.par_chunks_mut(BLOCK * stride))
        .enumerate()
        .for_each(block);
    #[cfg(not(feature = "parallel"))]
    block((0, (&mut base.texels, &mut to.texels)));
}

/// Runs a function compiled for the best instructions there are, which changes nothing else.
#[inline(always)]
fn compiled(f: impl FnOnce()) {
    match Simd::best().0 {
        None => f(),
        Some(level) => dispatch!(level, _simd => f()),
    }
}

/// Rounds a row of colours into the first texels of a stored one.
#[inline(always)]
fn put(line: &[[f32; 4]], row: &mut [Texel]) {
    let row = row.as_flattened_mut();
    for (t, v) in row.iter_mut().zip(line.as_flattened()) {
        *t = texel::round(*v);
    }
}

/// The filters from a source to the next level.
struct Halver<'a, R> {
    source: &'a R,
    columns: Taps,
    rows: Taps,
}

impl<'a, R: Rows> Halver<'a, R> {
    fn new(source: &'a R, filter: Decimation, wrap: Wrap) -> Self {
        let columns = Taps::new(source.width(), filter, wrap);
        let rows = Taps::new(source.height(), filter, wrap);
        Self { source, columns, rows }
    }

    /// Rows of the next level from `first` on, compiled for the best instructions there are. Rows of the
    /// source from twice that on are stored in `base`, as far as it goes; its second number is their
    /// distance.
    fn make(&self, first: usize, out: &mut [Texel], stride: usize, base: (&mut [Texel], usize)) {
        match Simd::best().0 {
            None => self.run(Scalar, first, out, stride, base),
            Some(level) => {
                dispatch!(level, simd => self.run(Vector(simd), first, out, stride, base));
            }
        }
    }

    #[inline(always)]
    fn run(
        &self,
        lanes: impl Lanes,
        first: usize,
        out: &mut [Texel],
        stride: usize,
        (base, stored): (&mut [Texel], usize),
    ) {
        let (columns, rows) = (&self.columns, &self.rows);
        let [left, right] = columns.margins();
        let width = self.source.width();
        let mut line = vec![[0.0; 4]; left + width + right];
        // The last rows of the source, filtered along themselves: row i in place i mod their number.
        let mut kept = vec![vec![[0.0; 4]; columns.outputs]; rows.count];
        let mut result = vec![[0.0; 4]; columns.outputs];
        let mut next = i32::MIN;
        for (i, out) in out.chunks_exact_mut(stride).enumerate() {
            let from = rows.firsts[first + i];
            for j in from.max(next)..from + rows.count as i32 {
                let y = rows.resolve(j);
                self.source.read(y, &mut line[left..left + width]);
                // Rows of the neighbours are theirs to store.
                let start = y.checked_sub(2 * first).map(|y| y * stored);
                if let Some(row) = start.and_then(|i| base.get_mut(i..i + stored)) {
                    put(&line[left..left + width], row);
                }
                for k in (0..left).chain(left + width..left + width + right) {
                    line[k] = line[left + columns.resolve(k as i32 - left as i32)];
                }
                along(lanes, columns, left, &line, &mut kept[place(j, rows.count)]);
            }
            next = from + rows.count as i32;
            let row = |k: usize| &kept[place(from + k as i32, rows.count)][..];
            let weights = rows.weights(first + i);
            let out = &mut out[..columns.outputs];
            if let Ok(weights) = weights.try_into() {
                across::<8>(weights, row, out);
            } else if let Ok(weights) = weights.try_into() {
                across::<2>(weights, row, out);
            } else {
                across_any(weights, row, &mut result);
                put(&result, out);
            }
        }
    }
}

/// Where row `j` is kept.
#[inline(always)]
fn place(j: i32, count: usize) -> usize {
    j.rem_euclid(count as i32) as usize
}

/// Σ wₖ·tₖ along a row that begins with `left` texels of its margin.
#[inline(always)]
fn along(lanes: impl Lanes, taps: &Taps, left: usize, line: &[[f32; 4]], out: &mut [[f32; 4]]) {
    if taps.is_even() {
        // One set of weights, two texels from output to output, beginning with the margin.
        let weights = taps.weights(0);
        if let Ok(weights) = weights.try_into() {
            return along_pairs(lanes, &pairs::<8, 4>(weights), line, out);
        }
        if let Ok(weights) = weights.try_into() {
            return along_pairs(lanes, &pairs::<2, 1>(weights), line, out);
        }
    }
    for (i, out) in out.iter_mut().enumerate() {
        let first = (taps.firsts[i] + left as i32) as usize;
        *out = [0.0; 4];
        for (w, t) in taps.weights(i).iter().zip(&line[first..first + taps.count]) {
            for (out, t) in out.iter_mut().zip(t) {
                *out += w * t;
            }
        }
    }
}

/// The weights of pairs of texels, each four times.
#[inline(always)]
fn pairs<const N: usize, const PAIRS: usize>(weights: &[f32; N]) -> [[f32; 8]; PAIRS] {
    let mut pairs = [[0.0; 8]; PAIRS];
    for (k, weight) in pairs.as_flattened_mut().iter_mut().enumerate() {
        *weight = weights[k / 4];
    }
    pairs
}

/// Two texels at a time.
#[inline(always)]
fn along_pairs<const PAIRS: usize>(
    lanes: impl Lanes,
    weights: &[[f32; 8]; PAIRS],
    line: &[[f32; 4]],
    out: &mut [[f32; 4]],
) {
    let (line, _) = line.as_chunks::<2>();
    for (out, run) in out.iter_mut().zip(line.windows(PAIRS)) {
        *out = lanes.sum(weights, run);
    }
}

/// The sum along a run of pairs of texels, in scalar code or in vectors: the same bits from each.
trait Lanes: Copy {
    /// Σ wₖ·tₖ, odd and even texels apart and then together.
    fn sum<const PAIRS: usize>(
        self,
        weights: &[[f32; 8]; PAIRS],
        run: &[[[f32; 4]; 2]],
    ) -> [f32; 4];
}

impl Lanes for Scalar {
    #[inline(always)]
    fn sum<const PAIRS: usize>(
        self,
        weights: &[[f32; 8]; PAIRS],
        run: &[[[f32; 4]; 2]],
    ) -> [f32; 4] {
        let mut sum = [0.0; 8];
        for (w, pair) in weights.iter().zip(run) {
            for ((sum, w), t) in sum.iter_mut().zip(w).zip(pair.as_flattened()) {
                *sum += w * t;
            }
        }
        core::array::from_fn(|c| sum[c] + sum[c + 4])
    }
}

impl<S: fearless_simd::Simd> Lanes for Vector<S> {
    #[inline(always)]
    fn sum<const PAIRS: usize>(
        self,
        weights: &[[f32; 8]; PAIRS],
        run: &[[[f32; 4]; 2]],
    ) -> [f32; 4] {
        let mut sum = f32x8::splat(self.0, 0.0);
        for (w, pair) in weights.iter().zip(run) {
            let pair = f32x8::from_slice(self.0, pair.as_flattened());
            sum += f32x8::load_array_ref(self.0, w) * pair;
        }
        let (even, odd) = sum.split();
        (even + odd).to_array()
    }
}

/// Σ wₖ·tₖ of whole rows, rounded.
#[inline(always)]
fn across<'a, const N: usize>(
    weights: &[f32; N],
    row: impl Fn(usize) -> &'a [[f32; 4]],
    out: &mut [Texel],
) {
    let out = out.as_flattened_mut();
    let mut rows = [&[][..]; N];
    for (k, each) in rows.iter_mut().enumerate() {
        *each = &row(k).as_flattened()[..out.len()];
    }
    for (x, out) in out.iter_mut().enumerate() {
        let mut sum = 0.0;
        for k in 0..N {
            sum += weights[k] * rows[k][x];
        }
        *out = texel::round(sum);
    }
}

/// The same for any number of rows, not rounded.
#[inline(always)]
fn across_any<'a>(weights: &[f32], row: impl Fn(usize) -> &'a [[f32; 4]], out: &mut [[f32; 4]]) {
    out.fill([0.0; 4]);
    let out = out.as_flattened_mut();
    for (k, w) in weights.iter().enumerate() {
        for (out, t) in out.iter_mut().zip(row(k).as_flattened()) {
            *out += w * t;
        }
    }
}
