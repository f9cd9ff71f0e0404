//! The 256 values of an 8-bit channel in the working space.

use scumble_pixel::WorkingSpace;

/// The value in 0…1 of each byte: itself over 255, or its light by IEC 61966-2-1.
pub(crate) fn decode_table(space: WorkingSpace) -> [f32; 256] {
    core::array::from_fn(|i| {
        let value = i as f64 / 255.0;
        (match space {
            WorkingSpace::Srgb => value,
            WorkingSpace::Linear => to_linear(value),
        }) as f32
    })
}

/// ((x + 0.055)/1.055)^2.4, or x/12.92 near black; the power as x²·(x²)^(1/5).
fn to_linear(x: f64) -> f64 {
    if x <= 0.04045 {
        return x / 12.92;
    }
    let y = (x + 0.055) / 1.055;
    y * y * crate::math::fifth_root(y * y)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_table_holds_the_formula() {
        let linear = decode_table(WorkingSpace::Linear);
        for (i, v) in linear.iter().enumerate() {
            let x = i as f64 / 255.0;
            let light = if x <= 0.04045 { x / 12.92 } else { ((x + 0.055) / 1.055).powf(2.4) };
            assert!((f64::from(*v) - light).abs() < 1e-7);
        }
        assert_eq!((linear[0], linear[255]), (0.0, 1.0));
        assert_eq!(decode_table(WorkingSpace::Srgb)[51], 0.2);
    }
}
