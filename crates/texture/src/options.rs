use crate::{Outline, Wrap};
use scumble_geometry::IntRect;
use scumble_pixel::WorkingSpace;

/// The filter that makes each level of a pyramid from the finer one.
///
/// Both keep the mean of the image. On sizes that are not even the filter is stretched to the exact
/// ratio of the two sizes and every output texel gets taps of its own (a polyphase filter); no row
/// is dropped.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default)]
pub enum Decimation {
    /// An 8-tap half-band sinc under a Kaiser window, β = 4: sharp, with little aliasing.
    #[default]
    Kaiser,
    /// The mean of the texels that an output texel covers: 2×2 on even sizes. Cheaper, softer and
    /// more aliased.
    Box,
}

impl Decimation {
    /// The variance that one step adds, in squared texels of the finer level: what the elliptical
    /// filter subtracts from its own.
    ///
    /// For the box it is the second moment of its taps, ¼. For Kaiser the second moment is −0.096,
    /// which says only how the filter bends at zero frequency; over the pass band it acts as a
    /// filter of no width, and 0 measures best.
    pub(crate) fn variance(self) -> f64 {
        match self {
            Self::Kaiser => 0.0,
            Self::Box => 0.25,
        }
    }
}

/// Which levels of the pyramid are built.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default)]
pub enum Levels {
    /// All, down to 1×1: a third more memory than the base.
    #[default]
    All,
    /// The image alone. Minification then costs texels and is bounded by a budget.
    BaseOnly,
    /// From one level to another, both included, for a texture that is always seen at about the same
    /// size: a thumbnail's source needs no level as large as itself. What lies outside the pyramid
    /// is brought back to it.
    ///
    /// Where the footprint asks for a finer level the first is magnified, and for a coarser one the
    /// last costs more texels, up to a budget. Positions and Jacobians stay in texels of the image.
    /// The finer levels are not kept, and not made either but for some rows at a time.
    Range {
        /// The finest level to keep; 0 is the image.
        first: usize,
        /// The coarsest.
        last: usize,
    },
}

/// What texels are stored as.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default)]
pub enum Storage {
    /// [`Storage::Compact`] for images of bytes, [`Storage::Float`] for all others: 16-bit codes are
    /// four times finer than its steps, and floats may be brighter than 1.
    #[default]
    Auto,
    /// Numbers of 16 bits in steps of 1/16,320, sixty-four to a code of eight bits: 8 bytes a texel.
    /// Rounding to a step is noise at −95 dB. Images are cut to 0…1 as they are stored, and samples lie
    /// in 0…alpha. All the fast loops are for this. Where all texels of level 0 are codes, it keeps these:
    /// 4 bytes a texel, with the same results. That is so of images of bytes that are opaque or premultiplied,
    /// in the space that they come in, with nothing beyond them that is no code; of rows that come one by one
    /// it must be known beforehand, from a format without alpha.
    Compact,
    /// Floats: 16 bytes a texel. Nothing is rounded and colours are not cut, below 0 and above alpha
    /// neither in the texture nor in its samples, so a sharp pyramid's few hundredths of overshoot show
    /// in them; only alpha is in 0…1, a NaN is 0, and magnitudes end at 10³⁰. The elliptical filter takes
    /// two to three times as long.
    Float,
}

impl Storage {
    /// Whether texels are floats, of an image of bytes or of another.
    pub(crate) fn is_float(self, bytes: bool) -> bool {
        match self {
            Self::Auto => !bytes,
            Self::Compact => false,
            Self::Float => true,
        }
    }
}

/// How a texture is made of an image.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct TextureOptions {
    /// The space in which texels are averaged, in the pyramid and by every filter.
    pub space: WorkingSpace,
    /// What lies beyond the edge.
    pub wrap: Wrap,
    /// The filter between levels.
    pub decimation: Decimation,
    /// The levels to build.
    pub levels: Levels,
    /// What texels are stored as.
    pub storage: Storage,
    /// The part of the image, in its texels, that samples will read; `None` for all of it.
    ///
    /// Of each level only what lies under the window is kept, and eight texels of that level around
    /// it; only what that is made of is converted. A coarse level, of which a few texels are the whole
    /// image, is made of the whole image: a window saves most with [`Levels::BaseOnly`] or
    /// [`Levels::Range`].
    ///
    /// That nothing else is read is the caller's promise: [`Sampler::reach`](crate::Sampler::reach)
    /// says how far a footprint reads around its centre. Samples whose ellipses lie in the window are
    /// those of the whole texture, bit for bit. Others take the nearest texel that is kept for those
    /// that are not; nothing worse comes of it. Beyond the edges of the image [`Wrap`] goes on as ever,
    /// so where it repeats or mirrors the window must hold what is read there. What lies outside the
    /// image is taken off the window, and of a window without a texel one is kept.
    pub window: Option<IntRect>,
    /// What samples read of the finest levels, from level 0 on, where that is less than the window: a
    /// plane to its horizon is read in level 0 only where it is near. With the same promise, which
    /// counts for more here: what lies outside of an outline may never be stored, and then has no
    /// meaning, nor has the mean that stands for footprints without a place or an end. Where texels
    /// repeat, only the bounds of outlines count.
    pub outlines: [Option<Outline>; OUTLINES],
}

/// How many levels can have an outline. All others together are 1/48 of the memory, and coarser ones may
/// be made of the last that is kept.
const OUTLINES: usize = 3;

impl TextureOptions {
    /// The outline of what is read of a level, if it has one.
    pub(crate) fn outline(&self, level: usize) -> Option<&Outline> {
        self.outlines.get(level)?.as_ref()
    }
}
