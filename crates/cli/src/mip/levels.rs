//! The levels themselves.

use super::{Place, file_format};
use crate::args::{Edge, LevelFilter, Mip, Space, StoredAs};
use crate::error::Failure;
use crate::interrupt::Interrupt;
use crate::picture::{Channels, Depth, Encoder, Picture, Pixels, Tone};
use crate::progress::Steps;
use scumble::pixel::{Premul, WorkingSpace};
use scumble::texture::{Decimation, Levels, Texture, TextureError, TextureOptions, Wrap, maps};
use serde_json::{Value, json};
use std::sync::atomic::Ordering;

/// An alpha that is the threshold to this accuracy passes: codes are seldom what a person types.
const NEARLY: f32 = 1e-5;

/// How levels are made, and what their numbers are.
#[derive(Debug)]
pub(super) struct Plan {
    options: TextureOptions,
    alpha_coverage: Option<f32>,
    normal_map: bool,
    pub(super) channels: Channels,
    pub(super) depth: Depth,
    /// What the numbers are to light.
    pub(super) written: Tone,
    /// Whether colours are stored multiplied by alpha.
    pub(super) premultiplied: bool,
    pub(super) force: bool,
}

/// A level, its numbers as they are stored.
#[derive(Debug)]
pub(super) struct Level {
    pub(super) width: u32,
    pub(super) height: u32,
    pub(super) pixels: Pixels,
    /// The part of it that passes the test of alpha, if that was asked for.
    coverage: Option<f64>,
}

impl Plan {
    pub(super) fn new(options: &Mip, picture: &Picture, place: &Place) -> Result<Self, Failure> {
        let normal_map = options.normal_map;
        if normal_map && (picture.channels.is_gray() || picture.origin.depth.is_float()) {
            return Err(Failure::Usage(
                "--normal-map takes red, green and blue in 8 or 16 bits".to_owned(),
            ));
        }
        if options.alpha_coverage.is_some() && !picture.channels.has_alpha() {
            return Err(Failure::Usage("--alpha-coverage: the picture has no alpha".to_owned()));
        }
        check_memory(options, picture)?;
        let depth = match options.depth {
            None => picture.origin.depth,
            Some(StoredAs::Eight) => Depth::Eight,
            Some(StoredAs::Sixteen) => Depth::Sixteen,
            Some(StoredAs::Half) => Depth::Half,
            Some(StoredAs::Float) => Depth::Float,
        };
        if normal_map && depth.is_float() {
            return Err(Failure::Usage("--normal-map is stored in 8 or 16 bits".to_owned()));
        }
        let files = matches!(place, Place::Folder(_));
        let written = match depth.is_float() {
            true => Tone::Linear,
            false if normal_map || (files && picture.icc.is_some()) => picture.tone.clone(),
            false => Tone::Srgb,
        };
        Ok(Self {
            options: texture_options(options),
            alpha_coverage: options.alpha_coverage,
            normal_map,
            channels: picture.channels,
            depth,
            written,
            premultiplied: files && file_format(depth).0.premultiplies(),
            force: options.force,
        })
    }

    pub(super) fn space_name(&self) -> &'static str {
        match self.options.space {
            _ if self.normal_map => "vectors",
            WorkingSpace::Srgb => "srgb",
            WorkingSpace::Linear => "linear",
        }
    }

    /// Whether the numbers are directions, and no colours.
    pub(super) fn is_data(&self) -> bool {
        self.normal_map
    }

    /// Whether the picture's numbers are those of level 0.
    fn keeps(&self, picture: &Picture) -> bool {
        self.depth == picture.origin.depth
            && self.written == picture.tone
            && (self.premultiplied == picture.premultiplied || !self.channels.has_alpha())
    }
}

/// Refuses what would take more memory than it may: the picture and all levels, as numbers and as the
/// filter has them, and one level as floats.
fn check_memory(options: &Mip, picture: &Picture) -> Result<(), Failure> {
    let (width, height) = (picture.width as usize, picture.height as usize);
    let texels = width as u64 * height as u64;
    let texture = Texture::memory_for(width, height, &texture_options(options));
    let texture = texture.map_or(u64::MAX, |bytes| bytes as u64);
    let floats = 16 * texels * if matches!(picture.pixels, Pixels::U8(_)) { 1 } else { 2 };
    let numbers = 4 * u64::from(picture.origin.depth.bits() / 8) * texels * 7 / 3;
    let needed = texture.saturating_add(floats).saturating_add(numbers);
    let most = options.limits.max_memory;
    if needed > most {
        return Err(Failure::Limit(format!(
            "the levels take {needed} bytes; at most {most} are allowed (--max-memory)"
        )));
    }
    Ok(())
}

fn texture_options(options: &Mip) -> TextureOptions {
    let space = match options.space {
        Some(Space::Srgb) => WorkingSpace::Srgb,
        Some(Space::Linear) | None => WorkingSpace::Linear,
    };
    let wrap = match options.wrap {
        Edge::Clamp => Wrap::Clamp,
        Edge::Repeat => Wrap::Repeat,
        Edge::Mirror => Wrap::Mirror,
    };
    let decimation = match options.filter {
        LevelFilter::Kaiser => Decimation::Kaiser,
        LevelFilter::Box => Decimation::Box,
    };
    let levels = match options.levels {
        Some(n) => Levels::Range { first: 0, last: n.saturating_sub(1) },
        None => Levels::All,
    };
    TextureOptions { space, wrap, decimation, levels, ..TextureOptions::default() }
}

/// Makes all levels; a texel is a step.
pub(super) fn build(
    picture: &Picture,
    plan: &Plan,
    interrupt: &Interrupt,
    steps: &Steps,
) -> Result<Vec<Level>, Failure> {
    let made = if plan.normal_map {
        normals(picture, plan, interrupt, steps)
    } else {
        colors(picture, plan, interrupt, steps)
    };
    made?.map_err(|e| match e {
        TextureError::TooLarge { .. } | TextureError::OutOfMemory { .. } => {
            Failure::Limit(format!("the levels: {e}"))
        }
        e => Failure::Failed(format!("the levels: {e}")),
    })
}

type Made = Result<Result<Vec<Level>, TextureError>, Failure>;

fn colors(picture: &Picture, plan: &Plan, interrupt: &Interrupt, steps: &Steps) -> Made {
    let texture = match picture.texture(&plan.options) {
        Ok(texture) => texture,
        Err(e) => return Ok(Err(e)),
    };
    let (space, written) = (plan.options.space, plan.written.clone());
    let encoder =
        Encoder::into_numbers(space, &picture.tone, written, plan.channels, plan.premultiplied);
    let threshold = plan.alpha_coverage.map(|t| (t - NEARLY).max(f32::MIN_POSITIVE));
    let mut part = 0.0;
    let mut levels = Vec::new();
    for l in 0..texture.level_count() {
        stop_if(interrupt)?;
        let Some(mut image) = texture.level(l) else { break };
        let coverage = threshold.map(|threshold| {
            if l == 0 {
                part = maps::coverage(image.pixels(), threshold);
            } else {
                let factor = maps::coverage_scale(image.pixels(), threshold, part);
                maps::scale_alpha(image.pixels_mut(), factor);
            }
            maps::coverage(image.pixels(), threshold)
        });
        let pixels = if l == 0 && plan.keeps(picture) {
            steps.add(image.pixels().len() as u64);
            picture.pixels.clone()
        } else {
            let mut pixels = Pixels::empty(plan.depth);
            let mut row = Vec::new();
            for y in 0..image.height() {
                row.clear();
                row.extend(image.row(y).iter().map(|&c| in_range(c)));
                encoder.row(&row, &mut pixels);
                steps.add(image.width() as u64);
            }
            pixels
        };
        let (width, height) = (image.width() as u32, image.height() as u32);
        levels.push(Level { width, height, pixels, coverage });
    }
    Ok(Ok(levels))
}

/// A sharp filter overshoots; an alpha that does is none.
fn in_range([r, g, b, a]: [f32; 4]) -> Premul {
    Premul([r, g, b, a.clamp(0.0, 1.0)])
}

fn normals(picture: &Picture, plan: &Plan, interrupt: &Interrupt, steps: &Steps) -> Made {
    let options = TextureOptions { space: WorkingSpace::Srgb, ..plan.options };
    let colors = picture.part(0..3).texture(&options);
    let alphas = picture.channels.has_alpha().then(|| picture.part(3..4).texture(&options));
    let (vectors, alphas) = match (colors, alphas.transpose()) {
        (Ok(vectors), Ok(alphas)) => (vectors, alphas),
        (Err(e), _) | (_, Err(e)) => return Ok(Err(e)),
    };
    let mut levels = Vec::new();
    for l in 0..vectors.level_count() {
        stop_if(interrupt)?;
        let Some(mut image) = vectors.level(l) else { break };
        maps::normalize_row(image.pixels_mut());
        if let Some(alpha) = alphas.as_ref().and_then(|a| a.level(l)) {
            for (texel, alpha) in image.pixels_mut().iter_mut().zip(alpha.pixels()) {
                texel[3] = alpha[0];
            }
        }
        let pixels = if l == 0 && plan.keeps(picture) {
            picture.pixels.clone()
        } else {
            let mut pixels = Pixels::empty(plan.depth);
            Encoder::data(plan.channels, image.pixels(), &mut pixels);
            pixels
        };
        let (width, height) = (image.width() as u32, image.height() as u32);
        levels.push(Level { width, height, pixels, coverage: None });
        steps.add(u64::from(width) * u64::from(height));
    }
    Ok(Ok(levels))
}

fn stop_if(interrupt: &Interrupt) -> Result<(), Failure> {
    match interrupt.cancel().load(Ordering::Relaxed) {
        true => Err(interrupt.failure()),
        false => Ok(()),
    }
}

impl Level {
    /// One without a coverage.
    #[cfg(test)]
    pub(super) fn bare(width: u32, height: u32, pixels: Pixels) -> Self {
        Self { width, height, pixels, coverage: None }
    }

    pub(super) fn json(&self) -> Value {
        let mut json = json!({ "width": self.width, "height": self.height });
        if let Some(coverage) = self.coverage {
            json["coverage"] = coverage.into();
        }
        json
    }
}
