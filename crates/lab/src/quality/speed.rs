//! How long the methods take: for the terminal, as no two runs agree.

use super::QualityError;
use super::methods::{Method, TABLE};
use super::sources::SOURCES;
use super::warps::{self, HEIGHT, WIDTH};
use crate::timing;
use scumble::pixel::Premul;
use scumble::texture::{Footprint, Texture};
use scumble_geometry::{DVec2, Homography};
use std::fmt::Write;

/// Nanoseconds for a pixel of W1 by each method, one core, as a table in Markdown.
///
/// # Errors
/// As for [`super::measure`].
pub fn times() -> Result<String, QualityError> {
    let t = SOURCES[0].texture()?;
    let [ground, ..] = warps::all()?;
    let mut out = String::from("| W1 | ns per pixel |\n|---|---|\n");
    for (name, method) in &TABLE {
        let [times] = timing::frames(5, || {
            Ok::<_, QualityError>([timing::clock(|| {
                draw(&t, &ground, method);
                Ok::<_, QualityError>(())
            })?])
        })?;
        let pixels = (WIDTH * HEIGHT.div_ceil(STEP)) as f64;
        let _ = writeln!(out, "| {name} | {:.0} |", times.median * 1e6 / pixels);
    }
    Ok(out)
}

/// One row in so many is drawn.
const STEP: usize = 4;

fn draw(t: &Texture, map: &Homography, method: &Method) {
    let mut row = vec![Premul::default(); WIDTH];
    for y in (0..HEIGHT).step_by(STEP) {
        let start = DVec2::new(0.5, y as f64 + 0.5);
        match method {
            Method::Sampler(s) => t.sample_row(map, start, s, &mut row),
            Method::Vulkan(_) => {
                for (x, out) in row.iter_mut().enumerate() {
                    let f = Footprint::at(map, start + DVec2::new(x as f64, 0.0));
                    *out = Premul(method.color(t, &f));
                }
            }
        }
        std::hint::black_box(&row);
    }
}
