//! `scumble spectrum`: a picture in, its frequencies out.

use crate::args::{Of, Spectrum as Options, Window as Choice};
use crate::error::Failure;
use crate::input::Source;
use crate::interrupt::Interrupt;
use crate::output::{Request, Target};
use crate::plain;
use scumble::pixel::{Image, Premul, unorm8};
use scumble_signal::{Channel, Spectrum, Window, plane};

/// Memory that a pixel takes: as eight bits, as colour, as three planes and three spectra, one of
/// them twice for its columns.
const BYTES_PER_PIXEL: u64 = 4 + 16 + 3 * (8 + 16) + 16;

/// Does what the arguments say.
pub(crate) fn run(options: &Options) -> Result<(), Failure> {
    let interrupt = Interrupt::install()?;
    let source = Source::new(&options.files.input);
    let out = Some(options.files.output.as_path());
    let target = Target::new(&Request { out, force: options.files.force, json: false }, &source)?;
    let space = options.space.working();
    let picture =
        plain::read(&source, &options.memory, BYTES_PER_PIXEL)?.map(|&c| space.import8(c));
    plain::write(&draw(&picture, options), &target, &interrupt)
}

fn draw(picture: &Image<Premul>, options: &Options) -> Image<[u8; 4]> {
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
    let spectrum = |&c: &Channel| Spectrum::new(plane(picture.view(), c).view(), window);
    let spectra: Vec<Spectrum> = channels.iter().map(spectrum).collect();
    let peak = spectra.iter().map(Spectrum::peak).fold(0.0, f64::max);
    let levels: Vec<Image<f64>> =
        spectra.iter().map(|spectrum| spectrum.decibels(peak, options.range)).collect();
    let code = |channel: usize, x: usize, y: usize| unorm8(levels[channel].row(y)[x] as f32);
    let pixel = |x: usize, y: usize| match levels.len() {
        3 => [code(0, x, y), code(1, x, y), code(2, x, y), 255],
        _ => [code(0, x, y), code(0, x, y), code(0, x, y), 255],
    };
    Image::from_fn(picture.width(), picture.height(), pixel).unwrap_or_default()
}
