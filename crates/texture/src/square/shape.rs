//! The weights of texels under a parallelogram: the integral over it of the tent that bilinear
//! interpolation puts on each texel, for one pixel or for sixteen.
//!
//! Across a row the tent is integrated in closed form, from the left side to the right; so what is left
//! is, by Green's theorem, an integral down each of the four sides. It is taken between every two rows of
//! texels, and between two corners, by Gauss and Legendre's rule, which is exact where the side does not
//! cross a column of texels.

use crate::magnify::patch::Spot;
use crate::number::Number;
use crate::walk::LANES;

/// The largest weight of a texel.
const WEIGHT: f32 = 4096.0;

/// The least height, and the least width of a row, in texels, so that what is no more than a line or a
/// point has an area too.
const LEAST: f32 = 1.0 / 1024.0;

/// The largest area, and the most that both sides reach in all, in texels: as much as an ellipse may. What
/// is larger, where no coarser level takes it, is shrunk, which aliases.
const MOST_AREA: f32 = crate::ewa::BUDGET as f32;
const MOST_REACH: f32 = 2048.0;

/// Where a side has no height to speak of, instead of it.
const FLAT: f32 = 1e-20;

/// Columns that a side may cross from row to row before it takes more nodes; fewer where the parallelogram
/// is narrower than that.
const CROSSED: f32 = 3.0;

/// The sides, and the halves of a row's tent.
const SIDES: usize = 4;
const HALVES: usize = 2;

/// A parallelogram in a level, about a [`Spot`]. Places count from the spot's texel.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Shape<N> {
    /// From the top: on the right the first and the second, then on the left.
    sides: [Side<N>; SIDES],
    /// The first and the last column and row in which a texel has a weight: whole numbers.
    pub(crate) low: [N; 2],
    pub(crate) high: [N; 2],
    /// The ends of its columns.
    ends: [N; 2],
    /// What a weight is counted in.
    unit: N,
    /// The sum of all weights.
    pub(crate) total: N,
    /// Positive where a side is so flat that it takes [`FINE`].
    pub(crate) flat: N,
}

/// A side: its upper end, the row of its lower, and how many columns it goes to the right from row to row.
#[derive(Debug, Clone, Copy)]
struct Side<N> {
    x: N,
    y: N,
    end: N,
    slope: N,
}

/// A rule of so many nodes for −1…1, whose weights sum to 2: each node, and its weight.
pub(crate) type Rule<const K: usize> = [[f32; 2]; K];

/// Gauss and Legendre's rules.
pub(crate) const COARSE: Rule<2> = [[-0.577_350_3, 1.0], [0.577_350_3, 1.0]];
pub(crate) const FINE: Rule<4> = [
    [-0.861_136_3, 0.347_854_84],
    [-0.339_981_05, 0.652_145_15],
    [0.339_981_05, 0.652_145_15],
    [0.861_136_3, 0.347_854_84],
];

/// Where the texels of one row get their weights from.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Row<N, const K: usize> {
    /// The first column: a whole number.
    pub(crate) first: N,
    /// [`LANES`] columns at a time, how many times: a whole number.
    pub(crate) quads: N,
    /// The nodes of each piece of a side that there is.
    nodes: [[Node<N>; K]; SIDES * HALVES],
    pieces: usize,
}

/// A place on a side, and how much of the row's tent it stands for: on the left less than nothing.
#[derive(Debug, Clone, Copy)]
struct Node<N> {
    x: N,
    weight: N,
}

impl<N: Number> Side<N> {
    #[inline(always)]
    fn new(x: N, [y, end]: [N; 2], slope: N) -> Self {
        Self { x, y, end, slope }
    }

    /// The column in which the line goes through row `y`.
    #[inline(always)]
    fn at(&self, y: N) -> N {
        self.x + (y - self.y) * self.slope
    }
}

impl<N: Number> Shape<N> {
    #[inline(always)]
    pub(crate) fn new(spot: &Spot<N>) -> Self {
        let [a, b, c, d] = spot.jacobian;
        let (zero, one, least) = (a.all(0.0), a.all(1.0), a.all(LEAST));
        let reach = (a.abs() + b.abs()) + (c.abs() + d.abs());
        let area = spot.determinant.abs();
        let share = (a.all(MOST_AREA) / area.at_least(a.all(MOST_AREA))).sqrt();
        let share = share.at_most(a.all(MOST_REACH) / reach.at_least(a.all(MOST_REACH)));
        // Both sides as they go down, and which of them leads to the right.
        let (a, c) = (c.if_positive(a, zero - a) * share, c.abs() * share);
        let (b, d) = (d.if_positive(b, zero - b) * share, (d.abs() * share).at_least(least));
        let cross = a * d - b * c;
        let (ru, rv) = (cross.if_positive(a, b), cross.if_positive(c, d));
        let (lu, lv) = (cross.if_positive(b, a), cross.if_positive(d, c));
        let (across, down) = ((ru + lu) * 0.5, (rv + lv) * 0.5);
        let (top, bottom) = ([spot.x - across, spot.y - down], [spot.x + across, spot.y + down]);
        let slopes = [ru / rv.at_least(a.all(FLAT)), lu / lv.at_least(a.all(FLAT))];
        let (right, left) = (top[0] + 0.5 * LEAST, top[0] - 0.5 * LEAST);
        let sides = [
            Side::new(right, [top[1], top[1] + rv], slopes[0]),
            Side::new(right + ru, [top[1] + rv, bottom[1]], slopes[1]),
            Side::new(left, [top[1], top[1] + lv], slopes[1]),
            Side::new(left + lu, [top[1] + lv, bottom[1]], slopes[0]),
        ];
        let ends = [
            left.at_most(sides[3].x).at_most(bottom[0] - 0.5 * LEAST),
            right.at_least(sides[1].x).at_least(bottom[0] + 0.5 * LEAST),
        ];
        let area = cross.abs() + (rv + lv) * LEAST;
        let longest = ru.abs().at_least(lu.abs()).at_least(rv.at_least(lv));
        // No texel has more than a row's width of it, or a column's height, or all.
        let unit = a.all(WEIGHT) / (area / longest.at_least(one)).at_most(one);
        let [right, left] = [ru.abs().at_most(slopes[0].abs()), lu.abs().at_most(slopes[1].abs())];
        let flattest = right.at_least(left);
        let width = area / longest.at_least(least);
        Self {
            sides,
            low: [ends[0].floor(), top[1].floor()],
            high: [ends[1].floor() + 1.0, bottom[1].floor() + 1.0],
            ends,
            unit,
            total: area * unit,
            flat: flattest - width.at_least(one).at_most(a.all(CROSSED)),
        }
    }

    /// Row `y`, a whole number.
    #[inline(always)]
    pub(crate) fn row<const K: usize>(&self, rule: &Rule<K>, y: N) -> Row<N, K> {
        let nothing = Node { x: y, weight: y };
        let mut nodes = [[nothing; K]; SIDES * HALVES];
        let mut pieces = 0;
        for half in 0..HALVES {
            let (above, below) = (y + (half as f32 - 1.0), y + half as f32);
            for (number, side) in self.sides.iter().enumerate() {
                let from = side.y.at_least(above);
                let length = side.end.at_most(below) - from;
                if !length.any_positive() {
                    continue;
                }
                let length = length.at_least(y.all(0.0)) * 0.5;
                let middle = from + length;
                let share = length * self.unit;
                let share = if number < SIDES / 2 { share } else { share * -1.0 };
                for (node, [at, weight]) in nodes[pieces].iter_mut().zip(rule) {
                    let at = middle + length * *at;
                    let tent = if half == 0 { at - above } else { below - at };
                    *node = Node { x: side.at(at), weight: share * *weight * tent };
                }
                pieces += 1;
            }
        }
        let [first, last] = self.columns(y);
        let quads = ((last - first) * (1.0 / LANES as f32)).floor() + 1.0;
        Row { first, quads, nodes, pieces }
    }

    /// The first and the last column of a row in which a texel has a weight.
    #[inline(always)]
    fn columns(&self, y: N) -> [N; 2] {
        let [right, lower_right, left, lower_left] = &self.sides;
        let (top, bottom) = ((y - 1.0).at_least(left.y), (y + 1.0).at_most(lower_left.end));
        // Where a row begins is where the right one of the lines of its two sides goes through it: leftmost
        // at a corner or at an end.
        let corners = [lower_left, lower_right].map(
            #[inline(always)]
            |side| side.y.at_least(top).at_most(bottom),
        );
        let [mut low, mut high] = [self.ends[1], self.ends[0]];
        for y in [top, bottom, corners[0]] {
            low = low.at_most(left.at(y).at_least(lower_left.at(y)));
        }
        for y in [top, bottom, corners[1]] {
            high = high.at_least(right.at(y).at_most(lower_right.at(y)));
        }
        [low.at_least(self.ends[0]).floor(), high.at_most(self.ends[1]).floor() + 1.0]
    }
}

impl<N: Number, const K: usize> Row<N, K> {
    /// The weights of the texels in [`LANES`] columns.
    #[inline(always)]
    pub(crate) fn weights(&self, column: N) -> [N; LANES] {
        let mut sums = [column.all(0.0); LANES];
        for nodes in &self.nodes[..self.pieces] {
            for node in nodes {
                let x = node.x - column;
                for (i, sum) in sums.iter_mut().enumerate() {
                    *sum = *sum + node.weight * tent_before(x - i as f32);
                }
            }
        }
        sums
    }
}

/// ∫ max(1 − |t|, 0) dt from 0 to x.
#[inline(always)]
fn tent_before<N: Number>(x: N) -> N {
    let x = x.at_least(x.all(-1.0)).at_most(x.all(1.0));
    x * (x.abs() * -0.5 + 1.0)
}
