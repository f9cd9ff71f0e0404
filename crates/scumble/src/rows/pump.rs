//! The way of the rows to the sink.

use super::{Control, Pool, Sink};
use std::ops::Range;

/// Why rows stopped coming.
pub(crate) enum Stopped<E> {
    /// The caller's flag was set.
    Cancelled,
    /// The sink failed.
    Sink(E),
}

/// Renders groups of rows, one after the other, and hands each to the sink: while the next is rendered,
/// or, with one thread, at once, from the one buffer that is still in the cache. `render` says which rows
/// of `height` the group has that it put into the buffer.
pub(crate) fn pump<P: Send + Sync, S: Sink<P>>(
    groups: usize,
    height: u32,
    (pool, control): (&Pool, &Control<'_>),
    sink: &mut S,
    mut render: impl FnMut(usize, &mut Vec<P>) -> Range<u32> + Send,
) -> Result<(), Stopped<S::Error>> {
    let (mut ready, mut next) = (Vec::new(), Vec::new());
    if pool.threads() == 1 {
        for group in 0..groups {
            let rows = render(group, &mut next);
            if control.is_cancelled() {
                return Err(Stopped::Cancelled);
            }
            if !rows.is_empty() {
                sink.rows(rows.start, &next).map_err(Stopped::Sink)?;
                control.report(rows.end, height);
            }
        }
        return Ok(());
    }
    let mut ready_rows = 0..0;
    // One round more than there are groups: the last only hands over.
    for group in 0..=groups {
        let (taken, rows) = pool.join(
            || if ready_rows.is_empty() { Ok(()) } else { sink.rows(ready_rows.start, &ready) },
            || if group < groups { render(group, &mut next) } else { 0..0 },
        );
        taken.map_err(Stopped::Sink)?;
        if control.is_cancelled() {
            return Err(Stopped::Cancelled);
        }
        if !ready_rows.is_empty() {
            control.report(ready_rows.end, height);
        }
        std::mem::swap(&mut ready, &mut next);
        ready_rows = rows;
    }
    Ok(())
}
