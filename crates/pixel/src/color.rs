/// Red, green, blue and alpha in 0…1, with the colour multiplied by the alpha.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
#[repr(transparent)]
pub struct Premul(pub [f32; 4]);

/// Red, green, blue and alpha in 0…1, the colour apart from the alpha.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
#[repr(transparent)]
pub struct Straight(pub [f32; 4]);

impl Premul {
    /// Nothing: all zeros.
    pub const TRANSPARENT: Self = Self([0.0; 4]);

    /// Alpha in 0…1.
    #[must_use]
    pub const fn alpha(self) -> f32 {
        self.0[3]
    }

    /// `self` over `below` (Porter and Duff 1984): self + (1 − α)·below.
    ///
    /// Over an opaque colour the result is opaque to the bit, and an opaque `self` over anything
    /// finite is `self`.
    #[must_use]
    #[inline]
    pub fn over(self, below: Self) -> Self {
        let k = 1.0 - self.0[3];
        Self(core::array::from_fn(|i| self.0[i] + k * below.0[i]))
    }

    /// All four components times `factor`: a uniform opacity.
    #[must_use]
    #[inline]
    pub fn scaled(self, factor: f32) -> Self {
        Self(self.0.map(|v| v * factor))
    }

    /// Divides the alpha out. Where alpha is 0 or less, or NaN, there is no colour to recover and
    /// the result is all zeros.
    #[must_use]
    #[inline]
    pub fn unpremultiply(self) -> Straight {
        let [r, g, b, a] = self.0;
        if a > 0.0 { Straight([r / a, g / a, b / a, a]) } else { Straight([0.0; 4]) }
    }
}

impl Straight {
    /// Opaque black.
    pub const BLACK: Self = Self([0.0, 0.0, 0.0, 1.0]);
    /// Opaque white.
    pub const WHITE: Self = Self([1.0; 4]);

    /// From 8 bits a component: code k is the `f32` nearest to k/255.
    #[must_use]
    pub fn from_rgba8(r: u8, g: u8, b: u8, a: u8) -> Self {
        Self([r, g, b, a].map(|code| f32::from(code) / 255.0))
    }

    /// From 16 bits a component: code k is the `f32` nearest to k/65535.
    #[must_use]
    pub fn from_rgba16(r: u16, g: u16, b: u16, a: u16) -> Self {
        Self([r, g, b, a].map(|code| f32::from(code) / 65535.0))
    }

    /// The same colour with its alpha times `opacity`.
    #[must_use]
    pub fn with_opacity(self, opacity: f32) -> Self {
        let [r, g, b, a] = self.0;
        Self([r, g, b, a * opacity])
    }

    /// Multiplies the alpha in.
    #[must_use]
    #[inline]
    pub fn premultiply(self) -> Premul {
        let [r, g, b, a] = self.0;
        Premul([r * a, g * a, b * a, a])
    }
}

impl From<[u8; 4]> for Straight {
    fn from([r, g, b, a]: [u8; 4]) -> Self {
        Self::from_rgba8(r, g, b, a)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn colour() -> impl Strategy<Value = Premul> {
        prop::array::uniform4(0.0_f32..=1.0).prop_map(|c| Straight(c).premultiply())
    }

    proptest! {
        #[test]
        fn opaque_stays_opaque(top in colour(), below in prop::array::uniform3(0.0_f32..=1.0)) {
            let [r, g, b] = below;
            prop_assert_eq!(top.over(Premul([r, g, b, 1.0])).alpha(), 1.0);
        }

        #[test]
        fn units_of_over(c in colour()) {
            prop_assert_eq!(c.over(Premul::TRANSPARENT), c);
            prop_assert_eq!(Premul::TRANSPARENT.over(c), c);
        }

        #[test]
        fn unpremultiply_undoes_premultiply(c in prop::array::uniform4(0.001_f32..=1.0)) {
            let back = Straight(c).premultiply().unpremultiply();
            for (a, b) in back.0.iter().zip(c) {
                prop_assert!((a - b).abs() <= 2.0 * f32::EPSILON * b);
            }
        }
    }

    #[test]
    fn no_alpha_no_colour() {
        for alpha in [0.0, -0.0, -1.0, f32::NAN] {
            assert_eq!(Premul([0.5, 0.5, 0.5, alpha]).unpremultiply(), Straight([0.0; 4]));
        }
    }
}
