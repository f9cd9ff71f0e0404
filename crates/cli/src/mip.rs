//! `scumble mip`: the levels of a picture, in files or in one container.

mod container;
mod dds;
mod ktx2;
mod levels;
mod sheet;

use crate::args::{Mip, choice_name};
use crate::error::{Failure, say, warn};
use crate::input::Source;
use crate::interrupt::Interrupt;
use crate::output::{Request, Target};
use crate::picture::{Depth, Form, Format, Limits, Picture, Tone, Writer, read};
use crate::progress::Steps;
use crate::report::{milliseconds, print};
use container::Container;
use levels::{Level, Plan};
use serde_json::json;
use std::fs;
use std::io;
use std::path::{Path, PathBuf};
use std::sync::atomic::Ordering;
use std::time::Instant;

/// Does what the arguments say.
pub(crate) fn run(options: &Mip) -> Result<(), Failure> {
    let interrupt = Interrupt::install()?;
    let source = Source::new(&options.input);
    source.check()?;
    let place = Place::new(options, &source)?;
    let sheet = options.sheet.as_deref().map(|out| target(out, options, &source)).transpose()?;
    if let (Some(sheet), Some(out)) = (&sheet, options.sheet.as_deref())
        && place.holds(sheet, out)
    {
        let why = format!("--sheet {}: it would replace what is made", out.display());
        return Err(Failure::Usage(why));
    }

    let start = Instant::now();
    let limits = Limits { pixels: options.limits.max_pixels, memory: options.limits.max_memory };
    let picture = read(&source, limits)?;
    let decode = start.elapsed();
    let name = source.name();
    let named = |e| match e {
        Failure::Limit(why) => Failure::Limit(format!("{name}: {why}")),
        Failure::Failed(why) => Failure::Failed(format!("{name}: {why}")),
        e => e,
    };
    let plan = Plan::new(options, &picture, &place).map_err(named)?;
    if !options.quiet {
        notes(&source, &picture, &place);
    }

    let start = Instant::now();
    // Every texel is made and written.
    let texels = u64::from(picture.width) * u64::from(picture.height) * 4 / 3;
    let steps = Steps::new(options.quiet || options.json, 2 * texels);
    let levels = levels::build(&picture, &plan, &interrupt, &steps).map_err(named)?;
    let mip = start.elapsed();
    let start = Instant::now();
    let (picture, plan, source, interrupt) = (&picture, &plan, &source, &interrupt);
    place.write(&levels, &Written { picture, plan, source, interrupt, steps: &steps })?;
    if let Some(target) = &sheet {
        sheet::write(&levels, plan, target, interrupt)?;
    }
    steps.clear();
    interrupt.release();
    if !options.json {
        return Ok(());
    }
    let report = json!({
        "picture": source.name(),
        "output": options.out.display().to_string(),
        "width": picture.width,
        "height": picture.height,
        "filter": choice_name(options.filter),
        "wrap": choice_name(options.wrap),
        "space": plan.space_name(),
        "channels": plan.channels.name(),
        "bits": plan.depth.bits(),
        "float": plan.depth.is_float(),
        "levels": levels.iter().map(Level::json).collect::<Vec<_>>(),
        "decode_ms": milliseconds(decode),
        "mip_ms": milliseconds(mip),
        "encode_ms": milliseconds(start.elapsed()),
    });
    print(&report.to_string())
}

/// Says what the reader left out, and what the container does.
fn notes(source: &Source, picture: &Picture, place: &Place) {
    let name = source.name();
    warn(&name, &picture.origin.notes);
    if matches!(place, Place::Container(..)) && picture.has_other_primaries() {
        let profile = picture.profile_name().unwrap_or_default();
        say(&format!(
            "{name}: warning: its primaries ({profile}) are not sRGB's, which a reader of the \
             container will take them for"
        ));
    }
}

fn target(out: &Path, options: &Mip, source: &Source) -> Result<Target, Failure> {
    let request = Request { out: Some(out), force: options.force, json: options.json };
    Target::new(&request, source)
}

/// Where the levels go.
enum Place {
    /// One file of all.
    Container(Container, Target),
    /// One file each.
    Folder(PathBuf),
}

impl Place {
    fn new(options: &Mip, source: &Source) -> Result<Self, Failure> {
        let out = &options.out;
        if let Some(container) = Container::of_name(out) {
            return Ok(Self::Container(container, target(out, options, source)?));
        }
        let folder = out.is_dir();
        let refused =
            out.as_os_str() == crate::args::STANDARD_STREAM || Format::of_name(out).is_some();
        if !folder && (refused || out.exists()) {
            return Err(Failure::Usage(format!(
                "{}: neither a folder nor a name that ends in .ktx2 or .dds",
                out.display()
            )));
        }
        match out.parent() {
            Some(parent) if !parent.as_os_str().is_empty() && !parent.is_dir() => {
                Err(Failure::Failed(format!("{}: no such folder", parent.display())))
            }
            _ => Ok(Self::Folder(out.clone())),
        }
    }

    /// Whether a sheet called `name` would stand where a level does, or all of them do.
    fn holds(&self, sheet: &Target, name: &Path) -> bool {
        match self {
            Self::Container(_, Target::File(file)) => sheet.is_at(&file.path),
            Self::Container(..) => false,
            Self::Folder(folder) => {
                let level = name.file_name().filter(|n| {
                    n.to_str().is_some_and(|n| n.starts_with("level_") && n.ends_with(".png"))
                });
                level.is_some_and(|level| sheet.is_at(&folder.join(level)))
            }
        }
    }

    /// Writes all levels.
    fn write(&self, levels: &[Level], written: &Written<'_>) -> Result<(), Failure> {
        let folder = match self {
            Self::Container(container, target) => {
                let Written { plan, interrupt, steps, .. } = written;
                return container.write(levels, plan, target, interrupt, steps);
            }
            Self::Folder(folder) => folder,
        };
        let new = match fs::create_dir(folder) {
            Ok(()) => true,
            Err(e) if e.kind() == io::ErrorKind::AlreadyExists => false,
            Err(e) => return Err(Failure::file(folder, &e)),
        };
        let done = written.files(folder, levels);
        if done.is_err() && new {
            // What is in it by now is somebody else's, and then it stays.
            let _ = fs::remove_dir(folder);
        }
        done
    }
}

/// What files of levels are made of.
struct Written<'a> {
    picture: &'a Picture,
    plan: &'a Plan,
    source: &'a Source,
    interrupt: &'a Interrupt,
    steps: &'a Steps,
}

/// The format of files of one level each.
fn file_format(depth: Depth) -> (Format, &'static str) {
    if depth.is_float() { (Format::Exr, "exr") } else { (Format::Png, "png") }
}

impl Written<'_> {
    /// Writes all levels, and gives them their names when the last is whole.
    fn files(&self, folder: &Path, levels: &[Level]) -> Result<(), Failure> {
        let files = levels.iter().enumerate().map(|(l, level)| self.file(folder, l, level));
        let files = files.collect::<Result<Vec<Writer>, Failure>>()?;
        files.into_iter().try_for_each(Writer::commit)
    }

    /// Writes level `l`.
    fn file(&self, folder: &Path, l: usize, level: &Level) -> Result<Writer, Failure> {
        if self.interrupt.cancel().load(Ordering::Relaxed) {
            return Err(self.interrupt.failure());
        }
        let plan = self.plan;
        let (format, ending) = file_format(plan.depth);
        let path = folder.join(format!("level_{l:02}.{ending}"));
        let request = Request { out: Some(&path), force: plan.force, json: false };
        let target = Target::new(&request, self.source)?;
        let icc = match plan.written {
            Tone::Linear => None,
            _ => self.picture.icc.clone().filter(|_| format.carries_icc()),
        };
        let Level { width, height, .. } = *level;
        let (channels, depth) = (plan.channels, plan.depth);
        let form = Form { width, height, channels, depth, format, icc };
        let mut writer = Writer::open(&target, self.interrupt, form)?;
        let row = width as usize * channels.count();
        for y in 0..height as usize {
            writer.part(&level.pixels, y * row..(y + 1) * row)?;
            self.steps.add(u64::from(width));
        }
        writer.finish()?;
        Ok(writer)
    }
}
