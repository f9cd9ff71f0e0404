//! Reading picture files.

mod exr;
mod tiff;

use super::orientation::transposes;
use super::{Channels, Depth, Format, Origin, Picture, Pixels, Tone, profile};
use crate::error::Failure;
use crate::input::Source;
use image::codecs::{jpeg::JpegDecoder, png::PngDecoder, webp::WebPDecoder};
use image::error::{LimitErrorKind, UnsupportedErrorKind};
use image::metadata::Orientation;
use image::{ColorType, ExtendedColorType, ImageDecoder, ImageError};
use std::io::Cursor;

/// What reading a picture may use.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Limits {
    /// Pixels of the picture.
    pub(crate) pixels: u64,
    /// Bytes: the file, its pixels and what decoding takes.
    pub(crate) memory: u64,
}

/// Why a picture was not read; the file's name comes before it.
#[derive(Debug)]
enum Refusal {
    /// The file is damaged or of a kind that is not read.
    Bad(String),
    /// It takes more than it may.
    Limit(String),
}

/// Reads the picture that `source` names, by what it holds and not by its name.
///
/// It comes out upright, its numbers as they are. What is read of each format, and what is refused, is
/// in `docs/pictures.md`.
pub(crate) fn read(source: &Source, limits: Limits) -> Result<Picture, Failure> {
    source.check()?;
    let data = source.read(limits.memory)?;
    read_bytes(&source.name(), &data, limits)
}

/// Reads the picture that a file called `name` holds.
pub(crate) fn read_bytes(name: &str, data: &[u8], limits: Limits) -> Result<Picture, Failure> {
    decode(data, limits).map_err(|refusal| match refusal {
        Refusal::Bad(why) => Failure::Failed(format!("{name}: {why}")),
        Refusal::Limit(why) => Failure::Limit(format!("{name}: {why}")),
    })
}

fn decode(data: &[u8], limits: Limits) -> Result<Picture, Refusal> {
    if data.is_empty() {
        return Err(Refusal::Bad("the file is empty".to_owned()));
    }
    let budget = Budget { limits, used: data.len() as u64 };
    let format = Format::of_content(data).ok_or_else(|| {
        const READ: &str = "PNG, JPEG, WebP, TIFF and OpenEXR are";
        Refusal::Bad(match foreign(data) {
            Some(kind) => format!("{kind} is not read; {READ}"),
            None => format!("not a picture of a known kind; {READ} read"),
        })
    })?;
    let stored = match format {
        Format::Png => png(data, &budget),
        Format::Jpeg => jpeg(data, &budget),
        Format::WebP => webp(data, &budget),
        Format::Tiff => tiff::read(data, &budget),
        Format::Exr => exr::read(data, &budget),
    };
    Ok(stored?.picture(format))
}

/// What a file is, if it is something that people have and that is not read here.
fn foreign(start: &[u8]) -> Option<&'static str> {
    let text = start.strip_prefix(b"\xef\xbb\xbf").unwrap_or(start).trim_ascii_start();
    let brand = start.get(4..12).filter(|b| b.starts_with(b"ftyp")).map(|b| &b[4..]);
    Some(match (start, brand) {
        _ if text.starts_with(b"<") => "text (perhaps a scene, for `scumble render`)",
        (_, Some(b"avif" | b"avis")) => "AVIF",
        (_, Some(b"heic" | b"heix" | b"mif1" | b"hevc")) => "HEIC",
        ([b'G', b'I', b'F', b'8', ..], _) => "GIF",
        ([b'B', b'M', ..], _) => "BMP",
        ([b'D', b'D', b'S', b' ', ..], _) => "DDS",
        ([0xab, b'K', b'T', b'X', ..], _) => "KTX",
        ([b'8', b'B', b'P', b'S', ..], _) => "PSD",
        ([b'%', b'P', b'D', b'F', ..], _) => "PDF",
        ([b'P', b'1'..=b'7' | b'F' | b'f', b'\n' | b' ' | b'\r' | b'\t', ..], _) => "PNM",
        ([b'#', b'?', b'R', b'A', b'D', b'I', ..], _) => "Radiance HDR",
        ([0xff, 0x0a, ..] | [0, 0, 0, 12, b'J', b'X', b'L', ..], _) => "JPEG XL",
        ([0, 0, 0, 12, b'j', b'P', ..] | [0xff, 0x4f, 0xff, 0x51, ..], _) => "JPEG 2000",
        _ => return None,
    })
}

/// What is left to use.
#[derive(Debug, Clone, Copy)]
struct Budget {
    limits: Limits,
    used: u64,
}

impl Budget {
    /// Refuses a picture that has too many pixels, or numbers that would fill too much memory while
    /// they take `bytes` each.
    fn check(&self, width: u64, height: u64, channels: u64, bytes: u64) -> Result<(), Refusal> {
        let Limits { pixels, memory } = self.limits;
        let count = width.saturating_mul(height);
        if count > pixels {
            return Err(Refusal::Limit(format!(
                "the picture is {width} by {height}, {count} pixels; at most {pixels} are allowed \
                 (--max-pixels)"
            )));
        }
        let needed = count.saturating_mul(channels).saturating_mul(bytes).saturating_add(self.used);
        if needed > memory {
            return Err(Refusal::Limit(format!(
                "the picture is {width} by {height} and takes {needed} bytes to read; at most \
                 {memory} are allowed (--max-memory)"
            )));
        }
        Ok(())
    }

    /// What decoders may allocate beside the pixels.
    fn rest(&self) -> u64 {
        self.limits.memory.saturating_sub(self.used)
    }
}

/// A picture as its file has it.
#[derive(Debug)]
struct Stored {
    width: u32,
    height: u32,
    channels: Channels,
    pixels: Pixels,
    premultiplied: bool,
    depth: Depth,
    icc: Option<Vec<u8>>,
    orientation: u8,
    notes: Vec<String>,
}

impl Stored {
    fn picture(self, format: Format) -> Picture {
        let Self { width, height, channels, pixels, premultiplied, depth, mut notes, .. } = self;
        let plain = if depth.is_float() { Tone::Linear } else { Tone::Srgb };
        let (tone, icc) = match self.icc.map(|icc| (profile::parse(&icc, channels), icc)) {
            None => (plain, None),
            Some((Err(note), _)) => {
                notes.push(note);
                (plain, None)
            }
            Some((Ok(profile), icc)) => {
                let tone = profile.tone.unwrap_or_else(|| {
                    notes.push("its ICC profile has no curves; those of sRGB are used".to_owned());
                    Tone::Srgb
                });
                (tone, Some(icc))
            }
        };
        let origin = Origin { format, depth, orientation: 1, notes };
        Picture { width, height, channels, pixels, premultiplied, tone, icc, origin }
            .upright(self.orientation)
    }
}

/// Bytes that a profile may have, unpacked. Those of printers have a few million.
const MAX_PROFILE_BYTES: u64 = 64 << 20;

/// What is said of animated pictures.
const ANIMATED: &str = "it is animated; the first picture is read";

fn png(data: &[u8], budget: &Budget) -> Result<Stored, Refusal> {
    // Beside the pixels, which have their own budget, come rows and profiles, and those unpack to a
    // thousand times what they are in the file.
    let mut limits = image::Limits::no_limits();
    let row = data.get(16..20).and_then(|w| w.first_chunk()).map_or(0, |w| u32::from_be_bytes(*w));
    let rows = u64::from(row).saturating_mul(4 * 8);
    limits.max_alloc = Some(budget.rest().min(MAX_PROFILE_BYTES.saturating_add(rows)));
    let decoder = PngDecoder::with_limits(Cursor::new(data), limits).map_err(bad)?;
    let animated = decoder.is_apng().unwrap_or_default();
    let gamma = decoder.gamma_value().ok().flatten();
    let mut stored = stored(decoder, budget, 1)?;
    if animated {
        stored.notes.push(ANIMATED.to_owned());
    }
    if stored.icc.is_none() && has_chunk(data, b"iCCP") {
        stored.notes.push(profile::DAMAGED.to_owned());
    }
    let srgb = gamma.is_none_or(|g| (g - 1.0 / 2.2).abs() < 0.01);
    if stored.icc.is_none() && !srgb {
        stored.notes.push("its gamma (gAMA) is not that of sRGB and was ignored".to_owned());
    }
    Ok(stored)
}

/// Whether a PNG has a chunk of this kind before its pixels.
fn has_chunk(data: &[u8], kind: &[u8; 4]) -> bool {
    let mut at = 8;
    while let Some(&[a, b, c, d, ref found @ ..]) =
        data.get(at..at + 8).and_then(|h| h.first_chunk::<8>())
    {
        if found == kind || found == b"IDAT" {
            return found == kind;
        }
        // Length, kind and checksum.
        at = at.saturating_add(12).saturating_add(u32::from_be_bytes([a, b, c, d]) as usize);
    }
    false
}

fn webp(data: &[u8], budget: &Budget) -> Result<Stored, Refusal> {
    // The container says how long it is; decoders take what is missing for zeros.
    let size = data.get(4..8).and_then(|s| s.first_chunk()).map(|s| u32::from_le_bytes(*s));
    if size.is_none_or(|size| (data.len() as u64) < 8 + u64::from(size)) {
        return Err(cut_off());
    }
    let decoder = WebPDecoder::new(Cursor::new(data)).map_err(bad)?;
    let animated = decoder.has_animation();
    let mut stored = stored(decoder, budget, 2)?;
    if animated {
        stored.notes.push(ANIMATED.to_owned());
    }
    Ok(stored)
}

fn jpeg(data: &[u8], budget: &Budget) -> Result<Stored, Refusal> {
    if !jpeg_ends(data) {
        return Err(cut_off());
    }
    let decoder = JpegDecoder::new(Cursor::new(data)).map_err(bad)?;
    let (width, height) = decoder.dimensions();
    // The limits first: they say more.
    budget.check(width.into(), height.into(), 1, 1)?;
    let most = (data.len() as u64).saturating_mul(MOST_PIXELS_PER_BYTE);
    if u64::from(width) * u64::from(height) > most {
        return Err(Refusal::Bad("there is too little in it for its size".to_owned()));
    }
    // A progressive file's coefficients are two bytes a number, beside the pixels and a copy.
    stored(decoder, budget, 4)
}

/// Pixels that a byte of a JPEG can stand for: each block of 8 by 8 takes a bit at least, of pixels or of
/// squares of four by four.
const MOST_PIXELS_PER_BYTE: u64 = 8 * 64 * 16;

/// Whether the coded data come to their end: decoders fill in grey where they do not.
fn jpeg_ends(data: &[u8]) -> bool {
    const START_OF_SCAN: u8 = 0xda;
    const END: [u8; 2] = [0xff, 0xd9];
    let mut at = 2;
    // Segments up to the first scan: thumbnails in them have ends of their own.
    while let Some(&[0xff, marker]) = data.get(at..at + 2).and_then(|m| m.first_chunk()) {
        if marker == START_OF_SCAN {
            // In coded data a byte of ones is followed by 0 unless it begins a marker.
            return data[at..].windows(2).any(|pair| pair == END);
        }
        match data.get(at + 2..at + 4).and_then(|l| l.first_chunk()) {
            // Filling bytes before a marker have no length.
            _ if marker == 0xff => at += 1,
            Some(length) => at += 2 + usize::from(u16::from_be_bytes(*length)),
            None => return false,
        }
    }
    // Whatever this is, the decoder will say what it makes of it.
    true
}

/// What a decoder of the crate `image` gives; `bytes` are what it takes for every byte of pixels.
fn stored(mut decoder: impl ImageDecoder, budget: &Budget, bytes: u64) -> Result<Stored, Refusal> {
    let (width, height) = decoder.dimensions();
    let (channels, depth) = match decoder.color_type() {
        ColorType::L8 => (Channels::Gray, Depth::Eight),
        ColorType::La8 => (Channels::GrayAlpha, Depth::Eight),
        ColorType::Rgb8 => (Channels::Rgb, Depth::Eight),
        ColorType::Rgba8 => (Channels::Rgba, Depth::Eight),
        ColorType::L16 => (Channels::Gray, Depth::Sixteen),
        ColorType::La16 => (Channels::GrayAlpha, Depth::Sixteen),
        ColorType::Rgb16 => (Channels::Rgb, Depth::Sixteen),
        ColorType::Rgba16 => (Channels::Rgba, Depth::Sixteen),
        other => return Err(Refusal::Bad(format!("pixels of the kind {other:?} are not read"))),
    };
    let orientation = decoder.orientation().map_or(1, Orientation::to_exif);
    let each = u64::from(depth.bits() / 8) * (bytes + u64::from(transposes(orientation)));
    budget.check(width.into(), height.into(), channels.count() as u64, each)?;
    let cmyk = matches!(decoder.original_color_type(), ExtendedColorType::Cmyk8);
    let icc = decoder.icc_profile().ok().flatten();
    let count = width as usize * height as usize * channels.count();
    let pixels = match depth {
        Depth::Eight => Pixels::U8(filled(count, |v| decoder.read_image(v))?),
        _ => Pixels::U16(filled(count, |v| decoder.read_image(bytemuck::cast_slice_mut(v)))?),
    };
    let notes = if cmyk {
        vec!["it was CMYK and was converted without its profile".to_owned()]
    } else {
        Vec::new()
    };
    Ok(Stored {
        width,
        height,
        channels,
        pixels,
        premultiplied: false,
        depth,
        icc,
        orientation,
        notes,
    })
}

/// So many numbers, filled by a decoder.
fn filled<T: Copy + Default>(
    count: usize,
    fill: impl FnOnce(&mut [T]) -> Result<(), ImageError>,
) -> Result<Vec<T>, Refusal> {
    let mut values = Vec::new();
    reserve(&mut values, count)?;
    values.resize(count, T::default());
    fill(&mut values).map_err(bad)?;
    Ok(values)
}

/// Memory for `count` more, if the system has it.
fn reserve<T>(values: &mut Vec<T>, count: usize) -> Result<(), Refusal> {
    values
        .try_reserve_exact(count)
        .map_err(|_| Refusal::Limit("there is not enough memory for the picture".to_owned()))
}

/// What a decoder said.
fn bad(error: ImageError) -> Refusal {
    match error {
        ImageError::Limits(e) if e.kind() == LimitErrorKind::InsufficientMemory => Refusal::Limit(
            "reading the picture takes more memory than is allowed (--max-memory)".to_owned(),
        ),
        ImageError::Limits(e) => Refusal::Limit(e.to_string()),
        ImageError::IoError(e) => Refusal::Bad(reading(&e)),
        ImageError::Unsupported(e) => match e.kind() {
            UnsupportedErrorKind::GenericFeature(what) => Refusal::Bad(format!("not read: {what}")),
            _ => Refusal::Bad(e.to_string()),
        },
        other => Refusal::Bad(without_preamble(&other.to_string())),
    }
}

/// What a decoder says, without saying again that it is a decoder.
fn without_preamble(text: &str) -> String {
    let text = text.trim();
    match text.split_once(": ") {
        Some((start, rest)) if start.starts_with("Format error decoding") => rest.to_owned(),
        _ => text.to_owned(),
    }
}

fn cut_off() -> Refusal {
    Refusal::Bad("the file is cut off".to_owned())
}

/// What went wrong in reading from memory, which is always that there was not enough of it.
fn reading(error: &std::io::Error) -> String {
    match error.kind() {
        std::io::ErrorKind::UnexpectedEof => "the file is cut off".to_owned(),
        _ => error.to_string(),
    }
}
