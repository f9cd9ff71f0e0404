//! Functions of one variable, sampled and brought back.

use crate::gallery::Drawn;
use crate::gallery::ink::{BLUE, GREEN, GREY, RED, finish};
use crate::gallery::plot::Plot;
use crate::math::{cos, log10, sin};
use scumble_geometry::{DVec2, Rect};
use scumble_sheet::{Anchor, Drawing, INK};
use std::f64::consts::{PI, TAU};

fn hills(x: f64) -> f64 {
    0.52 + 0.26 * sin(TAU * 1.2 * x + 0.4) + 0.15 * sin(TAU * 4.1 * x + 1.1)
}

/// The values at `n` places from 0 to 1, joined by lines.
fn lines(n: u32, x: f64) -> f64 {
    let place = x * f64::from(n - 1);
    let left = place.floor().min(f64::from(n - 2));
    let at = |i: f64| hills(i / f64::from(n - 1));
    at(left) + (at(left + 1.0) - at(left)) * (place - left)
}

pub(super) fn samples() -> Drawn {
    let mut drawing = Drawing::new(900, 430);
    let nearest = |x: f64| hills((x * 4.0 + 0.5).floor() / 4.0);
    type Way = (&'static str, u32, Option<fn(u32, f64) -> f64>);
    let panels: [Way; 6] = [
        ("five samples", 5, None),
        ("the nearest sample", 5, None),
        ("lines", 5, Some(lines)),
        ("lines, 5 samples", 5, Some(lines)),
        ("9 samples", 9, Some(lines)),
        ("17 samples", 17, Some(lines)),
    ];
    for (index, (title, n, way)) in panels.into_iter().enumerate() {
        let (left, top) = (24.0 + 296.0 * (index % 3) as f64, 34.0 + 206.0 * (index / 3) as f64);
        let frame = Rect::new(left, top, left + 264.0, top + 164.0);
        let plot = Plot { frame, x: [-0.02, 1.02], y: [0.0, 1.0] };
        plot.axes(&mut drawing, title);
        plot.curve(&mut drawing, GREY, 1.6, hills);
        let inner = Plot { frame, x: [-0.02, 1.02], y: [0.0, 1.0] };
        match way {
            Some(f) => inner.curve(&mut drawing, BLUE, 2.0, |x| f(n, x.clamp(0.0, 1.0))),
            None if index == 1 => inner.curve(&mut drawing, BLUE, 2.0, nearest),
            None => {}
        }
        let points: Vec<(f64, f64)> =
            (0..n).map(|i| f64::from(i) / f64::from(n - 1)).map(|x| (x, hills(x))).collect();
        plot.dots(&mut drawing, RED, &points);
    }
    finish(drawing)
}

pub(super) fn aliases() -> Drawn {
    let mut drawing = Drawing::new(900, 5 * 110 + 20);
    let rows = [(0.05_f64, "0.05"), (0.25, "0.25"), (0.45, "0.45"), (0.7, "0.70"), (0.95, "0.95")];
    for (index, (f, label)) in rows.into_iter().enumerate() {
        let top = 26.0 + 110.0 * index as f64;
        let plot = Plot {
            frame: Rect::new(20.0, top, 880.0, top + 72.0),
            x: [0.0, 40.0],
            y: [-1.15, 1.15],
        };
        // Both meet the wave at whole numbers.
        let slow = f.min(1.0 - f);
        let title = if slow == f {
            format!("{label} cycles a sample")
        } else {
            format!("{label} cycles a sample, which looks like {slow:.2}")
        };
        plot.axes(&mut drawing, &title);
        plot.curve(&mut drawing, GREY, 1.4, |x| cos(TAU * f * x));
        if slow != f {
            plot.curve(&mut drawing, BLUE, 2.0, |x| cos(TAU * slow * x));
        }
        let points: Vec<(f64, f64)> =
            (0..=40).map(f64::from).map(|x| (x, cos(TAU * f * x))).collect();
        plot.dots(&mut drawing, RED, &points);
    }
    finish(drawing)
}

/// Waves of one to four cycles on 0…1, of which the fastest is a sine alone.
fn music(x: f64) -> f64 {
    0.5 * cos(TAU * x + 0.3)
        + 0.4 * cos(TAU * 2.0 * x + 1.7)
        + 0.35 * cos(TAU * 3.0 * x + 4.0)
        + 0.3 * sin(TAU * 4.0 * x)
}

/// sinc over the endless repetition of `n` samples on 0…1 (Dirichlet's kernel).
fn sinc(n: u32, x: f64) -> f64 {
    let n = f64::from(n);
    let odd = n % 2.0 == 1.0;
    let kernel = |t: f64| {
        let below = sin(PI * t / n);
        if below.abs() < 1e-9 {
            return 1.0;
        }
        let ratio = sin(PI * t) / (n * below);
        if odd { ratio } else { ratio * cos(PI * t / n) }
    };
    let mut sum = 0.0;
    let mut i = 0.0;
    while i < n {
        sum += music(i / n) * kernel(x * n - i);
        i += 1.0;
    }
    sum
}

fn nearest(n: u32, x: f64) -> f64 {
    let n = f64::from(n);
    music((x * n + 0.5).floor() / n)
}

fn linear(n: u32, x: f64) -> f64 {
    let n = f64::from(n);
    let left = (x * n).floor();
    let (a, b) = (music(left / n), music((left + 1.0) / n));
    a + (b - a) * (x * n - left)
}

/// The error's mean square as decibels below the wave's own, in tenths, so that no rounding shows.
fn decibels(way: fn(u32, f64) -> f64, n: u32) -> f64 {
    let (mut error, mut power) = (0.0, 0.0);
    for i in 0..720 {
        let x = (f64::from(i) + 0.5) / 720.0;
        let d = way(n, x) - music(x);
        error += d * d;
        power += music(x) * music(x);
    }
    let level = 10.0 * log10((error / power).max(1e-12));
    ((level * 10.0 + 0.5).floor() / 10.0).max(-75.0)
}

pub(super) fn nyquist() -> Drawn {
    let mut drawing = Drawing::new(860, 430);
    let plot =
        Plot { frame: Rect::new(70.0, 34.0, 830.0, 350.0), x: [2.0, 32.0], y: [-75.0, 10.0] };
    let rules = [(0.0, "0"), (-20.0, "-20"), (-40.0, "-40"), (-60.0, "-60")];
    plot.rules(&mut drawing, &rules);
    let ticks =
        [(2.0, "2"), (4.0, "4"), (8.0, "8"), (9.0, ""), (16.0, "16"), (24.0, "24"), (32.0, "32")];
    plot.ticks(&mut drawing, &ticks);
    plot.axes(&mut drawing, "error of the reconstruction, dB");
    drawing.dashed([plot.place(8.0, -75.0), plot.place(8.0, 10.0)], 1.2, 5.0, GREY);
    let at = plot.place(8.2, 5.5);
    drawing.text(at, 13.0, Anchor::Start, "twice the highest frequency", INK);
    let at = DVec2::new(450.0, 388.0);
    drawing.text(at, 13.0, Anchor::Middle, "samples in one turn of the slowest wave", INK);
    let ways = [
        ("nearest sample", RED, nearest as fn(u32, f64) -> f64),
        ("lines", GREEN, linear),
        ("sinc", BLUE, sinc),
    ];
    for (index, (name, color, way)) in ways.into_iter().enumerate() {
        let points: Vec<(f64, f64)> = (2..=32).map(|n| (f64::from(n), decibels(way, n))).collect();
        drawing.line(points.iter().map(|&(x, y)| plot.place(x, y)), 2.0, color);
        plot.dots(&mut drawing, color, &points);
        let x = 200.0 + 190.0 * index as f64;
        drawing.line([DVec2::new(x, 412.0), DVec2::new(x + 26.0, 412.0)], 3.0, color);
        drawing.text(DVec2::new(x + 34.0, 416.5), 13.0, Anchor::Start, name, INK);
    }
    finish(drawing)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::gallery::errata::says;

    #[test]
    fn sinc_is_exact_above_twice_the_highest_frequency_and_not_at_it() {
        assert!(decibels(sinc, 9) <= -75.0);
        assert!(decibels(sinc, 31) <= -75.0);
        assert!(decibels(sinc, 8) > -12.0);
        says(&format!("−{:.0} dB with 8 samples", -decibels(sinc, 8)));
        for k in 0..8 {
            assert!(sin(TAU * 4.0 * f64::from(k) / 8.0).abs() < 1e-12);
        }
    }
}
