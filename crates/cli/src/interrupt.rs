//! Ctrl-C: nothing half-written stays behind.
//!
//! While there is nothing to clean up, a signal ends the process as it always does. While a
//! temporary file exists, it only asks the renderer to stop, and the file is removed on the way
//! out. Whoever cannot wait for that sends a second one, which ends the process and leaves the file.

use crate::error::Failure;
use signal_hook::consts::{SIGINT, SIGTERM};
use signal_hook::flag;
use std::io;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};

/// What the signals that came did.
#[derive(Debug, Clone)]
pub(crate) struct Interrupt {
    cancel: Arc<AtomicBool>,
    signal: Arc<AtomicUsize>,
    nothing_to_clean: Arc<AtomicBool>,
}

impl Interrupt {
    /// Takes over SIGINT and SIGTERM for the rest of the process.
    pub(crate) fn install() -> Result<Self, Failure> {
        let interrupt = Self::unheard();
        interrupt.listen().map_err(|e| Failure::io("signals", &e))?;
        Ok(interrupt)
    }

    /// One that no signal reaches.
    fn unheard() -> Self {
        Self {
            cancel: Arc::default(),
            signal: Arc::default(),
            nothing_to_clean: Arc::new(AtomicBool::new(true)),
        }
    }

    fn listen(&self) -> io::Result<()> {
        for signal in [SIGINT, SIGTERM] {
            // Actions run in the order of registration.
            flag::register_conditional_default(signal, Arc::clone(&self.nothing_to_clean))?;
            flag::register_conditional_default(signal, Arc::clone(&self.cancel))?;
            let number = usize::try_from(signal).unwrap_or_default();
            flag::register_usize(signal, Arc::clone(&self.signal), number)?;
            flag::register(signal, Arc::clone(&self.cancel))?;
        }
        Ok(())
    }

    /// Set once a signal has come; for the renderer to look at.
    pub(crate) fn cancel(&self) -> &AtomicBool {
        &self.cancel
    }

    /// Whether a signal has come.
    pub(crate) fn is_heard(&self) -> bool {
        self.cancel.load(Ordering::Relaxed)
    }

    /// From here on a signal must leave time to clean up.
    pub(crate) fn hold(&self) {
        self.nothing_to_clean.store(false, Ordering::SeqCst);
    }

    /// Everything is cleaned up: a signal may end the process again.
    pub(crate) fn release(&self) {
        self.nothing_to_clean.store(true, Ordering::SeqCst);
    }

    /// The end of a run that was told to stop.
    pub(crate) fn failure(&self) -> Failure {
        let signal = self.signal.load(Ordering::SeqCst);
        Failure::Interrupted { signal: u8::try_from(signal).unwrap_or_default() }
    }
}

#[cfg(test)]
pub(crate) mod tests {
    use super::*;

    /// One that no signal reaches.
    pub(crate) fn unheard() -> Interrupt {
        Interrupt::unheard()
    }

    #[test]
    fn the_signal_is_told() {
        let interrupt = unheard();
        assert!(!interrupt.cancel().load(Ordering::SeqCst));
        interrupt.signal.store(15, Ordering::SeqCst);
        assert!(matches!(interrupt.failure(), Failure::Interrupted { signal: 15 }));
    }

    #[test]
    fn holding_defers_the_end() {
        let interrupt = unheard();
        assert!(interrupt.nothing_to_clean.load(Ordering::SeqCst));
        interrupt.hold();
        assert!(!interrupt.nothing_to_clean.load(Ordering::SeqCst));
        interrupt.release();
        assert!(interrupt.nothing_to_clean.load(Ordering::SeqCst));
    }
}
