//! Rows of the result into a picture file.

use crate::error::Failure;
use crate::interrupt::Interrupt;
use crate::output::Target;
use crate::picture::{Channels, Depth, Encoder, Form, Pixels, Tone, Writer, out_of_turn};
use scumble::Sink;
use scumble::pixel::{Premul, WorkingSpace};
use std::time::{Duration, Instant};

/// A sink that writes a picture file: of codes where the result is plain sRGB, else of colours that are
/// still to be encoded.
#[derive(Debug)]
pub(super) struct PictureSink<'a> {
    target: &'a Target,
    interrupt: &'a Interrupt,
    form: Form,
    encoder: Encoder,
    codes: bool,
    writer: Option<Writer>,
    numbers: Pixels,
    spent: Duration,
}

impl<'a> PictureSink<'a> {
    /// A sink for a form, of a picture that was worked upon in a space and whose numbers are so related
    /// to light.
    pub(super) fn new(
        target: &'a Target,
        interrupt: &'a Interrupt,
        form: Form,
        space: WorkingSpace,
        tone: &Tone,
    ) -> Self {
        let known = match tone {
            Tone::Srgb => true,
            Tone::Linear => form.icc.is_none(),
            Tone::Curves(_) => false,
        };
        Self {
            target,
            interrupt,
            encoder: Encoder::new(space, tone, &form),
            codes: known && form.depth == Depth::Eight && !form.format.premultiplies(),
            writer: None,
            numbers: Pixels::empty(form.depth),
            form,
            spent: Duration::ZERO,
        }
    }

    /// Whether rows come as codes of eight bits.
    pub(super) fn takes_codes(&self) -> bool {
        self.codes
    }

    /// Time spent on encoding and writing so far.
    pub(super) fn spent(&self) -> Duration {
        self.spent
    }

    /// Gives the finished picture its name.
    pub(super) fn commit(self) -> Result<(), Failure> {
        self.writer.ok_or_else(out_of_turn)?.commit()
    }

    fn open(&mut self) -> Result<(), Failure> {
        let start = Instant::now();
        self.writer = Some(Writer::open(self.target, self.interrupt, self.form.clone())?);
        self.spent += start.elapsed();
        Ok(())
    }

    /// Writes what `put` makes of some rows.
    fn write(&mut self, put: impl FnOnce(&Self, &mut Pixels)) -> Result<(), Failure> {
        let start = Instant::now();
        let mut numbers = std::mem::replace(&mut self.numbers, Pixels::U8(Vec::new()));
        numbers.clear();
        put(self, &mut numbers);
        let written = self.writer.as_mut().ok_or_else(out_of_turn)?.rows(&numbers);
        self.numbers = numbers;
        self.spent += start.elapsed();
        written
    }

    fn close(&mut self) -> Result<(), Failure> {
        let start = Instant::now();
        let finished = self.writer.as_mut().ok_or_else(out_of_turn)?.finish();
        self.spent += start.elapsed();
        finished
    }
}

/// Appends the channels that there are of RGBA.
fn pack(pixels: &[[u8; 4]], channels: Channels, out: &mut Vec<u8>) {
    match channels {
        Channels::Gray => out.extend(pixels.iter().map(|p| p[0])),
        Channels::GrayAlpha => out.extend(pixels.iter().flat_map(|p| [p[0], p[3]])),
        Channels::Rgb => out.extend(pixels.iter().flat_map(|p| [p[0], p[1], p[2]])),
        Channels::Rgba => out.extend_from_slice(pixels.as_flattened()),
    }
}

impl Sink<[u8; 4]> for PictureSink<'_> {
    type Error = Failure;

    fn start(&mut self, _: u32, _: u32) -> Result<(), Failure> {
        self.open()
    }

    fn rows(&mut self, _: u32, rows: &[[u8; 4]]) -> Result<(), Failure> {
        self.write(|sink, numbers| {
            if let Pixels::U8(codes) = numbers {
                pack(rows, sink.form.channels, codes);
            }
        })
    }

    fn finish(&mut self) -> Result<(), Failure> {
        self.close()
    }
}

impl Sink<Premul> for PictureSink<'_> {
    type Error = Failure;

    fn start(&mut self, _: u32, _: u32) -> Result<(), Failure> {
        self.open()
    }

    fn rows(&mut self, _: u32, rows: &[Premul]) -> Result<(), Failure> {
        self.write(|sink, numbers| sink.encoder.row(rows, numbers))
    }

    fn finish(&mut self) -> Result<(), Failure> {
        self.close()
    }
}
