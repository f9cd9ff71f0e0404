//! One view by several methods.

use crate::gallery::Drawn;
use crate::gallery::ink::{finish, part, shown};
use crate::math::log10;
use crate::views::{self, HEIGHT, View, WIDTH};
use scumble::texture::{Kernel, LevelMode, Magnify, PixelFilter, Sampler};
use scumble_sheet::{Cell, contact_sheet};

const NONE: (&str, Sampler) =
    ("none", Sampler::DEFAULT.with(PixelFilter::Nearest, LevelMode::Zero));
const ENHANCED: (&str, Sampler) = ("enhanced EWA", Sampler::CLASSIC);

/// The paper's four, and ours.
const METHODS: [(&str, Sampler); 5] = [
    NONE,
    ("trilinear", Sampler::DEFAULT.with(PixelFilter::Bilinear, LevelMode::Linear)),
    (
        "EWA, Gaussian of radius 1",
        Sampler { kernel: Kernel::Gaussian, magnify: Magnify::None, ..Sampler::CLASSIC },
    ),
    ENHANCED,
    ("Scumble's default", Sampler::DEFAULT),
];

const WHOLE: [usize; 4] = [0, 0, WIDTH, HEIGHT];

/// A part of a view by all five, each with the decibels against the reference if `judged`.
fn five(view: &View, crop: [usize; 4], scale: u32, judged: bool) -> Drawn {
    let truth = view.draw(&Sampler::REFERENCE);
    let mut cells = Vec::new();
    for (name, sampler) in METHODS {
        let colors = view.draw(&sampler);
        let mut words = name.to_owned();
        if judged {
            words += &format!(": {:.1} dB", psnr(&colors, &truth));
        }
        cells.push(Cell::new(part(&shown(&colors)?, crop), [words]));
    }
    finish(contact_sheet(&cells, 3, scale))
}

/// Decibels between two pictures of numbers in 0…1.
pub(super) fn psnr(a: &[[f64; 3]], b: &[[f64; 3]]) -> f64 {
    let pairs = a.as_flattened().iter().zip(b.as_flattened());
    let squares: f64 = pairs.map(|(a, b)| (a - b) * (a - b)).sum();
    -10.0 * log10(squares / (3.0 * a.len() as f64))
}

pub(super) fn aliasing() -> Drawn {
    let view = views::checker()?;
    let mut cells = Vec::new();
    for (name, sampler) in [NONE, ENHANCED] {
        cells.push(Cell::new(shown(&view.draw(&sampler))?, [name]));
    }
    finish(contact_sheet(&cells, 2, 1))
}

pub(super) fn diagonal() -> Drawn {
    five(&views::diagonal()?, WHOLE, 1, true)
}

pub(super) fn frequencies() -> Drawn {
    five(&views::carpet()?, WHOLE, 1, true)
}

pub(super) fn ordinary() -> Drawn {
    five(&views::room()?, WHOLE, 1, true)
}

pub(super) fn magnified() -> Drawn {
    five(&views::boat()?, WHOLE, 1, false)
}

pub(super) fn cut() -> Drawn {
    five(&views::boat()?, [76, 32, 72, 72], 4, false)
}
