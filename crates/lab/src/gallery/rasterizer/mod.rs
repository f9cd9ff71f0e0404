//! The pictures of a student's write-up of a rasterizer: edges, transforms, textures.

mod corners;
mod edges;
mod textures;
mod work;

use super::{Figure, Page};

pub(super) const PAGE: Page = Page {
    name: "rasterizer",
    title: "A rasterizer: edges, transforms, textures",
    intro: "After Simon Xie's write-up \"My Tiny Rasterizer\" (18 February 2025), task by task. Its own scenes \
            are not ours to show; those here are from `assets/scenes`, of the same kind. Where it errs is \
            said under the picture concerned, and in the [errata](../errata.md); how long things take is \
            on the page on [performance](../performance.md).",
    figures: &FIGURES,
};

const FIGURES: [Figure; 11] = [
    Figure {
        name: "work",
        title: "Which pixels are looked at",
        look: "One triangle by its bounding box, by scanlines and by blocks of 8×8. Red pixels are covered, yellow \
               ones were tested for nothing, green ones belong to a block that was accepted whole. \
               Scanlines test no pixel: they compute where a row begins and ends, from the crossings of \
               its samples' lines with the edges. The write-up takes the edges at a row's upper and lower \
               border; a corner between the two needs looking at as well.",
        draw: work::looked_at,
    },
    Figure {
        name: "wedge",
        title: "A corner between two borders",
        look: "A triangle within one row of pixels, with sixteen samples to each. Where the row begins and where it ends \
               the triangle is nothing wide (green): a row's reach taken from there, as in the write-up, \
               would find none of the red samples, which are those that it covers.",
        draw: corners::wedge,
    },
    Figure {
        name: "samples",
        title: "1, 4, 9 and 16 samples",
        look: "A corner, and needles that close to nothing, four times enlarged. With one sample the needles \
               are dashes; with sixteen they fade as they get thinner. The write-up calls this MSAA and \
               says that N samples cost N times the time. What it describes is supersampling, which shades \
               each sample, and that does; multisampling tests N times and shades once.\n\n\
               `scumble compare assets/scenes/thin.svg -o sheet.png --vary samples=1/4/9/16 --pattern grid \
               --crop 236,130,56,42 --scale 4 -w 400 -H 400`",
        draw: edges::samples,
    },
    Figure {
        name: "degenerate",
        title: "Degenerate triangles",
        look: "A mesh of slivers with red triangles of no area on its edges, and two fans of 360 needles, by 1 \
               and 16 samples. Nothing red may show, no white between the needles, and nothing does: \
               each sample belongs to one of the triangles that share an edge, by whole numbers.",
        draw: edges::degenerate,
    },
    Figure {
        name: "barycentric",
        title: "The weights of three corners",
        look: "Two ways to see what a corner's colour weighs at P. Left, by distances from the side across: as far \
               as P is from BC, over as far as A is. Right, by areas: the triangle across from A, over the whole. \
               Both are the same number, and the three add up to 1.",
        draw: corners::weights,
    },
    Figure {
        name: "scenes",
        title: "Thin triangles, a cube, a robot, a wheel, a quad",
        look: "Above by one sample a pixel, needles and flat triangles in perspective: every edge is a stair. Below by \
               sixteen: one box, placed some twenty times by nested transforms; colours blended between the \
               corners of triangles by their barycentric coordinates; and a picture brought to four points, which \
               is a homography.",
        draw: edges::scenes,
    },
    Figure {
        name: "interpolation",
        title: "Interpolation under perspective, wrong and right",
        look: "Left, each of the two triangles of a quad is interpolated linearly on the screen: the picture \
               bends at the diagonal. Right, the pixel is taken back to the plane first.\n\n\
               `scumble compare assets/scenes/quad.svg -o sheet.png --vary interpolate`",
        draw: edges::interpolation,
    },
    Figure {
        name: "nearest_and_bilinear",
        title: "Nearest, bilinear and EWA, by 1 and 16 samples",
        look: "Part of a map, three times enlarged. Nearest texels break thin lines; between four texels they \
               hold together; the ellipse sees all that a pixel sees, which here is a little more, and no line breaks. More samples smooth only where triangles end, since a pixel is shaded once \
               however many samples it has (`--shade sample` shades each).\n\n\
               `scumble compare assets/scenes/map.svg -o sheet.png --vary samples=1/16,pixel=nearest/bilinear/ewa \
               --level zero --pattern grid --crop 268,210,90,70 --scale 3`",
        draw: textures::nearest_and_bilinear,
    },
    Figure {
        name: "pixel_and_level",
        title: "Ways to read a pixel, ways to choose a level",
        look: "Across: nearest, bilinear, EWA. Down: level zero, the nearest level, between two levels. Look at the \
               far end of the plane and at the top of the block. Level zero is noise but where EWA reads it, \
               which sees all of a pixel's texels by itself and takes its time, up to a bound that the horizon \
               goes beyond. A level chosen by the longer side of the footprint cures the noise and smears \
               what is seen at a slant, whoever reads it. The last picture is EWA with the level that suits \
               it, by the shorter side: neither noise nor smear.\n\n\
               `scumble compare assets/scenes/ground.svg -o sheet.png \
               --vary level=zero/nearest/linear,pixel=nearest/bilinear/ewa --crop 300,190,290,160`",
        draw: textures::pixel_and_level,
    },
    Figure {
        name: "levels",
        title: "Which level where",
        look: "A plane of texels to its horizon. Each colour is one level of the pyramid, by L = log₂ of the larger \
               of the lengths of (du/dx, dv/dx) and (du/dy, dv/dy), in texels: a pixel that covers 8×8 texels \
               reads level 3. The write-up leaves out the logarithm and takes u and v in 0…1, which gives \
               level 0 everywhere.",
        draw: textures::levels,
    },
    Figure {
        name: "memory",
        title: "What it costs in memory",
        look: "A map of 1024×512 texels and its pyramid, the levels from 256×128 on, to scale. Each is a \
               quarter of the one before: 1 + ¼ + 1/16 + … = 4/3 of the texture, and not the 2 that the \
               write-up has. Samples are not kept for the frame but for the tiles at work, 64×64 pixels each.\n\n\
               | | the write-up | Scumble |\n\
               |---|---|---|\n\
               | ways to read a pixel | nothing more | nothing more |\n\
               | the pyramid of a texture of 1024×512 | twice the texture | 4/3: 5.6 MB at 8 bytes a texel |\n\
               | 16 samples, 800×600 | 16 times the picture: 123 MB at 16 bytes a sample | the tiles at work: \
               at worst 1.2 MB a thread, 80 kB where the samples of a pixel are alike |\n\n\
               What these take in time is on the page on [performance](../performance.md).",
        draw: textures::memory,
    },
];
