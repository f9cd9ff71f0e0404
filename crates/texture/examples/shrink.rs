//! A picture to a thumbnail without aliasing, in linear light.
//!
//! `cargo run --release -p scumble-texture --example shrink [OUT.png]` draws hills under a fence and a
//! sun of rays, shrinks them nine times, and shows the filtered thumbnail beside what picking single
//! texels makes of it, both enlarged four times.

use scumble_geometry::{Affine, DVec2, Homography};
use scumble_pixel::{Image, Premul, WorkingSpace};
use scumble_texture::{LevelMode, PixelFilter, Sampler, Texture, TextureOptions};

/// A landscape of details finer than a pixel of the thumbnail.
fn landscape(size: usize) -> Result<Image<[u8; 4]>, scumble_pixel::ImageError> {
    Image::from_fn(size, size, |i, j| {
        let (x, y) = (i as f64 / size as f64, j as f64 / size as f64);
        let hill = 0.62 + 0.08 * (7.0 * x).sin() + 0.03 * (23.0 * x + 1.0).sin();
        let (dx, dy) = (x - 0.68, y - 0.27);
        let far = dx.hypot(dy);
        let [r, g, b] = if far < 0.05 {
            [255, 240, 160]
        } else if far < 0.24 && (60.0 * dy.atan2(dx)).sin() > 0.2 {
            [250, 200, 90]
        } else if y > 0.72 && (i / 4) % 3 == 0 || (0.76..0.78).contains(&y) {
            [245, 245, 240]
        } else if y > hill {
            let blades = ((i * 31 + j * 17) % 23) as u8;
            [30 + blades, 90 + 4 * blades, 40]
        } else {
            [70 + (60.0 * y) as u8, 130 + (70.0 * y) as u8, 220]
        };
        [r, g, b, 255]
    })
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let picture = landscape(1080)?;
    let (from, to) = (1080.0, 120);

    // The three lines: a texture, the map from the thumbnail's pixels to its texels, and rows of it.
    let options = TextureOptions { space: WorkingSpace::Linear, ..Default::default() };
    let texture = Texture::new(picture.view(), &options)?;
    let map = Homography::from(Affine::scale(from / to as f64, from / to as f64));

    let nearest = Sampler::default().with(PixelFilter::Nearest, LevelMode::Zero);
    let zoom = 4;
    let mut out = image::RgbaImage::new(2 * zoom * to as u32, zoom * to as u32);
    for (k, sampler) in [Sampler::default(), nearest].iter().enumerate() {
        let mut row = vec![Premul::TRANSPARENT; to];
        for y in 0..to {
            texture.sample_row(&map, DVec2::new(0.5, y as f64 + 0.5), sampler, &mut row);
            for (x, color) in row.iter().enumerate() {
                let (x, y) = ((k * to + x) as u32 * zoom, y as u32 * zoom);
                for i in 0..zoom * zoom {
                    let pixel = image::Rgba(options.space.export(*color));
                    out.put_pixel(x + i % zoom, y + i / zoom, pixel);
                }
            }
        }
    }
    let path = std::env::args().nth(1).unwrap_or_else(|| "target/shrink.png".into());
    out.save(&path)?;
    println!("{path}: filtered, and single texels");
    Ok(())
}
