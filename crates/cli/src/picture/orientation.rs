//! The eight ways in which a camera can be held (EXIF 2.32, tag 274), undone.

use super::{Picture, Pixels};

/// Whether an orientation swaps rows and columns.
pub(super) fn transposes(orientation: u8) -> bool {
    (5..=8).contains(&orientation)
}

impl Picture {
    /// The picture upright: what was stored under an orientation of 1 to 8; others change nothing.
    pub(super) fn upright(mut self, orientation: u8) -> Self {
        if !(2..=8).contains(&orientation) {
            return self;
        }
        let (width, height) = (self.width as usize, self.height as usize);
        let n = self.channels.count();
        self.pixels = match &self.pixels {
            Pixels::U8(v) => Pixels::U8(turned(v, width, height, n, orientation)),
            Pixels::U16(v) => Pixels::U16(turned(v, width, height, n, orientation)),
            Pixels::F32(v) => Pixels::F32(turned(v, width, height, n, orientation)),
        };
        if transposes(orientation) {
            (self.width, self.height) = (self.height, self.width);
        }
        self.origin.orientation = orientation;
        self
    }
}

/// The numbers in their new order, `n` to a pixel.
fn turned<T: Copy>(old: &[T], width: usize, height: usize, n: usize, orientation: u8) -> Vec<T> {
    let mut new = Vec::with_capacity(old.len());
    let (columns, rows) = if transposes(orientation) { (height, width) } else { (width, height) };
    for y in 0..rows {
        for x in 0..columns {
            let (right, bottom) = (width.wrapping_sub(1), height.wrapping_sub(1));
            let (i, j) = match orientation {
                2 => (right - x, y),
                3 => (right - x, bottom - y),
                4 => (x, bottom - y),
                5 => (y, x),
                6 => (y, bottom - x),
                7 => (right - y, bottom - x),
                _ => (right - y, x),
            };
            new.extend_from_slice(&old[(j * width + i) * n..][..n]);
        }
    }
    new
}

#[cfg(test)]
mod tests {
    use super::*;

    /// What EXIF says of each: where row 0 and column 0 of the stored picture are to be seen.
    #[test]
    fn all_eight() {
        // a b c
        // d e f
        let stored = *b"abcdef";
        let seen = |orientation| String::from_utf8(turned(&stored, 3, 2, 1, orientation)).unwrap();
        assert_eq!(seen(2), "cbafed");
        assert_eq!(seen(3), "fedcba");
        assert_eq!(seen(4), "defabc");
        assert_eq!(seen(5), "adbecf");
        // Row 0 is the right side, column 0 the top: the camera's left side was down.
        assert_eq!(seen(6), "daebfc");
        assert_eq!(seen(7), "fcebda");
        assert_eq!(seen(8), "cfbead");
    }

    #[test]
    fn a_pixel_stays_whole() {
        assert_eq!(turned(&[1, 2, 3, 4], 2, 1, 2, 2), [3, 4, 1, 2]);
        assert_eq!(turned::<u8>(&[], 0, 0, 3, 6), [0; 0]);
    }
}
