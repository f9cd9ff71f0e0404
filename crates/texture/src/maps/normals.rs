//! Normal maps: red, green and blue are x, y and z, 0…1 for −1…1.
//!
//! The mean of directions is the mean of vectors, so their levels are those of the numbers as they are:
//! no curve of sRGB, no alpha. The mean of unit vectors is shorter than one, the more so the more they
//! differ; [`normalize`] gives it back its length.

use crate::math::sqrt;

/// Below this length, a quarter of a step of eight bits, a mean of directions has none.
const SHORTEST: f64 = 0.001;

/// A texel whose vector has the length 1 and its direction; straight up, (½, ½, 1), where opposite
/// directions have cancelled and there is none.
///
/// ```
/// use scumble_texture::maps::normalize;
///
/// // The mean of two normals that lean 45° to either side.
/// assert_eq!(normalize([0.5, 0.5, 0.85355339]), [0.5, 0.5, 1.0]);
/// ```
#[must_use]
pub fn normalize(texel: [f32; 3]) -> [f32; 3] {
    let vector = texel.map(|v| 2.0 * f64::from(v) - 1.0);
    let [x, y, z] = vector;
    let length = sqrt(x * x + y * y + z * z);
    if length >= SHORTEST && length.is_finite() {
        vector.map(|v| (0.5 + 0.5 * (v / length)) as f32)
    } else {
        [0.5, 0.5, 1.0]
    }
}

/// [`normalize`] of a row or a whole level; the fourth number of each texel stays as it is.
pub fn normalize_row(texels: &mut [[f32; 4]]) {
    for texel in texels {
        let [r, g, b, a] = *texel;
        let [r, g, b] = normalize([r, g, b]);
        *texel = [r, g, b, a];
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    #[test]
    fn no_direction_is_up() {
        assert_eq!(normalize([0.5; 3]), [0.5, 0.5, 1.0]);
        assert_eq!(normalize([f32::NAN, 0.5, 0.5]), [0.5, 0.5, 1.0]);
        assert_eq!(normalize([f32::INFINITY, 0.5, 0.5]), [0.5, 0.5, 1.0]);
        let mut row = [[0.5, 0.5, 0.75, 0.25]];
        normalize_row(&mut row);
        assert_eq!(row, [[0.5, 0.5, 1.0, 0.25]]);
    }

    proptest! {
        #[test]
        fn the_length_is_one_and_the_direction_stays(texel in proptest::array::uniform3(0.0_f32..=1.0)) {
            let vector = texel.map(|v| 2.0 * f64::from(v) - 1.0);
            let length = vector.iter().map(|v| v * v).sum::<f64>().sqrt();
            prop_assume!(length > 0.01);
            let unit = normalize(texel).map(|v| 2.0 * f64::from(v) - 1.0);
            for (unit, v) in unit.iter().zip(vector) {
                prop_assert!((unit - v / length).abs() < 1e-6);
            }
        }
    }
}
