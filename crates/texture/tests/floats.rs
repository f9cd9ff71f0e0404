//! Textures of floats: nothing is rounded, nothing is cut.
#![allow(clippy::unwrap_used, reason = "a test helper may fail its test")]

mod common;

use common::{Random, noise};
use proptest::prelude::*;
use scumble_geometry::{DVec2, Homography, Matrix2};
use scumble_pixel::{Image, Premul, WorkingSpace};
use scumble_texture::{
    Decimation, Footprint, Kernel, LevelMode, Magnify, PixelFilter, Sampler, Separable, Simd,
    Storage, Texels, Texture, TextureOptions, Wrap,
};

const LINEAR: TextureOptions = TextureOptions {
    space: WorkingSpace::Linear,
    wrap: Wrap::Clamp,
    decimation: Decimation::Kaiser,
    levels: scumble_texture::Levels::All,
    storage: Storage::Auto,
    window: None,
    outlines: [None; 3],
};

fn samplers() -> Vec<Sampler> {
    let s = Sampler::DEFAULT;
    vec![
        Sampler::FAST,
        s,
        Sampler::HIGH,
        Sampler::REFERENCE,
        Sampler { level: LevelMode::Zero, ..s },
        Sampler { kernel: Kernel::Mitchell, ..s },
        Sampler { magnify: Magnify::CatmullRom, ..s },
        s.with(PixelFilter::Nearest, LevelMode::Auto),
        s.with(PixelFilter::Bilinear, LevelMode::Auto),
        s.with(PixelFilter::Probes, LevelMode::Auto),
        s.with(PixelFilter::Separable(Separable::Lanczos3), LevelMode::Linear),
        Sampler::CLASSIC,
    ]
}

fn footprint(random: &mut Random, w: usize, h: usize) -> Footprint {
    let size = random.range(0.0, 1.0).powi(3) * 40.0;
    let mut part = || random.range(-size, size);
    let jacobian = Matrix2::new(part(), part(), part(), part());
    let (u, v) = (random.range(-9.0, w as f64 + 9.0), random.range(-9.0, h as f64 + 9.0));
    Footprint { u, v, jacobian }
}

proptest! {
    #[test]
    fn a_constant_is_itself_to_the_last_bit(
        (w, h) in (1usize..90, 1usize..90),
        color in prop::array::uniform3(-50.0f32..900.0),
        a in 0.0f32..=1.0,
        (decimation, wrap) in (
            prop::sample::select(vec![Decimation::Kaiser, Decimation::Box]),
            prop::sample::select(vec![Wrap::Clamp, Wrap::Repeat, Wrap::Mirror]),
        ),
        seed: u64,
    ) {
        let [r, g, b] = color;
        let image = Image::filled(w, h, [r, g, b, a]).unwrap();
        let options = TextureOptions { decimation, wrap, ..LINEAR };
        let t = Texture::from_texels(&Texels::premultiplied(image.view()), &options).unwrap();
        for l in 0..t.level_count() {
            for texel in t.level(l).unwrap().pixels() {
                prop_assert_eq!(*texel, [r, g, b, a]);
            }
        }
        let mut random = Random::new(seed);
        for s in samplers() {
            for _ in 0..4 {
                let f = footprint(&mut random, w, h);
                prop_assert_eq!(t.sample(&f, &s).0, [r, g, b, a], "{:?} {:?}", f, s);
            }
        }
    }

    #[test]
    fn every_level_has_the_mean_of_the_image(
        (w, h) in (1usize..130, 1usize..130),
        decimation in prop::sample::select(vec![Decimation::Kaiser, Decimation::Box]),
        wrap in prop::sample::select(vec![Wrap::Clamp, Wrap::Repeat, Wrap::Mirror]),
        seed: u64,
    ) {
        let mut random = Random::new(seed);
        let image = Image::from_fn(w, h, |_, _| [(random.range(-0.5, 8.0)) as f32]).unwrap();
        let options = TextureOptions { decimation, wrap, ..LINEAR };
        let t = Texture::from_texels(&Texels::straight(image.view()), &options).unwrap();
        let mean = |l: usize| {
            let level = t.level(l).unwrap();
            let sum: f64 = level.pixels().iter().map(|t| f64::from(t[0])).sum();
            sum / level.pixels().len() as f64
        };
        for l in 1..t.level_count() {
            prop_assert!((mean(l) - mean(0)).abs() < 1e-5, "level {}: {} {}", l, mean(l), mean(0));
        }
    }

    #[test]
    fn rows_and_instruction_sets_agree(
        (w, h) in (1usize..70, 1usize..70),
        wrap in prop::sample::select(vec![
            Wrap::Clamp, Wrap::Repeat, Wrap::Mirror, Wrap::Constant(Premul([3.0, 0.5, 0.0, 0.5])),
        ]),
        (x, y, turn) in (-40.0..40.0, -40.0..40.0, -0.02..0.02),
        scale in 0.05..9.0,
    ) {
        let image = noise(w, h, 3).map(|p| p.map(|v| f32::from(v) * 0.02));
        let options = TextureOptions { wrap, ..LINEAR };
        let t = Texture::from_texels(&Texels::straight(image.view()), &options).unwrap();
        let map = Homography::new([[scale, 0.3, x], [0.2, scale, y], [turn, 0.001, 1.0]]);
        for s in samplers() {
            let mut row = [Premul::TRANSPARENT; 21];
            t.sample_row(&map, DVec2::new(0.5, 3.5), &s, &mut row);
            for simd in Simd::all() {
                let t = t.clone().with_simd(simd);
                for (i, color) in row.iter().enumerate() {
                    let f = Footprint::at(&map, DVec2::new(i as f64 + 0.5, 3.5));
                    prop_assert_eq!(t.sample(&f, &s), *color, "{:?} {:?}", s, simd);
                }
            }
        }
    }
}

#[test]
fn what_is_brighter_than_white_stays_so() {
    let image = Image::filled(8, 8, [0x4c00_u16, 0xbc00, 0x3800]).unwrap();
    let texels = Texels::straight(image.view()).half_floats();
    let t = Texture::from_texels(&texels, &LINEAR).unwrap();
    let f = Footprint { u: 3.3, v: 4.1, jacobian: Matrix2::new(2.0, 0.0, 0.0, 3.0) };
    assert_eq!(t.sample(&f, &Sampler::DEFAULT).0, [16.0, -1.0, 0.5, 1.0]);
    let compact = TextureOptions { storage: Storage::Compact, ..LINEAR };
    let t = Texture::from_texels(&texels, &compact).unwrap();
    assert_eq!(t.sample(&f, &Sampler::DEFAULT).0, [1.0, 0.0, 0.5, 1.0]);
}

#[test]
fn light_that_is_added_needs_no_alpha() {
    let image = Image::filled(3, 2, [5.0f32, 2.0, 0.25, 0.0]).unwrap();
    for space in [WorkingSpace::Linear, WorkingSpace::Srgb] {
        let options = TextureOptions { space, ..LINEAR };
        let t = Texture::from_texels(&Texels::premultiplied(image.view()), &options).unwrap();
        let texel = t.level(0).unwrap().row(0)[0];
        assert!(texel[0] > 2.0 && texel[3] == 0.0, "{texel:?}");
    }
}

#[test]
fn sixteen_bits_are_kept() {
    let image = Image::from_fn(256, 256, |x, y| [(x + 256 * y) as u16]).unwrap();
    let options = TextureOptions { space: WorkingSpace::Srgb, ..LINEAR };
    let t = Texture::from_texels(&Texels::straight(image.view()), &options).unwrap();
    let level = t.level(0).unwrap();
    for (texel, [code]) in level.pixels().iter().zip(image.pixels()) {
        assert_eq!((texel[0] * 65535.0 + 0.5) as u16, *code);
    }
    // Whole numbers are in 0…1, and so are samples, whatever the pyramid overshoots.
    let edge = Image::from_fn(64, 64, |x, _| [if x < 32 { 0 } else { 65535_u16 }]).unwrap();
    let t = Texture::from_texels(&Texels::straight(edge.view()), &options).unwrap();
    for i in 0..640 {
        let jacobian = Matrix2::new(4.0, 0.0, 0.0, 4.0);
        let f = Footprint { u: f64::from(i) * 0.1, v: 30.0, jacobian };
        let [r, _, _, a] = t.sample(&f, &Sampler::DEFAULT).0;
        assert!((0.0..=1.0).contains(&r) && a == 1.0);
    }
}

/// The same image in steps and in floats: far apart by no more than a step.
#[test]
fn floats_are_what_steps_are_rounded_from() {
    let image = noise(200, 160, 4);
    let make = |storage| {
        let options = TextureOptions { storage, ..LINEAR };
        Texture::new(image.view(), &options).unwrap()
    };
    let (steps, floats) = (make(Storage::Compact), make(Storage::Float));
    assert_eq!(steps.memory() * 2, floats.memory());
    let mut random = Random::new(8);
    for s in samplers() {
        for _ in 0..200 {
            let f = footprint(&mut random, 200, 160);
            let (a, b) = (steps.sample(&f, &s).0, floats.sample(&f, &s).0);
            assert!(a.iter().zip(b).all(|(a, b)| (a - b).abs() < 4e-4), "{f:?} {s:?} {a:?} {b:?}");
        }
    }
}
