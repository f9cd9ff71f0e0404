use scumble_coverage::SamplePattern;
use scumble_geometry::IntRect;
use scumble_pixel::{Straight, WorkingSpace};
use scumble_texture::Sampler;

/// Where textures and interpolated colours are evaluated.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default)]
pub enum Shading {
    /// Once a pixel, at its centre, over the pixel's whole footprint; the samples decide coverage
    /// alone. This is multisampling, and costs little more than one sample.
    #[default]
    Pixel,
    /// Once a sample, at its position, over the sample's share of the pixel (a footprint √n times
    /// narrower each way). This is supersampling, and costs as much as it sounds.
    Sample,
}

/// How edges are made smooth.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default)]
pub enum Antialias {
    /// By samples: every one belongs to what is drawn last over it, so neighbours meet without a
    /// seam and nothing shines through that is covered.
    #[default]
    Samples,
    /// Every primitive for itself, by the exact area of each pixel that it covers: 256 levels of
    /// grey at the price of one sample, right for whatever overlaps nothing else, as most drawings
    /// and all text do. Where two primitives share an edge, what lies under them shines through:
    /// of each, half covers half of the pixel, and that leaves a quarter. [`Settings::pattern`] and
    /// [`Settings::shading`] have no meaning then.
    Area,
}

/// How attributes vary between the corners of a triangle or a quad.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default)]
pub enum Interpolation {
    /// As the plane that they lie on projects: right.
    #[default]
    Perspective,
    /// Linearly on the screen, each triangle for itself: wrong under perspective, and instructive.
    /// Where a corner lies behind the eye there is no such thing, and perspective is used.
    Affine,
}

/// What lies under the picture.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub enum Background {
    /// What the scene says; transparent if it says nothing.
    #[default]
    Scene,
    /// Nothing.
    Transparent,
    /// One colour.
    Color(Straight),
}

/// How to render.
#[derive(Debug, Clone)]
pub struct Settings {
    /// Columns of the canvas that the scene is placed on.
    pub width: u32,
    /// Rows of the canvas.
    pub height: u32,
    /// The part of the canvas to render, in its pixels; `None` is all of it. The bytes are those
    /// of that part of the whole.
    pub crop: Option<IntRect>,
    /// How edges are made smooth.
    pub antialias: Antialias,
    /// Where coverage is sampled.
    pub pattern: SamplePattern,
    /// Where colour is sampled.
    pub shading: Shading,
    /// How textures are filtered.
    pub sampler: Sampler,
    /// The space in which everything is averaged.
    pub space: WorkingSpace,
    /// What lies under everything.
    pub background: Background,
    /// How attributes vary under perspective.
    pub interpolation: Interpolation,
    /// How many threads to use; 0 is one for each processor. Without the feature `parallel`, one.
    pub threads: usize,
    /// Side of a tile in pixels, 8 to 256. It changes the time and the memory, never a byte. (Drawings of
    /// intricate outlines by area are cut into tiles sixteen times as wide and half as high.)
    pub tile_size: u32,
    /// The most bytes that textures, geometry and buffers together may take.
    pub max_memory: u64,
}

/// A tile of 64×64 pixels and its samples fit a second-level cache, and there are enough of them
/// to keep many threads busy. Smaller tiles repeat set-up, larger ones balance badly.
pub const DEFAULT_TILE_SIZE: u32 = 64;

/// What edges need to look smooth at reading distance; more is for masters.
pub const DEFAULT_SAMPLES: usize = 16;

/// Enough for a hundred-megapixel texture with its pyramid, little enough for a laptop.
pub const DEFAULT_MAX_MEMORY: u64 = 4 << 30;

impl Settings {
    /// The defaults for a canvas of the given size: 16 samples in the standard pattern, shading
    /// per pixel, EWA, sRGB, the scene's background, all processors.
    #[must_use]
    pub fn new(width: u32, height: u32) -> Self {
        Self {
            width,
            height,
            crop: None,
            antialias: Antialias::default(),
            pattern: SamplePattern::standard(DEFAULT_SAMPLES).unwrap_or_default(),
            shading: Shading::default(),
            sampler: Sampler::default(),
            space: WorkingSpace::default(),
            background: Background::default(),
            interpolation: Interpolation::default(),
            threads: 0,
            tile_size: DEFAULT_TILE_SIZE,
            max_memory: DEFAULT_MAX_MEMORY,
        }
    }

    /// Samples that are stored for each pixel.
    pub(crate) fn samples(&self) -> u32 {
        match self.antialias {
            Antialias::Samples => self.pattern.len() as u32,
            Antialias::Area => 1,
        }
    }

    /// Whether colours that vary are evaluated sample by sample.
    pub(crate) fn per_sample(&self) -> bool {
        self.shading == Shading::Sample && self.samples() > 1
    }
}
