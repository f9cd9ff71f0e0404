//! A renderer of one's own on top of the crate: a turning cube with a checkered texture, a depth
//! test per sample and perspective-correct interpolation, six turns side by side.
//!
//! `cargo run --release -p scumble-coverage --example zbuffer [OUT.png]`

use image::{Rgb, RgbImage};
use scumble_coverage::{
    DVec2, IntRect, Perspective, SampleMask, SamplePattern, Scratch, Shape, Sink,
};

const SIZE: i32 = 240;
const SAMPLES: usize = 16;
const FRAMES: u32 = 6;

/// Colour and depth of every sample.
struct Frame {
    color: Vec<[f32; 3]>,
    /// 1/w: the larger, the nearer.
    depth: Vec<f64>,
}

/// Shades one triangle into a frame: a sink that sees the perspective.
struct Shader<'a> {
    frame: &'a mut Frame,
    pattern: &'a SamplePattern,
    perspective: Perspective,
    uv: [DVec2; 3],
    light: f32,
}

impl Shader<'_> {
    /// Colours once per pixel, at its centre, then tests the depth of each covered sample.
    fn shade(&mut self, x: i32, y: i32, mask: SampleMask) {
        let color = self.texture(self.perspective.at(x, y, [128, 128]).weights);
        for (s, &offset) in self.pattern.offsets().iter().enumerate() {
            if !mask.contains(s as u32) {
                continue;
            }
            let depth = self.perspective.at(x, y, offset).inverse_w;
            let i = (y * SIZE + x) as usize * SAMPLES + s;
            if depth > self.frame.depth[i] {
                self.frame.depth[i] = depth;
                self.frame.color[i] = color;
            }
        }
    }

    fn texture(&self, weights: [f64; 3]) -> [f32; 3] {
        let uv = self.uv[0] * weights[0] + self.uv[1] * weights[1] + self.uv[2] * weights[2];
        let checker = ((uv.x * 6.0).floor() + (uv.y * 6.0).floor()) as i32 & 1 == 0;
        let base = if checker { [0.95, 0.85, 0.6] } else { [0.25, 0.4, 0.65] };
        base.map(|v| v * self.light)
    }
}

impl Sink for Shader<'_> {
    fn run(&mut self, y: i32, x0: i32, x1: i32) {
        let all = self.pattern.full_mask();
        (x0..x1).for_each(|x| self.shade(x, y, all));
    }
    fn pixel(&mut self, x: i32, y: i32, mask: SampleMask) {
        self.shade(x, y, mask);
    }
}

/// A corner of the cube (±1 each) turned and projected: where it is seen, and its w.
fn project(p: [f64; 3], turn: f64) -> (DVec2, f64) {
    let ((s, c), (st, ct)) = (turn.sin_cos(), 0.5f64.sin_cos());
    let (x, z) = (p[0] * c - p[2] * s, p[0] * s + p[2] * c);
    let (y, z) = (p[1] * ct - z * st, p[1] * st + z * ct);
    let w = z + 4.5;
    let scale = 1.1 * f64::from(SIZE) / w;
    (DVec2::new(x, y) * scale + DVec2::splat(f64::from(SIZE) / 2.0), w)
}

/// The six faces: the corner where uv = (0, 0), and the ways u and v go.
const FACES: [[[f64; 3]; 3]; 6] = [
    [[-1.0, -1.0, -1.0], [2.0, 0.0, 0.0], [0.0, 2.0, 0.0]],
    [[1.0, -1.0, 1.0], [-2.0, 0.0, 0.0], [0.0, 2.0, 0.0]],
    [[-1.0, -1.0, 1.0], [0.0, 0.0, -2.0], [0.0, 2.0, 0.0]],
    [[1.0, -1.0, -1.0], [0.0, 0.0, 2.0], [0.0, 2.0, 0.0]],
    [[-1.0, -1.0, 1.0], [2.0, 0.0, 0.0], [0.0, 0.0, -2.0]],
    [[-1.0, 1.0, -1.0], [2.0, 0.0, 0.0], [0.0, 0.0, 2.0]],
];

fn render(turn: f64) -> Result<Frame, Box<dyn std::error::Error>> {
    let samples = (SIZE * SIZE) as usize * SAMPLES;
    let mut frame = Frame { color: vec![[0.1, 0.1, 0.12]; samples], depth: vec![0.0; samples] };
    let pattern = SamplePattern::standard(SAMPLES)?;
    let mut scratch = Scratch::new();
    for (face, [corner, u, v]) in FACES.iter().enumerate() {
        let at = |s: f64, t: f64| {
            let p = core::array::from_fn(|i| corner[i] + s * u[i] + t * v[i]);
            let (screen, w) = project(p, turn);
            (screen, w, DVec2::new(s, t))
        };
        let [a, b, c, d] = [at(0.0, 0.0), at(1.0, 0.0), at(1.0, 1.0), at(0.0, 1.0)];
        for t in [[a, b, c], [a, c, d]] {
            let corners = t.map(|v| v.0);
            let Some(perspective) = Perspective::new(corners, t.map(|v| v.1)) else { continue };
            let Some(shape) = Shape::triangle(corners)? else { continue };
            let light = [1.0, 0.9, 0.75, 0.85, 0.65, 0.5][face];
            let mut shader = Shader {
                frame: &mut frame,
                pattern: &pattern,
                perspective,
                uv: t.map(|v| v.2),
                light,
            };
            let clip = IntRect::new(0, 0, SIZE, SIZE);
            shape.rasterize(clip, &pattern, &mut scratch, &mut shader);
        }
    }
    Ok(frame)
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let mut image = RgbImage::new(SIZE as u32 * FRAMES, SIZE as u32);
    for i in 0..FRAMES {
        let frame = render(f64::from(i) * core::f64::consts::FRAC_PI_2 / f64::from(FRAMES) + 0.2)?;
        for (pixel, samples) in frame.color.chunks(SAMPLES).enumerate() {
            let mean = |k: usize| samples.iter().map(|c| c[k]).sum::<f32>() / SAMPLES as f32;
            let color = [mean(0), mean(1), mean(2)].map(|v| (v * 255.0 + 0.5) as u8);
            let (x, y) = (pixel as u32 % SIZE as u32, pixel as u32 / SIZE as u32);
            image.put_pixel(i * SIZE as u32 + x, y, Rgb(color));
        }
    }
    let out = std::env::args().nth(1).unwrap_or_else(|| "zbuffer.png".into());
    image.save(&out)?;
    println!("{out}");
    Ok(())
}
