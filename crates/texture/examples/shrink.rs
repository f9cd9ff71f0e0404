//! A picture to a thumbnail without aliasing, in linear light.
//!
//! `cargo run --release -p scumble-texture --example shrink` draws a fan of rays, shrinks it nine
//! times, and shows both the filtered thumbnail and what picking single texels makes of it.

use scumble_geometry::{Affine, DVec2, Homography};
use scumble_pixel::{Image, Premul, WorkingSpace};
use scumble_texture::{LevelMode, PixelFilter, Sampler, Texture, TextureOptions};

/// 36 rays that run together in the middle.
fn rays(size: usize) -> Result<Image<[u8; 4]>, scumble_pixel::ImageError> {
    Image::from_fn(size, size, |x, y| {
        let half = size as f64 / 2.0;
        let angle = (y as f64 + 0.5 - half).atan2(x as f64 + 0.5 - half);
        if (angle * 36.0).sin() > 0.0 { [255; 4] } else { [0, 0, 0, 255] }
    })
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let picture = rays(360)?;
    let (from, to) = (360.0, 40);

    // The three lines: a texture, the map from the thumbnail's pixels to its texels, and a row at a
    // time.
    let options = TextureOptions { space: WorkingSpace::Linear, ..Default::default() };
    let texture = Texture::new(picture.view(), &options)?;
    let map = Homography::from(Affine::scale(from / to as f64, from / to as f64));

    let nearest = Sampler::default().with(PixelFilter::Nearest, LevelMode::Zero);
    for (name, sampler) in [("filtered", Sampler::default()), ("single texels", nearest)] {
        println!("{name}:");
        for y in 0..to {
            let mut row = vec![Premul::TRANSPARENT; to];
            texture.sample_row(&map, DVec2::new(0.5, y as f64 + 0.5), &sampler, &mut row);
            // Five shades of grey, by light.
            let shade = |c: &Premul| [" ", "░", "▒", "▓", "█"][(c.0[0] * 4.99) as usize];
            println!("{}", row.iter().map(|c| shade(c).repeat(2)).collect::<String>());
        }
    }
    Ok(())
}
