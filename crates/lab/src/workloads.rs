//! Frames to measure: many small triangles, few large ones, smooth ones.
//!
//! They have the shape of the workloads that rasterizers are usually compared on: triangles of
//! one area, turned at random, all inside a 1920 × 1080 canvas, corners on a 1/256 pixel grid.

use scumble_geometry::{DVec2, Homography};
use scumble_pixel::Straight;
use scumble_scene::{Command, GouraudTriangle, Scene, View};

/// Columns of the canvas.
pub const WIDTH: u32 = 1920;
/// Rows of the canvas.
pub const HEIGHT: u32 = 1080;

/// 100,000 flat triangles of 10 pixels: set-up counts.
#[must_use]
pub fn small() -> Scene {
    triangles(100_000, 10.0, 3, false)
}

/// 1,000 flat triangles of 50,000 pixels, each hidden many times over: filling counts.
#[must_use]
pub fn large() -> Scene {
    triangles(1_000, 50_000.0, 4, false)
}

/// 10,000 triangles of 500 pixels with a colour at each corner: interpolation counts.
#[must_use]
pub fn smooth() -> Scene {
    triangles(10_000, 500.0, 5, true)
}

fn triangles(count: usize, area: f64, seed: u64, smooth: bool) -> Scene {
    let mut random = Random(seed);
    let commands = (0..count)
        .map(|_| {
            let points = {
                let shape = corners(&mut random, area);
                place(&mut random, shape)
            };
            let flat = random.color();
            let colors = if smooth { [flat, random.color(), random.color()] } else { [flat; 3] };
            Command::Gouraud(GouraudTriangle { points, colors, transform: Homography::IDENTITY })
        })
        .collect();
    Scene {
        view: View::Fit { size: DVec2::new(f64::from(WIDTH), f64::from(HEIGHT)) },
        background: Some(Straight::BLACK),
        images: Vec::new(),
        commands,
    }
}

/// A triangle of a given area about the origin, its corners on a circle.
fn corners(random: &mut Random, area: f64) -> [DVec2; 3] {
    let turn = random.unit();
    let points = [0.0, 1.0, 2.0].map(|third| {
        let angle = (turn + third / 3.0 + (random.unit() - 0.5) / 6.0) * std::f64::consts::TAU;
        DVec2::new(angle.cos(), angle.sin())
    });
    let [a, b, c] = points;
    let unscaled = (b - a).perp_dot(c - a).abs() / 2.0;
    points.map(|p| p * (area / unscaled).sqrt())
}

/// Moves a triangle somewhere inside the canvas, onto the grid.
fn place(random: &mut Random, points: [DVec2; 3]) -> [DVec2; 3] {
    let low = points.iter().fold(DVec2::INFINITY, |low, p| low.min(*p));
    let high = points.iter().fold(DVec2::NEG_INFINITY, |high, p| high.max(*p));
    let room = DVec2::new(f64::from(WIDTH), f64::from(HEIGHT)) - (high - low);
    let at = DVec2::new(random.unit(), random.unit()) * room - low;
    points.map(|p| ((p + at) * 256.0).round() / 256.0)
}

/// SplitMix64 (Steele, Lea and Flood 2014).
#[derive(Debug, Clone)]
struct Random(u64);

impl Random {
    fn next(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }

    /// In 0…1.
    fn unit(&mut self) -> f64 {
        (self.next() >> 11) as f64 / (1u64 << 53) as f64
    }

    /// An opaque colour.
    fn color(&mut self) -> Straight {
        let bytes = self.next().to_le_bytes();
        Straight::from_rgba8(bytes[0], bytes[1], bytes[2], 255)
    }
}
