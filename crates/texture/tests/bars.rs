//! What a good elliptical filter owes: no seams, no shimmer, no favourite direction, and the
//! resolution that its kernel promises.

#![allow(clippy::unwrap_used, reason = "a test helper may fail its test")]

mod common;

use common::{Random, grey, noise};
use scumble_geometry::Matrix2;
use scumble_texture::{Footprint, Levels, Sampler, Simd, Texture, TextureOptions, Wrap};

const PRESETS: [Sampler; 3] = [Sampler::FAST, Sampler::DEFAULT, Sampler::HIGH];

fn tiled(levels: Levels) -> TextureOptions {
    TextureOptions { wrap: Wrap::Repeat, levels, ..Default::default() }
}

fn isotropic(u: f64, v: f64, scale: f64) -> Footprint {
    Footprint { u, v, jacobian: Matrix2::new(scale, 0.0, 0.0, scale) }
}

/// A footprint of the given axes, turned.
fn oval(u: f64, v: f64, major: f64, minor: f64, angle: f64) -> Footprint {
    let (s, c) = angle.sin_cos();
    Footprint { u, v, jacobian: Matrix2::new(major * c, -minor * s, major * s, minor * c) }
}

fn rms(differences: impl Iterator<Item = f64>) -> f64 {
    let (sum, n) = differences.fold((0.0, 0.0), |(sum, n), d| (sum + d * d, n + 1.0));
    f64::sqrt(sum / n)
}

#[test]
fn a_pyramid_stands_for_its_image() {
    // The same ellipses over the image alone, which nothing approximates.
    let image = common::checker(512, 12);
    let white = noise(512, 512, 6);
    let make = |image: &scumble_pixel::Image<[u8; 4]>, levels| {
        Texture::new(image.view(), &tiled(levels)).unwrap()
    };
    for (name, image, bars) in
        [("checker", &image, [45.5, 60.0, 64.0]), ("white", &white, [49.0, 54.0, 63.5])]
    {
        let (all, base) = (make(image, Levels::All), make(image, Levels::BaseOnly));
        for (s, bar) in PRESETS.iter().zip(bars) {
            let mut random = Random::new(1);
            let error = rms((0..400).map(|_| {
                let (u, v) = (random.range(0.0, 512.0), random.range(0.0, 512.0));
                let minor = random.range(2.0, 8.0);
                let f = oval(u, v, minor * random.range(1.0, 5.0), minor, random.range(0.0, 7.0));
                f64::from(all.sample(&f, s).0[0] - base.sample(&f, s).0[0])
            }));
            let db = -20.0 * error.log10();
            println!("{name}, s = {}: {db:.1} dB", s.least_sigma);
            assert!(db >= bar, "{name}, s = {}: {db:.1} dB", s.least_sigma);
        }
    }
}

#[test]
fn no_direction_is_special() {
    // A wave, and a footprint across it, turned together.
    let wave = |angle: f64| {
        let (s, c) = angle.sin_cos();
        let image = grey(256, 256, |x, y| {
            let t = (x as f64 - 127.5) * c + (y as f64 - 127.5) * s;
            (127.5 + 120.0 * (t * 0.25).sin()).round() as u8
        });
        Texture::new(image.view(), &TextureOptions::default()).unwrap()
    };
    let place = |angle: f64, t: f64| {
        let (s, c) = angle.sin_cos();
        oval(128.0 + t * c, 128.0 + t * s, 6.0, 2.5, angle + 0.7)
    };
    let straight = wave(0.0);
    for angle in [0.2, 0.5, core::f64::consts::FRAC_PI_4, 1.1, 2.0, 2.9] {
        let turned = wave(angle);
        let difference = rms((0..200).map(|i| {
            let t = f64::from(i) * 0.37 - 37.0;
            let sample = |texture: &Texture, angle| {
                f64::from(texture.sample(&place(angle, t), &Sampler::DEFAULT).0[0])
            };
            sample(&turned, angle) - sample(&straight, 0.0)
        }));
        assert!(difference <= 1e-3, "{angle}: {difference:e}");
    }
}

#[test]
fn a_switch_of_level_does_not_show() {
    let t = Texture::new(noise(256, 256, 8).view(), &tiled(Levels::All)).unwrap();
    // Twelve octaves of scale in steps so small that only a switch can be seen.
    let mut worst = 0.0f64;
    for i in 0..4000 {
        let scale = 2f64.powf(f64::from(i) * 0.002);
        let jump = rms((0..16).map(|k| {
            let (u, v) = (f64::from(k) * 15.7, f64::from(k) * 3.1);
            let at = |scale| f64::from(t.sample(&isotropic(u, v, scale), &Sampler::DEFAULT).0[0]);
            at(scale * 1.002) - at(scale)
        }));
        worst = worst.max(jump);
    }
    println!("worst step {worst:.5}");
    assert!(worst <= 1.0 / 512.0, "{worst}");
}

#[test]
fn motion_by_parts_of_a_pixel_is_smooth() {
    let t = Texture::new(common::checker(128, 8).view(), &tiled(Levels::All)).unwrap();
    // From black to white, the most there can be. What is left is the cut of the kernel at R: a texel
    // enters with a weight of 0.9 % of the middle one's.
    for scale in [0.2, 1.0, 2.3, 5.0] {
        let at = |i: i32| {
            let move_by = f64::from(i) * scale / 16.0;
            let f = isotropic(31.0 + move_by, 17.3 + 0.3 * move_by, scale);
            f64::from(t.sample(&f, &Sampler::DEFAULT).0[0])
        };
        let second = (0..600).map(|i| (at(i - 1) - 2.0 * at(i) + at(i + 1)).abs());
        let worst = 255.0 * second.fold(0.0, f64::max);
        println!("{scale}×: {worst:.2}/255");
        assert!(worst < 3.5, "{scale}×: {worst:.2}/255");
    }
}

#[test]
fn an_edge_is_as_sharp_as_the_kernel_says() {
    // An edge 5° off the upright, drawn with exact areas.
    let slope = 5f64.to_radians().tan();
    let image = grey(128, 128, |x, y| {
        let area: f64 = (0..64)
            .map(|k| {
                let edge = 64.0 + (y as f64 + (f64::from(k) + 0.5) / 64.0 - 64.0) * slope;
                (x as f64 + 1.0 - edge).clamp(0.0, 1.0)
            })
            .sum();
        (area / 64.0 * 255.0).round() as u8
    });
    let t = Texture::new(image.view(), &TextureOptions::default()).unwrap();
    let step = 1.0 / 16.0;
    // Across the edge, and along it over every phase of the texels' grid.
    let edge = |i: i32| {
        let at = |k: i32| {
            let along = f64::from(k) / (64.0 * slope);
            let f = isotropic(64.0 + f64::from(i) * step + along * slope, 64.0 + along, 1.0);
            f64::from(t.sample(&f, &Sampler::DEFAULT).0[0])
        };
        (0..64).map(at).sum::<f64>() / 64.0
    };
    let line: Vec<(f64, f64)> =
        (-128..128).map(|i| ((f64::from(i) + 0.5) * step, edge(i + 1) - edge(i))).collect();
    let mtf = |f: f64| {
        let phase = |x: f64| core::f64::consts::TAU * f * x;
        let re: f64 = line.iter().map(|(x, d)| d * phase(*x).cos()).sum();
        let im: f64 = line.iter().map(|(x, d)| d * phase(*x).sin()).sum();
        f64::hypot(re, im) / line.iter().map(|(_, d)| d).sum::<f64>()
    };
    // The Gaussian pixel and reconstruction, widened by 1.7 % and cut at R (which takes 4.5 % of that
    // variance), over the texels' own squares.
    let variance = 1.017 * 0.955 * (0.25 + 1.0 / 6.0);
    let analytic = |f: f64| {
        let x = core::f64::consts::PI * f;
        (-2.0 * x * x * variance).exp() * x.sin() / x
    };
    let half = |curve: &dyn Fn(f64) -> f64| {
        let (mut low, mut high) = (0.01, 0.6);
        for _ in 0..50 {
            let middle = 0.5 * (low + high);
            if curve(middle) > 0.5 { low = middle } else { high = middle }
        }
        low
    };
    let (found, expected) = (half(&mtf), half(&analytic));
    println!("MTF50 {found:.4}, {expected:.4} by analysis");
    assert!((found / expected - 1.0).abs() < 0.02, "{found} and not {expected}");
}

/// Random footprints, sizes and wraps. `SCUMBLE_FUZZ` sets how many thousands; 40 without it.
#[test]
fn nothing_makes_it_stumble() {
    let thousands = std::env::var("SCUMBLE_FUZZ").ok().and_then(|v| v.parse().ok()).unwrap_or(40);
    let mut random = Random::new(77);
    let wraps = [Wrap::Clamp, Wrap::Repeat, Wrap::Mirror, Wrap::Constant(Default::default())];
    for round in 0..thousands {
        let (w, h) = (1 + random.next() as usize % 70, 1 + random.next() as usize % 70);
        let wrap = wraps[round % 4];
        let levels = if round % 5 == 0 { Levels::BaseOnly } else { Levels::All };
        let options = TextureOptions { wrap, levels, ..Default::default() };
        let t = Texture::new(noise(w, h, random.next()).view(), &options).unwrap();
        let t = if round % 2 == 0 { t.with_simd(Simd::SCALAR) } else { t };
        for _ in 0..1000 {
            // Magnitudes from nothing to beyond everything, with either sign.
            let mut number = || {
                let sign = if random.next().is_multiple_of(2) { -1.0 } else { 1.0 };
                match random.next() % 24 {
                    0 => 0.0,
                    1 => f64::from_bits(random.next()),
                    _ => sign * 2f64.powf(random.range(-8.0, 8.0)),
                }
            };
            let jacobian = Matrix2::new(number(), number(), number(), number());
            let f = Footprint { u: number(), v: number(), jacobian };
            let s = PRESETS[random.next() as usize % 3];
            let color = t.sample(&f, &s).0;
            assert!(color.iter().all(|c| (0.0..=1.0).contains(c)), "{f:?} {options:?}: {color:?}");
            assert!(t.cost(&f, &s) <= 2 * (5 * 16_384 + 64), "{f:?} {options:?}");
        }
    }
}
