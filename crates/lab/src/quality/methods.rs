//! The filters that are compared.

use scumble::texture::compare::vulkan_anisotropic;
use scumble::texture::{Footprint, LevelMode, Magnify, PixelFilter, Sampler, Texture};
use scumble_geometry::Matrix2;

/// Trilinear: two levels, four texels of each.
pub(crate) const TRILINEAR: Sampler =
    Sampler::DEFAULT.with(PixelFilter::Bilinear, LevelMode::Linear);

/// Four texels of the image itself.
pub(crate) const BILINEAR: Sampler = Sampler::DEFAULT.with(PixelFilter::Bilinear, LevelMode::Zero);

/// Probes along the major axis.
pub(crate) const PROBES: Sampler = Sampler::DEFAULT.with(PixelFilter::Probes, LevelMode::Auto);

/// A filter.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Method {
    Sampler(Sampler),
    /// Hardware's anisotropic filter, of at most so many samples.
    Vulkan(u32),
}

/// The rows of the tables.
pub(crate) const TABLE: [(&str, Method); 9] = [
    ("bilinear, level 0", Method::Sampler(BILINEAR)),
    ("trilinear", Method::Sampler(TRILINEAR)),
    ("Vulkan AF ×16", Method::Vulkan(16)),
    ("`classic`", Method::Sampler(Sampler::CLASSIC)),
    ("probes", Method::Sampler(PROBES)),
    ("`fast`", Method::Sampler(Sampler::FAST)),
    ("`default`", Method::Sampler(Sampler::DEFAULT)),
    ("`high`", Method::Sampler(Sampler::HIGH)),
    ("`reference`", Method::Sampler(Sampler::REFERENCE)),
];

/// The row of [`TABLE`] from which on there are only presets that the sweep judges.
pub(crate) const PRESETS_FROM: usize = 5;

/// The curves of the plot: one parameter of a method runs through a range.
pub(crate) fn families() -> Vec<(&'static str, Vec<Method>)> {
    let ratios = [2.0, 4.0, 8.0, 16.0, 32.0];
    let ellipse = |magnify, s| {
        let max_eccentricity = Sampler::HIGH.max_eccentricity;
        let s = Sampler { least_sigma: s, magnify, max_eccentricity, ..Sampler::DEFAULT };
        Method::Sampler(s)
    };
    let with_ratio =
        |s: Sampler, max_eccentricity| Method::Sampler(Sampler { max_eccentricity, ..s });
    let sigmas = [0.4, 0.5, 0.6, 0.7, 0.8, 1.0, 1.25, 1.5];
    vec![
        (
            "hardware's anisotropy, 1 to 64 samples",
            [1, 2, 4, 8, 16, 32, 64].map(Method::Vulkan).to_vec(),
        ),
        (
            "classic EWA, axis ratio to 2 … 32",
            ratios.map(|a| with_ratio(Sampler::CLASSIC, a)).to_vec(),
        ),
        ("probes, axis ratio to 2 … 32", ratios.map(|a| with_ratio(PROBES, a)).to_vec()),
        ("ellipse, s = 0.4 … 1.5", sigmas.map(|s| ellipse(Magnify::None, s)).to_vec()),
        ("ellipse and taps, s = 0.4 … 1.5", sigmas.map(|s| ellipse(Magnify::Taps, s)).to_vec()),
    ]
}

impl Method {
    /// The colour of a footprint.
    pub(crate) fn color(&self, t: &Texture, f: &Footprint) -> [f32; 4] {
        match self {
            Self::Sampler(s) => t.sample(f, s).0,
            Self::Vulkan(most) => vulkan_anisotropic(t, f, *most).0,
        }
    }

    /// Texels read for it, those of weight 0 included.
    pub(crate) fn texels(&self, t: &Texture, f: &Footprint) -> usize {
        match self {
            Self::Sampler(s) => t.cost(f, s),
            Self::Vulkan(most) => {
                let Matrix2 { a, b, c, d } = f.jacobian;
                let (x, y) = ((a * a + c * c).sqrt(), (b * b + d * d).sqrt());
                let ratio = (x.max(y) / x.min(y)).min(f64::from(*most));
                let spot = x.max(y) / ratio;
                let jacobian = Matrix2::new(spot, 0.0, 0.0, spot);
                ratio.ceil() as usize * t.cost(&Footprint { jacobian, ..*f }, &TRILINEAR)
            }
        }
    }
}
