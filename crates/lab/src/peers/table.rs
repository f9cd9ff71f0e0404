//! The comparison as Markdown.

use super::Row;
use super::contender::Contender;
use crate::quality::warps;
use std::collections::BTreeMap;
use std::fmt::Write;

type Rows = [Vec<(&'static Contender, Row)>];

/// All tables. What is absent is named below them.
pub(super) fn page(
    rows: &Rows,
    mips: &[(&'static str, Vec<f64>)],
    absent: &BTreeMap<&'static str, String>,
    rounds: usize,
) -> String {
    let about = warps::ABOUT.iter().copied().chain(["W4: five times up, turned by −15°"]);
    let mut out = format!("Medians of {rounds} rounds.\n");
    for (title, rows) in about.zip(rows) {
        let _ = write!(
            out,
            "\n| {title} | photo dB | worst of checker, photo, text | zone plate | ms |\n\
             |---|---|---|---|---|\n"
        );
        for (contender, row) in rows {
            let worst = row.psnr[..3].iter().copied().fold(f64::INFINITY, f64::min);
            let [photo, zone] = [row.psnr[0], row.psnr[3]];
            let (name, ms) = (contender.name, median(&row.ms));
            let _ = writeln!(out, "| {name} | {photo:.1} | {worst:.1} | {zone:.1} | {ms:.1} |");
        }
    }
    out.push_str("\n| pyramid of 4096² RGBA8 | ms |\n|---|---|\n");
    for (name, times) in mips {
        let _ = writeln!(out, "| {name} | {:.1} |", median(times));
    }
    for (program, why) in absent {
        let _ = writeln!(out, "\n{program} was not there ({why}).");
    }
    out
}

fn median(times: &[f64]) -> f64 {
    let mut times = times.to_vec();
    times.sort_by(f64::total_cmp);
    times.get(times.len() / 2).copied().unwrap_or(f64::NAN)
}
