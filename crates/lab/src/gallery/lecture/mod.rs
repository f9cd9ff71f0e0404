//! The pictures of a lecture on drawing a triangle: sampling, and what goes wrong with it.

mod blurring;
mod coverage;
mod false_patterns;
mod reconstruction;
mod spectra;
mod sums;

use super::{Figure, Page};

pub(super) const PAGE: Page = Page {
    name: "lecture",
    title: "Drawing a triangle: sampling and antialiasing",
    intro: "After the slides of Stanford CS248, lecture 2, \"Drawing a Triangle\" (winter 2022): a triangle is \
            drawn by asking of points whether they lie in it, and what comes of asking too few. Where the \
            slides err is said under the picture concerned, and in the [errata](../errata.md). Spectra and \
            filters are those of `scumble-signal`, and `scumble spectrum` and `scumble filter` do the \
            same to any picture.",
    figures: &FIGURES,
};

const FIGURES: [Figure; 20] = [
    Figure {
        name: "reconstruction",
        title: "A function, sampled and reconstructed",
        look: "Above, the function in grey and five samples of it; then what the nearest sample gives for \
               every place, and what a line from sample to sample does. Below, lines through 5, 9 and 17 \
               samples. No way of joining five samples brings back the small wave that fell between them; \
               more samples do.",
        draw: reconstruction::samples,
    },
    Figure {
        name: "coverage",
        title: "Coverage at pixel centres",
        look: "A pixel belongs to the triangle if its centre does (red). To the right is what a screen makes \
               of that: squares. A corner may reach into a pixel and leave no trace, as the one to the left \
               does.",
        draw: coverage::centres,
    },
    Figure {
        name: "half_planes",
        title: "A triangle is where three half-planes meet",
        look: "For each edge the side where its function L is inside, and all three at once. With \
               Lᵢ(x, y) = dYᵢ·x − dXᵢ·y + Cᵢ the step downwards is −dXᵢ; the slides have Bᵢ = dXᵢ, which walks \
               away from the triangle. And \"inside = all three below 0\" holds for one winding: for the \
               other all are above.",
        draw: coverage::half_planes,
    },
    Figure {
        name: "shared_edges",
        title: "Whose is a sample on a shared edge?",
        look: "Six triangles about one point, their corners and edges on samples. Each dot is a sample, and \
               the number says how many triangles take it. With L ≤ 0 those on edges are drawn twice and the \
               middle six times, with L < 0 nobody draws them; by the top-left rule everyone belongs to one, \
               and those on the outer rim to one or none.",
        draw: coverage::shared_edges,
    },
    Figure {
        name: "orders",
        title: "Orders of visiting",
        look: "The covered pixels in the order in which they are found, from blue to red: by rows, there and back, row \
               by row as far as the triangle reaches, along Morton's curve and along Hilbert's. All find the same \
               pixels. The first tests the whole width of the box in each row, the third (backtrack) leaves a \
               row once it is out of the triangle, which does not show here; the last two stay near where \
               they have been, which a cache likes.",
        draw: coverage::orders,
    },
    Figure {
        name: "blocks",
        title: "Blocks of 8×8: rejected, accepted, tested",
        look: "White blocks are outside one edge whole, green ones inside all three: neither has a sample \
               tested. Only yellow ones do. Of the samples that a bounding box would test, most are decided \
               by the block; see [performance](../performance.md) for what that is worth.",
        draw: coverage::blocks,
    },
    Figure {
        name: "supersampling",
        title: "Supersampling in numbers",
        look: "One sample a pixel says yes or no. Four say 0, 25, 50, 75 or 100 per cent, and the pixel shows \
               that much of the colour. Sixteen come nearer still to the area.",
        draw: coverage::supersampling,
    },
    Figure {
        name: "jaggies",
        title: "Jaggies",
        look: "Slender spokes, three times enlarged: with one sample they are stairs, and fall to pieces where \
               they are thinner than a pixel. `scumble compare SCENE -o SHEET.png --vary samples` makes \
               such a sheet of any scene.",
        draw: false_patterns::jaggies,
    },
    Figure {
        name: "moire",
        title: "Moiré",
        look: "Rings that get finer outwards. Every third pixel of every third row, and nothing else done, \
               shows rings about centres that are not there. If what is finer than the new pixels is taken \
               away first, the outside is grey, as it should be: nothing coarser is true there.",
        draw: false_patterns::moire,
    },
    Figure {
        name: "wagon_wheel",
        title: "The wagon wheel: sampling in time",
        look: "A wheel of eight spokes turns clockwise, by 40° from picture to picture, a spoke marked red. Above, each \
               picture is of one moment: as the spokes look alike, 40° forward is 5° back, and the wheel \
               creeps the wrong way. Below, each is the mean of 48 moments over the whole time between two \
               pictures, as light adds (`scumble_framebuffer::Exposure`): the spokes melt away, and with them the false motion; what is left, the red \
               sweep, goes the right way.",
        draw: false_patterns::wagon_wheel,
    },
    Figure {
        name: "waves",
        title: "A function as a sum of waves",
        look: "Three sines and their sum, and what the Fourier transform makes of the sum: the three again, each \
               at its frequency and as high as it is.",
        draw: sums::waves,
    },
    Figure {
        name: "cosines",
        title: "A block of a picture as a sum of cosines",
        look: "Above left the 64 products of cosines, from constant to finest. Right, how much of each is in a block \
               of 8×8 pixels of a portrait, in codes of 255: most of it in the slow ones. Below, the block \
               from the first coefficient alone, from the 3, 10 and 36 slowest, and from all.",
        draw: sums::cosines,
    },
    Figure {
        name: "spectra",
        title: "Pictures and their spectra",
        look: "Left a picture, right its spectrum, 60 dB from white to black: frequency zero in the middle, and \
               of all but the last the middle half, enlarged. A constant is one point. A wave is two more, the \
               finer the farther out, and turned as it is; a product of two waves is four. A Gaussian is a Gaussian, narrow where the other is wide: exp(−r²/16²) \
               has the spectrum exp(−π²16²f²), to within 10⁻⁴ in the tests. A picture has most of everything \
               near the middle.",
        draw: spectra::pairs,
    },
    Figure {
        name: "bands",
        title: "A picture as the sum of its bands",
        look: "Below 0.03 cycles per pixel, to 0.08, to 0.2, and above, each with its spectrum; what has no \
               mean is shown about grey. The four add up to the picture again: a test holds them to 10⁻¹². \
               `scumble filter IN OUT --band-pass 0.03,0.08` makes one.",
        draw: spectra::bands,
    },
    Figure {
        name: "convolution",
        title: "Convolution by hand",
        look: "A filter of three weights goes along a signal, and at each place the products are added. The result is \
               four times as high as the signal, as the weights add up to 4; divided by that, it is the \
               signal, smoothed. At the ends a number is missing: what stands there is the border's rule.",
        draw: sums::by_hand,
    },
    Figure {
        name: "boxes",
        title: "A box is a low-pass, and a wider one a lower",
        look: "Boxes of 3, 9 and 27 pixels and a Gaussian as wide as the second: the picture blurred by each, \
               and the kernel's spectrum, 40 dB deep. As the box grows, what it lets through shrinks. It is no \
               clean low-pass: sinc has side lobes, and some fine waves come through turned over. The \
               Gaussian has none.",
        draw: spectra::boxes,
    },
    Figure {
        name: "aliases",
        title: "A frequency rises, and falls",
        look: "Grey, the wave; red, its samples, one a unit; blue, the slowest wave through them. Up to half a \
               cycle a sample both are one. Beyond, the samples tell of a slower wave, ever slower until at \
               one cycle it stands still: an alias.",
        draw: reconstruction::aliases,
    },
    Figure {
        name: "before_and_after",
        title: "Blur before sampling, not after",
        look: "The same spokes enlarged: one sample a pixel; that, blurred by a box of 3×3 pixels; and sixteen samples \
               averaged, which is a box of one pixel before sampling. Blurring after makes the stairs soft \
               and leaves them there. The numbers are the energy that no blur of the true picture \
               explains (`scumble_signal::measure::unexplained`).",
        draw: blurring::before_and_after,
    },
    Figure {
        name: "pixel_box",
        title: "Averaging a pixel is filtering by a box",
        look: "Coverage along a row of pixels across a triangle's two edges, one steep and one slanted. Grey: \
               in or out. Blue: the same convolved with a box one pixel wide. Red: the area that the \
               rasterizer finds for each pixel, which is the blue curve at the pixels' centres.",
        draw: blurring::pixel_box,
    },
    Figure {
        name: "nyquist",
        title: "How many samples are enough",
        look: "The error of a reconstruction over the rate of sampling, for waves of one to four cycles, \
               together: by the nearest sample, by lines, and by sinc. The first two only get better. Sinc \
               is exact from nine samples on: *above* twice the highest frequency. At eight, which the \
               slides' summary says is enough, the samples of sin(2π·4x) are all 0, and the error is that of \
               the whole wave.",
        draw: reconstruction::nyquist,
    },
];
