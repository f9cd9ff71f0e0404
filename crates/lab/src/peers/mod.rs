//! `scumble warp` beside other programs: the same images under the same maps in one run, errors
//! against brute force, and times, as a table for `docs/performance.md`.
//!
//! The clock of ours counts what is done between decoding and encoding: conversion, the pyramid, the
//! filter. A rival's counts its warp alone. All run on one thread, taking turns. Beside what is measured of
//! ours stands the bar that it is to reach.

mod contender;
mod table;
mod truth;

pub use contender::Programs;

use crate::quality::{SOURCES, Source, warps};
use contender::{Contender, Outcome, Work};
use scumble_geometry::Homography;
use std::collections::BTreeMap;
use std::io;
use std::path::{Path, PathBuf};
use truth::{Pixel, Psnr, Truth};

/// Why nothing could be compared.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum PeersError {
    /// A file of the comparison's own could not be written.
    #[error("{}: {error}", path.display())]
    File {
        /// Which.
        path: PathBuf,
        /// What the system says.
        error: io::Error,
    },
    /// An image could not be made.
    #[error(transparent)]
    Quality(#[from] crate::quality::QualityError),
    /// Our own program failed.
    #[error("scumble: {0}")]
    Ours(String),
}

/// Images of the comparison: a photograph decides, the next two and it must not fail, and the zone plate
/// is told apart.
const IMAGES: [&str; 4] = ["photo", "checker", "text", "zone plate"];

/// What one contender came to on one map.
#[derive(Debug, Clone, Default)]
struct Row {
    /// Image by image.
    psnr: Vec<Psnr>,
    /// Milliseconds of each round, on the photograph.
    ms: Vec<f64>,
}

/// All contenders on one map, for one kind of pixel.
struct Heat {
    map: usize,
    pixel: Pixel,
    rows: Vec<(&'static Contender, Row)>,
}

/// How long to compare.
#[derive(Debug, Clone, Copy)]
pub struct Effort {
    /// Rounds of the clock.
    pub rounds: usize,
    /// One place in every square of so many pixels a side is compared with brute force.
    pub cell: usize,
}

/// Compares, and returns the tables in Markdown. The files that the programs hand one another lie in
/// `scratch`.
///
/// # Errors
/// [`PeersError`]; a rival that is not there or fails is named in the tables, and is no error.
pub fn compare(programs: &Programs, scratch: &Path, effort: Effort) -> Result<String, PeersError> {
    std::fs::create_dir_all(scratch)
        .map_err(|error| PeersError::File { path: scratch.to_owned(), error })?;
    let sources: Vec<&Source> =
        IMAGES.iter().filter_map(|name| SOURCES.iter().find(|s| s.name == *name)).collect();
    for source in &sources {
        contender::lay_out(source, scratch)?;
    }
    let maps = warps::with_enlargement().map_err(crate::quality::QualityError::from)?;
    let contest = Contest { programs, scratch, sources: &sources, maps: &maps, cell: effort.cell };
    let mut absent = BTreeMap::new();
    let mut heats = Vec::new();
    for (map, pixel) in HEATS {
        heats.push(contest.judged(map, pixel, &mut absent)?);
    }
    for _ in 0..effort.rounds {
        for heat in &mut heats {
            contest.timed(heat)?;
        }
    }
    let mips = contender::mips(programs, effort.rounds)?;
    Ok(table::page(&heats, &mips, &absent, effort.rounds))
}

/// The maps, by their numbers, and the pixels that they are judged by.
const HEATS: [(usize, Pixel); 7] = [
    (0, Pixel::Gaussian),
    (1, Pixel::Gaussian),
    (2, Pixel::Gaussian),
    (warps::ENLARGEMENT, Pixel::Cubic),
    (0, Pixel::Square),
    (1, Pixel::Square),
    (2, Pixel::Square),
];

/// What is compared.
struct Contest<'a> {
    programs: &'a Programs,
    scratch: &'a Path,
    sources: &'a [&'static Source],
    maps: &'a [Homography],
    cell: usize,
}

impl Contest<'_> {
    /// The errors of all contenders under a map.
    fn judged(
        &self,
        map: usize,
        pixel: Pixel,
        absent: &mut BTreeMap<&'static str, String>,
    ) -> Result<Heat, PeersError> {
        let field = contender::field(pixel).iter();
        let mut rows: Vec<(&Contender, Row)> = field.map(|c| (c, Row::default())).collect();
        for source in self.sources {
            let truth = Truth::new(source, &self.maps[map], pixel, self.cell)?;
            for (contender, row) in &mut rows {
                match contender.run(self.programs, &self.work(source, map))? {
                    Outcome::Done { pixels, .. } => row.psnr.push(truth.psnr(&pixels)),
                    Outcome::Absent(why) => {
                        absent.insert(contender.program(), why);
                    }
                }
            }
        }
        rows.retain(|(_, row)| row.psnr.len() == self.sources.len());
        Ok(Heat { map, pixel, rows })
    }

    /// One round of the clock.
    fn timed(&self, heat: &mut Heat) -> Result<(), PeersError> {
        for (contender, row) in &mut heat.rows {
            let work = self.work(self.sources[0], heat.map);
            if let Outcome::Done { ms, .. } = contender.run(self.programs, &work)? {
                row.ms.push(ms);
            }
        }
        Ok(())
    }

    fn work(&self, source: &'static Source, map: usize) -> Work<'_> {
        Work { source: source.name, map: &self.maps[map], scratch: self.scratch }
    }
}
