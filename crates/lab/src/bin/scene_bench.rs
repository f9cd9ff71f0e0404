//! One more program for a comparison of rasterizers: reads a scene that the others read too, renders
//! it frame after frame, and prints `ms MEDIAN MIN N`.
//!
//! A frame is a call of `scumble::render` into an image that is kept from frame to frame. The driver
//! builds the textures in that call, which the others do once, before the clock: so `ms` leaves that
//! part out, and a second line, `ms_textures`, says what was left out.

use clap::{Parser, ValueEnum};
use lab::driver;
use lab::exchange::{self, Frame};
use scumble::coverage::{CoverageError, SamplePattern};
use scumble::texture::{LevelMode, PixelFilter, Sampler};
use scumble::{Control, ImageSink, Settings, render};
use std::error::Error;
use std::path::PathBuf;
use std::process::ExitCode;

/// Renders a scene and measures it.
#[derive(Debug, Parser)]
struct Args {
    /// The scene: NAME.json with its triangles beside it, or NAME.dl.
    #[arg(long, value_name = "FILE")]
    scene: PathBuf,
    /// How many frames to measure; 0 measures nothing.
    #[arg(long, value_name = "N", default_value_t = 0)]
    bench: usize,
    /// How textures are filtered.
    #[arg(long, value_enum, default_value_t)]
    filter: Filter,
    /// Samples a pixel: the standard patterns where there is one, else a grid.
    #[arg(long, value_name = "M", default_value_t = 1)]
    msaa: usize,
    /// What edges are made of.
    #[arg(long, value_enum, default_value_t)]
    aa: Antialiasing,
    /// How many threads; 0 is one for each processor.
    #[arg(long, value_name = "T", default_value_t = 1)]
    threads: usize,
    /// Where to write the picture.
    #[arg(long, value_name = "PNG")]
    out: Option<PathBuf>,
}

/// By the names that the other programs give them. What has no levels in theirs has none here.
#[derive(Debug, Clone, Copy, Default, ValueEnum)]
#[value(rename_all = "snake_case")]
enum Filter {
    Nearest,
    Bilinear,
    BilinearMip,
    Trilinear,
    /// For an anisotropic filter of up to 16 taps: ours of a video's quality.
    #[value(alias = "aniso16")]
    #[value(name = "ewa-fast")]
    EwaFast,
    #[default]
    #[value(alias = "none")]
    Ewa,
    #[value(name = "ewa-high")]
    EwaHigh,
    Reference,
}

impl Filter {
    fn sampler(self) -> Sampler {
        let point = |pixel, level| Sampler::DEFAULT.with(pixel, level);
        match self {
            Self::Nearest => point(PixelFilter::Nearest, LevelMode::Zero),
            Self::Bilinear => point(PixelFilter::Bilinear, LevelMode::Zero),
            Self::BilinearMip => point(PixelFilter::Bilinear, LevelMode::Nearest),
            Self::Trilinear => point(PixelFilter::Bilinear, LevelMode::Linear),
            Self::EwaFast => Sampler::FAST,
            Self::Ewa => Sampler::DEFAULT,
            Self::EwaHigh => Sampler::HIGH,
            Self::Reference => Sampler::REFERENCE,
        }
    }
}

/// What edges are made of.
#[derive(Debug, Clone, Copy, Default, ValueEnum)]
enum Antialiasing {
    /// The samples of `--msaa`.
    #[default]
    Samples,
    /// The exact area of each primitive by itself.
    Area,
}

fn main() -> ExitCode {
    match run(&Args::parse()) {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("error: {error}");
            ExitCode::FAILURE
        }
    }
}

fn run(args: &Args) -> Result<(), Box<dyn Error>> {
    let Frame { width, height, scene } = exchange::read(&args.scene)?;
    let settings = settings(args, width, height)?;
    let mut sink = ImageSink::new();
    if args.bench == 0 {
        render(&scene, &settings, &mut sink, &Control::default())?;
    } else {
        let times = driver::measure(&scene, &settings, args.bench, &mut sink)?;
        println!("ms {}", times.drawing);
        if !scene.images.is_empty() {
            println!("ms_textures {}", times.textures);
        }
    }
    if let Some(path) = &args.out {
        let bytes = sink.into_image().into_vec().into_flattened();
        image::save_buffer(path, &bytes, width, height, image::ColorType::Rgba8)
            .map_err(|error| format!("{}: {error}", path.display()))?;
    }
    Ok(())
}

fn settings(args: &Args, width: u32, height: u32) -> Result<Settings, Box<dyn Error>> {
    let mut settings = Settings::new(width, height);
    match args.aa {
        Antialiasing::Samples => settings.pattern = pattern(args.msaa)?,
        Antialiasing::Area => settings.antialias = scumble::Antialias::Area,
    }
    settings.sampler = args.filter.sampler();
    settings.threads = args.threads;
    Ok(settings)
}

fn pattern(samples: usize) -> Result<SamplePattern, CoverageError> {
    SamplePattern::standard(samples).or_else(|_| SamplePattern::grid(samples))
}
