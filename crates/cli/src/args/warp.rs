//! The arguments of `scumble warp`.

use super::{Crop, Limits, Report, Space, value};
use crate::picture;
use clap::{ArgGroup, Args, ValueEnum, ValueHint};
use scumble::geometry::{DVec2, Homography};
use scumble::pixel::Straight;
use scumble::texture::{Kernel, Magnify};
use scumble::warp::Border;
use std::path::PathBuf;

/// What to warp, and how.
#[derive(Debug, Args)]
#[command(long_about = ABOUT, after_long_help = EXAMPLES, after_help = super::MORE)]
#[command(group = ArgGroup::new("way").required(true))]
pub(crate) struct Warp {
    /// The picture to warp: PNG, JPEG, WebP, TIFF or OpenEXR; `-` is standard input
    #[arg(value_hint = ValueHint::FilePath, value_name = "IN")]
    pub(crate) input: PathBuf,

    /// The result, in the format that its ending says; `-` is standard output, a PNG
    ///
    /// Left out, it is the name of IN with the ending .png in the current directory, and an existing
    /// file of that name stays unless --force is given.
    #[arg(value_hint = ValueHint::FilePath, conflicts_with = "output")]
    pub(crate) out: Option<PathBuf>,

    /// The result, the same as OUT
    #[arg(short, long = "output", value_name = "OUT", value_hint = ValueHint::FilePath)]
    pub(crate) output: Option<PathBuf>,

    /// Replace what stands in the result's place, whatever it is
    #[arg(long)]
    pub(crate) force: bool,

    #[command(flatten)]
    pub(crate) way: Way,
    #[command(flatten)]
    pub(crate) filter: Filter,
    #[command(flatten)]
    pub(crate) limits: Limits,
    #[command(flatten)]
    pub(crate) report: Report,

    /// Compare some ten thousand pixels with brute force and say how far they are off
    ///
    /// The PSNR of encoded values against the mean under a Gaussian pixel (sigma 1/2, what the filter
    /// aims at) and over a square one, and the worst pixel. Pixels whose footprint leaves the picture
    /// count apart. It takes seconds.
    #[arg(long, help_heading = "Report")]
    pub(crate) verify: bool,
}

const ABOUT: &str = "\
Warp a picture: every pixel of the result is the average of what it sees of the source

One of --to, --matrix, --rectify and --map says where things go. Depth, ICC profile and alpha are kept \
where the format of the result can carry them. EXIF orientation is applied first: coordinates are those \
of the upright picture. The same picture and options give the same bytes on every machine and any \
number of threads.";

const EXAMPLES: &str = "\
Examples:
  scumble warp poster.png out.png --to \"330,60 900,20 1180,690 240,700\" --size 1280x720
                                      the corners of the poster go to four points
  scumble warp page.jpg page.png --rectify \"310,220 890,160 1010,930 180,820\" --magnify catmull-rom
                                      a page in a photo, straight, its aspect recovered
  scumble warp a.png b.png --matrix 0.5,0,0,0,0.5,0,0,0,1 --verify
                                      half the size, and how exact that is
  scumble warp a.png b.png --matrix \"$M\" --pixel-origin center --border clamp
                                      a matrix made for OpenCV
  scumble warp fisheye.png flat.tif --map flat.exr --magnify catmull-rom

Exit status:
  0 done · 1 failure · 2 wrong arguments · 3 a limit was hit · 130 interrupted
  A picture appears whole or not at all: it is written beside its place and renamed.";

/// Where things go.
#[derive(Debug, Args)]
#[command(next_help_heading = "Way")]
pub(crate) struct Way {
    /// Four points of the result to which the corners of the picture go: top left, top right, bottom
    /// right, bottom left
    #[arg(long, group = "way", value_name = POINTS, value_parser = quad, allow_hyphen_values = true)]
    pub(crate) to: Option<Quad>,

    /// Four points of the picture that go to those of --to [default: its corners]
    #[arg(long, requires = "to", value_name = POINTS, value_parser = quad, allow_hyphen_values = true)]
    pub(crate) from: Option<Quad>,

    /// A 3×3 matrix, row by row, from the picture to the result, as OpenCV and ImageMagick mean it
    #[arg(long, group = "way", value_name = "a,b,c,d,e,f,g,h,i", value_parser = matrix, allow_hyphen_values = true)]
    pub(crate) matrix: Option<Homography>,

    /// The matrix is from the result to the picture
    #[arg(long, requires = "matrix")]
    pub(crate) inverse: bool,

    /// The corners of a page or a facade in a photo, top left first and then clockwise: it comes out
    /// straight
    ///
    /// The ratio of its sides comes from the perspective, for a photo that has not been cropped; where
    /// that says too little, from the sides as they appear. Corners that are a few pixels off cost no
    /// sharpness. Where the page is enlarged, --magnify catmull-rom keeps print crisper.
    #[arg(long, group = "way", value_name = POINTS, value_parser = quad, allow_hyphen_values = true)]
    pub(crate) rectify: Option<Quad>,

    /// A picture of floats (OpenEXR, TIFF) as large as the result: red and green are the column and
    /// the row of the picture that each pixel shows; `-` is standard input
    ///
    /// Coordinates are absolute, in pixels, as --pixel-origin says; columns go right and rows down.
    /// Where one is not finite, or an alpha is below a half, there is nothing: the result is transparent,
    /// pixel by pixel, without a soft edge. For one, let the map go on beyond the edge of the picture, which
    /// --border then ends softly.
    #[arg(long, group = "way", value_name = "MAP", value_hint = ValueHint::FilePath)]
    pub(crate) map: Option<PathBuf>,

    /// Size of the result [default: auto, which holds the whole of what --to or --matrix show right of
    /// and below the origin, loses nothing of what --rectify sees, and is the map's]
    #[arg(long, value_name = "WxH|auto", value_parser = size)]
    pub(crate) size: Option<Size>,

    /// Make only this part of the result, in pixels from its top left corner
    #[arg(long, value_name = "X,Y,W,H", value_parser = value::crop)]
    pub(crate) crop: Option<Crop>,

    /// Where the coordinates of pixels are whole numbers: at their top left corners, or in their
    /// centres, as OpenCV has it
    #[arg(long, value_enum, default_value_t = PixelOrigin::Corner)]
    pub(crate) pixel_origin: PixelOrigin,
}

const POINTS: &str = "x,y x,y x,y x,y";

/// How pixels are made.
#[derive(Debug, Args)]
#[command(next_help_heading = "Filter")]
pub(crate) struct Filter {
    /// How well the picture is filtered: `fast` for previews, `high` for print, `reference` for tests
    /// and `classic`, the enhanced EWA of 2009, for comparison
    #[arg(long, value_name = "PRESET", default_value = "default", value_parser = value::preset())]
    pub(crate) quality: &'static str,

    /// What texels are weighed by [default: the quality's; gaussian, and triangle for classic]
    ///
    /// All but the Gaussian are slower. `box` is the mean over the pixel's square, to compare with area
    /// averaging.
    #[arg(long, value_parser = value::kernel())]
    pub(crate) kernel: Option<Kernel>,

    /// What is made of a picture that is magnified: `taps` is what a pixel sees of bilinear interpolation
    /// (of the Gaussian kernel only), `none` is softer, the others are sharper [default: the quality's: taps]
    #[arg(long, value_name = "WAY", value_parser = value::magnify())]
    pub(crate) magnify: Option<Magnify>,

    /// What lies beyond the edge of the picture: `transparent`, `clamp`, `repeat`, `mirror` or a CSS
    /// colour; what lies behind a horizon is transparent
    #[arg(long, default_value = "transparent", value_parser = border)]
    pub(crate) border: Border,

    /// The space in which colours are averaged
    #[arg(long, value_enum, default_value_t = Space::Linear)]
    pub(crate) space: Space,

    /// The numbers of the result [default: as the picture's, or the nearest that the format has]
    #[arg(long, value_enum)]
    pub(crate) depth: Option<Depth>,
}

/// Where the coordinates of pixels are whole numbers.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub(crate) enum PixelOrigin {
    /// At their top left corners
    Corner,
    /// In their centres
    Center,
}

/// What the numbers of a file are.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub(crate) enum Depth {
    /// Whole numbers of 8 bits
    #[value(name = "8")]
    Eight,
    /// Whole numbers of 16 bits
    #[value(name = "16")]
    Sixteen,
    /// Floats of 32 bits
    Float,
}

impl Depth {
    /// What a file calls it.
    pub(crate) fn stored(self) -> picture::Depth {
        match self {
            Self::Eight => picture::Depth::Eight,
            Self::Sixteen => picture::Depth::Sixteen,
            Self::Float => picture::Depth::Float,
        }
    }
}

/// Four points.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Quad(pub(crate) [DVec2; 4]);

/// How large the result is.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Size {
    Auto,
    Pixels(u32, u32),
}

/// Numbers that are separated by commas, blanks or both.
fn numbers<const N: usize>(text: &str, what: &str) -> Result<[f64; N], String> {
    let words = text.split(|c: char| c == ',' || c == ';' || c.is_whitespace());
    let words = words.filter(|w| !w.is_empty());
    let number = |w: &str| match w.parse::<f64>() {
        Ok(v) if v.is_finite() => Ok(v),
        _ => Err(format!("`{w}` is not a number")),
    };
    let found = words.map(number).collect::<Result<Vec<_>, _>>()?;
    let count = found.len();
    found.try_into().map_err(|_| format!("{count} numbers; {what}"))
}

fn quad(text: &str) -> Result<Quad, String> {
    let [a, b, c, d, e, f, g, h] = numbers(text, "four points x,y are eight")?;
    Ok(Quad([(a, b), (c, d), (e, f), (g, h)].map(|(x, y)| DVec2::new(x, y))))
}

fn matrix(text: &str) -> Result<Homography, String> {
    let [a, b, c, d, e, f, g, h, i] = numbers(text, "a matrix has nine")?;
    Ok(Homography::new([[a, b, c], [d, e, f], [g, h, i]]))
}

fn size(text: &str) -> Result<Size, String> {
    if text == "auto" {
        return Ok(Size::Auto);
    }
    let (w, h) = text.split_once(['x', 'X', '×']).ok_or("neither `auto` nor such as 1280x720")?;
    Ok(Size::Pixels(value::length(w)?, value::length(h)?))
}

fn border(text: &str) -> Result<Border, String> {
    Ok(match text {
        "clamp" => Border::Clamp,
        "repeat" => Border::Repeat,
        "mirror" => Border::Mirror,
        _ => match value::background(text) {
            Ok(value::Background::Transparent) => Border::Transparent,
            Ok(value::Background::Color(color)) => Border::Constant(Straight(color)),
            Err(_) => {
                return Err(
                    "neither transparent, clamp, repeat, mirror nor a CSS colour".to_owned()
                );
            }
        },
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn points_are_eight_numbers() {
        let expected = [(1.0, 2.0), (-3.5, 4.0), (5.0, 6e2), (7.0, 8.0)];
        let expected = Quad(expected.map(|(x, y)| DVec2::new(x, y)));
        assert_eq!(quad("1,2 -3.5,4 5,6e2 7,8"), Ok(expected));
        assert_eq!(quad(" 1 2, -3.5 4;5,600,7,8 "), Ok(expected));
        assert_eq!(quad("1,2 3,4"), Err("4 numbers; four points x,y are eight".to_owned()));
        assert_eq!(quad("1,2 3,4 5,6 7,x"), Err("`x` is not a number".to_owned()));
        assert_eq!(quad("1,2 3,4 5,6 7,nan"), Err("`nan` is not a number".to_owned()));
    }

    #[test]
    fn matrices_are_nine() {
        let found = matrix("1,2,3 4,5,6 7,8,-9").unwrap();
        assert_eq!(found.m, [[1.0, 2.0, 3.0], [4.0, 5.0, 6.0], [7.0, 8.0, -9.0]]);
        assert!(matrix("1,0,0,0,1,0").is_err());
    }

    #[test]
    fn sizes_and_borders() {
        assert_eq!(size("auto"), Ok(Size::Auto));
        assert_eq!(size("640x480"), Ok(Size::Pixels(640, 480)));
        assert!(["", "640", "0x3", "3x", "-1x2"].iter().all(|t| size(t).is_err()));
        assert_eq!(border("mirror"), Ok(Border::Mirror));
        assert_eq!(border("#f00"), Ok(Border::Constant(Straight([1.0, 0.0, 0.0, 1.0]))));
        assert_eq!(border("none"), Ok(Border::Transparent));
        assert!(border("mirrored").is_err());
    }
}
