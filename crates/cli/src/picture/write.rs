//! Writing picture files.

mod exr;
mod png;
mod tiff;

use super::{Channels, Depth, Format, Pixels};
use crate::error::Failure;
use crate::interrupt::Interrupt;
use crate::output::{Output, Target};
use ::image::codecs::{jpeg::JpegEncoder, webp::WebPEncoder};
use ::image::{ExtendedColorType, ImageEncoder, ImageError};
pub(crate) use png::PngStream;
use std::io::Write;
use std::ops::Range;

/// The quality of JPEGs, 1 to 100. At 92 a photograph keeps about 42 dB and takes a fifth of its PNG;
/// 75, what many tools write, shows in flat skies and around letters.
const JPEG_QUALITY: u8 = 92;

/// What a file shall hold.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct Form {
    pub(crate) width: u32,
    pub(crate) height: u32,
    pub(crate) channels: Channels,
    pub(crate) depth: Depth,
    pub(crate) format: Format,
    pub(crate) icc: Option<Vec<u8>>,
}

impl Form {
    /// Says at once if the format cannot hold that.
    pub(crate) fn check(&self) -> Result<(), Failure> {
        let Self { width, height, channels, depth, format, .. } = *self;
        let name = format.name();
        if !format.carries(depth) {
            return Err(Failure::Usage(format!("{name} has no {} numbers", depth.name())));
        }
        if channels.has_alpha() && !format.carries_alpha() {
            return Err(Failure::Usage(format!(
                "{name} has no alpha, and the picture has some; write another format"
            )));
        }
        let longest = format.longest_side();
        if width.max(height) > longest {
            return Err(Failure::Limit(format!(
                "the picture would be {width} by {height}; a side of a {name} has at most {longest}"
            )));
        }
        if width == 0 || height == 0 {
            return Err(Failure::Failed("the picture would have no pixels".to_owned()));
        }
        Ok(())
    }

    /// Says at once if that cannot be written to a target with so much memory.
    pub(crate) fn check_for(&self, target: &Target, memory: u64) -> Result<(), Failure> {
        self.check()?;
        let needed = self.memory();
        if needed > memory {
            return Err(Failure::Limit(format!(
                "{}: {needed} bytes are needed to write {}, which is not written row by row as PNG \
                 is (--max-memory)",
                target.name(),
                self.format.name()
            )));
        }
        Ok(())
    }

    /// Numbers in all.
    fn numbers(&self) -> usize {
        self.width as usize * self.height as usize * self.channels.count()
    }

    /// Bytes that a [`Writer`] holds on to: all numbers, and the file that they become, but for PNG,
    /// which is written as rows come.
    fn memory(&self) -> u64 {
        match self.format {
            Format::Png => 0,
            _ => {
                let each = u64::from(self.depth.bits() / 8).max(2);
                2 * each
                    * u64::from(self.width)
                    * u64::from(self.height)
                    * self.channels.count() as u64
            }
        }
    }
}

/// A picture file being written. Dropped before [`Writer::commit`], it leaves none.
#[derive(Debug)]
pub(crate) struct Writer {
    form: Form,
    /// Numbers still to come.
    missing: usize,
    body: Body,
}

#[derive(Debug)]
enum Body {
    /// Encoded as rows come.
    Stream(Box<PngStream>),
    /// Gathered, and encoded at the end.
    Whole { output: Output, pixels: Pixels },
    /// Encoded.
    Done(Output),
    /// Given up.
    Failed,
}

impl Writer {
    /// Opens the target for a picture of this form.
    pub(crate) fn open(
        target: &Target,
        interrupt: &Interrupt,
        form: Form,
    ) -> Result<Self, Failure> {
        form.check()?;
        let output = Output::open(target, interrupt)?;
        let body = match form.format {
            Format::Png => Body::Stream(Box::new(PngStream::new(output, &form)?)),
            _ => Body::Whole { output, pixels: Pixels::empty(form.depth) },
        };
        Ok(Self { missing: form.numbers(), form, body })
    }

    /// Takes the next rows, or parts of them: numbers of the form's type and channels.
    pub(crate) fn rows(&mut self, rows: &Pixels) -> Result<(), Failure> {
        self.part(rows, 0..rows.len())
    }

    /// Takes some of the numbers as the next rows, or parts of them.
    pub(crate) fn part(&mut self, numbers: &Pixels, part: Range<usize>) -> Result<(), Failure> {
        fn of<T>(values: &[T], part: Range<usize>) -> Result<&[T], Failure> {
            values.get(part).ok_or_else(out_of_turn)
        }
        self.expect(part.len())?;
        match (&mut self.body, numbers) {
            (Body::Stream(stream), Pixels::U8(v)) => stream.write8(of(v, part)?),
            (Body::Stream(stream), Pixels::U16(v)) => stream.write16(of(v, part)?),
            (Body::Whole { pixels: Pixels::U8(all), .. }, Pixels::U8(v)) => {
                gather(all, of(v, part)?, &self.form)
            }
            (Body::Whole { pixels: Pixels::U16(all), .. }, Pixels::U16(v)) => {
                gather(all, of(v, part)?, &self.form)
            }
            (Body::Whole { pixels: Pixels::F32(all), .. }, Pixels::F32(v)) => {
                gather(all, of(v, part)?, &self.form)
            }
            _ => Err(out_of_turn()),
        }
    }

    /// The next rows in eight bits.
    pub(crate) fn rows8(&mut self, rows: &[u8]) -> Result<(), Failure> {
        self.expect(rows.len())?;
        match &mut self.body {
            Body::Stream(stream) => stream.write8(rows),
            Body::Whole { pixels: Pixels::U8(all), .. } => gather(all, rows, &self.form),
            _ => Err(out_of_turn()),
        }
    }

    fn expect(&mut self, count: usize) -> Result<(), Failure> {
        self.missing = self.missing.checked_sub(count).ok_or_else(out_of_turn)?;
        Ok(())
    }

    /// Says that all rows have come, encodes what is left, and writes it: after this a full disk is no
    /// reason to fail any more.
    pub(crate) fn finish(&mut self) -> Result<(), Failure> {
        let output = match std::mem::replace(&mut self.body, Body::Failed) {
            Body::Stream(stream) => stream.finish()?,
            Body::Whole { output, pixels } => {
                encode(&output, &self.form, &pixels)?;
                output
            }
            Body::Done(_) | Body::Failed => return Err(out_of_turn()),
        };
        output.pipe().flush().map_err(|e| output.failure(&e))?;
        self.body = Body::Done(output);
        Ok(())
    }

    /// Gives the finished file its name.
    pub(crate) fn commit(self) -> Result<(), Failure> {
        match self.body {
            Body::Done(output) => output.commit(),
            _ => Err(Failure::Failed("nothing was drawn".to_owned())),
        }
    }
}

/// Appends rows to those that came before.
fn gather<T: Copy>(all: &mut Vec<T>, rows: &[T], form: &Form) -> Result<(), Failure> {
    if all.is_empty() {
        all.try_reserve_exact(form.numbers())
            .map_err(|_| Failure::Limit("there is not enough memory for the picture".to_owned()))?;
    }
    all.extend_from_slice(rows);
    Ok(())
}

fn encode(output: &Output, form: &Form, pixels: &Pixels) -> Result<(), Failure> {
    if pixels.len() != form.numbers() {
        return Err(Failure::Failed("the picture lacks rows".to_owned()));
    }
    match (form.format, pixels) {
        (Format::Jpeg, Pixels::U8(v)) => {
            let encoder = JpegEncoder::new_with_quality(output.pipe(), JPEG_QUALITY);
            simple(encoder, output, form, v)
        }
        (Format::WebP, Pixels::U8(v)) => {
            simple(WebPEncoder::new_lossless(output.pipe()), output, form, v)
        }
        (Format::Tiff, _) => in_memory(output, |file| tiff::write(file, form, pixels)),
        (Format::Exr, Pixels::F32(v)) => in_memory(output, |file| exr::write(file, form, v)),
        _ => Err(out_of_turn()),
    }
}

/// An encoder of eight bits.
fn simple(
    mut encoder: impl ImageEncoder,
    output: &Output,
    form: &Form,
    values: &[u8],
) -> Result<(), Failure> {
    let color = match form.channels {
        Channels::Gray => ExtendedColorType::L8,
        Channels::GrayAlpha => ExtendedColorType::La8,
        Channels::Rgb => ExtendedColorType::Rgb8,
        Channels::Rgba => ExtendedColorType::Rgba8,
    };
    let failed = |e: ImageError| output.failure(&e);
    if let Some(icc) = &form.icc {
        encoder.set_icc_profile(icc.clone()).map_err(|e| output.failure(&e))?;
    }
    encoder.write_image(values, form.width, form.height, color).map_err(failed)
}

/// An encoder that goes back and forth in its file.
fn in_memory(
    output: &Output,
    write: impl FnOnce(&mut std::io::Cursor<Vec<u8>>) -> Result<(), String>,
) -> Result<(), Failure> {
    let mut file = std::io::Cursor::new(Vec::new());
    write(&mut file).map_err(|e| output.failure(&e))?;
    output.pipe().write_all(file.get_ref()).map_err(|e| output.failure(&e))
}

pub(crate) fn out_of_turn() -> Failure {
    Failure::Failed("rows came before the start or after the end".to_owned())
}
