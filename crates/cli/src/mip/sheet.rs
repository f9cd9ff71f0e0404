//! All levels on one page: the largest on the left, the others under one another on the right.

use super::levels::{Level, Plan};
use crate::error::Failure;
use crate::interrupt::Interrupt;
use crate::output::Target;
use crate::picture::{Channels, Depth, Form, Format, Tone, Writer, on_checkerboard};

/// Pixels around and between the levels.
const GAP: usize = 8;

/// The page's colour.
const PAGE: u8 = 48;

/// Levels with a longer side than this are left out, unless they are the last.
const LONGEST: u32 = 1024;

/// A level and its place on the page.
struct Placed<'a> {
    level: &'a Level,
    x: usize,
    y: usize,
}

/// Writes the page as a PNG.
pub(super) fn write(
    levels: &[Level],
    plan: &Plan,
    target: &Target,
    interrupt: &Interrupt,
) -> Result<(), Failure> {
    let (placed, width, height) = place(levels);
    let form = Form {
        width: width as u32,
        height: height as u32,
        channels: Channels::Rgb,
        depth: Depth::Eight,
        format: Format::Png,
        icc: None,
    };
    let mut writer = Writer::open(target, interrupt, form)?;
    for y in 0..height {
        let mut row = vec![[PAGE; 3]; width];
        for placed in &placed {
            let Some(v) = y.checked_sub(placed.y).filter(|v| *v < placed.level.height as usize)
            else {
                continue;
            };
            for (u, pixel) in row[placed.x..][..placed.level.width as usize].iter_mut().enumerate()
            {
                *pixel = shown(placed.level, plan, u, v);
            }
        }
        writer.rows8(row.as_flattened())?;
    }
    writer.finish()?;
    writer.commit()
}

/// The places of the levels, and the size of the page.
fn place(levels: &[Level]) -> (Vec<Placed<'_>>, usize, usize) {
    let small = |l: &Level| l.width.max(l.height) <= LONGEST;
    let first = levels.iter().position(small).unwrap_or(levels.len().saturating_sub(1));
    let mut placed = Vec::new();
    let (mut width, mut height) = (0, 0);
    let (mut x, mut y) = (GAP, GAP);
    for level in levels.iter().skip(first) {
        placed.push(Placed { level, x, y });
        width = width.max(x + level.width as usize + GAP);
        height = height.max(y + level.height as usize + GAP);
        if placed.len() == 1 {
            x += level.width as usize + GAP;
        } else {
            y += level.height as usize + GAP;
        }
    }
    (placed, width, height)
}

/// A texel as a person sees it.
fn shown(level: &Level, plan: &Plan, x: usize, y: usize) -> [u8; 3] {
    let n = plan.channels.count();
    let i = (y * level.width as usize + x) * n;
    let at = |c: usize| level.pixels.at(i + c);
    let color = if plan.channels.is_gray() { [at(0); 3] } else { [at(0), at(1), at(2)] };
    let alpha = if plan.channels.has_alpha() && !plan.is_data() { at(n - 1) } else { 1.0 };
    let divisor = if plan.premultiplied && alpha > 0.0 { alpha } else { 1.0 };
    let color = color.map(|v| {
        let v = v / divisor;
        alpha * if plan.written == Tone::Linear { Tone::Srgb.encode(0, v) } else { v }
    });
    on_checkerboard(color, alpha, x, y)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::picture::Pixels;

    fn level(width: u32, height: u32) -> Level {
        Level::bare(width, height, Pixels::U8(Vec::new()))
    }

    #[test]
    fn levels_do_not_overlap_and_fit_the_page() {
        for sizes in
            [&[(300, 200), (150, 100), (75, 50), (1, 1)][..], &[(1, 1)], &[(1, 900), (1, 450)]]
        {
            let levels: Vec<Level> = sizes.iter().map(|&(w, h)| level(w, h)).collect();
            let (placed, width, height) = place(&levels);
            let boxes: Vec<_> = placed
                .iter()
                .map(|p| (p.x, p.y, p.x + p.level.width as usize, p.y + p.level.height as usize))
                .collect();
            for (i, a) in boxes.iter().enumerate() {
                assert!(a.2 + GAP <= width && a.3 + GAP <= height);
                let apart = |b: &(usize, usize, usize, usize)| {
                    a.2 <= b.0 || b.2 <= a.0 || a.3 <= b.1 || b.3 <= a.1
                };
                assert!(boxes.iter().skip(i + 1).all(apart));
            }
        }
    }

    #[test]
    fn large_levels_are_left_out() {
        let levels = [level(4096, 10), level(2048, 5), level(1024, 2), level(512, 1)];
        assert_eq!(place(&levels).0.len(), 2);
        assert_eq!(place(&levels[..2]).0.len(), 1);
    }
}
