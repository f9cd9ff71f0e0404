//! Edges, and what moves them.

use crate::gallery::ink::finish;
use crate::gallery::stage::{scene, shot};
use crate::gallery::{Drawn, GalleryError};
use scumble::coverage::SamplePattern;
use scumble::scene::Scene;
use scumble::{Interpolation, Settings};
use scumble_sheet::{Cell, contact_sheet};

/// A scene by so many samples on a grid.
fn by(scene: &Scene, size: [u32; 2], crop: [i32; 4], samples: usize) -> Drawn {
    shot(scene, size, crop, |settings: &mut Settings| -> Result<(), GalleryError> {
        settings.pattern = SamplePattern::grid(samples)?;
        Ok(())
    })
}

fn words(samples: usize) -> String {
    if samples == 1 { "1 sample".to_owned() } else { format!("{samples} samples") }
}

pub(super) fn samples() -> Drawn {
    let mut cells = Vec::new();
    for (name, crop) in [("cube", [72, 268, 56, 42]), ("thin", [236, 130, 56, 42])] {
        let scene = scene(name)?;
        for samples in [1, 4, 9, 16] {
            cells.push(Cell::new(by(&scene, [400, 400], crop, samples)?, [words(samples)]));
        }
    }
    finish(contact_sheet(&cells, 4, 4))
}

pub(super) fn degenerate() -> Drawn {
    let mut cells = Vec::new();
    for name in ["degenerate_mesh", "degenerate_fan"] {
        let scene = scene(name)?;
        for samples in [1, 16] {
            let picture = by(&scene, [220, 220], [0, 0, 220, 220], samples)?;
            cells.push(Cell::new(picture, [words(samples)]));
        }
    }
    finish(contact_sheet(&cells, 4, 1))
}

pub(super) fn scenes() -> Drawn {
    let mut cells = Vec::new();
    let shown = [("thin", 1), ("cube", 1), ("robot", 16), ("wheel", 16), ("quad", 16)];
    for (name, samples) in shown {
        let picture = by(&scene(name)?, [288, 288], [0, 0, 288, 288], samples)?;
        cells.push(Cell::new(picture, [format!("{name}, {}", words(samples))]));
    }
    finish(contact_sheet(&cells, 3, 1))
}

pub(super) fn interpolation() -> Drawn {
    let scene = scene("quad")?;
    let mut cells = Vec::new();
    for (interpolation, words) in
        [(Interpolation::Affine, "on the screen"), (Interpolation::Perspective, "on the plane")]
    {
        let picture = shot(&scene, [432, 324], [0, 0, 432, 324], |settings| {
            settings.interpolation = interpolation;
            Ok(())
        })?;
        cells.push(Cell::new(picture, [words]));
    }
    finish(contact_sheet(&cells, 2, 1))
}
