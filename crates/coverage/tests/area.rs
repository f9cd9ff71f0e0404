//! Exact area against its definition.
#![allow(missing_docs)]

mod common;
use common::mesh::{Mesh, Random};
use common::*;
use proptest::prelude::*;
use scumble_coverage::*;
use std::collections::BTreeMap;

#[derive(Debug, Default, PartialEq)]
struct Areas(BTreeMap<(i32, i32), f32>);

impl AreaSink for Areas {
    fn run(&mut self, y: i32, x0: i32, x1: i32) {
        assert!(x0 < x1);
        for x in x0..x1 {
            assert_eq!(self.0.insert((x, y), 1.0), None, "pixel {x}, {y} named twice");
        }
    }
    fn pixel(&mut self, x: i32, y: i32, area: f32) {
        assert!(area > 0.0 && area <= 1.0);
        assert_eq!(self.0.insert((x, y), area), None, "pixel {x}, {y} named twice");
    }
}

fn areas(shape: Option<Shape>, clip: IntRect) -> Areas {
    let mut out = Areas::default();
    if let Some(shape) = shape {
        shape.rasterize_area(clip, &mut Scratch::new(), &mut out);
    }
    out
}

/// The covered area of a pixel: the heights at which anything happens cut it into strips, in
/// which every edge is straight and alone, so that the length at the middle is the mean.
fn exact(contours: &[Vec<[i64; 2]>], rule: FillRule, x: i32, y: i32) -> f64 {
    let mut edges = Vec::new();
    for c in contours {
        for (i, p) in c.iter().enumerate() {
            let q = c[(i + 1) % c.len()];
            if p[1] != q[1] {
                let (t, b, w) = if p[1] < q[1] { (*p, q, 1) } else { (q, *p, -1) };
                edges.push((t.map(|v| v as f64 / 256.0), b.map(|v| v as f64 / 256.0), w));
            }
        }
    }
    let (x, y) = (f64::from(x), f64::from(y));
    let slope = |e: &([f64; 2], [f64; 2], i32)| (e.1[0] - e.0[0]) / (e.1[1] - e.0[1]);
    let at = |e: &([f64; 2], [f64; 2], i32), h: f64| e.0[0] + (h - e.0[1]) * slope(e);
    let mut heights = vec![y, y + 1.0];
    for (i, e) in edges.iter().enumerate() {
        heights.extend([e.0[1], e.1[1]]);
        heights.extend([x, x + 1.0].map(|side| e.0[1] + (side - e.0[0]) / slope(e)));
        for f in &edges[..i] {
            heights.push((at(f, 0.0) - at(e, 0.0)) / (slope(e) - slope(f)));
        }
    }
    heights.retain(|&h| h >= y && h <= y + 1.0);
    heights.sort_by(f64::total_cmp);
    let mut sum = 0.0;
    for pair in heights.windows(2) {
        let middle = 0.5 * (pair[0] + pair[1]);
        let mut row: Vec<_> = edges
            .iter()
            .filter(|e| e.0[1] <= middle && middle < e.1[1])
            .map(|e| (at(e, middle).clamp(x, x + 1.0), e.2))
            .collect();
        row.sort_by(|a, b| a.0.total_cmp(&b.0));
        let mut winding = 0;
        let mut from = x;
        for (at, w) in row.into_iter().chain([(x + 1.0, 0)]) {
            let inside = match rule {
                FillRule::NonZero => winding != 0,
                FillRule::EvenOdd => winding % 2 != 0,
            };
            sum += if inside { (at - from) * (pair[1] - pair[0]) } else { 0.0 };
            (from, winding) = (at, winding + w);
        }
    }
    sum
}

fn check(contours: &[Vec<[i64; 2]>], rule: FillRule, actual: &Areas, clip: IntRect) {
    for y in clip.y0..clip.y1 {
        for x in clip.x0..clip.x1 {
            let expected = exact(contours, rule, x, y);
            let found = f64::from(actual.0.get(&(x, y)).copied().unwrap_or(0.0));
            assert!((found - expected).abs() < 1e-6, "pixel {x}, {y}: {found} for {expected}");
        }
    }
}

const SMALL: IntRect = IntRect::new(-2, -1, 9, 8);

/// Every call as it came.
#[derive(Debug, Default, PartialEq)]
struct Calls(Vec<(IntRect, Vec<f32>)>);

impl AreaSink for Calls {
    fn block(&mut self, rect: IntRect) {
        self.0.push((rect, vec![]));
    }
    fn run(&mut self, y: i32, x0: i32, x1: i32) {
        self.0.push((IntRect::new(x0, y, x1, y + 1), vec![]));
    }
    fn span(&mut self, y: i32, x0: i32, x1: i32, area: f32) {
        assert!(x0 < x1 && area > 0.0 && area < 1.0);
        self.0.push((IntRect::new(x0, y, x1, y + 1), vec![area]));
    }
    fn row(&mut self, y: i32, x0: i32, areas: &[f32]) {
        assert!(!areas.is_empty() && areas.iter().all(|a| (0.0..=1.0).contains(a)));
        self.0.push((IntRect::new(x0, y, x0 + areas.len() as i32, y + 1), areas.to_vec()));
    }
    fn pixel(&mut self, _: i32, _: i32, _: f32) {
        unreachable!("the other methods call it");
    }
}

proptest! {
    #[test]
    fn every_instruction_set_gives_the_same_calls(
        contours in prop::collection::vec(prop::collection::vec(point(18), 3..8), 1..3),
        rule in rule(),
    ) {
        for shape in [triangle(&contours[0]), polygon(&contours, rule)].into_iter().flatten() {
            let mut all = levels().into_iter().map(|level| {
                let mut calls = Calls::default();
                shape.rasterize_area(WINDOW, &mut Scratch::with_level(level), &mut calls);
                calls
            });
            let first = all.next().unwrap();
            prop_assert!(all.all(|calls| calls == first));
            for (rect, _) in first.0 {
                prop_assert_eq!(rect.intersect(&WINDOW), rect);
            }
        }
    }

    #[test]
    fn a_triangle_has_its_exact_area(p in [point(8), point(8), point(8)]) {
        check(&[p.to_vec()], FillRule::NonZero, &areas(triangle(&p), SMALL), SMALL);
    }

    #[test]
    fn a_polygon_has_its_exact_area(
        contours in prop::collection::vec(prop::collection::vec(point(8), 1..8), 1..3),
        rule in rule(),
    ) {
        check(&contours, rule, &areas(polygon(&contours, rule), SMALL), SMALL);
    }

    #[test]
    fn tiles_give_the_same_bits(
        contours in prop::collection::vec(prop::collection::vec(point(18), 3..8), 1..3),
        rule in rule(),
        tile in (1..12, 1..12),
    ) {
        for shape in [triangle(&contours[0]), polygon(&contours, rule)] {
            let whole = areas(shape.clone(), WINDOW);
            let Some(shape) = shape else { continue };
            let mut parts = Areas::default();
            let mut scratch = Scratch::new();
            for y in (WINDOW.y0..WINDOW.y1).step_by(tile.1 as usize) {
                for x in (WINDOW.x0..WINDOW.x1).step_by(tile.0 as usize) {
                    let clip = IntRect::new(x, y, x + tile.0, y + tile.1).intersect(&WINDOW);
                    shape.rasterize_area(clip, &mut scratch, &mut parts);
                }
            }
            prop_assert_eq!(parts, whole);
        }
    }

    #[test]
    fn the_areas_of_a_mesh_add_up(seed in any::<u64>(), grain in 0..8u32) {
        let mesh = Mesh::random(&mut Random::new(seed), 24, 1 << grain);
        let mut sum: BTreeMap<(i32, i32), f64> = BTreeMap::new();
        for t in &mesh.triangles {
            for (at, area) in areas(triangle(t), WINDOW).0 {
                *sum.entry(at).or_default() += f64::from(area);
            }
        }
        let whole = areas(polygon(&[mesh.outline], FillRule::NonZero), WINDOW);
        for (at, area) in &whole.0 {
            let parts = sum.remove(at).unwrap_or(0.0);
            prop_assert!((parts - f64::from(*area)).abs() < 1e-6, "{:?}: {} for {}", at, parts, area);
        }
        prop_assert!(sum.values().all(|&v| v < 1e-6));
    }
}

/// How far the part of covered samples may be from the area: with the standard 16 samples, at most
/// 3/16 in a pixel that a single edge crosses, and less than 0.02 in the mean.
#[test]
fn sixteen_samples_are_near_the_area() {
    let pattern = SamplePattern::standard(16).unwrap();
    let clip = IntRect::new(0, 0, 40, 40);
    let mut random = Random::new(7);
    let (mut sum, mut count) = (0.0, 0);
    for _ in 0..500 {
        // One edge through the window, the others far outside.
        let at = |random: &mut Random| random.below(40 * 256);
        let (p, q) = ([at(&mut random), -2560], [at(&mut random), 12_800]);
        let half = if random.below(2) == 0 {
            [p, q, [-90_000, 0]]
        } else {
            [[p[1], p[0]], [q[1], q[0]], [0, -90_000]]
        };
        let sampled = raster(&triangle(&half).unwrap(), clip, &pattern).masks;
        for (at, area) in areas(triangle(&half), clip).0 {
            let part = sampled.get(&at).map_or(0.0, |m| f64::from(m.count_ones()) / 16.0);
            let error = (part - f64::from(area)).abs();
            assert!(error <= 3.0 / 16.0, "{half:?} {at:?}: {part} for {area}");
            sum += error;
            count += 1;
        }
    }
    assert!(sum / f64::from(count) < 0.02);
}

#[test]
fn overlaps_count_by_the_rule() {
    let square = |d: i64| vec![[d, d], [d + 640, d], [d + 640, d + 640], [d, d + 640]];
    for rule in [FillRule::NonZero, FillRule::EvenOdd] {
        let contours = [square(0), square(192), square(320)];
        check(&contours, rule, &areas(polygon(&contours, rule), SMALL), SMALL);
    }
}

/// Ten thousand slanted bars and gaps, 64 to the pixel: far more edges in a row than are looked at
/// one height at a time. Half of each pixel within is covered, whatever the rule.
#[test]
fn crowded_rows_are_right_in_the_mean() {
    let bars: Vec<Vec<[i64; 2]>> = (0..10_000)
        .map(|i| {
            let x = i * 4;
            vec![[x, 100], [x + 2, 100], [x + 514, 2007], [x + 512, 2007]]
        })
        .collect();
    for rule in [FillRule::NonZero, FillRule::EvenOdd] {
        let clip = IntRect::new(50, 0, 60, 9);
        let found = areas(polygon(&bars, rule), clip);
        for y in 1..7 {
            for x in 50..60 {
                let area = found.0[&(x, y)];
                assert!((area - 0.5).abs() < 0.01, "{x}, {y}: {area}");
            }
        }
    }
}

fn scribble(corners: usize, size: [i64; 2]) -> Vec<[i64; 2]> {
    let mut random = Random::new(11);
    (0..corners).map(|_| size.map(|side| random.below(side * 256))).collect()
}

/// What crosses itself everywhere is sampled in the end. The areas must be right in the mean, the same
/// in every clip, and take no longer than samples do: this would not end in a day if every crossing
/// were looked for.
#[test]
fn a_scribble_is_sampled() {
    for (corners, rule) in [
        (300, FillRule::NonZero),
        (300, FillRule::EvenOdd),
        (3_000, FillRule::EvenOdd),
        (30_000, FillRule::EvenOdd),
    ] {
        let clip = IntRect::new(0, 0, 96, 64);
        let shape = polygon(&[scribble(corners, [96, 64])], rule);
        let whole = areas(shape.clone(), clip);
        let shape = shape.unwrap();
        let sampled = raster(&shape, clip, &SamplePattern::grid(64).unwrap());
        let (mut error, mut count) = (0.0, 0);
        for y in 0..64 {
            for x in 0..96 {
                let area = whole.0.get(&(x, y)).copied().unwrap_or(0.0);
                let mask = sampled.masks.get(&(x, y)).map_or(0, |mask| mask.count_ones());
                error += (f64::from(mask) / 64.0 - f64::from(area)).powi(2);
                count += 1;
            }
        }
        let error = (error / f64::from(count)).sqrt();
        // Of 64 samples and 128, all of which may know nothing of each other.
        assert!(
            error < 0.5 * (1.0f64 / 64.0 + 1.0 / 128.0).sqrt() * 1.1,
            "{corners} {rule:?}: {error}"
        );
        if corners <= 3000 {
            let mut parts = Areas::default();
            let mut scratch = Scratch::new();
            for (x, y) in (0..64).step_by(23).flat_map(|y| (0..96).step_by(13).map(move |x| (x, y)))
            {
                let part = IntRect::new(x, y, x + 13, y + 23).intersect(&clip);
                shape.rasterize_area(part, &mut scratch, &mut parts);
            }
            let bits = |areas: Areas| {
                areas.0.into_iter().filter(|(_, area)| *area > 0.0).collect::<Vec<_>>()
            };
            assert!(bits(parts) == bits(whole), "{corners} {rule:?}");
        }
    }
}

/// A star of a million corners: what lies off the clip must not cost.
#[test]
fn a_million_corners_are_no_trouble() {
    let points: Vec<DVec2> = (0..1_000_000)
        .map(|i| {
            let angle = f64::from(i) * (core::f64::consts::TAU / 1e6);
            let radius = 3000.0 + 5.0 * f64::from(i % 7);
            DVec2::new(radius * angle.cos(), radius * angle.sin())
        })
        .collect();
    let shape = Shape::polygon([&points[..]], FillRule::NonZero).unwrap().unwrap();
    let inside = IntRect::new(-32, -32, 32, 32);
    assert_eq!(shape.covers(inside), Cover::Full);
    let border = IntRect::new(2980, -32, 3044, 32);
    let found = areas(Some(shape.clone()), border);
    assert!(found.0.len() > 64 * 20 && found.0.len() < 64 * 64);
    let pattern = SamplePattern::standard(16).unwrap();
    let sampled = raster(&shape, border, &pattern);
    for (at, area) in &found.0 {
        let mask = sampled.masks.get(at).map_or(0, |m| m.count_ones());
        assert!((f64::from(mask) / 16.0 - f64::from(*area)).abs() < 0.4, "{at:?}");
    }
}
