//! `scumble spectrum`: a picture in, its frequencies out.

use crate::args::{Of, Spectrum as Options, Window as Choice};
use crate::error::Failure;
use crate::picture::{Channels, Depth, Picture, Tone};
use crate::progress::Steps;
use crate::signal::{COLOR_BYTES, Colors, Job};
use scumble::pixel::{Image, Premul, WorkingSpace};
use scumble_signal::{Channel, Spectrum, Window, plane};

/// Memory that a pixel takes: as a colour twice, as three planes and three spectra, one of them twice
/// for its columns.
const BYTES_PER_PIXEL: u64 = 2 * COLOR_BYTES + 3 * (8 + 16) + 16;

/// Does what the arguments say.
pub(crate) fn run(options: &Options) -> Result<(), Failure> {
    let job = Job::new(&options.files, &options.limits)?;
    let picture = job.read(BYTES_PER_PIXEL)?;
    let colors = job.colors(&picture, options.space.working())?;
    let levels = levels(&colors, options);
    let channels = if levels.len() == 3 { Channels::Rgb } else { Channels::Gray };
    // Levels are numbers to look at, whatever the picture's were to light.
    let shown = Picture { tone: Tone::Srgb, icc: None, ..picture };
    let result = Colors { image: drawn(&levels), space: WorkingSpace::Srgb, channels };
    job.write(&result, &shown, Depth::Eight)
}

/// The levels of the channels that are asked for, 0 to 1.
fn levels(picture: &Image<Premul>, options: &Options) -> Vec<Image<f64>> {
    let window = match options.window {
        Choice::Hann => Window::Hann,
        Choice::None => Window::None,
    };
    let channels: &[Channel] = match options.channel {
        Of::Luminance => &[Channel::Luminance],
        Of::Color => &[Channel::Red, Channel::Green, Channel::Blue],
        Of::Red => &[Channel::Red],
        Of::Green => &[Channel::Green],
        Of::Blue => &[Channel::Blue],
        Of::Alpha => &[Channel::Alpha],
    };
    let steps = Steps::new(options.files.quiet, channels.len() as u64);
    let spectrum = |&c: &Channel| {
        let spectrum = Spectrum::new(plane(picture.view(), c).view(), window);
        steps.add(1);
        spectrum
    };
    let spectra: Vec<Spectrum> = channels.iter().map(spectrum).collect();
    let peak = spectra.iter().map(Spectrum::peak).fold(0.0, f64::max);
    spectra.iter().map(|spectrum| spectrum.decibels(peak, options.range)).collect()
}

/// The levels as colours.
fn drawn(levels: &[Image<f64>]) -> Image<Premul> {
    let Some(first) = levels.first() else { return Image::default() };
    let pixel = |x: usize, y: usize| {
        let level = |c: usize| levels.get(c).unwrap_or(first).row(y)[x] as f32;
        Premul([level(0), level(1), level(2), 1.0])
    };
    Image::from_fn(first.width(), first.height(), pixel).unwrap_or_default()
}
