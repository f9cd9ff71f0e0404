//! From rows of an image to its pyramid.
//!
//! A row of the image is decoded and waits, with a few of its neighbours, until a row of the first level
//! can be made of them: across the rows first, then along. That row waits in the same way for the next
//! level. So every row is in the cache when it is used, what is not kept is never in memory as a whole,
//! and rows may come as a decoder yields them. Each texel is rounded once, as it is stored.

#[cfg(feature = "parallel")]
mod bands;
mod build;
mod cascade;
mod filter;
pub(crate) mod plan;
mod rung;

pub(crate) use build::{Making, image};
pub(crate) use filter::{Lanes, halve};
