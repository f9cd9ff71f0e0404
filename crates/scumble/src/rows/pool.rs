//! The threads.

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
    pub(super) fn join<A: Send, B: Send>(
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

    pub(crate) fn for_each<T: Send>(&self, items: Vec<T>, f: impl Fn(T) + Sync + Send) {
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
