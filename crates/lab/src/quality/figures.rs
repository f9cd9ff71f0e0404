//! The pictures: one scene by four filters, side by side.

use super::QualityError;
use super::methods::TRILINEAR;
use crate::canvas::Canvas;
use crate::views::{self, HEIGHT, View, ViewError, WIDTH};
use scumble::texture::{Kernel, LevelMode, Magnify, PixelFilter, Sampler};

/// A strip of four pictures.
pub(crate) struct Figure {
    /// The file's name without its ending.
    pub(crate) name: &'static str,
    pub(crate) title: &'static str,
    /// Which picture is which.
    pub(crate) order: &'static str,
    /// What to look at.
    pub(crate) look: &'static str,
    view: fn() -> Result<View, ViewError>,
    samplers: [Sampler; 4],
}

/// White between two.
const GAP: usize = 8;

const NONE: Sampler = Sampler::DEFAULT.with(PixelFilter::Nearest, LevelMode::Zero);
const FOUR: [Sampler; 4] = [NONE, TRILINEAR, Sampler::CLASSIC, Sampler::DEFAULT];
const IN_ORDER: &str = "From left to right: nearest texel, trilinear, `classic`, `default`.";

const fn ratio(max_eccentricity: f32) -> Sampler {
    Sampler { max_eccentricity, ..Sampler::DEFAULT }
}

/// The Gaussian cut at the pixel's radius of one, as Heckbert had it.
const CUT: Sampler =
    Sampler { kernel: Kernel::Gaussian, magnify: Magnify::None, ..Sampler::CLASSIC };

pub(crate) const FIGURES: [Figure; 6] = [
    Figure {
        name: "checker",
        title: "A checkerboard in perspective",
        order: IN_ORDER,
        look: "Look at the upper third. Without a filter the squares break up into false \
               patterns; trilinear turns grey first, because it takes the longer side of the \
               footprint for both; the ellipses keep the rows apart farther out, until those, \
               too, are finer than pixels.",
        view: views::checker,
        samplers: FOUR,
    },
    Figure {
        name: "rings",
        title: "High frequencies",
        order: IN_ORDER,
        look: "Rings that get finer outwards, as fine as texels can be, several times down \
               and tilted. Only those about the middle are true. Nearest is full of false \
               ones; trilinear and `classic` keep faint ones beside the middle and below it; \
               `default` fades out with the least of them.",
        view: views::rings,
        samplers: FOUR,
    },
    Figure {
        name: "room",
        title: "An ordinary view",
        order: IN_ORDER,
        look: "Look at the tiles at the far end and at the joints of the side wall: noise without a \
               filter, a smear with trilinear, and lines as far as there are pixels for them with \
               the ellipses.",
        view: views::room,
        samplers: FOUR,
    },
    Figure {
        name: "magnified",
        title: "Isotropic magnification",
        order: IN_ORDER,
        look: "A picture of 32×32 texels, seven times up and turned. Nearest shows the texels, trilinear \
               (bilinear here) the lines between their centres, `classic` is sharp, with halos along \
               dark edges, and `default`, the same lines seen through a pixel, has none.",
        view: views::boat,
        samplers: FOUR,
    },
    Figure {
        name: "clamp",
        title: "The bound on the axis ratio",
        order: "From left to right: `default` with the axis ratio bounded to 2, 8, 32 (its own), and 1024.",
        look: "Lower bounds widen the ellipse across, so the far part turns grey sooner, and \
               never alias. Between 32 and 1024 there is hardly a difference to see, even \
               here.",
        view: views::grazing,
        samplers: [ratio(2.0), ratio(8.0), ratio(32.0), ratio(1024.0)],
    },
    Figure {
        name: "cut",
        title: "A Gaussian that is cut, magnified",
        order: "From left to right: the Gaussian cut at the radius of one (`classic` with the Gaussian \
                kernel and no filter of its own for magnification), `classic`, `default`, and `default` \
                with Catmull-Rom magnification.",
        look: "Look along the mast and the edge of the hull, enlarged. Where the ellipse is \
               no larger than a texel, texels come into it and leave it while they still have \
               weight: the mast is dotted and the edge ragged. A kernel that ends at zero, or \
               a Gaussian wide enough to do so nearly, shows none of it.",
        view: views::boat,
        samplers: [
            CUT,
            Sampler::CLASSIC,
            Sampler::DEFAULT,
            Sampler { magnify: Magnify::CatmullRom, ..Sampler::DEFAULT },
        ],
    },
];

/// Every figure with its strip.
pub(crate) fn draw() -> Result<Vec<(&'static Figure, Canvas)>, QualityError> {
    FIGURES.iter().map(|figure| Ok((figure, strip(figure)?))).collect()
}

fn strip(figure: &Figure) -> Result<Canvas, QualityError> {
    let view = (figure.view)()?;
    let pictures = figure.samplers.map(|s| view.draw(&s));
    let (width, height) = (4 * WIDTH + 3 * GAP, HEIGHT);
    Ok(Canvas::paint(width as u32, height as u32, 1, |x, y| {
        let (x, y) = (x as usize, y as usize);
        let (index, x) = (x / (WIDTH + GAP), x % (WIDTH + GAP));
        if x < WIDTH { pictures[index][y * WIDTH + x] } else { [1.0; 3] }
    }))
}
