//! Colours over stretches of uniform pixels.

use crate::inlay::Colors;
use crate::level::Best;
use scumble_pixel::Premul;

/// Pixels that are written together: a line of the cache.
const TOGETHER: usize = 4;

/// Fewer pixels than this take less time than it takes to choose the best instructions.
const SHORT: usize = 12;

/// Runs a kernel on so many pixels by the best instructions, if they are worth it.
macro_rules! by_best {
    ($best:expr, $len:expr, $kernel:expr) => {{
        let (best, len): (Best, usize) = ($best, $len);
        if len < SHORT {
            return $kernel;
        }
        #[cfg(feature = "std")]
        fearless_simd::dispatch!(best.0, _simd => $kernel);
        #[cfg(not(feature = "std"))]
        {
            let Best = best;
            $kernel
        }
    }};
}

/// Makes all of a stretch `color`.
pub(crate) fn fill(best: Best, below: &mut [Premul], color: Premul) {
    by_best!(best, below.len(), fill_by(below, color))
}

/// One colour over many.
pub(crate) fn blend(best: Best, below: &mut [Premul], color: Premul) {
    by_best!(best, below.len(), blend_by(below, color))
}

/// Parts of one colour over as many pixels.
pub(crate) fn blend_parts(best: Best, below: &mut [Premul], parts: &[f32], color: Premul) {
    by_best!(best, below.len(), blend_parts_by(below, parts, color))
}

/// Parts of one colour over as many pixels of an [`Inlay`](crate::Inlay), with room for as many sums.
pub(crate) fn inlay_parts(
    best: Best,
    keys: &mut [u32],
    colors: &mut Colors,
    parts: &[f32],
    color: Premul,
) {
    by_best!(best, keys.len(), inlay_parts_by(keys, colors, parts, color))
}

/// Writes a key all over a run. Runs are short: two writes that overlap beat a loop over what is
/// left after whole vectors.
#[inline(always)]
pub(crate) fn fill_keys(run: &mut [u32], key: u32) {
    if let Some(last) = run.last_chunk_mut() {
        *last = [key; 8];
        for chunk in run.as_chunks_mut().0 {
            *chunk = [key; 8];
        }
    } else if let Some(last) = run.last_chunk_mut() {
        *last = [key; 4];
        if let Some(first) = run.first_chunk_mut() {
            *first = [key; 4];
        }
    } else {
        for seen in run {
            *seen = key;
        }
    }
}

#[inline(always)]
fn fill_by(below: &mut [Premul], color: Premul) {
    let (lines, rest) = below.as_chunks_mut::<TOGETHER>();
    for line in lines {
        *line = [color; TOGETHER];
    }
    for pixel in rest {
        *pixel = color;
    }
}

#[inline(always)]
fn blend_by(below: &mut [Premul], color: Premul) {
    if color.alpha() == 1.0 {
        return fill_by(below, color);
    }
    for pixel in below {
        *pixel = color.over(*pixel);
    }
}

#[inline(always)]
fn blend_parts_by(below: &mut [Premul], parts: &[f32], color: Premul) {
    for (pixel, &part) in below.iter_mut().zip(parts) {
        // Not by the methods of a colour: their closures would not be compiled for the instructions.
        let (above, under) = (color.0, pixel.0);
        let keep = 1.0 - above[3] * part;
        let mut sum = [0.0; 4];
        for i in 0..4 {
            sum[i] = above[i] * part + keep * under[i];
        }
        pixel.0 = sum;
    }
}

#[inline(always)]
fn inlay_parts_by(keys: &mut [u32], colors: &mut Colors, parts: &[f32], color: Premul) {
    for (key, &part) in keys.iter_mut().zip(parts) {
        // As in `blend_parts_by`.
        let (above, under) = (color.0, colors.list[*key as usize].0);
        let keep = 1.0 - above[3] * part;
        let mut sum = [0.0; 4];
        for i in 0..4 {
            sum[i] = above[i] * part + keep * under[i];
        }
        *key = colors.set(*key, Premul(sum));
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use alloc::vec::Vec;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn stretches_are_as_their_pixels(
            parts in prop::collection::vec(0.0_f32..=1.0, 0..60),
            color in prop::array::uniform4(0.0_f32..=1.0),
            opaque in any::<bool>(),
        ) {
            let mut color = Premul(color);
            if opaque {
                color.0[3] = 1.0;
            }
            let below: Vec<Premul> =
                parts.iter().map(|v| Premul([*v, 1.0 - v, v * v, 0.5 + 0.5 * v])).collect();
            let mut found = below.clone();
            blend_parts(Best::default(), &mut found, &parts, color);
            let over = |(part, below): (&f32, &Premul)| color.scaled(*part).over(*below);
            let expected: Vec<Premul> = parts.iter().zip(&below).map(over).collect();
            prop_assert_eq!(&found, &expected);
            let mut found = below.clone();
            blend(Best::default(), &mut found, color);
            let over = |below: &Premul| if opaque { color } else { color.over(*below) };
            prop_assert_eq!(&found, &below.iter().map(over).collect::<Vec<_>>());
            fill(Best::default(), &mut found, color);
            prop_assert!(found.iter().all(|&pixel| pixel == color));
        }
    }
}
