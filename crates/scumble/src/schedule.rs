//! Which tile when, on which thread, and the way of the rows to the sink.

use crate::rows::{Pool, Spares, Stopped, pump};
use crate::strips::{self, Wanted};
use crate::tile::{Job, Workspace};
use crate::{Antialias, Control, RenderError, Sink};
use scumble_geometry::{IntRect, TileBins, TileGrid};
use std::ops::Range;
use std::sync::atomic::AtomicU64;

/// Tiles in flight for each thread: enough that a heavy tile does not leave the others idle.
const TILES_PER_THREAD: usize = 8;

/// Bands that are rendered together: at least one, and enough tiles for all threads.
fn bands_per_group(grid: &TileGrid, threads: usize) -> usize {
    if threads <= 1 { 1 } else { (threads * TILES_PER_THREAD).div_ceil(grid.columns()) }
}

/// Rows held in memory at once: one group being rendered, and with several threads one being handed over.
pub(crate) fn buffered_rows(grid: &TileGrid, threads: usize) -> usize {
    threads.min(2)
        * (bands_per_group(grid, threads) * grid.height() as usize)
            .min(grid.area().height() as usize)
}

/// Renders all bands and hands them to the sink, which takes one group of bands while the next
/// is rendered.
pub(crate) fn run<S: Sink>(
    job: &Job<'_>,
    grid: TileGrid,
    bins: TileBins,
    pool: &Pool,
    sink: &mut S,
    control: &Control<'_>,
) -> Result<(), RenderError<S::Error>> {
    let step = bands_per_group(&grid, pool.threads());
    let mut groups =
        Groups { job, grid, bins, pool, control, lists: Vec::new(), idle: Spares::default() };
    let count = grid.bands().div_ceil(step);
    let render = |group: usize, buffer: &mut Vec<[u8; 4]>| {
        let bands = group * step..((group + 1) * step).min(grid.bands());
        let rows = groups.rows(&bands);
        groups.render(bands, buffer);
        rows
    };
    let outcome = pump(count, grid.area().height(), (pool, control), sink, render);
    outcome.map_err(|stopped| match stopped {
        Stopped::Cancelled => RenderError::Cancelled,
        Stopped::Sink(error) => RenderError::Sink(error),
    })
}

struct Groups<'a> {
    job: &'a Job<'a>,
    grid: TileGrid,
    bins: TileBins,
    pool: &'a Pool,
    control: &'a Control<'a>,
    /// For each tile of the group, what touches it.
    lists: Vec<Vec<u32>>,
    /// Workspaces that no thread is using.
    idle: Spares<Workspace>,
}

/// A tile to be rendered, with its pieces of the group's rows.
struct TileTask<'a> {
    rect: IntRect,
    list: &'a [u32],
    strips: &'a [Wanted<'a>],
    rows: Vec<&'a mut [[u8; 4]]>,
}

impl Groups<'_> {
    /// The rows of some bands, counted from the top of the picture.
    fn rows(&self, bands: &Range<usize>) -> Range<u32> {
        let end = |band: usize| (band as u32 * self.grid.height()).min(self.grid.area().height());
        end(bands.start)..end(bands.end)
    }

    fn render(&mut self, bands: Range<usize>, buffer: &mut Vec<[u8; 4]>) {
        let (columns, grid) = (self.grid.columns(), self.grid);
        let (across, side) = (grid.width() as usize, grid.height() as usize);
        let width = grid.area().width() as usize;
        buffer.resize(self.rows(&bands).len() * width, [0; 4]);
        self.lists.resize_with(bands.len() * columns, Vec::new);
        for (band, lists) in bands.clone().zip(self.lists.chunks_mut(columns)) {
            self.bins.fill(band, lists);
        }
        let found = self.strips(bands.clone());
        let mut tasks = Vec::with_capacity(self.lists.len());
        let pieces = buffer.chunks_mut(width * side);
        let lists = self.lists.chunks(columns).zip(&found);
        for ((band, strip), (lists, strips)) in bands.zip(pieces).zip(lists) {
            let first = tasks.len();
            tasks.extend(lists.iter().enumerate().map(|(column, list)| TileTask {
                rect: grid.tile(column, band),
                list,
                strips,
                rows: Vec::with_capacity(side),
            }));
            for row in strip.chunks_mut(width) {
                for (task, piece) in tasks[first..].iter_mut().zip(row.chunks_mut(across)) {
                    task.rows.push(piece);
                }
            }
        }
        let (job, control) = (self.job, self.control);
        self.pool.for_each(tasks, |mut task| {
            if !control.is_cancelled() {
                let lists = (task.list, task.strips);
                self.idle.lend(|work| job.tile(work, task.rect, lists, &mut task.rows));
            }
        });
    }

    /// What is found once for each of the bands.
    fn strips(&self, bands: Range<usize>) -> Vec<Vec<Wanted<'_>>> {
        let (job, grid) = (self.job, &self.grid);
        let mut found: Vec<Vec<Wanted<'_>>> = Vec::with_capacity(bands.len());
        if job.settings.antialias != Antialias::Area {
            found.resize_with(bands.len(), Vec::new);
            return found;
        }
        let lists = self.lists.chunks(grid.columns());
        found.extend(bands.zip(lists).map(|(band, l)| strips::wanted(job.plan, grid, band, l)));
        let spare = AtomicU64::new(job.spare.min(strips::MAX_BYTES));
        self.pool.for_each(found.iter_mut().flatten().collect(), |wanted| {
            if !self.control.is_cancelled() {
                self.idle.lend(|work| wanted.find(grid, &spare, &mut work.scratch));
            }
        });
        found
    }
}
