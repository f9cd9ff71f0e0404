//! Rows of probes on textures.

use crate::gallery::ellipses::{Columns, matrix};
use crate::gallery::ink::{finish, heat_map, part, shown};
use crate::gallery::{Drawn, GalleryError, Picture};
use crate::views::{self, View};
use scumble::texture::compare::vulkan_anisotropic;
use scumble::texture::{Footprint, LevelMode, PixelFilter, Sampler, Texture, TextureOptions};
use scumble_geometry::DVec2;
use scumble_pixel::Image;
use scumble_sheet::{Cell, contact_sheet};

const TRILINEAR: Sampler = Sampler::DEFAULT.with(PixelFilter::Bilinear, LevelMode::Linear);

/// At most ⌈2a − 1⌉ probes for an axis ratio a.
const fn probes(most: u32) -> Sampler {
    let max_eccentricity = (most as f32 + 1.0) / 2.0;
    Sampler { max_eccentricity, ..Sampler::DEFAULT.with(PixelFilter::Probes, LevelMode::Auto) }
}

/// Texels along each side of the square whose weights are shown.
const SIDE: usize = 32;

/// How much of each texel of that square is in the colour of a footprint about its middle.
fn response(f: &Footprint, s: &Sampler) -> Result<Vec<f32>, GalleryError> {
    // In the middle of a larger texture, so that coarse levels do not come round.
    const MARGIN: usize = 16;
    let f = Footprint { u: f.u + MARGIN as f64, v: f.v + MARGIN as f64, ..*f };
    let weight = |index: usize| {
        let lit = (index % SIDE + MARGIN, index / SIDE + MARGIN);
        let image = Image::from_fn(SIDE + 2 * MARGIN, SIDE + 2 * MARGIN, |x, y| {
            if (x, y) == lit { [255; 4] } else { [0, 0, 0, 255] }
        })?;
        Ok(Texture::new(image.view(), &TextureOptions::default())?.sample(&f, s).0[0])
    };
    (0..SIDE * SIDE).map(weight).collect()
}

pub(super) fn weights() -> Drawn {
    const TEXEL: usize = 9;
    // Ten texels long, a little over one wide.
    let columns: Columns = [DVec2::new(9.0, 4.0), DVec2::new(1.2, 1.7)];
    let f = Footprint { u: 16.2, v: 15.9, jacobian: matrix(columns) };
    let ways = [
        (TRILINEAR, "trilinear"),
        (probes(4), "4 probes"),
        (probes(16), "16 probes"),
        (Sampler::DEFAULT, "the ellipse"),
    ];
    let mut cells = Vec::new();
    for (s, words) in ways {
        let weights = response(&f, &s)?;
        let most = weights.iter().fold(f32::MIN_POSITIVE, |a, &b| a.max(b));
        let picture = heat_map(SIDE, TEXEL, |x, y| f64::from(weights[y * SIDE + x] / most))?;
        cells.push(Cell::new(picture, [words]));
    }
    finish(contact_sheet(&cells, 2, 1))
}

/// The view by the formulas of the Vulkan specification.
fn vulkan(view: &View, most: u32) -> Drawn {
    let color = |t: &Texture, f: &Footprint| {
        let [r, g, b, _] = vulkan_anisotropic(t, f, most).0;
        [r, g, b].map(f64::from)
    };
    shown(&view.each(view.background, color))
}

pub(super) fn room() -> Drawn {
    let view = views::room()?;
    let by = |s: &Sampler| shown(&view.draw(s));
    let cells = [
        Cell::new(by(&TRILINEAR)?, ["trilinear"]),
        Cell::new(vulkan(&view, 2)?, ["2 along the longer column"]),
        Cell::new(vulkan(&view, 4)?, ["4"]),
        Cell::new(vulkan(&view, 16)?, ["16"]),
        Cell::new(by(&probes(16))?, ["16 probes along the axis"]),
        Cell::new(by(&Sampler::DEFAULT)?, ["the ellipse"]),
    ];
    finish(contact_sheet(&cells, 3, 1))
}

pub(super) fn tilted() -> Drawn {
    let mut cells = Vec::new();
    for (view, crop) in
        [(views::diagonal()?, [56, 24, 144, 80]), (views::tilted()?, [56, 24, 144, 80])]
    {
        let cut = |picture: Picture| part(&picture, crop);
        cells.push(Cell::new(cut(vulkan(&view, 16)?), ["16 along the longer column"]));
        cells.push(Cell::new(cut(shown(&view.draw(&probes(16)))?), ["16 probes along the axis"]));
        cells.push(Cell::new(cut(shown(&view.draw(&Sampler::DEFAULT))?), ["the ellipse"]));
    }
    finish(contact_sheet(&cells, 3, 2))
}
