//! What `scumble spectrum` and `scumble filter` have in common: a picture in, as colours, and a picture of
//! colours out.

use crate::args::{self, InOut, ReadLimits};
use crate::error::{self, Failure};
use crate::input::Source;
use crate::interrupt::Interrupt;
use crate::output::{Request, Target};
use crate::picture::{
    Channels, Depth, Encoder, Form, Format, Limits, Picture, Pixels, Writer, read,
};
use scumble::pixel::{Image, Premul, WorkingSpace};

/// Bytes that a pixel takes as a colour.
pub(crate) const COLOR_BYTES: u64 = 16;

/// Colours of a space, and the channels that tell all of them.
pub(crate) struct Colors {
    pub(crate) image: Image<Premul>,
    pub(crate) space: WorkingSpace,
    pub(crate) channels: Channels,
}

/// A run from one picture to another.
pub(crate) struct Job<'a> {
    files: &'a InOut,
    limits: &'a ReadLimits,
    source: Source,
    target: Target,
    format: Format,
    pub(crate) interrupt: Interrupt,
}

impl<'a> Job<'a> {
    /// One whose picture can be read and whose result has a place.
    pub(crate) fn new(files: &'a InOut, limits: &'a ReadLimits) -> Result<Self, Failure> {
        let interrupt = Interrupt::install()?;
        let source = Source::new(&files.input);
        source.check()?;
        let request = Request { out: Some(&files.output), force: files.force, json: false };
        let target = Target::new(&request, &source)?;
        let format = target.format()?;
        Ok(Self { files, limits, source, target, format, interrupt })
    }

    /// The picture, if what becomes of it takes no more than `per_pixel` bytes of memory a pixel.
    pub(crate) fn read(&self, per_pixel: u64) -> Result<Picture, Failure> {
        let name = self.source.name();
        let (pixels, memory) = (self.limits.max_pixels, self.limits.max_memory);
        let picture = read(&self.source, Limits { pixels, memory })?;
        if !self.files.quiet {
            error::warn(&name, &picture.origin.notes);
        }
        let (width, height) = (picture.width, picture.height);
        let needed = u64::from(width) * u64::from(height);
        let needed = needed.saturating_mul(per_pixel).saturating_add(picture.pixels.bytes());
        if needed > memory {
            return Err(Failure::Limit(format!(
                "{name}: the picture is {width} by {height}, and {needed} bytes are needed to work \
                 on it; at most {memory} are allowed (--max-memory)"
            )));
        }
        Ok(picture)
    }

    /// The picture in a space, if all of it is finite: sums would spread what is not.
    pub(crate) fn colors(
        &self,
        picture: &Picture,
        space: WorkingSpace,
    ) -> Result<Image<Premul>, Failure> {
        if let Pixels::F32(values) = &picture.pixels
            && let Some(i) = values.iter().position(|v| !v.is_finite())
        {
            let pixel = i / picture.channels.count();
            let width = picture.width as usize;
            return Err(Failure::Failed(format!(
                "{}: the pixel at {},{} is not finite, and would be everywhere in the result",
                self.source.name(),
                pixel % width,
                pixel / width
            )));
        }
        Ok(picture.colors(space))
    }

    /// Writes what came of the picture, by a form of its own but for the channels and the depth.
    pub(crate) fn write(
        &self,
        colors: &Colors,
        picture: &Picture,
        depth: Depth,
    ) -> Result<(), Failure> {
        let Colors { image, space, channels } = colors;
        let asked = self.files.depth.map(args::Depth::stored);
        let depth = asked.unwrap_or_else(|| self.format.depth_for(depth));
        let form = Form { channels: *channels, ..picture.form(self.format, depth) };
        form.check_for(&self.target, self.limits.max_memory)?;
        let encoder = Encoder::new(*space, &picture.tone, &form);
        let mut numbers = Pixels::empty(form.depth);
        let mut writer = Writer::open(&self.target, &self.interrupt, form)?;
        for y in 0..image.height() {
            numbers.clear();
            encoder.row(image.row(y), &mut numbers);
            writer.rows(&numbers)?;
        }
        writer.finish()?;
        writer.commit()?;
        self.interrupt.release();
        Ok(())
    }
}
