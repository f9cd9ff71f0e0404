use crate::plan::{self, Plan};
use crate::rows::Pool;
use crate::schedule;
use crate::tile::Job;
use crate::{Background, Control, ImageSink, RenderError, Settings, Sink, Textures};
use scumble_framebuffer::{Inlay, Tile, Visibility};
use scumble_geometry::{IntRect, TileGrid};
use scumble_pixel::{Image, Premul};
use scumble_scene::Scene;
use std::convert::Infallible;

/// Canvases are positioned in `i32` pixels, with room for neighbours to be computed.
const MAX_SIDE: u32 = (1 << 30) - 1;

/// What a run did.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Stats {
    /// Columns of the picture.
    pub width: u32,
    /// Rows of the picture.
    pub height: u32,
    /// Primitives that touch the canvas.
    pub primitives: usize,
    /// Bytes that the textures and their pyramids took.
    pub texture_bytes: usize,
    /// Threads used.
    pub threads: usize,
}

/// Renders a scene into a sink, band by band from the top.
///
/// The bytes depend on the scene and on the settings that say so: not on
/// [`Settings::threads`], [`Settings::tile_size`], the machine or its instruction set.
///
/// # Errors
/// [`RenderError`]: a canvas or crop without pixels, the memory limit, an unusable image, the
/// caller's cancel flag, or the sink's own error. What the sink got before is then to be dropped.
pub fn render<S: Sink>(
    scene: &Scene,
    settings: &Settings,
    sink: &mut S,
    control: &Control<'_>,
) -> Result<Stats, RenderError<S::Error>> {
    let pool = Pool::new(settings.threads).map_err(RenderError::Threads)?;
    area::<S::Error>(settings)?;
    let textures = pool.install(|| Textures::build(scene, settings))?;
    draw(scene, &textures, settings, sink, control, &pool)
}

/// [`render`] with textures that were made before: for many pictures of one scene, or of scenes
/// that share their images.
///
/// # Errors
/// As [`render`]; and [`RenderError::Textures`] if they are not the ones that this scene needs with
/// these settings.
pub fn render_with<S: Sink>(
    scene: &Scene,
    textures: &Textures,
    settings: &Settings,
    sink: &mut S,
    control: &Control<'_>,
) -> Result<Stats, RenderError<S::Error>> {
    if !textures.serve(scene, settings) {
        return Err(RenderError::Textures);
    }
    let pool = Pool::new(settings.threads).map_err(RenderError::Threads)?;
    draw(scene, textures, settings, sink, control, &pool)
}

fn draw<S: Sink>(
    scene: &Scene,
    textures: &Textures,
    settings: &Settings,
    sink: &mut S,
    control: &Control<'_>,
    pool: &Pool,
) -> Result<Stats, RenderError<S::Error>> {
    let area = area(settings)?;
    let texture_bytes = textures.memory();
    let plan = plan::build(scene, settings, &textures.surfaces, pool);
    let grid = plan.grid(area, settings);
    let spare = check_memory(&plan, settings, &grid, pool.threads(), texture_bytes)?;
    let stats = Stats {
        width: area.width(),
        height: area.height(),
        primitives: plan.len(),
        texture_bytes,
        threads: pool.threads(),
    };
    let job = Job { plan: &plan, settings, background: background(scene, settings), spare };
    let bins = plan.bins(grid, pool);
    sink.start(stats.width, stats.height).map_err(RenderError::Sink)?;
    schedule::run(&job, grid, bins, pool, sink, control)?;
    sink.finish().map_err(RenderError::Sink)?;
    Ok(stats)
}

/// Renders a scene into an image in memory: sRGB-encoded, straight alpha.
///
/// # Errors
/// As [`render`].
pub fn render_image(
    scene: &Scene,
    settings: &Settings,
) -> Result<Image<[u8; 4]>, RenderError<Infallible>> {
    let mut sink = ImageSink::new();
    render(scene, settings, &mut sink, &Control::default())?;
    Ok(sink.into_image())
}

/// The pixels to render.
fn area<E>(settings: &Settings) -> Result<IntRect, RenderError<E>> {
    let Settings { width, height, tile_size, .. } = *settings;
    if !(1..=MAX_SIDE).contains(&width) || !(1..=MAX_SIDE).contains(&height) {
        return Err(RenderError::Canvas { width, height });
    }
    if !(8..=256).contains(&tile_size) {
        return Err(RenderError::TileSize(tile_size));
    }
    let canvas = IntRect::new(0, 0, width as i32, height as i32);
    let area = settings.crop.map_or(canvas, |crop| crop.intersect(&canvas));
    if area.is_empty() {
        return Err(RenderError::Crop { width, height });
    }
    Ok(area)
}

fn background(scene: &Scene, settings: &Settings) -> Premul {
    let color = match settings.background {
        Background::Scene => scene.background,
        Background::Transparent => None,
        Background::Color(color) => Some(color),
    };
    color.map_or(Premul::TRANSPARENT, |color| settings.space.import(color))
}

pub(crate) fn check_limit<E>(needed: u64, settings: &Settings) -> Result<(), RenderError<E>> {
    let limit = settings.max_memory;
    if needed > limit { Err(RenderError::Memory { needed, limit }) } else { Ok(()) }
}

/// The memory of the whole run, as far as it can be known before the first tile, must be within the
/// limit. Tells what is left of that.
fn check_memory<E>(
    plan: &Plan<'_>,
    settings: &Settings,
    grid: &TileGrid,
    threads: usize,
    texture_bytes: usize,
) -> Result<u64, RenderError<E>> {
    let (side, samples) = (settings.tile_size, settings.samples());
    let seen = Visibility::max_bytes(side, side, samples);
    let inlay = Inlay::max_bytes(grid.width(), grid.height());
    let tile = seen + inlay + Tile::max_bytes(side, side, samples);
    let depth = plan.layers.iter().map(|layer| layer.depth).max().unwrap_or(1);
    let tiles = tile.saturating_mul(depth).saturating_mul(threads as u64);
    let rows = schedule::buffered_rows(grid, threads) as u64 * u64::from(grid.area().width()) * 4;
    let all = [tiles, rows, plan.bytes(), texture_bytes as u64];
    let needed = all.into_iter().fold(0, u64::saturating_add);
    check_limit(needed, settings)?;
    Ok(settings.max_memory - needed)
}
