use std::sync::atomic::{AtomicBool, Ordering};

/// How far a run has come.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Progress {
    /// Rows handed to the sink.
    pub rows_done: u32,
    /// Rows in all.
    pub rows: u32,
}

/// What a caller can watch and stop while a picture is rendered.
#[derive(Clone, Copy, Default)]
pub struct Control<'a> {
    /// Called after each band of rows that the sink has taken.
    pub progress: Option<&'a (dyn Fn(Progress) + Sync)>,
    /// Set it, from any thread, and the run ends within a tile's time as
    /// [`RenderError::Cancelled`](crate::RenderError::Cancelled).
    pub cancel: Option<&'a AtomicBool>,
}

impl Control<'_> {
    pub(crate) fn is_cancelled(&self) -> bool {
        self.cancel.is_some_and(|flag| flag.load(Ordering::Relaxed))
    }

    pub(crate) fn report(&self, rows_done: u32, rows: u32) {
        if let Some(progress) = self.progress {
            progress(Progress { rows_done, rows });
        }
    }
}

impl std::fmt::Debug for Control<'_> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Control")
            .field("progress", &self.progress.is_some())
            .field("cancelled", &self.is_cancelled())
            .finish()
    }
}
