use crate::canvas::{Canvas, Rgb, hex, mix, shade};
use crate::math::{lerp, noise, octaves, sin, smoothstep, turns};

/// A drawn head, 384×512: broad smooth tones in the face against the finest strands in the hair,
/// which is what a filter has to tell apart.
pub(crate) fn draw() -> Canvas {
    Canvas::paint(384, 512, 3, |x, y| {
        let layers = [background, back_hair, shoulders, neck, face, features, fringe];
        layers.iter().fold([0.0; 3], |below, layer| layer(x, y, below))
    })
}

/// Distance from the rim of an ellipse as a fraction of its radius: −1 at the centre, 0 on it.
fn ellipse(x: f64, y: f64, cx: f64, cy: f64, rx: f64, ry: f64) -> f64 {
    let (dx, dy) = ((x - cx) / rx, (y - cy) / ry);
    (dx * dx + dy * dy).sqrt() - 1.0
}

fn background(x: f64, y: f64, _: Rgb) -> Rgb {
    let glow = smoothstep(1.4, -1.0, ellipse(x, y, 120.0, 150.0, 260.0, 330.0));
    let grain = 0.03 * (octaves(x / 48.0, y / 48.0, 64, 3, 0.5, 3) - 0.5);
    mix(hex(0x24424a), hex(0x7fa79a), glow + grain)
}

/// Strands that follow a field: `along` runs down the hair, `across` counts the strands.
fn strands(across: f64, along: f64) -> Rgb {
    let wave = 0.35 * sin(along * 5.0 + across * 0.15);
    let fine = noise(across * 1.9 + wave, along * 3.0, 4096, 71);
    let coarse = noise(across * 0.35 + wave, along * 1.5, 4096, 72);
    let shine = smoothstep(0.55, 0.95, coarse) * smoothstep(0.1, 0.5, along);
    let tone = mix(hex(0x2a1410), hex(0x8c4a22), 0.25 * fine + 0.75 * coarse * fine);
    mix(tone, hex(0xe2a95e), shine * fine * 0.85)
}

fn back_hair(x: f64, y: f64, below: Rgb) -> Rgb {
    let flare = lerp(128.0, 150.0, smoothstep(200.0, 420.0, y));
    let ripple = 5.0 * sin(y * 0.07) + 3.0 * sin(y * 0.19 + x * 0.02);
    let cap = ellipse(x, y, 192.0, 190.0, flare, 150.0) < 0.0;
    let fall = y > 190.0 && y < 455.0 + ripple * 2.0 && (x - 192.0).abs() < flare + ripple;
    if !(cap || fall) {
        return below;
    }
    let across = (x - 192.0) / (flare / 128.0) * 0.55 + ripple * 0.35;
    shade(strands(across + 300.0, y / 130.0), 0.8)
}

fn shoulders(x: f64, y: f64, below: Rgb) -> Rgb {
    if ellipse(x, y, 192.0, 540.0, 176.0, 118.0) > 0.0 {
        return below;
    }
    let weave = 0.10 * sin(x * 0.9) * sin(y * 0.9);
    let fold = 0.12 * sin((x - 192.0) * 0.05 + y * 0.02);
    let collar = ellipse(x, y, 192.0, 418.0, 64.0, 46.0);
    let cloth = shade(hex(0x2f4d86), 1.0 + weave + fold);
    if (0.0..0.12).contains(&collar) { shade(hex(0xf0e6d0), 1.0 + weave) } else { cloth }
}

const SKIN: u32 = 0xe9b791;
const SKIN_SHADE: u32 = 0xa8684a;

fn neck(x: f64, y: f64, below: Rgb) -> Rgb {
    let half = 38.0 + 26.0 * smoothstep(350.0, 418.0, y);
    let throat = (320.0..=418.0).contains(&y) && (x - 192.0).abs() < half;
    let chest = y > 418.0 && ellipse(x, y, 192.0, 418.0, 64.0, 46.0) < 0.0;
    if !(throat || chest) {
        return below;
    }
    let shadow = smoothstep(400.0, 335.0, y) * 0.7 + smoothstep(0.0, 60.0, x - 192.0) * 0.35;
    mix(hex(SKIN), hex(SKIN_SHADE), shadow)
}

fn face(x: f64, y: f64, below: Rgb) -> Rgb {
    // Narrower below the cheekbones.
    let jaw = 1.0 - 0.24 * smoothstep(240.0, 370.0, y);
    if ellipse(x, y, 192.0, 240.0, 92.0 * jaw, 128.0) > 0.0 {
        return below;
    }
    let side = smoothstep(-30.0, 90.0, x - 192.0) * 0.45;
    let rim = smoothstep(-0.35, 0.0, ellipse(x, y, 186.0, 236.0, 92.0 * jaw, 128.0)) * 0.45;
    let brow = smoothstep(170.0, 120.0, y) * 0.35;
    let skin = mix(hex(SKIN), hex(SKIN_SHADE), (side + rim + brow).min(1.0));
    let blush = smoothstep(0.0, -1.0, ellipse(x, y, 146.0, 284.0, 34.0, 22.0))
        + smoothstep(0.0, -1.0, ellipse(x, y, 238.0, 284.0, 30.0, 22.0));
    mix(skin, hex(0xd9735c), 0.35 * blush)
}

fn features(x: f64, y: f64, below: Rgb) -> Rgb {
    let mirrored = 192.0 - (x - 192.0).abs();
    mouth(x, y, nose(x, y, eye(mirrored, x, y, below)))
}

/// One eye and brow, drawn on the left half; `x` breaks the mirror where the light falls.
fn eye(mirrored: f64, x: f64, y: f64, below: Rgb) -> Rgb {
    let brow = y - (206.0 + 0.004 * (mirrored - 150.0) * (mirrored - 150.0) * 2.0);
    if brow.abs() < 5.0 - 0.05 * (mirrored - 152.0).abs() && (126.0..180.0).contains(&mirrored) {
        return shade(strands(mirrored * 1.2 + brow, 0.4), 0.8);
    }
    let dx = (mirrored - 153.0) / 23.0;
    let lid = 11.5 * (1.0 - dx * dx);
    let dy = y - 235.0;
    if dx.abs() >= 1.0 || dy > lid * 0.8 || dy < -lid - 3.0 {
        return below;
    }
    if dy < -lid + 0.5 {
        return hex(0x2a1714);
    }
    let (ix, iy) = (mirrored - 153.0, dy + 1.0);
    let r = (ix * ix + iy * iy).sqrt();
    let glint = (x - (if x < 192.0 { 149.0 } else { 227.0 })).abs() < 2.6 && (dy + 5.0).abs() < 2.6;
    if r < 9.5 && glint {
        return [1.0; 3];
    }
    if r < 4.4 {
        return hex(0x0d0d10);
    }
    if r < 9.5 {
        let spokes = noise(turns(ix, iy) * 40.0, 0.5, 40, 8);
        return mix(hex(0x2d5a4f), hex(0x79b58d), spokes * smoothstep(9.5, 5.0, r));
    }
    mix(hex(0xf6f2ea), hex(0xb9a59a), smoothstep(2.0, -10.0, dy) * 0.8)
}

fn nose(x: f64, y: f64, below: Rgb) -> Rgb {
    let ridge = smoothstep(9.0, 0.0, (x - 203.0).abs())
        * smoothstep(225.0, 285.0, y)
        * smoothstep(300.0, 285.0, y);
    let tip = smoothstep(0.0, -1.0, ellipse(x, y, 190.0, 284.0, 13.0, 11.0));
    let nostril = ellipse((x - 192.0).abs(), y, 10.5, 294.0, 5.5, 2.8) < 0.0;
    let lit = mix(mix(below, hex(SKIN_SHADE), 0.55 * ridge), hex(0xf7d3b4), 0.6 * tip);
    if nostril { hex(0x6b3626) } else { lit }
}

fn mouth(x: f64, y: f64, below: Rgb) -> Rgb {
    let dx = (x - 192.0) / 34.0;
    if dx.abs() >= 1.0 {
        return below;
    }
    let line = 323.0 - 3.0 * dx * dx;
    let upper = line - 8.0 * (1.0 - dx * dx) * (1.0 - 0.35 * smoothstep(0.22, 0.0, dx.abs()));
    let lower = line + 12.0 * (1.0 - dx * dx);
    if y < upper || y > lower {
        return below;
    }
    if (y - line).abs() < 1.1 {
        return hex(0x5d1f1f);
    }
    let lip = if y < line { hex(0xa9443f) } else { hex(0xc65a52) };
    mix(lip, hex(0xf2b3a4), 0.6 * smoothstep(0.0, -1.0, ellipse(x, y, 184.0, 330.0, 13.0, 3.5)))
}

/// The hair before the forehead, parted at the left and swept to both sides.
fn fringe(x: f64, y: f64, below: Rgb) -> Rgb {
    let (px, py) = (x - 168.0, y - 66.0);
    let part = if px < 0.0 { -px } else { px * 0.72 };
    let hairline = 116.0 + 0.0135 * part * part - 12.0 * smoothstep(26.0, 0.0, part);
    let edge = 6.0 * noise(part * 0.4, 0.0, 4096, 5);
    if ellipse(x, y, 192.0, 190.0, 129.0, 150.0) > 0.0 || y > hairline + edge {
        return below;
    }
    // Strands leave the parting and bend down with the distance from it.
    let side = if px < 0.0 { 900.0 } else { 500.0 };
    strands((py * 0.9 - 0.0085 * part * part + side) * 0.8, part / 90.0 + y / 300.0)
}
