//! Interpolation by a kernel along each axis: sharper than bilinear, and like it a filter of a place,
//! not of an area.

use crate::Wrap;
use crate::kernel::{THIRD, cubic_beyond, cubic_within, lanczos};
use crate::level::Level;
use crate::magnify::patch::{Patch, Spot, Spotted};
use crate::number::Number;

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

    /// The weights of `M` texels in a row, the pair in the middle those on either side of a place: from
    /// its distance to the first of them. Their sum is about 1.
    #[inline(always)]
    fn weights<N: Number, const M: usize>(self, fraction: N) -> [N; M] {
        let mut weights = [fraction; M];
        for (i, weight) in weights.iter_mut().enumerate() {
            let from = i as f32 - (M / 2 - 1) as f32;
            let middle = i + 1 == M / 2 || i == M / 2;
            let r = (fraction - from).abs();
            *weight = match self {
                Self::CatmullRom if middle => cubic_within(r, 0.0, 0.5),
                Self::CatmullRom => cubic_beyond(r, 0.0, 0.5),
                Self::Mitchell if middle => cubic_within(r, THIRD, THIRD),
                Self::Mitchell => cubic_beyond(r, THIRD, THIRD),
                Self::Lanczos2 => (r * r).each(|r2| lanczos::TWO.weight(r2)),
                Self::Lanczos3 => (r * r).each(|r2| lanczos::THREE.weight(r2)),
            };
        }
        weights
    }

    /// The weights of `M`×`M` texels about a place: 6 for three lobes, 4 for the others.
    #[inline(always)]
    pub(crate) fn patch<N: Number, const M: usize>(self, spot: &Spot<N>) -> Patch<N, M, M> {
        let before = spot.x.all(1.0 - (M / 2) as f32);
        Patch::product([before; 2], self.weights(spot.x), self.weights(spot.y))
    }

    /// The colour at a spot of a level.
    #[inline(always)]
    pub(crate) fn sample(self, level: &Level, wrap: Wrap, at: &Spotted) -> [f32; 4] {
        match self {
            Self::Lanczos3 => self.patch::<f32, 6>(&at.spot).average(level, wrap, at.base),
            _ => self.patch::<f32, 4>(&at.spot).average(level, wrap, at.base),
        }
    }
}
