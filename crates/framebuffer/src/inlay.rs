use crate::Palette;
use crate::level::Best;
use crate::stretch;
use alloc::vec::Vec;
use core::ops::Range;
use scumble_pixel::{Premul, WorkingSpace};

/// A tile of one value a pixel that is painted over in colours of a [`Palette`], most pixels by one
/// opaque colour whole. A pixel holds the place of its colour in a list, a quarter of its size: of one
/// of the palette's, or, where a colour covers a part of it or something shines through, of one of its
/// own, a sum. Sums lie beside each other, however far apart their pixels are.
///
/// The pixels are those of a [`Tile`](crate::Tile) that the same is painted on, to the bit.
///
/// ```
/// use scumble_framebuffer::{Inlay, Palette};
/// use scumble_pixel::WorkingSpace;
///
/// let space = WorkingSpace::Srgb;
/// let mut palette = Palette::new(space);
/// palette.extend([space.import([255, 255, 255, 255]), space.import([255, 0, 0, 255])]);
/// let mut tile = Inlay::new();
/// tile.reset(4, 1, 0, &palette);
/// tile.fill(0, 0, 2, 1, 1);
/// tile.blend_areas(2, 0, &[0.5], 1);
/// let mut codes = [[0; 4]; 4];
/// tile.encode_row(0, &mut codes);
/// assert_eq!(codes[1..], [[255, 0, 0, 255], [255, 128, 128, 255], [255; 4]]);
/// ```
#[derive(Debug, Clone, Default)]
pub struct Inlay {
    width: usize,
    height: usize,
    /// Per pixel: the place of its colour.
    keys: Vec<u32>,
    colors: Colors,
    /// The encodings of colours: of the palette's, and of the sums if they are `encoded`.
    codes: Vec<[u8; 4]>,
    encoded: bool,
    space: WorkingSpace,
    level: Best,
}

/// The colours of a palette, and sums.
#[derive(Debug, Clone, Default)]
pub(crate) struct Colors {
    /// Those of the palette, the sums, and room for more.
    pub(crate) list: Vec<Premul>,
    /// Where sums begin, and where they end.
    pub(crate) first_sum: usize,
    pub(crate) end: usize,
}

/// Pixels that are encoded together.
const TOGETHER: usize = 16;

/// As many sums a pixel are kept, those among them that have been painted over, until they are sorted
/// out.
const SUMS_PER_PIXEL: usize = 2;

impl Inlay {
    /// A tile of no pixels; [`reset`](Self::reset) gives it a shape.
    #[must_use]
    pub fn new() -> Self {
        Self::default()
    }

    /// Makes this a tile of `width` × `height` pixels, each at most
    /// [`Tile::MAX_SIDE`](crate::Tile::MAX_SIDE), all of the colour `key` of a palette, which is that of
    /// all keys up to the next reset. Allocations are kept.
    pub fn reset(&mut self, width: u32, height: u32, key: u32, palette: &Palette) {
        let side = |v: u32| v.min(crate::Tile::MAX_SIDE) as usize;
        (self.width, self.height) = (side(width), side(height));
        self.space = palette.space();
        self.colors.start(palette.colors());
        self.codes.clear();
        self.codes.extend_from_slice(palette.codes());
        self.encoded = true;
        self.keys.clear();
        self.keys.resize(self.width * self.height, self.colors.of_palette(key).0);
    }

    /// The most bytes that a tile of this shape takes, which is brought into range as by
    /// [`reset`](Self::reset); but for the palette.
    #[must_use]
    pub fn max_bytes(width: u32, height: u32) -> u64 {
        let side = |v: u32| u64::from(v.min(crate::Tile::MAX_SIDE));
        let sum = size_of::<Premul>() + size_of::<[u8; 4]>();
        // Once more while they are sorted out.
        let pixel = size_of::<u32>() + SUMS_PER_PIXEL * sum + size_of::<Premul>();
        side(width) * side(height) * pixel as u64
    }

    /// Paints `w` × `h` pixels from (`x`, `y`) on with the colour `key`.
    pub fn fill(&mut self, x: u32, y: u32, w: u32, h: u32, key: u32) {
        let (key, color) = self.colors.of_palette(key);
        for row in y..y.saturating_add(h).min(self.height as u32) {
            let span = self.span(x, row, w as usize);
            if color.alpha() == 1.0 {
                stretch::fill_keys(&mut self.keys[span], key);
            } else {
                self.blend(span, color);
            }
        }
    }

    /// Paints one part, 0 to 1, of each of `len` pixels from (`x`, `y`) to the right with the colour
    /// `key`.
    pub fn blend_area(&mut self, (x, y): (u32, u32), len: u32, area: f32, key: u32) {
        let (_, color) = self.colors.of_palette(key);
        self.blend(self.span(x, y, len as usize), color.scaled(area));
    }

    /// Paints parts, 0 to 1, of the pixels from (`x`, `y`) to the right with the colour `key`.
    pub fn blend_areas(&mut self, x: u32, y: u32, areas: &[f32], key: u32) {
        let (_, color) = self.colors.of_palette(key);
        let span = self.span(x, y, areas.len());
        self.make_room(span.len());
        stretch::inlay_parts(self.level, &mut self.keys[span], &mut self.colors, areas, color);
    }

    /// The pixels of a row, encoded to straight 8-bit sRGB; as many as both `out` and the row have.
    pub fn encode_row(&mut self, y: u32, out: &mut [[u8; 4]]) {
        #[cfg(feature = "std")]
        fearless_simd::dispatch!(self.level.0, _simd => self.encode_row_by(y, out));
        #[cfg(not(feature = "std"))]
        self.encode_row_by(y, out);
    }

    // Inlined, so that it runs on the instructions of its caller.
    #[inline(always)]
    fn encode_row_by(&mut self, y: u32, out: &mut [[u8; 4]]) {
        if !self.encoded {
            let Colors { list, first_sum, end } = &self.colors;
            self.codes.resize(*end, [0; 4]);
            self.space.export_row(&list[*first_sum..*end], &mut self.codes[*first_sum..]);
            self.encoded = true;
        }
        let span = self.span(0, y, out.len());
        let (keys, rest_keys) = self.keys[span.clone()].as_chunks::<TOGETHER>();
        let (out, rest_out) = out[..span.len()].as_chunks_mut::<TOGETHER>();
        for (keys, out) in keys.iter().zip(out) {
            let differ = keys.iter().fold(0, |differ, key| differ | (key ^ keys[0]));
            if differ == 0 {
                *out = [code(&self.codes, keys[0]); TOGETHER];
            } else {
                encode(keys, &self.codes, out);
            }
        }
        encode(rest_keys, &self.codes, rest_out);
    }

    /// `color` over some pixels.
    fn blend(&mut self, span: Range<usize>, color: Premul) {
        self.make_room(span.len());
        for key in &mut self.keys[span] {
            let below = self.colors.list[*key as usize];
            *key = self.colors.set(*key, color.over(below));
        }
    }

    /// Makes room for `count` more sums, which will not be encoded.
    #[inline]
    fn make_room(&mut self, count: usize) {
        self.encoded = false;
        if self.colors.end + count > self.colors.list.len() {
            self.grow(count);
        }
    }

    #[cold]
    fn grow(&mut self, count: usize) {
        let pixels = self.keys.len();
        let most = self.colors.first_sum + SUMS_PER_PIXEL * pixels;
        if self.colors.end + count > most {
            self.colors.sort_out(&mut self.keys);
        }
        let needed = self.colors.end + count;
        if needed > self.colors.list.len() {
            // Rarely: twice as many each time.
            let room = needed.next_power_of_two().min(most).max(needed);
            self.colors.list.resize(room, Premul::TRANSPARENT);
        }
    }

    /// The indices of up to `len` pixels from (`x`, `y`) to the right.
    fn span(&self, x: u32, y: u32, len: usize) -> Range<usize> {
        let (x, y) = (x as usize, y as usize);
        if x >= self.width || y >= self.height {
            return 0..0;
        }
        let start = y * self.width + x;
        start..start + len.min(self.width - x)
    }
}

impl Colors {
    /// Begins anew with the colours of a palette, the last of which stands for all keys beyond.
    fn start(&mut self, palette: &[Premul]) {
        (self.first_sum, self.end) = (palette.len(), palette.len());
        if self.list.len() < palette.len() {
            self.list.resize(palette.len(), Premul::TRANSPARENT);
        }
        self.list[..palette.len()].copy_from_slice(palette);
    }

    /// A colour of the palette, and its place.
    fn of_palette(&self, key: u32) -> (u32, Premul) {
        let place = key.min(self.first_sum.saturating_sub(1) as u32);
        (place, self.list.get(place as usize).copied().unwrap_or_default())
    }

    /// Gives a pixel with the key `key` a sum, for which there is room, and tells its key. (Without a
    /// branch, which nothing could guess.)
    #[inline(always)]
    pub(crate) fn set(&mut self, key: u32, sum: Premul) -> u32 {
        let is_new = (key as usize) < self.first_sum;
        let place = if is_new { self.end } else { key as usize };
        self.list[place] = sum;
        self.end += usize::from(is_new);
        place as u32
    }

    /// Drops the sums that no pixel holds.
    fn sort_out(&mut self, keys: &mut [u32]) {
        let mut kept = Vec::new();
        for key in keys {
            if *key as usize >= self.first_sum {
                kept.push(self.list[*key as usize]);
                *key = (self.first_sum + kept.len() - 1) as u32;
            }
        }
        self.end = self.first_sum + kept.len();
        self.list[self.first_sum..self.end].copy_from_slice(&kept);
    }
}

#[inline(always)]
fn code(codes: &[[u8; 4]], key: u32) -> [u8; 4] {
    codes[(key as usize).min(codes.len() - 1)]
}

#[inline(always)]
fn encode(keys: &[u32], codes: &[[u8; 4]], out: &mut [[u8; 4]]) {
    for (key, out) in keys.iter().zip(out) {
        *out = code(codes, *key);
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

    /// Sums that have been painted over take no more and more room.
    #[test]
    fn sums_are_sorted_out() {
        let space = WorkingSpace::Srgb;
        let mut palette = Palette::new(space);
        palette.extend([Premul([0.0, 0.0, 0.0, 1.0]), Premul([1.0, 0.5, 0.25, 1.0])]);
        let mut inlay = Inlay::new();
        inlay.reset(8, 2, 0, &palette);
        for round in 0..100 {
            inlay.blend_areas(0, 0, &[0.5; 8], 1);
            inlay.fill(round % 8, 0, 8, 1, 0);
            inlay.blend_area((1, 1), 4, 0.01, 1);
        }
        let most = Inlay::max_bytes(8, 2) as usize / size_of::<Premul>();
        assert!(inlay.colors.list.len() <= most, "{}", inlay.colors.list.len());
        let mut codes = [[0; 4]; 8];
        inlay.encode_row(0, &mut codes);
        assert_eq!(codes[2..4], [[128, 64, 32, 255], [0, 0, 0, 255]]);
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
                    inlay.reset(*width, *height, 0, &palette);
                    let mut tile = Tile::new();
                    tile.reset(*width, *height, 1, color(0));
                    for op in ops {
                        match *op {
                            Op::Fill(x, y, w, h, key) => {
                                inlay.fill(x, y, w, h, key);
                                tile.fill_block(x, y, w, h, color(key));
                            }
                            Op::Area(x, y, len, area, key) => {
                                inlay.blend_area((x, y), len, area, key);
                                tile.fill_block(x, y, len, 1, color(key).scaled(area));
                            }
                            Op::Areas(x, y, ref areas, key) => {
                                inlay.blend_areas(x, y, areas, key);
                                tile.blend_areas(x, y, areas, color(key));
                            }
                        }
                    }
                    for y in 0..*height {
                        let mut pixels = vec![Premul::TRANSPARENT; *width as usize];
                        tile.resolve_row(y, &mut pixels);
                        let (mut codes, mut expected) = (vec![[9; 4]; 60], vec![[9; 4]; 60]);
                        encode_row(&pixels, space, &mut expected);
                        inlay.encode_row(y, &mut codes);
                        prop_assert_eq!(codes, expected);
                    }
                }
            }
        }
    }
}
