//! The signed distance, the alpha that is made of it, and what that tends to.

use crate::gallery::Drawn;
use crate::gallery::ink::{GREEN, PURPLE, RED, finish};
use crate::gallery::plot::Plot;
use scumble::texture::Footprint;
use scumble::texture::procedural::{Antialias, Grid};
use scumble_geometry::{DVec2, Matrix2, Rect};
use scumble_pixel::Straight;
use scumble_sheet::{Anchor, Drawing, INK};

/// Lines across u alone, as a function of u and the pixel's width.
fn one_family(antialias: Antialias, u: f64, pixel: f64) -> f64 {
    // Half way between lines of the other family, by a pixel that sees none of them.
    let flat = if antialias == Antialias::Integral { 0.0 } else { pixel };
    let f = Footprint { u, v: 1.0, jacobian: Matrix2::new(pixel, 0.0, 0.0, flat) };
    Grid { period: 2.0, width: 0.4, antialias, ..Grid::default() }.coverage(&f)
}

pub(super) fn waves() -> Drawn {
    let mut drawing = Drawing::new(910, 610);
    let entries = [
        (GREEN, "signed distance"),
        (PURPLE, "clamped: clamp(1/2 - distance/pixel)"),
        (RED, "covered, on average over the pixel"),
    ];
    legend(&mut drawing, 50.0, &entries);
    for (index, (pixel, words)) in
        [(0.1, "a pixel 0.1 wide"), (0.5, "0.5 wide"), (3.0, "3 wide")].into_iter().enumerate()
    {
        let top = 62.0 + 184.0 * index as f64;
        let frame = Rect::new(50.0, top, 890.0, top + 140.0);
        let plot = Plot { frame, x: [-1.5, 5.5], y: [-0.3, 1.1] };
        plot.rules(&mut drawing, &[(0.0, "0"), (0.5, "0.5"), (1.0, "1")]);
        let ticks = [(0.0, "line"), (1.0, "1"), (2.0, "line"), (3.0, "3"), (4.0, "line")];
        plot.ticks(&mut drawing, &ticks);
        plot.axes(&mut drawing, words);
        let grid = Grid { period: 2.0, width: 0.4, ..Grid::default() };
        plot.curve(&mut drawing, GREEN, 1.6, |u| grid.distance(u, 1.0));
        plot.curve(&mut drawing, RED, 4.0, |u| one_family(Antialias::Integral, u, pixel));
        plot.curve(&mut drawing, PURPLE, 2.0, |u| one_family(Antialias::Gradient, u, pixel));
    }
    finish(drawing)
}

/// Words in a line, each after a stroke of its colour.
fn legend(drawing: &mut Drawing, mut x: f64, entries: &[(Straight, &str)]) {
    for &(color, words) in entries {
        drawing.line([DVec2::new(x, 19.0), DVec2::new(x + 26.0, 19.0)], 3.0, color);
        drawing.text(DVec2::new(x + 34.0, 24.0), 14.0, Anchor::Start, words, INK);
        x += 60.0 + scumble_sheet::text_width(words, 14.0);
    }
}

/// The mean alpha of a grid of lines 2 apart and 0.05 wide, for a square pixel of this width.
fn mean(antialias: Antialias, pixel: f64) -> f64 {
    const STEPS: u32 = 160;
    let grid = Grid { period: 2.0, width: 0.05, antialias, ..Grid::default() };
    let jacobian = Matrix2::new(pixel, 0.0, 0.0, pixel);
    let at = |k: u32| 2.0 * (f64::from(k) + 0.5) / f64::from(STEPS);
    let row = |v: f64| {
        let one = |k: u32| grid.coverage(&Footprint { u: at(k), v, jacobian });
        (0..STEPS).map(one).sum::<f64>()
    };
    (0..STEPS).map(|k| row(at(k))).sum::<f64>() / f64::from(STEPS * STEPS)
}

pub(super) fn means() -> Drawn {
    const OCTAVES: [i32; 2] = [-6, 8];
    let mut drawing = Drawing::new(910, 300);
    let entries = [(PURPLE, "clamped distance"), (RED, "integral over the pixel")];
    legend(&mut drawing, 60.0, &entries);
    let frame = Rect::new(60.0, 46.0, 820.0, 256.0);
    let plot = Plot { frame, x: OCTAVES.map(f64::from), y: [0.0, 0.55] };
    plot.rules(&mut drawing, &[(0.0, "0"), (0.1, "0.1"), (0.3, "0.3"), (0.5, "0.5")]);
    let ticks = ["1/64", "1/16", "1/4", "1", "4", "16", "64", "256"];
    let ticks: Vec<(f64, &str)> = (-3..=4).map(|k| 2.0 * f64::from(k)).zip(ticks).collect();
    plot.ticks(&mut drawing, &ticks);
    plot.axes(&mut drawing, "");
    // Four points an octave.
    let step = 2.0_f64.sqrt().sqrt();
    for (antialias, color) in [(Antialias::Gradient, PURPLE), (Antialias::Integral, RED)] {
        let mut pixel = 1.0 / 64.0;
        let mut points = Vec::new();
        for k in 4 * OCTAVES[0]..=4 * OCTAVES[1] {
            points.push(plot.place(f64::from(k) / 4.0, mean(antialias, pixel)));
            pixel *= step;
        }
        drawing.line(points, 2.2, color);
        let words = format!("{:.3}", mean(antialias, 100.0));
        let at = plot.place(f64::from(OCTAVES[1]), mean(antialias, 256.0));
        drawing.text(at + DVec2::new(8.0, 5.0), 14.0, Anchor::Start, &words, INK);
    }
    let below = DVec2::new(440.0, 294.0);
    drawing.text(below, 14.0, Anchor::Middle, "width of a pixel", INK);
    finish(drawing)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::gallery::errata::says;

    #[test]
    fn the_clamped_distance_tends_to_one_half() {
        let (clamped, covered) =
            (mean(Antialias::Gradient, 100.0), mean(Antialias::Integral, 100.0));
        says(&format!(
            "{clamped:.3} on average at a pixel of 100 units, where the lines cover {covered:.3}"
        ));
        assert!((covered - (1.0 - 0.975 * 0.975)).abs() < 1e-4, "{covered}");
        // And the integral over a whole period does not depend on the distance.
        assert!((mean(Antialias::Integral, 0.01) - covered).abs() < 1e-3);
    }
}
