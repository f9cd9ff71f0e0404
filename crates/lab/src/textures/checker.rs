use crate::canvas::{Canvas, Rgb, hex, mix};

/// Eight by eight squares, dark slate and ivory, with a hairline of red along the top row and of
/// blue down the left column, so that a turned or mirrored texture shows.
pub(crate) fn draw() -> Canvas {
    Canvas::paint(512, 512, 1, |x, y| {
        let (i, j) = ((x / 64.0).floor() as i64, (y / 64.0).floor() as i64);
        let base = if (i + j) % 2 == 0 { hex(0xf4efe2) } else { hex(0x2b3440) };
        match (j, i) {
            (0, _) if (26.0..38.0).contains(&y) => hex(0xc8402f),
            (_, 0) if (26.0..38.0).contains(&x) => hex(0x2f6fc8),
            _ => base,
        }
    })
}

/// One floor tile of two dark and two light squares with thin joints: repeats without a seam.
pub(crate) fn draw_tile() -> Canvas {
    Canvas::paint(128, 128, 2, |x, y| {
        let light = (x < 64.0) == (y < 64.0);
        let (u, v) = (x % 64.0, y % 64.0);
        let edge = u.min(64.0 - u).min(v.min(64.0 - v));
        if edge < 1.5 {
            return hex(0x8a8172);
        }
        let base = if light { hex(0xe9dfc9) } else { hex(0x6a2f2a) };
        mix(base, [1.0; 3], 0.10 * (1.0 - u / 64.0) * (1.0 - v / 64.0))
    })
}

/// A 32×32 sailing boat.
pub(crate) fn draw_emblem() -> Canvas {
    Canvas::paint(32, 32, 4, boat)
}

fn boat(x: f64, y: f64) -> Rgb {
    let hull = (22.0..27.0).contains(&y) && x > 5.0 + (y - 22.0) && x < 27.0 - (y - 22.0);
    let main = y < 20.5 && y > 4.0 && x > 16.5 && (x - 16.5) < (y - 4.0) * 0.6;
    let jib = y < 20.5 && y > 7.0 && x < 14.5 && (14.5 - x) < (y - 7.0) * 0.55;
    let mast = (15.0..16.0).contains(&x) && (3.0..22.0).contains(&y);
    let sun = (x - 25.0) * (x - 25.0) + (y - 7.0) * (y - 7.0) < 9.0;
    if hull {
        hex(0x7a3b22)
    } else if mast {
        hex(0x40301f)
    } else if main {
        hex(0xffffff)
    } else if jib {
        hex(0xe5533d)
    } else if sun {
        hex(0xffc93c)
    } else if y > 25.0 {
        hex(0x1f6f9f)
    } else {
        hex(0x9fd3ea)
    }
}
