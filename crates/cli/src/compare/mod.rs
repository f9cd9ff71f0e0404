//! `scumble compare`: one scene by several settings, on a sheet with labels.

use crate::args::{Compare as Options, Render};
use crate::error::Failure;
use crate::input::Source;
use crate::interrupt::Interrupt;
use crate::output::{Request, Target};
use crate::png_sink;
use crate::render;
use crate::report::warn;
use crate::resources::Folders;
use crate::settings::Choices;
use crate::size::Canvas;
use scumble::pixel::Image;
use scumble::{Control, ImageSink, RenderError, Settings, Textures, render_with};
use scumble_sheet::{Cell, contact_sheet};
use scumble_svg::Parsed;
use std::time::{Duration, Instant};

/// Pictures that one alone is varied in are broken into rows of so many.
const COLUMNS: usize = 4;

/// How often a picture is drawn for its time.
const ROUNDS: usize = 3;

/// Does what the arguments say.
pub(crate) fn run(options: &Options) -> Result<(), Failure> {
    let interrupt = Interrupt::install()?;
    let source = Source::new(&options.scene);
    source.check()?;
    let force = options.files.force;
    let out = Some(options.output.as_path());
    let target = Target::new(&Request { out, force, json: false }, &source)?;
    let reference = options.reference().map_err(Failure::Usage)?;
    let limits = render::limits(&reference);
    let max_file = limits.max_file_bytes as u64;
    let folders = Folders::new(source.folder(), &options.files.resources, max_file)?;
    let parsed = render::read(&source, &folders, limits, &reference)?;
    if !options.quiet {
        warn(&source.name(), &parsed.warnings);
    }
    target.check_unused(&folders, force)?;
    let sheet = Comparison { parsed, source: &source, interrupt: &interrupt };
    png_sink::write(&sheet.draw(options, &reference)?, &target, &interrupt)
}

/// The scene that is drawn again and again.
struct Comparison<'a> {
    parsed: Parsed,
    source: &'a Source,
    interrupt: &'a Interrupt,
}

impl Comparison<'_> {
    fn draw(mut self, options: &Options, reference: &Render) -> Result<Image<[u8; 4]>, Failure> {
        let view = &mut self.parsed.scene.view;
        let canvas = Canvas::new(view, &options.size, options.limits.max_pixels)?;
        *view = canvas.view(*view, &options.size);
        let (truth, _) = self.picture(reference, &canvas, 1)?;
        let rounds = if options.no_time { 1 } else { ROUNDS };
        let mut cells = Vec::new();
        for combination in options.vary.combinations() {
            let render = options.render_with(&combination).map_err(Failure::Usage)?;
            let (picture, time) = self.picture(&render, &canvas, rounds)?;
            let mut lines: Vec<String> =
                combination.iter().map(|(name, value)| format!("{name} {value}")).collect();
            let quality = decibels(&picture, &truth);
            lines.push(match options.no_time {
                true => quality,
                false => format!("{quality}, {:.1} ms", time.as_secs_f64() * 1e3),
            });
            cells.push(Cell::new(picture, lines));
        }
        let columns = options.columns.map_or_else(|| columns(options), usize::from);
        let sheet = contact_sheet(&cells, columns, options.scale);
        let mut settings = Settings::new(sheet.width(), sheet.height());
        settings.threads = options.limits.threads;
        settings.max_memory = options.limits.max_memory;
        let mut sink = ImageSink::new();
        scumble::render(&sheet.into_scene(), &settings, &mut sink, &Control::default())
            .map_err(|e| self.failure(e))?;
        Ok(sink.into_image())
    }

    /// The scene by some settings, and the shortest time in which it was drawn.
    fn picture(
        &self,
        render: &Render,
        canvas: &Canvas,
        rounds: usize,
    ) -> Result<(Image<[u8; 4]>, Duration), Failure> {
        let choices = Choices::new(&render.quality, &render.color, self.parsed.profile)?;
        let settings = choices.settings(canvas, render)?;
        let scene = &self.parsed.scene;
        let textures = Textures::new(scene, &settings).map_err(|e| self.failure(e))?;
        let control = Control { progress: None, cancel: Some(self.interrupt.cancel()) };
        let (mut sink, mut best) = (ImageSink::new(), Duration::MAX);
        for _ in 0..rounds {
            let start = Instant::now();
            render_with(scene, &textures, &settings, &mut sink, &control)
                .map_err(|e| self.failure(e))?;
            best = best.min(start.elapsed());
        }
        Ok((sink.into_image(), best))
    }

    fn failure(&self, error: RenderError<std::convert::Infallible>) -> Failure {
        let line = format!("{}: {error}", self.source.name());
        match error {
            RenderError::Cancelled => self.interrupt.failure(),
            RenderError::Memory { .. } => Failure::Limit(format!("{line} (--max-memory)")),
            RenderError::Canvas { .. } => Failure::Limit(line),
            _ => Failure::Failed(line),
        }
    }
}

fn columns(options: &Options) -> usize {
    match options.vary.0.as_slice() {
        [alone] => alone.values.len().min(COLUMNS),
        all => all.last().map_or(1, |axis| axis.values.len()),
    }
}

/// How near a picture is to another of its size, as PSNR of encoded values over white.
fn decibels(picture: &Image<[u8; 4]>, truth: &Image<[u8; 4]>) -> String {
    let over_white = |[r, g, b, a]: [u8; 4]| {
        let alpha = f64::from(a) / 255.0;
        [r, g, b].map(|v| f64::from(v) / 255.0 * alpha + 1.0 - alpha)
    };
    let pixels = picture.pixels().iter().zip(truth.pixels());
    let sum: f64 = pixels
        .map(|(&a, &b)| {
            let (a, b) = (over_white(a), over_white(b));
            (0..3).map(|i| (a[i] - b[i]) * (a[i] - b[i])).sum::<f64>()
        })
        .sum();
    if sum == 0.0 {
        return "the same".to_owned();
    }
    format!("{:.1} dB", 10.0 * ((3 * truth.pixels().len()) as f64 / sum).log10())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn decibels_are_of_the_mean_square() {
        let grey = |v: u8| Image::filled(4, 3, [v, v, v, 255]).unwrap();
        assert_eq!(decibels(&grey(100), &grey(100)), "the same");
        assert_eq!(decibels(&grey(0), &grey(255)), "0.0 dB");
        // A tenth of black over white is 25 codes from white, whose transparency does not show.
        let (white, tenth) = ([255, 255, 255, 7], [0, 0, 0, 25]);
        let filled = |color| Image::filled(4, 3, color).unwrap();
        assert_eq!(decibels(&filled(tenth), &filled(white)), "20.2 dB");
    }
}
