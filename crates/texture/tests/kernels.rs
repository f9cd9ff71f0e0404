//! Kernels beside the Gaussian, interpolation, and the way from minified to magnified.

#![allow(clippy::unwrap_used, reason = "a test helper may fail its test")]

mod common;

use common::{grey, noise};
use scumble_geometry::Matrix2;
use scumble_pixel::Image;
use scumble_texture::{
    Footprint, Kernel, LevelMode, Magnify, PixelFilter, RadialFilter, Sampler, Separable, Texture,
    TextureOptions, Wrap,
};
use std::sync::LazyLock;

static WELCH: LazyLock<RadialFilter> =
    LazyLock::new(|| RadialFilter::new(1.2, |r2| 1.0 - r2 / 1.44));

fn kernels() -> impl Iterator<Item = Kernel> {
    Kernel::ALL.into_iter().chain([Kernel::Own(&WELCH)])
}

fn tiled(image: &scumble_pixel::Image<[u8; 4]>) -> Texture {
    let options = TextureOptions { wrap: Wrap::Repeat, ..Default::default() };
    Texture::new(image.view(), &options).unwrap()
}

fn turned(u: f64, v: f64, major: f64, minor: f64, angle: f64) -> Footprint {
    let (s, c) = angle.sin_cos();
    Footprint { u, v, jacobian: Matrix2::new(major * c, -minor * s, major * s, minor * c) }
}

fn red(t: &Texture, f: &Footprint, s: &Sampler) -> f64 {
    f64::from(t.sample(f, s).0[0])
}

#[test]
fn every_kernel_passes_what_is_coarse_and_stops_what_is_fine() {
    // Waves of a fifth of and of two and a half times the limit of sampling, three texels a pixel.
    let wave = |cycles: f64| {
        tiled(&grey(300, 300, |x, _| {
            (127.5 + 127.0 * (core::f64::consts::TAU * cycles * x as f64 / 300.0).cos()) as u8
        }))
    };
    let (coarse, fine) = (wave(10.0), wave(125.0));
    for k in kernels() {
        let s = Sampler { kernel: k, ..Sampler::DEFAULT };
        let contrast = |t: &Texture| {
            let values =
                (0..90).map(|i| red(t, &turned(f64::from(i) * 0.7, 0.5, 3.0, 3.0, 0.3), &s));
            let (low, high) = values.fold((1.0f64, 0.0f64), |(l, h), v| (l.min(v), h.max(v)));
            high - low
        };
        let (passed, stopped) = (contrast(&coarse), contrast(&fine));
        println!("{k:?}: passes {passed:.3}, lets through {stopped:.4}");
        let alias = if k == Kernel::Box { 0.2 } else { 0.05 };
        assert!(passed > 0.85 && stopped < alias, "{k:?}: {passed} {stopped}");
    }
}

#[test]
fn sharpness_has_the_order_of_the_table() {
    let t = tiled(&grey(128, 128, |x, _| if (x / 8) % 2 == 0 { 255 } else { 0 }));
    // The slope of an edge: two texels a pixel.
    let slope = |kernel| {
        let s = Sampler { kernel, ..Sampler::DEFAULT };
        red(&t, &turned(63.0, 20.3, 2.0, 2.0, 0.0), &s)
            - red(&t, &turned(65.0, 20.3, 2.0, 2.0, 0.0), &s)
    };
    let order = [Kernel::Gaussian, Kernel::Triangle, Kernel::Lanczos2];
    let slopes = order.map(slope);
    assert!(slopes.is_sorted_by(|a, b| a.abs() < b.abs()), "{slopes:?}");
}

#[test]
fn the_two_halves_of_a_kernel_balance() {
    // A ramp: any symmetric kernel reads its centre.
    let t = Texture::new(grey(128, 128, |x, _| (x * 2) as u8).view(), &TextureOptions::default());
    let t = t.unwrap();
    for k in kernels() {
        let s = Sampler { kernel: k, ..Sampler::DEFAULT };
        for i in 0..100 {
            let u = 50.0 + f64::from(i) * 0.13;
            let found = red(&t, &turned(u, 60.2, 3.0, 2.0, 0.1 * f64::from(i)), &s) * 127.5;
            let bar = if k == Kernel::Box { 0.7 } else { 0.12 };
            assert!((found - (u - 0.5)).abs() < bar, "{k:?} at {u}: {found}");
        }
    }
}

#[test]
fn separable_kernels_interpolate() {
    let t = tiled(&noise(16, 16, 5));
    let at = |u: f64, v: f64, k| {
        t.sample(
            &Footprint::point(u, v),
            &Sampler::DEFAULT.with(PixelFilter::Separable(k), LevelMode::Zero),
        )
        .0
    };
    for k in [Separable::CatmullRom, Separable::Lanczos2, Separable::Lanczos3] {
        for (x, y) in [(0, 0), (5, 9), (15, 15)] {
            let texel = t.level(0).unwrap().row(y)[x];
            let found = at(x as f64 + 0.5, y as f64 + 0.5, k);
            assert!(found.iter().zip(texel).all(|(a, b)| (a - b).abs() < 1e-4), "{k:?}");
        }
    }
    // Catmull and Rom's cubic is exact on a parabola.
    let image = grey(16, 4, |x, _| (x * x) as u8);
    let t = Texture::new(image.view(), &TextureOptions::default()).unwrap();
    for i in 0..40 {
        let x = 4.0 + f64::from(i) * 0.2;
        let s =
            Sampler::DEFAULT.with(PixelFilter::Separable(Separable::CatmullRom), LevelMode::Zero);
        let found = red(&t, &Footprint::point(x + 0.5, 2.0), &s) * 255.0;
        assert!((found - x * x).abs() < 5e-3, "{x}: {found}");
    }
}

#[test]
fn magnified_is_interpolated_and_minified_is_not() {
    let t = tiled(&noise(32, 32, 7));
    let ways = [
        (Magnify::Bilinear, PixelFilter::Bilinear),
        (Magnify::CatmullRom, PixelFilter::Separable(Separable::CatmullRom)),
        (Magnify::Mitchell, PixelFilter::Separable(Separable::Mitchell)),
        (Magnify::Lanczos2, PixelFilter::Separable(Separable::Lanczos2)),
    ];
    for (magnify, pixel) in ways {
        for kernel in [Kernel::Gaussian, Kernel::Triangle] {
            let s = Sampler { magnify, kernel, ..Sampler::DEFAULT };
            let plain = Sampler { kernel, ..Sampler::DEFAULT };
            let point = Sampler::DEFAULT.with(pixel, LevelMode::Zero);
            let near = turned(9.3, 21.8, 0.74, 0.2, 1.0);
            // Weights in whole numbers and weights in floats.
            let (found, point) = (t.sample(&near, &s).0, t.sample(&near, &point).0);
            let off = found.iter().zip(point).map(|(a, b)| (a - b).abs()).fold(0.0, f32::max);
            assert!(off < 1e-4, "{magnify:?}: {off}");
            // Long and thin is not magnified, however thin.
            let long = turned(9.3, 21.8, 1.51, 0.001, 1.0);
            assert_eq!(t.sample(&long, &s), t.sample(&long, &plain), "{magnify:?}");
        }
    }
}

#[test]
fn the_transition_has_no_seam() {
    let t = tiled(&noise(32, 32, 8));
    let radial = [Kernel::Lanczos2, Kernel::Mitchell].map(Magnify::Radial);
    for magnify in Magnify::ALL.into_iter().chain(radial) {
        for kernel in [Kernel::Gaussian, Kernel::Triangle, Kernel::Mitchell] {
            let s = Sampler { magnify, kernel, ..Sampler::DEFAULT };
            let mut worst = 0.0f64;
            for k in 0..8 {
                let place = |i: i32| {
                    let major = 0.5 + f64::from(i) * 0.0005;
                    turned(3.1 * f64::from(k), 7.7, major, 0.4 * major, 0.7)
                };
                for i in 0..3000 {
                    worst = worst.max((red(&t, &place(i + 1), &s) - red(&t, &place(i), &s)).abs());
                }
            }
            println!("{magnify:?} {kernel:?}: {worst:.5}");
            // White noise, whose neighbours differ by 1: a switch would be a tenth and more.
            assert!(worst < 0.006, "{magnify:?} {kernel:?}: {worst}");
        }
    }
}

#[test]
fn blended_weights_end_in_either_kernel() {
    let t = tiled(&noise(32, 32, 9));
    let of = |magnify, kernel, f: &Footprint| {
        t.sample(f, &Sampler { magnify, kernel, ..Sampler::DEFAULT })
    };
    let near = turned(9.3, 21.8, 0.7, 0.4, 0.3);
    let far = turned(9.3, 21.8, 2.9, 1.6, 0.3);
    let paper = Magnify::Radial(Kernel::Lanczos2);
    assert_eq!(of(paper, Kernel::Triangle, &far), of(Magnify::None, Kernel::Triangle, &far));
    // Wholly magnified, the other kernel does not matter.
    let found = of(paper, Kernel::Triangle, &near).0;
    let same = of(paper, Kernel::Lanczos2, &near).0;
    assert!(found.iter().zip(same).all(|(a, b)| (a - b).abs() < 1e-6), "{found:?} {same:?}");
    // Sharper than what a Gaussian makes of a single texel.
    let dot = tiled(&grey(16, 16, |x, y| if (x, y) == (8, 8) { 255 } else { 0 }));
    let at = |magnify| {
        red(&dot, &turned(8.5, 8.5, 0.3, 0.3, 0.0), &Sampler { magnify, ..Sampler::DEFAULT })
    };
    assert!(at(paper) > at(Magnify::None) + 0.2, "{} {}", at(paper), at(Magnify::None));
}

#[test]
fn taps_are_the_integral_over_the_bilinear_surface() {
    use scumble_geometry::{DVec2, Homography};
    use scumble_texture::reference::{PixelShape, Reference};
    let t = tiled(&noise(32, 32, 10));
    let truth = Reference::new(&t, PixelShape::Gaussian { sigma: 0.5 }).with_density(4.0, 32);
    // White noise, the worst that a texture can be; the last bars hold the blend with the ellipse.
    for (major, gain, bar) in
        [(0.3, 20.0, 58.0), (0.6, 7.0, 49.0), (0.75, 2.0, 46.0), (0.9, 0.0, 45.0)]
    {
        let of = |magnify| {
            let s = Sampler { magnify, ..Sampler::DEFAULT };
            let error: f64 = (0..60)
                .map(|i| {
                    let i = f64::from(i);
                    let f = turned(i * 0.37, i * 0.83, major, 0.6 * major, 0.21 * i);
                    let j = f.jacobian;
                    let map = Homography::new([[j.a, j.b, f.u], [j.c, j.d, f.v], [0.0, 0.0, 1.0]]);
                    let truth = truth.sample(&map, DVec2::ZERO);
                    (0..4)
                        .map(|c| (f64::from(t.sample(&f, &s).0[c]) - truth[c]).powi(2))
                        .sum::<f64>()
                })
                .sum();
            -10.0 * (error / 240.0).log10()
        };
        let (ellipse, taps) = (of(Magnify::None), of(Magnify::Taps));
        println!("{major}: ellipse {ellipse:.1}, taps {taps:.1} dB");
        assert!(taps > ellipse + gain && taps > bar, "{major}: {ellipse} {taps}");
    }
}

#[test]
fn a_square_over_one_colour_is_that_colour() {
    for code in 0..=255 {
        let image = Image::from_fn(2, 6, |_, _| [code, 82, 255 - code, 189]).unwrap();
        let options = TextureOptions { wrap: Wrap::Repeat, ..TextureOptions::default() };
        let t = Texture::new(image.view(), &options).unwrap();
        let nearest = Sampler::DEFAULT.with(PixelFilter::Nearest, LevelMode::Zero);
        let one = t.sample(&Footprint::point(0.5, 0.5), &nearest);
        let square = Sampler { kernel: Kernel::Box, ..Sampler::DEFAULT };
        for (u, v) in [(0.0, 0.0), (1.3, 2.7), (1.9, 4.2)] {
            assert_eq!(t.sample(&Footprint::point(u, v), &square), one, "{code} {u} {v}");
        }
    }
}
