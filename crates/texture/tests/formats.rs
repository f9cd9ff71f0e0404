//! Images of every format, parts of pyramids, and pyramids of flat colours.

#![allow(clippy::unwrap_used, reason = "a test helper may fail its test")]
#![allow(
    clippy::redundant_closure,
    reason = "the function alone is not general enough in its lifetime"
)]

mod common;

use common::{Random, noise};
use proptest::prelude::*;
use scumble_geometry::{IntRect, Matrix2};
use scumble_pixel::{Image, ImageView, WorkingSpace, srgb};
use scumble_texture::{
    Alpha, Channels, Footprint, Levels, Sampler, Storage, Texels, Texture, TextureError,
    TextureOptions,
};

const SPACES: [WorkingSpace; 2] = [WorkingSpace::Srgb, WorkingSpace::Linear];

/// Half a step of what a texture stores, and a float's rounding.
const STEP: f32 = 0.51 / 16_320.0;

fn options(space: WorkingSpace) -> TextureOptions {
    TextureOptions { space, levels: Levels::BaseOnly, ..Default::default() }
}

/// The texel that one pixel becomes.
fn one<P: Channels, A: Alpha>(
    space: WorkingSpace,
    pixel: P,
    texels: impl FnOnce(ImageView<'_, P>) -> Texels<'_, P, A>,
) -> [f32; 4] {
    let memory = [pixel];
    let texels = texels(ImageView::new(1, 1, 1, &memory).unwrap());
    Texture::from_texels(&texels, &options(space)).unwrap().level(0).unwrap().row(0)[0]
}

/// Within one step: a value half way between two may go either way. (Two multiples of a step that
/// are neighbours differ by it only to the last bit.)
fn near(a: [f32; 4], b: [f32; 4]) -> bool {
    a.iter().zip(b).all(|(a, b)| (a - b).abs() <= 2.0 * STEP)
}

proptest! {
    #[test]
    fn bytes_are_what_the_usual_way_makes_of_them(pixel: [u8; 4]) {
        for space in SPACES {
            let usual = Texture::new(ImageView::new(1, 1, 1, &[pixel]).unwrap(), &options(space)).unwrap();
            let usual = usual.level(0).unwrap().row(0)[0];
            prop_assert!(near(one(space, pixel, |v| Texels::straight(v)), usual));
            // Every code of 8 bits is one of 16.
            prop_assert!(near(one(space, pixel.map(|v| u16::from(v) * 257), |v| Texels::straight(v)), usual));
            let float = pixel.map(|v| f32::from(v) / 255.0);
            prop_assert!(near(one(space, float, |v| Texels::straight(v).encoded()), usual));
            let [r, g, b, a] = float;
            let light = [srgb::decode(r), srgb::decode(g), srgb::decode(b), a];
            prop_assert!(near(one(space, light, |v| Texels::straight(v)), usual));
            let premultiplied = [r * a, g * a, b * a, a];
            let found = one(space, premultiplied, |v| Texels::premultiplied(v).encoded());
            prop_assert!(near(found, usual), "{:?} {:?}", found, usual);
            let premultiplied = [light[0] * a, light[1] * a, light[2] * a, a];
            prop_assert!(near(one(space, premultiplied, |v| Texels::premultiplied(v)), usual));
        }
    }

    #[test]
    fn fewer_channels_are_grey_or_opaque([r, g, b, a]: [u16; 4]) {
        for space in SPACES {
            let of = |pixel: [u16; 4]| one(space, pixel, |v| Texels::straight(v));
            prop_assert_eq!(one(space, [r], |v| Texels::straight(v)), of([r, r, r, u16::MAX]));
            prop_assert_eq!(one(space, [r, a], |v| Texels::straight(v)), of([r, r, r, a]));
            prop_assert_eq!(one(space, [r, g, b], |v| Texels::straight(v)), of([r, g, b, u16::MAX]));
        }
    }

    #[test]
    fn half_floats_are_floats(bits: [u16; 4]) {
        let float = bits.map(|b| {
            let magnitude = f32::from_bits(u32::from(b & 0x7fff) << 13) * 2f32.powi(112);
            let value = if b & 0x7c00 == 0x7c00 {
                if b & 0x3ff == 0 { f32::INFINITY } else { f32::NAN }
            } else {
                magnitude
            };
            if b & 0x8000 == 0 { value } else { -value }
        });
        for space in SPACES {
            let found = one(space, bits, |v| Texels::straight(v).half_floats());
            prop_assert_eq!(found, one(space, float, |v| Texels::straight(v)));
        }
    }

    #[test]
    fn any_float_is_taken(pixel: [f32; 4], wild in prop::array::uniform4(prop::num::f32::ANY)) {
        for pixel in [pixel, wild] {
            for space in SPACES {
                let finite = [
                    one(space, pixel, |v| Texels::straight(v)),
                    one(space, pixel, |v| Texels::premultiplied(v)),
                ];
                for texel in finite {
                    prop_assert!(texel.iter().all(|v| v.is_finite()), "{:?}", texel);
                    prop_assert!((0.0..=1.0).contains(&texel[3]));
                }
                let memory = [pixel];
                let view = ImageView::new(1, 1, 1, &memory).unwrap();
                let compact =
                    TextureOptions { storage: Storage::Compact, ..options(space) };
                let cut = |t: Result<Texture, TextureError>| t.unwrap().level(0).unwrap().row(0)[0];
                let [r, g, b, a] = cut(Texture::from_texels(&Texels::straight(view), &compact));
                let [x, y, z, w] = cut(Texture::from_texels(&Texels::premultiplied(view), &compact));
                prop_assert!([r, g, b].iter().all(|v| (0.0..=a).contains(v)) && a <= 1.0);
                prop_assert!([x, y, z].iter().all(|v| (0.0..=w + STEP).contains(v)) && w <= 1.0);
            }
        }
    }
}

#[test]
fn integers_may_be_light() {
    let found = one(WorkingSpace::Linear, [0x8000_u16; 3], |v| Texels::straight(v).in_light());
    assert!((found[0] - 0.5).abs() < 1e-4, "{found:?}");
}

#[test]
fn foreign_memory_with_a_stride_is_read_in_place() {
    let memory: Vec<[u8; 1]> = (0..60).map(|i| [i as u8 * 4]).collect();
    let view = ImageView::new(7, 5, 11, &memory[3..]).unwrap();
    let t = Texture::from_texels(&Texels::straight(view), &options(WorkingSpace::Srgb)).unwrap();
    for y in 0..5 {
        for x in 0..7 {
            let texel = t.level(0).unwrap().row(y)[x][0];
            assert!((texel - f32::from(memory[3 + 11 * y + x][0]) / 255.0).abs() <= STEP);
        }
    }
    let nothing = ImageView::<[u8; 3]>::new(0, 5, 0, &[]).unwrap();
    let error = Texture::from_texels(&Texels::straight(nothing), &TextureOptions::default());
    assert_eq!(error.unwrap_err(), TextureError::Empty);
}

/// Images of these pixels, of every width and with one pixel that is not opaque anywhere or none.
fn sees_every_alpha<P: Channels>(opaque: P, clear: P) {
    for width in 1..40 {
        let mut pixels = vec![opaque; 2 * width];
        let is_opaque = |pixels: &[P]| {
            Texels::straight(ImageView::new(width, 2, width, pixels).unwrap()).is_opaque()
        };
        assert!(is_opaque(&pixels));
        for i in 0..pixels.len() {
            pixels[i] = clear;
            assert!(!is_opaque(&pixels), "{i} of {width}");
            pixels[i] = opaque;
        }
    }
}

#[test]
fn one_pixel_that_is_not_opaque_is_found() {
    sees_every_alpha([7u8, 0, 255, 255], [255, 255, 255, 254]);
    sees_every_alpha([0u8, 255], [255, 127]);
    sees_every_alpha([0u16, 7, 9, 65535], [65535, 65535, 65535, 65534]);
    sees_every_alpha([9.0, 1.0], [1.0, 0.999]);
}

/// Only what is kept of level 0 has to be opaque for it to be kept in bytes.
#[test]
fn pixels_beyond_the_window_do_not_matter() {
    let mut image = Image::filled(64, 64, [1, 2, 3, 255]).unwrap();
    image.row_mut(0)[63] = [1, 2, 3, 0];
    let memory = |window| {
        let options = TextureOptions { window, levels: Levels::BaseOnly, ..Default::default() };
        let texture = Texture::new(image.view(), &options).unwrap();
        (texture.memory(), Texture::memory_for(64, 64, &options).unwrap())
    };
    let (found, most) = memory(None);
    assert_eq!(found, most);
    let (found, most) = memory(Some(IntRect::new(0, 20, 40, 50)));
    assert_eq!(2 * found, most);
    let (found, most) = memory(Some(IntRect::new(30, 0, 60, 20)));
    assert_eq!(found, most);
}

#[test]
fn a_part_of_a_pyramid_gives_what_the_whole_gives_there() {
    for (width, height) in [(256, 256), (301, 200)] {
        let image = noise(width, height, 3);
        let make = |levels| {
            Texture::new(image.view(), &TextureOptions { levels, ..Default::default() }).unwrap()
        };
        let all = make(Levels::All);
        let part = make(Levels::Range { first: 2, last: 4 });
        assert_eq!((part.width(), part.height(), part.level_count()), (width, height, 3));
        assert_eq!(part.level(0), all.level(2));
        assert_eq!(part.level(2), all.level(4));
        assert!(part.memory() * 8 < all.memory());
        let levels = Levels::Range { first: 2, last: 4 };
        let said =
            Texture::memory_for(width, height, &TextureOptions { levels, ..Default::default() });
        assert_eq!(said, Some(part.memory()));
        let mut random = Random::new(9);
        for _ in 0..200 {
            let scale = random.range(8.0, 20.0);
            let (s, c) = random.range(0.0, 7.0).sin_cos();
            let jacobian = Matrix2::new(scale * c, -scale * s, scale * s, scale * c);
            let (u, v) = (random.range(0.0, width as f64), random.range(0.0, height as f64));
            let f = Footprint { u, v, jacobian };
            // The reconstruction's share of the variance is that of the first level here.
            let (a, b) = (all.sample(&f, &Sampler::HIGH).0, part.sample(&f, &Sampler::HIGH).0);
            assert!(a.iter().zip(b).all(|(a, b)| (a - b).abs() < 0.012), "{a:?} {b:?}");
        }
    }
    // Anything asked for is brought back to what there is.
    for (first, last) in [(0, 0), (9, 3), (usize::MAX, usize::MAX), (0, usize::MAX), (3, 1)] {
        let levels = Levels::Range { first, last };
        let options = TextureOptions { levels, ..Default::default() };
        let t = Texture::new(noise(20, 9, 1).view(), &options).unwrap();
        assert!(t.level_count() >= 1);
        assert_eq!(Some(t.memory()), Texture::memory_for(20, 9, &options));
    }
}

/// The best single test of a level's choice (after OpenImageIO's): the minor axis fixed, everything
/// else varied, and the answer must be one colour all the time.
#[test]
fn over_flat_levels_every_footprint_of_one_minor_axis_has_one_colour() {
    let t = Texture::colored_levels(512, 512, &TextureOptions::default()).unwrap();
    let s = Sampler { blend: false, ..Sampler::DEFAULT };
    // Minor axes in the middle of a level's range: σ = 0.85 of its texels.
    let colors = [[1.0, 1.0, 0.0], [0.0, 1.0, 0.0], [0.0, 1.0, 1.0], [0.0, 0.0, 1.0]];
    for (l, [r, g, b]) in colors.into_iter().enumerate() {
        let minor = 2.0 * 0.85 * 2f64.powi(l as i32 + 1);
        for ratio in [1.0, 1.5, 3.0, 8.0, 20.0, 31.0] {
            for turn in 0..24 {
                let (sin, cos) = (f64::from(turn) * 0.26).sin_cos();
                let major = minor * ratio;
                let jacobian = Matrix2::new(major * cos, -minor * sin, major * sin, minor * cos);
                let found = t.sample(&Footprint { u: 250.0, v: 260.0, jacobian }, &s).0;
                assert_eq!(found, [r, g, b, 1.0], "level {}, {ratio}:1, turn {turn}", l + 1);
            }
        }
    }
    // And trilinear goes from one to the next.
    let square =
        |scale| Footprint { u: 250.0, v: 260.0, jacobian: Matrix2::new(scale, 0.0, 0.0, scale) };
    let linear = |scale| scumble_texture::compare::trilinear(&t, &square(scale)).0;
    assert_eq!(linear(1.0), [1.0, 0.0, 0.0, 1.0]);
    assert_eq!(linear(4.0), [0.0, 1.0, 0.0, 1.0]);
    let between = linear(3.0);
    assert!(
        (between[0] - (1.0 - (3f32.log2() - 1.0))).abs() < 1e-4 && between[1] == 1.0,
        "{between:?}"
    );
}

#[test]
fn an_image_and_its_view_are_alike() {
    let image: Image<[u8; 4]> = noise(12, 10, 4);
    let a = Texture::new(image.view(), &TextureOptions::default()).unwrap();
    let b =
        Texture::from_texels(&Texels::straight(image.view()), &TextureOptions::default()).unwrap();
    for l in 0..a.level_count() {
        let (a, b) = (a.level(l).unwrap(), b.level(l).unwrap());
        let pairs = a.pixels().as_flattened().iter().zip(b.pixels().as_flattened());
        assert!(pairs.into_iter().all(|(a, b)| (a - b).abs() <= 3.0 * STEP));
    }
}

#[test]
fn a_constant_between_two_steps_goes_one_way_in_every_level() {
    // 206·203/255 of 64 steps is a hair below a half.
    for (code, alpha) in (0..=255u8).map(|i| (i, 203)).chain((0..=255).map(|i| (206, i))) {
        for space in SPACES {
            let image = common::constant(4, 6, [code, 0, 255, alpha]);
            let options = TextureOptions { space, ..Default::default() };
            let own = Texels::straight(image.view());
            for t in [Texture::new(image.view(), &options), Texture::from_texels(&own, &options)] {
                let t = t.unwrap();
                let first = t.level(0).unwrap().row(0)[0];
                for l in 0..t.level_count() {
                    assert!(
                        t.level(l).unwrap().pixels().iter().all(|p| *p == first),
                        "{code} {alpha} {space:?} {l} {:?} {first:?}",
                        t.level(l).unwrap().pixels()
                    );
                }
            }
        }
    }
}
