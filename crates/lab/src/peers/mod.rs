//! `scumble warp` beside other programs: the same images under the same maps in one run, errors
//! against brute force, and times, as a table for `docs/performance.md`.
//!
//! The clock of ours counts what is done between decoding and encoding: conversion, the pyramid, the
//! filter. A rival's counts its warp alone. All run on one thread, taking turns.

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
    /// Decibels, image by image.
    psnr: Vec<f64>,
    /// Milliseconds of each round, on the photograph.
    ms: Vec<f64>,
}

/// Compares, in so many rounds of the clock, and returns the tables in Markdown. The files that the
/// programs hand one another lie in `scratch`.
///
/// # Errors
/// [`PeersError`]; a rival that is not there or fails is named in the tables, and is no error.
pub fn compare(programs: &Programs, scratch: &Path, rounds: usize) -> Result<String, PeersError> {
    std::fs::create_dir_all(scratch)
        .map_err(|error| PeersError::File { path: scratch.to_owned(), error })?;
    let sources: Vec<&Source> =
        IMAGES.iter().filter_map(|name| SOURCES.iter().find(|s| s.name == *name)).collect();
    for source in &sources {
        contender::lay_out(source, scratch)?;
    }
    let mut absent = BTreeMap::new();
    let maps = warps::with_enlargement().map_err(crate::quality::QualityError::from)?;
    let mut rows = Vec::new();
    for (number, map) in maps.iter().enumerate() {
        rows.push(judged(programs, scratch, &sources, number, map, &mut absent)?);
    }
    for _ in 0..rounds {
        for (number, map) in maps.iter().enumerate() {
            for (contender, row) in &mut rows[number] {
                let work = Work { source: sources[0].name, map, scratch };
                if let Outcome::Done { ms, .. } = contender.run(programs, &work)? {
                    row.ms.push(ms);
                }
            }
        }
    }
    let mips = contender::mips(programs, rounds)?;
    Ok(table::page(&rows, &mips, &absent, rounds))
}

/// The errors of all contenders under one map.
fn judged(
    programs: &Programs,
    scratch: &Path,
    sources: &[&Source],
    number: usize,
    map: &Homography,
    absent: &mut BTreeMap<&'static str, String>,
) -> Result<Vec<(&'static Contender, Row)>, PeersError> {
    let field = contender::field(number).iter();
    let mut rows: Vec<(&Contender, Row)> = field.map(|c| (c, Row::default())).collect();
    for source in sources {
        let truth = truth::Truth::new(source, map, number == warps::ENLARGEMENT)?;
        for (contender, row) in &mut rows {
            let work = Work { source: source.name, map, scratch };
            match contender.run(programs, &work)? {
                Outcome::Done { pixels, .. } => row.psnr.push(truth.psnr(&pixels)),
                Outcome::Absent(why) => {
                    absent.insert(contender.program(), why);
                }
            }
        }
    }
    rows.retain(|(_, row)| row.psnr.len() == sources.len());
    Ok(rows)
}
