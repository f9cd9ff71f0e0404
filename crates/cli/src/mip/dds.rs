//! DDS with the header of DirectX 10.

use super::container::{Texels, write_level};
use super::levels::Level;
use crate::picture::{Channels, Depth};
use std::io::{self, Write};

pub(super) fn write(
    out: &mut impl Write,
    texels: &Texels,
    levels: &[Level],
    channels: Channels,
) -> io::Result<()> {
    /// Capabilities, height, width, pitch, pixel format and number of levels are there.
    const FLAGS: u32 = 0x2_100f;
    /// A texture, of several surfaces, with levels.
    const CAPABILITIES: u32 = 0x40_1008;
    const TEXTURE_2D: u32 = 3;

    out.write_all(b"DDS ")?;
    let pitch = u64::from(texels.width) * texels.size() as u64;
    let count = levels.len() as u32;
    let start = [124, FLAGS, texels.height, texels.width, pitch as u32, 0, count];
    let pixel_format = [32, 4, u32::from_le_bytes(*b"DX10"), 0, 0, 0, 0, 0];
    let end = [CAPABILITIES, 0, 0, 0, 0];
    let alpha_mode = if texels.has_alpha { 1 } else { 3 };
    let extension = [dxgi_format(texels), TEXTURE_2D, 0, 1, alpha_mode];
    let header = start.iter().chain(&[0; 11]).chain(&pixel_format).chain(&end).chain(&extension);
    for value in header {
        out.write_all(&value.to_le_bytes())?;
    }
    levels.iter().try_for_each(|level| write_level(out, level, channels, texels.depth))
}

/// `DXGI_FORMAT`.
fn dxgi_format(texels: &Texels) -> u32 {
    match texels.depth {
        Depth::Eight if texels.srgb => 29,
        Depth::Eight => 28,
        Depth::Sixteen => 11,
        Depth::Half => 10,
        Depth::Float => 2,
    }
}
