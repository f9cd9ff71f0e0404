//! KTX 2.0 (Khronos, revision 4): header, index of levels, data format descriptor, keys, levels.

use super::container::{Texels, write_level};
use super::levels::Level;
use crate::picture::{Channels, Depth};
use std::io::{self, Write};

const IDENTIFIER: [u8; 12] = *b"\xabKTX 20\xbb\r\n\x1a\n";

/// Bytes of the identifier, the header and the index without its levels.
const HEADER_BYTES: u64 = 80;

/// Bytes of an entry of the index of levels.
const ENTRY_BYTES: u64 = 24;

/// Keys and values, in the order of the keys: rows go down, columns go right.
const KEYS: [(&str, &str); 2] =
    [("KTXorientation", "rd"), ("KTXwriter", concat!("scumble ", env!("CARGO_PKG_VERSION")))];

pub(super) fn write(
    out: &mut impl Write,
    texels: &Texels,
    levels: &[Level],
    channels: Channels,
) -> io::Result<()> {
    let (descriptor, keys) = (descriptor(texels), keys());
    let descriptor_at = HEADER_BYTES + ENTRY_BYTES * levels.len() as u64;
    let keys_at = descriptor_at + descriptor.len() as u64;
    let places = places(texels, levels, keys_at + keys.len() as u64);

    out.write_all(&IDENTIFIER)?;
    let type_size = (texels.depth.bits() / 8).max(1);
    let header = [
        vulkan_format(texels),
        type_size,
        texels.width,
        texels.height,
        // No depth, no array, one face.
        0,
        0,
        1,
        levels.len() as u32,
        // Not compressed beyond its format.
        0,
        descriptor_at as u32,
        descriptor.len() as u32,
        keys_at as u32,
        keys.len() as u32,
    ];
    for value in header {
        out.write_all(&value.to_le_bytes())?;
    }
    // No data that all levels share.
    out.write_all(&[0; 16])?;
    for (place, level) in places.iter().zip(levels) {
        let bytes = texels.level_bytes(level);
        for value in [*place, bytes, bytes] {
            out.write_all(&value.to_le_bytes())?;
        }
    }
    out.write_all(&descriptor)?;
    out.write_all(&keys)?;
    let mut at = keys_at + keys.len() as u64;
    for (place, level) in places.iter().zip(levels).rev() {
        io::copy(&mut io::Read::take(io::repeat(0), place - at), out)?;
        write_level(out, level, channels, texels.depth)?;
        at = place + texels.level_bytes(level);
    }
    Ok(())
}

/// Where each level begins: the smallest comes first, each at a multiple of a texel's size.
fn places(texels: &Texels, levels: &[Level], first: u64) -> Vec<u64> {
    let mut at = first;
    let mut places: Vec<u64> = levels
        .iter()
        .rev()
        .map(|level| {
            let place = at.next_multiple_of(texels.size() as u64);
            at = place + texels.level_bytes(level);
            place
        })
        .collect();
    places.reverse();
    places
}

/// `VkFormat`.
fn vulkan_format(texels: &Texels) -> u32 {
    match texels.depth {
        Depth::Eight if texels.srgb => 43,
        Depth::Eight => 37,
        Depth::Sixteen => 91,
        Depth::Half => 97,
        Depth::Float => 109,
    }
}

/// The data format descriptor (Khronos Data Format Specification 1.3): one basic block.
fn descriptor(texels: &Texels) -> Vec<u8> {
    const CHANNELS: [u8; 4] = [0, 1, 2, 15];
    /// Straight numbers in an encoded texel.
    const LINEAR: u8 = 0x10;
    const FLOAT: u8 = 0xc0;
    let block = 24 + 16 * CHANNELS.len() as u16;
    let transfer = if texels.srgb { 2 } else { 1 };

    let mut out = Vec::new();
    out.extend((u32::from(block) + 4).to_le_bytes());
    // Khronos, basic; version 2.
    out.extend(0_u32.to_le_bytes());
    out.extend(2_u16.to_le_bytes());
    out.extend(block.to_le_bytes());
    // RGBSDA, the primaries of BT.709, the curve, straight alpha; blocks of one texel.
    out.extend([1, 1, transfer, 0, 0, 0, 0, 0]);
    out.extend([texels.size() as u8, 0, 0, 0, 0, 0, 0, 0]);
    let bits = texels.depth.bits() as u16;
    let float = texels.depth.is_float();
    for (i, channel) in CHANNELS.into_iter().enumerate() {
        let alpha = if channel == 15 && texels.srgb { LINEAR } else { 0 };
        let kind = channel | alpha | if float { FLOAT } else { 0 };
        let (lower, upper) = match texels.depth {
            Depth::Eight => (0, 255),
            Depth::Sixteen => (0, 65535),
            Depth::Half | Depth::Float => ((-1.0_f32).to_bits(), 1.0_f32.to_bits()),
        };
        out.extend((i as u16 * bits).to_le_bytes());
        out.extend([bits as u8 - 1, kind, 0, 0, 0, 0]);
        out.extend(lower.to_le_bytes());
        out.extend(upper.to_le_bytes());
    }
    out
}

fn keys() -> Vec<u8> {
    let mut out = Vec::new();
    for (key, value) in KEYS {
        let length = key.len() + value.len() + 2;
        out.extend((length as u32).to_le_bytes());
        out.extend(key.bytes().chain([0]).chain(value.bytes()).chain([0]));
        out.resize(out.len().next_multiple_of(4), 0);
    }
    out
}
