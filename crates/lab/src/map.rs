//! The world on a sheet of many triangles of moderate size: what the ways of finding covered samples
//! are compared on.
//!
//! The triangles are a mesh: they share out the sheet without gap or overlap. So a flat picture of
//! it needs no buffer of samples: each triangle adds its colour to a pixel once for every sample
//! that it owns there, in any order, and the sum over the number of samples is the pixel.

use crate::math::{cos, sin};
use crate::textures;
use scumble::coverage::{IntRect, SampleMask, SamplePattern, Scratch, Shape, Sink, Traversal};
use scumble_geometry::{DVec2, Homography};
use scumble_pixel::{Image, Straight};
use scumble_scene::{
    Command, GouraudTriangle, ImageId, ImageWrap, Scene, SceneImage, TexturedTriangle, View,
};
use std::f64::consts::TAU;
use std::sync::{Mutex, PoisonError};

/// Columns of the picture.
pub const WIDTH: u32 = 800;
/// Rows of the picture.
pub const HEIGHT: u32 = 600;

const COLUMNS: u32 = 40;
const ROWS: u32 = 30;

/// Rows of pixels that a thread takes at a time: few enough for all threads to end together, enough
/// that few triangles are met twice.
const BAND: usize = 32;

/// One triangle of the sheet.
#[derive(Debug, Clone, PartialEq)]
pub struct Piece {
    /// Its corners in pixels.
    pub points: [DVec2; 3],
    /// Where they lie on the map.
    pub uvs: [DVec2; 3],
    /// The map's colour in its middle.
    pub color: [u8; 3],
}

/// The sheet, and the map on it.
#[derive(Debug, Clone)]
pub struct Map {
    /// 2400 triangles of about 170 pixels.
    pub pieces: Vec<Piece>,
    texture: Image<[u8; 4]>,
}

impl Map {
    /// Draws the map and lays it on the sheet.
    #[must_use]
    pub fn new() -> Self {
        let texture = textures::world();
        let mut pieces = Vec::new();
        for j in 0..ROWS {
            for i in 0..COLUMNS {
                let cell = [(i, j), (i + 1, j), (i + 1, j + 1), (i, j + 1)].map(|(i, j)| {
                    DVec2::new(f64::from(i) / f64::from(COLUMNS), f64::from(j) / f64::from(ROWS))
                });
                for half in [[0, 1, 2], [0, 2, 3]] {
                    let uvs = half.map(|k: usize| cell[k]);
                    let middle = (uvs[0] + uvs[1] + uvs[2]) / 3.0;
                    let (x, y) =
                        (middle.x * texture.width() as f64, middle.y * texture.height() as f64);
                    let [r, g, b, _] =
                        texture.get(x as usize, y as usize).copied().unwrap_or([0; 4]);
                    pieces.push(Piece { points: uvs.map(place), uvs, color: [r, g, b] });
                }
            }
        }
        Self { pieces, texture }
    }

    /// The same without triangles: what a frame takes before anything is covered.
    #[must_use]
    pub fn blank() -> Self {
        Self { pieces: Vec::new(), texture: Image::default() }
    }

    /// As a scene for the driver: each triangle in its flat colour, or with its part of the map.
    #[must_use]
    pub fn scene(&self, textured: bool) -> Scene {
        let command = |piece: &Piece| {
            let (points, transform) = (piece.points, Homography::IDENTITY);
            if textured {
                let (uvs, image) = (piece.uvs, ImageId(0));
                Command::Textured(TexturedTriangle { points, uvs, image, opacity: 1.0, transform })
            } else {
                let [r, g, b] = piece.color;
                let colors = [Straight::from_rgba8(r, g, b, 255); 3];
                Command::Gouraud(GouraudTriangle { points, colors, transform })
            }
        };
        let image = SceneImage { pixels: self.texture.clone(), wrap: ImageWrap::Clamp };
        Scene {
            view: View::Fit { size: DVec2::new(f64::from(WIDTH), f64::from(HEIGHT)) },
            background: Some(Straight::WHITE),
            images: if textured { vec![image] } else { Vec::new() },
            commands: self.pieces.iter().map(command).collect(),
        }
    }

    /// One frame, flat on white, from the corners to the finished pixels, row by row.
    ///
    /// The triangles are set up; then the picture is cut into bands of 32 rows, and each thread
    /// takes the next band that none has taken, and clears, fills and resolves it.
    pub fn draw(
        &self,
        traversal: Traversal,
        pattern: &SamplePattern,
        threads: usize,
        canvas: &mut Canvas,
    ) {
        let shape = |piece: &Piece| Some((Shape::triangle(piece.points).ok()??, piece.color));
        let shapes: Vec<(Shape, [u8; 3])> = self.pieces.iter().filter_map(shape).collect();
        let rows = BAND * WIDTH as usize;
        let bands = canvas.sums.chunks_mut(rows).zip(canvas.pixels.chunks_mut(rows));
        let bands = Mutex::new((0..).step_by(BAND).zip(bands));
        let work = || {
            let mut scratch = Scratch::new();
            loop {
                let band = bands.lock().unwrap_or_else(PoisonError::into_inner).next();
                let Some((y, (sums, pixels))) = band else { break };
                let mut band = Band { y, sums, samples: pattern.len() as u64, color: 0 };
                band.fill(&shapes, traversal, pattern, &mut scratch);
                band.resolve(pixels);
            }
        };
        std::thread::scope(|scope| {
            for _ in 1..threads {
                scope.spawn(work);
            }
            work();
        });
    }
}

impl Default for Map {
    fn default() -> Self {
        Self::new()
    }
}

/// A place of the map on the waving sheet.
fn place(uv: DVec2) -> DVec2 {
    let wave = sin(uv.x * TAU * 1.3 + uv.y * 1.1);
    let swell = cos(uv.x * TAU * 0.9 - uv.y * 2.0);
    DVec2::new(
        40.0 + 720.0 * uv.x + 20.0 * swell,
        65.0 + 460.0 * uv.y + 45.0 * wave - 20.0 * swell * uv.y,
    )
}

/// What [`Map::draw`] draws on, kept from frame to frame.
#[derive(Debug, Clone)]
pub struct Canvas {
    /// Four sums of 16 bits a pixel: of red, green and blue over the covered samples, and their
    /// number. 64 samples of 255 fit.
    sums: Vec<u64>,
    pixels: Vec<[u8; 4]>,
}

impl Canvas {
    /// A canvas of [`WIDTH`] by [`HEIGHT`].
    #[must_use]
    pub fn new() -> Self {
        let size = WIDTH as usize * HEIGHT as usize;
        Self { sums: vec![0; size], pixels: vec![[0; 4]; size] }
    }

    /// The pixels, row by row.
    #[must_use]
    pub fn pixels(&self) -> &[[u8; 4]] {
        &self.pixels
    }
}

impl Default for Canvas {
    fn default() -> Self {
        Self::new()
    }
}

/// Some rows of the picture.
struct Band<'a> {
    y: i32,
    sums: &'a mut [u64],
    samples: u64,
    /// What a covered sample adds.
    color: u64,
}

impl Band<'_> {
    fn fill(
        &mut self,
        shapes: &[(Shape, [u8; 3])],
        traversal: Traversal,
        pattern: &SamplePattern,
        scratch: &mut Scratch,
    ) {
        self.sums.fill(0);
        let height = (self.sums.len() / WIDTH as usize) as i32;
        let clip = IntRect::new(0, self.y, WIDTH as i32, self.y + height);
        for (shape, [r, g, b]) in shapes {
            self.color = u64::from(*r) | u64::from(*g) << 16 | u64::from(*b) << 32 | 1 << 48;
            shape.rasterize_by(traversal, clip, pattern, scratch, self);
        }
    }

    /// The mean of each pixel's samples; those that nothing covers are white.
    fn resolve(&self, pixels: &mut [[u8; 4]]) {
        let scale = 1.0 / self.samples as f32;
        let mean = |sum: u64| {
            let lane = |k: u32| (sum >> (16 * k)) as u16;
            let white = (self.samples as u16 - lane(3)) * 255;
            let mean = |k: u32| (f32::from(lane(k) + white) * scale + 0.5) as u8;
            [mean(0), mean(1), mean(2), 255]
        };
        // Most pixels are as the one before.
        let (mut before, mut color) = (0, mean(0));
        for (pixel, &sum) in pixels.iter_mut().zip(&*self.sums) {
            if sum != before {
                (before, color) = (sum, mean(sum));
            }
            *pixel = color;
        }
    }

    fn at(&self, x: i32, y: i32) -> usize {
        (y - self.y) as usize * WIDTH as usize + x as usize
    }
}

impl Sink for Band<'_> {
    fn run(&mut self, y: i32, x0: i32, x1: i32) {
        let first = self.at(x0, y);
        // Nothing else owns a sample there.
        self.sums[first..first + (x1 - x0) as usize].fill(self.color * self.samples);
    }

    fn pixel(&mut self, x: i32, y: i32, mask: SampleMask) {
        let at = self.at(x, y);
        self.sums[at] += self.color * u64::from(mask.count());
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use scumble::coverage::Order;

    #[test]
    fn every_traversal_on_any_number_of_threads_draws_the_driver_s_picture() {
        let map = Map::new();
        let mut canvas = Canvas::new();
        for samples in [1, 9, 16] {
            let mut settings = scumble::Settings::new(WIDTH, HEIGHT);
            settings.pattern = SamplePattern::grid(samples).unwrap();
            let picture = scumble::render_image(&map.scene(false), &settings).unwrap();
            for traversal in [
                Traversal::Tiled,
                Traversal::BoundingBox,
                Traversal::Scanline,
                Traversal::Incremental(Order::ZigZag),
            ] {
                for threads in [1, 3] {
                    canvas.pixels.fill([7; 4]);
                    map.draw(traversal, &settings.pattern, threads, &mut canvas);
                    let off = canvas.pixels().iter().zip(picture.pixels());
                    let off = off.filter(|(a, b)| (0..4).any(|k| a[k].abs_diff(b[k]) > 1)).count();
                    assert_eq!(off, 0, "{traversal:?}, {samples} samples, {threads} threads");
                }
            }
        }
    }
}
