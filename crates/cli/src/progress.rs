//! A progress bar for work that takes its time, where somebody is watching.

use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};
use std::cell::Cell;
use std::io::{self, IsTerminal};
use std::sync::OnceLock;
use std::time::{Duration, Instant};

/// How long a run may take before it shows a bar: shorter ones would only flicker.
const PATIENCE: Duration = Duration::from_millis(500);

/// Redraws a second.
const REFRESH_HZ: u8 = 10;

/// A bar that appears when it is worth it.
#[derive(Debug)]
pub(crate) struct Progress {
    watched: bool,
    since: Instant,
    bar: OnceLock<ProgressBar>,
}

impl Progress {
    /// A bar on standard error, if that is a terminal and the user wants to be told.
    pub(crate) fn new(quiet: bool) -> Self {
        Self::starting(!quiet && io::stderr().is_terminal(), Instant::now())
    }

    fn starting(watched: bool, since: Instant) -> Self {
        Self { watched, since, bar: OnceLock::new() }
    }

    /// `done` of `total` rows are finished. Any thread may say so.
    pub(crate) fn update(&self, done: impl Into<u64>, total: impl Into<u64>) {
        let (done, total) = (done.into(), total.into());
        let due = self.watched && done < total && self.since.elapsed() >= PATIENCE;
        if due || self.bar.get().is_some() {
            self.bar.get_or_init(|| new_bar(total)).set_position(done);
        }
    }

    /// Takes the bar away.
    pub(crate) fn clear(&self) {
        if let Some(bar) = self.bar.get() {
            bar.finish_and_clear();
        }
    }
}

/// A bar for work that is done piece by piece on one thread.
#[derive(Debug)]
pub(crate) struct Steps {
    progress: Progress,
    done: Cell<u64>,
    total: u64,
}

impl Steps {
    /// For so many steps of any size.
    pub(crate) fn new(quiet: bool, total: u64) -> Self {
        Self { progress: Progress::new(quiet), done: Cell::new(0), total }
    }

    /// So many more are done.
    pub(crate) fn add(&self, steps: u64) {
        self.done.set(self.done.get().saturating_add(steps));
        self.progress.update(self.done.get(), self.total);
    }

    /// Takes the bar away.
    pub(crate) fn clear(&self) {
        self.progress.clear();
    }
}

impl Drop for Progress {
    fn drop(&mut self) {
        self.clear();
    }
}

fn new_bar(total: u64) -> ProgressBar {
    let target = ProgressDrawTarget::stderr_with_hz(REFRESH_HZ);
    let bar = ProgressBar::with_draw_target(Some(total), target);
    if let Ok(style) = ProgressStyle::with_template("{bar:40} {percent:>3}% · {eta} left") {
        bar.set_style(style);
    }
    bar
}

#[cfg(test)]
mod tests {
    use super::*;

    fn long_ago() -> Instant {
        Instant::now().checked_sub(PATIENCE * 2).unwrap()
    }

    #[test]
    fn short_work_shows_nothing() {
        let progress = Progress::starting(true, Instant::now());
        progress.update(1_u32, 10_u32);
        assert!(progress.bar.get().is_none());
    }

    #[test]
    fn long_work_shows_a_bar_if_watched() {
        let watched = Progress::starting(true, long_ago());
        watched.update(3_u32, 10_u32);
        assert_eq!(watched.bar.get().unwrap().position(), 3);
        watched.update(10_u32, 10_u32);
        assert_eq!(watched.bar.get().unwrap().position(), 10);
        watched.clear();
        assert!(watched.bar.get().unwrap().is_finished());

        let unwatched = Progress::starting(false, long_ago());
        unwatched.update(3_u32, 10_u32);
        assert!(unwatched.bar.get().is_none());
    }

    #[test]
    fn no_bar_appears_for_the_last_row() {
        let progress = Progress::starting(true, long_ago());
        progress.update(10_u32, 10_u32);
        assert!(progress.bar.get().is_none());
    }

    #[test]
    fn steps_add_up() {
        let steps =
            Steps { progress: Progress::starting(true, long_ago()), done: Cell::new(0), total: 9 };
        steps.add(2);
        steps.add(3);
        assert_eq!(steps.progress.bar.get().unwrap().position(), 5);
        steps.clear();
        assert!(steps.progress.bar.get().unwrap().is_finished());
    }
}
