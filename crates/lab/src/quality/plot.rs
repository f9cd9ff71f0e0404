//! The plot of decibels over texels, as SVG.

use super::methods::{PRESETS_FROM, TABLE};
use super::study::Score;
use super::warps;
use crate::svg::number;
use std::fmt::Write;

const COLORS: [&str; 5] = ["#b3402a", "#8a6d1d", "#7a4fa3", "#2f6f9f", "#1d8a5a"];
const WIDTH: f64 = 400.0;
const HEIGHT: f64 = 330.0;
const LEFT: f64 = 50.0;
const TOP: f64 = 40.0;
const GAP: f64 = 40.0;
/// The axes' ends.
const TEXELS: [f64; 2] = [3.0, 1000.0];
const DECIBELS: [f64; 2] = [10.0, 80.0];

/// Two panels, W1 and W2; `score` of a warp and a method, and the methods of each curve.
pub(crate) fn draw(
    score: &dyn Fn(usize, usize) -> Score,
    series: &[(&'static str, Vec<usize>)],
) -> String {
    let (width, height) = (LEFT + 2.0 * WIDTH + GAP + 20.0, TOP + HEIGHT + 110.0);
    let mut out = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {width} {height}\" \
         width=\"{width}\" height=\"{height}\" font-family=\"sans-serif\" font-size=\"12\">\n\
         <rect width=\"{width}\" height=\"{height}\" fill=\"#ffffff\"/>\n"
    );
    for panel in 0..2 {
        let left = LEFT + panel as f64 * (WIDTH + GAP);
        axes(&mut out, left, warps::ABOUT[panel]);
        for (color, (_, methods)) in COLORS.iter().zip(series) {
            curve(&mut out, left, color, methods.iter().map(|m| score(panel, *m)));
        }
        for (index, (name, _)) in TABLE.iter().enumerate().skip(PRESETS_FROM) {
            let (x, y) = place(left, score(panel, index));
            let (x_text, y_text) = (number(x + 9.0, 1), number(y + 12.0, 1));
            let (x, y, name) = (number(x, 1), number(y, 1), name.trim_matches('`'));
            let ring = "r=\"5.5\" fill=\"none\" stroke=\"#202020\" stroke-width=\"1.6\"";
            let _ = writeln!(out, "<circle cx=\"{x}\" cy=\"{y}\" {ring}/>");
            text(&mut out, &x_text, &y_text, "start", name);
        }
    }
    legend(&mut out, series);
    out.push_str("</svg>\n");
    out
}

fn axes(out: &mut String, left: f64, title: &str) {
    let (right, bottom) = (left + WIDTH, TOP + HEIGHT);
    let line = |out: &mut String, [x0, y0, x1, y1]: [f64; 4], color: &str| {
        let [x0, y0, x1, y1] = [x0, y0, x1, y1].map(|v| number(v, 1));
        let _ =
            writeln!(out, "<path d=\"M{x0} {y0}L{x1} {y1}\" stroke=\"{color}\" fill=\"none\"/>");
    };
    for k in [3.0, 10.0, 30.0, 100.0, 300.0, 1000.0] {
        let (x, _) = place(left, Score { texels: k, psnr: 0.0 });
        line(out, [x, TOP, x, bottom], "#e4e4e4");
        text(out, &number(x, 1), &number(bottom + 16.0, 1), "middle", &number(k, 0));
    }
    for k in 1..=8 {
        let psnr = f64::from(k) * 10.0;
        let (_, y) = place(left, Score { texels: 10.0, psnr });
        line(out, [left, y, right, y], "#e4e4e4");
        text(out, &number(left - 6.0, 1), &number(y + 4.0, 1), "end", &number(psnr, 0));
    }
    line(out, [left, TOP, left, bottom], "#404040");
    line(out, [left, bottom, right, bottom], "#404040");
    let middle = number(left + WIDTH / 2.0, 1);
    text(out, &middle, &number(TOP - 22.0, 1), "middle", title);
    text(out, &middle, &number(bottom + 32.0, 1), "middle", "texels read for a pixel");
    text(out, &number(left + 4.0, 1), &number(TOP - 6.0, 1), "start", "dB, worst of six images");
}

fn curve(out: &mut String, left: f64, color: &str, scores: impl Iterator<Item = Score>) {
    let mut path = String::new();
    let mut dots = String::new();
    for score in scores {
        let (x, y) = place(left, score);
        let (x, y) = (number(x, 1), number(y, 1));
        let _ = write!(path, "{}{x} {y}", if path.is_empty() { 'M' } else { 'L' });
        let _ = writeln!(dots, "<circle cx=\"{x}\" cy=\"{y}\" r=\"2.6\" fill=\"{color}\"/>");
    }
    let stroke = format!("stroke=\"{color}\" stroke-width=\"1.6\" fill=\"none\"");
    let _ = writeln!(out, "<path d=\"{path}\" {stroke}/>");
    out.push_str(&dots);
}

fn legend(out: &mut String, series: &[(&'static str, Vec<usize>)]) {
    for (index, (color, (name, _))) in COLORS.iter().zip(series).enumerate() {
        let x = LEFT + (index % 2) as f64 * (WIDTH + GAP);
        let y = TOP + HEIGHT + 56.0 + (index / 2) as f64 * 18.0;
        let (from, to, y_line) = (number(x, 1), number(x + 24.0, 1), number(y - 4.0, 1));
        let stroke = format!("stroke=\"{color}\" stroke-width=\"3\"");
        let _ = writeln!(out, "<path d=\"M{from} {y_line}L{to} {y_line}\" {stroke}/>");
        text(out, &number(x + 32.0, 1), &number(y, 1), "start", name);
    }
}

fn text(out: &mut String, x: &str, y: &str, anchor: &str, words: &str) {
    let _ = writeln!(
        out,
        "<text x=\"{x}\" y=\"{y}\" text-anchor=\"{anchor}\" fill=\"#202020\">{words}</text>"
    );
}

/// Where a score lies in the panel whose left edge is given.
fn place(left: f64, score: Score) -> (f64, f64) {
    let along = |v: f64, [from, to]: [f64; 2]| ((v - from) / (to - from)).clamp(0.0, 1.0);
    let x = along(score.texels.max(1.0).ln(), TEXELS.map(f64::ln));
    let y = along(score.psnr, DECIBELS);
    (left + x * WIDTH, TOP + (1.0 - y) * HEIGHT)
}
