//! A row is its pixels, one by one, bit for bit, whatever the map, the filter and the border are.

use super::painter::centre;
use super::{Border, Lookup, Map, Prepared, Warp};
use crate::geometry::{DVec2, Homography, IntRect};
use crate::pixel::{Image, Premul, Straight, WorkingSpace};
use crate::texture::{
    Footprint, Kernel, LevelMode, Magnify, PixelFilter, Sampler, Texture, TextureOptions,
};
use crate::{Control, ImageSink};
use proptest::prelude::*;

/// Size of the outputs.
const WIDTH: usize = 50;
const HEIGHT: usize = 30;

/// Noise, opaque or not.
fn source(opaque: bool) -> Image<[u8; 4]> {
    Image::from_fn(61, 47, |x, y| {
        let noise = (x * 7919 + y * 104_729) % 251;
        let alpha = if opaque { 255 } else { 55 + (x * 3 + y) as u8 % 200 };
        [noise as u8, (x * 4) as u8, 255 - (y * 5) as u8, alpha]
    })
    .unwrap()
}

fn homography() -> impl Strategy<Value = Homography> {
    let parts = (prop::array::uniform8(-1.0..1.0f64), -2..4i32);
    parts.prop_map(|(m, scale)| {
        let s = 2f64.powi(scale);
        Homography::new([
            [s * (1.2 + m[0]), s * m[1], 60.0 * m[2]],
            [s * m[3], s * (1.2 - m[4]), 60.0 * m[5]],
            [0.03 * m[6], 0.03 * m[7], 0.8],
        ])
    })
}

fn sampler() -> impl Strategy<Value = Sampler> {
    let taps = Sampler { magnify: Magnify::CatmullRom, ..Sampler::DEFAULT };
    let square = Sampler { kernel: Kernel::Box, ..Sampler::DEFAULT };
    prop::sample::select(vec![
        square,
        Sampler { magnify: Magnify::Bilinear, ..square },
        Sampler::FAST,
        Sampler::DEFAULT,
        Sampler::HIGH,
        taps,
        Sampler::DEFAULT.with(PixelFilter::Bilinear, LevelMode::Auto),
        Sampler::DEFAULT.with(PixelFilter::Nearest, LevelMode::Zero),
    ])
}

fn border() -> impl Strategy<Value = Border> {
    let blue = Straight([0.1, 0.2, 0.9, 0.7]);
    let all = [Border::Transparent, Border::Constant(blue), Border::Clamp, Border::Repeat];
    prop::sample::select(all.to_vec())
}

fn warp<M: Map>(map: M, sampler: Sampler, border: Border) -> Warp<M> {
    Warp { sampler, border, threads: 1, ..Warp::new(map, WIDTH as u32, HEIGHT as u32) }
}

/// All colours of the output by rows, in pieces of the given length.
fn rows<M: Map>(prepared: &Prepared<'_, M>, piece: usize) -> Vec<Premul> {
    let painter = prepared.painter();
    let mut colors = vec![Premul::TRANSPARENT; WIDTH * HEIGHT];
    for (y, row) in (0..).zip(colors.chunks_mut(WIDTH)) {
        for (i, part) in row.chunks_mut(piece).enumerate() {
            painter.row((i * piece) as i32, y, part);
        }
    }
    colors
}

/// A quarter of the usual number: each case is a picture or two.
fn cases() -> ProptestConfig {
    let usual = ProptestConfig::default();
    ProptestConfig { cases: usual.cases.div_ceil(4), ..usual }
}

proptest! {
    #![proptest_config(cases())]

    #[test]
    fn rows_are_their_pixels(
        map in homography(), sampler in sampler(), border in border(), opaque: bool, piece in 1..50usize,
    ) {
        let warp = warp(map, sampler, border);
        let source = source(opaque);
        let Ok(prepared) = warp.prepare(&source.view()) else { return Ok(()) };
        let painter = prepared.painter();
        let found = rows(&prepared, piece);
        for (i, found) in found.iter().enumerate() {
            let p = centre((i % WIDTH) as i32, (i / WIDTH) as i32);
            let alone = painter.pixel(p);
            prop_assert_eq!(found.0, alone.0, "{:?}", p);
            let [r, g, b, a] = found.0;
            prop_assert!((0.0..=1.0).contains(&a), "{:?}", found);
            prop_assert!([r, g, b].iter().all(|c| (0.0..=a * 1.000_001).contains(c)), "{:?}", found);
        }
    }

    #[test]
    fn a_function_is_the_map_that_it_computes(
        map in homography(), sampler in sampler(), opaque: bool,
    ) {
        // No horizon: a function has a hard one.
        let map = Homography::new([map.m[0], map.m[1], [0.0, 0.0, 1.0]]);
        let source = source(opaque);
        let own = warp(move |p: DVec2| Some(Footprint::at(&map, p)), sampler, Border::Transparent);
        let plain = warp(map, sampler, Border::Transparent);
        let (Ok(mut own), Ok(plain)) = (own.prepare(&source.view()), plain.prepare(&source.view())) else {
            return Ok(());
        };
        // The bounds of what is seen differ, and with them the levels.
        own.texture = plain.texture.clone();
        own.opaque = plain.opaque;
        let (own, plain) = (rows(&own, WIDTH), rows(&plain, WIDTH));
        for (i, (own, plain)) in own.iter().zip(&plain).enumerate() {
            prop_assert_eq!(own.0, plain.0, "{}", i);
        }
    }

    #[test]
    fn what_is_not_kept_is_not_read(
        (eye, horizon, side) in (5.0..60.0f64, -60.0..-6.0f64, -0.3..0.3f64),
        sampler in sampler(), border in border(),
    ) {
        // A plane to its horizon, which lies above the picture.
        let row = |across: f64, along: f64| {
            [eye * (across + side), 0.0, along * eye * 100.0 - eye * across * 30.0]
        };
        let map = Homography::new([row(1.0, 0.4), row(-0.6, 0.5), [0.0, 1.0, -horizon]]);
        let source = Image::from_fn(700, 500, |x, y| {
            let v = (x * 7919 + y * 104_729) % 251;
            [v as u8, (v * y) as u8, (v * x) as u8, 255]
        })
        .unwrap();
        let warp = warp(map, sampler, border);
        let Ok(mut prepared) = warp.prepare(&source.view()) else { return Ok(()) };
        let part = rows(&prepared, WIDTH);
        let wrap = border.wrap(warp.space, true);
        let options = TextureOptions { space: warp.space, wrap, ..TextureOptions::default() };
        prepared.texture = Texture::new(source.view(), &options).unwrap();
        for (i, (part, whole)) in part.iter().zip(&rows(&prepared, WIDTH)).enumerate() {
            prop_assert_eq!(part.0, whole.0, "{}", i);
        }
    }

    #[test]
    fn threads_and_crops_change_no_byte(
        map in homography(), border in border(), space in 0..2usize,
        (x, y, w, h) in (0..550i32, 0..25i32, 1..600i32, 1..20i32),
    ) {
        let space = [WorkingSpace::Srgb, WorkingSpace::Linear][space];
        let source = source(true);
        let whole = Warp { border, space, threads: 1, ..Warp::new(map, 600, 20) };
        let Ok(all) = whole.image(&source.view()) else { return Ok(()) };
        let crop = IntRect::new(x, y, x + w, y + h);
        let part = Warp { crop: Some(crop), threads: 3, ..whole.clone() };
        let part = part.image(&source.view());
        let expected = all.view().crop(x as usize, y as usize, w as usize, h as usize);
        if expected.height() == 0 {
            prop_assert!(part.is_err());
        } else {
            prop_assert_eq!(part.unwrap(), expected.to_image());
        }
    }
}

#[test]
fn a_crop_that_ends_at_the_horizon_beside_the_source_changes_no_byte() {
    let last = [-0.003_166_796_324_654_654, -0.020_673_539_955_673_725, 0.8];
    let map = Homography::new([[1.2, 0.0, 0.0], [0.0, 1.2, 0.0], last]);
    let source = source(true);
    for border in [Border::Transparent, Border::Constant(Straight([0.2, 0.4, 0.6, 1.0]))] {
        let whole = Warp { border, threads: 1, ..Warp::new(map, 600, 20) };
        let all = whole.image(&source.view()).unwrap();
        let part = Warp { crop: Some(IntRect::new(20, 0, 227, 5)), ..whole.clone() };
        let part = part.image(&source.view()).unwrap();
        assert_eq!(part.pixels(), all.view().crop(20, 0, 207, 5).to_image().pixels());
    }
}

#[test]
fn far_beside_a_source_that_is_not_opaque_all_is_the_border() {
    let map = Homography::new([[9.0, 0.0, -15.0], [-2.9, 6.0, 74.0], [0.0, 0.0, 1.0]]);
    let border = Border::Constant(Straight([0.1, 0.2, 0.9, 0.7]));
    let point = |pixel| Sampler { pixel, level: LevelMode::Zero, ..Sampler::DEFAULT };
    let (nearest, bilinear) = (point(PixelFilter::Nearest), point(PixelFilter::Bilinear));
    for sampler in [nearest, bilinear, Sampler::FAST, Sampler::DEFAULT, Sampler::HIGH] {
        let warp = warp(map, sampler, border);
        let source = source(false);
        let prepared = warp.prepare(&source.view()).unwrap();
        let found = rows(&prepared, WIDTH);
        for (i, found) in found.iter().enumerate() {
            let p = centre((i % WIDTH) as i32, (i / WIDTH) as i32);
            assert_eq!(found.0, prepared.painter().pixel(p).0, "{sampler:?} {p:?}");
        }
    }
}

#[test]
fn a_lookup_of_a_homography_is_nearly_that_homography() {
    let map = Homography::new([[1.4, 0.2, -20.0], [-0.3, 1.7, 3.0], [1e-4, 2e-4, 1.0]]);
    let positions = Image::from_fn(WIDTH, HEIGHT, |x, y| {
        let p = map.project(centre(x as i32, y as i32)).unwrap_or_default();
        [p.x as f32, p.y as f32]
    });
    let lookup = Lookup::new(positions.unwrap());
    let source = source(true);
    let of = |picture: Image<[u8; 4]>| picture.into_vec();
    let exact = of(warp(map, Sampler::HIGH, Border::Transparent).image(&source.view()).unwrap());
    let found = of(warp(lookup, Sampler::HIGH, Border::Transparent).image(&source.view()).unwrap());
    let worst = exact.as_flattened().iter().zip(found.as_flattened()).map(|(a, b)| a.abs_diff(*b));
    assert!(worst.max() <= Some(2));
}

#[test]
fn sixteen_bits_and_floats_are_the_same_picture() {
    let map = Homography::new([[1.4, 0.2, -20.0], [-0.3, 1.7, 3.0], [1e-4, 2e-4, 1.0]]);
    let source = source(false);
    for space in [WorkingSpace::Srgb, WorkingSpace::Linear] {
        let warp = Warp { space, ..warp(map, Sampler::DEFAULT, Border::Transparent) };
        let prepared = warp.prepare(&source.view()).unwrap();
        let (mut eight, mut sixteen, mut float) = (
            ImageSink::<[u8; 4]>::new(),
            ImageSink::<[u16; 4]>::new(),
            ImageSink::<[f32; 4]>::new(),
        );
        prepared.draw(&mut eight, &Control::default()).unwrap();
        prepared.draw(&mut sixteen, &Control::default()).unwrap();
        prepared.draw(&mut float, &Control::default()).unwrap();
        let (eight, sixteen, float) =
            (eight.into_image(), sixteen.into_image(), float.into_image());
        for ((a, b), c) in eight.pixels().iter().zip(sixteen.pixels()).zip(float.pixels()) {
            let light = WorkingSpace::Linear.export16(Straight(*c).premultiply());
            for k in 0..4 {
                assert!((f64::from(a[k]) - f64::from(b[k]) / 257.0).abs() < 0.51 || b[3] < 257);
                assert!(b[k].abs_diff(light[k]) <= 1, "{b:?} {light:?}");
            }
        }
    }
}
