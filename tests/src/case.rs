use scumble::coverage::SamplePattern;
use scumble::geometry::IntRect;
use scumble::pixel::WorkingSpace;
use scumble::texture::{LevelMode, PixelFilter};
use scumble::{Antialias, Background, Interpolation, Settings, Shading};
use scumble_svg::{Profile, ProfileChoice};

/// What to render: a scene and the options that the command line would take.
///
/// | key | values | default |
/// |---|---|---|
/// | `scene` | a file under `assets/scenes` | required |
/// | `width`, `height` | pixels | required |
/// | `profile` | `auto`, `svg`, `course` | `auto` |
/// | `samples` | a number that the pattern has | 16; 1 in the course profile |
/// | `pattern` | `standard`, `grid` | `standard`; `grid` in the course profile |
/// | `aa` | `samples`, `area` | `samples` |
/// | `shade` | `pixel`, `sample` | `pixel` |
/// | `pixel` | `ewa`, `bilinear`, `nearest` | `ewa`; `nearest` in the course profile |
/// | `level` | `auto`, `zero`, `nearest`, `linear` | `auto`; `zero` in the course profile |
/// | `space` | `srgb`, `linear` | `srgb` |
/// | `interpolate` | `perspective`, `affine` | `perspective` |
/// | `background` | `scene`, `none` | `scene` |
/// | `crop` | x,y,width,height | all |
/// | `warnings` | how many the reader gives | 0 |
#[derive(Debug, Clone, PartialEq)]
pub struct Case {
    /// The scene's file name.
    pub scene: String,
    /// How to read the scene.
    pub profile: ProfileChoice,
    /// How many warnings the reader gives.
    pub warnings: usize,
    size: (u32, u32),
    samples: Option<usize>,
    grid: Option<bool>,
    pixel: Option<PixelFilter>,
    level: Option<LevelMode>,
    aa: Antialias,
    shade: Shading,
    space: WorkingSpace,
    interpolate: Interpolation,
    background: Background,
    crop: Option<IntRect>,
}

impl Case {
    /// A case with every default for a scene.
    #[must_use]
    pub fn new(scene: &str, width: u32, height: u32) -> Self {
        Self {
            scene: scene.to_owned(),
            profile: ProfileChoice::Auto,
            warnings: 0,
            size: (width, height),
            samples: None,
            grid: None,
            pixel: None,
            level: None,
            aa: Antialias::default(),
            shade: Shading::default(),
            space: WorkingSpace::default(),
            interpolate: Interpolation::default(),
            background: Background::default(),
            crop: None,
        }
    }

    /// Reads the text of a case. Empty lines and lines that start with `#` say nothing.
    ///
    /// # Errors
    /// The line that is not understood, or the key that is missing.
    pub fn parse(text: &str) -> Result<Self, String> {
        let mut case = Self::new("", 0, 0);
        for (index, line) in text.lines().enumerate() {
            let line = line.trim();
            if line.is_empty() || line.starts_with('#') {
                continue;
            }
            let set = match line.split_once('=') {
                Some((key, value)) => case.set(key.trim(), value.trim()),
                None => Err("not `key = value`".to_owned()),
            };
            set.map_err(|e| format!("line {}: {line}: {e}", index + 1))?;
        }
        if case.scene.is_empty() || case.size.0 == 0 || case.size.1 == 0 {
            return Err("a case names its scene, width and height".to_owned());
        }
        Ok(case)
    }

    fn set(&mut self, key: &str, value: &str) -> Result<(), String> {
        match key {
            "scene" => self.scene = value.to_owned(),
            "width" => self.size.0 = number(value)?,
            "height" => self.size.1 = number(value)?,
            "samples" => self.samples = Some(number(value)?),
            "warnings" => self.warnings = number(value)?,
            "crop" => self.crop = Some(crop(value)?),
            "profile" => {
                use ProfileChoice::{Auto, Course, Svg};
                self.profile = one_of(value, &[("auto", Auto), ("svg", Svg), ("course", Course)])?;
            }
            "pattern" => {
                self.grid = Some(one_of(value, &[("standard", false), ("grid", true)])?);
            }
            "aa" => {
                let ways = [("samples", Antialias::Samples), ("area", Antialias::Area)];
                self.aa = one_of(value, &ways)?;
            }
            "shade" => {
                let ways = [("pixel", Shading::Pixel), ("sample", Shading::Sample)];
                self.shade = one_of(value, &ways)?;
            }
            "pixel" => {
                use PixelFilter::{Bilinear, Ewa, Nearest};
                let filters = [("ewa", Ewa), ("bilinear", Bilinear), ("nearest", Nearest)];
                self.pixel = Some(one_of(value, &filters)?);
            }
            "level" => {
                use LevelMode::{Auto, Linear, Nearest, Zero};
                let modes =
                    [("auto", Auto), ("zero", Zero), ("nearest", Nearest), ("linear", Linear)];
                self.level = Some(one_of(value, &modes)?);
            }
            "space" => {
                let spaces = [("srgb", WorkingSpace::Srgb), ("linear", WorkingSpace::Linear)];
                self.space = one_of(value, &spaces)?;
            }
            "interpolate" => {
                use Interpolation::{Affine, Perspective};
                self.interpolate =
                    one_of(value, &[("perspective", Perspective), ("affine", Affine)])?;
            }
            "background" => {
                let grounds = [("scene", Background::Scene), ("none", Background::Transparent)];
                self.background = one_of(value, &grounds)?;
            }
            _ => return Err("no such key".to_owned()),
        }
        Ok(())
    }

    /// The renderer's settings for a scene that was read with `profile`.
    ///
    /// # Errors
    /// The pattern that does not exist.
    pub fn settings(&self, profile: Profile) -> Result<Settings, String> {
        let course = profile == Profile::Course;
        let mut settings = Settings::new(self.size.0, self.size.1);
        let samples = self.samples.unwrap_or(if course { 1 } else { scumble::DEFAULT_SAMPLES });
        let pattern = if self.grid.unwrap_or(course) {
            SamplePattern::grid(samples)
        } else {
            SamplePattern::standard(samples)
        };
        settings.pattern = pattern.map_err(|e| e.to_string())?;
        let (pixel, level) = if course {
            (PixelFilter::Nearest, LevelMode::Zero)
        } else {
            (PixelFilter::Ewa, LevelMode::Auto)
        };
        settings.sampler =
            settings.sampler.with(self.pixel.unwrap_or(pixel), self.level.unwrap_or(level));
        settings.antialias = self.aa;
        settings.shading = self.shade;
        settings.space = self.space;
        settings.interpolation = self.interpolate;
        settings.background = self.background;
        settings.crop = self.crop;
        settings.threads = 1;
        Ok(settings)
    }
}

fn number<T: std::str::FromStr>(value: &str) -> Result<T, String> {
    value.parse().map_err(|_| "not a whole number".to_owned())
}

fn one_of<T: Copy>(value: &str, ways: &[(&str, T)]) -> Result<T, String> {
    let found = ways.iter().find(|(name, _)| *name == value);
    found.map(|&(_, way)| way).ok_or_else(|| {
        let names: Vec<&str> = ways.iter().map(|(name, _)| *name).collect();
        format!("one of {}", names.join(", "))
    })
}

fn crop(value: &str) -> Result<IntRect, String> {
    let parts: Vec<i32> = value.split(',').map(|v| number(v.trim())).collect::<Result<_, _>>()?;
    match parts[..] {
        [x, y, width, height] => Ok(IntRect::new(x, y, x + width, y + height)),
        _ => Err("x,y,width,height".to_owned()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const LEAST: &str = "scene = a.svg\nwidth = 8\nheight = 6\n";

    #[test]
    fn a_case_is_read_and_its_defaults_depend_on_the_profile() {
        let case = Case::parse(&format!("# why\n\n{LEAST}level = linear\n")).unwrap();
        let svg = case.settings(Profile::Svg).unwrap();
        assert_eq!((svg.width, svg.height, svg.pattern.len()), (8, 6, 16));
        assert_eq!(svg.sampler.pixel, PixelFilter::Ewa);
        let course = case.settings(Profile::Course).unwrap();
        assert_eq!(course.pattern.len(), 1);
        assert_eq!(course.sampler.pixel, PixelFilter::Nearest);
        assert_eq!(course.sampler.level, LevelMode::Linear);
    }

    #[test]
    fn what_is_not_understood_is_an_error() {
        for wrong in ["colour = red", "pixel = cubic", "width = wide", "crop = 1,2", "scene"] {
            let error = Case::parse(&format!("{LEAST}{wrong}\n")).unwrap_err();
            assert!(error.starts_with("line 4"), "{error}");
        }
        assert!(Case::parse("scene = a.svg\nwidth = 8\n").is_err());
        let case = Case::parse(&format!("{LEAST}samples = 5\n")).unwrap();
        assert!(case.settings(Profile::Svg).is_err());
    }
}
