//! The presets against brute force, on warps and images of the kinds they are meant for.
//!
//! PSNR is of encoded values against a Gaussian pixel, σ = ½, over bilinear reconstruction, at random
//! pixels whose neighbourhood lies inside the image.

#![allow(clippy::unwrap_used, reason = "a test helper may fail its test")]

mod common;

use common::{Random, ground};
use scumble_geometry::{DVec2, Homography};
use scumble_pixel::Image;
use scumble_texture::reference::{PixelShape, Reference};
use scumble_texture::{Footprint, LevelMode, PixelFilter, Sampler, Texture, TextureOptions};

const N: usize = 2048;
const PLACES: usize = 250;

fn checker() -> Texture {
    texture(common::checker(N, 24))
}

/// Three phases of a zone plate that reaches the limit of sampling at the middle of the edges.
fn zone() -> Texture {
    let half = N as f64 / 2.0;
    let texel = |i: usize| {
        let (x, y) = ((i % N) as f64 + 0.5 - half, (i / N) as f64 + 0.5 - half);
        let phase = core::f64::consts::PI * (x * x + y * y) / (2.0 * half);
        let channel =
            |k: f64| (127.5 + 127.5 * (phase + k * core::f64::consts::TAU / 3.0).cos()).round();
        [channel(0.0) as u8, channel(1.0) as u8, channel(2.0) as u8, 255]
    };
    texture(Image::from_vec(N, N, (0..N * N).map(texel).collect()).unwrap())
}

/// Dark strokes of one to three texels on white, in lines, as text has them.
fn text() -> Texture {
    let mut random = Random::new(11);
    let mut image = Image::filled(N, N, [255u8; 4]).unwrap();
    let mut top = 10;
    while top + 30 < N {
        let size = 9 + (random.next() % 14) as usize;
        let mut left = 10;
        while left + size < N {
            for _ in 0..3 {
                let thick = 1 + size / 9;
                let (x, y) = (random.unit() * 0.6 * size as f64, random.unit() * 0.8 * size as f64);
                let upright = random.next().is_multiple_of(2);
                let (w, h) =
                    if upright { (thick, size - y as usize) } else { (size * 2 / 3, thick) };
                for j in 0..h {
                    for i in 0..w {
                        let at = (top + y as usize + j).min(N - 1) * N
                            + (left + x as usize + i).min(N - 1);
                        image.pixels_mut()[at] = [20, 20, 20, 255];
                    }
                }
            }
            left += size;
        }
        top += size * 13 / 10 + 4;
    }
    texture(image)
}

/// Smooth noise of many octaves, each with an amplitude in proportion to its wavelength: the
/// spectrum of photographs.
fn photo() -> Texture {
    let mut random = Random::new(5);
    let grid: Vec<f64> = (0..256 * 256).map(|_| random.unit() - 0.5).collect();
    let at = |x: usize, y: usize| grid[(y % 256) * 256 + x % 256];
    let value = |x: f64, y: f64| {
        let (i, j) = (x.floor(), y.floor());
        let (fx, fy) = (x - i, y - j);
        let (i, j) = (i as usize, j as usize);
        let top = at(i, j) + (at(i + 1, j) - at(i, j)) * fx;
        let low = at(i, j + 1) + (at(i + 1, j + 1) - at(i, j + 1)) * fx;
        top + (low - top) * fy
    };
    let image = common::grey(N, N, |x, y| {
        let octave = |k: i32| {
            let f = 2f64.powi(-k);
            value(x as f64 * f + 17.3 * f64::from(k), y as f64 * f) * 12.0 * f64::from(k + 1)
        };
        (128.0 + (0..7).map(octave).sum::<f64>()).clamp(0.0, 255.0) as u8
    });
    texture(image)
}

fn texture(image: Image<[u8; 4]>) -> Texture {
    Texture::new(image.view(), &TextureOptions::default()).unwrap()
}

/// A keystone, three times down.
fn keystone() -> Homography {
    let n = N as f64;
    let source = [(0.0, 0.0), (n, 0.0), (n, n), (0.0, n)];
    let screen = [(330.0, 60.0), (900.0, 20.0), (1180.0, 690.0), (240.0, 700.0)];
    let points = |p: [(f64, f64); 4]| p.map(|(x, y)| DVec2::new(x, y));
    Homography::from_points(points(screen), points(source)).unwrap()
}

/// A turn by some degrees, and so many times down, about the middles.
fn turned(degrees: f64, scale: f64) -> Homography {
    let (s, c) = degrees.to_radians().sin_cos();
    let (s, c) = (s * scale, c * scale);
    let half = N as f64 / 2.0;
    let row = |x: f64, y: f64| [x, y, half - x * 640.0 - y * 360.0];
    Homography::new([row(c, s), row(-s, c), [0.0, 0.0, 1.0]])
}

/// Random pixels of 1280×720 with everything within 2½ pixels well inside the image.
fn places(map: &Homography) -> Vec<DVec2> {
    let mut random = Random::new(3);
    let inside = |p: DVec2| {
        let reach = [-2.5, 0.0, 2.5];
        let corners = reach.iter().flat_map(|x| reach.map(|y| p + DVec2::new(*x, y)));
        corners
            .map(|p| map.project(p))
            .all(|q| q.is_some_and(|q| q.min_element() > 4.0 && q.max_element() < N as f64 - 4.0))
    };
    core::iter::repeat_with(|| {
        DVec2::new(random.range(0.0, 1280.0).floor() + 0.5, random.range(0.0, 720.0).floor() + 0.5)
    })
    .filter(|p| inside(*p))
    .take(PLACES)
    .collect()
}

/// What the pixels are in truth.
fn truth(t: &Texture, map: &Homography, places: &[DVec2]) -> Vec<[f64; 4]> {
    let brute = Reference::new(t, PixelShape::Gaussian { sigma: 0.5 }).with_density(2.0, 16);
    places.iter().map(|p| brute.sample(map, *p)).collect()
}

fn psnr(t: &Texture, map: &Homography, places: &[DVec2], truth: &[[f64; 4]], s: &Sampler) -> f64 {
    let mut sum = 0.0;
    for (p, truth) in places.iter().zip(truth) {
        let found = t.sample(&Footprint::at(map, *p), s).0;
        sum += (0..3).map(|c| (f64::from(found[c]) - truth[c]).powi(2)).sum::<f64>();
    }
    -10.0 * (sum / (3 * places.len()) as f64).log10()
}

const PRESETS: [(&str, Sampler); 4] = [
    ("fast", Sampler::FAST),
    ("default", Sampler::DEFAULT),
    ("high", Sampler::HIGH),
    ("reference", Sampler::REFERENCE),
];

/// Prints a line for each warp and holds it to the bars: for each warp one for each preset.
fn hold(name: &str, t: &Texture, bars: [[f64; 4]; 3]) {
    let warps = [("ground", ground(N)), ("keystone", keystone()), ("turned", turned(30.0, 4.0))];
    for ((warp, map), bars) in warps.iter().zip(bars) {
        let places = places(map);
        let truth = truth(t, map, &places);
        let of = |s: &Sampler| psnr(t, map, &places, &truth, s);
        let found = PRESETS.map(|(_, preset)| of(&preset));
        let trilinear = of(&Sampler::DEFAULT.with(PixelFilter::Bilinear, LevelMode::Linear));
        let probes = of(&Sampler::DEFAULT.with(PixelFilter::Probes, LevelMode::Auto));
        let classic = of(&Sampler::CLASSIC);
        println!(
            "{name:8} {warp:9} trilinear {trilinear:.1}, probes {probes:.1}, classic {classic:.1}; \
             presets {found:.1?}"
        );
        assert!(
            trilinear < probes + 0.1 && classic < found[1],
            "{name}, {warp}: {probes} {classic}"
        );
        for (((preset, _), found), bar) in PRESETS.iter().zip(found).zip(bars) {
            assert!(found >= bar, "{name}, {warp}, {preset}: {found:.1} dB, less than {bar}");
        }
    }
}

#[test]
fn a_checkerboard() {
    let ground = [45.2, 56.8, 56.8, 57.6];
    let keystone = [41.2, 53.1, 56.4, 75.0];
    let turned = [41.1, 51.4, 51.4, 75.0];
    hold("checker", &checker(), [ground, keystone, turned]);
}

#[test]
fn a_zone_plate() {
    let ground = [45.7, 47.7, 47.7, 46.2];
    let keystone = [39.7, 40.2, 51.5, 73.0];
    let turned = [47.3, 52.6, 52.8, 75.0];
    hold("zone", &zone(), [ground, keystone, turned]);
}

#[test]
fn text_like_strokes() {
    let ground = [47.2, 57.6, 57.6, 59.4];
    let keystone = [40.1, 42.9, 52.3, 75.0];
    let turned = [41.5, 49.2, 49.4, 75.0];
    hold("text", &text(), [ground, keystone, turned]);
}

#[test]
fn noise_like_photographs() {
    let ground = [62.1, 72.5, 72.5, 73.5];
    let keystone = [57.8, 63.2, 70.2, 75.0];
    let turned = [58.2, 67.5, 67.5, 75.0];
    hold("photo", &photo(), [ground, keystone, turned]);
}

/// A small σ is poor just where it falls on a level boundary: judge a preset by its worst scale.
#[test]
fn no_scale_is_bad() {
    let t = text();
    let scales: Vec<f64> = (0..16).map(|i| 2.0 * 2f64.powf(f64::from(i) / 8.0)).collect();
    for ((name, s), bar) in PRESETS.iter().zip([33.0, 33.0, 42.0, 66.0]) {
        let mut worst = (f64::INFINITY, 0.0);
        for scale in &scales {
            let map = turned(30.0, *scale);
            let places = &places(&map)[..PLACES / 4];
            let truth = truth(&t, &map, places);
            let found = psnr(&t, &map, places, &truth, s);
            if found < worst.0 {
                worst = (found, *scale);
            }
        }
        println!("{name}: worst {:.1} dB at {:.2}×", worst.0, worst.1);
        assert!(worst.0 >= bar, "{name}: {worst:?}");
    }
}
