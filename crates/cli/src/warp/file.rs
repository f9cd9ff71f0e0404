//! What the result is written as.

use super::way::Map;
use crate::args;
use crate::error::Failure;
use crate::picture::{Channels, Form, Format, Picture, Pixels};
use scumble::pixel::Straight;
use scumble::texture::{Texture, TextureError, TextureOptions};
use scumble::warp::{Border, Prepared, Source};

/// The form of the result; its size is still that of the picture.
pub(super) fn form(
    options: &args::Warp,
    picture: &Picture,
    format: Format,
    prepared: &Prepared<'_, Map>,
) -> Result<Form, Failure> {
    let asked = options.filter.depth.map(args::Depth::stored);
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
