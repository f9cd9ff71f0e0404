//! The visiting orders as pictures: the pixels of a triangle from first (dark) to last (light), and
//! the path between them.
//!
//! `cargo run --release -p scumble-coverage --example order [OUT.png]`

use image::{Rgb, RgbImage};
use scumble_coverage::{
    DVec2, IntRect, Order, SampleMask, SamplePattern, Scratch, Shape, Sink, Traversal, hairline,
};

/// Pixels of the triangle's little canvas, and how large each is drawn.
const SIDE: u32 = 24;
const ZOOM: u32 = 14;
const GAP: u32 = 16;

/// Writes down the pixels in the order in which they come.
#[derive(Default)]
struct Path(Vec<(i32, i32)>);

impl Sink for Path {
    fn run(&mut self, y: i32, x0: i32, x1: i32) {
        self.0.extend((x0..x1).map(|x| (x, y)));
    }
    fn pixel(&mut self, x: i32, y: i32, _mask: SampleMask) {
        self.0.push((x, y));
    }
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let corners = [DVec2::new(21.0, 1.0), DVec2::new(1.5, 9.0), DVec2::new(16.0, 23.0)];
    let Some(shape) = Shape::triangle(corners)? else { return Ok(()) };
    let pattern = SamplePattern::standard(1)?;
    let orders = [Order::RowMajor, Order::Backtrack, Order::ZigZag, Order::Morton, Order::Hilbert];
    let panel = SIDE * ZOOM + GAP;
    let mut image =
        RgbImage::from_pixel(panel * orders.len() as u32 + GAP, panel + GAP, Rgb([250, 250, 247]));
    for (i, order) in orders.into_iter().enumerate() {
        let mut path = Path::default();
        let clip = IntRect::new(0, 0, SIDE as i32, SIDE as i32);
        let way = Traversal::Incremental(order);
        shape.rasterize_by(way, clip, &pattern, &mut Scratch::new(), &mut path);
        draw(&mut image, i as u32 * panel + GAP, &path.0);
    }
    let out = std::env::args().nth(1).unwrap_or_else(|| "order.png".into());
    image.save(&out)?;
    println!("{out}");
    Ok(())
}

fn draw(image: &mut RgbImage, left: u32, path: &[(i32, i32)]) {
    for (i, &(x, y)) in path.iter().enumerate() {
        let t = i as f32 / path.len() as f32;
        let mix = |from: f32, to: f32| (from + (to - from) * t) as u8;
        let color = Rgb([mix(40.0, 250.0), mix(60.0, 215.0), mix(120.0, 130.0)]);
        for dy in 1..ZOOM {
            for dx in 1..ZOOM {
                image.put_pixel(left + x as u32 * ZOOM + dx, GAP + y as u32 * ZOOM + dy, color);
            }
        }
    }
    let center = |(x, y): (i32, i32)| {
        let at = |v: i32, from: u32| f64::from(v as u32 * ZOOM + from + ZOOM / 2);
        DVec2::new(at(x, left) + 0.5, at(y, GAP) + 0.5)
    };
    let clip = IntRect::new(0, 0, image.width() as i32, image.height() as i32);
    for pair in path.windows(2) {
        hairline(center(pair[0]), center(pair[1]), clip, |x, y| {
            image.put_pixel(x as u32, y as u32, Rgb([190, 30, 50]));
        });
    }
}
