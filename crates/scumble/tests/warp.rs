//! What warping promises, on pictures whose result is known.

#![allow(clippy::unwrap_used)] // helpers of tests

use scumble::geometry::{Affine, DVec2, Homography, IntRect, Rect};
use scumble::pixel::{Image, Straight, WorkingSpace};
use scumble::texture::{Footprint, Levels, TextureOptions};
use scumble::texture::{LevelMode, Magnify, PixelFilter, Sampler, Separable, Texture};
use scumble::warp::{Border, Warp, WarpError};
use scumble::{Control, ImageSink, Sink};
use std::sync::atomic::{AtomicBool, AtomicU32, Ordering};

fn noise(width: usize, height: usize) -> Image<[u8; 4]> {
    let pixel = |x: usize, y: usize| {
        let v = (x * 7919 + y * 104_729 + x * y * 31) % 253;
        [v as u8, (255 - v) as u8, (v * 7 % 256) as u8, 255]
    };
    Image::from_fn(width, height, pixel).unwrap()
}

fn white(width: usize, height: usize) -> Image<[u8; 4]> {
    Image::filled(width, height, [255; 4]).unwrap()
}

/// Points of the plane.
fn points(p: [(f64, f64); 4]) -> [DVec2; 4] {
    p.map(|(x, y)| DVec2::new(x, y))
}

#[test]
fn the_identity_is_the_identity() {
    let source = noise(37, 23);
    let filters = [
        PixelFilter::Nearest,
        PixelFilter::Bilinear,
        PixelFilter::Separable(Separable::CatmullRom),
    ];
    for space in [WorkingSpace::Srgb, WorkingSpace::Linear] {
        for pixel in filters {
            for border in [Border::Transparent, Border::Clamp, Border::Repeat] {
                let sampler = Sampler::DEFAULT.with(pixel, LevelMode::Zero);
                let warp = Warp { sampler, border, space, ..Warp::new(Affine::IDENTITY, 37, 23) };
                assert_eq!(warp.image(&source.view()).unwrap(), source, "{pixel:?} {border:?}");
            }
        }
    }
}

#[test]
fn pixels_are_samples_at_exact_footprints() {
    let source = noise(200, 150);
    let to = points([(20.0, 10.0), (150.0, 30.0), (140.0, 100.0), (-10.0, 115.0)]);
    let map = Homography::from_points(to, Rect::new(0.0, 0.0, 200.0, 150.0).corners()).unwrap();
    let warp =
        Warp { border: Border::Clamp, space: WorkingSpace::Srgb, ..Warp::new(map, 160, 120) };
    let picture = warp.image(&source.view()).unwrap();
    let texture = Texture::new(source.view(), &TextureOptions::default()).unwrap();
    for (y, row) in picture.view().rows().enumerate() {
        for (x, pixel) in row.iter().enumerate() {
            let p = DVec2::new(x as f64 + 0.5, y as f64 + 0.5);
            let color = texture.sample(&Footprint::at(&map, p), &Sampler::DEFAULT);
            assert_eq!(*pixel, WorkingSpace::Srgb.export(color), "{x} {y}");
        }
    }
}

/// Alpha along a row, in 0…1.
fn alphas(picture: &Image<[u16; 4]>, y: usize) -> Vec<f64> {
    picture.row(y).iter().map(|p| f64::from(p[3]) / 65535.0).collect()
}

fn picture16(warp: &Warp<Affine>, source: &Image<[u8; 4]>) -> Image<[u16; 4]> {
    let mut sink = ImageSink::new();
    warp.prepare(&source.view()).unwrap().draw(&mut sink, &Control::default()).unwrap();
    sink.into_image()
}

#[test]
fn the_edge_is_a_line_of_the_output_at_any_scale() {
    for magnify in [Magnify::None, Magnify::Taps, Magnify::CatmullRom] {
        for zoom in [0.11, 0.5, 1.0, 6.0, 40.0] {
            let source = white(80, 60);
            // The source's edges at 10.3 and 10.3 + 80·zoom.
            let map = Affine::new(1.0 / zoom, 0.0, 0.0, 1.0 / zoom, -10.3 / zoom, -10.3 / zoom);
            let width = (80.0 * zoom + 21.0) as u32;
            let warp = Warp {
                sampler: Sampler { magnify, ..Sampler::DEFAULT },
                crop: Some(IntRect::new(0, 12, width as i32, 13)),
                ..Warp::new(map, width, 40)
            };
            let row = alphas(&picture16(&warp, &source), 0);
            let sum: f64 = row.iter().sum();
            assert!((sum - 80.0 * zoom).abs() < 0.02, "{magnify:?} {zoom}: {sum}");
            let soft = row[..(10.3 + 40.0 * zoom) as usize].iter();
            let soft = soft.filter(|a| (0.001..0.999).contains(*a)).count();
            assert!((2..=4).contains(&soft), "{magnify:?} {zoom}: {soft} pixels");
            assert!((row[10] - 0.66).abs() < 0.02, "{magnify:?} {zoom}: {}", row[10]);
        }
    }
}

#[test]
fn the_colour_at_an_edge_is_the_sources_own() {
    // White with one black line around, reduced: near the edge a pixel sees the inside, not more of
    // the line than there is.
    let frame = |x: usize, y: usize| x == 0 || y == 0 || x == 159 || y == 159;
    let image =
        Image::from_fn(160, 160, |x, y| if frame(x, y) { [0, 0, 0, 255] } else { [255; 4] });
    let source = image.unwrap();
    let map = Affine::new(16.0, 0.0, 0.0, 16.0, -80.0, -80.0);
    let warp = Warp { space: WorkingSpace::Srgb, ..Warp::new(map, 20, 20) };
    let picture = warp.image(&source.view()).unwrap();
    // The pixel left of the edge sees a sixth of what the one right of it does.
    let [r, _, _, a] = picture.row(10)[5];
    assert!((210..220).contains(&a) && r > 230, "{r} {a}");
    let [r, _, _, a] = picture.row(10)[4];
    assert!((35..45).contains(&a) && r > 130, "{r} {a}");
}

#[test]
fn a_constant_border_is_the_picture_over_that_colour() {
    let source = noise(30, 20);
    let to = points([(5.0, 3.0), (60.0, 8.0), (55.0, 50.0), (2.0, 44.0)]);
    let map = Homography::from_points(to, Rect::new(0.0, 0.0, 30.0, 20.0).corners()).unwrap();
    let ground = Straight([0.2, 0.4, 0.6, 1.0]);
    let warp = Warp { space: WorkingSpace::Srgb, ..Warp::new(map, 64, 56) };
    let clear = warp.image(&source.view()).unwrap();
    let over = Warp { border: Border::Constant(ground), ..warp }.image(&source.view()).unwrap();
    for (clear, over) in clear.pixels().iter().zip(over.pixels()) {
        let space = WorkingSpace::Srgb;
        let expected = space.export(space.import(*clear).over(space.import(ground)));
        assert_eq!(over[3], 255);
        assert!((0..3).all(|k| over[k].abs_diff(expected[k]) <= 1), "{over:?} {expected:?}");
    }
}

#[test]
fn a_source_with_alpha_fades_at_its_edge_and_keeps_its_colour() {
    let source = Image::filled(12, 12, [200, 100, 50, 128]).unwrap();
    let map = Affine::new(0.25, 0.0, 0.0, 0.25, -2.0, -2.0);
    let warp = Warp { space: WorkingSpace::Srgb, ..Warp::new(map, 64, 64) };
    let picture = warp.image(&source.view()).unwrap();
    assert_eq!(picture.row(32)[32], [200, 100, 50, 128]);
    assert_eq!(picture.row(1)[1], [0; 4]);
    for [r, g, b, a] in picture.row(32).iter().copied().filter(|p| p[3] > 40) {
        assert!(
            r.abs_diff(200) <= 2 && g.abs_diff(100) <= 2 && b.abs_diff(50) <= 2,
            "{r} {g} {b} {a}"
        );
    }
}

/// A floor: the horizon at y = 40.25 of the output, the eye 2 texels above.
fn floor() -> Homography {
    Homography::new([[0.05, 0.0, -5.0], [0.0, 0.0, 2.0], [0.0, 0.001, -0.040_25]])
}

#[test]
fn behind_the_horizon_there_is_nothing() {
    let source = noise(64, 64);
    for border in [Border::Repeat, Border::Clamp, Border::Mirror, Border::Transparent] {
        let warp = Warp { border, ..Warp::new(floor(), 200, 120) };
        let picture = warp.image(&source.view()).unwrap();
        for (y, row) in picture.view().rows().enumerate() {
            if y < 40 {
                assert!(row.iter().all(|p| p[3] == 0), "{border:?} {y}");
            } else if matches!(border, Border::Repeat | Border::Mirror) {
                // The horizon cuts row 40 at a quarter of its height.
                let expected = if y == 40 { 191 } else { 255 };
                assert!(row.iter().all(|p| p[3].abs_diff(expected) <= 1), "{border:?} {y}");
            }
        }
    }
}

#[test]
fn a_repeated_floor_is_grey_at_its_horizon() {
    let checker = |x: usize, y: usize| {
        if (x / 8 + y / 8).is_multiple_of(2) { [255; 4] } else { [0, 0, 0, 255] }
    };
    let source = Image::from_fn(64, 64, checker).unwrap();
    let warp =
        Warp { border: Border::Repeat, space: WorkingSpace::Srgb, ..Warp::new(floor(), 200, 120) };
    let picture = warp.image(&source.view()).unwrap();
    for y in 40..42 {
        assert!(picture.row(y).iter().all(|p| p[0].abs_diff(128) < 8), "{y}: {:?}", picture.row(y));
    }
}

#[test]
fn only_the_levels_that_are_read_are_kept() {
    let source = noise(256, 256);
    let bytes = |scale: f64, side: u32| {
        let map = Affine::new(scale, 0.0, 0.0, scale, 0.0, 0.0);
        Warp::new(map, side, side).prepare(&source.view()).unwrap().stats().texture_bytes
    };
    let all = Texture::memory_for(256, 256, &TextureOptions::default()).unwrap();
    // At its own size only the source is read, at half of it a level beside it.
    let base = TextureOptions { levels: Levels::BaseOnly, ..TextureOptions::default() };
    assert_eq!(Some(bytes(1.0, 256)), Texture::memory_for(256, 256, &base));
    assert!(bytes(2.0, 128) <= all && bytes(2.0, 128) > bytes(1.0, 256));
    // Level 2, and what is coarser.
    assert!(bytes(8.0, 32) < all / 8, "{} of {all}", bytes(8.0, 32));
    // 13 texels on each side, and the margin.
    assert!(bytes(0.2, 64) < all / 20, "{} of {all}", bytes(0.2, 64));
}

#[test]
fn progress_and_cancelling_are_those_of_rendering() {
    let source = noise(64, 64);
    let warp = Warp { threads: 1, ..Warp::new(Affine::IDENTITY, 64, 64) };
    let prepared = warp.prepare(&source.view()).unwrap();
    let last = AtomicU32::new(0);
    let tell = |p: scumble::Progress| {
        assert_eq!(p.rows, 64);
        assert!(last.swap(p.rows_done, Ordering::Relaxed) < p.rows_done);
    };
    let control = Control { progress: Some(&tell), cancel: None };
    let stats = prepared.draw(&mut ImageSink::<[u8; 4]>::new(), &control).unwrap();
    assert_eq!((last.into_inner(), stats.width, stats.height, stats.threads), (64, 64, 64, 1));
    let cancel = AtomicBool::new(true);
    let control = Control { progress: None, cancel: Some(&cancel) };
    let outcome = prepared.draw(&mut ImageSink::<[u8; 4]>::new(), &control);
    assert!(matches!(outcome, Err(WarpError::Cancelled)));
}

#[test]
fn what_cannot_be_done_is_said() {
    let source = noise(8, 8);
    let warp = Warp::new(Affine::IDENTITY, 8, 8);
    let fails = |warp: &Warp<Affine>| warp.prepare(&source.view()).map(|_| ()).unwrap_err();
    assert!(matches!(fails(&Warp { width: 0, ..warp.clone() }), WarpError::Size { .. }));
    assert!(matches!(fails(&Warp { height: u32::MAX, ..warp.clone() }), WarpError::Size { .. }));
    let crop = Some(IntRect::new(8, 0, 12, 4));
    assert!(matches!(fails(&Warp { crop, ..warp.clone() }), WarpError::Crop { .. }));
    assert!(matches!(fails(&Warp { max_memory: 100, ..warp.clone() }), WarpError::Memory { .. }));
    for map in [Affine::scale(1.0, 0.0), Affine::scale(f64::NAN, 1.0)] {
        assert!(matches!(fails(&Warp { map, ..warp.clone() }), WarpError::Singular));
    }
    let empty = Image::<[u8; 4]>::default();
    assert!(matches!(warp.prepare(&empty.view()).map(|_| ()), Err(WarpError::Source(_))));
    // Rows that are long beside the limit.
    let long = Warp { max_memory: 5000, ..Warp::new(Affine::IDENTITY, 1 << 20, 1) };
    let outcome = long.image(&source.view());
    assert!(matches!(outcome, Err(WarpError::Memory { .. })));
}

/// A sink that fails at a row.
struct Full;

impl Sink<[u16; 4]> for Full {
    type Error = u32;

    fn start(&mut self, _: u32, _: u32) -> Result<(), u32> {
        Ok(())
    }

    fn rows(&mut self, y: u32, rows: &[[u16; 4]]) -> Result<(), u32> {
        if y as usize + rows.len() / 8 > 20 { Err(y) } else { Ok(()) }
    }

    fn finish(&mut self) -> Result<(), u32> {
        Err(u32::MAX)
    }
}

#[test]
fn the_sinks_error_comes_back() {
    let source = noise(8, 8);
    let warp = Warp { threads: 1, ..Warp::new(Affine::IDENTITY, 8, 64) };
    let outcome = warp.prepare(&source.view()).unwrap().draw(&mut Full, &Control::default());
    assert!(matches!(outcome, Err(WarpError::Sink(16))));
}
