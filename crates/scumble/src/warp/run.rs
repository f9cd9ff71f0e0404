//! From a source to rows: the texture, the bands and the threads.

use super::extent::Extent;
use super::painter::Painter;
use super::{Border, Map, OutputPixel, Source, Warp, WarpError};
use crate::geometry::{IntRect, Rect};
use crate::pixel::{Image, Premul};
use crate::rows::{Pool, pump};
use crate::texture::{Levels, Texture, TextureOptions};
use crate::{Control, ImageSink, Sink};
use std::convert::Infallible;
use std::ops::Range;

/// Columns of a tile: their colours fit a first-level cache on the way to the rows.
const TILE_COLUMNS: usize = 512;

/// Rows of a tile, so that neighbouring rows find the source's texels where the one before left them.
const TILE_ROWS: usize = 16;

/// Tiles in flight for each thread: enough that a heavy one does not leave the others idle.
const TILES_PER_THREAD: usize = 8;

/// Outputs are positioned in `i32` pixels, with room for neighbours to be computed.
const MAX_SIDE: u32 = (1 << 30) - 1;

/// What a run did.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Stats {
    /// Columns of the picture.
    pub width: u32,
    /// Rows of the picture.
    pub height: u32,
    /// Bytes that the texture takes.
    pub texture_bytes: usize,
    /// Threads used.
    pub threads: usize,
}

/// A warp with its source made ready to be sampled.
pub struct Prepared<'a, M> {
    pub(super) warp: &'a Warp<M>,
    pub(super) texture: Texture,
    pub(super) opaque: bool,
    pub(super) area: IntRect,
    pub(super) pool: Pool,
}

impl<M: std::fmt::Debug> std::fmt::Debug for Prepared<'_, M> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Prepared").field("warp", &self.warp).field("area", &self.area).finish()
    }
}

impl<M: Map> Warp<M> {
    /// Makes a texture of the source, with the levels that this warp reads.
    ///
    /// # Errors
    /// [`WarpError`]: an output or crop without pixels, a singular homography, the memory limit, or a source
    /// that cannot become a texture.
    pub fn prepare<S: Source>(&self, source: &S) -> Result<Prepared<'_, M>, WarpError> {
        let area = self.area()?;
        if self.map.homography().is_some_and(|map| map.inverse().is_err()) {
            return Err(WarpError::Singular);
        }
        let opaque = source.is_opaque();
        let options = self.texture_options(source.size(), opaque, area);
        let pool = Pool::new(self.threads).map_err(WarpError::Threads)?;
        let [width, height] = source.size();
        let texels = Texture::memory_for(width, height, &options).map_or(u64::MAX, |n| n as u64);
        self.check_memory(texels)?;
        let texture = pool.install(|| source.texture(&options))?;
        Ok(Prepared { warp: self, texture, opaque, area, pool })
    }

    /// The whole result in memory, in eight bits.
    ///
    /// # Errors
    /// As [`Warp::prepare`].
    pub fn image<S: Source>(&self, source: &S) -> Result<Image<[u8; 4]>, WarpError> {
        let mut sink = ImageSink::new();
        self.prepare(source)?.draw(&mut sink, &Control::default())?;
        Ok(sink.into_image())
    }

    /// The pixels to make.
    fn area(&self) -> Result<IntRect, WarpError> {
        let Self { width, height, .. } = *self;
        if !(1..=MAX_SIDE).contains(&width) || !(1..=MAX_SIDE).contains(&height) {
            return Err(WarpError::Size { width, height });
        }
        let output = IntRect::new(0, 0, width as i32, height as i32);
        let area = self.crop.map_or(output, |crop| crop.intersect(&output));
        if area.is_empty() { Err(WarpError::Crop { width, height }) } else { Ok(area) }
    }

    /// What the texture must have. The levels depend on the whole output, so that a crop is that part of
    /// it.
    fn texture_options(&self, size: [usize; 2], opaque: bool, area: IntRect) -> TextureOptions {
        let visible = self.border.ends().then_some(size);
        let extent = Extent::of(&self.map, [self.width, self.height], visible);
        let levels = self.sampler.levels_for(extent.least, extent.most);
        let periodic = matches!(self.border, Border::Repeat | Border::Mirror);
        let map = self.map.homography().filter(|_| !periodic && levels != Levels::All);
        let source = (size, self.border.ends());
        let parts = map.and_then(|map| Extent::parts(&map, area, source, &self.sampler));
        let window = parts.and_then(|parts| parts.window);
        let outlines = parts.map(|parts| parts.outlines).unwrap_or_default();
        let levels = match levels {
            // Down to a single texel, which is the mean: those take little more.
            Levels::Range { first, .. } if window.is_none() => {
                Levels::Range { first, last: usize::MAX }
            }
            levels => levels,
        };
        let wrap = self.border.wrap(self.space, opaque);
        let space = self.space;
        let options = TextureOptions::default();
        TextureOptions { space, wrap, levels, window, outlines, ..options }
    }

    pub(super) fn check_memory<E>(&self, needed: u64) -> Result<(), WarpError<E>> {
        let limit = self.max_memory;
        if needed > limit { Err(WarpError::Memory { needed, limit }) } else { Ok(()) }
    }
}

impl<M: Map> Prepared<'_, M> {
    /// Draws into a sink, band by band from the top.
    ///
    /// # Errors
    /// [`WarpError`]: the memory limit, the caller's cancel flag, or the sink's own error. What the
    /// sink got before is then to be dropped.
    pub fn draw<P: OutputPixel, S: Sink<P>>(
        &self,
        sink: &mut S,
        control: &Control<'_>,
    ) -> Result<Stats, WarpError<S::Error>> {
        let (width, height) = (self.area.width(), self.area.height());
        let bands = Bands::new(self, control);
        let groups = self.pool.threads().min(2);
        let rows = (groups * bands.rows_per_group).min(height as usize) as u64;
        let buffers = rows * u64::from(width) * size_of::<P>() as u64;
        self.warp.check_memory(buffers + self.texture.memory() as u64)?;
        sink.start(width, height).map_err(WarpError::Sink)?;
        let groups = (height as usize).div_ceil(bands.rows_per_group);
        let render = |group: usize, buffer: &mut Vec<P>| bands.group(group, buffer);
        pump(groups, height, (&self.pool, control), sink, render)?;
        sink.finish().map_err(WarpError::Sink)?;
        Ok(self.stats())
    }

    /// Whether every pixel of the result is opaque, as far as that can be told beforehand: where the
    /// source is, no horizon is in sight, and the output shows nothing beyond an edge.
    #[must_use]
    pub fn is_opaque(&self) -> bool {
        let Some(map) = self.warp.map.homography() else { return false };
        let IntRect { x0, y0, x1, y1 } = self.area;
        let [left, top, right, bottom] = [x0 - 2, y0 - 2, x1 + 2, y1 + 2].map(f64::from);
        let size = [self.texture.width() as f64, self.texture.height() as f64];
        let inside = Rect::new(left, top, right, bottom).corners().map(|p| {
            let place = map.project(p)?;
            let within = (0.0..=size[0]).contains(&place.x) && (0.0..=size[1]).contains(&place.y);
            Some(within)
        });
        let ahead = inside.iter().all(Option::is_some);
        let filled = match self.warp.border {
            Border::Transparent => false,
            Border::Constant(color) => color.0[3] >= 1.0,
            Border::Clamp | Border::Repeat | Border::Mirror => true,
        };
        // What lies between four points inside is inside, too.
        self.opaque && ahead && (filled || inside.iter().all(|p| *p == Some(true)))
    }

    /// What a run does.
    #[must_use]
    pub fn stats(&self) -> Stats {
        Stats {
            width: self.area.width(),
            height: self.area.height(),
            texture_bytes: self.texture.memory(),
            threads: self.pool.threads(),
        }
    }

    pub(super) fn painter(&self) -> Painter<'_, M> {
        Painter::new(self.warp, &self.texture, self.opaque)
    }
}

/// The rows of the output in groups that are drawn together.
struct Bands<'a, M> {
    painter: Painter<'a, M>,
    prepared: &'a Prepared<'a, M>,
    control: &'a Control<'a>,
    rows_per_group: usize,
}

/// Some rows of some columns.
struct Tile<'a, P> {
    /// Its first pixel.
    x: i32,
    y: i32,
    rows: Vec<&'a mut [P]>,
}

impl<'a, M: Map> Bands<'a, M> {
    fn new(prepared: &'a Prepared<'a, M>, control: &'a Control<'a>) -> Self {
        let columns = (prepared.area.width() as usize).div_ceil(TILE_COLUMNS);
        let threads = prepared.pool.threads();
        let bands = if threads <= 1 { 1 } else { (threads * TILES_PER_THREAD).div_ceil(columns) };
        Self { painter: prepared.painter(), prepared, control, rows_per_group: bands * TILE_ROWS }
    }

    /// Draws a group, and says which rows it has, counted from the top of the picture.
    fn group<P: OutputPixel>(&self, group: usize, buffer: &mut Vec<P>) -> Range<u32> {
        let area = self.prepared.area;
        let (width, height) = (area.width() as usize, area.height() as usize);
        let rows = group * self.rows_per_group..((group + 1) * self.rows_per_group).min(height);
        buffer.resize(rows.len() * width, P::default());
        let mut tiles = Vec::new();
        for (band, rows_of_band) in buffer.chunks_mut(width * TILE_ROWS).enumerate() {
            let y = area.y0 + (rows.start + band * TILE_ROWS) as i32;
            let first = tiles.len();
            let starts = (0..width).step_by(TILE_COLUMNS);
            tiles.extend(starts.map(|x| Tile { x: area.x0 + x as i32, y, rows: Vec::new() }));
            for row in rows_of_band.chunks_mut(width) {
                for (tile, piece) in tiles[first..].iter_mut().zip(row.chunks_mut(TILE_COLUMNS)) {
                    tile.rows.push(piece);
                }
            }
        }
        self.prepared.pool.for_each(tiles, |tile| {
            if !self.control.is_cancelled() {
                self.draw(tile);
            }
        });
        rows.start as u32..rows.end as u32
    }

    fn draw<P: OutputPixel>(&self, tile: Tile<'_, P>) {
        let mut colors = [Premul::TRANSPARENT; TILE_COLUMNS];
        for (y, row) in (tile.y..).zip(tile.rows) {
            let colors = &mut colors[..row.len()];
            self.painter.row(tile.x, y, colors);
            P::encode(colors, self.prepared.warp.space, row);
        }
    }
}

impl WarpError<Infallible> {
    /// The same error beside one of a sink.
    #[must_use]
    pub fn widen<E>(self) -> WarpError<E> {
        match self {
            Self::Size { width, height } => WarpError::Size { width, height },
            Self::Crop { width, height } => WarpError::Crop { width, height },
            Self::Singular => WarpError::Singular,
            Self::Memory { needed, limit } => WarpError::Memory { needed, limit },
            Self::Source(error) => WarpError::Source(error),
            Self::Threads(error) => WarpError::Threads(error),
            Self::Cancelled => WarpError::Cancelled,
            Self::Sink(never) => match never {},
        }
    }
}
