//! How long a frame takes: the medians that comparisons quote.

use std::fmt;
use std::time::{Duration, Instant};

/// Frames before the clock counts: caches and memory settle.
const WARM_UP: usize = 2;
/// Frames that are measured however long they take.
const LEAST: usize = 3;
/// When to stop after those.
const BUDGET: Duration = Duration::from_millis(1500);

/// What some frames took. Prints as `MEDIAN MIN N`, in milliseconds.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Times {
    /// The middle one, in milliseconds.
    pub median: f64,
    /// The shortest, in milliseconds.
    pub min: f64,
    /// How many.
    pub count: usize,
}

impl fmt::Display for Times {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{:.4} {:.4} {}", self.median, self.min, self.count)
    }
}

impl Times {
    fn of(mut times: Vec<f64>) -> Self {
        times.sort_by(f64::total_cmp);
        let middle = times.get(times.len() / 2).copied();
        let (median, min) = (middle.unwrap_or(f64::NAN), times.first().copied());
        Self { median, min: min.unwrap_or(f64::NAN), count: times.len() }
    }
}

/// What one call takes, in milliseconds.
///
/// # Errors
/// Those of the call.
pub fn clock<T, E>(call: impl FnOnce() -> Result<T, E>) -> Result<f64, E> {
    let start = Instant::now();
    call()?;
    Ok(start.elapsed().as_secs_f64() * 1e3)
}

/// Calls `frame`, which tells K times of its own making, up to `frames` times (at least once; fewer
/// if it takes more than 1.5 s in all), after two calls that do not count.
///
/// # Errors
/// The first error of a frame.
pub fn frames<const K: usize, E>(
    frames: usize,
    mut frame: impl FnMut() -> Result<[f64; K], E>,
) -> Result<[Times; K], E> {
    for _ in 0..WARM_UP {
        frame()?;
    }
    let start = Instant::now();
    let mut times = [const { Vec::new() }; K];
    for done in 0..frames.max(1) {
        if done >= LEAST && start.elapsed() > BUDGET {
            break;
        }
        for (times, time) in times.iter_mut().zip(frame()?) {
            times.push(time);
        }
    }
    Ok(times.map(Times::of))
}
