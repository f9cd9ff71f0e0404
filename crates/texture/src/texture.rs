use crate::batch;
use crate::decode::Decoder;
use crate::engine::{Engine, Scalar, Vector};
use crate::ewa::{self, Limits};
use crate::format::{Alpha, Channels, Texels};
use crate::level::{LARGEST, Level, texels_kept};
use crate::point::{self, Bilinear, Nearest};
use crate::points::Points;
use crate::pyramid;
use crate::pyramid::plan::{self, Plan};
use crate::run::{InRow, Listed, Run};
use crate::store::{self, Store};
use crate::texel::{self, Cell, Texel};
use crate::wrap::Nearer;
use crate::{
    Footprint, LevelMode, PixelFilter, Sampler, Simd, TextureError, TextureOptions, Wrap, extra,
    lod,
};
use alloc::vec::Vec;
use fearless_simd::dispatch;
use scumble_geometry::{DVec2, Homography, IntRect, Matrix2};
use scumble_pixel::{Image, ImageView, Premul, WorkingSpace};

/// An image made ready to be filtered: its pyramid, premultiplied, in the working space.
///
/// Texels take 8 bytes each (four numbers of 16 bits, in steps of 1/16,320), 4 in a level 0 of opaque
/// bytes, or 16 as floats ([`Storage`](crate::Storage)); each level has eight more on every side, for what
/// lies beyond its edge, and all levels together take a third more than the base:
/// [`Texture::memory_for`] says it before anything is allocated.
#[derive(Debug, Clone)]
pub struct Texture {
    /// Those that are kept.
    pub(crate) levels: Vec<Level>,
    /// Columns and rows of the image.
    size: [usize; 2],
    /// Which level of the pyramid is the first that is kept.
    pub(crate) first: usize,
    pub(crate) wrap: Wrap,
    space: WorkingSpace,
    average: [f32; 4],
    /// Whether all colours of the image are in 0…alpha, and so are samples.
    pub(crate) bounded: bool,
    pub(crate) nearer: [Nearer; 2],
    pub(crate) simd: Simd,
}

impl Texture {
    /// A texture from straight-alpha, sRGB-encoded RGBA8.
    ///
    /// [`Texture::from_texels`] takes other formats, and [`TextureBuilder`](crate::TextureBuilder) rows
    /// as they are decoded.
    ///
    /// # Errors
    /// [`TextureError::Empty`] for an image without a pixel; [`TextureError::TooLarge`] and
    /// [`TextureError::OutOfMemory`] if the texels do not fit.
    pub fn new(
        image: ImageView<'_, [u8; 4]>,
        options: &TextureOptions,
    ) -> Result<Self, TextureError> {
        Self::make(&Texels::straight(image), options, Vec::new())
    }

    /// The texture of another image, like [`Texture::new`], in the memory of this one where its levels
    /// have the same sizes: for the frames of a film. Fresh memory costs about as much as the pyramid.
    ///
    /// # Errors
    /// As for [`Texture::new`].
    pub fn renewed(
        self,
        image: ImageView<'_, [u8; 4]>,
        options: &TextureOptions,
    ) -> Result<Self, TextureError> {
        let simd = self.simd;
        Ok(Self::make(&Texels::straight(image), options, self.levels)?.with_simd(simd))
    }

    /// A texture from an image in any of the formats that there are.
    ///
    /// # Errors
    /// As for [`Texture::new`].
    pub fn from_texels<P: Channels, A: Alpha>(
        texels: &Texels<'_, P, A>,
        options: &TextureOptions,
    ) -> Result<Self, TextureError> {
        Self::make(texels, options, Vec::new())
    }

    fn make<P: Channels, A: Alpha>(
        texels: &Texels<'_, P, A>,
        options: &TextureOptions,
        old: Vec<Level>,
    ) -> Result<Self, TextureError> {
        let size = texels.size();
        Self::check(size, options)?;
        let pixels = size[0].saturating_mul(size[1]);
        let decoder = Decoder::new(texels.format, options.space, pixels);
        let levels = if options.storage.is_float(texels.format.is_of_bytes()) {
            pyramid::image::<[f32; 4], _, _>(texels.view, &decoder, options, false, old)?
        } else {
            let base = plan::kept_levels(size, options.levels).start == 0;
            let coded = base && decoder.has_codes(|| texels.part(options).is_opaque());
            pyramid::image::<Texel, _, _>(texels.view, &decoder, options, coded, old)?
        };
        Self::over(levels, size, options, texels.format.is_bounded())
    }

    /// A texture whose every level is one colour, red, yellow, green, cyan, blue, magenta, white and
    /// black in turn: it shows which level is read where, and a filter that reads one level over a
    /// footprint gives one colour.
    ///
    /// # Errors
    /// As for [`Texture::new`].
    pub fn colored_levels(
        width: usize,
        height: usize,
        options: &TextureOptions,
    ) -> Result<Self, TextureError> {
        let size = [width, height];
        Self::check(size, options)?;
        let levels = if options.storage.is_float(true) {
            colored::<[f32; 4]>(size, options)?
        } else {
            colored::<Texel>(size, options)?
        };
        Self::over(levels, size, options, true)
    }

    /// Whether a texture of this size can be made.
    pub(crate) fn check(size: [usize; 2], options: &TextureOptions) -> Result<(), TextureError> {
        plan::check(size)?;
        let [width, height] = size;
        match Self::memory_for(width, height, options) {
            Some(_) => Ok(()),
            None => Err(TextureError::TooLarge { width, height }),
        }
    }

    /// The texture of the levels that are kept.
    pub(crate) fn over(
        mut levels: Vec<Level>,
        size: [usize; 2],
        options: &TextureOptions,
        bounded: bool,
    ) -> Result<Self, TextureError> {
        let TextureOptions { space, wrap, .. } = *options;
        // Of all levels the coarsest has the fewest texels, and the same mean.
        let average = levels.last().ok_or(TextureError::Empty)?.mean();
        let first = plan::kept_levels(size, options.levels).start;
        for (l, level) in levels.iter_mut().enumerate() {
            level.seal(wrap, &plan::stored_rows(size, first + l, options));
        }
        let nearer = size.map(|n| Nearer::new(wrap, n));
        let simd = Simd::best();
        Ok(Self { levels, first, size, wrap, space, average, bounded, nearer, simd })
    }

    /// The same texture, sampled with other instructions and the same results.
    #[must_use]
    pub fn with_simd(self, simd: Simd) -> Self {
        Self { simd, ..self }
    }

    /// Columns of the image, level 0.
    #[must_use]
    pub fn width(&self) -> usize {
        self.size[0]
    }

    /// Rows of the image, level 0.
    #[must_use]
    pub fn height(&self) -> usize {
        self.size[1]
    }

    /// The space that the texels are in, and the samples.
    #[must_use]
    pub fn space(&self) -> WorkingSpace {
        self.space
    }

    /// Levels that are kept, the image itself included if it is; at least 1.
    #[must_use]
    pub fn level_count(&self) -> usize {
        self.levels.len()
    }

    /// A copy of the texels of a level, premultiplied RGBA in the working space, counted from the first
    /// that is kept; `None` beyond the last. Of a texture with a window, those that are kept
    /// ([`Texture::level_window`]).
    ///
    /// Of the whole pyramid level l is ⌊width/2ˡ⌋ × ⌊height/2ˡ⌋ and at least 1×1. Kaiser levels may
    /// overshoot 0…1 by a few hundredths at sharp edges, as any sharp filter does; samples never do.
    #[must_use]
    pub fn level(&self, index: usize) -> Option<Image<[f32; 4]>> {
        let level = self.levels.get(index)?;
        Some(match &level.texels {
            Store::Floats(texels) => level.view(texels)?.to_image(),
            Store::Steps(texels) => level.view(texels)?.to_image().map(|t| texel::color(*t)),
            Store::Codes(texels) => {
                level.view(texels)?.to_image().map(|t| texel::color(store::of_code(*t)))
            }
        })
    }

    /// The texels of a level that are kept, in texels of that level: all unless
    /// [`TextureOptions::window`] says otherwise. Levels count as in [`Texture::level`].
    #[must_use]
    pub fn level_window(&self, index: usize) -> Option<IntRect> {
        let [columns, rows] = self.levels.get(index)?.part;
        // Sides are below 2²⁹.
        let [x0, x1, y0, y1] = [columns.start, columns.end, rows.start, rows.end].map(|i| i as i32);
        Some(IntRect::new(x0, y0, x1, y1))
    }

    /// Bytes of texels that this texture holds.
    #[must_use]
    pub fn memory(&self) -> usize {
        self.levels.iter().map(|level| level.texels.bytes()).sum()
    }

    /// Bytes of texels that a texture of this size will hold at most; `None` if that overflows or a
    /// side is above 2²⁹. With [`Storage::Auto`](crate::Storage::Auto) those of an image of bytes. It will hold
    /// fewer only where level 0 is kept in codes ([`Storage::Compact`](crate::Storage::Compact)).
    #[must_use]
    pub fn memory_for(width: usize, height: usize, options: &TextureOptions) -> Option<usize> {
        if width.max(height) > LARGEST {
            return None;
        }
        let mut bytes = 0usize;
        if width.min(height) == 0 {
            return Some(0);
        }
        let levels = plan::kept_levels([width, height], options.levels);
        let float = options.storage.is_float(true);
        let texel = if float { size_of::<[f32; 4]>() } else { size_of::<Texel>() };
        for l in levels.start..levels.end {
            let texels = texels_kept(plan::kept_part([width, height], l, options))?;
            bytes = bytes.checked_add(texels.checked_mul(texel)?)?;
        }
        isize::try_from(bytes).ok().map(isize::unsigned_abs)
    }

    /// The colour of a footprint: premultiplied, in the working space, alpha in 0…1 and each channel in
    /// 0…alpha, if it was in the image: of one in floats that are stored as such
    /// ([`Storage::Float`](crate::Storage::Float)) colours are not cut.
    ///
    /// Finite for every footprint. A centre that is not finite gives the mean of the texture; so
    /// does a Jacobian that is not, or that has a component beyond 2³⁰, where the filter needs it.
    #[must_use]
    pub fn sample(&self, f: &Footprint, s: &Sampler) -> Premul {
        let mut out = [Premul::TRANSPARENT];
        self.dispatch(Listed(core::slice::from_ref(f)), s, &mut out);
        let [color] = out;
        color
    }

    /// The colours of a run of pixels: `out[i]` is what [`Texture::sample`] gives for
    /// [`Footprint::at`]`(map, start + (i, 0))`, to the last bit.
    ///
    /// `map` goes from the screen to texels of level 0. The Jacobian is exact at each sample.
    pub fn sample_row(&self, map: &Homography, start: DVec2, s: &Sampler, out: &mut [Premul]) {
        self.dispatch(InRow { map, start }, s, out);
    }

    /// The colours of a run of footprints: `out[i]` is what [`Texture::sample`] gives for
    /// `footprints[i]`, to the last bit. The shorter slice ends it.
    pub fn sample_footprints(&self, footprints: &[Footprint], s: &Sampler, out: &mut [Premul]) {
        let count = footprints.len().min(out.len());
        self.dispatch(Listed(footprints), s, &mut out[..count]);
    }

    /// Samples a run of footprints: by the fast paths, or by what is beside them.
    #[inline(always)]
    fn dispatch(&self, run: impl Run, s: &Sampler, out: &mut [Premul]) {
        if extra::takes(s) {
            return extra::fill(self, run, s, out);
        }
        self.fill_fast(run, s, out);
    }

    /// Runs [`Texture::fill`] compiled for the chosen instructions.
    pub(crate) fn fill_fast(&self, run: impl Run, s: &Sampler, out: &mut [Premul]) {
        match self.simd.0 {
            None => self.fill(Scalar, run, s, out),
            Some(level) => dispatch!(level, simd => self.fill(Vector(simd), run, s, out)),
        }
    }

    /// Samples a run of footprints.
    #[inline(always)]
    fn fill(&self, engine: impl Engine, run: impl Run, s: &Sampler, out: &mut [Premul]) {
        match s.pixel {
            PixelFilter::Nearest => return self.fill_points(engine, run, s, Nearest, out),
            PixelFilter::Bilinear => return self.fill_points(engine, run, s, Bilinear, out),
            _ => (),
        }
        let limits = Limits::new(s);
        let float = self.levels[0].is_float();
        let many = s.level == LevelMode::Auto && out.len() >= batch::WORTH && !float;
        if many && engine.ellipses(self, run, &limits, out) {
            return;
        }
        for (i, out) in out.iter_mut().enumerate() {
            let f = self.nearer(&run.at(i));
            *out = if f.is_finite() && f.is_bounded() {
                self.within_range(ewa::sample(self, engine, &f, s.level, &limits))
            } else {
                self.average()
            };
        }
    }

    /// Samples a run of footprints by a filter of a place.
    #[inline(always)]
    fn fill_points(
        &self,
        engine: impl Engine,
        run: impl Run,
        s: &Sampler,
        filter: impl Points,
        out: &mut [Premul],
    ) {
        let mode = point_mode(s);
        if out.len() >= batch::WORTH && engine.points(self, run, mode, filter, out) {
            return;
        }
        for (i, out) in out.iter_mut().enumerate() {
            *out = point::sample(self, &run.at(i), mode, filter);
        }
    }

    /// How many texels [`Texture::sample`] reads for a footprint, those of weight 0 included.
    #[must_use]
    pub fn cost(&self, f: &Footprint, s: &Sampler) -> usize {
        let f = self.nearer(f);
        if !f.is_finite() {
            return 0;
        }
        let each = match s.pixel {
            PixelFilter::Nearest => 1,
            PixelFilter::Bilinear => 4,
            _ if extra::takes(s) => return extra::cost(self, &f, s),
            _ => return self.cost_fast(&f, s),
        };
        let pick = lod::pick(&f, point_mode(s), self.range());
        let two = pick.coarser > 0.0;
        if two { 2 * each } else { each }
    }

    /// The same for the fast elliptical filter, the centre brought near.
    pub(crate) fn cost_fast(&self, f: &Footprint, s: &Sampler) -> usize {
        if f.is_bounded() { ewa::cost(self, f, s.level, &Limits::new(s)) } else { 0 }
    }

    /// The first and the last level of the pyramid that are kept.
    #[inline(always)]
    pub(crate) fn range(&self) -> [usize; 2] {
        [self.first, self.first + self.levels.len() - 1]
    }

    /// The footprint with its centre brought near, and out of the mirror if there is one.
    #[inline(always)]
    pub(crate) fn nearer(&self, f: &Footprint) -> Footprint {
        let [u, v] = &self.nearer;
        // A centre that is not finite stays so: ∞ − ∞ and 0·∞ are NaN, and NaN survives the sum.
        let lost = 0.0 * f.u + 0.0 * f.v;
        let (at_u, along_u) = u.before_mirror(u.bring(f.u));
        let (at_v, along_v) = v.before_mirror(v.bring(f.v));
        let Matrix2 { a, b, c, d } = f.jacobian;
        let jacobian = Matrix2::new(a * along_u, b * along_u, c * along_v, d * along_v);
        Footprint { u: at_u + lost, v: at_v + lost, jacobian }
    }

    /// What stands for a footprint that reaches infinitely far.
    pub(crate) fn average(&self) -> Premul {
        self.within_range(self.average)
    }

    /// A sample within what the image's colours are, without what a sharp pyramid overshoots.
    #[inline(always)]
    pub(crate) fn within_range(&self, color: [f32; 4]) -> Premul {
        if self.bounded {
            return into_range(color);
        }
        let [r, g, b, a] = color;
        Premul([r, g, b, a.clamp(0.0, 1.0)])
    }
}

/// The level mode of nearest and bilinear, which have a best of their own.
pub(crate) fn point_mode(s: &Sampler) -> LevelMode {
    match (s.level, s.pixel) {
        (LevelMode::Auto, PixelFilter::Nearest) => LevelMode::Nearest,
        (LevelMode::Auto, _) => LevelMode::Linear,
        (mode, _) => mode,
    }
}

/// The colours of [`Texture::colored_levels`].
const LEVEL_COLORS: [[f32; 3]; 8] = [
    [1.0, 0.0, 0.0],
    [1.0, 1.0, 0.0],
    [0.0, 1.0, 0.0],
    [0.0, 1.0, 1.0],
    [0.0, 0.0, 1.0],
    [1.0, 0.0, 1.0],
    [1.0, 1.0, 1.0],
    [0.0, 0.0, 0.0],
];

/// The levels of [`Texture::colored_levels`].
fn colored<T: Cell>(
    size: [usize; 2],
    options: &TextureOptions,
) -> Result<Vec<Level>, TextureError> {
    let mut levels = Plan::new(size, options).empty::<T>(options, false, Vec::new())?;
    let first = plan::kept_levels(size, options.levels).start;
    for (l, level) in levels.iter_mut().enumerate() {
        let [r, g, b] = LEVEL_COLORS[(first + l) % LEVEL_COLORS.len()];
        if let Some(memory) = T::kept(&mut level.texels) {
            memory.fill(T::of_color([r, g, b, 1.0]));
        }
    }
    Ok(levels)
}

/// Takes off what a sharp pyramid overshoots: alpha to 0…1, colour to 0…alpha.
#[inline(always)]
pub(crate) fn into_range([r, g, b, a]: [f32; 4]) -> Premul {
    // Comparisons in this form are one instruction each.
    let positive = |v: f32| if v > 0.0 { v } else { 0.0 };
    let below = |v: f32, most: f32| if v < most { v } else { most };
    let a = below(positive(a), 1.0);
    Premul([below(positive(r), a), below(positive(g), a), below(positive(b), a), a])
}
