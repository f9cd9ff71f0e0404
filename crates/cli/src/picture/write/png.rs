//! PNG, encoded as rows come.

use super::Form;
use crate::error::Failure;
use crate::output::{Output, Pipe};
use crate::picture::{Channels, Depth};
use png::{BitDepth, ColorType, DeflateCompression, Encoder, Filter, Info, SrgbRenderingIntent};
use std::borrow::Cow;
use std::io::Write;

/// Effort of the compressor. Level 1 halves the time but doubles flat art; the png crate's default,
/// 6, saves 2 to 12 % of the size and takes two to five times as long.
const COMPRESSION: DeflateCompression = DeflateCompression::Level(2);

/// Bytes of compressed data in a chunk, which is what the encoder holds back.
const CHUNK_BYTES: usize = 64 << 10;

/// A PNG being written.
pub(crate) struct PngStream {
    // Before the encoder, and so dropped before it: what an encoder writes as it is dropped
    // would make an unfinished picture look like a finished one.
    output: Output,
    encoder: png::StreamWriter<'static, Pipe>,
    swapped: Vec<u8>,
}

impl std::fmt::Debug for PngStream {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("PngStream").field("output", &self.output).finish_non_exhaustive()
    }
}

impl PngStream {
    /// Writes the header.
    pub(super) fn new(output: Output, form: &Form) -> Result<Self, Failure> {
        let mut info = Info::with_size(form.width, form.height);
        info.color_type = match form.channels {
            Channels::Gray => ColorType::Grayscale,
            Channels::GrayAlpha => ColorType::GrayscaleAlpha,
            Channels::Rgb => ColorType::Rgb,
            Channels::Rgba => ColorType::Rgba,
        };
        info.bit_depth = match form.depth {
            Depth::Sixteen => BitDepth::Sixteen,
            _ => BitDepth::Eight,
        };
        info.icc_profile = form.icc.clone().map(Cow::Owned);
        let stream = Encoder::with_info(output.pipe(), info).and_then(|mut encoder| {
            if form.icc.is_none() {
                encoder.set_source_srgb(SrgbRenderingIntent::Perceptual);
            }
            encoder.set_filter(Filter::Adaptive);
            encoder.set_deflate_compression(COMPRESSION);
            encoder.write_header()?.into_stream_writer_with_size(CHUNK_BYTES)
        });
        let encoder = stream.map_err(|e| output.failure(&e))?;
        Ok(Self { output, encoder, swapped: Vec::new() })
    }

    pub(super) fn write8(&mut self, values: &[u8]) -> Result<(), Failure> {
        self.encoder.write_all(values).map_err(|e| self.output.failure(&e))
    }

    pub(super) fn write16(&mut self, values: &[u16]) -> Result<(), Failure> {
        self.swapped.clear();
        self.swapped.extend(values.iter().flat_map(|v| v.to_be_bytes()));
        self.encoder.write_all(&self.swapped).map_err(|e| self.output.failure(&e))
    }

    pub(super) fn finish(self) -> Result<Output, Failure> {
        match self.encoder.finish() {
            Ok(()) => Ok(self.output),
            Err(e) => Err(self.output.failure(&e)),
        }
    }
}
