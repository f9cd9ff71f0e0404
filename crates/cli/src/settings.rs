//! From words on the command line to the renderer's settings.

use crate::args::{
    Antialias, Background, Color, Interpolate, Level, Pattern, Pixel, Quality, Render, Shade, Space,
};
use crate::error::Failure;
use crate::size::Canvas;
use scumble::coverage::{CoverageError, SamplePattern};
use scumble::geometry::IntRect;
use scumble::pixel::Straight;
use scumble::texture::{LevelMode, PixelFilter, Sampler};
use scumble::{Interpolation, Settings, Shading};
use scumble_svg::Profile;

/// What a profile takes where the user chose nothing.
struct Defaults {
    samples: u32,
    pattern: Pattern,
    pixel: Pixel,
    level: Level,
}

const SVG: Defaults =
    Defaults { samples: 16, pattern: Pattern::Standard, pixel: Pixel::Ewa, level: Level::Auto };

const COURSE: Defaults =
    Defaults { samples: 1, pattern: Pattern::Grid, pixel: Pixel::Nearest, level: Level::Zero };

/// Every choice that was made, by the user or for them.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Choices {
    pub(crate) aa: Antialias,
    pub(crate) samples: u32,
    pub(crate) pattern: Pattern,
    pub(crate) shade: Shade,
    /// The name of a preset of the filters.
    pub(crate) quality: &'static str,
    pub(crate) pixel: Pixel,
    pub(crate) level: Level,
    pub(crate) space: Space,
    pub(crate) interpolate: Interpolate,
}

impl Choices {
    /// The user's choices, and the profile's for the rest.
    pub(crate) fn new(quality: &Quality, color: &Color, profile: Profile) -> Result<Self, Failure> {
        let defaults = match profile {
            Profile::Svg => SVG,
            Profile::Course => COURSE,
        };
        let samples = quality.samples.unwrap_or(defaults.samples);
        let pixel = quality.pixel.unwrap_or(defaults.pixel);
        // Trilinear is two levels by its name.
        let level = if pixel == Pixel::Trilinear { Level::Linear } else { defaults.level };
        Ok(Self {
            aa: quality.aa.unwrap_or(Antialias::Samples),
            samples,
            pattern: pattern(quality.pattern, defaults.pattern, samples)?,
            shade: quality.shade.unwrap_or(Shade::Pixel),
            quality: quality.quality.unwrap_or("default"),
            pixel,
            level: quality.level.unwrap_or(level),
            space: color.space.unwrap_or(Space::Srgb),
            interpolate: quality.interpolate.unwrap_or(Interpolate::Perspective),
        })
    }

    fn sample_pattern(&self) -> Result<SamplePattern, Failure> {
        let samples = self.samples as usize;
        let made: Result<_, CoverageError> = match self.pattern {
            Pattern::Standard => SamplePattern::standard(samples),
            Pattern::Grid => SamplePattern::grid(samples),
        };
        made.map_err(|e| Failure::Usage(format!("--samples {samples}: {e}")))
    }

    /// The quality's filter, changed by what was chosen beside it.
    fn sampler(&self, quality: &Quality) -> Sampler {
        let mut sampler = Sampler::preset(self.quality).unwrap_or_default();
        sampler.pixel = match self.pixel {
            // The ellipse is what every preset has, each in its own way.
            Pixel::Ewa => sampler.pixel,
            Pixel::Probes => PixelFilter::Probes,
            Pixel::Bilinear | Pixel::Trilinear => PixelFilter::Bilinear,
            Pixel::Nearest => PixelFilter::Nearest,
        };
        sampler.level = match self.level {
            Level::Auto => LevelMode::Auto,
            Level::Zero => LevelMode::Zero,
            Level::Nearest => LevelMode::Nearest,
            Level::Linear => LevelMode::Linear,
        };
        Sampler {
            kernel: quality.kernel.unwrap_or(sampler.kernel),
            magnify: quality.magnify.unwrap_or(sampler.magnify),
            max_eccentricity: quality.max_eccentricity.unwrap_or(sampler.max_eccentricity),
            ..sampler
        }
    }

    /// The renderer's settings for these choices.
    pub(crate) fn settings(&self, canvas: &Canvas, options: &Render) -> Result<Settings, Failure> {
        let mut settings = Settings::new(canvas.width, canvas.height);
        settings.pattern = self.sample_pattern()?;
        settings.antialias = match self.aa {
            Antialias::Samples => scumble::Antialias::Samples,
            Antialias::Area => scumble::Antialias::Area,
        };
        settings.crop = crop(canvas)?;
        settings.shading = match self.shade {
            Shade::Pixel => Shading::Pixel,
            Shade::Sample => Shading::Sample,
        };
        settings.sampler = self.sampler(&options.quality);
        settings.space = self.space.working();
        settings.interpolation = match self.interpolate {
            Interpolate::Perspective => Interpolation::Perspective,
            Interpolate::Affine => Interpolation::Affine,
        };
        settings.background = match options.color.background {
            None => scumble::Background::Scene,
            Some(Background::Transparent) => scumble::Background::Transparent,
            Some(Background::Color(color)) => scumble::Background::Color(Straight(color)),
        };
        settings.threads = options.limits.threads;
        settings.max_memory = options.limits.max_memory;
        Ok(settings)
    }
}

/// The pattern that was asked for; else the profile's, or the one that exists for so many samples.
fn pattern(asked: Option<Pattern>, default: Pattern, samples: u32) -> Result<Pattern, Failure> {
    let square = samples.isqrt().pow(2) == samples;
    match asked {
        Some(Pattern::Grid) if !square => Err(Failure::Usage(format!(
            "--pattern grid: {samples} samples make no square grid; 1, 4, 9, 16, 25, 36, 49 and 64 do"
        ))),
        // Hardware has no nine and stops at sixteen; the grid is the one pattern of those numbers.
        _ if samples == 9 || samples > 16 => Ok(Pattern::Grid),
        Some(pattern) => Ok(pattern),
        None if !square => Ok(Pattern::Standard),
        None => Ok(default),
    }
}

pub(crate) fn crop(canvas: &Canvas) -> Result<Option<IntRect>, Failure> {
    let Some(crop) = canvas.crop else { return Ok(None) };
    // A crop lies in the canvas, so its corners are no larger than its sides.
    let int = |v: u32| i32::try_from(v).map_err(|_| Failure::Limit("the crop is too far".into()));
    let (x0, y0) = (int(crop.x)?, int(crop.y)?);
    Ok(Some(IntRect::new(x0, y0, int(crop.x + crop.width)?, int(crop.y + crop.height)?)))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::args::{Cli, Command};
    use clap::Parser;
    use scumble::pixel::WorkingSpace;

    fn parse(arguments: &str) -> Render {
        let words = ["scumble", "render", "a.svg"].into_iter().chain(arguments.split_whitespace());
        match Cli::try_parse_from(words).unwrap().command {
            Command::Render(render) => *render,
            _ => unreachable!("the word is render"),
        }
    }

    fn choices(arguments: &str, profile: Profile) -> Result<Choices, Failure> {
        let render = parse(arguments);
        Choices::new(&render.quality, &render.color, profile)
    }

    fn settings(arguments: &str, profile: Profile) -> Settings {
        let render = parse(arguments);
        let canvas = Canvas { width: 8, height: 6, crop: render.size.crop };
        choices(arguments, profile).unwrap().settings(&canvas, &render).unwrap()
    }

    #[test]
    fn the_svg_profile_takes_the_best() {
        let settings = settings("", Profile::Svg);
        assert_eq!((settings.width, settings.height, settings.crop), (8, 6, None));
        assert_eq!(settings.pattern, SamplePattern::standard(16).unwrap());
        assert_eq!(settings.sampler.pixel, PixelFilter::Ewa);
        assert_eq!(settings.sampler.level, LevelMode::Auto);
        assert_eq!(settings.space, WorkingSpace::Srgb);
        assert_eq!(settings.max_memory, scumble::DEFAULT_MAX_MEMORY);
        assert_eq!(settings.sampler.max_eccentricity, 32.0, "as --help says");
    }

    #[test]
    fn the_course_profile_takes_the_courses_own_and_each_can_be_overridden() {
        let own = settings("", Profile::Course);
        assert_eq!(own.pattern, SamplePattern::grid(1).unwrap());
        assert_eq!(own.sampler.pixel, PixelFilter::Nearest);
        assert_eq!(own.sampler.level, LevelMode::Zero);
        let other = settings("--samples 4 --pixel ewa", Profile::Course);
        assert_eq!(other.pattern, SamplePattern::grid(4).unwrap());
        assert_eq!(other.sampler.pixel, PixelFilter::Ewa);
        assert_eq!(other.sampler.level, LevelMode::Zero);
        let standard = settings("--samples 4 --pattern standard", Profile::Course);
        assert_eq!(standard.pattern, SamplePattern::standard(4).unwrap());
    }

    #[test]
    fn every_count_has_a_pattern_in_every_profile() {
        for profile in [Profile::Svg, Profile::Course] {
            for samples in [1, 2, 4, 8, 9, 16, 25, 36, 49, 64] {
                let settings = settings(&format!("--samples {samples}"), profile);
                assert_eq!(settings.pattern.len(), samples);
            }
        }
        assert_eq!(choices("--samples 9", Profile::Svg).unwrap().pattern, Pattern::Grid);
        for arguments in ["--samples 2 --pattern grid", "--samples 8 --pattern grid"] {
            assert!(matches!(choices(arguments, Profile::Svg), Err(Failure::Usage(_))));
        }
    }

    #[test]
    fn a_quality_is_a_preset_and_words_beside_it_change_it() {
        use scumble::texture::{Kernel, Magnify};
        let of = |arguments: &str| settings(arguments, Profile::Svg).sampler;
        assert_eq!(of(""), Sampler::DEFAULT);
        for (name, preset) in Sampler::PRESETS {
            assert_eq!(of(&format!("--quality {name}")), preset);
        }
        let own = of("--quality high --kernel lanczos3 --magnify catmull-rom --max-eccentricity 9");
        let (kernel, magnify) = (Kernel::Lanczos3, Magnify::CatmullRom);
        assert_eq!(own, Sampler { kernel, magnify, max_eccentricity: 9.0, ..Sampler::HIGH });
        assert_eq!(of("--pixel probes").pixel, PixelFilter::Probes);
        let trilinear = of("--pixel trilinear");
        assert_eq!((trilinear.pixel, trilinear.level), (PixelFilter::Bilinear, LevelMode::Linear));
        assert_eq!(of("--pixel trilinear --level nearest").level, LevelMode::Nearest);
        let course = settings("--pixel trilinear", Profile::Course).sampler;
        assert_eq!((course.pixel, course.level), (PixelFilter::Bilinear, LevelMode::Linear));
    }

    #[test]
    fn every_word_reaches_the_renderer() {
        let settings = settings(
            "--crop 1,2,3,4 --shade sample --pixel bilinear --level linear --max-eccentricity 5 \
             --space linear --background #ff000080 --interpolate affine -j 3 --max-memory 1M",
            Profile::Svg,
        );
        assert_eq!(settings.crop, Some(IntRect::new(1, 2, 4, 6)));
        assert_eq!(settings.shading, Shading::Sample);
        assert_eq!(settings.sampler.pixel, PixelFilter::Bilinear);
        assert_eq!(settings.sampler.level, LevelMode::Linear);
        assert_eq!(settings.sampler.max_eccentricity, 5.0);
        assert_eq!(settings.space, WorkingSpace::Linear);
        assert_eq!(settings.interpolation, Interpolation::Affine);
        assert_eq!((settings.threads, settings.max_memory), (3, 1 << 20));
        let scumble::Background::Color(Straight(color)) = settings.background else {
            panic!("no colour")
        };
        assert_eq!(color, [1.0, 0.0, 0.0, 128.0 / 255.0]);
    }
}
