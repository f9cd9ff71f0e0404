//! The arguments of `spectrum` and `filter`.

use super::{Depth, ReadLimits, Space};
use clap::{Args, ValueEnum, ValueHint};
use scumble_signal::Kernel;
use std::path::PathBuf;

/// What to look at, and how.
#[derive(Debug, Args)]
#[command(after_long_help = SPECTRUM_EXAMPLES)]
pub(crate) struct Spectrum {
    #[command(flatten)]
    pub(crate) files: InOut,

    /// What the picture is multiplied by first: hann takes away the cross that borders make
    #[arg(long, value_enum, default_value_t = Window::Hann)]
    pub(crate) window: Window,

    /// Decibels from white, the largest amplitude, down to black; 20 are a factor of ten
    #[arg(long, value_name = "DB", default_value_t = 100.0, value_parser = decibels)]
    pub(crate) range: f64,

    /// Of what the spectrum is: one channel in grey, or red, green and blue in their colours
    #[arg(long, value_enum, default_value_t = Of::Luminance)]
    pub(crate) channel: Of,

    /// The space whose values are transformed
    #[arg(long, value_enum, default_value_t = Space::Srgb)]
    pub(crate) space: Space,

    #[command(flatten)]
    pub(crate) limits: ReadLimits,
}

const SPECTRUM_EXAMPLES: &str = "\
The spectrum has the picture's size, and frequency zero in its middle: at column ⌊w/2⌋, row ⌊h/2⌋, from \
0. A pixel one column to the right stands for one cycle more across the picture.

Examples:
  scumble spectrum photo.jpg spectrum.png
  scumble spectrum tile.png spectrum.png --window none   for a picture that tiles
  scumble spectrum photo.jpg spectrum.png --channel color --range 80";

/// What to keep of a picture.
#[derive(Debug, Args)]
#[command(after_long_help = FILTER_EXAMPLES, group = clap::ArgGroup::new("what").required(true))]
#[command(allow_negative_numbers = true)]
pub(crate) struct Filter {
    #[command(flatten)]
    pub(crate) files: InOut,

    /// Keep what is coarser than C cycles per pixel; ½ is the finest along an axis
    #[arg(long, value_name = "C", group = "what", value_parser = cutoff)]
    pub(crate) low_pass: Option<f64>,

    /// Keep what lies between A and B cycles per pixel
    #[arg(long, value_name = "A,B", group = "what", value_parser = band)]
    pub(crate) band_pass: Option<[f64; 2]>,

    /// Keep what is finer than C cycles per pixel
    #[arg(long, value_name = "C", group = "what", value_parser = cutoff)]
    pub(crate) high_pass: Option<f64>,

    /// Convolve with box:WIDTH, triangle:RADIUS, gaussian:SIGMA, mitchell:SCALE, or rows of weights:
    /// matrix:1,2,1/2,4,2/1,2,1
    ///
    /// In pixels, decimals allowed. A matrix has odd numbers of rows and columns; its weights are
    /// divided by their sum, unless that is 0.
    #[arg(long, value_name = "KERNEL", group = "what", value_parser = convolution)]
    pub(crate) kernel: Option<Convolution>,

    /// Let a band end as Gaussians do, ½ at its cutoff, instead of at once: no ringing
    #[arg(long, conflicts_with = "kernel")]
    pub(crate) gaussian: bool,

    /// What lies beyond the picture's border; a band cannot be clamped
    #[arg(long, value_enum, default_value_t = Border::Mirror)]
    pub(crate) border: Border,

    /// What is added, for results about zero to be seen [default: 0.5 for them, else 0]
    #[arg(long, value_name = "VALUE", value_parser = offset)]
    pub(crate) offset: Option<f64>,

    /// The space whose values are filtered
    #[arg(long, value_enum, default_value_t = Space::Srgb)]
    pub(crate) space: Space,

    #[command(flatten)]
    pub(crate) limits: ReadLimits,
}

const FILTER_EXAMPLES: &str = "\
Low-passes and kernels act on alpha as on colour. What a band-pass, a high-pass or a matrix that sums to 0 \
gives is about zero; it is shown about ½, opaque. Depth and ICC profile are kept where the format of the \
result can carry them, and EXIF orientation is applied. Floats below 0 and above 1 stay.

Examples:
  scumble filter photo.jpg soft.png --low-pass 0.1 --gaussian
  scumble filter photo.jpg edges.png --high-pass 0.2
  scumble filter photo.jpg blurred.png --kernel box:3 --space linear
  scumble filter photo.jpg sobel.png --kernel matrix:-1,0,1/-2,0,2/-1,0,1";

/// A picture in and a picture out.
#[derive(Debug, Args)]
pub(crate) struct InOut {
    /// The picture: PNG, JPEG, WebP, TIFF or OpenEXR; `-` is standard input
    #[arg(value_name = "IN", value_hint = ValueHint::FilePath)]
    pub(crate) input: PathBuf,

    /// The result, in the format that its ending says; `-` is standard output, a PNG
    #[arg(value_name = "OUT", value_hint = ValueHint::FilePath)]
    pub(crate) output: PathBuf,

    /// Replace what stands in the result's place, whatever it is
    #[arg(long)]
    pub(crate) force: bool,

    /// The numbers of the result [default: as the picture's, or the nearest that the format has; of
    /// a spectrum, 8]
    #[arg(long, value_enum)]
    pub(crate) depth: Option<Depth>,

    /// Say nothing but errors
    #[arg(short, long)]
    pub(crate) quiet: bool,
}

/// What a picture is multiplied by before its spectrum is taken.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub(crate) enum Window {
    /// A raised cosine
    Hann,
    /// Nothing
    None,
}

/// Of what a spectrum is.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub(crate) enum Of {
    /// All three colours, weighed as the eye does
    Luminance,
    /// Each colour, in its own
    Color,
    /// Red
    Red,
    /// Green
    Green,
    /// Blue
    Blue,
    /// Alpha
    Alpha,
}

/// What lies beyond a picture's border.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub(crate) enum Border {
    /// The picture turned over
    Mirror,
    /// The picture again
    Repeat,
    /// Its outermost pixels
    Clamp,
}

/// What to convolve with.
#[derive(Debug, Clone, PartialEq)]
pub(crate) enum Convolution {
    /// The same along rows and columns.
    Separable(Kernel),
    /// Weights as they were given, in rows of so many.
    Matrix {
        /// Weights in a row.
        columns: usize,
        /// All of them.
        weights: Vec<f64>,
    },
}

/// A frequency in cycles per pixel.
fn cutoff(text: &str) -> Result<f64, String> {
    match text.parse::<f64>() {
        Ok(value) if value >= 0.0 => Ok(value),
        _ => Err("not a number of cycles per pixel, 0 or more".to_owned()),
    }
}

/// Two frequencies, the lower first.
fn band(text: &str) -> Result<[f64; 2], String> {
    let (low, high) = text.split_once(',').ok_or("not two frequencies A,B")?;
    let (low, high) = (cutoff(low.trim())?, cutoff(high.trim())?);
    if low <= high { Ok([low, high]) } else { Err("the band ends before it begins".to_owned()) }
}

/// A positive number of decibels.
fn decibels(text: &str) -> Result<f64, String> {
    match text.parse::<f64>() {
        Ok(value) if value > 0.0 && value.is_finite() => Ok(value),
        _ => Err("not a number of decibels above 0".to_owned()),
    }
}

/// A number to add.
fn offset(text: &str) -> Result<f64, String> {
    text.parse().ok().filter(|v: &f64| v.is_finite()).ok_or_else(|| "not a number".to_owned())
}

/// A kernel and its size, or a matrix.
fn convolution(text: &str) -> Result<Convolution, String> {
    let kernels = "not box:W, triangle:R, gaussian:S, mitchell:S or matrix:…";
    let (name, rest) = text.split_once(':').ok_or(kernels)?;
    let make = match name {
        "box" => Kernel::rectangle,
        "triangle" => Kernel::triangle,
        "gaussian" => Kernel::gaussian,
        "mitchell" => Kernel::mitchell,
        "matrix" => return matrix(rest),
        _ => return Err(kernels.to_owned()),
    };
    let size = rest.parse().map_err(|_| format!("`{rest}` is no number"))?;
    make(size).map(Convolution::Separable).map_err(|e| e.to_string())
}

fn matrix(text: &str) -> Result<Convolution, String> {
    let number = |s: &str| offset(s.trim()).map_err(|e| format!("`{s}`: {e}"));
    let mut weights = Vec::new();
    let (mut columns, mut rows) = (0, 0);
    for row in text.split('/') {
        let row = row.split(',').map(number).collect::<Result<Vec<_>, _>>()?;
        if rows > 0 && row.len() != columns {
            return Err("the rows differ in length".to_owned());
        }
        columns = row.len();
        rows += 1;
        weights.extend(row);
    }
    if columns % 2 == 0 || rows % 2 == 0 {
        return Err(
            "rows and columns must be odd in number, for one weight to be in the middle".to_owned()
        );
    }
    Ok(Convolution::Matrix { columns, weights })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn kernels_are_a_name_and_a_size() {
        assert_eq!(
            convolution("box:3"),
            Ok(Convolution::Separable(Kernel::rectangle(3.0).unwrap()))
        );
        let weights = vec![1.0, -2.0, 1.5];
        assert_eq!(
            convolution("matrix:1, -2,1.5"),
            Ok(Convolution::Matrix { columns: 3, weights })
        );
        for text in ["", "box", "box:", "box:x", "box:-1", "disc:3", "matrix:", "matrix:1,2,nan"] {
            assert!(convolution(text).is_err(), "{text}");
        }
        assert!(convolution("matrix:1,2,3/4,5").is_err_and(|e| e.contains("differ")));
    }

    #[test]
    fn bands_are_in_order() {
        assert_eq!(band("0.1, 0.2"), Ok([0.1, 0.2]));
        for text in ["", "0.1", "0.2,0.1", "-1,2", "0,nan", "0.1,0.2,0.3"] {
            assert!(band(text).is_err(), "{text}");
        }
    }

    proptest::proptest! {
        #[test]
        fn any_text_is_read_or_refused(text in "[-+0-9.,:/eKa-z ½]{0,24}") {
            let _ = (cutoff(&text), band(&text), decibels(&text), offset(&text));
            let _ = (convolution(&text), convolution(&format!("matrix:{text}")));
        }
    }
}
