//! Alpha-tested coverage, kept from level to level.
//!
//! A leaf that is drawn where its alpha is at least T thins out with distance: averages of alpha fall
//! below T almost everywhere. Scaling the alpha of each level so that as large a part of it passes the
//! test as of level 0 keeps the foliage as dense as it is (Castaño, "Computing Alpha Mipmaps", 2010).

use alloc::vec::Vec;

/// Half a code of eight bits: an alpha nearer to the threshold than this may be stored on its other side.
const MARGIN: f32 = 0.5 / 255.0;

/// The part of the texels, premultiplied RGBA, whose alpha is at least `threshold`, in 0…1; 0 for none.
///
/// ```
/// use scumble_texture::maps::coverage;
///
/// assert_eq!(coverage(&[[0.0; 4], [0.5; 4], [1.0; 4], [0.0; 4]], 0.5), 0.5);
/// ```
#[must_use]
pub fn coverage(texels: &[[f32; 4]], threshold: f32) -> f64 {
    let passing = texels.iter().filter(|t| t[3] >= threshold).count();
    if texels.is_empty() { 0.0 } else { passing as f64 / texels.len() as f64 }
}

/// The factor for the alpha of a level after which as near a part of it as can be passes the test
/// against `threshold`, in 0…1, as `part` says, in 0…1.
///
/// Instead of searching the factor by trial, this takes the alphas that shall just pass and just fail,
/// and puts the threshold half way between them: exact, and the test's outcome survives rounding to
/// eight bits if anything can. Where equal alphas stand on both sides, all of them pass or none,
/// whichever is nearer. It is 1 where nothing needs to change, or nothing can be had: a level without
/// alpha, a threshold that is not above 0.
///
/// ```
/// use scumble_texture::maps::{coverage, coverage_scale, scale_alpha};
///
/// // A level whose averages have all but lost the leaf.
/// let mut level = [[0.1; 4], [0.3; 4], [0.4; 4], [0.2; 4]];
/// let factor = coverage_scale(&level, 0.5, 0.5);
/// scale_alpha(&mut level, factor);
/// assert_eq!(coverage(&level, 0.5), 0.5);
/// ```
#[must_use]
pub fn coverage_scale(texels: &[[f32; 4]], threshold: f32, part: f64) -> f32 {
    let mut alphas: Vec<f32> = texels.iter().map(|t| t[3]).filter(|a| *a > 0.0).collect();
    if !(threshold > 0.0 && part >= 0.0) || alphas.is_empty() {
        return 1.0;
    }
    // The cast truncates: rounded to nearest, halves up.
    let wanted = (part.min(1.0) * texels.len() as f64 + 0.5) as usize;
    alphas.sort_unstable_by(|a, b| b.total_cmp(a));
    let count = nearest_cut(&alphas, wanted.min(alphas.len()));
    // What just passes and what just fails; beyond the ends anything does.
    let passes = count.checked_sub(1).map_or(f32::INFINITY, |i| alphas[i]);
    let fails = alphas.get(count).copied().unwrap_or(0.0);
    if passes - MARGIN > threshold && fails + MARGIN < threshold {
        return 1.0;
    }
    if fails == 0.0 {
        (threshold + 2.0 * MARGIN) / passes
    } else if passes == f32::INFINITY {
        (threshold - 2.0 * MARGIN).max(0.5 * threshold) / fails
    } else {
        threshold / (0.5 * (passes + fails))
    }
}

/// The number of texels, out of alphas in falling order, that is nearest to `wanted` and does not part
/// equal alphas; the larger of two that are as near.
fn nearest_cut(alphas: &[f32], wanted: usize) -> usize {
    let Some(&alpha) = wanted.checked_sub(1).and_then(|i| alphas.get(i)) else { return 0 };
    let before = alphas.partition_point(|a| *a > alpha);
    let after = alphas.partition_point(|a| *a >= alpha);
    if wanted - before < after - wanted { before } else { after }
}

/// Multiplies the alpha of premultiplied texels, up to 1, and keeps their straight colours.
pub fn scale_alpha(texels: &mut [[f32; 4]], factor: f32) {
    for texel in texels {
        let alpha = texel[3];
        if alpha > 0.0 {
            let scaled = alpha * factor;
            let scaled = if scaled < 1.0 { scaled } else { 1.0 };
            let by = scaled / alpha;
            *texel = [texel[0] * by, texel[1] * by, texel[2] * by, scaled];
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use alloc::vec;
    use proptest::prelude::*;

    fn level(alphas: &[f32]) -> Vec<[f32; 4]> {
        alphas.iter().map(|&a| [0.5 * a, 0.25 * a, 0.0, a]).collect()
    }

    fn kept(alphas: &[f32], threshold: f32, part: f64) -> f64 {
        let mut texels = level(alphas);
        let factor = coverage_scale(&texels, threshold, part);
        scale_alpha(&mut texels, factor);
        coverage(&texels, threshold)
    }

    #[test]
    fn ends_and_nothing_at_all() {
        assert_eq!(kept(&[], 0.5, 0.5), 0.0);
        assert_eq!(kept(&[0.0, 0.0], 0.5, 1.0), 0.0);
        assert_eq!(kept(&[0.1, 0.2], 0.5, 1.0), 1.0);
        assert_eq!(kept(&[0.9, 0.8], 0.5, 0.0), 0.0);
        assert_eq!(coverage_scale(&level(&[0.9, 0.1]), 0.5, 0.5), 1.0);
        assert_eq!(coverage_scale(&level(&[0.9]), 0.0, 0.5), 1.0);
        assert_eq!(coverage_scale(&level(&[0.9]), 0.5, f64::NAN), 1.0);
    }

    #[test]
    fn equal_alphas_go_together() {
        assert_eq!(kept(&[0.4, 0.3, 0.3, 0.3, 0.3], 0.5, 0.4), 0.2);
        assert_eq!(kept(&[0.4, 0.3, 0.3, 0.3, 0.3], 0.5, 0.8), 1.0);
    }

    #[test]
    fn the_colour_stays() {
        let mut texels = vec![[0.1, 0.2, 0.05, 0.2], [0.3, 0.6, 0.0, 0.6], [0.0; 4]];
        scale_alpha(&mut texels, 2.0);
        assert_eq!(texels[0], [0.2, 0.4, 0.1, 0.4]);
        assert_eq!((texels[1][3], texels[2]), (1.0, [0.0; 4]));
        assert!((texels[1][1] - 1.0).abs() < 1e-6 && (texels[1][0] - 0.5).abs() < 1e-6);
    }

    proptest! {
        #[test]
        fn the_part_is_kept_to_half_a_texel(
            mut alphas in proptest::collection::vec(0.01_f32..1.0, 1..80),
            part in 0.0_f64..=1.0,
            threshold in 0.1_f32..0.9,
        ) {
            // Distinct, so that every part can be had.
            alphas.sort_by(f32::total_cmp);
            alphas.dedup_by(|a, b| (*a - *b).abs() < 1e-4);
            let most = 0.5 / alphas.len() as f64 + 1e-9;
            prop_assert!((kept(&alphas, threshold, part) - part).abs() <= most);
        }
    }
}
