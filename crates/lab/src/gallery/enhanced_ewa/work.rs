//! What bounds the work, what hides the change of kernel, and where the texels go.

use super::methods::psnr;
use crate::gallery::ink::{BLUE, RED, codes, finish, heat_color, part, rgb, shown};
use crate::gallery::{Drawn, Picture};
use crate::math::smoothstep;
use crate::views::{self, HEIGHT, View, WIDTH};
use scumble::texture::{Kernel, LevelMode, Magnify, PixelFilter, Sampler};
use scumble_geometry::{DVec2, Rect};
use scumble_pixel::{Image, Straight};
use scumble_sheet::{Anchor, Cell, Drawing, INK, contact_sheet};

const fn bounded(max_eccentricity: f32) -> Sampler {
    Sampler { max_eccentricity, ..Sampler::CLASSIC }
}

/// Texels for each pixel of a view, 0 where no surface is; and their mean where one is.
fn cost(view: &View, s: &Sampler) -> (Vec<usize>, f64) {
    let texels = view.each(0, |t, f| t.cost(f, s));
    let count = texels.iter().filter(|n| **n > 0).count().max(1);
    let mean = texels.iter().sum::<usize>() as f64 / count as f64;
    (texels, mean)
}

pub(super) fn clamp() -> Drawn {
    let view = views::grazing()?;
    let free = view.draw(&bounded(1024.0));
    let mut cells = Vec::new();
    for (ratio, name) in [(4.0, "4"), (8.0, "8"), (16.0, "16"), (30.0, "30"), (1024.0, "no bound")]
    {
        let s = bounded(ratio);
        let colors = view.draw(&s);
        let mut words = format!("{name}: {:.0} texels", cost(&view, &s).1);
        if ratio < 1000.0 {
            words += &format!(", {:.0} dB", psnr(&colors, &free));
        }
        cells.push(Cell::new(part(&shown(&colors)?, [56, 0, 144, 60]), [words]));
    }
    finish(contact_sheet(&cells, 3, 2))
}

/// How magnified a pixel is by its longer half-axis: 1 where wholly, 0 where not at all.
fn magnified(view: &View) -> Vec<f64> {
    view.each(0.0, |_, f| 1.0 - smoothstep(0.75, 1.5, f.jacobian.axes().major))
}

/// The part of the view where one kernel gives way to the other.
const SEAM: [usize; 4] = [112, 96, 144, 90];

pub(super) fn transition() -> Drawn {
    let view = views::lettering()?;
    let alone = |kernel| Sampler { kernel, magnify: Magnify::None, ..Sampler::CLASSIC };
    let sharp = view.draw(&alone(Kernel::Lanczos2));
    let soft = view.draw(&alone(Kernel::Triangle));
    let near = magnified(&view);
    let pixel = |k: usize| if near[k] > 0.5 { sharp[k] } else { soft[k] };
    let switched: Vec<[f64; 3]> = (0..near.len()).map(pixel).collect();
    let blended = view.draw(&Sampler::CLASSIC);
    let apart: Vec<[f64; 3]> = (0..near.len())
        .map(|k| [0, 1, 2].map(|c| 1.0 - 16.0 * (switched[k][c] - blended[k][c]).abs()))
        .collect();
    let mut cells = Vec::new();
    for (colors, words) in [
        (&sharp, "Lanczos 2 alone"),
        (&soft, "the triangle alone"),
        (&switched, "switched"),
        (&blended, "blended"),
    ] {
        cells.push(Cell::new(part(&shown(colors)?, SEAM), [words]));
    }
    cells.push(Cell::new(part(&weights(&near)?, SEAM), ["which: blue Lanczos, red triangle"]));
    cells.push(Cell::new(part(&shown(&apart)?, SEAM), ["switched less blended, ×16"]));
    finish(contact_sheet(&cells, 3, 2))
}

/// From red to blue by how magnified a pixel is.
fn weights(near: &[f64]) -> Drawn {
    let color = |&k: &f64| {
        let part = k as f32;
        codes(Straight(std::array::from_fn(|c| RED.0[c] + (BLUE.0[c] - RED.0[c]) * part)))
    };
    Ok(Image::from_vec(WIDTH, HEIGHT, near.iter().map(color).collect())?)
}

/// Octaves of the legend: 2 to 4 texels, 4 to 8, and so on.
const OCTAVES: u32 = 11;

fn octave_color(texels: usize) -> Straight {
    if texels == 0 {
        return rgb(0xbfd4e0);
    }
    heat_color(f64::from(texels.ilog2()) / f64::from(OCTAVES))
}

pub(super) fn texels() -> Drawn {
    let view = views::diagonal()?;
    let methods = [
        ("trilinear", Sampler::DEFAULT.with(PixelFilter::Bilinear, LevelMode::Linear)),
        ("enhanced EWA", Sampler::CLASSIC),
        ("default", Sampler::DEFAULT),
    ];
    let mut cells = Vec::new();
    for (name, s) in methods {
        let (texels, mean) = cost(&view, &s);
        let pixels = texels.iter().map(|&n| codes(octave_color(n))).collect();
        let picture: Picture = Image::from_vec(WIDTH, HEIGHT, pixels)?;
        cells.push(Cell::new(picture, [format!("{name}: {mean:.0} on average")]));
    }
    let sheet = contact_sheet(&cells, 3, 1);
    let mut drawing = Drawing::new(sheet.width(), sheet.height() + 34);
    drawing.picture(finish(sheet)?, 0, 0, 1);
    for octave in 1..=OCTAVES {
        let x = 12.0 + 66.0 * f64::from(octave - 1);
        let y = f64::from(drawing.height()) - 26.0;
        let color = octave_color(1 << octave);
        drawing.rect(Rect::new(x, y, x + 20.0, y + 14.0), color);
        let at = DVec2::new(x + 25.0, y + 12.0);
        let more = if octave == OCTAVES { " and more" } else { "" };
        let words = format!("{}{more}", 1_u32 << octave);
        drawing.text(at, 13.0, Anchor::Start, &words, INK);
    }
    finish(drawing)
}
