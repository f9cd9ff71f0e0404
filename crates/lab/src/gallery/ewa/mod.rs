//! The pictures of a derivation of the elliptical weighted average.

mod footprints;
mod spans;
mod weights;

use super::{Figure, Page};

pub(super) const PAGE: Page = Page {
    name: "ewa",
    title: "The elliptical weighted average",
    intro: "After Simon Xie's \"Mathematical Derivation of EWA Filtering\" (19 February 2025): what a pixel sees of a \
            texture, and how to average it. The idea is right and well told; the matrices and the listing \
            have slips that matter, which are shown here and listed in the [errata](../errata.md). \
            J is the Jacobian ∂(u, v)/∂(x, y), in texels per pixel.",
    figures: &FIGURES,
};

const FIGURES: [Figure; 5] = [
    Figure {
        name: "spans",
        title: "Pixels see areas of unlike size and shape",
        look: "Left a screen of 24×12 large pixels over a plane, four of them marked; right the plane from above, with \
               what each of the four sees of it. The same square on the screen is small near by and long in the \
               distance, and across the line of sight it is less wide than deep.",
        draw: spans::pixels,
    },
    Figure {
        name: "footprints",
        title: "A pixel and its image in the texture",
        look: "Four Jacobians. Each pixel square becomes a parallelogram (grey) whose sides are the columns of J \
               (red and green), and the pixel's circle an ellipse. The columns are not the ellipse's axes \
               (blue): with a shear, neither is longest or shortest, and a level or a row of probes chosen \
               by them is wrong.",
        draw: footprints::strip,
    },
    Figure {
        name: "heat",
        title: "What each texel weighs",
        look: "The Gaussian pixel of the second Jacobian, over texels, with one standard deviation and two drawn as \
               ellipses: by the covariance JJᵀ/4, and by what the derivation prints, A = uₓ² + vₓ², \
               B = uₓu_y + vₓv_y, C = u_y² + v_y² in the exponent. Those are entries of JᵀJ, which is \
               transposed and not inverted: where the footprint is long the printed weights are narrow, \
               and one texel gets nearly all.",
        draw: weights::heat,
    },
    Figure {
        name: "printed",
        title: "The printed weights on a picture",
        look: "A plane of squares, at most some ten texels a pixel: bilinear; the listing with its weights as printed \
               (its texel fetch and its exponential put right, without which it *is* bilinear); the same with \
               A = (vₓ² + v_y²)/F, B = −(uₓvₓ + u_yv_y)/F, C = (uₓ² + u_y²)/F, F = (det J)². The printed \
               weights alias far away, as bilinear does, and blur near by, where the pixel is small beside \
               a texel and the inverse of it large.\n\n\
               The listing put right, without its debugging; σ² is the pixel's variance and V₀ the \
               reconstruction's, and the level is one in which the ellipse is a few texels wide:\n\n\
               ```text\n\
               Suu = σ²(uₓ² + u_y²) + V₀      Suv = σ²(uₓvₓ + u_yv_y)      Svv = σ²(vₓ² + v_y²) + V₀\n\
               F = Suu·Svv − Suv²      A = Svv/F      B = −Suv/F      C = Suu/F\n\
               for v from ⌈v₀ − R√Svv − ½⌉ to ⌊v₀ + R√Svv − ½⌋\n\
               \x20   for u from ⌈u₀ − R√Suu − ½⌉ to ⌊u₀ + R√Suu − ½⌋\n\
               \x20       Δu = u + ½ − u₀      Δv = v + ½ − v₀\n\
               \x20       weight = exp(−½(A·Δu² + 2B·Δu·Δv + C·Δv²))\n\
               \x20       color += weight · texel(wrap(u), wrap(v), level)\n\
               \x20       total += weight\n\
               color /= total\n\
               ```",
        draw: weights::printed,
    },
    Figure {
        name: "ground",
        title: "Bilinear and EWA on a plane with a block",
        look: "Above, bilinear between levels; below, EWA. From left to right the far plane, the top of the block, and \
               the near plane, twice enlarged. Far away a pixel sees more of the depth than of the width; \
               trilinear blurs both alike, and the columns melt. Near by there is nothing to choose between them.\n\n\
               `scumble compare assets/scenes/ground.svg -o sheet.png --vary pixel=trilinear/ewa \
               --crop 330,205,140,100 --scale 2`",
        draw: footprints::ground,
    },
];
