//! TIFF (6.0 and BigTIFF): the first picture of a file.

use super::{Budget, Refusal, Stored, reading};
use crate::picture::orientation::transposes;
use crate::picture::{Channels, Depth, Pixels};
use std::io::Cursor;
use tiff::decoder::{Decoder, DecodingResult, Limits};
use tiff::tags::{ExtraSamples, Tag};
use tiff::{ColorType, TiffError};

type Tiff<'a> = Decoder<Cursor<&'a [u8]>>;

/// Bytes that a profile or another field of the file may have.
const MAX_FIELD_BYTES: usize = 64 << 20;

pub(super) fn read(data: &[u8], budget: &Budget) -> Result<Stored, Refusal> {
    let mut limits = Limits::default();
    limits.ifd_value_size = MAX_FIELD_BYTES.min(data.len());
    let mut decoder = Decoder::new(Cursor::new(data)).map_err(bad)?.with_limits(limits.clone());
    let (width, height) = decoder.dimensions().map_err(bad)?;
    let (channels, bits) = channels(&mut decoder)?;
    let orientation = number(&mut decoder, Tag::Orientation)?.unwrap_or(1) as u8;

    // The file's numbers and the picture's may stand side by side.
    let each = u64::from(bits.div_ceil(8)) * (2 + u64::from(transposes(orientation)));
    budget.check(width.into(), height.into(), channels.count() as u64, each)?;
    let rest = usize::try_from(budget.rest()).unwrap_or(usize::MAX);
    (limits.decoding_buffer_size, limits.intermediate_buffer_size) = (rest, rest);
    decoder = decoder.with_limits(limits);
    let premultiplied = channels.has_alpha()
        && number(&mut decoder, Tag::ExtraSamples)? == Some(ExtraSamples::AssociatedAlpha.to_u16());
    let icc = decoder.find_tag(Tag::IccProfile).map_err(bad)?;
    let icc = icc.and_then(|v| v.into_u8_vec().ok()).filter(|icc| !icc.is_empty());
    let more = decoder.more_images();

    let size = (width as usize, height as usize);
    let (pixels, depth) = pixels(&mut decoder, channels, size, bits)?;
    if pixels.len() != size.0 * size.1 * channels.count() {
        return Err(Refusal::Bad("its rows are not as long as it says".to_owned()));
    }
    let mut notes = Vec::new();
    if more {
        notes.push("it holds several pictures; the first is read".to_owned());
    }
    Ok(Stored { width, height, channels, pixels, premultiplied, depth, icc, orientation, notes })
}

/// The channels of a pixel and the bits of each.
fn channels(decoder: &mut Tiff<'_>) -> Result<(Channels, u8), Refusal> {
    let samples = number(decoder, Tag::SamplesPerPixel)?.unwrap_or(1);
    let (channels, bits) = match decoder.colortype().map_err(bad)? {
        ColorType::Gray(bits) => (Channels::Gray, bits),
        ColorType::Multiband { bit_depth, num_samples: 2 } => (Channels::GrayAlpha, bit_depth),
        ColorType::RGB(bits) => (Channels::Rgb, bits),
        ColorType::RGBA(bits) => (Channels::Rgba, bits),
        ColorType::Palette(_) => return Err(not_read("a palette")),
        ColorType::CMYK(_) | ColorType::CMYKA(_) => return Err(not_read("CMYK")),
        ColorType::YCbCr(_) => return Err(not_read("YCbCr")),
        ColorType::Lab(_) => return Err(not_read("Lab")),
        ColorType::Multiband { num_samples, .. } => {
            return Err(not_read(&format!("{num_samples} channels")));
        }
        _ => return Err(not_read("colours of this kind")),
    };
    if usize::from(samples) != channels.count() {
        return Err(not_read(&format!("{samples} channels")));
    }
    Ok((channels, bits))
}

/// All numbers, interleaved.
fn pixels(
    decoder: &mut Tiff<'_>,
    channels: Channels,
    (width, height): (usize, usize),
    bits: u8,
) -> Result<(Pixels, Depth), Refusal> {
    let mut result = DecodingResult::U8(Vec::new());
    let layout = decoder.read_image_to_buffer(&mut result).map_err(bad)?;
    if result.as_buffer(0).as_bytes().len() < layout.complete_len {
        return Err(Refusal::Limit(
            "it takes more memory than is allowed (--max-memory)".to_owned(),
        ));
    }
    let n = if layout.planes > 1 { channels.count() } else { 1 };
    Ok(match result {
        DecodingResult::U8(v) if bits == 8 => (Pixels::U8(woven(v, n)), Depth::Eight),
        DecodingResult::U8(v) if bits == 1 && channels == Channels::Gray => {
            (Pixels::U8(bilevel(&v, width, height)), Depth::Eight)
        }
        DecodingResult::U16(v) if bits == 16 => (Pixels::U16(woven(v, n)), Depth::Sixteen),
        DecodingResult::F16(v) => {
            (Pixels::F32(woven(v.into_iter().map(|v| v.to_f32()).collect(), n)), Depth::Half)
        }
        DecodingResult::F32(v) => (Pixels::F32(woven(v, n)), Depth::Float),
        _ => return Err(not_read(&format!("{bits} bits a channel of this kind"))),
    })
}

/// `planes` planes, one after another, pixel by pixel.
fn woven<T: Copy>(values: Vec<T>, planes: usize) -> Vec<T> {
    if planes <= 1 {
        return values;
    }
    let size = values.len() / planes;
    (0..size).flat_map(|i| (0..planes).map(move |p| p * size + i)).map(|i| values[i]).collect()
}

/// Rows of bits, padded to bytes, as black and white.
fn bilevel(rows: &[u8], width: usize, height: usize) -> Vec<u8> {
    let rows = rows.chunks(width.div_ceil(8)).take(height);
    let bit = |row: &[u8], x: usize| row.get(x / 8).is_some_and(|byte| byte << (x % 8) & 0x80 != 0);
    rows.flat_map(|row| (0..width).map(move |x| if bit(row, x) { 255 } else { 0 })).collect()
}

/// The first of a tag's numbers.
fn number(decoder: &mut Tiff<'_>, tag: Tag) -> Result<Option<u16>, Refusal> {
    let values = decoder.find_tag_unsigned_vec::<u16>(tag).map_err(bad)?;
    Ok(values.and_then(|v| v.first().copied()))
}

fn not_read(what: &str) -> Refusal {
    Refusal::Bad(format!("a TIFF with {what} is not read"))
}

fn bad(error: TiffError) -> Refusal {
    match error {
        TiffError::IoError(e) => Refusal::Bad(reading(&e)),
        TiffError::LimitsExceeded => {
            Refusal::Limit("it takes more memory than is allowed (--max-memory)".to_owned())
        }
        other => Refusal::Bad(other.to_string()),
    }
}
