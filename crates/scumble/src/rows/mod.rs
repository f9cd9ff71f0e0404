//! What scenes and warps share: threads, and the way of finished rows to whoever wants them.

mod control;
mod pool;
mod pump;
mod sink;
mod spares;

pub use control::{Control, Progress};
pub(crate) use pool::Pool;
pub(crate) use pump::{Stopped, pump};
pub use sink::{ImageSink, Sink};
pub(crate) use spares::Spares;
