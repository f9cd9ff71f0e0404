//! What holds for every texture, footprint and sampler.
#![allow(clippy::unwrap_used, reason = "a test helper may fail its test")]

mod common;

use common::{constant, ground, noise};
use proptest::prelude::*;
use scumble_geometry::{DVec2, Homography, Matrix2};
use scumble_pixel::{Image, Premul, WorkingSpace};
use scumble_texture::{
    Decimation, Footprint, Kernel, LevelMode, Levels, Magnify, PixelFilter, Sampler, Separable,
    Simd, Storage, StraightAlpha, TexelFormat, Texture, TextureBuilder, TextureOptions, Wrap,
};

/// A colour that bytes do not hold.
const BETWEEN_CODES: Wrap = Wrap::Constant(Premul([0.1, 0.2, 0.3, 0.5]));

fn wraps() -> impl Strategy<Value = Wrap> {
    prop_oneof![
        Just(Wrap::Clamp),
        Just(Wrap::Repeat),
        Just(Wrap::Mirror),
        Just(Wrap::Constant(Premul::TRANSPARENT)),
        Just(BETWEEN_CODES),
    ]
}

fn options() -> impl Strategy<Value = TextureOptions> {
    let space = prop_oneof![Just(WorkingSpace::Srgb), Just(WorkingSpace::Linear)];
    let decimation = prop_oneof![Just(Decimation::Kaiser), Just(Decimation::Box)];
    let levels = prop_oneof![
        4 => Just(Levels::All),
        1 => Just(Levels::BaseOnly),
        1 => (0usize..7, 0usize..7).prop_map(|(first, last)| Levels::Range { first, last }),
    ];
    let storage = prop::sample::select(vec![Storage::Compact, Storage::Float]);
    let all = (space, wraps(), decimation, levels, storage);
    all.prop_map(|(space, wrap, decimation, levels, storage)| TextureOptions {
        space,
        wrap,
        decimation,
        levels,
        window: None,
        outlines: [None; 3],
        storage,
    })
}

fn samplers() -> impl Strategy<Value = Sampler> {
    let pixel = prop_oneof![
        1 => Just(PixelFilter::Nearest),
        1 => Just(PixelFilter::Bilinear),
        1 => prop::sample::select(&Separable::ALL).prop_map(PixelFilter::Separable),
        1 => Just(PixelFilter::Probes),
        1 => Just(PixelFilter::Classic),
        4 => Just(PixelFilter::Ewa)
    ];
    let level = prop_oneof![
        1 => Just(LevelMode::Zero),
        1 => Just(LevelMode::Nearest),
        1 => Just(LevelMode::Linear),
        3 => Just(LevelMode::Auto)
    ];
    let preset = prop_oneof![Just(Sampler::FAST), Just(Sampler::DEFAULT), Just(Sampler::HIGH)];
    let kernel = prop_oneof![2 => Just(Kernel::Gaussian), 1 => prop::sample::select(&Kernel::ALL)];
    let magnify = prop_oneof![
        2 => Just(Magnify::None),
        2 => prop::sample::select(&Magnify::ALL),
        1 => prop::sample::select(&Kernel::ALL).prop_map(Magnify::Radial),
    ];
    (pixel, level, preset, kernel, magnify).prop_map(|(pixel, level, preset, kernel, magnify)| {
        Sampler { kernel, magnify, ..preset.with(pixel, level) }
    })
}

/// Numbers of every size, and those that are none.
fn component() -> impl Strategy<Value = f64> {
    prop_oneof![
        6 => -40.0..40.0f64,
        2 => -1e7..1e7f64,
        1 => prop::num::f64::ANY,
        1 => Just(0.0),
    ]
}

fn footprints() -> impl Strategy<Value = Footprint> {
    (component(), component(), [component(), component(), component(), component()])
        .prop_map(|(u, v, [a, b, c, d])| Footprint { u, v, jacobian: Matrix2::new(a, b, c, d) })
}

/// Of noise, opaque for every second seed: level 0 may be kept in codes then.
fn texture(width: usize, height: usize, seed: u64, options: &TextureOptions) -> Texture {
    let image = if seed.is_multiple_of(2) { opaque } else { noise };
    Texture::new(image(width, height, seed).view(), options).unwrap()
}

/// White noise in three channels.
fn opaque(width: usize, height: usize, seed: u64) -> Image<[u8; 4]> {
    noise(width, height, seed).map(|[r, g, b, _]| [*r, *g, *b, 255])
}

/// A rotation, a scale and a rotation.
fn turned(turns: [f64; 2], [major, minor]: [f64; 2]) -> Matrix2 {
    let [(s, c), (t, d)] = turns.map(f64::sin_cos);
    Matrix2::new(
        c * major * d - s * minor * t,
        -c * major * t - s * minor * d,
        s * major * d + c * minor * t,
        c * minor * d - s * major * t,
    )
}

proptest! {
    /// A place in a mirror shows what stands in front of it, to the bit, and as many periods on.
    #[test]
    fn a_mirror_shows_what_stands_before_it(
        (w, h) in (1usize..60, 1usize..60),
        // Not on the line between two texels, where the nearest is that on the right in both.
        (x, y) in (0u32..1 << 20, 0u32..1 << 20),
        (periods, mirrored) in ((-3i32..4, -3i32..4), (any::<bool>(), any::<bool>())),
        (turns, axes) in (prop::array::uniform2(0.0..7.0f64), prop::array::uniform2(0.0..9.0f64)),
        sampler in samplers(),
        seed in 0u64..4,
    ) {
        let wrap = Wrap::Mirror;
        let texture = texture(w, h, seed, &TextureOptions { wrap, ..TextureOptions::default() });
        let place = |x: u32, n: usize| (f64::from(x % (n as u32 * 64)) + 0.5) / 64.0;
        let (u, v, jacobian) = (place(x, w), place(y, h), turned(turns, axes));
        let before = texture.sample(&Footprint { u, v, jacobian }, &sampler);
        let along = |u: f64, n: usize, periods: i32, mirrored: bool| {
            let sign = if mirrored { -1.0 } else { 1.0 };
            (sign * u + f64::from(2 * periods) * n as f64, sign)
        };
        let (u, su) = along(u, w, periods.0, mirrored.0);
        let (v, sv) = along(v, h, periods.1, mirrored.1);
        let Matrix2 { a, b, c, d } = jacobian;
        let jacobian = Matrix2::new(a * su, b * su, c * sv, d * sv);
        let behind = Footprint { u, v, jacobian };
        prop_assert_eq!(texture.sample(&behind, &sampler), before, "{:?}", behind);
    }

    /// A texture that has only the levels that are said to be read gives what all of them give.
    #[test]
    fn the_levels_for_footprints_are_those_that_they_read(
        (w, h) in (1usize..200, 1usize..200),
        least in 0.0..40.0f64,
        ratio in 1.0..60.0f64,
        spread in 1.0..4.0f64,
        places in prop::collection::vec((-0.5..1.5f64, -0.5..1.5f64, 0.0..7.0f64, 0.0..7.0f64, 0.0..=1.0f64), 20),
        preset in prop::sample::select(vec![Sampler::FAST, Sampler::DEFAULT, Sampler::HIGH]),
        magnify in prop::sample::select(&Magnify::ALL),
        decimation in prop_oneof![Just(Decimation::Kaiser), Just(Decimation::Box)],
        wrap in wraps(),
    ) {
        let sampler = Sampler { magnify, ..preset };
        let (low, high) = ([least * ratio, least], [least * ratio * spread, least * spread]);
        let image = noise(w, h, 3);
        let all = TextureOptions { decimation, wrap, ..TextureOptions::default() };
        let some = TextureOptions { levels: sampler.levels_for(low, high), ..all };
        let all = Texture::new(image.view(), &all).unwrap();
        let some = Texture::new(image.view(), &some).unwrap();
        for (x, y, first, second, part) in places {
            let axes = [0, 1].map(|k| low[k] + (high[k] - low[k]) * part);
            let jacobian = turned([first, second], axes);
            let f = Footprint { u: x * w as f64, v: y * h as f64, jacobian };
            prop_assert_eq!(all.sample(&f, &sampler), some.sample(&f, &sampler), "{:?}", f);
        }
    }
}

proptest! {
    #[test]
    fn samples_are_finite_in_range_and_bounded(
        width in 1usize..40, height in 1usize..40, seed: u64,
        options in options(), sampler in samplers(), f in footprints(),
    ) {
        let t = texture(width, height, seed, &options);
        let Premul([r, g, b, a]) = t.sample(&f, &sampler);
        prop_assert!((0.0..=1.0).contains(&a));
        prop_assert!([r, g, b].iter().all(|v| (0.0..=a).contains(v)));
        prop_assert!(t.cost(&f, &sampler) <= 2 * (5 * 16_384 + 64));
    }

    #[test]
    fn a_constant_stays_constant_to_the_last_bit(
        width in 1usize..40, height in 1usize..40, texel: [u8; 4],
        options in options(), sampler in samplers(), f in footprints(),
    ) {
        // Another colour beyond it would be seen.
        let wrap = if let Wrap::Constant(_) = options.wrap { Wrap::Clamp } else { options.wrap };
        let options = TextureOptions { wrap, ..options };
        let t = Texture::new(constant(width, height, texel).view(), &options).unwrap();
        let expected = t.sample(&Footprint::point(0.5, 0.5), &Sampler::DEFAULT.with(PixelFilter::Nearest, LevelMode::Zero));
        prop_assert_eq!(t.sample(&f, &sampler), expected);
    }

    #[test]
    fn a_row_is_its_samples(
        seed: u64, options in options(), sampler in samplers(),
        x in -50.0..1300.0f64, y in -30.0..700.0f64,
    ) {
        let t = texture(37, 51, seed, &options);
        for map in [ground(64), Homography::IDENTITY] {
            let mut row = [Premul::TRANSPARENT; 21];
            t.sample_row(&map, DVec2::new(x, y), &sampler, &mut row);
            for (i, c) in row.iter().enumerate() {
                let f = Footprint::at(&map, DVec2::new(x + i as f64, y));
                prop_assert_eq!(*c, t.sample(&f, &sampler));
            }
        }
    }

    /// An image whose rows come one by one is not known to be opaque before it is kept: its level 0 is in
    /// steps.
    #[test]
    fn an_opaque_image_is_kept_in_half_the_memory_and_is_the_same(
        width in 1usize..90, height in 1usize..90, seed: u64,
        options in options(), sampler in samplers(), f in footprints(),
        x in -50.0..1300.0f64, y in -30.0..700.0f64,
    ) {
        let image = opaque(width, height, seed);
        let codes = Texture::new(image.view(), &options).unwrap();
        let format = TexelFormat::<[u8; 4], StraightAlpha>::straight();
        let mut builder = TextureBuilder::new(width, height, format, &options).unwrap();
        builder.push_rows(image.pixels()).unwrap();
        let steps = builder.finish().unwrap();
        let base = codes.level(0).unwrap();
        let halved = options.space == WorkingSpace::Srgb
            && options.storage == Storage::Compact
            && (base.width(), base.height()) == (width, height)
            && options.wrap != BETWEEN_CODES;
        prop_assert_eq!(codes.memory() < steps.memory(), halved);
        if halved && codes.level_count() == 1 {
            prop_assert_eq!(codes.memory() * 2, steps.memory());
        }
        for l in 0..steps.level_count() {
            prop_assert_eq!(codes.level(l), steps.level(l));
        }
        for simd in Simd::all() {
            let (codes, steps) = (codes.clone().with_simd(simd), steps.clone().with_simd(simd));
            prop_assert_eq!(codes.sample(&f, &sampler), steps.sample(&f, &sampler));
            for map in [ground(64), Homography::IDENTITY] {
                let [mut one, mut other] = [[Premul::TRANSPARENT; 21]; 2];
                codes.sample_row(&map, DVec2::new(x, y), &sampler, &mut one);
                steps.sample_row(&map, DVec2::new(x, y), &sampler, &mut other);
                prop_assert_eq!(one, other, "{:?}", simd);
            }
        }
    }

    #[test]
    fn every_instruction_set_gives_the_same_bits(
        width in 1usize..40, height in 1usize..40, seed: u64,
        options in options(), sampler in samplers(), f in footprints(),
        x in -50.0..1300.0f64, y in -30.0..700.0f64,
    ) {
        let t = texture(width, height, seed, &options).with_simd(Simd::SCALAR);
        let one = t.sample(&f, &sampler);
        let mut row = [Premul::TRANSPARENT; 21];
        t.sample_row(&ground(64), DVec2::new(x, y), &sampler, &mut row);
        for simd in Simd::all() {
            let t = t.clone().with_simd(simd);
            prop_assert_eq!(t.sample(&f, &sampler), one, "{:?}", simd);
            let mut other = [Premul::TRANSPARENT; 21];
            t.sample_row(&ground(64), DVec2::new(x, y), &sampler, &mut other);
            prop_assert_eq!(other, row, "{:?}", simd);
        }
    }

    #[test]
    fn a_repeating_texture_has_no_origin(
        seed: u64, sampler in samplers(), u in 0.0..32.0f64, v in 0.0..32.0f64,
        i in -3i32..4, j in -3i32..4, a in -4.0..4.0f64, d in -4.0..4.0f64,
    ) {
        let options = TextureOptions { wrap: Wrap::Repeat, ..TextureOptions::default() };
        let t = texture(32, 32, seed, &options);
        let jacobian = Matrix2::new(a, 0.5, -0.5, d);
        // Quarters survive the translation exactly.
        let (u, v) = ((u * 4.0).floor() / 4.0, (v * 4.0).floor() / 4.0);
        let here = t.sample(&Footprint { u, v, jacobian }, &sampler);
        let (u, v) = (u + 32.0 * f64::from(i), v + 32.0 * f64::from(j));
        prop_assert_eq!(t.sample(&Footprint { u, v, jacobian }, &sampler), here);
    }

    #[test]
    fn the_sign_of_an_axis_does_not_matter(
        seed: u64, u in 0.0..48.0f64, v in 0.0..48.0f64,
        [a, b, c, d] in [-9.0..9.0f64, -9.0..9.0f64, -9.0..9.0f64, -9.0..9.0f64],
    ) {
        let t = texture(48, 48, seed, &TextureOptions::default());
        for (s, scale) in [(Sampler::DEFAULT, 1.0), (Sampler::HIGH, 1.0), (Sampler::HIGH, 0.1)] {
            let [a, b, c, d] = [a, b, c, d].map(|v| v * scale);
            let of = |a, b, c, d| t.sample(&Footprint { u, v, jacobian: Matrix2::new(a, b, c, d) }, &s);
            let one = of(a, b, c, d);
            prop_assert_eq!(one, of(-a, b, -c, d));
            prop_assert_eq!(one, of(b, a, d, c));
        }
    }
}
