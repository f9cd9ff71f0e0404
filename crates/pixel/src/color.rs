/// Red, green, blue and alpha in 0…1, with the colour multiplied by the alpha.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
#[repr(transparent)]
pub struct Premul(pub [f32; 4]);

/// Red, green, blue and alpha in 0…1, the colour apart from the alpha.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
#[repr(transparent)]
pub struct Straight(pub [f32; 4]);

/// The space in which colours are averaged and blended.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default)]
pub enum WorkingSpace {
    /// sRGB-encoded values, as SVG and the browsers composite.
    #[default]
    Srgb,
    /// Linear light, as light adds.
    Linear,
}

impl Premul {
    /// Nothing: all zeros.
    pub const TRANSPARENT: Self = Self([0.0; 4]);

    /// Alpha in 0…1.
    #[must_use]
    pub const fn alpha(self) -> f32 {
        self.0[3]
    }

    /// `self` over `below` (Porter and Duff 1984): self + (1 − α)·below.
    #[must_use]
    pub fn over(self, below: Self) -> Self {
        let k = 1.0 - self.0[3];
        Self(core::array::from_fn(|i| self.0[i] + k * below.0[i]))
    }

    /// All four components times `factor`: a uniform opacity.
    #[must_use]
    pub fn scaled(self, factor: f32) -> Self {
        Self(self.0.map(|v| v * factor))
    }
}

impl Straight {
    /// Opaque black.
    pub const BLACK: Self = Self([0.0, 0.0, 0.0, 1.0]);
    /// Opaque white.
    pub const WHITE: Self = Self([1.0; 4]);

    /// Multiplies the alpha in.
    #[must_use]
    pub fn premultiply(self) -> Premul {
        let [r, g, b, a] = self.0;
        Premul([r * a, g * a, b * a, a])
    }
}
