use crate::{Premul, Straight, srgb, unorm8, unorm16};

/// The space in which colours are averaged and blended.
///
/// Colours come in from files and style sheets as straight sRGB ([`import`](Self::import)) and go
/// out as straight sRGB ([`export`](Self::export)); between the two every average of a run is of
/// premultiplied values in its one working space.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default)]
pub enum WorkingSpace {
    /// sRGB-encoded values, as SVG and the browsers composite.
    #[default]
    Srgb,
    /// Linear light, as light adds.
    Linear,
}

impl WorkingSpace {
    /// A straight sRGB colour, or 8 bits a component of it, as a premultiplied colour of this
    /// space.
    ///
    /// ```
    /// use scumble_pixel::{Premul, WorkingSpace};
    ///
    /// let half_red = WorkingSpace::Srgb.import([255, 0, 0, 51]);
    /// assert_eq!(half_red, Premul([0.2, 0.0, 0.0, 0.2]));
    /// ```
    #[must_use]
    #[inline]
    pub fn import(self, color: impl Into<Straight>) -> Premul {
        let Straight([r, g, b, a]) = color.into();
        match self {
            Self::Srgb => Straight([r, g, b, a]),
            Self::Linear => Straight([srgb::decode(r), srgb::decode(g), srgb::decode(b), a]),
        }
        .premultiply()
    }

    /// [`import`](Self::import) of an 8-bit colour, from tables: the same bits.
    #[must_use]
    #[inline]
    pub fn import8(self, [r, g, b, a]: [u8; 4]) -> Premul {
        match self {
            Self::Srgb => Straight::from_rgba8(r, g, b, a),
            Self::Linear => Straight([
                srgb::decode8(r),
                srgb::decode8(g),
                srgb::decode8(b),
                f32::from(a) / 255.0,
            ]),
        }
        .premultiply()
    }

    /// [`import8`](Self::import8) of a row; the shorter slice ends it.
    pub fn import_row(self, colors: &[[u8; 4]], out: &mut [Premul]) {
        for (out, &color) in out.iter_mut().zip(colors) {
            *out = self.import8(color);
        }
    }

    /// A colour of this space as straight sRGB in `f32`, unclamped.
    #[must_use]
    #[inline]
    pub fn export_straight(self, color: Premul) -> Straight {
        let Straight([r, g, b, a]) = color.unpremultiply();
        match self {
            Self::Srgb => Straight([r, g, b, a]),
            Self::Linear => Straight([srgb::encode(r), srgb::encode(g), srgb::encode(b), a]),
        }
    }

    /// A colour of this space as straight 8-bit sRGB, every component rounded to nearest.
    ///
    /// Components beyond 0…1 are clamped and NaN is 0. An alpha that rounds to 0 gives
    /// `[0, 0, 0, 0]`. Every 8-bit colour of alpha 1…255 comes back from
    /// [`import`](Self::import) unchanged, in both spaces.
    ///
    /// ```
    /// use scumble_pixel::WorkingSpace;
    ///
    /// let colour = [12, 34, 56, 3];
    /// assert_eq!(WorkingSpace::Linear.export(WorkingSpace::Linear.import(colour)), colour);
    /// ```
    #[must_use]
    #[inline]
    pub fn export(self, color: Premul) -> [u8; 4] {
        match self {
            Self::Srgb => export_srgb(color),
            Self::Linear => export_linear(color),
        }
    }

    /// [`export`](Self::export) of a row; the shorter slice ends it.
    // Inlined, so that a caller compiled for better instructions gets it in them.
    #[inline(always)]
    pub fn export_row(self, colors: &[Premul], out: &mut [[u8; 4]]) {
        match self {
            Self::Srgb => export_srgb_row(colors, out),
            Self::Linear => export_row_with(colors, out, export_linear),
        }
    }

    /// A colour of this space as straight 16-bit sRGB, every component rounded to nearest.
    ///
    /// An alpha that rounds to 0 gives zeros, as in [`export`](Self::export).
    #[must_use]
    #[inline]
    pub fn export16(self, color: Premul) -> [u16; 4] {
        let codes = self.export_straight(color).0.map(unorm16);
        if codes[3] == 0 { [0; 4] } else { codes }
    }
}

/// [`WorkingSpace::export`] of encoded values, without a branch: a row of them is twice as fast.
#[inline(always)]
fn export_srgb(color: Premul) -> [u8; 4] {
    let alpha = color.alpha();
    // Where there is no alpha, infinity makes zeros.
    let divisor = if alpha > 0.0 { alpha } else { f32::INFINITY };
    let divisors = [divisor, divisor, divisor, 1.0];
    let codes: [u8; 4] = core::array::from_fn(|i| unorm8(color.0[i] / divisors[i]));
    let keep = u8::from(codes[3] != 0).wrapping_neg();
    codes.map(|code| code & keep)
}

/// Pixels that are looked at together: if all are opaque, nothing needs to be divided.
const TOGETHER: usize = 16;

/// [`export_srgb`] of a row.
#[inline(always)]
fn export_srgb_row(colors: &[Premul], out: &mut [[u8; 4]]) {
    let len = colors.len().min(out.len());
    let (colors, rest) = colors[..len].as_chunks::<TOGETHER>();
    let (codes, rest_codes) = out[..len].as_chunks_mut::<TOGETHER>();
    for (colors, codes) in colors.iter().zip(codes) {
        let opaque = colors.iter().fold(true, |all, color| all & (color.alpha() == 1.0));
        if opaque {
            // As one array of numbers, which fills vectors.
            let values = colors.map(|color| color.0);
            for (code, &value) in codes.as_flattened_mut().iter_mut().zip(values.as_flattened()) {
                *code = unorm8(value);
            }
        } else {
            export_row_with(colors, codes, export_srgb);
        }
    }
    export_row_with(rest, rest_codes, export_srgb);
}

/// [`WorkingSpace::export`] of linear light.
#[inline(always)]
fn export_linear(color: Premul) -> [u8; 4] {
    let alpha = unorm8(color.alpha());
    if alpha == 0 {
        return [0; 4];
    }
    let Straight([r, g, b, _]) = color.unpremultiply();
    [srgb::encode8(r), srgb::encode8(g), srgb::encode8(b), alpha]
}

#[inline(always)]
fn export_row_with(colors: &[Premul], out: &mut [[u8; 4]], export: impl Fn(Premul) -> [u8; 4]) {
    for (out, &color) in out.iter_mut().zip(colors) {
        *out = export(color);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    const SPACES: [WorkingSpace; 2] = [WorkingSpace::Srgb, WorkingSpace::Linear];

    #[test]
    fn every_colour_and_alpha_comes_back() {
        for space in SPACES {
            assert_eq!(space.export(space.import([9, 8, 7, 0])), [0; 4]);
            for alpha in 1..=255 {
                for code in 0..=255 {
                    let colour = [code, 255 - code, code / 2, alpha];
                    assert_eq!(space.export(space.import8(colour)), colour, "{space:?}");
                }
            }
        }
    }

    #[test]
    fn out_of_range_is_clamped() {
        for space in SPACES {
            assert_eq!(space.export(Premul([f32::NAN; 4])), [0; 4]);
            assert_eq!(space.export(Premul([2.0, -1.0, f32::NAN, 1.0])), [255, 0, 0, 255]);
            assert_eq!(space.export(Premul([1.0, 1.0, 1.0, 1e-9])), [0; 4]);
            assert_eq!(space.export(Premul([f32::INFINITY; 4])), [0, 0, 0, 255]);
        }
    }

    proptest! {
        #[test]
        fn tables_give_the_bits_of_the_formula(colour: [u8; 4]) {
            for space in SPACES {
                prop_assert_eq!(space.import8(colour), space.import(colour));
            }
        }

        #[test]
        fn export_is_division_then_rounding(
            color in prop::array::uniform4(prop_oneof![-0.5_f32..1.5, any::<f32>()]),
        ) {
            let color = Premul(color);
            let alpha = unorm8(color.alpha());
            let [r, g, b, _] = color.unpremultiply().0;
            for (space, encode) in SPACES.into_iter().zip([unorm8, srgb::encode8]) {
                let codes = [encode(r), encode(g), encode(b), alpha];
                prop_assert_eq!(space.export(color), if alpha == 0 { [0; 4] } else { codes });
            }
        }

        #[test]
        fn sixteen_bits_come_back(rgb: [u16; 3], alpha in 256_u16..) {
            let colour = [rgb[0], rgb[1], rgb[2], alpha];
            let straight = Straight::from_rgba16(rgb[0], rgb[1], rgb[2], alpha);
            for space in SPACES {
                prop_assert_eq!(space.export16(space.import(straight)), colour);
            }
        }

        #[test]
        fn rows_are_the_scalars(row: Vec<[u8; 4]>) {
            for space in SPACES {
                let mut premul = vec![Premul::TRANSPARENT; row.len()];
                space.import_row(&row, &mut premul);
                let mut back = vec![[1; 4]; row.len()];
                space.export_row(&premul, &mut back);
                for ((&colour, &p), &b) in row.iter().zip(&premul).zip(&back) {
                    prop_assert_eq!(p, space.import8(colour));
                    prop_assert_eq!(b, space.export(p));
                }
            }
        }
    }
}
