//! The command as a user meets it: real runs, real files, exit codes and messages.

mod common;
mod failures;
mod limits;
mod output;
mod pictures;
mod report;
mod warp;
