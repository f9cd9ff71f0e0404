//! The page in Markdown.

use super::QualityError;
use super::figures::FIGURES;
use super::methods::{self, PRESETS_FROM, TABLE};
use super::plot;
use super::sources::SOURCES;
use super::study::{Study, scales};
use super::warps;
use std::fmt::Write;

/// What was measured.
pub struct Report(Study);

/// Measures, with one place in every square of `cell`×`cell` pixels ([`super::FULL`] for the page).
///
/// # Errors
/// [`QualityError::Texture`] and [`QualityError::Map`], which do not occur with the images and maps
/// that there are but for want of memory.
pub fn measure(cell: usize) -> Result<Report, QualityError> {
    Study::new(cell).map(Report)
}

impl Report {
    /// The page, in Markdown.
    #[must_use]
    pub fn page(&self) -> String {
        let count = self.0.places.iter().map(ToString::to_string).collect::<Vec<_>>();
        TEMPLATE
            .replace("{{places}}", &count.join(", "))
            .replace("{{tables}}", &self.tables())
            .replace("{{sweep}}", &self.sweep())
            .replace("{{figures}}", &figures())
    }

    /// The tables of the warps, each under a heading.
    #[must_use]
    pub fn tables(&self) -> String {
        let mut out = String::new();
        let names: Vec<&str> = SOURCES.iter().map(|s| s.name).collect();
        for (warp, about) in warps::ABOUT.iter().enumerate() {
            let line = "|---|".to_owned() + &"---|".repeat(SOURCES.len() + 2);
            let names = names.join(" | ");
            let _ = writeln!(out, "### {about}\n\n| | {names} | worst | texels |\n{line}");
            for (method, (name, _)) in TABLE.iter().enumerate() {
                let cells: Vec<String> =
                    self.0.row(warp, method).into_iter().map(|v| format!("{v:.1}")).collect();
                let worst = self.0.worst(warp, method);
                let (cells, psnr, texels) = (cells.join(" | "), worst.psnr, worst.texels);
                let _ = writeln!(out, "| {name} | {cells} | **{psnr:.1}** | {texels:.0} |");
            }
            out.push('\n');
        }
        out.trim_end().to_owned()
    }

    /// The sweep's table.
    #[must_use]
    pub fn sweep(&self) -> String {
        let mut out =
            String::from("| | worst | at | on | best | at |\n|---|---|---|---|---|---|\n");
        let scales = scales();
        for (preset, (name, _)) in TABLE[PRESETS_FROM..].iter().enumerate() {
            let found: Vec<_> = self.0.sweep(preset).into_iter().zip(&scales).collect();
            let Some(worst) = found.iter().min_by(|a, b| a.0.0.total_cmp(&b.0.0)) else { continue };
            let Some(best) = found.iter().max_by(|a, b| a.0.0.total_cmp(&b.0.0)) else { continue };
            let _ = writeln!(
                out,
                "| {name} | **{:.1}** | {:.2} | {} | {:.1} | {:.2} |",
                worst.0.0, worst.1, SOURCES[worst.0.1].name, best.0.0, best.1
            );
        }
        out.trim_end().to_owned()
    }

    /// The worst image's decibels of each method, by its name, on each warp.
    #[must_use]
    pub fn worst(&self) -> Vec<(&'static str, Vec<f64>)> {
        let of =
            |method| (0..warps::ABOUT.len()).map(|warp| self.0.worst(warp, method).psnr).collect();
        TABLE.iter().enumerate().map(|(method, (name, _))| (*name, of(method))).collect()
    }

    /// The plot of decibels over texels, as SVG.
    #[must_use]
    pub fn plot(&self) -> String {
        let mut next = TABLE.len();
        let mut series = Vec::new();
        for (name, methods) in methods::families() {
            series.push((name, (next..next + methods.len()).collect::<Vec<_>>()));
            next += methods.len();
        }
        let score = |warp, method| self.0.worst(warp, method);
        plot::draw(&score, &series)
    }
}

/// The pictures with what is to be seen on them.
fn figures() -> String {
    let mut out = String::new();
    for figure in &FIGURES {
        let name = figure.name;
        let _ = writeln!(out, "### {}\n\n![{}](quality/{name}.png)\n", figure.title, figure.title);
        let _ = writeln!(out, "{}\n\n{}\n", figure.order, figure.look);
    }
    out.trim_end().to_owned()
}

const TEMPLATE: &str = include_str!("page.in");

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_place_of_the_page_is_filled() {
        let places = ["places", "tables", "sweep", "figures"];
        for place in places {
            assert_eq!(TEMPLATE.matches(&format!("{{{{{place}}}}}")).count(), 1, "{place}");
        }
        assert_eq!(TEMPLATE.matches("{{").count(), places.len());
    }
}
