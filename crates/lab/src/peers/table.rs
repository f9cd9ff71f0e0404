//! The comparison as Markdown.

use super::contender::{
    BILINEAR, BOX, CATMULL_ROM, CATMULL_ROM_16, OPENCV_CUBIC, OPENCV_GAUSSIAN_4, OPENCV_LINEAR,
};
use super::truth::{Pixel, Psnr};
use super::{Heat, Row};
use crate::quality::warps;
use std::collections::BTreeMap;
use std::fmt::Write;

/// What one of ours is to reach: at least so many decibels, at most so many milliseconds.
#[derive(Debug, Clone, Copy, Default)]
struct Bar {
    photo: Option<f64>,
    worst: Option<f64>,
    zone: Option<f64>,
    /// For each of photo, text and checker.
    far: Option<f64>,
    ms: Option<f64>,
}

/// All tables. What is absent is named below them.
pub(super) fn page(
    heats: &[Heat],
    mips: &[(&'static str, Vec<f64>)],
    absent: &BTreeMap<&'static str, String>,
    rounds: usize,
) -> String {
    let mut out = format!(
        "Rounds of the clock, whose medians these are: {rounds}. Behind a number of ours stands its bar: ≥ or ≤ where it is met, \
         < or > where it is not.\n"
    );
    for heat in heats {
        table(&mut out, heat);
    }
    out.push_str("\n| pyramid of 4096² RGBA8 | ms |\n|---|---|\n");
    let rival = mips.iter().find(|(name, _)| name.contains("OpenCV")).map(|(_, ms)| median(ms));
    for (name, times) in mips {
        let bar = match *name {
            _ if name.contains("OpenCV") => None,
            _ if name.contains("Kaiser") => Some(60.0),
            _ => rival.map(|ms| 1.5 * ms),
        };
        let _ = writeln!(out, "| {name} | {} |", at_most(median(times), bar));
    }
    out.push_str("\nllvmpipe was not asked: none of the programs that take part speaks OpenGL.\n");
    for (program, why) in absent {
        let _ = writeln!(out, "\n{program} was not there ({why}).");
    }
    out
}

fn table(out: &mut String, heat: &Heat) {
    let about: Vec<&str> =
        warps::ABOUT.iter().copied().chain(["W4: five times up, turned by −15°"]).collect();
    let truth = match heat.pixel {
        Pixel::Gaussian | Pixel::Cubic => "",
        Pixel::Square => "; a square pixel",
    };
    let has_far = heat.rows.iter().any(|(_, row)| row.psnr.iter().any(|p| p.far.is_some()));
    let (far, rule) =
        if has_far { (" ≥ 16 texels: photo · text · checker |", "---|") } else { ("", "") };
    let _ = write!(
        out,
        "\n| {}{truth} | photo dB | worst of checker, photo, text | zone plate |{far} ms |\n\
         |---|---|---|---|{rule}---|\n",
        about[heat.map]
    );
    for (contender, row) in &heat.rows {
        let bar = bar(heat, contender.name);
        let all = |i: usize| row.psnr[i].all;
        let worst = row.psnr[..3].iter().map(|p| p.all).fold(f64::INFINITY, f64::min);
        let _ = write!(
            out,
            "| {} | {} | {} | {} |",
            contender.name,
            at_least(all(0), bar.photo),
            at_least(worst, bar.worst),
            at_least(all(3), bar.zone)
        );
        if has_far {
            let _ = write!(out, " {} |", far_away(&row.psnr, bar.far));
        }
        let _ = writeln!(out, " {} |", at_most(median(&row.ms), bar.ms));
    }
}

/// Photo, text and checker, which are images 0, 2 and 1.
fn far_away(psnr: &[Psnr], bar: Option<f64>) -> String {
    let of = |i: usize| psnr[i].far.unwrap_or(f64::NAN);
    let told = |v: f64| format!("{v:.1}");
    let all = [of(0), of(2), of(1)];
    let text = all.map(told).join(" · ");
    let least = all.into_iter().fold(f64::INFINITY, f64::min);
    text + &against(least, bar, false)
}

fn at_least(value: f64, bar: Option<f64>) -> String {
    format!("{value:.1}{}", against(value, bar, false))
}

fn at_most(value: f64, bar: Option<f64>) -> String {
    format!("{value:.1}{}", against(value, bar, true))
}

/// How a value stands to its bar. What is printed decides.
fn against(value: f64, bar: Option<f64>, most: bool) -> String {
    let Some(bar) = bar else { return String::new() };
    let [value, bar] = [value, bar].map(|v| (10.0 * v).round());
    let sign = match (most, value.total_cmp(&bar)) {
        (false, std::cmp::Ordering::Less) => "<",
        (false, _) => "≥",
        (true, std::cmp::Ordering::Greater) => ">",
        (true, _) => "≤",
    };
    format!(" {sign} {}", bar / 10.0)
}

/// The bar of one of ours.
fn bar(heat: &Heat, name: &str) -> Bar {
    let some = |photo: f64, worst: f64, ms: f64| Bar {
        photo: Some(photo),
        worst: Some(worst),
        ms: Some(ms),
        ..Bar::default()
    };
    let row = |name: &str| -> Option<&Row> {
        heat.rows.iter().find(|(contender, _)| contender.name == name).map(|(_, row)| row)
    };
    let rival = |name: &str| row(name).map(|row| median(&row.ms));
    let ground = |photo, worst, far, ms| {
        // At its best it shall not be worse than the honest rival.
        let zone = match row(OPENCV_GAUSSIAN_4) {
            Some(row) if name == "`high`" => row.psnr[3].all,
            _ => 36.0,
        };
        Bar { far: Some(far), zone: Some(zone), ..some(photo, worst, ms) }
    };
    match (heat.pixel, heat.map, name) {
        (Pixel::Gaussian, 0, "`fast`") => ground(50.0, 40.0, 40.0, 25.0),
        (Pixel::Gaussian, 0, "`default`") => ground(52.0, 42.0, 50.0, 50.0),
        (Pixel::Gaussian, 0, "`high`") => ground(52.0, 42.0, 50.0, 60.0),
        (Pixel::Gaussian, 1, "`fast`") => some(49.0, 38.0, 25.0),
        (Pixel::Gaussian, 1, "`default`") => some(54.0, 41.0, 45.0),
        (Pixel::Gaussian, 1, "`high`") => some(57.0, 50.0, 80.0),
        (Pixel::Gaussian, 2, "`fast`") => some(43.0, 32.0, 18.0),
        (Pixel::Gaussian, 2, "`default`") => some(56.5, 50.0, 30.0),
        (Pixel::Gaussian, 2, "`high`") => some(56.5, 50.0, 40.0),
        (Pixel::Cubic, _, BILINEAR) => {
            Bar { ms: rival(OPENCV_LINEAR).map(|ms| 2.0 * ms), ..Bar::default() }
        }
        (Pixel::Cubic, _, CATMULL_ROM) => {
            Bar { photo: Some(57.0), ms: rival(OPENCV_CUBIC), ..Bar::default() }
        }
        (Pixel::Cubic, _, CATMULL_ROM_16) => Bar { photo: Some(62.0), ..Bar::default() },
        (Pixel::Square, 0, BOX) => Bar { ms: None, ..some(44.0, 36.0, 0.0) },
        _ => Bar::default(),
    }
}

fn median(times: &[f64]) -> f64 {
    let mut times = times.to_vec();
    times.sort_by(f64::total_cmp);
    times.get(times.len() / 2).copied().unwrap_or(f64::NAN)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_bar_is_met_by_what_is_printed() {
        assert_eq!(at_least(49.96, Some(50.0)), "50.0 ≥ 50");
        assert_eq!(at_least(49.94, Some(50.0)), "49.9 < 50");
        assert_eq!(at_most(25.04, Some(25.0)), "25.0 ≤ 25");
        assert_eq!(at_most(26.0, Some(25.26)), "26.0 > 25.3");
        assert_eq!(at_most(f64::NAN, None), "NaN");
    }
}
