//! A picture, the difference enlarged, and the other picture, side by side.

use super::measure::{Comparison, Seen};
use crate::error::Failure;
use crate::interrupt::Interrupt;
use crate::output::Target;
use crate::picture::{Channels, Depth, Form, Format, Tone, Writer, on_checkerboard};
use crate::progress::Steps;
use scumble::pixel::unorm8;

/// Columns between the three.
const GAP: usize = 8;

/// Their colour.
const BETWEEN: u8 = 48;

/// Differences are enlarged so that the largest is white, and at most so much.
const MOST: f64 = 64.0;

/// Writes it as a PNG; a row is a step.
pub(super) fn write(
    seen: &Seen<'_>,
    comparison: &Comparison,
    target: &Target,
    interrupt: &Interrupt,
    steps: &Steps,
) -> Result<(), Failure> {
    let (width, height) = (seen.width(), seen.height());
    let side = |n: usize| u32::try_from(n).unwrap_or(u32::MAX);
    let form = Form {
        width: side(3 * width + 2 * GAP),
        height: side(height),
        channels: Channels::Rgb,
        depth: Depth::Eight,
        format: Format::Png,
        icc: None,
    };
    let mut writer = Writer::open(target, interrupt, form)?;
    let gain = gain(comparison.largest);
    let mut row = Vec::new();
    for y in 0..height {
        row.clear();
        let places = |x: usize| (x, y, y * width + x);
        (0..width).for_each(|x| row.extend(shown(seen, 0, places(x))));
        row.extend([BETWEEN; 3 * GAP]);
        (0..width).for_each(|x| row.extend(enlarged(seen, y * width + x, gain)));
        row.extend([BETWEEN; 3 * GAP]);
        (0..width).for_each(|x| row.extend(shown(seen, 1, places(x))));
        writer.rows8(&row)?;
        steps.add(1);
    }
    writer.finish()?;
    writer.commit()
}

/// What differences are multiplied by.
fn gain(largest: f64) -> f64 {
    if largest > 0.0 { (255.0 / largest).clamp(1.0, MOST) } else { 1.0 }
}

/// A pixel of one picture, in sRGB, on the checkerboard.
fn shown(seen: &Seen<'_>, which: usize, (x, y, i): (usize, usize, usize)) -> [u8; 3] {
    let [r, g, b, alpha] = seen.pixel(which, i);
    // Light would be dark to look at.
    let light = !seen.is_converted() && seen.pictures[which].tone == Tone::Linear;
    let color = [r, g, b].map(|v| if light { Tone::Srgb.encode(0, v) } else { v });
    on_checkerboard(color, alpha, x, y)
}

/// How a pixel differs, channel by channel; where alpha does, all do.
fn enlarged(seen: &Seen<'_>, i: usize, gain: f64) -> [u8; 3] {
    let [a, b] = [seen.pixel(0, i), seen.pixel(1, i)];
    let difference = |c: usize| {
        let d = (f64::from(a[c]) - f64::from(b[c])).abs();
        if d.is_nan() { 1.0 } else { d }
    };
    let alpha = difference(3);
    [0, 1, 2].map(|c| unorm8((difference(c).max(alpha) * gain) as f32))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_largest_is_white_and_noise_stays_dim() {
        assert_eq!(gain(51.0), 5.0);
        assert_eq!((gain(1.0), gain(0.0), gain(1000.0)), (64.0, 1.0, 1.0));
    }
}
