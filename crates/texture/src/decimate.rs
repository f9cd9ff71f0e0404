//! From one level to the next: separable, exact for every size.

use crate::math::{bessel_i0, sinc};
use crate::pyramid::plan::Span;
use crate::{Decimation, Wrap};
use alloc::{vec, vec::Vec};

/// β of the Kaiser window.
const KAISER_BETA: f64 = 4.0;

/// The filter along one axis: for every output texel, which input texels with which weights.
///
/// Even sizes need one set of weights; others one for each output texel.
#[derive(Debug, Clone)]
pub(crate) struct Taps {
    /// Output texels.
    pub(crate) outputs: usize,
    /// Taps for each output.
    pub(crate) count: usize,
    /// First input texel of every output, before wrapping.
    pub(crate) firsts: Vec<i32>,
    /// What lies beyond the edge.
    fold: Wrap,
    /// Input texels.
    inputs: usize,
    /// Weight of every tap of every output; of even sizes, of the first.
    weights: Vec<f32>,
}

impl Taps {
    /// The filter from `n` texels to max(1, ⌊n/2⌋).
    pub(crate) fn new(n: usize, filter: Decimation, wrap: Wrap) -> Self {
        let outputs = (n / 2).max(1);
        let ratio = n as f64 / outputs as f64;
        if n == 1 {
            return Self {
                outputs,
                count: 1,
                firsts: vec![0],
                fold: Wrap::Clamp,
                inputs: 1,
                weights: vec![1.0],
            };
        }
        let reach = match filter {
            Decimation::Kaiser => 2.0 * ratio,
            Decimation::Box => 0.5 * ratio,
        };
        let even = n.is_multiple_of(2);
        // An odd size shifts the grid under the filter: one tap more catches every shift.
        let count = if even { (2.0 * reach) as usize } else { (2.0 * reach) as usize + 2 };
        // Beyond the edge the pyramid mirrors the image unless it repeats: only so is its mean kept.
        let fold = if matches!(wrap, Wrap::Repeat) { Wrap::Repeat } else { Wrap::Mirror };
        let share = 1.0 / ratio;
        let mut firsts = Vec::with_capacity(outputs);
        let mut weights = Vec::with_capacity(outputs * count);
        for i in 0..outputs {
            let centre = (i as f64 + 0.5) * ratio;
            let first = crate::math::floor(centre - reach + if even { 0.5 } else { 0.0 }) as i32;
            firsts.push(first);
            if even && i > 0 {
                // An even size has one phase.
                continue;
            }
            weights.extend((first..first + count as i32).map(|j| match filter {
                Decimation::Kaiser => share * partition((j as f64 + 0.5 - centre) * 2.0 * share),
                Decimation::Box => share * overlap(j as f64, centre - reach, centre + reach),
            }));
        }
        if filter == Decimation::Kaiser && !even {
            balance(&mut weights, &firsts, count, ratio);
        }
        let weights = weights.iter().map(|w| *w as f32).collect();
        Self { outputs, count, firsts, fold, inputs: n, weights }
    }

    /// The weights of output `i`.
    #[inline(always)]
    pub(crate) fn weights(&self, i: usize) -> &[f32] {
        let i = if self.is_even() { 0 } else { i };
        &self.weights[i * self.count..(i + 1) * self.count]
    }

    /// The weights of output `i`, which may lie outside.
    #[inline(always)]
    pub(crate) fn weights_of(&self, i: i32) -> &[f32] {
        self.weights(i.rem_euclid(self.outputs as i32) as usize)
    }

    /// The inputs of some outputs as rows that come: after mirroring, but before repeating.
    #[cfg(feature = "parallel")]
    pub(crate) fn rows_of(&self, [first, end]: [i32; 2]) -> [i32; 2] {
        if self.mirrors() {
            let Span { start, end } =
                self.inputs_of(Span { start: first as usize, end: end as usize });
            return [start as i32, end as i32];
        }
        [self.first(first), self.first(end - 1) + self.count as i32]
    }

    /// Whether all outputs have the weights of the first, each two texels on.
    #[inline(always)]
    pub(crate) fn is_even(&self) -> bool {
        self.inputs.is_multiple_of(2)
    }

    /// The input texel that stands at `i`, which may lie outside.
    #[inline(always)]
    pub(crate) fn resolve(&self, i: i32) -> usize {
        // Neither fold has an outside.
        self.fold.resolve(i, self.inputs).unwrap_or(0)
    }

    /// Where the taps of some outputs begin and end, before wrapping.
    pub(crate) fn reach(&self, outputs: Span) -> [i32; 2] {
        [self.firsts[outputs.start], self.firsts[outputs.end - 1] + self.count as i32]
    }

    /// Whether the taps of some outputs reach over an end.
    pub(crate) fn crosses(&self, outputs: Span) -> bool {
        let [first, end] = self.reach(outputs);
        first < 0 || end > self.inputs as i32
    }

    /// The inputs of some outputs, after wrapping.
    pub(crate) fn inputs_of(&self, outputs: Span) -> Span {
        let [first, end] = self.reach(outputs);
        let n = self.inputs as i32;
        let all = Span::all(self.inputs);
        if !self.crosses(outputs) {
            return Span { start: first as usize, end: end as usize };
        }
        if self.fold == Wrap::Repeat || end - first >= n {
            return all;
        }
        // What lies over an end stands as far inside it.
        let (mut low, mut high) = (first.max(0), end.min(n));
        if first < 0 {
            (low, high) = (0, high.max(-first));
        }
        if end > n {
            (low, high) = (low.min(2 * n - end), n);
        }
        Span { start: low.clamp(0, n) as usize, end: high.clamp(0, n) as usize }
    }

    /// Whether what lies over an end stands as far inside it.
    pub(crate) fn mirrors(&self) -> bool {
        self.fold == Wrap::Mirror
    }

    /// The first input of output `i`, which may lie outside like its inputs.
    pub(crate) fn first(&self, i: i32) -> i32 {
        let (n, outputs) = (self.inputs as i32, self.outputs as i32);
        self.firsts[i.rem_euclid(outputs) as usize] + n * i.div_euclid(outputs)
    }
}

/// The half-band kernel at distance `d` in texels of an even-sized level: sinc(d/2) under the
/// window I₀(β√(1 − (d/4)²)). At ½, 1½, 2½, 3½ and normalised: 0.43850, 0.11692, −0.04300, −0.01242.
fn kaiser(d: f64) -> f64 {
    let t = d / 4.0;
    if t * t >= 1.0 {
        return 0.0;
    }
    let window = bessel_i0(0.25 * KAISER_BETA * KAISER_BETA * (1.0 - t * t));
    sinc(core::f64::consts::PI * 0.5 * d) * window
}

/// The kernel divided by the sum of its copies at every second place: a partition of unity, so that
/// the outputs share each input evenly whatever its phase. At the half-band's own taps the sum is the
/// same, and nothing changes.
fn partition(d: f64) -> f64 {
    let own = kaiser(d);
    let copy = |k: i32| if k == 0 { own } else { kaiser(d + 2.0 * f64::from(k)) };
    own / (-4..=4).map(copy).sum::<f64>()
}

/// How much of texel `j` lies in [from, to).
fn overlap(j: f64, from: f64, to: f64) -> f64 {
    (to.min(j + 1.0) - from.max(j)).max(0.0)
}

/// Makes the weights of every output sum to 1 without changing what any input gives in all, so that
/// constants and the mean of the level are both kept: what an output lacks it takes from the next one,
/// at the two texels beside their common edge. The amounts are below two thousandths; areas need none.
fn balance(weights: &mut [f64], firsts: &[i32], count: usize, ratio: f64) {
    for i in 0..firsts.len() {
        let taps = &mut weights[i * count..(i + 1) * count];
        let lack = 1.0 - taps.iter().sum::<f64>();
        if i + 1 == firsts.len() {
            // All that is left is rounding.
            taps[count / 2] += lack;
            return;
        }
        let edge = (i + 1) as f64 * ratio - 0.5;
        let texel = crate::math::floor(edge);
        let fraction = edge - texel;
        for (j, part) in [(texel as i32, 1.0 - fraction), (texel as i32 + 1, fraction)] {
            weights[i * count + (j - firsts[i]) as usize] += lack * part;
            weights[(i + 1) * count + (j - firsts[i + 1]) as usize] -= lack * part;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_kaiser_taps_are_the_published_ones() {
        let taps = Taps::new(16, Decimation::Kaiser, Wrap::Repeat);
        assert_eq!((taps.outputs, taps.count), (8, 8));
        let half = [0.43850, 0.11692, -0.04300, -0.01242];
        for (k, tap) in half.iter().enumerate() {
            assert!((taps.weights[3 - k] - tap).abs() < 1e-5);
            assert!((taps.weights[4 + k] - tap).abs() < 1e-5);
        }
        // Output 3 covers texels 6 and 7.
        assert_eq!(taps.firsts[3], 3);
    }

    #[test]
    fn box_taps_are_areas() {
        let taps = Taps::new(5, Decimation::Box, Wrap::Clamp);
        let mut dense = [[0.0f32; 5]; 2];
        for (i, dense) in dense.iter_mut().enumerate() {
            for (k, w) in taps.weights(i).iter().enumerate() {
                dense[taps.resolve(taps.firsts[i] + k as i32)] += w;
            }
        }
        let near = |a: [f32; 5], b: [f32; 5]| a.iter().zip(b).all(|(a, b)| (a - b).abs() < 1e-6);
        assert!(near(dense[0], [0.4, 0.4, 0.2, 0.0, 0.0]));
        assert!(near(dense[1], [0.0, 0.0, 0.2, 0.4, 0.4]));
    }

    #[test]
    fn every_size_keeps_the_mean_and_sums_to_one() {
        for wrap in [Wrap::Clamp, Wrap::Repeat] {
            for filter in [Decimation::Kaiser, Decimation::Box] {
                for n in (1..70).chain([255, 257, 1021, 1023]) {
                    let taps = Taps::new(n, filter, wrap);
                    let mut totals = vec![0.0f64; n];
                    for i in 0..taps.outputs {
                        for (k, w) in taps.weights(i).iter().enumerate() {
                            let j = taps.resolve(taps.firsts[i] + k as i32);
                            totals[j] += f64::from(*w);
                        }
                    }
                    let share = taps.outputs as f64 / n as f64;
                    let worst = totals.iter().map(|t| (t - share).abs()).fold(0.0, f64::max);
                    assert!(worst < 1e-6, "{n} {filter:?} {wrap:?}: {worst}");
                    for w in (0..taps.outputs).map(|i| taps.weights(i)) {
                        let sum: f64 = w.iter().map(|w| f64::from(*w)).sum();
                        assert!((sum - 1.0).abs() < 1e-6, "{n} {filter:?} {wrap:?} {sum}");
                    }
                }
            }
        }
    }
}
