//! Which tile when, on which thread, and the way of the rows to the sink.

use crate::tile::{Job, Workspace};
use crate::{Control, RenderError, Sink};
use scumble_geometry::{IntRect, TileBins, TileGrid};
use std::ops::Range;
use std::sync::{Mutex, PoisonError};

/// Tiles in flight for each thread: enough that a heavy tile does not leave the others idle.
const TILES_PER_THREAD: usize = 8;

/// One thread, or several.
pub(crate) enum Pool {
    Serial,
    #[cfg(feature = "parallel")]
    Parallel(rayon::ThreadPool),
}

impl Pool {
    /// A pool of `threads` threads; 0 is one for each processor.
    pub(crate) fn new(threads: usize) -> Result<Self, String> {
        #[cfg(feature = "parallel")]
        if threads != 1 {
            let pool = rayon::ThreadPoolBuilder::new()
                .num_threads(threads)
                .build()
                .map_err(|error| error.to_string())?;
            if pool.current_num_threads() > 1 {
                return Ok(Self::Parallel(pool));
            }
        }
        let _ = threads;
        Ok(Self::Serial)
    }

    pub(crate) fn threads(&self) -> usize {
        match self {
            Self::Serial => 1,
            #[cfg(feature = "parallel")]
            Self::Parallel(pool) => pool.current_num_threads(),
        }
    }

    /// Runs a closure so that what it does in parallel runs in this pool.
    pub(crate) fn install<T: Send>(&self, f: impl FnOnce() -> T + Send) -> T {
        match self {
            Self::Serial => f(),
            #[cfg(feature = "parallel")]
            Self::Parallel(pool) => pool.install(f),
        }
    }

    /// Runs both, side by side if there are threads.
    fn join<A: Send, B: Send>(
        &self,
        a: impl FnOnce() -> A + Send,
        b: impl FnOnce() -> B + Send,
    ) -> (A, B) {
        match self {
            Self::Serial => (a(), b()),
            #[cfg(feature = "parallel")]
            Self::Parallel(pool) => pool.install(|| rayon::join(a, b)),
        }
    }

    /// What becomes of each item, in their order.
    pub(crate) fn map<T: Send, U: Send>(
        &self,
        items: Vec<T>,
        f: impl Fn(T) -> U + Sync + Send,
    ) -> Vec<U> {
        match self {
            Self::Serial => items.into_iter().map(f).collect(),
            #[cfg(feature = "parallel")]
            Self::Parallel(pool) => {
                use rayon::iter::{IntoParallelIterator, ParallelIterator};
                pool.install(|| items.into_par_iter().map(f).collect())
            }
        }
    }

    fn for_each<T: Send>(&self, items: Vec<T>, f: impl Fn(T) + Sync + Send) {
        match self {
            Self::Serial => items.into_iter().for_each(f),
            #[cfg(feature = "parallel")]
            Self::Parallel(_) => {
                use rayon::iter::{IntoParallelIterator, ParallelIterator};
                items.into_par_iter().for_each(f);
            }
        }
    }
}

/// Bands that are rendered together: at least one, and enough tiles for all threads.
fn bands_per_group(grid: &TileGrid, threads: usize) -> usize {
    if threads <= 1 { 1 } else { (threads * TILES_PER_THREAD).div_ceil(grid.columns()) }
}

/// Rows held in memory at once: one group being rendered, one being handed over.
pub(crate) fn buffered_rows(grid: &TileGrid, threads: usize) -> usize {
    2 * (bands_per_group(grid, threads) * grid.side() as usize).min(grid.area().height() as usize)
}

/// Renders all bands and hands them to the sink, which takes one group of bands while the next
/// is rendered.
pub(crate) fn run<S: Sink>(
    job: &Job<'_>,
    grid: TileGrid,
    mut bins: TileBins,
    pool: &Pool,
    sink: &mut S,
    control: &Control<'_>,
) -> Result<(), RenderError<S::Error>> {
    let step = bands_per_group(&grid, pool.threads());
    let groups = Groups { job, grid, pool, control, idle: Mutex::default() };
    let (mut ready, mut next) = (Vec::new(), Vec::new());
    let (mut lists, mut next_lists) = (Vec::new(), Vec::new());
    let mut ready_rows = 0..0;
    // One round more than there are groups: the last only hands over.
    let band = |group: usize| (group * step).min(grid.bands());
    fill(&mut bins, grid, band(0)..band(1), &mut lists);
    for group in 0..=grid.bands().div_ceil(step) {
        let bands = band(group)..band(group + 1);
        let rows = groups.rows(&bands);
        let (taken, ()) = pool.join(
            || {
                fill(&mut bins, grid, band(group + 1)..band(group + 2), &mut next_lists);
                if ready_rows.is_empty() { Ok(()) } else { sink.rows(ready_rows.start, &ready) }
            },
            || groups.render(bands, &lists, &mut next),
        );
        std::mem::swap(&mut lists, &mut next_lists);
        taken.map_err(RenderError::Sink)?;
        if control.is_cancelled() {
            return Err(RenderError::Cancelled);
        }
        if !ready_rows.is_empty() {
            control.report(ready_rows.end, grid.area().height());
        }
        std::mem::swap(&mut ready, &mut next);
        ready_rows = rows;
    }
    Ok(())
}

/// For each tile of some bands, what touches it.
fn fill(bins: &mut TileBins, grid: TileGrid, bands: Range<usize>, lists: &mut Vec<Vec<u32>>) {
    lists.resize_with(bands.len() * grid.columns(), Vec::new);
    for (band, lists) in bands.zip(lists.chunks_mut(grid.columns())) {
        bins.fill(band, lists);
    }
}

struct Groups<'a> {
    job: &'a Job<'a>,
    grid: TileGrid,
    pool: &'a Pool,
    control: &'a Control<'a>,
    /// Workspaces that no thread is using.
    idle: Mutex<Vec<Workspace>>,
}

/// A tile to be rendered, with its pieces of the group's rows.
struct TileTask<'a> {
    rect: IntRect,
    list: &'a [u32],
    rows: Vec<&'a mut [[u8; 4]]>,
}

impl Groups<'_> {
    /// The rows of some bands, counted from the top of the picture.
    fn rows(&self, bands: &Range<usize>) -> Range<u32> {
        let end = |band: usize| (band as u32 * self.grid.side()).min(self.grid.area().height());
        end(bands.start)..end(bands.end)
    }

    fn render(&self, bands: Range<usize>, lists: &[Vec<u32>], buffer: &mut Vec<[u8; 4]>) {
        let (columns, grid) = (self.grid.columns(), self.grid);
        let width = grid.area().width() as usize;
        buffer.resize(self.rows(&bands).len() * width, [0; 4]);
        let mut tasks = Vec::with_capacity(lists.len());
        let strips = buffer.chunks_mut(width * grid.side() as usize);
        for ((band, strip), lists) in bands.zip(strips).zip(lists.chunks(columns)) {
            let first = tasks.len();
            tasks.extend(lists.iter().enumerate().map(|(column, list)| TileTask {
                rect: grid.tile(column, band),
                list,
                rows: Vec::with_capacity(grid.side() as usize),
            }));
            for row in strip.chunks_mut(width) {
                for (task, piece) in
                    tasks[first..].iter_mut().zip(row.chunks_mut(grid.side() as usize))
                {
                    task.rows.push(piece);
                }
            }
        }
        let (job, control, idle) = (self.job, self.control, &self.idle);
        self.pool.for_each(tasks, |mut task| {
            if control.is_cancelled() {
                return;
            }
            // A poisoned lock means that another tile panicked; its workspace is gone, not ours.
            let lock = || idle.lock().unwrap_or_else(PoisonError::into_inner);
            let mut work = lock().pop().unwrap_or_default();
            job.tile(&mut work, task.rect, task.list, &mut task.rows);
            lock().push(work);
        });
    }
}
