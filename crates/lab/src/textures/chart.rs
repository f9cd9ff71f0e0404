use super::font::inked;
use crate::canvas::{Canvas, Rgb, hex};
use crate::math::{cos, fract, turns};
use std::f64::consts::PI;

const INK: u32 = 0x15181c;
const PAPER: u32 = 0xfbfaf6;
const BARS: [u32; 8] =
    [0xffffff, 0xf2e205, 0x12c8d8, 0x2fb344, 0xc936c0, 0xd9342b, 0x2b4fd9, 0x101010];

/// A resolution chart of 512×512: zone plate, Siemens star, line pairs of falling width, text in
/// four sizes, colour bars and grey steps.
pub(crate) fn draw() -> Canvas {
    Canvas::paint(512, 512, 3, chart)
}

fn chart(x: f64, y: f64) -> Rgb {
    let frame = x.min(y).min(512.0 - x).min(512.0 - y);
    if frame < 8.0 {
        return hex(if frame < 4.0 { INK } else { PAPER });
    }
    if let Some(c) = zone_plate(x - 140.0, y - 140.0).or_else(|| star(x - 388.0, y - 124.0)) {
        return c;
    }
    if (16.0..496.0).contains(&x) {
        if (424.0..460.0).contains(&y) {
            return hex(BARS[((x - 16.0) / 60.0) as usize]);
        }
        if (464.0..496.0).contains(&y) {
            return [((x - 16.0) / 30.0).floor() / 15.0; 3];
        }
    }
    if (284.0..414.0).contains(&y) {
        return if x < 248.0 {
            line_pairs(x - 20.0, y - 284.0)
        } else {
            text(x - 256.0, y - 284.0)
        };
    }
    if (252.0..276.0).contains(&y) && letters("SCUMBLE TEST CHART", x - 204.0, y - 253.0, 2.5) {
        return hex(INK);
    }
    hex(PAPER)
}

/// cos(k·r²), from one period across the middle to two pixels a period at the rim.
fn zone_plate(x: f64, y: f64) -> Option<Rgb> {
    const RADIUS: f64 = 120.0;
    let r2 = x * x + y * y;
    (r2 < RADIUS * RADIUS).then(|| [0.5 + 0.5 * cos(PI * r2 / (2.0 * RADIUS)); 3])
}

/// Thirty-six spokes about a bull's eye.
fn star(x: f64, y: f64) -> Option<Rgb> {
    let r2 = x * x + y * y;
    if r2 >= 100.0 * 100.0 {
        return None;
    }
    let dark = if r2 < 36.0 { r2 < 9.0 } else { fract(turns(x, y) * 36.0) < 0.5 };
    Some(hex(if dark { INK } else { PAPER }))
}

/// Blocks of upright and level bars, each three quarters as wide as the last.
fn line_pairs(x: f64, y: f64) -> Rgb {
    let mut left = 0.0;
    let mut bar = 6.0;
    while bar > 0.9 {
        let width = bar * 5.0;
        if x >= left && x < left + width {
            let along = if y < 56.0 { x - left } else { y - 64.0 };
            let inside = y < 56.0 || (y >= 64.0 && y < 64.0 + width);
            let dark = inside && ((along / bar).floor() as i64) % 2 == 0;
            return hex(if dark { INK } else { PAPER });
        }
        left += width + 8.0;
        bar *= 0.75;
    }
    hex(PAPER)
}

/// Lines of text, each in a smaller face than the last.
fn text(x: f64, y: f64) -> Rgb {
    const LINES: [(&str, f64, f64); 6] = [
        ("COVERAGE", 4.0, 0.0),
        ("TEXTURE FILTER", 2.6, 34.0),
        ("A PIXEL SEES AN AREA", 1.8, 58.0),
        ("NOT A POINT. EVERY SAMPLE", 1.5, 76.0),
        ("BELONGS TO EXACTLY ONE TRIANGLE", 1.2, 92.0),
        ("THE SAME BYTES ON EVERY MACHINE", 1.0, 106.0),
    ];
    let dark = LINES.iter().any(|&(line, size, top)| letters(line, x, y - top, size));
    hex(if dark { INK } else { PAPER })
}

/// Whether (x, y) is on the ink of a line of text whose pixels are `size` wide.
fn letters(line: &str, x: f64, y: f64, size: f64) -> bool {
    if x < 0.0 || y < 0.0 {
        return false;
    }
    let (column, row) = ((x / size) as usize, (y / size) as usize);
    line.chars().nth(column / 6).is_some_and(|c| inked(c, column % 6, row))
}
