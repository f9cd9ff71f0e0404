use crate::samples::same_bits;
use scumble_pixel::{Premul, WorkingSpace};

/// Finished pixels as straight 8-bit sRGB, every component rounded to nearest; the shorter slice
/// ends it. The colour of a pixel is [`WorkingSpace::export`] of it, whatever its neighbours are.
///
/// With the feature `std` it runs on the best instructions that the machine has, which give the same
/// bytes.
pub fn encode_row(pixels: &[Premul], space: WorkingSpace, out: &mut [[u8; 4]]) {
    #[cfg(feature = "std")]
    fearless_simd::dispatch!(fearless_simd::Level::new(), _simd => encode_by(pixels, space, out));
    #[cfg(not(feature = "std"))]
    encode_by(pixels, space, out);
}

/// Pixels that are looked at together.
const TOGETHER: usize = 16;

/// Where colours repeat, as they do in most of a drawing, comparing them is several times as quick as
/// encoding them.
#[inline(always)]
fn encode_by(pixels: &[Premul], space: WorkingSpace, out: &mut [[u8; 4]]) {
    let len = pixels.len().min(out.len());
    let (pixels, rest) = pixels[..len].as_chunks::<TOGETHER>();
    let (out, rest_out) = out[..len].as_chunks_mut::<TOGETHER>();
    let mut last = None;
    for (pixels, out) in pixels.iter().zip(out) {
        match last {
            Some((color, code)) if are_all(pixels, color) => *out = [code; TOGETHER],
            _ => {
                space.export_row(pixels, out);
                last = Some((pixels[TOGETHER - 1], out[TOGETHER - 1]));
            }
        }
    }
    space.export_row(rest, rest_out);
}

/// Whether all pixels are of one colour, to the bit. (Looks at the first alone, since in a gradient that
/// is enough, and then at all of them, which fills vectors.)
#[inline(always)]
fn are_all(pixels: &[Premul; TOGETHER], color: Premul) -> bool {
    if !same_bits(pixels[0], color) {
        return false;
    }
    let [r, g, b, a] = color.0.map(f32::to_bits);
    let four = [r, g, b, a, r, g, b, a, r, g, b, a, r, g, b, a];
    let mut differ = [0; 16];
    for pixels in pixels.as_chunks::<4>().0 {
        for (i, (differ, bits)) in differ.iter_mut().zip(four).enumerate() {
            *differ |= pixels[i / 4].0[i % 4].to_bits() ^ bits;
        }
    }
    differ == [0; 16]
}

/// Finished pixels as straight 16-bit sRGB, every component rounded to nearest; the shorter slice
/// ends it. See [`WorkingSpace::export16`].
pub fn encode_row16(pixels: &[Premul], space: WorkingSpace, out: &mut [[u16; 4]]) {
    for (out, &pixel) in out.iter_mut().zip(pixels) {
        *out = space.export16(pixel);
    }
}

/// Finished pixels as straight 8-bit sRGB with ordered dither; the shorter slice ends it.
///
/// The row starts at column `x` of row `y` of the picture. There, red, green and blue are rounded
/// up where their fraction of a code exceeds a threshold that depends on the position alone: the
/// 8×8 matrix of Bayer (1973), 64 thresholds from 1/128 to 127/128. So a smooth gradient keeps its
/// mean over every 8×8 pixels to 1/128 of a code, a crop is that part of the whole, and a value
/// that is a code already stays as it is. Alpha is rounded to nearest.
///
/// ```
/// use scumble_framebuffer::encode_row_dithered;
/// use scumble_pixel::{Premul, WorkingSpace};
///
/// let grey = [Premul([100.5 / 255.0, 0.0, 0.0, 1.0]); 8];
/// let mut codes = [[0; 4]; 8];
/// encode_row_dithered(&grey, WorkingSpace::Srgb, 0, 0, &mut codes);
/// assert_eq!(codes.iter().filter(|c| c[0] == 101).count(), 4);
/// ```
pub fn encode_row_dithered(
    pixels: &[Premul],
    space: WorkingSpace,
    x: u32,
    y: u32,
    out: &mut [[u8; 4]],
) {
    let thresholds: [f64; 8] = core::array::from_fn(|column| bayer(column as u32, y));
    for ((i, &pixel), out) in pixels.iter().enumerate().zip(out) {
        let alpha = space.export(pixel)[3];
        if alpha == 0 {
            *out = [0; 4];
            continue;
        }
        let threshold = thresholds[(x as usize).wrapping_add(i) % 8];
        let [r, g, b, _] = space.export_straight(pixel).0;
        // The cast truncates, saturates, and makes 0 of NaN.
        let [r, g, b] = [r, g, b].map(|v| (f64::from(v) * 255.0 + threshold) as u8);
        *out = [r, g, b, alpha];
    }
}

/// What to add before rounding down: (m + ½)/64 with m from Bayer's matrix, whose bits are those
/// of x ⊕ y and y, lowest first, interleaved from the top.
fn bayer(x: u32, y: u32) -> f64 {
    let mixed = x ^ y;
    let m = (0..3).fold(0, |m, bit| (m << 2) | ((mixed >> bit & 1) << 1) | (y >> bit & 1));
    (f64::from(m) + 0.5) / 64.0
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    const SPACES: [WorkingSpace; 2] = [WorkingSpace::Srgb, WorkingSpace::Linear];

    #[test]
    fn bayer_takes_every_value_once() {
        let mut found: Vec<f64> = (0..64).map(|i| bayer(i % 8, i / 8)).collect();
        // The corner of the matrix as it is usually printed: 0 32 8 40 / 48 16 56 24.
        assert_eq!(found[..4], [0.5, 32.5, 8.5, 40.5].map(|v| v / 64.0));
        assert_eq!(found[8..12], [48.5, 16.5, 56.5, 24.5].map(|v| v / 64.0));
        found.sort_by(f64::total_cmp);
        assert!(found.iter().enumerate().all(|(m, &t)| t == (m as f64 + 0.5) / 64.0));
    }

    proptest! {
        #[test]
        fn dither_leaves_codes_alone(codes: [u8; 3], x: u32, y: u32) {
            let colour = [codes[0], codes[1], codes[2], 255];
            for space in SPACES {
                let mut out = [[0; 4]; 9];
                encode_row_dithered(&[space.import(colour); 9], space, x, y, &mut out);
                prop_assert_eq!(out, [colour; 9]);
            }
        }

        #[test]
        fn dither_keeps_the_mean(value in 0.0_f32..=1.0, x in 0..99_u32, y in 0..99_u32) {
            for space in SPACES {
                let pixels = [Premul([value, value, value, 1.0]); 8];
                let exact = f64::from(space.export_straight(pixels[0]).0[0]) * 255.0;
                let mut sum = 0.0;
                for row in 0..8 {
                    let mut out = [[0; 4]; 8];
                    encode_row_dithered(&pixels, space, x, y + row, &mut out);
                    sum += out.iter().map(|c| f64::from(c[0])).sum::<f64>();
                }
                prop_assert!((sum / 64.0 - exact).abs() <= 1.0 / 128.0 + 1e-9);
            }
        }

        #[test]
        fn neighbours_do_not_matter(
            stretches in prop::collection::vec((any::<[u8; 3]>(), 0.0_f32..=1.0, 1..70_usize), 1..6),
            room in 0..200_usize,
        ) {
            for space in SPACES {
                let color = |&(rgb, alpha, len): &([u8; 3], f32, usize)| {
                    let [r, g, b] = rgb;
                    vec![space.import([r, g, b, 255]).scaled(alpha); len]
                };
                let pixels: Vec<Premul> = stretches.iter().flat_map(color).collect();
                let mut codes = vec![[1; 4]; room];
                encode_row(&pixels, space, &mut codes);
                for (code, pixel) in codes.iter().zip(&pixels) {
                    prop_assert_eq!(*code, space.export(*pixel));
                }
                prop_assert!(codes.iter().skip(pixels.len()).all(|&code| code == [1; 4]));
            }
        }

        #[test]
        fn a_part_of_a_row_is_dithered_alike(
            row in prop::collection::vec(0.0_f32..=1.0, 1..40),
            skip in 0..40_usize,
            x: u32,
        ) {
            let pixels: Vec<Premul> = row.iter().map(|&v| Premul([v, v, v, 1.0])).collect();
            let skip = skip.min(pixels.len());
            let mut whole = vec![[0; 4]; pixels.len()];
            encode_row_dithered(&pixels, WorkingSpace::Srgb, x, 5, &mut whole);
            let mut part = vec![[0; 4]; pixels.len() - skip];
            let x = x.wrapping_add(skip as u32);
            encode_row_dithered(&pixels[skip..], WorkingSpace::Srgb, x, 5, &mut part);
            prop_assert_eq!(&whole[skip..], &part[..]);
        }

        #[test]
        fn sixteen_bits_hold_every_eight(colour: [u8; 4]) {
            for space in SPACES {
                let mut wide = [[0; 4]];
                encode_row16(&[space.import(colour)], space, &mut wide);
                if colour[3] > 0 {
                    prop_assert_eq!(wide[0], colour.map(|c| u16::from(c) * 257));
                }
            }
        }
    }

    #[test]
    fn nothing_is_nothing() {
        let mut out = [[9; 4]; 2];
        let pixels = [Premul([1.0, 1.0, 1.0, 1e-4]), Premul([f32::NAN; 4])];
        encode_row_dithered(&pixels, WorkingSpace::Linear, 0, 0, &mut out);
        assert_eq!(out, [[0; 4]; 2]);
    }
}
