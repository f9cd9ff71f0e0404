//! Interpolation by a kernel along each axis: sharper than bilinear, and like it a filter of a place,
//! not of an area.

use crate::Wrap;
use crate::kernel::{THIRD, cubic, lanczos};
use crate::level::Level;
use crate::math::floor;
use crate::texel::color;

/// A kernel for interpolation between texels, applied along columns and then along rows.
///
/// Each channel may overshoot beside an edge; a sample is brought back to its range.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default)]
pub enum Separable {
    /// The cubic of Catmull and Rom (1974): through the texels, 4×4 of them. B = 0, C = ½ in
    /// Mitchell's family.
    #[default]
    CatmullRom,
    /// Mitchell and Netravali's compromise (1988), B = C = ⅓: 4×4, a little blur, faint halos.
    Mitchell,
    /// sinc under a window of its own (Duchon 1979), two lobes: 4×4, through the texels.
    Lanczos2,
    /// The same with three lobes: 6×6.
    Lanczos3,
}

impl Separable {
    /// All of them.
    pub const ALL: [Self; 4] = [Self::CatmullRom, Self::Mitchell, Self::Lanczos2, Self::Lanczos3];

    /// Texels that one sample reads.
    pub(crate) const fn texels(self) -> usize {
        match self {
            Self::Lanczos3 => 36,
            _ => 16,
        }
    }

    /// The weight at a distance.
    #[inline(always)]
    fn weight(self, r: f32) -> f32 {
        match self {
            Self::CatmullRom => cubic(r.abs(), 0.0, 0.5),
            Self::Mitchell => cubic(r.abs(), THIRD, THIRD),
            Self::Lanczos2 => lanczos::TWO.weight(r * r),
            Self::Lanczos3 => lanczos::THREE.weight(r * r),
        }
    }

    /// The weights of `N` texels about a place `fraction` beyond the middle pair's first; their sum
    /// is 1.
    #[inline(always)]
    fn weights<const N: usize>(self, fraction: f32) -> [f32; N] {
        let first = 1.0 - (N / 2) as f32;
        let raw: [f32; N] = core::array::from_fn(|i| self.weight(first + i as f32 - fraction));
        let sum: f32 = raw.iter().sum();
        raw.map(|w| w / sum)
    }

    /// The value at (u, v), in texels of this level.
    #[inline(always)]
    pub(crate) fn sample(self, level: &Level, wrap: Wrap, u: f64, v: f64) -> [f32; 4] {
        match self {
            Self::Lanczos3 => self.average::<6>(level, wrap, u, v),
            _ => self.average::<4>(level, wrap, u, v),
        }
    }

    #[inline(always)]
    fn average<const N: usize>(self, level: &Level, wrap: Wrap, u: f64, v: f64) -> [f32; 4] {
        let (x, y) = (u - 0.5, v - 0.5);
        let (x0, y0) = (floor(x), floor(y));
        let columns: [f32; N] = self.weights((x - x0) as f32);
        let rows: [f32; N] = self.weights((y - y0) as f32);
        let (x0, y0) = (x0 as i32, y0 as i32);
        let first = 1 - (N / 2) as i32;
        let texels = square::<N>(level, wrap, x0.wrapping_add(first), y0.wrapping_add(first));
        // About a texel, so that a constant stays what it is.
        let centre = texels[N / 2 - 1][N / 2 - 1];
        let centres = [centre; N];
        // Down each column first: sums of whole rows, in loops over all of their channels.
        let mut down = [[0.0; 4]; N];
        for (weight, row) in rows.iter().zip(&texels) {
            let channels = row.as_flattened().iter().zip(centres.as_flattened());
            for (sum, (texel, centre)) in down.as_flattened_mut().iter_mut().zip(channels) {
                *sum += weight * (texel - centre);
            }
        }
        let mut sum = centre;
        for (weight, column) in columns.iter().zip(&down) {
            for c in 0..4 {
                sum[c] += weight * column[c];
            }
        }
        sum
    }
}

/// `N` by `N` texels, the first at (x, y); they may lie outside.
#[inline(always)]
fn square<const N: usize>(level: &Level, wrap: Wrap, x: i32, y: i32) -> [[[f32; 4]; N]; N] {
    // Places are brought near, so that this fits.
    let last = N as i32 - 1;
    if level.holds([x, y], [x + last, y + last]) {
        let first = level.index(x, y);
        let row = |j: usize| level.texels.get(first + j * level.stride..)?.first_chunk::<N>();
        if let (Some(_), Some(_)) = (row(0), row(N - 1)) {
            return core::array::from_fn(|j| row(j).map_or([[0.0; 4]; N], |t| t.map(color)));
        }
    }
    square_across(level, wrap, x, y)
}

/// The same, one by one.
#[cold]
#[inline(never)]
fn square_across<const N: usize>(level: &Level, wrap: Wrap, x: i32, y: i32) -> [[[f32; 4]; N]; N] {
    let texel =
        |i: usize, j: usize| level.texel(x.wrapping_add(i as i32), y.wrapping_add(j as i32), wrap);
    core::array::from_fn(|j| core::array::from_fn(|i| texel(i, j)))
}
