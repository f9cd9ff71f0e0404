//! OpenEXR: the first layer of a file that is not deep.

use super::{Budget, Refusal, Stored, reserve};
use crate::picture::{Channels, Depth, Pixels};
use ::exr::block::samples::IntoNativeSample;
use ::exr::error::Error;
use ::exr::image::{AnyChannel, AnyChannels, FlatSamples};
use ::exr::meta::MetaData;
use ::exr::meta::header::Header;
use ::exr::prelude::{ReadChannels, ReadLayers, read as reader};
use std::io::Cursor;

pub(super) fn read(data: &[u8], budget: &Budget) -> Result<Stored, Refusal> {
    let meta = MetaData::read_from_buffered(Cursor::new(data), false).map_err(bad)?;
    let header = meta.headers.iter().find(|h| !h.deep);
    let header = header.ok_or_else(|| Refusal::Bad("deep pixels are not read".to_owned()))?;
    check(header, budget)?;

    let image = reader()
        .no_deep_data()
        .largest_resolution_level()
        .all_channels()
        .first_valid_layer()
        .all_attributes()
        .non_parallel()
        .from_buffered(Cursor::new(data))
        .map_err(bad)?;
    let layer = image.layer_data;
    let (width, height) = (layer.size.x(), layer.size.y());
    let (channels, list) = choose(&layer.channel_data)?;
    let half = list.iter().all(|c| matches!(c.sample_data, FlatSamples::F16(_)));
    let depth = if half { Depth::Half } else { Depth::Float };
    let pixels = woven(&list, width * height)?;

    let mut notes = Vec::new();
    if meta.headers.len() > 1 {
        notes.push("it holds several layers; the first is read".to_owned());
    }
    let window = image.attributes.display_window;
    if window.size != layer.size || window.position != layer.attributes.layer_position {
        notes.push("its data window, which is read, is not its display window".to_owned());
    }
    let side = |n: usize| u32::try_from(n).map_err(|_| Refusal::Bad("it is too long".to_owned()));
    Ok(Stored {
        width: side(width)?,
        height: side(height)?,
        channels,
        pixels: Pixels::F32(pixels),
        premultiplied: true,
        depth,
        icc: None,
        orientation: 1,
        notes,
    })
}

/// Refuses before anything is allocated what is too large or laid out in ways that are not read.
fn check(header: &Header, budget: &Budget) -> Result<(), Refusal> {
    let (width, height) = (header.layer_size.x() as u64, header.layer_size.y() as u64);
    let list = &header.channels.list;
    // The channels apart and together, four bytes each.
    budget.check(width, height, list.len() as u64, 8)?;
    if list.iter().any(|c| c.sampling.x() != 1 || c.sampling.y() != 1) {
        return Err(Refusal::Bad("luminance with sparse chroma is not read".to_owned()));
    }
    Ok(())
}

/// The channels of colour among those that there are.
fn choose(
    all: &AnyChannels<FlatSamples>,
) -> Result<(Channels, Vec<&AnyChannel<FlatSamples>>), Refusal> {
    let find = |name: &str| all.list.iter().find(|c| c.name.eq_case_insensitive(name));
    let alpha = find("A");
    if let (Some(r), Some(g), Some(b)) = (find("R"), find("G"), find("B")) {
        let channels = if alpha.is_some() { Channels::Rgba } else { Channels::Rgb };
        return Ok((channels, [r, g, b].into_iter().chain(alpha).collect()));
    }
    if let Some(y) = find("Y").or(all.list.first().filter(|_| all.list.len() == 1)) {
        let alpha = alpha.filter(|a| a.name != y.name);
        let channels = if alpha.is_some() { Channels::GrayAlpha } else { Channels::Gray };
        return Ok((channels, [y].into_iter().chain(alpha).collect()));
    }
    let names: Vec<String> = all.list.iter().map(|c| c.name.to_string()).collect();
    Err(Refusal::Bad(format!("its channels are {}; neither R, G, B nor Y", names.join(", "))))
}

/// The numbers of the channels, pixel by pixel.
fn woven(list: &[&AnyChannel<FlatSamples>], count: usize) -> Result<Vec<f32>, Refusal> {
    let n = list.len();
    let mut values = Vec::new();
    reserve(&mut values, count * n)?;
    values.resize(count * n, 0.0);
    for (c, channel) in list.iter().enumerate() {
        let out = values.iter_mut().skip(c).step_by(n);
        match &channel.sample_data {
            FlatSamples::F16(v) => out.zip(v).for_each(|(out, v)| *out = v.to_f32()),
            FlatSamples::F32(v) => out.zip(v).for_each(|(out, v)| *out = *v),
            FlatSamples::U32(v) => out.zip(v).for_each(|(out, v)| *out = v.to_f32()),
        }
    }
    Ok(values)
}

fn bad(error: Error) -> Refusal {
    match error {
        Error::Io(e) => Refusal::Bad(super::reading(&e)),
        Error::Invalid(what) => Refusal::Bad(format!("damaged or cut off: {what}")),
        Error::NotSupported(what) => Refusal::Bad(format!("not read: {what}")),
        Error::Aborted => Refusal::Bad("aborted".to_owned()),
    }
}
