//! How far a warp is from brute force.

use super::painter::centre;
use super::{Map, OutputPixel, Prepared, Source, WarpError};
use crate::Control;
use crate::geometry::DVec2;
use crate::pixel::{Premul, WorkingSpace};
use crate::texture::{Levels, Texture, TextureOptions, Wrap, reference};
use std::sync::Mutex;

/// Pixels that are looked at along each side of the output.
const STRATA: u32 = 100;

/// Points for each texel, along each axis of the output.
const POINTS_PER_TEXEL: f64 = 2.5;

/// Points for each pixel, along each axis, at least.
const POINTS_PER_PIXEL: f64 = 8.0;

/// Points of a pixel at most. Some texels are missed where a pixel sees so many that this is too few,
/// next to a horizon.
const MOST_POINTS: f64 = 1_048_576.0;

/// Half the side of the square that the Gaussian is integrated over, in pixels: four of its σ.
const SUPPORT: f64 = 2.0;

/// The result of [`Prepared::verify`].
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Verification {
    /// Pixels that see the source alone.
    pub inside: Score,
    /// Pixels that see something of the source and something beyond.
    pub edge: Score,
    /// Pixels that see nothing of the source, where it ends; nothing is counted of them.
    pub empty: usize,
    /// Pixels whose truth had too few points, because they see more than four hundred texels along each
    /// axis. They count like all others.
    pub capped: usize,
}

/// How far pixels are from the truth.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Score {
    /// How many pixels were compared.
    pub pixels: usize,
    /// Where the truth is the mean under a Gaussian of σ = ½ pixel, as the filter has it.
    pub gaussian: Distance,
    /// Where it is the mean over the pixel's square.
    pub square: Distance,
}

/// Distance of sRGB-encoded numbers from the truth, on the scale of eight bits.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Distance {
    sum_of_squares: f64,
    numbers: usize,
    /// The largest difference in a channel, in codes of eight bits.
    pub worst: f64,
    /// The pixel of the output where that is.
    pub at: [i32; 2],
}

impl Distance {
    /// The mean of the squared differences, in squared codes of eight bits; 0 of nothing.
    #[must_use]
    pub fn mean_square(&self) -> f64 {
        if self.numbers == 0 { 0.0 } else { self.sum_of_squares / self.numbers as f64 }
    }

    fn add(&mut self, found: &[f64], truth: &[f64], at: [i32; 2]) {
        for difference in found.iter().zip(truth).map(|(a, b)| (a - b).abs()) {
            self.sum_of_squares += difference * difference;
            self.numbers += 1;
            if difference > self.worst {
                (self.worst, self.at) = (difference, at);
            }
        }
    }

    fn join(&mut self, other: &Self) {
        self.sum_of_squares += other.sum_of_squares;
        self.numbers += other.numbers;
        if other.worst > self.worst {
            (self.worst, self.at) = (other.worst, other.at);
        }
    }
}

impl Score {
    fn join(&mut self, other: &Self) {
        self.pixels += other.pixels;
        self.gaussian.join(&other.gaussian);
        self.square.join(&other.square);
    }
}

impl<M: Map> Prepared<'_, M> {
    /// Compares about ten thousand pixels of the result, rounded as pixels of the type `P` are, with brute
    /// force.
    ///
    /// The pixels are spread evenly, one in each of 100 by 100 parts of the output, always the same ones.
    /// The truth is an integral in `f64` of the source, interpolated bilinearly, over the pixel, by at least
    /// 2.5 points a texel and 8 a pixel along each axis, and at most 2²⁰ points in all: no pyramid, no
    /// ellipse, no approximation of the map. The points beyond a horizon are transparent. What is
    /// compared are sRGB-encoded numbers, multiplied by alpha; and alpha, too, unless all is opaque.
    ///
    /// It takes a texture of its own unless this one has level 0, and seconds.
    ///
    /// # Errors
    /// [`WarpError`]: the memory limit, or the caller's cancel flag. Progress is told in rows of parts.
    pub fn verify<P: OutputPixel, S: Source>(
        &self,
        source: &S,
        control: &Control<'_>,
    ) -> Result<Verification, WarpError> {
        let ends = self.warp.border.ends();
        let drawn = ends && self.opaque;
        let wrap = if drawn { Wrap::Clamp } else { self.warp.border.wrap(self.warp.space, false) };
        let levels = Levels::BaseOnly;
        let options =
            TextureOptions { space: self.warp.space, wrap, levels, ..TextureOptions::default() };
        let size = source.size();
        let needed = Texture::memory_for(size[0], size[1], &options).map_or(u64::MAX, |n| n as u64);
        self.warp.check_memory(needed.saturating_add(self.texture.memory() as u64))?;
        let base = self.pool.install(|| source.texture(&options))?;
        let alpha = ends || !self.opaque;
        let ground = if drawn { Some(self.painter().ground()) } else { None };
        let truth = Truth { map: &self.warp.map, base, ground, ends };
        self.compare::<P>(&truth, alpha, control)
    }

    fn compare<P: OutputPixel>(
        &self,
        truth: &Truth<'_, M>,
        alpha: bool,
        control: &Control<'_>,
    ) -> Result<Verification, WarpError> {
        let rows = self.area.height().min(STRATA);
        let mut parts: Vec<Option<Verification>> = vec![None; rows as usize];
        let done = Mutex::new(0);
        self.pool.for_each(parts.iter_mut().enumerate().collect(), |(row, part)| {
            if !control.is_cancelled() {
                *part = Some(self.compare_row::<P>(truth, alpha, row as u32, rows));
                // A poisoned lock means a panic elsewhere, which will be heard of.
                if let Ok(mut done) = done.lock() {
                    *done += 1;
                    control.report(*done, rows);
                }
            }
        });
        let mut all = EMPTY;
        for part in parts {
            let part = part.ok_or(WarpError::Cancelled)?;
            all.inside.join(&part.inside);
            all.edge.join(&part.edge);
            all.empty += part.empty;
            all.capped += part.capped;
        }
        Ok(all)
    }

    /// One pixel of each part of a row of parts.
    fn compare_row<P: OutputPixel>(
        &self,
        truth: &Truth<'_, M>,
        alpha: bool,
        row: u32,
        rows: u32,
    ) -> Verification {
        let (painter, space) = (self.painter(), self.warp.space);
        let columns = self.area.width().min(STRATA);
        let mut result = EMPTY;
        for column in 0..columns {
            let chance = scattered(u64::from(row) << 32 | u64::from(column));
            let x = self.area.x0 + within(column, columns, self.area.width(), chance as u32);
            let y = self.area.y0 + within(row, rows, self.area.height(), (chance >> 32) as u32);
            let p = centre(x, y);
            let kind = truth.kind(p);
            if kind == Kind::Empty {
                result.empty += 1;
                continue;
            }
            let mut found = [P::default()];
            P::encode(&[painter.pixel(p)], space, &mut found);
            let found = multiplied(found[0].codes(space));
            let (means, capped) = truth.means(p);
            let count = if alpha { 4 } else { 3 };
            let score = if kind == Kind::Inside { &mut result.inside } else { &mut result.edge };
            let [gaussian, square] = means.map(|mean| encoded(mean, space));
            score.pixels += 1;
            score.gaussian.add(&found[..count], &gaussian[..count], [x, y]);
            score.square.add(&found[..count], &square[..count], [x, y]);
            result.capped += usize::from(capped);
        }
        result
    }
}

const EMPTY: Verification = {
    let nothing = Distance { sum_of_squares: 0.0, numbers: 0, worst: 0.0, at: [0; 2] };
    let score = Score { pixels: 0, gaussian: nothing, square: nothing };
    Verification { inside: score, edge: score, empty: 0, capped: 0 }
};

/// A place in part `i` of `n` of a side.
fn within(i: u32, n: u32, side: u32, chance: u32) -> i32 {
    let edge = |i: u32| u64::from(side) * u64::from(i) / u64::from(n);
    let (from, to) = (edge(i), edge(i + 1));
    (from + ((u64::from(chance) * (to - from)) >> 32)) as i32
}

/// Some bits for each number (Steele, Lea and Flood's SplitMix64, 2014).
fn scattered(n: u64) -> u64 {
    let z = n.wrapping_add(1).wrapping_mul(0x9e37_79b9_7f4a_7c15);
    let z = (z ^ z >> 30).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    let z = (z ^ z >> 27).wrapping_mul(0x94d0_49bb_1331_11eb);
    z ^ z >> 31
}

/// Codes times alpha, and alpha on their scale.
fn multiplied([r, g, b, a]: [f64; 4]) -> [f64; 4] {
    [r * a, g * a, b * a, 255.0 * a]
}

/// A premultiplied colour of the working space in encoded numbers.
fn encoded(color: [f64; 4], space: WorkingSpace) -> [f64; 4] {
    multiplied(Premul(color.map(|v| v as f32)).codes(space))
}

/// What a pixel sees.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Kind {
    Inside,
    Edge,
    Empty,
}

/// The source as the brute force sees it.
struct Truth<'a, M> {
    map: &'a M,
    base: Texture,
    /// What lies beyond the edge of the source, where that is a line.
    ground: Option<Premul>,
    /// Whether the source ends.
    ends: bool,
}

impl<M: Map> Truth<'_, M> {
    fn place(&self, p: DVec2) -> Option<DVec2> {
        let f = self.map.at(p)?;
        let place = DVec2::new(f.u, f.v);
        place.is_finite().then_some(place)
    }

    fn holds(&self, place: DVec2) -> bool {
        let within = |v: f64, n: usize| (0.0..=n as f64).contains(&v);
        within(place.x, self.base.width()) && within(place.y, self.base.height())
    }

    /// By 25 places of the pixel's support.
    fn kind(&self, p: DVec2) -> Kind {
        let inside = (0..25).filter(|k| {
            let offset = DVec2::new(f64::from(k % 5 - 2), f64::from(k / 5 - 2)) * (0.5 * SUPPORT);
            self.place(p + offset).is_some_and(|place| self.holds(place))
        });
        match inside.count() {
            25 => Kind::Inside,
            0 if self.ends => Kind::Empty,
            _ => Kind::Edge,
        }
    }

    fn color(&self, p: DVec2) -> [f64; 4] {
        let Some(place) = self.place(p) else { return [0.0; 4] };
        match self.ground {
            Some(ground) if !self.holds(place) => ground.0.map(f64::from),
            _ => reference::surface(&self.base, place).unwrap_or_default(),
        }
    }

    /// Points a pixel along both axes, and whether they are too few.
    fn points(&self, p: DVec2) -> ([usize; 2], bool) {
        let along = |axis: DVec2| {
            let stretch = (0..9).filter_map(|k| {
                let offset = DVec2::new(f64::from(k % 3 - 1), f64::from(k / 3 - 1)) * SUPPORT;
                let step = axis * 1e-3;
                let (a, b) = (self.place(p + offset - step)?, self.place(p + offset + step)?);
                Some((b - a).length() / 2e-3)
            });
            (stretch.fold(0.0, f64::max) * POINTS_PER_TEXEL).max(POINTS_PER_PIXEL)
        };
        let wanted = [along(DVec2::new(1.0, 0.0)), along(DVec2::new(0.0, 1.0))];
        let side = 2.0 * SUPPORT;
        let all = wanted[0] * wanted[1] * side * side;
        let fewer = if all > MOST_POINTS { (MOST_POINTS / all).sqrt() } else { 1.0 };
        // One long axis must not take all points of the other.
        let least = |n: f64| (n * fewer).clamp(POINTS_PER_PIXEL, MOST_POINTS / 1024.0);
        // Even, so that the pixel's square begins between two points.
        (wanted.map(|n| 2 * (0.5 * least(n)).ceil() as usize), fewer < 1.0)
    }

    /// The means under the Gaussian and over the square, and whether they had too few points.
    fn means(&self, p: DVec2) -> ([[f64; 4]; 2], bool) {
        let ([across, down], capped) = self.points(p);
        let (columns, rows) = (offsets(across), offsets(down));
        let (mut gaussian, mut square) = (Mean::default(), Mean::default());
        for &(y, wy) in &rows {
            for &(x, wx) in &columns {
                let color = self.color(p + DVec2::new(x, y));
                gaussian.add(color, wx * wy);
                if x.abs() < 0.5 && y.abs() < 0.5 {
                    square.add(color, 1.0);
                }
            }
        }
        ([gaussian.get(), square.get()], capped)
    }
}

/// The points along an axis, so many a pixel, and the Gaussian's weights there.
fn offsets(per_pixel: usize) -> Vec<(f64, f64)> {
    let at = |i: usize| (i as f64 + 0.5) / per_pixel as f64 - SUPPORT;
    (0..(2.0 * SUPPORT) as usize * per_pixel)
        .map(|i| (at(i), falloff(2.0 * at(i) * at(i))))
        .collect()
}

/// e^(−x) for x in 0…8, to 10⁻¹²: a series for the 1024th part, and ten squares.
fn falloff(x: f64) -> f64 {
    let h = x / 1024.0;
    let part = 1.0 - h * (1.0 - h / 2.0 * (1.0 - h / 3.0 * (1.0 - h / 4.0 * (1.0 - h / 5.0))));
    (0..10).fold(part, |power, _| power * power)
}

#[derive(Default)]
struct Mean {
    sum: [f64; 4],
    weight: f64,
}

impl Mean {
    fn add(&mut self, color: [f64; 4], weight: f64) {
        self.weight += weight;
        for (sum, v) in self.sum.iter_mut().zip(color) {
            *sum += weight * v;
        }
    }

    fn get(&self) -> [f64; 4] {
        self.sum.map(|v| v / self.weight)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::{Affine, Homography};
    use crate::pixel::Image;
    use crate::texture::{LevelMode, PixelFilter, Sampler};
    use crate::warp::{Border, Warp};

    fn psnr(distance: &Distance) -> f64 {
        10.0 * (255.0 * 255.0 / distance.mean_square()).log10()
    }

    fn noise(side: usize) -> Image<[u8; 4]> {
        let pixel = |x: usize, y: usize| {
            let v = scattered((x * side + y) as u64).to_le_bytes();
            [v[0], v[1], v[2], 255]
        };
        Image::from_fn(side, side, pixel).unwrap()
    }

    fn verified<M: Map>(warp: &Warp<M>, source: &Image<[u8; 4]>) -> Verification {
        let prepared = warp.prepare(&source.view()).unwrap();
        prepared.verify::<[u8; 4], _>(&source.view(), &Control::default()).unwrap()
    }

    #[test]
    fn the_falloff_is_exponential() {
        for i in 0..=800 {
            let x = f64::from(i) / 100.0;
            assert!((falloff(x) / (-x).exp() - 1.0).abs() < 1e-11, "{x}");
        }
    }

    #[test]
    fn a_good_filter_scores_and_a_bad_one_does_not() {
        let map = Homography::new([[3.0, 0.5, 20.0], [-0.4, 3.2, 30.0], [2e-4, 1e-3, 1.0]]);
        let warp = Warp { space: WorkingSpace::Srgb, ..Warp::new(map, 60, 50) };
        let source = noise(256);
        let good = verified(&warp, &source);
        assert_eq!(good.inside.pixels + good.edge.pixels + good.empty, 60 * 50);
        assert!(good.inside.pixels > 2000 && good.capped == 0, "{good:?}");
        assert!(psnr(&good.inside.gaussian) > 40.0, "{}", psnr(&good.inside.gaussian));
        assert!(psnr(&good.inside.square) < psnr(&good.inside.gaussian));
        assert_eq!(good, verified(&Warp { threads: 3, ..warp.clone() }, &source));
        let sampler = Sampler::DEFAULT.with(PixelFilter::Nearest, LevelMode::Zero);
        let bad = verified(&Warp { sampler, ..warp }, &source);
        assert!(psnr(&bad.inside.gaussian) < 16.0, "{}", psnr(&bad.inside.gaussian));
        assert!(bad.inside.gaussian.worst > 100.0);
    }

    #[test]
    fn edges_are_judged_apart_and_are_right_too() {
        let source = Image::filled(90, 90, [250, 200, 150, 255]).unwrap();
        for (zoom, angle) in [(0.3, 0.2), (1.0, 0.4), (5.0, 0.1)] {
            let (s, c) = (f64::sin(angle) / zoom, f64::cos(angle) / zoom);
            let map = Affine::new(c, -s, s, c, -10.0, 5.0);
            for border in [Border::Transparent, Border::Clamp, Border::Repeat] {
                let warp = Warp { border, space: WorkingSpace::Srgb, ..Warp::new(map, 70, 70) };
                let found = verified(&warp, &source);
                assert!(found.edge.pixels > 10 && found.inside.gaussian.worst <= 0.01, "{found:?}");
                assert!(found.edge.gaussian.worst < 4.0, "{border:?} {zoom}: {:?}", found.edge);
            }
        }
    }

    #[test]
    fn the_work_is_bounded_near_a_horizon() {
        let map = Homography::new([[0.05, 0.0, -5.0], [0.0, 0.0, 2.0], [0.0, 0.001, -0.01025]]);
        let warp = Warp { border: Border::Repeat, ..Warp::new(map, 6, 12) };
        let found = verified(&warp, &noise(32));
        assert!(found.capped > 0 && found.edge.pixels == 72);
    }

    #[test]
    fn cancelling_ends_it() {
        let source = noise(16);
        let warp = Warp::new(Affine::IDENTITY, 16, 16);
        let prepared = warp.prepare(&source.view()).unwrap();
        let flag = std::sync::atomic::AtomicBool::new(true);
        let control = Control { progress: None, cancel: Some(&flag) };
        let outcome = prepared.verify::<[u8; 4], _>(&source.view(), &control);
        assert!(matches!(outcome, Err(WarpError::Cancelled)));
    }
}
