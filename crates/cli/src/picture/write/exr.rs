//! OpenEXR, compressed without loss.

use super::Form;
use crate::picture::{Channels, Depth};
use ::exr::image::{AnyChannel, AnyChannels, Encoding, FlatSamples, Image, Layer};
use ::exr::meta::header::LayerAttributes;
use ::exr::prelude::{WritableImage, f16};
use std::io::{Seek, Write};

pub(super) fn write(file: impl Write + Seek, form: &Form, values: &[f32]) -> Result<(), String> {
    let names: &[&str] = match form.channels {
        Channels::Gray => &["Y"],
        Channels::GrayAlpha => &["Y", "A"],
        Channels::Rgb => &["R", "G", "B"],
        Channels::Rgba => &["R", "G", "B", "A"],
    };
    let channel = |(c, name): (usize, &&str)| {
        let values = values.iter().skip(c).step_by(names.len()).copied();
        let samples = match form.depth {
            Depth::Half => FlatSamples::F16(values.map(f16::from_f32).collect()),
            _ => FlatSamples::F32(values.collect()),
        };
        AnyChannel::new(*name, samples)
    };
    let channels = AnyChannels::sort(names.iter().enumerate().map(channel).collect());
    let size = (form.width as usize, form.height as usize);
    let layer = Layer::new(size, LayerAttributes::default(), Encoding::SMALL_LOSSLESS, channels);
    let image = Image::from_layer(layer);
    image.write().non_parallel().to_buffered(file).map_err(|e| e.to_string())
}
