//! The filters against values worked out by hand, and against brute force.

mod common;

use common::{checker, grey, ground, noise};
use scumble_geometry::{DVec2, Homography, Matrix2};
use scumble_pixel::Premul;
use scumble_texture::reference::{PixelShape, Reference};
use scumble_texture::{Footprint, LevelMode, PixelFilter, Sampler, Texture, TextureOptions, Wrap};

const GAUSS: PixelShape = PixelShape::Gaussian { sigma: 0.5 };

fn sampler(pixel: PixelFilter, level: LevelMode) -> Sampler {
    Sampler::default().with(pixel, level)
}

fn isotropic(u: f64, v: f64, scale: f64) -> Footprint {
    Footprint { u, v, jacobian: Matrix2::new(scale, 0.0, 0.0, scale) }
}

/// PSNR in dB of a sampler against brute force, over a grid of pixels of a map.
fn psnr(t: &Texture, s: &Sampler, map: &Homography, places: &[DVec2]) -> f64 {
    let brute = Reference::new(t, GAUSS);
    let mut sum = 0.0;
    for p in places {
        let found = t.sample(&Footprint::at(map, *p), s).0;
        let truth = brute.sample(map, *p);
        sum += (0..3).map(|c| (f64::from(found[c]) - truth[c]).powi(2)).sum::<f64>();
    }
    -10.0 * (sum / (3 * places.len()) as f64).log10()
}

fn rotation(degrees: f64, scale: f64, about: f64) -> Homography {
    let (s, c) = degrees.to_radians().sin_cos();
    let at = |x: f64, y: f64| about - x * 20.0 - y * 20.0;
    let (x, y) = ([c * scale, s * scale], [-s * scale, c * scale]);
    Homography::new([[x[0], x[1], at(x[0], x[1])], [y[0], y[1], at(y[0], y[1])], [0.0, 0.0, 1.0]])
}

fn grid(n: usize) -> Vec<DVec2> {
    (0..n * n)
        .map(|i| DVec2::new((i % n) as f64 * 3.0 + 10.5, (i / n) as f64 * 3.0 + 10.5))
        .collect()
}

#[test]
fn nearest_and_bilinear_read_the_texels_they_should() {
    let image = grey(4, 2, |x, y| (x * 20 + y * 100) as u8);
    let t = Texture::new(image.view(), &TextureOptions::default()).unwrap();
    let value = |u, v, pixel| {
        let s = sampler(pixel, LevelMode::Zero);
        t.sample(&Footprint::point(u, v), &s).0[0] * 255.0
    };
    let nearest = |u, v| value(u, v, PixelFilter::Nearest).round();
    assert_eq!([nearest(0.0, 0.0), nearest(0.999, 0.5), nearest(1.0, 1.0)], [0.0, 0.0, 120.0]);
    assert_eq!([nearest(-7.0, 0.0), nearest(99.0, 99.0)], [0.0, 160.0]);
    let bilinear = |u, v| value(u, v, PixelFilter::Bilinear);
    for (u, v, expected) in
        [(0.5, 0.5, 0.0), (1.0, 0.5, 10.0), (1.0, 1.0, 60.0), (2.25, 0.75, 60.0), (0.0, 0.0, 0.0)]
    {
        assert!((bilinear(u, v) - expected).abs() < 1e-3, "{u} {v}: {}", bilinear(u, v));
    }
}

#[test]
fn all_nine_combinations_read_their_levels() {
    // Each level of this pyramid is one value: the level's own mean is the image's, so give the
    // image a slope and look at how blurred it is instead: a single bright texel of 8×8.
    let image = grey(8, 8, |x, y| if (x, y) == (3, 3) { 255 } else { 0 });
    let t = Texture::new(image.view(), &TextureOptions::default()).unwrap();
    let f = isotropic(3.5, 3.5, 2.0);
    let value = |pixel, level| t.sample(&f, &sampler(pixel, level)).0[0];
    use LevelMode::{Linear, Nearest, Zero};
    for pixel in [PixelFilter::Nearest, PixelFilter::Bilinear, PixelFilter::Ewa] {
        // D = 1 exactly: nearest and linear agree.
        assert_eq!(value(pixel, Nearest), value(pixel, Linear), "{pixel:?}");
        assert!(value(pixel, Zero) > value(pixel, Linear), "{pixel:?}");
    }
    assert_eq!(value(PixelFilter::Nearest, Zero), 1.0);
    assert_eq!(value(PixelFilter::Bilinear, Zero), 1.0);
    let level_one = t.level(1).unwrap().row(1)[1][0];
    assert_eq!(value(PixelFilter::Nearest, Nearest), level_one);
    // Between two levels, linear is between them.
    let f = isotropic(3.5, 3.5, 3.0);
    let at = |level| t.sample(&f, &sampler(PixelFilter::Nearest, level)).0[0];
    let (one, two) = (t.level(1).unwrap().row(1)[1][0], t.level(2).unwrap().row(0)[0][0]);
    let fraction = 3f32.log2() - 1.0;
    assert!((at(Linear) - (one + (two - one) * fraction)).abs() < 1e-6);
    assert_eq!(at(Nearest), two);
}

#[test]
fn auto_is_the_best_that_a_filter_can_do() {
    let t = Texture::new(noise(64, 64, 3).view(), &TextureOptions::default()).unwrap();
    let f = isotropic(20.3, 31.9, 3.0);
    let value = |pixel, level| t.sample(&f, &sampler(pixel, level));
    use LevelMode::{Auto, Linear, Nearest};
    assert_eq!(value(PixelFilter::Nearest, Auto), value(PixelFilter::Nearest, Nearest));
    assert_eq!(value(PixelFilter::Bilinear, Auto), value(PixelFilter::Bilinear, Linear));
}

#[test]
fn ewa_is_the_integral_it_claims_to_be() {
    let options = TextureOptions { wrap: Wrap::Repeat, ..Default::default() };
    let t = Texture::new(checker(256, 12).view(), &options).unwrap();
    let n = Texture::new(noise(256, 256, 9).view(), &options).unwrap();
    let places = grid(8);
    // Bars in dB: a checkerboard, and white noise in four channels.
    for (scale, degrees, on_checker, on_noise) in
        [(1.0, 20.0, 51.0, 52.0), (2.6, 30.0, 49.0, 43.0), (4.0, 30.0, 47.5, 58.0)]
    {
        let map = rotation(degrees, scale, 128.0);
        let found = psnr(&t, &Sampler::DEFAULT, &map, &places);
        let found_noise = psnr(&n, &Sampler::DEFAULT, &map, &places);
        println!("{scale}× {degrees}°: checker {found:.1} dB, noise {found_noise:.1} dB");
        assert!(found > on_checker, "{scale}×: checker {found}");
        assert!(found_noise > on_noise, "{scale}×: noise {found_noise}");
    }
}

#[test]
fn better_presets_are_better_on_the_ground() {
    let t = Texture::new(checker(512, 6).view(), &TextureOptions::default()).unwrap();
    let map = ground(512);
    let places: Vec<_> = (0..40)
        .map(|i| DVec2::new(400.5 + f64::from(i) * 12.0, 60.5 + f64::from(i % 8) * 20.0))
        .collect();
    let of = |s: &Sampler| psnr(&t, s, &map, &places);
    let trilinear = of(&sampler(PixelFilter::Bilinear, LevelMode::Linear));
    let (fast, default) = (of(&Sampler::FAST), of(&Sampler::DEFAULT));
    println!("trilinear {trilinear:.1}, fast {fast:.1}, default {default:.1} dB");
    assert!(fast > trilinear + 5.0 && default > fast);
}

#[test]
fn a_ramp_stays_where_it_is() {
    // A horizontal ramp of 2 per texel; the middle of any symmetric filter reads it exactly, up to
    // the centroid error of few texels.
    let image = grey(128, 128, |x, _| (x * 2) as u8);
    let t = Texture::new(image.view(), &TextureOptions::default()).unwrap();
    let mut worst = 0.0f64;
    for i in 0..400 {
        let u = 40.0 + f64::from(i) * 0.11;
        let scale = 1.0 + f64::from(i % 40) * 0.1;
        let found = f64::from(t.sample(&isotropic(u, 64.3, scale), &Sampler::DEFAULT).0[0]);
        // In texels of level 0, then of the level that is read (σ from 0.6 of its texels on).
        let error = (found * 255.0 / 2.0 - (u - 0.5)).abs();
        worst = worst.max(error / (0.5 * scale / 0.6).max(1.0));
    }
    println!("worst centroid error {worst:.4}");
    assert!(worst <= 0.025, "{worst}");
}

#[test]
fn wide_footprints_are_means() {
    let t = Texture::new(noise(50, 31, 4).view(), &TextureOptions::default()).unwrap();
    let top = t.level(t.level_count() - 1).unwrap().row(0)[0];
    for scale in [1e3, 1e6, 1e12, 1e13, f64::INFINITY, f64::NAN] {
        let found = t.sample(&isotropic(25.0, 15.0, scale), &Sampler::DEFAULT).0;
        assert!(
            found.iter().zip(top).all(|(a, b)| (a - b).abs() < 1e-5),
            "{scale}: {found:?} {top:?}"
        );
    }
}

#[test]
fn nearest_and_bilinear_at_level_zero_ignore_the_jacobian() {
    let t = Texture::new(noise(8, 8, 4).view(), &TextureOptions::default()).unwrap();
    for pixel in [PixelFilter::Nearest, PixelFilter::Bilinear] {
        let s = sampler(pixel, LevelMode::Zero);
        let point = t.sample(&Footprint::point(3.2, 4.9), &s);
        assert_eq!(t.sample(&isotropic(3.2, 4.9, f64::NAN), &s), point);
    }
}

#[test]
fn the_constant_border_comes_in_from_outside() {
    let border = Premul([0.0, 0.25, 0.0, 0.25]);
    let options = TextureOptions { wrap: Wrap::Constant(border), ..Default::default() };
    let t = Texture::new(common::constant(16, 16, [255; 4]).view(), &options).unwrap();
    for pixel in [PixelFilter::Nearest, PixelFilter::Bilinear, PixelFilter::Ewa] {
        let s = sampler(pixel, LevelMode::Auto);
        assert_eq!(t.sample(&isotropic(-40.0, 8.0, 1.0), &s), border);
        assert_eq!(t.sample(&isotropic(8.0, 8.0, 1.0), &s), Premul([1.0; 4]));
    }
    // On the edge, half and half.
    let edge = t.sample(&isotropic(0.0, 8.0, 1.0), &Sampler::DEFAULT).0;
    assert!((edge[3] - 0.625).abs() < 0.01, "{edge:?}");
}

#[test]
fn the_clamp_widens_the_minor_axis() {
    // Stripes along u, seen with a footprint that is long in v: a thin ellipse keeps them, a
    // clamped one blurs them.
    let image = grey(256, 256, |x, _| if (x / 4) % 2 == 0 { 255 } else { 0 });
    let t = Texture::new(image.view(), &TextureOptions::default()).unwrap();
    let f = Footprint { u: 130.0, v: 128.0, jacobian: Matrix2::new(1.0, 0.0, 0.0, 40.0) };
    let contrast = |ratio| {
        let s = Sampler { max_eccentricity: ratio, ..Sampler::DEFAULT };
        (t.sample(&f, &s).0[0] - 0.5).abs()
    };
    assert!(contrast(64.0) > 0.45, "{}", contrast(64.0));
    assert!(contrast(8.0) < 0.2, "{}", contrast(8.0));
    assert_eq!(contrast(0.0), contrast(1.0));
    assert_eq!(contrast(f32::NAN), contrast(1.0));
    assert_eq!(contrast(1e9), contrast(1024.0));
}
