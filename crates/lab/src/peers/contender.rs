//! The programs, and how each is asked to warp.

use super::PeersError;
use super::truth::Pixel;
use crate::quality::{SIZE, Source, warps};
use crate::timing::clock;
use scumble::texture::{Decimation, Levels, Texture, TextureOptions};
use scumble_geometry::Homography;
use scumble_pixel::{Image, WorkingSpace};
use serde_json::Value;
use std::path::{Path, PathBuf};
use std::process::Command;

/// Where the programs are.
#[derive(Debug, Clone)]
pub struct Programs {
    /// Our command.
    pub scumble: PathBuf,
    /// A Python that may know OpenCV.
    pub python: PathBuf,
    /// ImageMagick's command.
    pub magick: PathBuf,
}

/// One way of one program.
#[derive(Debug)]
pub(super) struct Contender {
    pub(super) name: &'static str,
    how: How,
}

#[derive(Debug)]
enum How {
    /// Arguments to `scumble warp`.
    Scumble(&'static [&'static str]),
    /// The method of the script.
    OpenCv(&'static str),
    /// The filter's name; empty for its own choice.
    Magick(&'static str),
}

const fn contender(name: &'static str, how: How) -> Contender {
    Contender { name, how }
}

/// Those that make a picture smaller.
static REDUCERS: [Contender; 7] = [
    contender("`fast`", How::Scumble(&["--quality", "fast"])),
    contender("`default`", How::Scumble(&["--quality", "default"])),
    contender("`high`", How::Scumble(&["--quality", "high"])),
    contender(OPENCV_LINEAR, How::OpenCv("linear")),
    contender("OpenCV 3×3, Gaussian weights", How::OpenCv("gaussian:3")),
    contender(OPENCV_GAUSSIAN_4, How::OpenCv("gaussian:4")),
    contender("ImageMagick Gaussian", How::Magick("Gaussian")),
];

/// Those that make it larger.
static ENLARGERS: [Contender; 7] = [
    contender("`default`", How::Scumble(&["--quality", "default"])),
    contender(BILINEAR, How::Scumble(&["--magnify", "bilinear"])),
    contender(CATMULL_ROM, How::Scumble(&["--magnify", "catmull-rom"])),
    contender(CATMULL_ROM_16, How::Scumble(&["--magnify", "catmull-rom", "--depth", "16"])),
    contender(OPENCV_LINEAR, How::OpenCv("linear")),
    contender(OPENCV_CUBIC, How::OpenCv("cubic")),
    contender("ImageMagick Gaussian", How::Magick("Gaussian")),
];

/// Those that aim at the mean over the pixel's square.
static SQUARES: [Contender; 5] = [
    contender(BOX, How::Scumble(&["--kernel", "box"])),
    contender("`high --kernel box`", How::Scumble(&["--quality", "high", "--kernel", "box"])),
    contender(OPENCV_LINEAR, How::OpenCv("linear")),
    contender("OpenCV 4×4, equal weights", How::OpenCv("mean:4")),
    contender("ImageMagick's own filter", How::Magick("")),
];

// Names that bars refer to.
pub(super) const BOX: &str = "`--kernel box`";
pub(super) const BILINEAR: &str = "`--magnify bilinear`";
pub(super) const CATMULL_ROM: &str = "`--magnify catmull-rom`";
pub(super) const CATMULL_ROM_16: &str = "`--magnify catmull-rom --depth 16`";
pub(super) const OPENCV_LINEAR: &str = "OpenCV linear";
pub(super) const OPENCV_GAUSSIAN_4: &str = "OpenCV 4×4, Gaussian weights";
pub(super) const OPENCV_CUBIC: &str = "OpenCV cubic";

/// Those that compete under a map, for a kind of pixel.
pub(super) fn field(pixel: Pixel) -> &'static [Contender] {
    match pixel {
        Pixel::Square => &SQUARES,
        Pixel::Gaussian => &REDUCERS,
        Pixel::Cubic => &ENLARGERS,
    }
}

/// A task.
pub(super) struct Work<'a> {
    /// The image's name.
    pub(super) source: &'static str,
    /// From the output to the source.
    pub(super) map: &'a Homography,
    pub(super) scratch: &'a Path,
}

/// What came of it.
pub(super) enum Outcome {
    Done {
        ms: f64,
        /// Red, green and blue of 255, row after row.
        pixels: Vec<f32>,
    },
    /// The program is not there, or failed; why.
    Absent(String),
}

/// Writes an image as a PNG and as bare bytes.
pub(super) fn lay_out(source: &Source, scratch: &Path) -> Result<(), PeersError> {
    let canvas = source.canvas();
    let png = canvas.to_png().map_err(crate::quality::QualityError::from)?;
    let raw: Vec<u8> =
        canvas.into_image().pixels().iter().flat_map(|[r, g, b, _]| [*r, *g, *b]).collect();
    for (ending, bytes) in [("png", png), ("rgb", raw)] {
        let path = file(scratch, source.name, ending);
        std::fs::write(&path, bytes).map_err(|error| PeersError::File { path, error })?;
    }
    Ok(())
}

fn file(scratch: &Path, name: &str, ending: &str) -> PathBuf {
    scratch.join(format!("{}.{ending}", name.replace(' ', "-")))
}

impl Contender {
    /// The name of the program.
    pub(super) fn program(&self) -> &'static str {
        match self.how {
            How::Scumble(_) => "scumble",
            How::OpenCv(_) => "OpenCV",
            How::Magick(_) => "ImageMagick",
        }
    }

    /// Warps once.
    pub(super) fn run(&self, programs: &Programs, work: &Work) -> Result<Outcome, PeersError> {
        match self.how {
            How::Scumble(args) => ours(&programs.scumble, args, work).map_err(PeersError::Ours),
            How::OpenCv(method) => Ok(tried(opencv(&programs.python, method, work))),
            How::Magick(filter) => Ok(tried(magick(&programs.magick, filter, work))),
        }
    }
}

fn tried(result: Result<Outcome, String>) -> Outcome {
    result.unwrap_or_else(Outcome::Absent)
}

/// Runs a command; what it printed, or the last line that it complained with.
fn output(command: &mut Command) -> Result<String, String> {
    let name = command.get_program().to_string_lossy().into_owned();
    let output = command.output().map_err(|e| format!("{name}: {e}"))?;
    if output.status.success() {
        return Ok(String::from_utf8_lossy(&output.stdout).into_owned());
    }
    let said = String::from_utf8_lossy(&output.stderr);
    Err(format!("{name}: {}", said.trim().lines().last().unwrap_or("failed")))
}

fn coefficients(map: &Homography) -> [f64; 9] {
    std::array::from_fn(|i| map.m[i / 3][i % 3])
}

fn ours(program: &Path, args: &[&str], work: &Work) -> Result<Outcome, String> {
    let out = work.scratch.join("ours.png");
    let matrix = coefficients(work.map).map(|v| v.to_string()).join(",");
    let said = output(
        Command::new(program)
            .arg("warp")
            .arg(file(work.scratch, work.source, "png"))
            .arg("-o")
            .arg(&out)
            .args(["--matrix", &matrix, "--inverse"])
            .args(["--size", &format!("{}x{}", warps::WIDTH, warps::HEIGHT)])
            .args(["--space", "srgb", "--border", "clamp", "--threads", "1"])
            .args(["--json", "--force"])
            .args(args),
    )?;
    let report: Value = serde_json::from_str(&said).map_err(|e| e.to_string())?;
    let ms = report["warp_ms"].as_f64().ok_or("no warp_ms in the report")?;
    Ok(Outcome::Done { ms, pixels: pixels(&out)? })
}

/// The numbers of a picture, of 255.
fn pixels(path: &Path) -> Result<Vec<f32>, String> {
    let codes = image::open(path).map_err(|e| e.to_string())?.into_rgb16().into_raw();
    Ok(codes.into_iter().map(|code| f32::from(code) / 257.0).collect())
}

/// The script that speaks to OpenCV.
const SCRIPT: &str = include_str!("opencv.py");

fn opencv(python: &Path, method: &str, work: &Work) -> Result<Outcome, String> {
    let out = work.scratch.join("opencv.rgb");
    let [size, width, height] = [SIZE, warps::WIDTH, warps::HEIGHT].map(|n| n.to_string());
    let said = output(
        Command::new(python)
            .args(["-c", SCRIPT, method, &size])
            .arg(file(work.scratch, work.source, "rgb"))
            .args([width, height])
            .args(coefficients(work.map).map(|v| v.to_string()))
            .arg(&out),
    )?;
    let ms = said.trim().parse().map_err(|_| format!("said {said:?}"))?;
    let codes = std::fs::read(&out).map_err(|e| e.to_string())?;
    Ok(Outcome::Done { ms, pixels: codes.into_iter().map(f32::from).collect() })
}

fn magick(program: &Path, filter: &str, work: &Work) -> Result<Outcome, String> {
    let out = work.scratch.join("magick.png");
    let forward = work.map.inverse().map_err(|e| e.to_string())?;
    let m = coefficients(&forward);
    let eight = m[..8].iter().map(|v| (v / m[8]).to_string()).collect::<Vec<_>>().join(",");
    let command = |distort: bool| {
        let mut command = Command::new(program);
        command.env("MAGICK_THREAD_LIMIT", "1").env("OMP_NUM_THREADS", "1");
        command.arg(file(work.scratch, work.source, "png"));
        if distort {
            let view = format!("distort:viewport={}x{}+0+0", warps::WIDTH, warps::HEIGHT);
            command.args(["-virtual-pixel", "edge", "-define", &view]);
            if !filter.is_empty() {
                command.args(["-filter", filter]);
            }
            command.args(["-distort", "PerspectiveProjection", &eight, "+repage"]);
        } else {
            command.args(["-crop", &format!("{}x{}+0+0", warps::WIDTH, warps::HEIGHT), "+repage"]);
        }
        command.args(["-define", "png:compression-level=1"]).arg(&out);
        command
    };
    // It has no clock of its own: what reading and writing alone take is taken off.
    let around = clock(|| output(&mut command(false)))?;
    let whole = clock(|| output(&mut command(true)))?;
    Ok(Outcome::Done { ms: whole - around, pixels: pixels(&out)? })
}

/// Texels along each side of the texture whose pyramid is timed.
const LARGE: usize = 4096;

/// Pyramids of a texture of 4096² RGBA8: names, and the times of each round. OpenCV's is the last, if it
/// is there.
pub(super) fn mips(
    programs: &Programs,
    rounds: usize,
) -> Result<Vec<(&'static str, Vec<f64>)>, PeersError> {
    let image = Image::from_fn(LARGE, LARGE, |x, y| {
        let n = (4 * (y * LARGE + x)) as u32;
        [0, 1, 2, 3].map(|i| (n + i) as u8)
    })
    .map_err(|e| PeersError::Ours(e.to_string()))?;
    let ours = |decimation, space, first| {
        let levels = Levels::Range { first, last: usize::MAX };
        let options = TextureOptions { decimation, space, levels, ..TextureOptions::default() };
        clock(|| Texture::new(image.view(), &options)).map_err(|e| PeersError::Ours(e.to_string()))
    };
    let mut rows = vec![
        ("ours, box, encoded, from level 1 on", Vec::new()),
        ("ours, Kaiser, linear light, from level 1 on", Vec::new()),
        ("ours, box, encoded, with level 0", Vec::new()),
        ("ours, Kaiser, linear light, with level 0", Vec::new()),
        ("OpenCV `INTER_AREA`, encoded, from level 1 on", Vec::new()),
    ];
    for _ in 0..rounds {
        for (first, rows) in [1, 0].into_iter().zip(rows.as_chunks_mut::<2>().0) {
            rows[0].1.push(ours(Decimation::Box, WorkingSpace::Srgb, first)?);
            rows[1].1.push(ours(Decimation::Kaiser, WorkingSpace::Linear, first)?);
        }
        let mut command = Command::new(&programs.python);
        let said = output(command.args(["-c", SCRIPT, "mips", &LARGE.to_string()]));
        rows[4].1.extend(said.ok().and_then(|s| s.trim().parse::<f64>().ok()));
    }
    rows.retain(|(_, times)| !times.is_empty());
    Ok(rows)
}
