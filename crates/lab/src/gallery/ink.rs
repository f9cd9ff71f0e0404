//! Colours, small pictures, and their way into a file.

use super::{Drawn, GalleryError, Picture};
use crate::views::{HEIGHT, WIDTH};
use png::{BitDepth, ColorType, Compression, Encoder, Filter};
use scumble::coverage::SamplePattern;
use scumble::scene::Scene;
use scumble::{Settings, render_image};
use scumble_pixel::{Image, Straight, unorm8};
use scumble_sheet::Drawing;
use std::collections::BTreeMap;

/// The colours of the figures: named for what they stand for most often.
pub(super) const RED: Straight = rgb(0xc8402a);
pub(super) const BLUE: Straight = rgb(0x2f6f9f);
pub(super) const GREEN: Straight = rgb(0x3f8f4f);
pub(super) const YELLOW: Straight = rgb(0xe3a52c);
pub(super) const PURPLE: Straight = rgb(0x7a4fa3);
pub(super) const GREY: Straight = rgb(0xa8a8a8);
pub(super) const LIGHT: Straight = rgb(0xdcdcdc);

/// `0xrrggbb`.
pub(super) const fn rgb(code: u32) -> Straight {
    Straight([channel_of(code, 16), channel_of(code, 8), channel_of(code, 0), 1.0])
}

const fn channel_of(code: u32, shift: u32) -> f32 {
    ((code >> shift) & 0xff) as f32 / 255.0
}

/// White, over yellow and red, to nearly black.
pub(super) fn heat_color(t: f64) -> Straight {
    let stops = [rgb(0xffffff), rgb(0xffe08a), rgb(0xe8793a), rgb(0xa02c3c), rgb(0x2a1030)];
    let place = t.clamp(0.0, 1.0) * 4.0;
    let index = (place.floor() as usize).min(3);
    let part = (place - index as f64) as f32;
    let (a, b) = (stops[index].0, stops[index + 1].0);
    Straight(std::array::from_fn(|i| a[i] + (b[i] - a[i]) * part))
}

/// A square of `side` texels, each `texel` pixels wide, in the colour of a number in 0…1.
pub(super) fn heat_map(side: usize, texel: usize, weight: impl Fn(usize, usize) -> f64) -> Drawn {
    Ok(Image::from_fn(side * texel, side * texel, |x, y| {
        let line = x % texel == 0 || y % texel == 0;
        let color = heat_color(weight(x / texel, y / texel));
        let [r, g, b, _] = color.0.map(|v| unorm8(if line { v * 0.93 } else { v }));
        [r, g, b, 255]
    })?)
}

/// Eight bits of a colour.
pub(super) fn codes(Straight(c): Straight) -> [u8; 4] {
    c.map(unorm8)
}

/// The picture of a drawing.
pub(super) fn finish(drawing: Drawing) -> Drawn {
    let settings = Settings::new(drawing.width(), drawing.height());
    Ok(render_image(&drawing.into_scene(), &settings)?)
}

/// A scene with so many samples a pixel, on a grid.
pub(super) fn sampled(scene: &Scene, width: u32, height: u32, samples: usize) -> Drawn {
    let mut settings = Settings::new(width, height);
    settings.pattern = SamplePattern::grid(samples)?;
    Ok(render_image(scene, &settings)?)
}

/// An opaque grey picture of a plane: 0 is black, 1 white, and what lies beyond is cut off.
pub(super) fn grey(plane: &Image<f64>) -> Picture {
    plane.map(|&v| {
        let code = unorm8(v as f32);
        [code, code, code, 255]
    })
}

/// The colours of a view as a picture.
pub(super) fn shown(colors: &[[f64; 3]]) -> Drawn {
    let pixel = |&[r, g, b]: &[f64; 3]| {
        let [r, g, b] = [r, g, b].map(|v| unorm8(v as f32));
        [r, g, b, 255]
    };
    Ok(Image::from_vec(WIDTH, HEIGHT, colors.iter().map(pixel).collect())?)
}

/// A plane by a function of the pixel's column and row.
pub(super) fn plane(
    width: usize,
    height: usize,
    value: impl Fn(f64, f64) -> f64,
) -> Result<Image<f64>, GalleryError> {
    Ok(Image::from_fn(width, height, |x, y| value(x as f64, y as f64))?)
}

/// The picture with every pixel a square of `n`.
pub(super) fn enlarged(picture: &Picture, n: usize) -> Drawn {
    let at = |x: usize, y: usize| picture.row(y / n)[x / n];
    Ok(Image::from_fn(picture.width() * n, picture.height() * n, at)?)
}

/// Part of a picture.
pub(super) fn part(picture: &Picture, [x, y, width, height]: [usize; 4]) -> Picture {
    picture.view().crop(x, y, width, height).to_image()
}

/// Pictures of one size side by side, or one below the other, with some white between.
pub(super) fn joined(pictures: &[Picture], down: bool) -> Drawn {
    const GAP: usize = 4;
    let Some(first) = pictures.first() else { return Ok(Image::default()) };
    let (w, h) = (first.width(), first.height());
    let along = if down { h } else { w };
    let length = pictures.len() * (along + GAP) - GAP;
    let (width, height) = if down { (w, length) } else { (length, h) };
    Ok(Image::from_fn(width, height, |x, y| {
        let (place, across) = if down { (y, x) } else { (x, y) };
        let (index, within) = (place / (along + GAP), place % (along + GAP));
        let pixel = if down { (across, within) } else { (within, across) };
        pictures[index].get(pixel.0, pixel.1).copied().unwrap_or([255; 4])
    })?)
}

/// A PNG, by a palette where there are few enough colours.
pub(super) fn encode(picture: &Picture) -> Result<Vec<u8>, GalleryError> {
    let mut colors: BTreeMap<[u8; 4], u8> = picture.pixels().iter().map(|&c| (c, 0)).collect();
    let mut out = Vec::new();
    let (width, height) = (picture.width() as u32, picture.height() as u32);
    let mut encoder = Encoder::new(&mut out, width, height);
    encoder.set_depth(BitDepth::Eight);
    encoder.set_compression(Compression::High);
    let grey = colors.keys().all(|[r, g, b, _]| r == g && g == b);
    let bytes: Vec<u8> = if grey {
        encoder.set_color(ColorType::Grayscale);
        encoder.set_filter(Filter::Adaptive);
        picture.pixels().iter().map(|c| c[0]).collect()
    } else if colors.len() <= 256 {
        let palette: Vec<u8> = colors.keys().flat_map(|&[r, g, b, _]| [r, g, b]).collect();
        for (index, code) in colors.values_mut().enumerate() {
            *code = index as u8;
        }
        encoder.set_color(ColorType::Indexed);
        encoder.set_palette(palette);
        encoder.set_filter(Filter::NoFilter);
        picture.pixels().iter().map(|c| colors[c]).collect()
    } else {
        encoder.set_color(ColorType::Rgb);
        encoder.set_filter(Filter::Adaptive);
        picture.pixels().iter().flat_map(|&[r, g, b, _]| [r, g, b]).collect()
    };
    let mut writer = encoder.write_header()?;
    writer.write_image_data(&bytes)?;
    writer.finish()?;
    Ok(out)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_kind_of_file_holds_its_picture() {
        let many = |x: usize, y: usize| [x as u8, y as u8, (x * y) as u8, 255];
        let few = |x: usize, y: usize| [(x % 3) as u8, y as u8 % 5, 9, 255];
        let grey = |x: usize, _: usize| [x as u8, x as u8, x as u8, 255];
        for pixel in [many as fn(usize, usize) -> [u8; 4], few, grey] {
            let picture = Image::from_fn(100, 80, pixel).unwrap();
            let file = encode(&picture).unwrap();
            let back = image::load_from_memory(&file).unwrap().into_rgba8();
            assert!(back.pixels().map(|p| p.0).eq(picture.pixels().iter().copied()));
        }
    }

    #[test]
    fn pictures_are_joined_either_way() {
        let one = Image::filled(3, 2, [1; 4]).unwrap();
        let two = [one.clone(), one];
        let across = joined(&two, false).unwrap();
        assert_eq!((across.width(), across.height()), (10, 2));
        assert_eq!(
            (across.row(0)[2], across.row(0)[3], across.row(1)[9]),
            ([1; 4], [255; 4], [1; 4])
        );
        let down = joined(&two, true).unwrap();
        assert_eq!((down.width(), down.height()), (3, 8));
        assert_eq!(down.row(7), [[1; 4]; 3]);
    }
}
