//! Textures: how they are read, from which level, and what that takes.

use crate::gallery::Drawn;
use crate::gallery::ink::{BLUE, RED, codes, finish};
use crate::gallery::stage::{scene, shot};
use crate::svg::hue;
use crate::textures;
use scumble::coverage::SamplePattern;
use scumble::texture::{LevelMode, PixelFilter, Texture, TextureOptions};
use scumble_geometry::{DVec2, Homography, Rect};
use scumble_pixel::{Image, Straight, unorm8};
use scumble_sheet::{Anchor, Cell, Drawing, INK, contact_sheet};

const FILTERS: [(PixelFilter, &str); 3] = [
    (PixelFilter::Nearest, "nearest"),
    (PixelFilter::Bilinear, "bilinear"),
    (PixelFilter::Ewa, "EWA"),
];

pub(super) fn nearest_and_bilinear() -> Drawn {
    let scene = scene("map")?;
    let mut cells = Vec::new();
    for samples in [1, 16] {
        for (pixel, name) in FILTERS {
            let picture = shot(&scene, [800, 600], [268, 210, 90, 70], |settings| {
                settings.pattern = SamplePattern::grid(samples)?;
                settings.sampler = settings.sampler.with(pixel, LevelMode::Zero);
                Ok(())
            })?;
            let plural = if samples == 1 { "" } else { "s" };
            cells.push(Cell::new(picture, [format!("{name}, {samples} sample{plural}")]));
        }
    }
    finish(contact_sheet(&cells, 3, 3))
}

pub(super) fn pixel_and_level() -> Drawn {
    let scene = scene("ground")?;
    let mut cells = Vec::new();
    let levels = [
        (LevelMode::Zero, "level zero"),
        (LevelMode::Nearest, "nearest level"),
        (LevelMode::Linear, "between levels"),
    ];
    for (level, level_name) in levels {
        for (pixel, name) in FILTERS {
            let picture = shot(&scene, [800, 600], [300, 190, 290, 160], |settings| {
                settings.sampler = settings.sampler.with(pixel, level);
                Ok(())
            })?;
            cells.push(Cell::new(picture, [format!("{name}, {level_name}")]));
        }
    }
    let auto = shot(&scene, [800, 600], [300, 190, 290, 160], |_| Ok(()))?;
    cells.push(Cell::new(auto, ["EWA, level auto"]));
    finish(contact_sheet(&cells, 3, 1))
}

/// The colour of a level, from red for the finest on.
fn tint(level: u32) -> Straight {
    let [r, g, b] = hue(f64::from(level) / 9.0).map(|v| (0.25 + 0.65 * v) as f32);
    Straight([r, g, b, 1.0])
}

pub(super) fn levels() -> Drawn {
    const WIDTH: usize = 640;
    const HEIGHT: usize = 260;
    const HORIZON: f64 = 12.3;
    const LEVELS: u32 = 8;
    // From the screen to texels: what is one pixel below the horizon is farthest.
    let scale = 150.0;
    let map = Homography::new([
        [scale, 0.0, -scale * WIDTH as f64 / 2.0],
        [0.0, 0.0, scale * 120.0],
        [0.0, 1.0, -HORIZON],
    ]);
    let picture = Image::from_fn(WIDTH, HEIGHT, |x, y| {
        let at = DVec2::new(x as f64 + 0.5, y as f64 + 0.5);
        let (Some(here), true) = (map.project(at), at.y > HORIZON + 1.0) else {
            return [230, 236, 240, 255];
        };
        let step = |d: DVec2| map.project(at + d * 1e-4).map_or(0.0, |p| (p - here).length() * 1e4);
        let size = step(DVec2::new(1.0, 0.0)).max(step(DVec2::new(0.0, 1.0)));
        // The logarithm, rounded down: how often it can be halved.
        let (mut level, mut left) = (0, size);
        while left >= 2.0 && level < LEVELS {
            left /= 2.0;
            level += 1;
        }
        // The texels of the plane, in squares of 64, show how it lies.
        let square = ((here.x / 64.0).floor() + (here.y / 64.0).floor()) as i64 % 2 == 0;
        let [r, g, b, a] = codes(tint(level));
        let shade = |v: u8| if square { v } else { v - v / 5 };
        [shade(r), shade(g), shade(b), a]
    })?;
    let mut drawing = Drawing::new(WIDTH as u32 + 24, HEIGHT as u32 + 60);
    drawing.picture(picture, 12, 12, 1);
    for level in 0..=LEVELS {
        let x = 12.0 + 70.0 * f64::from(level);
        let y = HEIGHT as f64 + 24.0;
        drawing.rect(Rect::new(x, y, x + 20.0, y + 14.0), tint(level));
        let at = DVec2::new(x + 27.0, y + 12.0);
        drawing.text(at, 14.0, Anchor::Start, &level.to_string(), INK);
    }
    finish(drawing)
}

pub(super) fn memory() -> Drawn {
    let texture = Texture::new(textures::world().view(), &TextureOptions::default())?;
    let mut drawing = Drawing::new(640, 260);
    let mut x = 16;
    // The first two are too large to show.
    for level in (2..texture.level_count()).filter_map(|index| texture.level(index)) {
        let bytes = |color: &[f32; 4]| color.map(unorm8);
        let (width, height) = (level.width() as u32, level.height() as u32);
        drawing.picture(level.map(bytes), x, 156 - height, 1);
        x += width + 8;
    }
    let words = ["1/16", "1/64", "1/256", "1/1024"];
    let mut left = 16.0;
    for (index, words) in words.into_iter().enumerate() {
        let width = f64::from(256 >> index);
        let at = DVec2::new(left + width / 2.0, 176.0);
        drawing.text(at, 14.0, Anchor::Middle, words, INK);
        left += width + 8.0;
    }
    let mut left = 16.0;
    let parts = [(1.0, BLUE), (0.25, RED), (0.0625, RED), (0.015_625, RED), (0.005, RED)];
    for (part, color) in parts {
        let width = 440.0 * part;
        drawing.rect(Rect::new(left, 200.0, left + width - 1.5, 224.0), color);
        left += width;
    }
    let at = DVec2::new(16.0, 246.0);
    drawing.text(at, 14.0, Anchor::Start, "the texture, and a third of it more", INK);
    finish(drawing)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::gallery::errata::says;
    use crate::gallery::rasterizer::PAGE;
    use scumble::texture::{Footprint, Levels};

    #[test]
    fn a_pyramid_is_a_third_more() {
        let whole = TextureOptions::default();
        let base = TextureOptions { levels: Levels::BaseOnly, ..whole };
        let memory = |o: &TextureOptions| Texture::memory_for(1024, 512, o).unwrap() as f64;
        let ratio = memory(&whole) / memory(&base);
        // And the margins of the levels, which are a larger part of small ones.
        assert!((ratio - 4.0 / 3.0).abs() < 0.05, "{ratio}");
        let texels: usize = (0..10).map(|l| (1024 >> l) * (512 >> l)).sum();
        says(&format!("{:.3} of it", texels as f64 / (1024.0 * 512.0)));
        let words = PAGE.figures.iter().find(|f| f.name == "memory").unwrap().look;
        let megabytes = format!("{:.1} MB at 8 bytes", 8e-6 * texels as f64);
        assert!(words.contains(&megabytes), "{megabytes}");
        assert!(words.contains(&format!("{:.0} MB at 16 bytes", 800.0 * 600.0 * 256.0 / 1e6)));
    }

    #[test]
    fn a_difference_is_a_chord() {
        // A plane: v = 120/y, four pixels below the horizon.
        let map = Homography::new([[1.0, 0.0, 0.0], [0.0, 0.0, 120.0], [0.0, 1.0, 0.0]]);
        let at = DVec2::new(0.5, 4.0);
        let v = |p: DVec2| map.project(p).unwrap().y;
        let chord = v(at + DVec2::new(0.0, 1.0)) - v(at);
        let derivative = Footprint::at(&map, at).jacobian.d;
        says(&format!("{:.1} of the derivative", chord / derivative));
    }
}
