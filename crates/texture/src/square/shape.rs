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
/// point has an area too. (Two sides along one line count as much at its ends as in its middle then.)
const LEAST: f32 = 1.0 / 1024.0;
const LEAST_WIDTH: f32 = 1.0 / 8192.0;

/// The largest area, and the most that both sides reach in all, in texels: as much as an ellipse may. What
/// is larger, where no coarser level takes it, is shrunk, which aliases.
const MOST_AREA: f32 = crate::ewa::BUDGET as f32;
const MOST_REACH: f32 = 2048.0;

/// Where a side has no height to speak of, instead of it.
const FLAT: f32 = 1e-20;

/// Columns that a side may cross within a row before it takes more nodes, for each texel that the
/// parallelogram is wide. A square never does.
const CROSSED: f32 = 1.25;

/// The widest gap between two nodes of [`FINE`], as a part of what they stand for. A flat sliver is widened
/// to no less than a texel short of that, which is along its length: it has no holes.
const GAP: f32 = 0.34;

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
        let (b, d) = (d.if_positive(b, zero - b) * share, d.abs() * share);
        // The one that goes less far across has a height.
        let steeper = b.abs() - a.abs();
        let (c, d) =
            (steeper.if_positive(c.at_least(least), c), steeper.if_positive(d, d.at_least(least)));
        let cross = a * d - b * c;
        let (ru, rv) = (cross.if_positive(a, b), cross.if_positive(c, d));
        let (lu, lv) = (cross.if_positive(b, a), cross.if_positive(d, c));
        let (across, down) = ((ru + lu) * 0.5, (rv + lv) * 0.5);
        let (top, bottom) = ([spot.x - across, spot.y - down], [spot.x + across, spot.y + down]);
        let slopes = [ru / rv.at_least(a.all(FLAT)), lu / lv.at_least(a.all(FLAT))];
        let crossed = crossed(ru, rv, slopes[0]).at_least(crossed(lu, lv, slopes[1]));
        let crossed = crossed / (rv + lv).at_most(one);
        let chord = cross.abs() / (rv + lv);
        let wider = (crossed * GAP - 1.0 - chord).at_least(a.all(LEAST_WIDTH));
        let (right, left) = (top[0] + wider * 0.5, top[0] - wider * 0.5);
        let sides = [
            Side::new(right, [top[1], top[1] + rv], slopes[0]),
            Side::new(right + ru, [top[1] + rv, bottom[1]], slopes[1]),
            Side::new(left, [top[1], top[1] + lv], slopes[1]),
            Side::new(left + lu, [top[1] + lv, bottom[1]], slopes[0]),
        ];
        let ends = [
            left.at_most(sides[3].x).at_most(bottom[0] - wider * 0.5),
            right.at_least(sides[1].x).at_least(bottom[0] + wider * 0.5),
        ];
        let area = cross.abs() + (rv + lv) * wider;
        let longest = ru.abs().at_least(lu.abs()).at_least(rv.at_least(lv));
        // No texel has more than a row's width of it, or a column's height, or all.
        let unit = a.all(WEIGHT) / (area / longest.at_least(one)).at_most(one);
        let length = (ru * ru + rv * rv).at_least(lu * lu + lv * lv).sqrt();
        let width = (area / length.at_least(least)).at_least(one);
        Self {
            sides,
            low: [ends[0].floor(), top[1].floor()],
            high: [ends[1].floor() + 1.0, bottom[1].floor() + 1.0],
            ends,
            unit,
            flat: crossed - width * CROSSED,
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

/// How many columns a side crosses within a row, as much of a row as it goes through.
#[inline(always)]
fn crossed<N: Number>(u: N, v: N, slope: N) -> N {
    u.abs().at_most(slope.abs()) * v.at_most(v.all(1.0))
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
        // What a rule is off by on a sliver may lead out of the range that sums are sure to fit.
        let (zero, most) = (column.all(0.0), column.all(WEIGHT));
        for sum in &mut sums {
            *sum = sum.at_least(zero).at_most(most);
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

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;
    use std::collections::BTreeMap;

    /// Parts of the whole, by texel.
    type Weights = BTreeMap<(i32, i32), f64>;

    fn spot([a, b, c, d]: [f64; 4], [x, y]: [f64; 2]) -> Spot<f32> {
        let jacobian = [a, b, c, d].map(|v| v as f32);
        Spot { x: x as f32, y: y as f32, jacobian, determinant: (a * d - b * c) as f32 }
    }

    fn weights<const K: usize>(shape: &Shape<f32>, rule: &Rule<K>) -> Weights {
        let mut weights = Weights::new();
        for y in shape.low[1] as i32..=shape.high[1] as i32 {
            let row = shape.row(rule, y as f32);
            for i in 0..row.quads as i32 {
                let column = row.first as i32 + LANES as i32 * i;
                for (x, weight) in (column..).zip(row.weights(column as f32)) {
                    assert!((0.0..=WEIGHT).contains(&weight), "{weight} at {x}, {y}");
                    weights.insert((x, y), f64::from(weight));
                }
            }
        }
        let sum: f64 = weights.values().sum();
        weights.values_mut().for_each(|weight| *weight /= sum);
        weights
    }

    /// The same from many places, each between four texels.
    fn truth([a, b, c, d]: [f64; 4], [x, y]: [f64; 2]) -> Weights {
        let count = |u: f64, v: f64| (24.0 * u.hypot(v)).max(24.0) as i32;
        let (across, down) = (count(a, c), count(b, d));
        let share = 1.0 / (f64::from(across) * f64::from(down));
        let part = |i: i32, n: i32| (f64::from(i) + 0.5) / f64::from(n) - 0.5;
        let mut weights = Weights::new();
        for j in 0..down {
            for i in 0..across {
                let (r, s) = (part(i, across), part(j, down));
                let (u, v) = (x + r * a + s * b, y + r * c + s * d);
                let (fx, fy) = (u - u.floor(), v - v.floor());
                for (k, wy) in [(0, 1.0 - fy), (1, fy)] {
                    for (l, wx) in [(0, 1.0 - fx), (1, fx)] {
                        let texel = (u.floor() as i32 + l, v.floor() as i32 + k);
                        *weights.entry(texel).or_default() += wx * wy * share;
                    }
                }
            }
        }
        weights
    }

    /// The error of a mean of noise whose σ is 0.3, in decibels.
    fn noise(found: &Weights, truth: &Weights) -> f64 {
        let other = |weights: &Weights, at| weights.get(at).copied().unwrap_or(0.0);
        let both = found.keys().chain(truth.keys().filter(|at| !found.contains_key(at)));
        let squares = both.map(|at| (other(found, at) - other(truth, at)).powi(2));
        -10.0 * (0.09 * squares.sum::<f64>()).log10()
    }

    fn check(sides: [f64; 4], at: [f64; 2], bar: f64) {
        let shape = Shape::new(&spot(sides, at));
        let found =
            if shape.flat > 0.0 { weights(&shape, &FINE) } else { weights(&shape, &COARSE) };
        let noise = noise(&found, &truth(sides, at));
        assert!(noise > bar, "{noise} dB: {sides:?} {at:?}");
    }

    proptest! {
        #[test]
        fn a_square_is_a_square(
            side in 0.0..9.0f64, turn in 0.0..7.0f64, at in [0.0..1.0, 0.0..1.0]
        ) {
            let (sin, cos) = turn.sin_cos();
            let (sin, cos) = (sin * side, cos * side);
            check([cos, -sin, sin, cos], at, 48.0);
        }

        #[test]
        fn so_is_what_is_stretched_and_sheared(
            sides in [-9.0..9.0, -9.0..9.0, -9.0..9.0, -9.0..9.0], at in [0.0..1.0, 0.0..1.0]
        ) {
            let [a, b, c, d]: [f64; 4] = sides;
            let longest = a.hypot(c).max(b.hypot(d));
            let ratio = longest * longest / (a * d - b * c).abs();
            prop_assume!(ratio < 500.0);
            check(sides, at, if ratio > 16.0 { 25.0 } else { 40.0 });
        }

        #[test]
        fn lines_and_points_have_their_texels(
            (u, v) in (-9.0..9.0, -9.0..9.0), at in [0.0..1.0, 0.0..1.0]
        ) {
            let lines = [[u, 0.0, v, 0.0], [0.0, u, 0.0, 0.0], [0.0, 0.0, 0.0, v], [0.7 * u, u, 0.0, 0.0]];
            for sides in lines.into_iter().chain([[0.0; 4]]) {
                check(sides, at, 26.0);
            }
        }
    }

    #[test]
    fn along_the_axes_the_weights_are_exact() {
        // From 0.25 to 2.75 along x and 0 to 1 along y.
        let found = weights(&Shape::new(&spot([2.5, 0.0, 0.0, 1.0], [1.5, 0.5])), &COARSE);
        let x = [0.281_25, 0.968_75, 0.968_75, 0.281_25].map(|w| w / 2.5);
        for y in 0..2 {
            for (column, expected) in (0..).zip(x.map(|w| 0.5 * w)) {
                let weight = found[&(column, y)];
                assert!((weight - expected).abs() < 1e-3, "{column}, {y}: {weight} {expected}");
            }
        }
    }
}
