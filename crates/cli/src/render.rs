//! `scumble render`: a scene in, a picture out.

use crate::args::{self, Render};
use crate::error::Failure;
use crate::input::Source;
use crate::interrupt::Interrupt;
use crate::output::{Request, Target};
use crate::picture::Format;
use crate::png_sink::PngSink;
use crate::progress::Progress;
use crate::report::{Report, Times, located, warn};
use crate::resources::{Folders, Refusal};
use crate::settings::Choices;
use crate::size::Canvas;
use scumble::{Background, Control, RenderError, Settings};
use scumble_svg::{Limits, Options, Parsed, ProfileChoice, ResourceError, SvgError};
use std::io;
use std::time::{Duration, Instant};

/// Does what the arguments say.
pub(crate) fn run(options: &Render) -> Result<(), Failure> {
    let interrupt = Interrupt::install()?;
    let source = Source::new(&options.scene);
    source.check()?;
    let out = options.out.as_deref().or(options.output.as_deref());
    let force = options.files.force;
    let target = Target::new(&Request { out, force, json: options.report.json }, &source)?;

    let start = Instant::now();
    let limits = limits(options);
    let max_file = limits.max_file_bytes as u64;
    let folders = Folders::new(source.folder(), &options.files.resources, max_file)?;
    let mut parsed = read(&source, &folders, limits, options)?;
    let parse = start.elapsed();
    if !options.report.quiet {
        warn(&source.name(), &parsed.warnings);
    }
    target.check_unused(&folders, force)?;

    let canvas = Canvas::new(&parsed.scene.view, &options.size, options.limits.max_pixels)?;
    parsed.scene.view = canvas.view(parsed.scene.view, &options.size);
    let choices = Choices::new(&options.quality, &options.color, parsed.profile)?;
    let settings = choices.settings(&canvas, options)?;
    let job = Job { source: &source, target: &target, interrupt: &interrupt, settings: &settings };
    let (render, encode) = job.draw(&parsed, options.report.quiet || options.report.json)?;
    if !options.report.json {
        return Ok(());
    }
    let report = Report {
        scene: &source.name(),
        output: &target.name(),
        profile: parsed.profile,
        canvas,
        choices,
        max_eccentricity: settings.sampler.max_eccentricity,
        threads: threads(settings.threads),
        times: Times { parse, render, encode },
        warnings: &parsed.warnings,
    };
    report.print()
}

/// A picture to be drawn.
struct Job<'a> {
    source: &'a Source,
    target: &'a Target,
    interrupt: &'a Interrupt,
    settings: &'a Settings,
}

impl Job<'_> {
    /// Draws the picture and gives it its name. Returns the time for drawing and for encoding.
    fn draw(&self, parsed: &Parsed, quiet: bool) -> Result<(Duration, Duration), Failure> {
        let start = Instant::now();
        let progress = Progress::new(quiet);
        let update = |p: scumble::Progress| progress.update(p.rows_done, p.rows);
        let control = Control { progress: Some(&update), cancel: Some(self.interrupt.cancel()) };
        let opaque = is_opaque(self.settings, parsed);
        let mut sink = PngSink::new(self.target, self.interrupt, opaque);
        let drawn = scumble::render(&parsed.scene, self.settings, &mut sink, &control);
        progress.clear();
        drawn.map_err(|e| self.failure(e))?;
        let encode = sink.spent();
        sink.commit()?;
        self.interrupt.release();
        Ok((start.elapsed().saturating_sub(encode), encode))
    }

    fn failure(&self, error: RenderError<Failure>) -> Failure {
        match error {
            RenderError::Sink(failure) => failure,
            RenderError::Cancelled => self.interrupt.failure(),
            RenderError::Memory { .. } => {
                Failure::Limit(format!("{}: {error} (--max-memory)", self.source.name()))
            }
            RenderError::Canvas { .. } => {
                Failure::Limit(format!("{}: {error}", self.source.name()))
            }
            _ => Failure::Failed(format!("{}: {error}", self.source.name())),
        }
    }
}

/// Memory that an element of a document takes while it is read, roughly.
const BYTES_PER_ELEMENT: u64 = 2048;

/// Memory that an image takes in the end for each byte that it has as pixels: a pixel is four bytes
/// at first, and then sixteen in a pyramid that is a third larger than its base.
const BYTES_PER_IMAGE_BYTE: u64 = 6;

/// Memory that a byte of text may come to take: rectangles and path data have been seen at 16 to 32.
const BYTES_PER_TEXT_BYTE: u64 = 32;

/// Memory that the longest file beside the scene may take while it is decoded: one part in so many.
const FILE_SHARE: u64 = 8;

/// What a scene may cost, given what the run may use. The renderer, which knows the whole, counts
/// again; these stop a hostile scene before it takes the memory, and say where it is.
pub(crate) fn limits(options: &Render) -> Limits {
    let memory = options.limits.max_memory;
    let share = |part: u64| usize::try_from(memory / part).unwrap_or(usize::MAX);
    let mut limits = Limits::default();
    limits.max_document_bytes = limits.max_document_bytes.min(share(BYTES_PER_TEXT_BYTE));
    limits.max_elements = limits.max_elements.min(share(BYTES_PER_ELEMENT));
    limits.max_file_bytes = limits.max_file_bytes.min(share(FILE_SHARE));
    limits.max_image_pixels = options.limits.max_pixels;
    limits.max_image_bytes = memory / BYTES_PER_IMAGE_BYTE;
    limits
}

/// The scene, read with the resources that it may have.
pub(crate) fn read(
    source: &Source,
    folders: &Folders,
    limits: Limits,
    options: &Render,
) -> Result<Parsed, Failure> {
    let text = source.read(limits.max_document_bytes as u64)?;
    if let Some(format) = Format::of_content(&text) {
        let (name, kind) = (source.name(), format.name());
        let why = format!("{name}: it is a picture ({kind}); what is drawn is a scene, as SVG");
        return Err(Failure::Failed(why));
    }
    let profile = match options.files.profile {
        args::Profile::Auto => ProfileChoice::Auto,
        args::Profile::Svg => ProfileChoice::Svg,
        args::Profile::Course => ProfileChoice::Course,
    };
    let how = Options::default().with_profile(profile).with_resources(folders).with_limits(limits);
    scumble_svg::parse(&text, &how).map_err(|e| unreadable(source, &e))
}

fn unreadable(source: &Source, error: &SvgError) -> Failure {
    let line = located(&source.name(), error.position(), &error.kind().to_string());
    if error.is_limit() { Failure::Limit(line) } else { Failure::Failed(line) }
}

/// Whether every pixel is bound to have full alpha: whatever is painted over an opaque ground
/// leaves it opaque.
fn is_opaque(settings: &Settings, parsed: &Parsed) -> bool {
    let ground = match settings.background {
        Background::Scene => parsed.scene.background,
        Background::Color(color) => Some(color),
        Background::Transparent => None,
    };
    ground.is_some_and(|color| color.0[3] >= 1.0)
}

/// The number of threads that a setting stands for.
fn threads(setting: usize) -> usize {
    match setting {
        0 => std::thread::available_parallelism().map_or(1, usize::from),
        n => n,
    }
}

impl scumble_svg::Resources for Folders {
    fn load(&self, href: &str) -> Result<Vec<u8>, ResourceError> {
        self.read(href).map_err(|refusal| match refusal {
            Refusal::Read(e) if e.kind() == io::ErrorKind::NotFound => ResourceError::NotFound,
            Refusal::Read(_) => ResourceError::Other(refusal.to_string()),
            Refusal::TooLong(limit) => ResourceError::TooLarge { limit: limit as usize },
            _ => ResourceError::Refused(refusal.to_string()),
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn zero_threads_are_all() {
        assert_eq!(threads(3), 3);
        assert!(threads(0) >= 1);
    }
}
