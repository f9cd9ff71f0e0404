//! Anisotropic probes over textures and functions, and the procedural grid.

#![allow(clippy::unwrap_used, reason = "a test helper may fail its test")]

mod common;

use common::{Random, checker, constant, ground};
use scumble_geometry::{DVec2, Homography, Matrix2};
use scumble_pixel::Premul;
use scumble_texture::procedural::{Antialias, Grid, Source};
use scumble_texture::reference::{PixelShape, Reference};
use scumble_texture::{
    Footprint, LevelMode, PixelFilter, Probes, Sampler, Texture, TextureOptions, Wrap, compare,
};

fn oval(u: f64, v: f64, major: f64, minor: f64, angle: f64) -> Footprint {
    let (s, c) = angle.sin_cos();
    Footprint { u, v, jacobian: Matrix2::new(major * c, -minor * s, major * s, minor * c) }
}

#[test]
fn probes_stand_between_trilinear_and_the_ellipse() {
    let t = Texture::new(checker(1024, 12).view(), &TextureOptions::default()).unwrap();
    let map = ground(1024);
    let truth = Reference::new(&t, PixelShape::Gaussian { sigma: 0.5 }).with_density(2.0, 16);
    let mut random = Random::new(2);
    let places: Vec<(Footprint, f64)> = core::iter::repeat_with(|| {
        DVec2::new(
            random.range(300.0, 980.0).floor() + 0.5,
            random.range(20.0, 500.0).floor() + 0.5,
        )
    })
    .filter(|p| map.project(*p).is_some_and(|q| q.min_element() > 60.0 && q.max_element() < 960.0))
    .take(300)
    .map(|p| (Footprint::at(&map, p), truth.sample(&map, p)[0]))
    .collect();
    let db = |sample: &dyn Fn(&Footprint) -> Premul| {
        let square = |(f, truth): &(Footprint, f64)| (f64::from(sample(f).0[0]) - truth).powi(2);
        -10.0 * (places.iter().map(square).sum::<f64>() / places.len() as f64).log10()
    };
    let s = |pixel| Sampler::DEFAULT.with(pixel, LevelMode::Auto);
    let trilinear = db(&|f| compare::trilinear(&t, f));
    let hardware = db(&|f| compare::vulkan_anisotropic(&t, f, 16));
    let probes = db(&|f| t.sample(f, &s(PixelFilter::Probes)));
    let ellipse = db(&|f| t.sample(f, &s(PixelFilter::Ewa)));
    println!(
        "trilinear {trilinear:.1}, hardware ×16 {hardware:.1}, probes {probes:.1}, ellipse {ellipse:.1} dB"
    );
    assert!(trilinear + 3.0 < hardware && hardware + 10.0 < probes && probes < ellipse);
}

#[test]
fn a_row_has_the_variance_of_the_pixel() {
    // A source that is the square of the distance along the row, as a spot sees it: the mean of x² over
    // a Gaussian spot of σ = ½ of its size about x.
    let (s, c) = 0.7f64.sin_cos();
    let square = |f: &Footprint| {
        let x = f.u * c + f.v * s;
        let spot = f.jacobian.axes().major;
        Premul([(x * x + 0.25 * spot * spot) as f32; 4])
    };
    for (major, minor) in
        [(1.0, 1.0), (3.0, 2.0), (10.0, 1.0), (7.0, 3.0), (40.0, 1.0), (900.0, 1.0), (5.0, 0.0)]
    {
        let found = Probes::new(64).sample(&oval(0.0, 0.0, major, minor, 0.7), &square).0[0];
        let truth = 0.25 * major * major;
        assert!(
            (f64::from(found) / truth - 1.0).abs() < 1e-4,
            "{major} × {minor}: {found} {truth}"
        );
    }
}

#[test]
fn few_probes_blur_and_do_not_alias() {
    // Stripes across the row of a long footprint: whatever the number, they must go.
    let stripes = Grid { period: 3.0, width: 1.5, ..Grid::default() };
    let source = |f: &Footprint| {
        let j = f.jacobian;
        stripes.color(&Footprint { u: f.u, v: 1.5, jacobian: Matrix2::new(j.a, j.b, 0.0, 0.0) })
    };
    for most in [1, 2, 5, 16, 64] {
        for i in 0..50 {
            let f = oval(f64::from(i) * 0.17, 0.0, 60.0, 1.0, 0.1);
            let v = Probes::new(most).sample(&f, &source).0[0];
            assert!((v - 0.5).abs() < 0.06, "{most}: {v}");
        }
    }
}

#[test]
fn probes_over_a_texture_are_probes_over_its_trilinear_samples() {
    let options = TextureOptions { wrap: Wrap::Repeat, ..Default::default() };
    let t = Texture::new(common::noise(64, 64, 3).view(), &options).unwrap();
    let s = Sampler {
        max_eccentricity: 16.0,
        ..Sampler::DEFAULT.with(PixelFilter::Probes, LevelMode::Linear)
    };
    let source = (&t, s.with(PixelFilter::Bilinear, LevelMode::Linear));
    for i in 0..100 {
        let i = f64::from(i);
        let f = oval(i * 0.71, i * 1.3, 1.0 + i * 0.2, 0.9, i);
        let (a, b) = (t.sample(&f, &s).0, Probes::new(31).sample(&f, &source).0);
        assert!(a.iter().zip(b).all(|(a, b)| (a - b).abs() < 1e-5), "{a:?} {b:?}");
    }
    let flat = Texture::new(constant(9, 9, [10, 200, 30, 77]).view(), &options).unwrap();
    let f = oval(3.0, 2.0, 30.0, 2.0, 0.4);
    let texel =
        flat.sample(&Footprint::point(0.5, 0.5), &s.with(PixelFilter::Nearest, LevelMode::Zero));
    assert_eq!(flat.sample(&f, &s), texel);
}

/// The share of lines under a pixel's square, by many points.
fn brute(grid: &Grid, f: &Footprint) -> f64 {
    let n = 700;
    let at = |i: i32| (f64::from(i) + 0.5) / f64::from(n) - 0.5;
    let hit = |k: i32| {
        let p = f.jacobian.apply(DVec2::new(at(k % n), at(k / n)));
        u32::from(grid.distance(f.u + p.x, f.v + p.y) < 0.0)
    };
    f64::from((0..n * n).map(hit).sum::<u32>()) / f64::from(n * n)
}

#[test]
fn the_grids_integral_is_the_integral() {
    let grid = Grid { period: 2.0, width: 0.3, ..Grid::default() };
    let mut random = Random::new(4);
    for i in 0..24 {
        let size = 10f64.powf(random.range(-2.0, 1.3));
        let (a, d) = (size * random.range(0.1, 1.0), size * random.range(-1.0, 1.0));
        let j =
            if i % 2 == 0 { Matrix2::new(a, 0.0, 0.0, d) } else { Matrix2::new(0.0, a, d, 0.0) };
        let f = Footprint { u: random.range(-9.0, 9.0), v: random.range(-9.0, 9.0), jacobian: j };
        let (found, truth) = (grid.coverage(&f), brute(&grid, &f));
        assert!((found - truth).abs() < 4e-3, "{f:?}: {found} {truth}");
    }
    // One family under any parallelogram: the other's lines out of sight.
    let lines = Grid { width: 0.5, period: 1e6, ..grid };
    for _ in 0..16 {
        let [a, b] = [random.range(-2.0, 2.0), random.range(-2.0, 2.0)];
        let f = Footprint {
            u: random.range(-2.0, 2.0),
            v: 4e5,
            jacobian: Matrix2::new(a, b, b, 2.0 * a),
        };
        let (found, truth) = (lines.coverage(&f), brute(&lines, &f));
        assert!((found - truth).abs() < 4e-3, "{f:?}: {found} {truth}");
    }
}

#[test]
fn the_grid_is_right_far_away_and_the_gradient_is_not() {
    let grid = |antialias| Grid { period: 2.0, width: 0.1, antialias, ..Grid::default() };
    // Of the whole, 1 − 0.95².
    let truth = 0.0975;
    let mut gradient = 0.0;
    for i in 0..100 {
        let i = f64::from(i);
        let f = oval(i * 0.77, i * 1.31, 90.0, 60.0, i);
        let integral = grid(Antialias::Integral).coverage(&f);
        assert!((integral - truth).abs() < 2e-3, "{integral}");
        gradient += grid(Antialias::Gradient).coverage(&f) / 100.0;
    }
    println!("far away the clamped gradient tends to {gradient:.3}, the truth is {truth}");
    assert!(gradient > 0.47);
    // Near by, where a pixel is narrower than a line, all three agree on average.
    for antialias in [Antialias::None, Antialias::Gradient, Antialias::Integral] {
        let of = |k: i32| {
            let f = oval(f64::from(k) * 0.001, 1.0, 0.02, 0.02, 0.0);
            grid(antialias).coverage(&f) / 2000.0
        };
        let mean: f64 = (0..2000).map(of).sum();
        assert!((mean - 0.05).abs() < 1e-3, "{antialias:?}: {mean}");
    }
}

#[test]
fn the_grid_takes_anything() {
    let wild = [0.0, -0.0, 1e-300, 1.0, -3e7, 1e300, f64::INFINITY, f64::NAN];
    for antialias in [Antialias::None, Antialias::Gradient, Antialias::Integral] {
        for (i, &a) in wild.iter().enumerate() {
            for (k, &b) in wild.iter().enumerate() {
                let grid =
                    Grid { period: wild[(i + k) % 8], width: b, antialias, ..Grid::default() };
                for g in [grid, Grid { antialias, ..Grid::default() }] {
                    let f = Footprint {
                        u: a,
                        v: b,
                        jacobian: Matrix2::new(b, a, wild[(i * k) % 8], 1.0),
                    };
                    let found = g.coverage(&f);
                    assert!((0.0..=1.0).contains(&found), "{g:?} {f:?}: {found}");
                    let probed = Probes::new(8).sample(&f, &g).0;
                    assert!(probed.iter().all(|v| v.is_finite()), "{g:?} {f:?}");
                }
            }
        }
    }
}

#[test]
fn probes_follow_a_grid_to_its_horizon() {
    // From above the ground, the lines at 45° to the view, where the product of two families is off
    // and one sample of it is not enough.
    let grid = Grid { period: 1.0, width: 0.12, ..Grid::default() };
    let (s, c) = core::f64::consts::FRAC_PI_4.sin_cos();
    let side = |x: f64, y: f64| [2.0 * x, 0.0, 200.0 * y];
    let (p, q) = (side(c, s), side(-s, c));
    let map = Homography::new([p, q, [0.0, 1.0, 0.0]]);
    let mut worst = 0.0f64;
    for y in [8, 14, 25, 60, 120] {
        for x in 0..12 {
            let f = Footprint::at(&map, DVec2::new(f64::from(x) * 7.0 + 0.5, f64::from(y) + 0.5));
            // The pixel's Gaussian, by points.
            let n = 240;
            let at = |i: i32| ((f64::from(i) + 0.5) / f64::from(n) - 0.5) * 4.0;
            let (mut sum, mut total) = (0.0, 0.0);
            for k in 0..n * n {
                let (x, y) = (at(k % n), at(k / n));
                let w = (-2.0 * (x * x + y * y)).exp();
                let d = f.jacobian.apply(DVec2::new(x, y));
                total += w;
                sum += if grid.distance(f.u + d.x, f.v + d.y) < 0.0 { w } else { 0.0 };
            }
            let found = f64::from(Probes::new(64).sample(&f, &grid).0[0]);
            worst = worst.max((found - sum / total).abs());
        }
    }
    println!("worst {worst:.3}");
    assert!(worst < 0.09, "{worst}");
}
