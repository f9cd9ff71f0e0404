//! One antialiased triangle, from corners to a PNG.
//!
//! `cargo run --release -p scumble-coverage --example triangle [OUT.png]`

use image::{GrayImage, Luma};
use scumble_coverage::{AreaSink, DVec2, IntRect, Scratch, Shape};

struct Canvas(GrayImage);

impl AreaSink for Canvas {
    fn run(&mut self, y: i32, x0: i32, x1: i32) {
        (x0..x1).for_each(|x| self.pixel(x, y, 1.0));
    }
    fn pixel(&mut self, x: i32, y: i32, area: f32) {
        self.0.put_pixel(x as u32, y as u32, Luma([(area * 255.0 + 0.5) as u8]));
    }
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let corners = [DVec2::new(20.0, 30.5), DVec2::new(230.2, 90.0), DVec2::new(70.7, 235.0)];
    let mut canvas = Canvas(GrayImage::new(256, 256));
    if let Some(shape) = Shape::triangle(corners)? {
        shape.rasterize_area(IntRect::new(0, 0, 256, 256), &mut Scratch::new(), &mut canvas);
    }
    let out = std::env::args().nth(1).unwrap_or_else(|| "triangle.png".into());
    canvas.0.save(&out)?;
    println!("{out}");
    Ok(())
}
