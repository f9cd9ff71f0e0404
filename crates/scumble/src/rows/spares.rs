use std::sync::{Mutex, PoisonError};

/// What workers keep from one piece of work to the next, for whoever comes.
#[derive(Debug, Default)]
pub(crate) struct Spares<T>(Mutex<Vec<T>>);

impl<T: Default> Spares<T> {
    /// Lends one, or a new one.
    pub(crate) fn lend(&self, f: impl FnOnce(&mut T)) {
        // A poisoned lock means that another worker panicked; what it had is gone, not ours.
        let lock = || self.0.lock().unwrap_or_else(PoisonError::into_inner);
        let mut one = lock().pop().unwrap_or_default();
        f(&mut one);
        lock().push(one);
    }
}
