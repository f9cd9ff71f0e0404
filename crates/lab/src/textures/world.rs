use super::world_outlines::{INLAND_SEAS, LAND, Outline};
use crate::canvas::{Canvas, Rgb, hex, mix, shade};
use crate::math::{octaves, smoothstep};

/// A map of the world, 1024×512, plate carrée: 180° W to 180° E, 90° N to 90° S, with the
/// graticule every 15 degrees.
pub(crate) fn draw() -> Canvas {
    let land = boxed(LAND);
    let seas = boxed(INLAND_SEAS);
    Canvas::paint(1024, 512, 2, |x, y| {
        let (longitude, latitude) = (x * 360.0 / 1024.0 - 180.0, 90.0 - y * 180.0 / 512.0);
        let (lon, lat) = bend(longitude, latitude);
        let is_land = inside_any(&land, lon, lat) && !inside_any(&seas, lon, lat);
        let base = if is_land { ground(longitude, latitude) } else { sea(longitude, latitude) };
        let c = mix(base, hex(0x16324a), graticule(longitude, latitude));
        let frame = x.min(y).min(1024.0 - x).min(512.0 - y);
        if frame < 3.0 { hex(0x1c2630) } else { c }
    })
}

/// An outline with its west, south, east and north ends.
type Boxed = ([f64; 4], Outline);

fn boxed(outlines: &'static [Outline]) -> Vec<Boxed> {
    let bounds = |outline: Outline| {
        let mut b = [f64::MAX, f64::MAX, f64::MIN, f64::MIN];
        for &(x, y) in outline {
            b = [b[0].min(x), b[1].min(y), b[2].max(x), b[3].max(y)];
        }
        b
    };
    outlines.iter().map(|&o| (bounds(o), o)).collect()
}

/// Noise over the map that meets itself at the date line.
fn relief(longitude: f64, latitude: f64, cells: i64, count: u32, seed: u32) -> f64 {
    let scale = cells as f64 / 360.0;
    octaves((longitude + 180.0) * scale, (latitude + 90.0) * scale, cells, count, 0.55, seed)
}

/// Moves a point by up to a few degrees: the straight edges of an outline become a coast.
fn bend(longitude: f64, latitude: f64) -> (f64, f64) {
    let east = relief(longitude, latitude, 72, 4, 3) - 0.5;
    let north = relief(longitude, latitude, 72, 4, 19) - 0.5;
    (longitude + 7.0 * east, latitude + 5.0 * north)
}

fn inside_any(outlines: &[Boxed], x: f64, y: f64) -> bool {
    outlines.iter().any(|(b, outline)| {
        x >= b[0] && x <= b[2] && y >= b[1] && y <= b[3] && inside(outline, x, y)
    })
}

fn inside(outline: Outline, x: f64, y: f64) -> bool {
    let next = outline.iter().cycle().skip(1);
    let crossings = outline.iter().zip(next).filter(|&(&(ax, ay), &(bx, by))| {
        (ay > y) != (by > y) && x < ax + (bx - ax) * (y - ay) / (by - ay)
    });
    crossings.count() % 2 == 1
}

/// Land by climate: ice, tundra, forest, desert, savanna, rain forest, with a little relief.
fn ground(longitude: f64, latitude: f64) -> Rgb {
    let height = relief(longitude, latitude, 24, 3, 31);
    let moved = latitude.abs() + 16.0 * (height - 0.5);
    let bands: [(f64, u32); 7] = [
        (9.0, 0x3f7f46),
        (17.0, 0x9aa653),
        (31.0, 0xdcc07c),
        (41.0, 0xa9b061),
        (56.0, 0x5f8f55),
        (67.0, 0x9fae93),
        (f64::MAX, 0xf3f5f4),
    ];
    let tone = bands.iter().find(|b| moved < b.0).map_or(0xf3f5f4, |b| b.1);
    let lit = 0.92 + ((height - 0.5) * 6.0).floor() * 0.05;
    shade(hex(tone), lit)
}

fn sea(longitude: f64, latitude: f64) -> Rgb {
    let depth = (relief(longitude, latitude, 12, 2, 57) * 7.0).floor() / 7.0;
    mix(hex(0x8cc0dc), hex(0x5b9cc6), smoothstep(0.2, 0.8, depth))
}

/// How much ink of the 15-degree lines a point carries; the equator and Greenwich are heavier.
fn graticule(longitude: f64, latitude: f64) -> f64 {
    let line = |degrees: f64, width: f64| {
        let nearest = (degrees / 15.0 + 0.5).floor() * 15.0;
        let width = if nearest == 0.0 { width * 2.0 } else { width };
        (degrees - nearest).abs() < width
    };
    if line(longitude, 0.2) || line(latitude, 0.2) { 0.45 } else { 0.0 }
}
