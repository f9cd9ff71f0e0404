//! A ground plane to its horizon: what each sampler reads, how far it is from the truth, and a picture
//! of all of them, one strip below the other.
//!
//! `cargo run --release -p scumble-texture --example ground [OUT.png]`

use scumble_geometry::{DVec2, Homography};
use scumble_pixel::{Image, Premul};
use scumble_texture::reference::{PixelShape, Reference};
use scumble_texture::{Footprint, LevelMode, PixelFilter, Sampler, Texture, TextureOptions, Wrap};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let tile = Image::from_fn(128, 128, |x, y| {
        if (x / 16 + y / 16) % 2 == 0 { [255, 255, 255, 255] } else { [30, 60, 90, 255] }
    })?;
    let options = TextureOptions { wrap: Wrap::Repeat, ..Default::default() };
    let texture = Texture::new(tile.view(), &options)?;

    // Looking along the ground from 64 texels above it, 320×180, with the horizon at row −4.
    let (height, focal, horizon) = (64.0, 240.0, -4.0);
    let map = Homography::new([
        [height, 0.0, -160.0 * height],
        [0.0, 0.0, height * focal],
        [0.0, 1.0, -horizon],
    ]);

    let base = Sampler::default();
    let samplers = [
        ("nearest", base.with(PixelFilter::Nearest, LevelMode::Zero)),
        ("trilinear", base.with(PixelFilter::Bilinear, LevelMode::Linear)),
        ("probes", base.with(PixelFilter::Probes, LevelMode::Auto)),
        ("classic", Sampler::CLASSIC),
        ("fast", Sampler::FAST),
        ("default", Sampler::DEFAULT),
        ("high", Sampler::HIGH),
    ];
    let truth = Reference::new(&texture, PixelShape::Gaussian { sigma: 0.5 }).with_density(1.0, 16);
    let rows = [6, 12, 25, 50, 100];
    println!(
        "worst error in 255ths by row (the horizon is above row 0), and texels read per pixel"
    );
    let mut strips = image::RgbaImage::new(320, 60 * samplers.len() as u32);
    for (k, (name, sampler)) in samplers.into_iter().enumerate() {
        for y in 0..60 {
            let mut row = [Premul::TRANSPARENT; 320];
            texture.sample_row(&map, DVec2::new(0.5, f64::from(y) + 0.5), &sampler, &mut row);
            for (x, color) in row.iter().enumerate() {
                let pixel = image::Rgba(options.space.export(*color));
                strips.put_pixel(x as u32, 60 * k as u32 + y, pixel);
            }
        }
        print!("{name:9}");
        for y in rows {
            let start = DVec2::new(0.5, f64::from(y) + 0.5);
            let mut row = [Premul::TRANSPARENT; 320];
            texture.sample_row(&map, start, &sampler, &mut row);
            let (mut worst, mut texels) = (0.0f64, 0);
            for x in (0..320).step_by(16) {
                let place = start + DVec2::new(x as f64, 0.0);
                let error = f64::from(row[x].0[0]) - truth.sample(&map, place)[0];
                worst = worst.max(error.abs() * 255.0);
                texels += texture.cost(&Footprint::at(&map, place), &sampler);
            }
            print!("  {worst:6.2} ({:4})", texels / 20);
        }
        println!();
    }
    let path = std::env::args().nth(1).unwrap_or_else(|| "target/ground-strips.png".into());
    strips.save(&path)?;
    println!("{path}: {}", samplers.map(|(name, _)| name).join(", "));
    Ok(())
}
