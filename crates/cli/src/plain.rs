//! Whole pictures of eight bits, read and written at once.

use crate::args::Memory;
use crate::error::Failure;
use crate::input::Source;
use crate::interrupt::Interrupt;
use crate::output::Target;
use crate::png_sink::PngSink;
use image::{ImageDecoder, ImageError, ImageReader, Limits};
use scumble::Sink;
use scumble::pixel::Image;
use std::io::Cursor;

/// Reads a PNG, JPEG, GIF or WebP. What follows takes `per_pixel` bytes of memory a pixel.
pub(crate) fn read(
    source: &Source,
    memory: &Memory,
    per_pixel: u64,
) -> Result<Image<[u8; 4]>, Failure> {
    source.check()?;
    let name = source.name();
    let wrong = |e: ImageError| match e {
        ImageError::Limits(e) => Failure::Limit(format!("{name}: {e} (--max-memory)")),
        e => Failure::Failed(format!("{name}: {e}")),
    };
    let data = source.read(memory.max_memory / 2)?;
    let mut reader = ImageReader::new(Cursor::new(data))
        .with_guessed_format()
        .map_err(|e| Failure::io(&name, &e))?;
    let mut limits = Limits::default();
    limits.max_alloc = Some(memory.max_memory);
    reader.limits(limits);
    let decoder = reader.into_decoder().map_err(wrong)?;
    let (width, height) = decoder.dimensions();
    let pixels = u64::from(width) * u64::from(height);
    if pixels.saturating_mul(per_pixel) > memory.max_memory {
        return Err(Failure::Limit(format!(
            "{name}: a picture of {width} by {height} pixels takes {} MB of memory here; \
             --max-memory allows it",
            pixels.saturating_mul(per_pixel) / 1_000_000
        )));
    }
    let decoded = image::DynamicImage::from_decoder(decoder).map_err(wrong)?.into_rgba8();
    let colors = decoded.pixels().map(|p| p.0).collect();
    Image::from_vec(width as usize, height as usize, colors)
        .map_err(|e| Failure::Failed(format!("{name}: {e}")))
}

/// Writes a PNG, and gives it its name once it is whole.
pub(crate) fn write(
    picture: &Image<[u8; 4]>,
    target: &Target,
    interrupt: &Interrupt,
) -> Result<(), Failure> {
    let opaque = picture.pixels().iter().all(|p| p[3] == 255);
    let side = |n: usize| u32::try_from(n).map_err(|_| Failure::Limit("too large".to_owned()));
    let mut sink = PngSink::new(target, interrupt, opaque);
    sink.start(side(picture.width())?, side(picture.height())?)?;
    sink.rows(0, picture.pixels())?;
    sink.finish()?;
    sink.commit()?;
    interrupt.release();
    Ok(())
}
