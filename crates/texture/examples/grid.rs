//! The ground grid of a 3-D viewport, four ways side by side: not antialiased, by the clamped gradient,
//! by the exact integral of its lines over the pixel, and that under anisotropic probes.
//!
//! `cargo run --release -p scumble-texture --example grid [OUT.png]`
//!
//! The first crawls with aliases. The second is smooth near by and then turns to an even grey of ½ where
//! the lines cover a tenth. The third is right on average, and the fourth keeps lines at 45° apart
//! farther out, because it sees a long thin pixel as a row of spots.

use scumble_geometry::{DVec2, Homography};
use scumble_pixel::{Premul, WorkingSpace};
use scumble_texture::procedural::{Antialias, Grid, Source};
use scumble_texture::{Footprint, Probes};

const WIDTH: u32 = 320;
const HEIGHT: u32 = 360;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    // The floor under an eye at height 1.2, the horizon above the picture's top edge.
    let (height, focal, horizon) = (1.2, 300.0, -3.0);
    let (s, c) = 0.6f64.sin_cos();
    let side = [height, 0.0, -height * f64::from(WIDTH / 2)];
    let ahead = [0.0, 0.0, height * focal];
    let row = |a: f64, b: f64| core::array::from_fn(|i| a * side[i] + b * ahead[i]);
    let map = Homography::new([row(c, -s), row(s, c), [0.0, 1.0, -horizon]]);

    let dark = Premul([0.01, 0.012, 0.02, 1.0]);
    let grid = |antialias| Grid { width: 0.06, ground: dark, antialias, ..Grid::default() };
    let probes = Probes::new(32);
    type Way<'a> = Box<dyn Fn(&Footprint) -> Premul + 'a>;
    let plain = |antialias| -> Way { Box::new(move |f| grid(antialias).color(f)) };
    let ways: [Way; 4] = [
        plain(Antialias::None),
        plain(Antialias::Gradient),
        plain(Antialias::Integral),
        Box::new(move |f| probes.sample(f, &grid(Antialias::Integral))),
    ];

    let mut picture = image::RgbaImage::new(4 * WIDTH, HEIGHT);
    for (x, y, out) in picture.enumerate_pixels_mut() {
        let way = &ways[(x / WIDTH) as usize];
        let at = DVec2::new(f64::from(x % WIDTH) + 0.5, f64::from(y) + 0.5);
        *out = image::Rgba(WorkingSpace::Linear.export(way(&Footprint::at(&map, at))));
    }
    let path = std::env::args().nth(1).unwrap_or_else(|| "target/grid.png".into());
    picture.save(&path)?;
    println!("{path}: none, clamped gradient, integral, integral under probes");
    Ok(())
}
