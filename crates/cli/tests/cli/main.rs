//! The command as a user meets it: real runs, real files, exit codes and messages.

mod common;
mod compare;
mod diff;
mod failures;
mod info;
mod kept;
mod limits;
mod mip;
mod output;
mod pictures;
mod report;
mod signal;
mod streams;
mod warp;
