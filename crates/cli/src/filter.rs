//! `scumble filter`: a picture in, some of its frequencies out.

use crate::args::{self, Convolution, Filter as Options};
use crate::error::Failure;
use crate::progress::Steps;
use crate::signal::{COLOR_BYTES, Colors, Job};
use scumble::pixel::{Image, Premul};
use scumble_signal::{
    Band, Border, Kernel2, Shape, SignalError, Tiling, band_filter, convolve, convolve_separable,
    map_channels,
};

/// Memory that a pixel takes for a convolution: as a colour three times, four planes, and two of work.
const SPACE_BYTES: u64 = 3 * COLOR_BYTES + 4 * 8 + 2 * 8;

/// What a transform takes beside: a spectrum, its copy, and columns.
const SPECTRUM_BYTES: u64 = 3 * 16;

/// Channels that are filtered, one after another.
const CHANNELS: u64 = 4;

/// A filter ready to be applied.
enum Work {
    Band(Band, Shape, Tiling),
    Convolution(Convolution, Border),
}

/// Does what the arguments say.
pub(crate) fn run(options: &Options) -> Result<(), Failure> {
    let work = Work::new(options)?;
    let job = Job::new(&options.files, &options.limits)?;
    let picture = job.read(work.bytes_per_pixel())?;
    let space = options.space.working();
    let colors = job.colors(&picture, space)?;
    let steps = Steps::new(options.files.quiet, CHANNELS);
    let filtered = work.apply(&colors, &steps).map_err(|e| Failure::Usage(e.to_string()))?;
    steps.clear();
    let opaque = work.is_about_zero() || picture.is_opaque();
    let offset = options.offset.unwrap_or(if work.is_about_zero() { 0.5 } else { 0.0 }) as f32;
    let image = filtered.map(|&Premul([r, g, b, a])| {
        Premul([r + offset, g + offset, b + offset, if opaque { 1.0 } else { a }])
    });
    let channels = if opaque { picture.channels.without_alpha() } else { picture.channels };
    job.write(&Colors { image, space, channels }, &picture, picture.origin.depth)
}

impl Work {
    fn new(options: &Options) -> Result<Self, Failure> {
        if let Some(kernel) = &options.kernel {
            let border = match options.border {
                args::Border::Mirror => Border::Mirror,
                args::Border::Repeat => Border::Repeat,
                args::Border::Clamp => Border::Clamp,
            };
            return Ok(Self::Convolution(kernel.clone(), border));
        }
        let tiling = match options.border {
            args::Border::Mirror => Tiling::Mirror,
            args::Border::Repeat => Tiling::Repeat,
            args::Border::Clamp => {
                let why = "--border clamp: a band of frequencies is of a picture that goes on \
                           for ever, by mirror or repeat";
                return Err(Failure::Usage(why.to_owned()));
            }
        };
        let band = match (options.low_pass, options.band_pass, options.high_pass) {
            (Some(cutoff), ..) => Band::LowPass(cutoff),
            (_, Some([low, high]), _) => Band::BandPass(low, high),
            (.., high) => Band::HighPass(high.unwrap_or_default()),
        };
        let shape = if options.gaussian { Shape::Gaussian } else { Shape::Ideal };
        Ok(Self::Band(band, shape, tiling))
    }

    fn bytes_per_pixel(&self) -> u64 {
        SPACE_BYTES
            + match self {
                Self::Convolution(..) => 0,
                Self::Band(.., Tiling::Repeat) => SPECTRUM_BYTES,
                // The picture and its three mirror images.
                Self::Band(.., Tiling::Mirror) => 4 * (SPECTRUM_BYTES + 2 * 8),
            }
    }

    /// Whether a constant picture becomes zero.
    fn is_about_zero(&self) -> bool {
        match self {
            Self::Band(Band::LowPass(_), ..) | Self::Convolution(Convolution::Separable(_), _) => {
                false
            }
            Self::Band(..) => true,
            Self::Convolution(Convolution::Matrix { weights, .. }, _) => cancels(weights),
        }
    }

    /// The picture filtered; a channel is a step.
    fn apply(&self, picture: &Image<Premul>, steps: &Steps) -> Result<Image<Premul>, SignalError> {
        type Plane = Image<f64>;
        let channels = |filter: &dyn Fn(&Plane) -> Result<Plane, SignalError>| {
            map_channels(picture.view(), |plane| {
                let filtered = filter(plane);
                steps.add(1);
                filtered
            })
        };
        match self {
            Self::Band(band, shape, tiling) => {
                channels(&|p| band_filter(p.view(), *band, *shape, *tiling))
            }
            Self::Convolution(Convolution::Separable(kernel), border) => {
                channels(&|p| Ok(convolve_separable(p.view(), kernel, kernel, *border)))
            }
            Self::Convolution(Convolution::Matrix { columns, weights }, border) => {
                let rows = weights.len() / columns.max(&1);
                let make = if cancels(weights) { Kernel2::new } else { Kernel2::normalized };
                let kernel = make(*columns, rows, weights.clone())?;
                channels(&|p| Ok(convolve(p.view(), &kernel, *border)))
            }
        }
    }
}

/// Whether weights sum to nothing but rounding.
fn cancels(weights: &[f64]) -> bool {
    let (sum, size) = weights.iter().fold((0.0, 0.0), |(s, a), w: &f64| (s + w, a + w.abs()));
    sum.abs() <= 1e-12 * size
}
