//! The pictures of a paper on enhanced EWA filtering.

mod bounds;
mod kernels;
mod methods;
mod work;

use super::{Figure, Page};

pub(super) const PAGE: Page = Page {
    name: "enhanced_ewa",
    title: "Enhanced EWA",
    intro: "After Kalle Rutanen, \"Enhanced EWA filtering\" (3 March 2009), its figures 1 to 6 with scenes of our \
            own, and what its text describes. The four methods are the paper's: none is the nearest texel; \
            trilinear; EWA with a Gaussian of radius 1, as Heckbert had it; and the enhanced method, a triangle \
            of radius 1 for what is minified and Lanczos 2 for what is magnified, axis ratios to 30, two levels \
            everywhere (`--quality classic`, `Sampler::CLASSIC`). The fifth picture is what Scumble does \
            by default. Decibels are against `Sampler::REFERENCE`, which has a Gaussian pixel: a triangle loses \
            some for being another filter. Where the paper \
            errs is in the [errata](../errata.md), and how far each method is from brute force on the page on \
            [quality](../quality.md).",
    figures: &FIGURES,
};

const FIGURES: [Figure; 12] = [
    Figure {
        name: "aliasing",
        title: "Figure 1: aliasing, and none",
        look: "A checkerboard to the horizon, the nearest texel and the enhanced method. What is finer than the \
               pixels cannot be shown; without a filter it turns into patterns that are not there.",
        draw: methods::aliasing,
    },
    Figure {
        name: "diagonal",
        title: "Figure 2: footprints aslant in the texture",
        look: "The board turned by 44°, so that what a pixel sees of it lies along neither axis. Trilinear \
               filtering does prevent aliasing (the paper says \"antialiasing\"), and blurs; the ellipses \
               keep the squares much farther out.",
        draw: methods::diagonal,
    },
    Figure {
        name: "frequencies",
        title: "Figure 3: high frequencies",
        look: "Rings as fine as texels can be, repeated to the horizon and turned. True are those about the middle \
               of each tile. All others are false: the nearest texel is full of them, the enhanced method \
               keeps faint ones.",
        draw: methods::frequencies,
    },
    Figure {
        name: "ordinary",
        title: "Figure 4: an ordinary view",
        look: "Not much is fine here, and without a filter it looks acceptable at first sight; in motion it would not. \
               Trilinear loses the tiles' far end and the bricks.",
        draw: methods::ordinary,
    },
    Figure {
        name: "magnified",
        title: "Figure 5: isotropic magnification",
        look: "32×32 texels, seven times up and turned. Nearest shows the texels, trilinear (bilinear here) the lines \
               between them; the Gaussian of radius 1 is soft and ragged; Lanczos 2 is sharp and has halos; our \
               default is trilinear's lines seen through a pixel, and has none. `--magnify` has the choice.",
        draw: methods::magnified,
    },
    Figure {
        name: "cut",
        title: "Figure 6: a Gaussian cut too soon",
        look: "The mast and the jib of the same picture, four times enlarged. A Gaussian of radius 1 ends where it \
               still has 13.5 per cent of its height. As the circle moves over the texels they come in and go out \
               at that height: the mast is dotted, edges are ragged.",
        draw: methods::cut,
    },
    Figure {
        name: "kernels",
        title: "The kernels",
        look: "Weight over the distance from the middle. Red: e^(−2x²) cut at 1, with its step of e^(−2) = 13.5 per cent; \
               the paper gives its variance as 0.5, and it is ¼: σ = ½. Green: the triangle. Blue: \
               Lanczos 2. Purple: the Gaussian as Scumble cuts it, at 1.54, where it has 0.9 per cent.",
        draw: kernels::plot,
    },
    Figure {
        name: "box",
        title: "The bounding box, as derived and as printed",
        look: "The paper derives that the box's half-widths are the roots of the entries of S⁻¹, √(d/(ad − b²)) and \
               √(a/(ad − b²)) (red). Its example in §6.1 has √d/(ad − b²) and √a/(ad − b²) (purple), which is that \
               times the ellipse's area over π: ⅛ instead of ½ for the circle of radius ½, and too much \
               for an ellipse of more than π texels.",
        draw: bounds::printed_box,
    },
    Figure {
        name: "rows",
        title: "The texels of an ellipse",
        look: "One ellipse by its bounding box, as the paper visits it, and by rows, as Scumble does. Red texels are in \
               the ellipse, yellow ones were visited for nothing. A row's run begins and ends where the \
               ellipse does; the longer and the more aslant it is, the more that saves.",
        draw: bounds::walks,
    },
    Figure {
        name: "clamp",
        title: "The clamp: axis ratios to 4, 8, 16, 30 and without bound",
        look: "The far part of a plane at a grazing angle by the enhanced method, twice enlarged. Beyond the bound the minor axis is widened: \
               the distance turns grey sooner, and nothing aliases. The numbers are the decibels against no bound, and \
               the texels in the boxes of an ellipse, on average over the plane. 30 is what the paper \
               recommends; between that and none there is nothing to see but the work.",
        draw: work::clamp,
    },
    Figure {
        name: "transition",
        title: "From magnified to minified",
        look: "A plane that is magnified near by and minified far off, where the one turns into the other, twice \
               enlarged. Lanczos 2 is sharp near by, and has no business far off; the triangle is for the \
               distance, and soft near by. Switched where the longer half-axis is 1.06 \
               texels a pixel, there is a line across the picture where sharp lines turn soft; blended between \
               0.75 and 1.5, none. Blue is magnified, red minified. The last is sixteen times the difference \
               between switched and blended.",
        draw: work::transition,
    },
    Figure {
        name: "texels",
        title: "Texels for a pixel",
        look: "How many texels are read for each pixel of the plane of figure 2, in steps of an octave, by trilinear, \
               by the enhanced method and by Scumble's default, with the mean over the plane. With a pyramid \
               the distance is of no account: only the ratio of the axes is, up to its bound. The enhanced \
               method reads whole boxes in two levels everywhere. The default reads rows in one, and in two just \
               before a switch of level, which are the darker bands.",
        draw: work::texels,
    },
];
