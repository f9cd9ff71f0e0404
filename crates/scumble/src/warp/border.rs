use crate::pixel::{Premul, Straight, WorkingSpace};
use crate::texture::{Footprint, Kernel, Magnify, PixelFilter, Sampler, Wrap};

/// What lies beyond the edge of the source.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub enum Border {
    /// Nothing: the picture ends, and its edge is antialiased.
    ///
    /// The edge of an opaque source is a line, and a pixel of the output shows as much of the source as
    /// lies on that side of it, magnified or not. A source with transparency of its own is taken to go on
    /// with transparent texels instead, so that its last texels fade where it is magnified.
    #[default]
    Transparent,
    /// One colour, in sRGB; the edge is as it would be over that ground.
    Constant(Straight),
    /// The texel at the edge, for ever.
    Clamp,
    /// The source again, as tiles.
    Repeat,
    /// The source mirrored, then again.
    Mirror,
}

impl Border {
    /// Whether the source ends somewhere.
    pub(super) fn ends(self) -> bool {
        matches!(self, Self::Transparent | Self::Constant(_))
    }

    /// The wrap of the texture. The edge of an opaque source is drawn over transparent texels, from which
    /// the share of the source in a sample can be told.
    pub(super) fn wrap(self, space: WorkingSpace, opaque: bool) -> Wrap {
        match self {
            Self::Constant(color) if !opaque => Wrap::Constant(space.import(color)),
            Self::Transparent | Self::Constant(_) => Wrap::Constant(Premul::TRANSPARENT),
            Self::Clamp => Wrap::Clamp,
            Self::Repeat => Wrap::Repeat,
            Self::Mirror => Wrap::Mirror,
        }
    }
}

/// Standard deviations to a pixel: the pixel is a Gaussian, σ = ½.
const SIGMAS_PER_PIXEL: f64 = 2.0;

/// How much of a pixel lies within the source, whose edges are taken for straight lines there.
#[derive(Debug, Clone, Copy)]
pub(super) struct Edge {
    /// Columns and rows of the source.
    size: [f64; 2],
    pixel: Pixel,
}

/// What a pixel is.
#[derive(Debug, Clone, Copy)]
enum Pixel {
    /// A Gaussian, whose part beyond its cut, `tail`, counts for nothing.
    Gaussian { tail: f64 },
    /// A square.
    Square,
}

impl Edge {
    pub(super) fn new([width, height]: [usize; 2], sampler: &Sampler) -> Self {
        let square = sampler.kernel == Kernel::Box
            && sampler.pixel == PixelFilter::Ewa
            && !matches!(sampler.magnify, Magnify::Radial(_));
        // A NaN becomes the lower bound.
        let radius = f64::from(sampler.radius.max(2.0)).min(4.0);
        let gaussian = Pixel::Gaussian { tail: 1.0 - normal(radius) };
        let pixel = if square { Pixel::Square } else { gaussian };
        Self { size: [width as f64, height as f64], pixel }
    }

    /// The share, 0…1.
    ///
    /// Exact for one edge, and for two that meet where the map keeps right angles.
    pub(super) fn coverage(&self, f: &Footprint) -> f64 {
        let j = &f.jacobian;
        let [width, height] = self.size;
        self.between(f.u, width, j.a, j.b) * self.between(f.v, height, j.c, j.d)
    }

    /// The share between two lines, at 0 and at `size`, of a coordinate that is `at` in the pixel's middle
    /// and grows by (dx, dy) for each pixel.
    fn between(&self, at: f64, size: f64, dx: f64, dy: f64) -> f64 {
        let slope = (dx * dx + dy * dy).sqrt() * (1.0 / SIGMAS_PER_PIXEL);
        if slope > 0.0 {
            let below = |distance: f64| match self.pixel {
                Pixel::Gaussian { tail } => gaussian_below(distance / slope, tail),
                Pixel::Square => square_below(distance, dx, dy),
            };
            (below(at) + below(size - at) - 1.0).max(0.0)
        } else {
            f64::from(u8::from(at > 0.0 && at < size))
        }
    }
}

/// The share of the Gaussian, cut and of integral 1, below z standard deviations.
fn gaussian_below(z: f64, tail: f64) -> f64 {
    within_unit((normal(z) - tail) / (1.0 - 2.0 * tail))
}

/// The share of the pixel's square below a line, of a coordinate that is `distance` above its middle and grows
/// by (dx, dy) for each pixel: of the sum of two numbers, each of which is anywhere in its range as likely.
fn square_below(distance: f64, dx: f64, dy: f64) -> f64 {
    let (long, short) = (dx.abs().max(dy.abs()), dx.abs().min(dy.abs()));
    let beyond = (0.5 * (long + short) - distance.abs()).max(0.0);
    // As long as the line cuts both of the longer sides, what is beyond grows evenly.
    let share = if beyond < short {
        0.5 * (beyond / short) * (beyond / long)
    } else {
        0.5 - distance.abs() / long
    };
    within_unit(if distance < 0.0 { share } else { 1.0 - share })
}

/// Brought within 0…1, a NaN to 0.
fn within_unit(share: f64) -> f64 {
    if share > 0.0 { share.min(1.0) } else { 0.0 }
}

/// The normal distribution Φ(z), to 1.5·10⁻⁷ (Abramowitz and Stegun 26.2.19).
fn normal(z: f64) -> f64 {
    const C: [f64; 6] = [
        0.049_867_347_0,
        0.021_141_006_1,
        0.003_277_626_3,
        0.000_038_003_6,
        0.000_048_890_6,
        0.000_005_383_0,
    ];
    let x = z.abs().min(9.0);
    let p = 1.0 + x * C.iter().rev().fold(0.0, |sum, c| sum * x + c);
    let (p2, one) = (p * p, 1.0);
    let p4 = p2 * p2;
    let p8 = p4 * p4;
    let half = 0.5 / (p8 * p8);
    if z < 0.0 { half } else { one - half }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::Matrix2;

    #[test]
    fn the_distribution_is_as_exact_as_stated() {
        // ∫ by midpoints.
        let (mut sum, step) = (0.5, 1e-4);
        for i in 0..40_000 {
            let z = (f64::from(i) + 0.5) * step;
            sum += step * (-0.5 * z * z).exp() / (2.0 * std::f64::consts::PI).sqrt();
            let (above, below) = (normal(z + 0.5 * step), normal(-z - 0.5 * step));
            assert!((above - sum).abs() < 1.6e-7 && (above + below - 1.0).abs() < 1e-15, "{z}");
        }
        assert_eq!(normal(f64::INFINITY), 1.0 - normal(f64::NEG_INFINITY));
    }

    fn coverage(u: f64, v: f64, jacobian: Matrix2) -> f64 {
        Edge::new([10, 20], &Sampler::DEFAULT).coverage(&Footprint { u, v, jacobian })
    }

    #[test]
    fn coverage_is_a_half_on_an_edge_and_a_quarter_on_a_corner_at_any_scale() {
        for scale in [1e-3, 0.1, 1.0] {
            let j = Matrix2::new(scale, 0.0, 0.0, scale);
            assert!((coverage(0.0, 10.0, j) - 0.5).abs() < 1e-12);
            assert!((coverage(10.0, 20.0, j) - 0.25).abs() < 1e-12);
            assert_eq!(coverage(5.0, 10.0, j), 1.0);
            assert_eq!(coverage(-1.6 * scale, 10.0, j), 0.0);
        }
    }

    #[test]
    fn of_a_square_it_is_the_area_within() {
        let sampler = Sampler { kernel: Kernel::Box, ..Sampler::DEFAULT };
        let edge = Edge::new([10, 20], &sampler);
        for i in 0..60 {
            let at = |k: f64| (f64::from(i) * k) % 1.0;
            let j = Matrix2::new(4.0 * at(0.37) - 2.0, 3.0 * at(0.71) - 1.5, 0.0, 0.2);
            let f = Footprint { u: 3.0 * at(0.618) - 1.0, v: 9.0, jacobian: j };
            let part = |k: i32| (f64::from(k) + 0.5) / 400.0 - 0.5;
            let inside = |y: i32| {
                (0..400).filter(|x| f.u + j.a * part(*x) + j.b * part(y) > 0.0).count() as f64
            };
            let truth = (0..400).map(inside).sum::<f64>() / 160_000.0;
            assert!((edge.coverage(&f) - truth).abs() < 3e-3, "{f:?}: {truth}");
        }
        assert_eq!(
            edge.coverage(&Footprint { u: 0.0, v: 20.0, ..Footprint::point(0.0, 0.0) }),
            0.0
        );
        for v in [0.0, -1.0, 1e300, f64::INFINITY, f64::NAN] {
            for j in [0.0, 1e-300, 1e300, f64::NAN, f64::INFINITY] {
                let jacobian = Matrix2::new(j, 0.0, j, j);
                let share = edge.coverage(&Footprint { u: v, v: 3.0, jacobian });
                assert!((0.0..=1.0).contains(&share), "{v} {j}: {share}");
            }
        }
    }

    #[test]
    fn any_footprint_has_a_share() {
        for v in [0.0, 1.0, -1e300, f64::INFINITY, f64::NAN] {
            for j in [0.0, 1e-300, 1e300, f64::NAN, f64::INFINITY] {
                let share = coverage(v, 3.0, Matrix2::new(j, 0.0, j, j));
                assert!((0.0..=1.0).contains(&share), "{v} {j}: {share}");
            }
        }
        // The whole source in a hundredth of a pixel.
        let tiny = coverage(5.0, 10.0, Matrix2::new(1000.0, 0.0, 0.0, 2000.0));
        // A density of 2/π at the peak, over 0.01 by 0.01 pixel.
        assert!((tiny / (2.0 / std::f64::consts::PI * 1e-4) - 1.0).abs() < 0.02, "{tiny}");
    }
}
