use scumble_geometry::IntRect;

/// The order in which [`Traversal::Incremental`](crate::Traversal::Incremental) visits the pixels
/// of the bounding box.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default)]
pub enum Order {
    /// Row by row, each from the left.
    #[default]
    RowMajor,
    /// Row by row, but only as far as the shape reaches: left from where the row above began until
    /// it ends, back again, then right until it ends.
    Backtrack,
    /// Row by row, to the right and to the left in turn: each step goes to a neighbour.
    ZigZag,
    /// Along the Z-shaped curve of Morton: nearby pixels come at nearby times, with jumps.
    Morton,
    /// Along Hilbert's curve: nearby pixels come at nearby times, without jumps.
    Hilbert,
}

/// Someone who goes from pixel to pixel.
pub(super) trait Visit {
    /// Goes there and tells whether the shape may touch that pixel.
    fn step(&mut self, x: i32, y: i32) -> bool;
    /// Looks at the pixel where it stands.
    fn look(&mut self);
}

impl Order {
    pub(super) fn visit(self, rect: IntRect, visitor: &mut impl Visit) {
        match self {
            Self::RowMajor => {
                for y in rect.y0..rect.y1 {
                    for x in rect.x0..rect.x1 {
                        look_at(visitor, x, y);
                    }
                }
            }
            Self::ZigZag => {
                for y in rect.y0..rect.y1 {
                    let right = (y - rect.y0) % 2 == 0;
                    for i in 0..rect.x1 - rect.x0 {
                        look_at(visitor, if right { rect.x0 + i } else { rect.x1 - 1 - i }, y);
                    }
                }
            }
            Self::Backtrack => backtrack(rect, visitor),
            Self::Morton => morton(rect, (rect.x0, rect.y0), side(rect), visitor),
            Self::Hilbert => {
                let side = side(rect);
                hilbert(rect, (rect.x0, rect.y0), (side, 0), (0, side), visitor);
            }
        }
    }
}

fn look_at(visitor: &mut impl Visit, x: i32, y: i32) {
    visitor.step(x, y);
    visitor.look();
}

/// The power of two that spans the rectangle.
fn side(rect: IntRect) -> i32 {
    // At most 2²³: a region lies within the guard band.
    rect.width().max(rect.height()).next_power_of_two() as i32
}

fn backtrack(rect: IntRect, visitor: &mut impl Visit) {
    let mut start = rect.x0;
    for y in rect.y0..rect.y1 {
        let mut x = start;
        let mut left = start;
        while x >= rect.x0 && visitor.step(x, y) {
            visitor.look();
            left = x;
            x -= 1;
        }
        // Where the row above began, this one may not have begun yet.
        let mut begun = x < start;
        x = start + i32::from(begun);
        while x < rect.x1 {
            if visitor.step(x, y) {
                visitor.look();
                left = if begun { left } else { x };
                begun = true;
            } else if begun {
                break;
            }
            x += 1;
        }
        start = if begun { left } else { rect.x0 };
    }
}

fn morton(rect: IntRect, at: (i32, i32), side: i32, visitor: &mut impl Visit) {
    if misses(rect, at, side) {
        return;
    }
    if side == 1 {
        look_at(visitor, at.0, at.1);
        return;
    }
    let half = side / 2;
    for (dx, dy) in [(0, 0), (half, 0), (0, half), (half, half)] {
        morton(rect, (at.0 + dx, at.1 + dy), half, visitor);
    }
}

/// The curve through the square with a corner at `at` and the sides `a` and `b`, one of them level.
fn hilbert(rect: IntRect, at: (i32, i32), a: (i32, i32), b: (i32, i32), visitor: &mut impl Visit) {
    let sum = (a.0 + b.0, a.1 + b.1);
    let corner = (at.0 + sum.0.min(0), at.1 + sum.1.min(0));
    let side = sum.0.abs();
    if misses(rect, corner, side) {
        return;
    }
    if side == 1 {
        look_at(visitor, corner.0, corner.1);
        return;
    }
    let (ha, hb) = ((a.0 / 2, a.1 / 2), (b.0 / 2, b.1 / 2));
    let plus = |p: (i32, i32), q: (i32, i32)| (p.0 + q.0, p.1 + q.1);
    let minus = |p: (i32, i32)| (-p.0, -p.1);
    let middle = plus(at, ha);
    hilbert(rect, at, hb, ha, visitor);
    hilbert(rect, middle, ha, hb, visitor);
    hilbert(rect, plus(middle, hb), ha, hb, visitor);
    hilbert(rect, plus(middle, b), minus(hb), minus(ha), visitor);
}

fn misses(rect: IntRect, at: (i32, i32), side: i32) -> bool {
    rect.intersect(&IntRect::new(at.0, at.1, at.0 + side, at.1 + side)).is_empty()
}
