//! The measurements.

use super::QualityError;
use super::methods::{self, Method};
use super::sources::{SOURCES, Source};
use super::warps;
use scumble::texture::reference::{PixelShape, Reference};
use scumble::texture::{Footprint, Texture};
use scumble_geometry::{DVec2, Homography};

/// How a method does on one image under one map.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(crate) struct Score {
    /// Decibels.
    pub(crate) psnr: f64,
    /// Texels read for a pixel, the mean.
    pub(crate) texels: f64,
}

/// What one image gave.
#[derive(Default)]
struct Column {
    /// For each warp, the methods of the table and then those of each family.
    warps: Vec<Vec<Score>>,
    /// For each scale of the sweep, the presets.
    sweep: Vec<Vec<Score>>,
}

/// All that the page says.
pub(crate) struct Study {
    columns: Vec<Column>,
    /// Places compared, for each warp.
    pub(crate) places: Vec<usize>,
}

/// Texels per pixel of the sweep: two octaves in steps of an eighth.
pub(crate) fn scales() -> Vec<f64> {
    // Eighths of an octave by square roots, which round the same everywhere.
    let step = 2.0f64.sqrt().sqrt().sqrt();
    std::iter::successors(Some(2.0), |s| Some(s * step)).take(17).collect()
}

impl Study {
    /// Measures with one place in every `cell`×`cell` pixels; for the sweep and the plot's curves
    /// with one in four times as many.
    pub(crate) fn new(cell: usize) -> Result<Self, QualityError> {
        let warps = warps::all()?;
        let places = warps.iter().map(|w| warps::places(w, cell).len()).collect();
        let mut slots: Vec<Result<Column, QualityError>> = Vec::new();
        slots.resize_with(SOURCES.len(), || Ok(Column::default()));
        std::thread::scope(|scope| {
            for (slot, source) in slots.iter_mut().zip(&SOURCES) {
                let warps = &warps;
                scope.spawn(move || *slot = column(source, warps, cell));
            }
        });
        Ok(Self { columns: slots.into_iter().collect::<Result<_, _>>()?, places })
    }

    /// The scores of a method on a warp, image by image.
    fn scores(&self, warp: usize, method: usize) -> impl Iterator<Item = Score> {
        self.columns.iter().map(move |c| c.warps[warp][method])
    }

    /// Decibels of a method on a warp, image by image.
    pub(crate) fn row(&self, warp: usize, method: usize) -> Vec<f64> {
        self.scores(warp, method).map(|s| s.psnr).collect()
    }

    /// The worst image's decibels, and the texels read.
    pub(crate) fn worst(&self, warp: usize, method: usize) -> Score {
        let worst = self.scores(warp, method).fold(f64::INFINITY, |w, s| w.min(s.psnr));
        Score { psnr: worst, texels: self.columns[0].warps[warp][method].texels }
    }

    /// For a preset, counted from the first: for each scale of the sweep the worst image's decibels
    /// and its index.
    pub(crate) fn sweep(&self, preset: usize) -> Vec<(f64, usize)> {
        let at = |scale: usize| {
            let images = self.columns.iter().map(|c| c.sweep[scale][preset].psnr).zip(0..);
            images.fold((f64::INFINITY, 0), |a, b| if b.0 < a.0 { b } else { a })
        };
        (0..scales().len()).map(at).collect()
    }
}

fn column(source: &Source, warps: &[Homography], cell: usize) -> Result<Column, QualityError> {
    let t = source.texture()?;
    let table: Vec<Method> = methods::TABLE.map(|(_, m)| m).to_vec();
    let curves = methods::families().into_iter().flat_map(|(_, methods)| methods);
    let all: Vec<Method> = table.iter().copied().chain(curves).collect();
    let of_warp = |w: &Homography| scores(&t, w, &warps::places(w, cell), &all);
    let presets = &table[methods::PRESETS_FROM..];
    let of_scale = |scale: f64| {
        let map = warps::turned(scale);
        scores(&t, &map, &warps::places(&map, 2 * cell), presets)
    };
    Ok(Column {
        warps: warps.iter().map(of_warp).collect(),
        sweep: scales().into_iter().map(of_scale).collect(),
    })
}

/// Each method against brute force at some places.
fn scores(t: &Texture, map: &Homography, places: &[DVec2], methods: &[Method]) -> Vec<Score> {
    let brute = Reference::new(t, PixelShape::Gaussian { sigma: 0.5 }).with_density(2.0, 16);
    let truth: Vec<[f64; 4]> = places.iter().map(|p| brute.sample(map, *p)).collect();
    let score = |method: &Method| {
        let (mut error, mut texels) = (0.0, 0);
        for (p, truth) in places.iter().zip(&truth) {
            let f = Footprint::at(map, *p);
            let found = method.color(t, &f);
            error += (0..3).map(|c| (f64::from(found[c]) - truth[c]).powi(2)).sum::<f64>();
            texels += method.texels(t, &f);
        }
        let count = places.len().max(1) as f64;
        Score { psnr: -10.0 * (error / (3.0 * count)).log10(), texels: texels as f64 / count }
    };
    methods.iter().map(score).collect()
}
