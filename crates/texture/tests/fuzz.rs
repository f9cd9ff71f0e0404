//! Every filter on random textures, Jacobians and places: a colour in range, for a bounded number of
//! texels, whatever comes.
//!
//! `cargo test --release -p scumble-texture --test fuzz -- --ignored` takes ten million samples.

#![allow(clippy::unwrap_used, reason = "a test helper may fail its test")]

mod common;

use common::{Random, noise};
use scumble_geometry::{IntRect, Matrix2};
use scumble_pixel::{Premul, WorkingSpace};
use scumble_texture::{
    Decimation, Footprint, Kernel, LevelMode, Levels, Magnify, PixelFilter, Sampler, Storage,
    Texture, TextureOptions, Wrap, compare,
};

/// The most texels that a sample may read: two levels of the largest ellipse that the sampler allows,
/// five times over for the thinnest; and 64 for magnification.
fn most(s: &Sampler) -> usize {
    let within = |x: f32, low: f64, high: f64| f64::from(x).max(low).min(high);
    let radius = match s.kernel {
        Kernel::Gaussian if !matches!(s.magnify, Magnify::Radial(_)) => within(s.radius, 2.0, 4.0),
        // Three pixels.
        _ => 6.0,
    };
    let (ratio, least) = (within(s.max_eccentricity, 1.0, 1024.0), within(s.least_sigma, 0.4, 4.0));
    let ellipse = core::f64::consts::PI * (radius * 2.0 * least).powi(2) * ratio;
    10 * ellipse.max(16_384.0) as usize + 64
}

struct Fuzz(Random);

impl Fuzz {
    fn pick<T: Copy>(&mut self, from: &[T]) -> T {
        from[(self.0.next() % from.len() as u64) as usize]
    }

    fn options(&mut self) -> TextureOptions {
        let border = Wrap::Constant(Premul([0.1, 0.2, 0.3, 0.5]));
        let first = (self.0.next() % 6) as usize;
        let range = Levels::Range { first, last: first + (self.0.next() % 4) as usize };
        let mut side = || (self.0.next() % 80) as i32;
        let (x, y) = (side() - 10, side() - 10);
        let window = IntRect::new(x, y, x + side(), y + side());
        TextureOptions {
            space: self.pick(&[WorkingSpace::Srgb, WorkingSpace::Linear]),
            wrap: self.pick(&[Wrap::Clamp, Wrap::Repeat, Wrap::Mirror, border]),
            decimation: self.pick(&[Decimation::Kaiser, Decimation::Box]),
            levels: self.pick(&[Levels::All, Levels::All, Levels::BaseOnly, range]),
            storage: self.pick(&[Storage::Auto, Storage::Auto, Storage::Float]),
            window: self.pick(&[None, None, Some(window)]),
            ..TextureOptions::default()
        }
    }

    fn sampler(&mut self) -> Sampler {
        let (_, mut s) = self.pick(&Sampler::PRESETS);
        if self.0.next().is_multiple_of(2) {
            return s;
        }
        s.pixel = self.pick(&PixelFilter::ALL);
        s.level = self.pick(&[
            LevelMode::Auto,
            LevelMode::Auto,
            LevelMode::Zero,
            LevelMode::Nearest,
            LevelMode::Linear,
        ]);
        s.kernel = self.pick(&Kernel::ALL);
        s.magnify = match self.0.next() % 4 {
            0 => Magnify::Radial(self.pick(&Kernel::ALL)),
            _ => self.pick(&Magnify::ALL),
        };
        if self.0.next().is_multiple_of(8) {
            s.max_eccentricity = self.number() as f32;
            s.radius = self.number() as f32;
            s.least_sigma = self.number() as f32;
        }
        s
    }

    /// Mostly what occurs, and now and then anything that a float can be.
    fn number(&mut self) -> f64 {
        match self.0.next() % 32 {
            0 => f64::from_bits(self.0.next()),
            1 => self.pick(&[
                0.0,
                -0.0,
                1.0,
                -1.0,
                f64::INFINITY,
                f64::NAN,
                1e300,
                1e-300,
                1_073_741_824.0,
            ]),
            2..=5 => self.0.range(-1.0, 1.0) * 10f64.powf(self.0.range(-9.0, 9.0)),
            _ => self.0.range(-20.0, 20.0),
        }
    }

    fn footprint(&mut self) -> Footprint {
        let [mut a, mut b, c, d] = [(); 4].map(|()| self.number());
        match self.0.next() % 16 {
            // Rank 1, nearly rank 1, mirrored.
            0 => (a, b) = (2.0 * c, 2.0 * d),
            1 => (a, b) = (c * (1.0 + 1e-6), d),
            2 => (a, b) = (-d, c),
            _ => (),
        }
        Footprint {
            u: 10.0 * self.number(),
            v: 10.0 * self.number(),
            jacobian: Matrix2::new(a, b, c, d),
        }
    }
}

fn run(textures: u64, samples: u64) {
    let sizes =
        [(1, 1), (1, 700), (700, 1), (2, 3), (17, 5), (64, 64), (100, 33), (16_384, 2), (3, 2000)];
    let mut worst = 0;
    for seed in 0..textures {
        let mut fuzz = Fuzz(Random::new(seed + 1));
        let (width, height) = fuzz.pick(&sizes);
        let options = fuzz.options();
        let t = Texture::new(noise(width, height, seed).view(), &options).unwrap();
        for _ in 0..samples {
            let (s, f) = (fuzz.sampler(), fuzz.footprint());
            let Premul([r, g, b, a]) = t.sample(&f, &s);
            let good = (0.0..=1.0).contains(&a) && [r, g, b].iter().all(|v| (0.0..=a).contains(v));
            let cost = t.cost(&f, &s);
            worst = worst.max(cost);
            assert!(
                good && cost <= most(&s),
                "{width}×{height} {options:?} {s:?} {f:?}: {:?}, {cost} texels",
                [r, g, b, a]
            );
        }
        let f = fuzz.footprint();
        let Premul(c) = compare::vulkan_anisotropic(&t, &f, 16);
        assert!(c.iter().all(|v| (0.0..=1.00001).contains(v)), "{f:?}: {c:?}");
    }
    println!("{} samples, at most {worst} texels each", textures * samples);
}

#[test]
fn nothing_breaks_a_filter() {
    run(200, 500);
}

#[test]
#[ignore = "minutes"]
fn nothing_breaks_a_filter_in_ten_million() {
    run(10_000, 1000);
}
