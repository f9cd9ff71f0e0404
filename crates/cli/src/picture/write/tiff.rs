//! TIFF, compressed by Deflate.

use super::Form;
use crate::picture::{Channels, Pixels};
use std::io::{Seek, Write};
use tiff::TiffResult;
use tiff::encoder::colortype::{ColorType, Gray8, Gray16, Gray32Float, RGB8, RGB16, RGB32Float};
use tiff::encoder::{Compression, DeflateLevel, TiffEncoder, TiffValue};
use tiff::tags::{ExtraSamples, Tag};

pub(super) fn write(file: impl Write + Seek, form: &Form, pixels: &Pixels) -> Result<(), String> {
    let gray = form.channels.is_gray();
    match pixels {
        Pixels::U8(v) if gray => numbers::<Gray8, _>(file, form, v),
        Pixels::U8(v) => numbers::<RGB8, _>(file, form, v),
        Pixels::U16(v) if gray => numbers::<Gray16, _>(file, form, v),
        Pixels::U16(v) => numbers::<RGB16, _>(file, form, v),
        Pixels::F32(v) if gray => numbers::<Gray32Float, _>(file, form, v),
        Pixels::F32(v) => numbers::<RGB32Float, _>(file, form, v),
    }
    .map_err(|e| e.to_string())
}

fn numbers<C: ColorType, W: Write + Seek>(
    file: W,
    form: &Form,
    values: &[C::Inner],
) -> TiffResult<()>
where
    [C::Inner]: TiffValue,
{
    let compression = Compression::Deflate(DeflateLevel::Fast);
    let mut encoder = TiffEncoder::new(file)?.with_compression(compression);
    let mut image = encoder.new_image::<C>(form.width, form.height)?;
    if matches!(form.channels, Channels::GrayAlpha | Channels::Rgba) {
        image.extra_samples(&[ExtraSamples::UnassociatedAlpha])?;
    }
    if let Some(icc) = &form.icc {
        image.encoder().write_tag(Tag::IccProfile, icc.as_slice())?;
    }
    image.write_data(values)
}
