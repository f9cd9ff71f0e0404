//! Knots that only look like ones: edges that lie beside each other and never cross.

use super::steps::Steps;
use super::strips::AreaEdge;
use crate::fixed::{floor, low_bits};

/// With more edges than this the question is not worth asking.
const MOST: usize = 16;

/// Edges that are out of order by less than this (in pixels) touch; they do not cross.
const TOUCHING: f64 = 1.0 / (1u64 << 30) as f64;

/// An edge in a strip of the row: the winding number it adds, and x at the strip's top and bottom.
#[derive(Clone, Copy, Default)]
struct Piece {
    top: f64,
    bottom: f64,
    winding: i32,
}

impl Piece {
    fn is_right_of(&self, other: &Self) -> bool {
        self.top + self.bottom > other.top + other.bottom
    }
}

/// The winding numbers in each of eight pixels: the least and the greatest.
struct Ranges {
    least: [i32; 8],
    most: [i32; 8],
}

impl Ranges {
    /// Adds a winding number between two x, counted from the left side of the first pixel.
    #[inline(always)]
    fn add(&mut self, from: f64, to: f64, winding: i32) {
        let pixel = |x: f64| low_bits(floor(x.clamp(0.0, 7.5))) as usize;
        let (first, last) = (pixel(from - TOUCHING), pixel(to + TOUCHING));
        for (least, most) in self.least[first..=last].iter_mut().zip(&mut self.most[first..=last]) {
            *least = winding.min(*least);
            *most = winding.max(*most);
        }
    }

    /// Whether the mean of each pixel tells its area.
    #[inline(always)]
    fn are_narrow(&self) -> bool {
        self.least.iter().zip(&self.most).all(|(least, most)| most - least <= 1)
    }
}

/// Whether it is plain to see that in none of the eight pixels from `x` on the winding number takes
/// more than two values, neighbours of each other, along row `y`: then the area follows from its mean.
#[inline(always)]
pub(super) fn is_calm((x, y): (i32, i32), left: &Steps, edges: &[AreaEdge]) -> bool {
    if edges.len() > MOST {
        return false;
    }
    if left.is_constant() {
        match edges {
            [] | [_] => return true,
            // The two sides of something narrow.
            [a, b] if a.winding == -b.winding && (a.from, a.to) == (b.from, b.to) => {
                return keep_order(y, a, b);
            }
            _ => {}
        }
    }
    // Where the edges cross the top of the row, and how far they run in 1/256 of it.
    let mut lines = [(0.0, 0.0); MOST];
    for (line, e) in lines.iter_mut().zip(edges) {
        let top = e.slope.at(f64::from(y));
        *line = (top, e.slope.run * e.slope.sign * (1.0 / 256.0));
    }
    let mut events = left.marks();
    for e in edges {
        for height in [e.from, e.to & 255] {
            events[height as usize / 64] |= 1 << (height % 64);
        }
    }
    events[0] &= !1;
    let mut pieces = [Piece::default(); MOST];
    let x = f64::from(x);
    let mut winding = left.top;
    let mut ranges = Ranges { least: [i32::MAX; 8], most: [i32::MIN; 8] };
    let mut from = 0;
    let mut word = 0;
    loop {
        while word < 4 && events[word] == 0 {
            word += 1;
        }
        let mut to = 256;
        if word < 4 {
            to = word as i32 * 64 + events[word].trailing_zeros() as i32;
            events[word] &= events[word] - 1;
        }
        let mut count = 0;
        for (line, e) in lines.iter().zip(edges) {
            if e.from <= from && to <= e.to {
                let at = |height: i32| line.0 + f64::from(height) * line.1;
                let piece = Piece { top: at(from), bottom: at(to), winding: e.winding };
                let mut place = count;
                while place > 0 && pieces[place - 1].is_right_of(&piece) {
                    pieces[place] = pieces[place - 1];
                    place -= 1;
                }
                pieces[place] = piece;
                count += 1;
            }
        }
        if !is_in_order(&pieces[..count]) {
            return false;
        }
        let (mut here, mut since) = (winding, 0.0);
        for piece in &pieces[..count] {
            ranges.add(since, piece.top.max(piece.bottom) - x, here);
            since = piece.top.min(piece.bottom) - x;
            here += piece.winding;
        }
        ranges.add(since, 8.0, here);
        if to == 256 {
            return ranges.are_narrow();
        }
        winding += left.change(to);
        from = to;
    }
}

/// Whether two edges between the same heights do not cross, each winding once.
#[inline(always)]
fn keep_order(y: i32, a: &AreaEdge, b: &AreaEdge) -> bool {
    let apart = |height: i32| {
        let y = f64::from(y) + f64::from(height) * (1.0 / 256.0);
        a.slope.at(y) - b.slope.at(y)
    };
    let (top, bottom) = (apart(a.from), apart(a.to));
    a.winding.abs() == 1 && (top.max(bottom) <= TOUCHING || top.min(bottom) >= -TOUCHING)
}

#[inline(always)]
fn is_in_order(pieces: &[Piece]) -> bool {
    pieces.windows(2).all(|pair| {
        pair[0].top <= pair[1].top + TOUCHING && pair[0].bottom <= pair[1].bottom + TOUCHING
    })
}
