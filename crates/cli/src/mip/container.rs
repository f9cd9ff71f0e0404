//! Containers of all levels of a texture, as graphics interfaces take them: uncompressed, four channels.

use super::levels::{Level, Plan};
use super::{dds, ktx2};
use crate::error::Failure;
use crate::interrupt::Interrupt;
use crate::output::{Output, Pipe, Target};
use crate::picture::{Channels, Depth, Pixels, Tone};
use crate::progress::Steps;
use exr::prelude::f16;
use std::ffi::OsStr;
use std::io::{self, Write};
use std::path::Path;

/// A kind of container.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Container {
    Ktx2,
    Dds,
}

/// What a container holds, in its own terms.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Texels {
    pub(super) width: u32,
    pub(super) height: u32,
    pub(super) depth: Depth,
    /// Whether colours are encoded by the curve of sRGB; otherwise they are light, or no colours.
    pub(super) srgb: bool,
    pub(super) has_alpha: bool,
}

impl Texels {
    /// Bytes of a texel: four numbers.
    pub(super) fn size(&self) -> usize {
        4 * (self.depth.bits() / 8) as usize
    }

    /// Bytes of a level.
    pub(super) fn level_bytes(&self, level: &Level) -> u64 {
        u64::from(level.width) * u64::from(level.height) * self.size() as u64
    }
}

impl Container {
    /// The one that the ending of a name says.
    pub(super) fn of_name(path: &Path) -> Option<Self> {
        let ending = path.extension().and_then(OsStr::to_str)?.to_ascii_lowercase();
        match ending.as_str() {
            "ktx2" => Some(Self::Ktx2),
            "dds" => Some(Self::Dds),
            _ => None,
        }
    }

    /// Writes the file; a texel is a step.
    pub(super) fn write(
        self,
        levels: &[Level],
        plan: &Plan,
        target: &Target,
        interrupt: &Interrupt,
        steps: &Steps,
    ) -> Result<(), Failure> {
        let Some(Level { width, height, .. }) = levels.first() else {
            return Err(Failure::Failed("there are no levels".to_owned()));
        };
        let texels = Texels {
            width: *width,
            height: *height,
            depth: plan.depth,
            srgb: plan.written == Tone::Srgb && !plan.is_data(),
            has_alpha: plan.channels.has_alpha(),
        };
        let output = Output::open(target, interrupt)?;
        let mut out = Counted { pipe: output.pipe(), steps, texel: texels.size() };
        match self {
            Self::Ktx2 => ktx2::write(&mut out, &texels, levels, plan.channels),
            Self::Dds => dds::write(&mut out, &texels, levels, plan.channels),
        }
        .map_err(|e| output.failure(&e))?;
        output.commit()
    }
}

/// A pipe that counts texels.
struct Counted<'a> {
    pipe: Pipe,
    steps: &'a Steps,
    /// Bytes of a texel.
    texel: usize,
}

impl Write for Counted<'_> {
    fn write(&mut self, data: &[u8]) -> io::Result<usize> {
        let written = self.pipe.write(data)?;
        self.steps.add((written / self.texel) as u64);
        Ok(written)
    }

    fn flush(&mut self) -> io::Result<()> {
        self.pipe.flush()
    }
}

/// Writes a level as four numbers a texel, little-endian.
pub(super) fn write_level(
    out: &mut impl Write,
    level: &Level,
    channels: Channels,
    depth: Depth,
) -> io::Result<()> {
    // A row at a time: a level may be large.
    let row = level.width as usize * channels.count();
    let mut bytes = Vec::new();
    for y in 0..level.height as usize {
        bytes.clear();
        let range = y * row..(y + 1) * row;
        match &level.pixels {
            Pixels::U8(v) => four(&v[range], channels, u8::MAX, |v| bytes.push(v)),
            Pixels::U16(v) => {
                four(&v[range], channels, u16::MAX, |v| bytes.extend(v.to_le_bytes()));
            }
            Pixels::F32(v) if depth == Depth::Half => four(&v[range], channels, 1.0, |v| {
                bytes.extend(f16::from_f32(v).to_bits().to_le_bytes());
            }),
            Pixels::F32(v) => four(&v[range], channels, 1.0, |v| bytes.extend(v.to_le_bytes())),
        }
        out.write_all(&bytes)?;
    }
    Ok(())
}

/// Gives out the pixels as red, green, blue and alpha.
fn four<T: Copy>(values: &[T], channels: Channels, one: T, mut put: impl FnMut(T)) {
    for pixel in values.chunks_exact(channels.count()) {
        let all = match *pixel {
            [y] => [y, y, y, one],
            [y, a] => [y, y, y, a],
            [r, g, b] => [r, g, b, one],
            [r, g, b, a] => [r, g, b, a],
            _ => continue,
        };
        all.into_iter().for_each(&mut put);
    }
}
