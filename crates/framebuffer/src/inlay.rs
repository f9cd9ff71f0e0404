use crate::Palette;
use crate::level::Best;
use crate::stretch;
use alloc::vec::Vec;
use scumble_pixel::Premul;

/// A tile of one value a pixel that is painted over in colours of a [`Palette`], most pixels by one
/// opaque colour whole: such a one holds the number of the colour, a quarter of its size. Where a
/// colour covers a part of a pixel, or something shines through, the pixel holds the sum.
///
/// The pixels are those of a [`Tile`](crate::Tile) that the same is painted on, to the bit. All calls
/// between two resets are to come with one palette.
///
/// ```
/// use scumble_framebuffer::{Inlay, Palette};
/// use scumble_pixel::WorkingSpace;
///
/// let space = WorkingSpace::Srgb;
/// let mut palette = Palette::new(space);
/// palette.extend([space.import([255, 255, 255, 255]), space.import([255, 0, 0, 255])]);
/// let mut tile = Inlay::new();
/// tile.reset(4, 1, 0);
/// tile.fill(0, 0, 2, 1, 1, &palette);
/// tile.blend_areas(2, 0, &[0.5], 1, &palette);
/// let mut codes = [[0; 4]; 4];
/// tile.encode_row(0, &palette, &mut codes);
/// assert_eq!(codes[1..], [[255, 0, 0, 255], [255, 128, 128, 255], [255; 4]]);
/// ```
#[derive(Debug, Clone, Default)]
pub struct Inlay {
    width: usize,
    height: usize,
    /// Per pixel: the number of its colour, or [`SUM`].
    keys: Vec<u32>,
    /// Per pixel: its colour, if the key is [`SUM`]; else any.
    sums: Vec<Premul>,
    level: Best,
}

/// Stands in place of a number where a pixel is of none of the palette's colours.
pub(crate) const SUM: u32 = u32::MAX;

/// Pixels that are encoded together.
const TOGETHER: usize = 16;

/// What pixels hold before there is a sum: something opaque, since that is quickest to encode.
const ANY: Premul = Premul([0.0, 0.0, 0.0, 1.0]);

impl Inlay {
    /// The largest key.
    pub const MAX_KEY: u32 = SUM - 1;

    /// A tile of no pixels; [`reset`](Self::reset) gives it a shape.
    #[must_use]
    pub fn new() -> Self {
        Self::default()
    }

    /// Makes this a tile of `width` × `height` pixels, each at most
    /// [`Tile::MAX_SIDE`](crate::Tile::MAX_SIDE), all of the colour `key`. Allocations are kept.
    pub fn reset(&mut self, width: u32, height: u32, key: u32) {
        let side = |v: u32| v.min(crate::Tile::MAX_SIDE) as usize;
        (self.width, self.height) = (side(width), side(height));
        let len = self.width * self.height;
        self.keys.clear();
        self.keys.resize(len, key.min(Self::MAX_KEY));
        if self.sums.len() < len {
            self.sums.resize(len, ANY);
        }
    }

    /// The most bytes that a tile of this shape takes, which is brought into range as by
    /// [`reset`](Self::reset).
    #[must_use]
    pub fn max_bytes(width: u32, height: u32) -> u64 {
        let side = |v: u32| u64::from(v.min(crate::Tile::MAX_SIDE));
        side(width) * side(height) * (size_of::<u32>() + size_of::<Premul>()) as u64
    }

    /// Paints `w` × `h` pixels from (`x`, `y`) on with the colour `key`.
    pub fn fill(&mut self, x: u32, y: u32, w: u32, h: u32, key: u32, palette: &Palette) {
        let color = palette.color(key);
        for row in y..y.saturating_add(h).min(self.height as u32) {
            let span = self.span(x, row, w as usize);
            if color.alpha() == 1.0 {
                stretch::fill_keys(&mut self.keys[span], key.min(Self::MAX_KEY));
            } else {
                self.blend(span, color, palette);
            }
        }
    }

    /// Paints one part, 0 to 1, of each of `len` pixels from (`x`, `y`) to the right with the colour
    /// `key`.
    pub fn blend_area(
        &mut self,
        (x, y): (u32, u32),
        len: u32,
        area: f32,
        key: u32,
        palette: &Palette,
    ) {
        let span = self.span(x, y, len as usize);
        self.blend(span, palette.color(key).scaled(area), palette);
    }

    /// Paints parts, 0 to 1, of the pixels from (`x`, `y`) to the right with the colour `key`.
    pub fn blend_areas(&mut self, x: u32, y: u32, areas: &[f32], key: u32, palette: &Palette) {
        let span = self.span(x, y, areas.len());
        let pixels = (&mut self.keys[span.clone()], &mut self.sums[span]);
        stretch::inlay_parts(self.level, pixels, areas, palette.color(key), palette);
    }

    /// The pixels of a row, encoded to straight 8-bit sRGB; as many as both `out` and the row have.
    pub fn encode_row(&self, y: u32, palette: &Palette, out: &mut [[u8; 4]]) {
        #[cfg(feature = "std")]
        fearless_simd::dispatch!(self.level.0, _simd => self.encode_row_by(y, palette, out));
        #[cfg(not(feature = "std"))]
        self.encode_row_by(y, palette, out);
    }

    // Inlined, so that it runs on the instructions of its caller.
    #[inline(always)]
    fn encode_row_by(&self, y: u32, palette: &Palette, out: &mut [[u8; 4]]) {
        let span = self.span(0, y, out.len());
        let (keys, sums) = (&self.keys[span.clone()], &self.sums[span.clone()]);
        let (keys, rest_keys) = keys.as_chunks::<TOGETHER>();
        let (sums, rest_sums) = sums.as_chunks::<TOGETHER>();
        let (out, rest_out) = out[..span.len()].as_chunks_mut::<TOGETHER>();
        for ((keys, sums), out) in keys.iter().zip(sums).zip(out) {
            let differ = keys.iter().fold(0, |differ, key| differ | (key ^ keys[0]));
            if differ == 0 && keys[0] != SUM {
                *out = [palette.code(keys[0]); TOGETHER];
            } else {
                encode(keys, sums, palette, out);
            }
        }
        encode(rest_keys, rest_sums, palette, rest_out);
    }

    /// `color` over some pixels.
    fn blend(&mut self, span: core::ops::Range<usize>, color: Premul, palette: &Palette) {
        for (key, sum) in self.keys[span.clone()].iter_mut().zip(&mut self.sums[span]) {
            let below = if *key == SUM { *sum } else { palette.color(*key) };
            (*key, *sum) = (SUM, color.over(below));
        }
    }

    /// The indices of up to `len` pixels from (`x`, `y`) to the right.
    fn span(&self, x: u32, y: u32, len: usize) -> core::ops::Range<usize> {
        let (x, y) = (x as usize, y as usize);
        if x >= self.width || y >= self.height {
            return 0..0;
        }
        let start = y * self.width + x;
        start..start + len.min(self.width - x)
    }
}

/// Up to [`TOGETHER`] pixels.
#[inline(always)]
fn encode(keys: &[u32], sums: &[Premul], palette: &Palette, out: &mut [[u8; 4]]) {
    let mut codes = [[0; 4]; TOGETHER];
    // All of them, sums or not: that is done in vectors, and choosing is not.
    palette.space().export_row(sums, &mut codes);
    for ((key, code), out) in keys.iter().zip(codes).zip(out) {
        *out = if *key == SUM { code } else { palette.code(*key) };
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Tile, encode_row};
    use alloc::{vec, vec::Vec};
    use proptest::prelude::*;
    use scumble_pixel::WorkingSpace;

    #[derive(Debug, Clone)]
    enum Op {
        Fill(u32, u32, u32, u32, u32),
        Area(u32, u32, u32, f32, u32),
        Areas(u32, u32, Vec<f32>, u32),
    }

    fn op() -> impl Strategy<Value = Op> {
        let area = || prop_oneof![Just(0.0_f32), Just(1.0), 0.0..=1.0_f32];
        let (x, y, key) = (0..50_u32, 0..5_u32, 0..6_u32);
        prop_oneof![
            (x.clone(), y.clone(), 0..60_u32, 0..6_u32, key.clone())
                .prop_map(|(x, y, w, h, key)| Op::Fill(x, y, w, h, key)),
            (x.clone(), y.clone(), 0..60_u32, area(), key.clone())
                .prop_map(|(x, y, len, area, key)| Op::Area(x, y, len, area, key)),
            (x, y, prop::collection::vec(area(), 0..50), key)
                .prop_map(|(x, y, areas, key)| Op::Areas(x, y, areas, key)),
        ]
    }

    proptest! {
        #[test]
        fn it_is_a_tile_of_colours(
            runs in prop::collection::vec(
                (1..50_u32, 1..5_u32, prop::collection::vec(op(), 0..30)), 1..3),
            colors in prop::array::uniform5((prop::array::uniform3(0.0..=1.0_f32), 0..3_u8)),
        ) {
            for space in [WorkingSpace::Srgb, WorkingSpace::Linear] {
                let colors = colors.map(|([r, g, b], opacity)| {
                    let alpha = [1.0, 1.0, 0.4][usize::from(opacity)];
                    Premul([r * alpha, g * alpha, b * alpha, alpha])
                });
                let mut palette = Palette::new(space);
                palette.extend(colors);
                // Beyond the palette there is no colour.
                let color = |key: u32| colors.get(key as usize).copied().unwrap_or(Premul::TRANSPARENT);
                let mut inlay = Inlay::new();
                for (width, height, ops) in &runs {
                    inlay.reset(*width, *height, 0);
                    let mut tile = Tile::new();
                    tile.reset(*width, *height, 1, color(0));
                    for op in ops {
                        match *op {
                            Op::Fill(x, y, w, h, key) => {
                                inlay.fill(x, y, w, h, key, &palette);
                                tile.fill_block(x, y, w, h, color(key));
                            }
                            Op::Area(x, y, len, area, key) => {
                                inlay.blend_area((x, y), len, area, key, &palette);
                                tile.fill_block(x, y, len, 1, color(key).scaled(area));
                            }
                            Op::Areas(x, y, ref areas, key) => {
                                inlay.blend_areas(x, y, areas, key, &palette);
                                tile.blend_areas(x, y, areas, color(key));
                            }
                        }
                    }
                    for y in 0..*height {
                        let mut pixels = vec![Premul::TRANSPARENT; *width as usize];
                        tile.resolve_row(y, &mut pixels);
                        let (mut codes, mut expected) = (vec![[9; 4]; 60], vec![[9; 4]; 60]);
                        encode_row(&pixels, space, &mut expected);
                        inlay.encode_row(y, &palette, &mut codes);
                        prop_assert_eq!(codes, expected);
                    }
                }
            }
        }
    }
}
