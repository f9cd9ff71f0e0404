//! The pictures of a page about anisotropic filtering in a shader.

mod grid;
mod jacobians;
mod printed;
mod probes;
mod wave;

use super::{Figure, Page};

pub(super) const PAGE: Page = Page {
    name: "anisotropic",
    title: "Anisotropic filtering in software",
    intro: "After \"A technique for software anisotropic filtering\" (web page, April 2024): how to draw an \
            endless grid of lines on the ground, and how hardware's anisotropic filter can be had where there \
            is no texture to filter. The method is called EWA there; it is *footprint assembly*, a row \
            of samples along the long axis of the ellipse that a pixel sees. The signs in its listing are \
            shown below, and all that errs is in the [errata](../errata.md). The grid is \
            `scumble_texture::procedural::Grid`, the row of samples `scumble_texture::Probes`.",
    figures: &FIGURES,
};

const FIGURES: [Figure; 9] = [
    Figure {
        name: "wave",
        title: "A distance, and an alpha made of it",
        look: "Across the lines of a grid, 2 apart and 0.4 wide. Green: the signed distance to the nearest edge \
               of a line, a saw wave. Purple: clamp(½ − distance/pixel), the alpha that the page makes of it. \
               Red: how much of a pixel the lines cover. Where a pixel is narrower than lines and gaps both are \
               the same. At 0.5 it is wider than a line: the alpha's tip is too high. At 3, where a pixel \
               always sees more than one line, the alpha has nothing to do with what is covered; the wider \
               the pixel, the nearer it comes to ½ everywhere.",
        draw: wave::waves,
    },
    Figure {
        name: "mean",
        title: "What becomes of it in the distance",
        look: "The mean alpha of a grid of lines 2 apart and 0.05 wide, over the width of a pixel in the same \
               unit. The lines cover 0.049 of the ground, however far off it is. The clamped distance \
               makes it 0.497 where a pixel is 100 wide.",
        draw: wave::means,
    },
    Figure {
        name: "grid",
        title: "The grid, nine ways",
        look: "Lines 2 apart and 0.1 wide, to the horizon, with the error of each picture (rms, in codes of 255). \
               Isotropic: one width of a pixel for both families of lines, its longer one. Clamped: the width \
               across the line in question. Then the page's method: a row of samples of the isotropic \
               alpha along the long axis, 2 to 16 of them; each is round and as small as so many can be. \
               Far away all of these are too dark, as the alpha tends to ½. The integral of the square wave over \
               the pixel needs no row of samples and is right at every distance (where lines of \
               both families cross within a pixel it takes them for independent). The last is the mean of \
               576 points a pixel.",
        draw: grid::nine,
    },
    Figure {
        name: "jacobians",
        title: "Columns are not axes",
        look: "What can be dragged about on the page, as a strip: one column of the Jacobian stays (red), the other \
               (green) turns towards it. The circle is the pixel, the ellipse its image; axes in blue and \
               orange. Below each the ratio of the columns' lengths and that of the axes: only where the \
               columns are at right angles are they the same. Chosen by the columns, samples would be too \
               few and along the wrong way.",
        draw: jacobians::strip,
    },
    Figure {
        name: "signs",
        title: "Two signs and a zero",
        look: "The axes by the page's listing, for four Jacobians: black is the ellipse as it is, dots are eight \
               samples along the axis that was found, blue where it is right and red where it is not. First row, as printed: sin θ is never negative, so an \
               ellipse that leans to one side is right and one that leans to the other is mirrored; and at \
               45° t = sign(p)·√… is sign(0) = 0, and the ellipse counts as a circle. \
               Second row: sin θ with the sign of B/t, and B = +2(…) as printed, which is wrong wherever an \
               ellipse leans. Third: with B = −2(…), and sign(0) = 1.",
        draw: jacobians::signs,
    },
    Figure {
        name: "wrong_axis",
        title: "The same on a plane",
        look: "Squares on a plane, aslant, by up to 16 trilinear samples along the axis as printed and along the \
               right one, three times enlarged. Left of the middle ellipses lean to one side of the texture's diagonal, \
               right of it to the other: one half is as good as it will be, the other is blurred \
               across and has false bands along. Below, four times the difference.",
        draw: printed::on_a_plane,
    },
    Figure {
        name: "weights",
        title: "What each texel weighs",
        look: "One long footprint, and how much of each texel is in the result: trilinear by the longer \
               column; rows of 4 and 16 probes (`PixelFilter::Probes`); the ellipse. The weights are \
               measured, with a picture of one white texel for each. A row of round spots is an ellipse with \
               the ends of a sausage and the grain of the pyramid.",
        draw: probes::weights,
    },
    Figure {
        name: "room",
        title: "Isotropic and anisotropic",
        look: "A room by trilinear filtering; by the formulas of the Vulkan specification with at most 2, \
               4 and 16 samples (equal weights, along the longer *column*); by at most 16 probes along the true \
               axis; and by the ellipse. Look at the floor's far end, the wall to the left and the picture \
               on the wall to the right, which is seen nearly edge-on.",
        draw: probes::room,
    },
    Figure {
        name: "turned",
        title: "Where columns and axes part",
        look: "The far part of a plane of squares that lies aslant, twice enlarged. With 16 samples along \
               the longer column most of it is fine, as the columns are nearly axes when the eye is level. \
               With the eye tilted sideways (below) they are not, and the columns' way blurs what the \
               axes keep. Right, the ellipse.",
        draw: probes::tilted,
    },
];
