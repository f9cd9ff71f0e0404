//! The textures: every pixel a pure function of its position.

mod brick;
mod chart;
mod checker;
mod font;
mod noise;
mod portrait;
mod world;
mod world_outlines;

use crate::canvas::Canvas;

pub(crate) use font::inked;

/// Every texture by name.
pub(crate) fn all() -> Vec<(&'static str, Canvas)> {
    vec![
        ("brick", brick::draw()),
        ("chart", chart::draw()),
        ("checker", checker::draw()),
        ("noise", noise::draw()),
        ("portrait", portrait::draw()),
        ("tile", checker::draw_tile()),
        ("world", world::draw()),
    ]
}

/// A small picture for scenes that carry their image inside them.
pub(crate) fn emblem() -> Canvas {
    checker::draw_emblem()
}

/// The drawn head.
pub(crate) fn portrait() -> scumble_pixel::Image<[u8; 4]> {
    portrait::draw().into_image()
}

/// The map of the world.
pub(crate) fn world() -> scumble_pixel::Image<[u8; 4]> {
    world::draw().into_image()
}
