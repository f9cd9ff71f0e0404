//! Parts of images: textures made row by row, and textures that keep a window.
#![allow(clippy::unwrap_used, reason = "a test helper may fail its test")]

mod common;

use common::{Random, noise};
use proptest::prelude::*;
use scumble_geometry::{IntRect, Matrix2};
use scumble_pixel::{Image, Premul, WorkingSpace};
use scumble_texture::{
    Decimation, Footprint, Kernel, LevelMode, Levels, Magnify, Outline, PixelFilter, Sampler,
    Separable, Simd, Storage, StraightAlpha, TexelFormat, Texels, Texture, TextureBuilder,
    TextureError, TextureOptions, Wrap,
};

const WRAPS: [Wrap; 4] =
    [Wrap::Clamp, Wrap::Repeat, Wrap::Mirror, Wrap::Constant(Premul([0.25, 0.5, 0.125, 0.75]))];

fn options() -> impl Strategy<Value = TextureOptions> {
    let space = prop::sample::select(vec![WorkingSpace::Srgb, WorkingSpace::Linear]);
    let decimation = prop::sample::select(vec![Decimation::Kaiser, Decimation::Box]);
    let levels = prop_oneof![
        Just(Levels::All),
        Just(Levels::BaseOnly),
        (0usize..5, 0usize..3)
            .prop_map(|(first, more)| Levels::Range { first, last: first + more }),
    ];
    let window = prop::option::of((-9i32..90, -9i32..90, 0i32..70, 0i32..70));
    let storage = prop::sample::select(vec![Storage::Auto, Storage::Float]);
    (space, prop::sample::select(WRAPS.to_vec()), decimation, levels, window, storage).prop_map(
        |(space, wrap, decimation, levels, window, storage)| TextureOptions {
            storage,
            space,
            wrap,
            decimation,
            levels,
            window: window.map(|(x, y, w, h)| IntRect::new(x, y, x + w, y + h)),
            ..TextureOptions::default()
        },
    )
}

fn build(image: &Image<[u8; 4]>, options: &TextureOptions) -> Texture {
    let format = TexelFormat::<[u8; 4], StraightAlpha>::straight();
    let mut builder = TextureBuilder::new(image.width(), image.height(), format, options).unwrap();
    let needed = builder.rows_needed();
    assert_eq!(builder.skip_rows(usize::MAX), needed.start);
    for y in needed {
        assert_eq!(builder.rows_needed().start, y);
        builder.push_row(image.row(y)).unwrap();
    }
    assert!(builder.rows_needed().is_empty());
    builder.finish().unwrap()
}

fn same_levels(a: &Texture, b: &Texture) -> bool {
    a.level_count() == b.level_count()
        && (0..a.level_count())
            .all(|l| a.level(l) == b.level(l) && a.level_window(l) == b.level_window(l))
}

proptest! {
    #[test]
    fn rows_that_come_make_what_an_image_makes(
        (w, h) in (1usize..100, 1usize..100),
        options in options(),
        seed: u64,
    ) {
        let image = noise(w, h, seed);
        let whole = Texture::new(image.view(), &options).unwrap();
        prop_assert!(same_levels(&whole, &build(&image, &options)));
        prop_assert_eq!(Some(whole.memory()), Texture::memory_for(w, h, &options));
    }

    #[test]
    fn a_window_keeps_what_the_whole_has_there(
        (w, h) in (1usize..120, 1usize..120),
        options in options(),
        seed: u64,
    ) {
        let image = noise(w, h, seed);
        let part = Texture::new(image.view(), &options).unwrap();
        let whole = Texture::new(image.view(), &TextureOptions { window: None, ..options }).unwrap();
        for l in 0..whole.level_count() {
            let rect = part.level_window(l).unwrap();
            let (part, whole) = (part.level(l).unwrap(), whole.level(l).unwrap());
            for y in 0..part.height() {
                let (x0, y0) = (rect.x0 as usize, rect.y0 as usize);
                prop_assert_eq!(part.row(y), &whole.row(y0 + y)[x0..x0 + part.width()]);
            }
        }
    }

    /// Footprints whose reach is in the window, or in a part of outlines, by every filter.
    #[test]
    fn samples_inside_a_window_are_those_of_the_whole(
        outlined: bool,
        (w, h) in (90usize..300, 90usize..300),
        (x, y) in (0usize..100, 0usize..100),
        side in 10usize..160,
        options in options(),
        seed: u64,
    ) {
        let image = noise(w, h, 7);
        let (x, y) = (x % w, y % h);
        let side = side.min(w - x).min(h - y);
        let (x, y) = (x as i32, y as i32);
        let window = IntRect::new(x, y, x + side as i32, y + side as i32);
        let whole = TextureOptions { window: None, ..options };
        let whole = Texture::new(image.view(), &whole).unwrap();
        let mut outline = Outline::new(h);
        outline.add(window);
        outline.add(IntRect::new(w as i32 - x, h as i32 - y, w as i32, h as i32));
        let options = if outlined {
            TextureOptions { window: None, outlines: [Some(outline); 3], ..options }
        } else {
            TextureOptions { window: Some(window), ..options }
        };
        let part = Texture::new(image.view(), &options).unwrap();
        let mut random = Random::new(seed);
        let s = Sampler::DEFAULT;
        for s in [
            Sampler::FAST,
            s,
            Sampler::HIGH,
            Sampler::REFERENCE,
            Sampler { kernel: Kernel::Lanczos3, ..s },
            Sampler { kernel: Kernel::Triangle, magnify: Magnify::CatmullRom, ..s },
            s.with(PixelFilter::Bilinear, LevelMode::Linear),
            s.with(PixelFilter::Nearest, LevelMode::Nearest),
            s.with(PixelFilter::Probes, LevelMode::Auto),
            s.with(PixelFilter::Separable(Separable::Lanczos3), LevelMode::Linear),
            Sampler::CLASSIC,
        ] {
            for _ in 0..12 {
                let size = random.range(0.0, 1.0).powi(2) * 0.2 * side as f64;
                let mut part_of = |s: f64| random.range(-s, s);
                let jacobian =
                    Matrix2::new(part_of(size), part_of(size), part_of(size), part_of(size));
                let mut f = Footprint { u: 0.0, v: 0.0, jacobian };
                let [across, down] = s.reach(&f);
                let mut place = |low: i32, reach: f64| {
                    let room = side as f64 - 2.0 * reach;
                    (room >= 0.0).then(|| f64::from(low) + reach + random.range(0.0, room))
                };
                let (Some(u), Some(v)) = (place(x, across), place(y, down)) else { continue };
                (f.u, f.v) = (u, v);
                for simd in [Simd::SCALAR, Simd::best()] {
                    let (part, whole) =
                        (part.clone().with_simd(simd), whole.clone().with_simd(simd));
                    prop_assert_eq!(part.sample(&f, &s), whole.sample(&f, &s), "{:?} {:?}", f, s);
                }
            }
        }
    }
}

#[test]
fn outlines_take_less_memory_and_keep_what_they_hold() {
    let image = noise(640, 640, 3);
    let mut outline = Outline::new(640);
    outline.add(IntRect::new(500, 0, 520, 20));
    outline.add(IntRect::new(100, 620, 120, 640));
    let whole = Texture::new(image.view(), &TextureOptions::default()).unwrap();
    let outlines = [Some(outline), None, None];
    let options = TextureOptions { outlines, ..TextureOptions::default() };
    let part = Texture::new(image.view(), &options).unwrap();
    let (fine, all) = (part.level(0).unwrap(), whole.level(0).unwrap());
    assert_eq!(fine.row(10)[500..520], all.row(10)[500..520]);
    assert_eq!(fine.row(630)[100..120], all.row(630)[100..120]);
    // What lies between them is not stored.
    assert_eq!(fine.row(300)[200], [0.0; 4]);
    assert_eq!(part.level(1), whole.level(1));
    // Where little is read, little is had.
    let mut outline = Outline::new(640);
    outline.add(IntRect::new(500, 0, 520, 20));
    let options = TextureOptions { outlines: [Some(outline), None, None], ..options };
    let part = Texture::new(image.view(), &options).unwrap();
    assert_eq!(part.level_window(0), Some(IntRect::new(492, 0, 528, 28)));
    assert_eq!(part.level(1), whole.level(1));
    assert!(part.memory() < whole.memory() / 3);
}

#[test]
fn a_broken_promise_gives_the_same_colour_everywhere() {
    for wrap in WRAPS {
        let options = TextureOptions {
            wrap,
            window: Some(IntRect::new(40, 30, 60, 50)),
            ..TextureOptions::default()
        };
        let t = Texture::new(noise(128, 128, 3).view(), &options).unwrap();
        let mut random = Random::new(5);
        for _ in 0..500 {
            let mut any = |low, high| random.range(low, high);
            let jacobian = Matrix2::new(any(-9., 9.), any(-2., 2.), any(-2., 2.), any(-9., 9.));
            let f = Footprint { u: any(-300., 300.), v: any(-300., 300.), jacobian };
            let s = [Sampler::FAST, Sampler::DEFAULT, Sampler::HIGH, Sampler::CLASSIC];
            for s in s.into_iter().chain([
                Sampler::DEFAULT.with(PixelFilter::Bilinear, LevelMode::Linear),
                Sampler::DEFAULT.with(PixelFilter::Nearest, LevelMode::Zero),
            ]) {
                let expected = t.clone().with_simd(Simd::SCALAR).sample(&f, &s);
                assert!(expected.0.iter().all(|v| (0.0..=1.0).contains(v)));
                for simd in Simd::all() {
                    assert_eq!(t.clone().with_simd(simd).sample(&f, &s), expected, "{f:?} {s:?}");
                }
            }
        }
    }
}

#[test]
fn what_is_not_kept_takes_no_memory() {
    let image = noise(512, 512, 1);
    let make = |levels, window| {
        let options = TextureOptions { levels, window, ..TextureOptions::default() };
        Texture::new(image.view(), &options).unwrap().memory()
    };
    let whole = make(Levels::All, None);
    assert!(make(Levels::Range { first: 2, last: 4 }, None) * 10 < whole);
    assert!(make(Levels::BaseOnly, Some(IntRect::new(100, 100, 200, 120))) * 50 < whole);
}

#[test]
fn rows_that_do_not_fit_are_errors() {
    let format = TexelFormat::<[u8; 3], _>::straight();
    let mut builder = TextureBuilder::new(4, 3, format, &TextureOptions::default()).unwrap();
    let row = [[1, 2, 3]; 4];
    assert_eq!(builder.push_row(&row[..3]), Err(TextureError::Row { row: 0 }));
    builder.push_row(&row).unwrap();
    assert_eq!(builder.clone().finish().err(), Some(TextureError::Incomplete { row: 1 }));
    assert_eq!(builder.push_rows(&[[0; 3]; 12]), Err(TextureError::Row { row: 1 }));
    assert_eq!(builder.push_rows(&[[0; 3]; 7]), Err(TextureError::Row { row: 1 }));
    builder.push_rows(&[[9; 3]; 8]).unwrap();
    assert_eq!(builder.push_row(&row), Err(TextureError::Row { row: 3 }));
    let made = builder.finish().unwrap();
    assert_eq!(made.level(0).unwrap().row(0)[0][3], 1.0);
    let none = TextureBuilder::new(0, 3, format, &TextureOptions::default());
    assert_eq!(none.err(), Some(TextureError::Empty));
}

#[test]
fn a_builder_takes_the_memory_of_another_texture() {
    let image = noise(64, 48, 2);
    let options = TextureOptions { wrap: Wrap::Repeat, ..TextureOptions::default() };
    let old = Texture::new(noise(64, 48, 9).view(), &options).unwrap();
    let format = TexelFormat::<[u8; 4], StraightAlpha>::straight();
    let mut builder = TextureBuilder::renewing(old, 64, 48, format, &options).unwrap();
    builder.push_rows(image.pixels()).unwrap();
    let texels = Texels::straight(image.view());
    let new = Texture::from_texels(&texels, &options).unwrap();
    assert!(same_levels(&builder.finish().unwrap(), &new));
}
