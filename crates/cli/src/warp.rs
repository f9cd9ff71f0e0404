//! `scumble warp`: a picture in, the same picture seen another way out.

mod file;
mod report;
mod sink;
mod way;

use crate::args::{STANDARD_STREAM, Warp as Options};
use crate::error::{self, Failure};
use crate::input::Source;
use crate::interrupt::Interrupt;
use crate::output::{Request, Target};
use crate::picture::{self, Depth, Picture};
use crate::progress::Progress;
use crate::settings;
use crate::size::Canvas;
use report::Report;
use scumble::Control;
use scumble::pixel::Premul;
use scumble::texture::Sampler;
use scumble::warp::{Prepared, Verification, Warp, WarpError};
use sink::PictureSink;
use std::path::Path;
use std::time::{Duration, Instant};
use way::Map;

/// Does what the arguments say.
pub(crate) fn run(options: &Options) -> Result<(), Failure> {
    let interrupt = Interrupt::install()?;
    let source = Source::new(&options.input);
    source.check()?;
    let out = options.out.as_deref().or(options.output.as_deref());
    let request = Request { out, force: options.force, json: options.report.json };
    let target = Target::new(&request, &source)?;
    let lookup = options.way.map.as_deref().map(Source::new);
    if let Some(lookup) = &lookup {
        if *lookup == Source::Stdin && source == Source::Stdin {
            return Err(Failure::Usage(
                "only one of IN and --map can be standard input".to_owned(),
            ));
        }
        target.check_apart(lookup, options.force)?;
    }
    let format = target.format()?;

    let start = Instant::now();
    let limits =
        picture::Limits { pixels: options.limits.max_pixels, memory: options.limits.max_memory };
    let picture = picture::read(&source, limits)?;
    let (map, canvas) = way::choose(&options.way, &picture, limits)?;
    let decode = start.elapsed();
    if !options.report.quiet {
        error::warn(&source.name(), &picture.origin.notes);
    }
    let job = Job {
        options,
        picture: &picture,
        name: source.name(),
        target: &target,
        interrupt: &interrupt,
        canvas,
    };
    let warp = job.settings(map)?;
    let done = job.draw(&warp, format)?;
    let report = Report { job: &job, warp: &warp, decode, done: &done };
    if options.report.json {
        report.print()?;
    } else if let Some(verification) = &done.verification {
        report::tell(
            verification,
            out == Some(Path::new(STANDARD_STREAM)) || target == Target::Stdout,
        )?;
    }
    Ok(())
}

/// A picture to be warped.
struct Job<'a> {
    options: &'a Options,
    picture: &'a Picture,
    name: String,
    target: &'a Target,
    interrupt: &'a Interrupt,
    canvas: Canvas,
}

/// What came of it.
struct Done {
    depth: Depth,
    threads: usize,
    warp: Duration,
    encode: Duration,
    verification: Option<Verification>,
}

impl Job<'_> {
    fn settings(&self, map: Map) -> Result<Warp<Map>, Failure> {
        let options = self.options;
        let filter = &options.filter;
        let preset = Sampler::preset(filter.quality).unwrap_or_default();
        let sampler = Sampler {
            kernel: filter.kernel.unwrap_or(preset.kernel),
            magnify: filter.magnify.unwrap_or(preset.magnify),
            ..preset
        };
        let held = self.picture.pixels.bytes().saturating_add(map.memory());
        Ok(Warp {
            crop: settings::crop(&self.canvas)?,
            sampler,
            border: filter.border,
            space: filter.space.working(),
            threads: options.limits.threads,
            max_memory: options.limits.max_memory.saturating_sub(held),
            ..Warp::new(map, self.canvas.width, self.canvas.height)
        })
    }

    /// Makes the picture, gives it its name, and judges it if that is asked for.
    fn draw(&self, warp: &Warp<Map>, format: picture::Format) -> Result<Done, Failure> {
        let start = Instant::now();
        let prepared = warp.prepare(self.picture).map_err(|e| self.failure(e.widen()))?;
        let mut form = file::form(self.options, self.picture, format, &prepared)?;
        (form.width, form.height) = self.canvas.picture();
        form.check_for(self.target, warp.max_memory)?;
        let depth = form.depth;
        let mut sink =
            PictureSink::new(self.target, self.interrupt, form, warp.space, &self.picture.tone);
        self.watched(|control| {
            if sink.takes_codes() {
                prepared.draw::<[u8; 4], _>(&mut sink, control)
            } else {
                prepared.draw::<Premul, _>(&mut sink, control)
            }
        })
        .map_err(|e| self.failure(e))?;
        let (elapsed, spent) = (start.elapsed(), sink.spent());
        let threads = prepared.stats().threads;
        // On several threads rows are encoded while others are made.
        let warp = if threads > 1 { elapsed } else { elapsed.saturating_sub(spent) };
        let verification =
            if self.options.verify { Some(self.verify(&prepared, depth)?) } else { None };
        let finish = Instant::now();
        sink.commit()?;
        self.interrupt.release();
        let encode = spent + finish.elapsed();
        Ok(Done { depth, threads, warp, encode, verification })
    }

    fn verify(&self, prepared: &Prepared<'_, Map>, depth: Depth) -> Result<Verification, Failure> {
        self.watched(|control| match depth {
            Depth::Eight => prepared.verify::<[u8; 4], _>(self.picture, control),
            Depth::Sixteen => prepared.verify::<[u16; 4], _>(self.picture, control),
            Depth::Half | Depth::Float => prepared.verify::<[f32; 4], _>(self.picture, control),
        })
        .map_err(|e| self.failure(e.widen()))
    }

    /// Work with a bar that can be interrupted.
    fn watched<T>(&self, work: impl FnOnce(&Control<'_>) -> T) -> T {
        let progress = Progress::new(self.options.report.quiet || self.options.report.json);
        let update = |p: scumble::Progress| progress.update(p.rows_done, p.rows);
        work(&Control { progress: Some(&update), cancel: Some(self.interrupt.cancel()) })
    }

    fn failure(&self, error: WarpError<Failure>) -> Failure {
        match error {
            WarpError::Sink(failure) => failure,
            WarpError::Cancelled => self.interrupt.failure(),
            WarpError::Memory { .. } => {
                Failure::Limit(format!("{}: {error} (--max-memory)", self.name))
            }
            WarpError::Size { .. } => Failure::Limit(format!("{}: {error}", self.name)),
            _ => Failure::Failed(format!("{}: {error}", self.name)),
        }
    }
}
