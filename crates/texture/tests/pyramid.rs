//! The pyramid: sizes, memory, means, borders.
#![allow(clippy::unwrap_used, reason = "a test helper may fail its test")]

mod common;

use common::{grey, noise};
use scumble_geometry::Matrix2;
use scumble_pixel::{Image, WorkingSpace};
use scumble_texture::{
    Decimation, Footprint, Levels, Sampler, Texture, TextureError, TextureOptions, Wrap,
};

fn mean(t: &Texture, level: usize) -> [f64; 4] {
    let level = t.level(level).unwrap();
    let mut sum = [0.0; 4];
    for y in 0..level.height() {
        for texel in level.row(y) {
            for c in 0..4 {
                sum[c] += f64::from(texel[c]);
            }
        }
    }
    sum.map(|v| v / (level.width() * level.height()) as f64)
}

const SIZES: [(usize, usize); 9] =
    [(1, 1), (1, 37), (64, 1), (2, 2), (3, 3), (5, 7), (64, 48), (63, 65), (100, 33)];

#[test]
fn levels_halve_down_to_one() {
    for (w, h) in SIZES {
        let options = TextureOptions::default();
        let t = Texture::new(noise(w, h, 1).view(), &options).unwrap();
        let sizes: Vec<_> = (0..t.level_count())
            .map(|l| t.level(l).map(|l| (l.width(), l.height())).unwrap())
            .collect();
        assert_eq!(sizes[0], (w, h));
        assert_eq!(sizes.last(), Some(&(1, 1)));
        for pair in sizes.windows(2) {
            assert_eq!(pair[1], ((pair[0].0 / 2).max(1), (pair[0].1 / 2).max(1)));
        }
        assert!(t.level(t.level_count()).is_none());
        assert_eq!(Some(t.memory()), Texture::memory_for(w, h, &options));
    }
}

#[test]
fn every_level_keeps_the_mean() {
    for (w, h) in SIZES {
        for decimation in [Decimation::Kaiser, Decimation::Box] {
            for wrap in [Wrap::Clamp, Wrap::Repeat, Wrap::Mirror] {
                for space in [WorkingSpace::Srgb, WorkingSpace::Linear] {
                    let options = TextureOptions { decimation, wrap, space, ..Default::default() };
                    let t = Texture::new(noise(w, h, 5).view(), &options).unwrap();
                    for l in 1..t.level_count() {
                        // Texels are rounded to a step once a level, each way alike.
                        let level = t.level(l).unwrap();
                        let texels = (level.width() * level.height()) as f64;
                        let rounding = 1.5 / 16_320.0 / texels.sqrt();
                        for (a, b) in mean(&t, 0).iter().zip(mean(&t, l)) {
                            assert!(
                                (a - b).abs() < 1e-5 + rounding,
                                "{w}×{h} {options:?} level {l}: {a} {b}"
                            );
                        }
                    }
                }
            }
        }
    }
}

#[test]
fn box_levels_of_an_even_image_are_plain_means() {
    let image = grey(4, 2, |x, y| (x * 10 + y * 100) as u8);
    let options = TextureOptions { decimation: Decimation::Box, ..Default::default() };
    let t = Texture::new(image.view(), &options).unwrap();
    let row: Vec<f32> = t.level(1).unwrap().row(0).iter().map(|t| t[0] * 255.0).collect();
    assert!((row[0] - 55.0).abs() < 1e-4 && (row[1] - 75.0).abs() < 1e-4, "{row:?}");
}

#[test]
fn transparent_texels_lend_no_colour() {
    // Half opaque red, half transparent green: the mean is half-covered red.
    let image = Image::from_vec(2, 1, vec![[255, 0, 0, 255], [0, 255, 0, 0]]).unwrap();
    let t = Texture::new(image.view(), &TextureOptions::default()).unwrap();
    assert_eq!(t.level(1).unwrap().row(0)[0], [0.5, 0.0, 0.0, 0.5]);
}

#[test]
fn linear_light_averages_light() {
    let image = Image::from_vec(2, 1, vec![[255, 255, 255, 255], [0, 0, 0, 255]]).unwrap();
    let options = TextureOptions { space: WorkingSpace::Linear, ..Default::default() };
    let t = Texture::new(image.view(), &options).unwrap();
    assert_eq!(t.level(1).unwrap().row(0)[0], [0.5, 0.5, 0.5, 1.0]);
}

#[test]
fn the_base_alone_is_the_base_alone() {
    let options = TextureOptions { levels: Levels::BaseOnly, ..Default::default() };
    let t = Texture::new(noise(9, 9, 1).view(), &options).unwrap();
    assert_eq!(t.level_count(), 1);
    // Eight texels on every side are what lies beyond the edge.
    assert_eq!(t.memory(), (9 + 16) * (9 + 16) * 8);
}

#[test]
fn impossible_textures_are_errors() {
    let empty = Image::from_vec(0, 3, vec![]).unwrap();
    let made = Texture::new(empty.view(), &TextureOptions::default());
    assert_eq!(made.err(), Some(TextureError::Empty));
    assert_eq!(Texture::memory_for(usize::MAX, 2, &TextureOptions::default()), None);
    assert_eq!(Texture::memory_for(1 << 40, 1 << 30, &TextureOptions::default()), None);
    assert_eq!(Texture::memory_for(0, 0, &TextureOptions::default()), Some(0));
}

#[test]
fn a_renewed_texture_is_a_new_one() {
    // Of the same size, and of others; a tile has an apron that must be its own.
    let first = Texture::new(noise(48, 37, 1).view(), &TextureOptions::default()).unwrap();
    for (w, h, wrap) in [(48, 37, Wrap::Repeat), (48, 37, Wrap::Clamp), (96, 5, Wrap::Mirror)] {
        let options = TextureOptions { wrap, ..Default::default() };
        let image = noise(w, h, 2);
        let new = Texture::new(image.view(), &options).unwrap();
        let renewed = first.clone().renewed(image.view(), &options).unwrap();
        assert_eq!(renewed.level_count(), new.level_count());
        for l in 0..new.level_count() {
            assert_eq!(renewed.level(l).unwrap().pixels(), new.level(l).unwrap().pixels());
        }
        for i in 0..50 {
            let f = Footprint {
                u: f64::from(i) * 1.7 - 20.0,
                v: f64::from(i) * 0.9,
                jacobian: Matrix2::new(3.0, 1.0, 0.2, 0.9),
            };
            assert_eq!(renewed.sample(&f, &Sampler::DEFAULT), new.sample(&f, &Sampler::DEFAULT));
        }
    }
}
