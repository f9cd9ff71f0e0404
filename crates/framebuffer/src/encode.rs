use scumble_pixel::{Premul, WorkingSpace};

/// Finished pixels as straight 8-bit sRGB, every component rounded to nearest; the shorter slice
/// ends it. The colour of a pixel is [`WorkingSpace::export`] of it, whatever its neighbours are.
pub fn encode_row(pixels: &[Premul], space: WorkingSpace, out: &mut [[u8; 4]]) {
    space.export_row(pixels, out);
}
