use crate::{Comparison, compare, triptych};
use image::RgbaImage;
use image::codecs::png::{CompressionType, FilterType, PngEncoder};
use image::{ExtendedColorType, ImageEncoder};
use serde_json::json;
use std::path::{Path, PathBuf};

/// What to do where a picture is not its reference.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Mode {
    /// Fail, and leave a triptych and a report.
    Compare,
    /// Take the picture as the new reference.
    Bless,
}

/// The reference of one picture, and where to leave what there is to say about it.
#[derive(Debug, Clone)]
pub struct Golden {
    /// The picture's name.
    pub name: String,
    /// Where the references stand.
    pub references: PathBuf,
    /// Where reports and pictures of failures go.
    pub results: PathBuf,
}

impl Golden {
    /// Holds a picture to its reference, exactly.
    ///
    /// In every mode a report `NAME.json` is left under `results`; in [`Mode::Compare`] also
    /// `NAME.actual.png` and, where there was a reference, `NAME.triptych.png`.
    ///
    /// # Errors
    /// In words, with the path of the picture to look at, if the reference is missing or differs.
    pub fn judge(&self, actual: &RgbaImage, mode: Mode) -> Result<(), String> {
        std::fs::create_dir_all(&self.results).map_err(|e| in_file(&self.results, &e))?;
        let reference = self.references.join(format!("{}.png", self.name));
        let expected = match reference.exists() {
            true => Some(image::open(&reference).map_err(|e| in_file(&reference, &e))?.to_rgba8()),
            false => None,
        };
        let comparison = expected.as_ref().and_then(|expected| compare(expected, actual));
        if comparison.is_some_and(|c| c.count == 0) {
            return self.report("equal", comparison, &reference);
        }
        if mode == Mode::Bless {
            write_png(&reference, actual)?;
            println!("blessed {}", reference.display());
            return self.report("equal", Some(Comparison::default()), &reference);
        }
        let candidate = self.results.join(format!("{}.actual.png", self.name));
        write_png(&candidate, actual)?;
        let Some(expected) = expected else {
            self.report("missing", None, &candidate)?;
            return Err(format!(
                "there is no reference: look at {}, then `cargo xtask golden bless {}`",
                candidate.display(),
                self.name
            ));
        };
        let picture = self.results.join(format!("{}.triptych.png", self.name));
        write_png(&picture, &triptych(&expected, actual))?;
        self.report("different", comparison, &picture)?;
        Err(match comparison {
            None => format!(
                "the size is {:?}, not {:?}: {}",
                actual.dimensions(),
                expected.dimensions(),
                picture.display()
            ),
            Some(c) => format!(
                "{} pixels differ, by up to {} levels, first at {:?}: {}",
                c.count,
                c.max_difference,
                c.first.unwrap_or_default(),
                picture.display()
            ),
        })
    }

    fn report(
        &self,
        status: &str,
        comparison: Option<Comparison>,
        picture: &Path,
    ) -> Result<(), String> {
        let report = json!({
            "name": self.name,
            "status": status,
            "count": comparison.map(|c| c.count),
            "max_difference": comparison.map(|c| c.max_difference),
            "first": comparison.and_then(|c| c.first).map(|(x, y)| [x, y]),
            "picture": picture.display().to_string(),
        });
        let path = self.results.join(format!("{}.json", self.name));
        std::fs::write(&path, format!("{report:#}\n")).map_err(|e| in_file(&path, &e))
    }
}

/// Writes a PNG: RGB if every pixel is opaque, RGBA otherwise.
fn write_png(path: &Path, picture: &RgbaImage) -> Result<(), String> {
    let mut bytes = Vec::new();
    let encoder =
        PngEncoder::new_with_quality(&mut bytes, CompressionType::Best, FilterType::Adaptive);
    let (width, height) = picture.dimensions();
    let encoded = if picture.pixels().all(|p| p.0[3] == 255) {
        let rgb: Vec<u8> = picture.pixels().flat_map(|p| [p.0[0], p.0[1], p.0[2]]).collect();
        encoder.write_image(&rgb, width, height, ExtendedColorType::Rgb8)
    } else {
        encoder.write_image(picture.as_raw(), width, height, ExtendedColorType::Rgba8)
    };
    encoded.map_err(|e| in_file(path, &e))?;
    if let Some(folder) = path.parent() {
        std::fs::create_dir_all(folder).map_err(|e| in_file(folder, &e))?;
    }
    std::fs::write(path, bytes).map_err(|e| in_file(path, &e))
}

fn in_file(path: &Path, error: &dyn std::fmt::Display) -> String {
    format!("{}: {error}", path.display())
}
