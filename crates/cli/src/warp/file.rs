//! What the result is written as.

use super::depth_of;
use super::way::Map;
use crate::args::{self};
use crate::error::Failure;
use crate::output::Target;
use crate::picture::{Channels, Depth, Form, Format, Picture, Pixels};
use scumble::pixel::Straight;
use scumble::texture::{Texture, TextureError, TextureOptions};
use scumble::warp::{Border, Prepared, Source};
use std::path::Path;

/// The format that the target's name says; a PNG where there is no ending.
pub(super) fn format(target: &Target) -> Result<Format, Failure> {
    let of = |path: &Path| {
        if path.extension().is_none() {
            return Ok(Format::Png);
        }
        Format::of_name(path).ok_or_else(|| {
            Failure::Usage(format!(
                "{}: its ending names no format that is written: .png, .jpg, .webp, .tif or .exr",
                path.display()
            ))
        })
    };
    match target {
        Target::Stdout => Ok(Format::Png),
        Target::File(file) => of(&file.shown),
        Target::Device(path) => of(path),
    }
}

/// The form of the result; its size is still that of the picture.
pub(super) fn form(
    options: &args::Warp,
    picture: &Picture,
    format: Format,
    prepared: &Prepared<'_, Map>,
) -> Result<Form, Failure> {
    let asked = options.filter.depth.map(depth_of);
    let depth = asked.unwrap_or_else(|| format.depth_for(picture.origin.depth));
    let mut form = picture.form(format, depth);
    if let Border::Constant(Straight([r, g, b, _])) = options.filter.border
        && form.channels.is_gray()
        && (r != g || g != b)
    {
        form.channels = if form.channels.has_alpha() { Channels::Rgba } else { Channels::Rgb };
        form.icc = None;
    }
    form.channels = if prepared.is_opaque() {
        form.channels.without_alpha()
    } else {
        form.channels.with_alpha()
    };
    if form.channels.has_alpha() && !format.carries_alpha() {
        return Err(Failure::Usage(format!(
            "{} has no alpha, and parts of the result are transparent; --border clamp or a colour \
             fills what lies beyond the edge",
            format.name()
        )));
    }
    Ok(form)
}

/// Says at once if the result cannot be written.
pub(super) fn check(form: &Form, target: &Target, memory: u64) -> Result<(), Failure> {
    form.check()?;
    let needed = form.memory();
    if needed > memory {
        return Err(Failure::Limit(format!(
            "{}: {needed} bytes are needed to write {}, which is not written row by row as PNG is \
             (--max-memory)",
            target.name(),
            form.format.name()
        )));
    }
    Ok(())
}

/// Bytes that a picture takes.
pub(super) fn memory(picture: &Picture) -> u64 {
    let each = match picture.pixels {
        Pixels::U8(_) => Depth::Eight,
        Pixels::U16(_) => Depth::Sixteen,
        Pixels::F32(_) => Depth::Float,
    };
    picture.pixels.len() as u64 * u64::from(each.bits() / 8)
}

impl Source for Picture {
    fn size(&self) -> [usize; 2] {
        [self.width as usize, self.height as usize]
    }

    fn is_opaque(&self) -> bool {
        let count = self.channels.count();
        if !self.channels.has_alpha() {
            return true;
        }
        match &self.pixels {
            Pixels::U8(v) => v.chunks_exact(count).all(|p| p[count - 1] == u8::MAX),
            Pixels::U16(v) => v.chunks_exact(count).all(|p| p[count - 1] == u16::MAX),
            Pixels::F32(v) => v.chunks_exact(count).all(|p| p[count - 1] >= 1.0),
        }
    }

    fn texture(&self, options: &TextureOptions) -> Result<Texture, TextureError> {
        Self::texture(self, options)
    }
}
