use crate::canvas::{Canvas, Rgb, hex, mix, shade};
use crate::math::{octaves, random, smoothstep};

/// Courses of bricks in running bond, 4 across and 8 down, that repeat without a seam.
pub(crate) fn draw() -> Canvas {
    Canvas::paint(256, 256, 2, brick)
}

fn brick(x: f64, y: f64) -> Rgb {
    const WIDTH: f64 = 64.0;
    const HEIGHT: f64 = 32.0;
    let row = (y / HEIGHT).floor();
    let shifted = (x + if row as i64 % 2 == 0 { 0.0 } else { WIDTH / 2.0 }) % 256.0;
    let column = (shifted / WIDTH).floor();
    let (u, v) = (shifted - column * WIDTH, y - row * HEIGHT);

    let grain = octaves(x / 16.0, y / 16.0, 16, 3, 0.6, 11);
    let wobble = 1.6 * octaves(x / 32.0, y / 32.0, 8, 2, 0.5, 23);
    let edge = u.min(WIDTH - u).min(v.min(HEIGHT - v)) - wobble;
    let inside = smoothstep(1.0, 2.6, edge);

    let tone = random(column as i64, row as i64, 5);
    let clay = mix(hex(0x8e3f2b), hex(0xc0694a), tone);
    let lit =
        0.86 + 0.22 * grain + 0.06 * smoothstep(5.0, 1.0, v) - 0.08 * smoothstep(26.0, 31.0, v);
    let mortar = shade(hex(0xc9c0ae), 0.85 + 0.25 * grain);
    quantise(mix(mortar, shade(clay, lit), inside))
}

/// 32 steps a channel: invisible, and a third of the file.
fn quantise(c: Rgb) -> Rgb {
    c.map(|v| (v * 31.0 + 0.5).floor() / 31.0)
}
