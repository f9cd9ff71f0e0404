//! Triangles, and polygons cut into them.
#![allow(missing_docs)]

use proptest::prelude::*;
use scumble_geometry::{DVec2, FillRule, Triangle, triangulate};
use std::time::Instant;

fn v(x: f64, y: f64) -> DVec2 {
    DVec2::new(x, y)
}

type Point = (i64, i64);

fn to_grid(p: DVec2) -> Point {
    let (x, y) = (p.x * 256.0, p.y * 256.0);
    assert_eq!((x, y), (x.round(), y.round()), "not on the grid");
    (x as i64, y as i64)
}

fn snap(p: DVec2) -> Point {
    ((p.x * 256.0 + 0.5).floor() as i64, (p.y * 256.0 + 0.5).floor() as i64)
}

fn cross(a: Point, b: Point, c: Point) -> i64 {
    (b.0 - a.0) * (c.1 - a.1) - (b.1 - a.1) * (c.0 - a.0)
}

/// The top-left rule, exact, for a triangle of positive area (clockwise to the eye).
fn covers(t: [Point; 3], p: Point) -> bool {
    (0..3).all(|i| {
        let (a, b) = (t[i], t[(i + 1) % 3]);
        let top = a.1 == b.1 && b.0 > a.0;
        let left = b.1 < a.1;
        let e = cross(a, b, p);
        e > 0 || (e == 0 && (top || left))
    })
}

/// How often rings wind around a point, with the same half-open rule.
fn winding(rings: &[Vec<Point>], p: Point) -> i64 {
    let mut sum = 0;
    for ring in rings {
        for (i, &a) in ring.iter().enumerate() {
            let b = ring[(i + 1) % ring.len()];
            let (upper, lower, turn) = if a.1 < b.1 { (a, b, 1) } else { (b, a, -1) };
            if upper.1 <= p.1 && p.1 < lower.1 {
                // On the edge counts as right of it.
                sum += if cross(upper, lower, p) <= 0 { turn } else { 0 };
            }
        }
    }
    sum
}

/// Whether a point is within `units` of an edge.
fn is_near(rings: &[Vec<Point>], p: Point, units: f64) -> bool {
    let f = |p: Point| v(p.0 as f64, p.1 as f64);
    let p = f(p);
    rings.iter().any(|ring| {
        (0..ring.len()).any(|i| {
            let (a, b) = (f(ring[i]), f(ring[(i + 1) % ring.len()]));
            let d = b - a;
            let t = ((p - a).dot(d) / d.length_squared().max(1e-9)).clamp(0.0, 1.0);
            (p - a - d * t).length() <= units
        })
    })
}

struct Result {
    triangles: Vec<[Point; 3]>,
    rings: Vec<Vec<Point>>,
    rule: FillRule,
}

impl Result {
    fn of(contours: &[Vec<DVec2>], rule: FillRule) -> Self {
        let triangles = triangulate(contours.iter().map(Vec::as_slice), rule);
        let triangles: Vec<_> = triangles.into_iter().map(|t| t.map(to_grid)).collect();
        for t in &triangles {
            assert!(cross(t[0], t[1], t[2]) > 0, "{t:?}");
        }
        let rings = contours.iter().map(|c| c.iter().map(|&p| snap(p)).collect()).collect();
        Self { triangles, rings, rule }
    }

    /// Whether only vertices of the input were used.
    fn reuses_vertices(&self) -> bool {
        let known = |p: &Point| self.rings.iter().any(|r| r.contains(p));
        self.triangles.iter().flatten().all(known)
    }

    fn area2(&self) -> i64 {
        self.triangles.iter().map(|t| cross(t[0], t[1], t[2])).sum()
    }

    /// Twice the area that the rule asks for: widths at the middle heights between all vertices
    /// and crossings, which is exact because they grow linearly in between.
    fn true_area2(&self) -> f64 {
        let f = |p: Point| v(p.0 as f64, p.1 as f64);
        let mut edges = Vec::new();
        for ring in &self.rings {
            for i in 0..ring.len() {
                let (a, b) = (f(ring[i]), f(ring[(i + 1) % ring.len()]));
                if a.y != b.y {
                    edges.push(if a.y < b.y { (a, b, 1) } else { (b, a, -1) });
                }
            }
        }
        let x_at = |e: &(DVec2, DVec2, i64), y: f64| {
            e.0.x + (e.1.x - e.0.x) * (y - e.0.y) / (e.1.y - e.0.y)
        };
        let mut heights: Vec<f64> = edges.iter().flat_map(|e| [e.0.y, e.1.y]).collect();
        for (i, e) in edges.iter().enumerate() {
            for g in &edges[..i] {
                let (y0, y1) = (e.0.y.max(g.0.y), e.1.y.min(g.1.y));
                let (d0, d1) = (x_at(e, y0) - x_at(g, y0), x_at(e, y1) - x_at(g, y1));
                if y0 < y1 && d0 * d1 < 0.0 {
                    heights.push(y0 + (y1 - y0) * d0 / (d0 - d1));
                }
            }
        }
        heights.sort_by(f64::total_cmp);
        let width = |y: f64| {
            let mut at: Vec<_> = edges.iter().filter(|e| e.0.y < y && y < e.1.y).collect();
            at.sort_by(|a, b| x_at(a, y).total_cmp(&x_at(b, y)));
            let (mut w, mut sum) = (0, 0.0);
            for pair in at.windows(2) {
                w += pair[0].2;
                if self.rule.is_inside(w) {
                    sum += x_at(pair[1], y) - x_at(pair[0], y);
                }
            }
            sum
        };
        heights.windows(2).map(|h| 2.0 * (h[1] - h[0]) * width((h[0] + h[1]) * 0.5)).sum()
    }

    fn perimeter(&self) -> f64 {
        let length = |r: &Vec<Point>| {
            let n = r.len();
            (0..n)
                .map(|i| {
                    let (a, b) = (r[i], r[(i + 1) % n]);
                    v((b.0 - a.0) as f64, (b.1 - a.1) as f64).length()
                })
                .sum::<f64>()
        };
        self.rings.iter().map(length).sum()
    }

    fn count(&self, p: Point) -> usize {
        self.triangles.iter().filter(|t| covers(**t, p)).count()
    }

    /// Points of the grid all over the shape, among them all vertices and points beside them.
    fn probes(&self) -> Vec<Point> {
        let all: Vec<Point> = self.rings.iter().flatten().copied().collect();
        let mut probes = all.clone();
        probes.extend(all.iter().map(|p| (p.0 + 1, p.1)));
        probes.extend(all.windows(2).map(|w| ((w[0].0 + w[1].0) / 2, (w[0].1 + w[1].1) / 2)));
        probes.extend(all.iter().zip(all.iter().rev()).map(|(a, b)| (a.0, b.1)));
        probes.extend(
            self.triangles
                .iter()
                .map(|t| ((t[0].0 + t[1].0 + t[2].0) / 3, (t[0].1 + t[1].1 + t[2].1) / 3)),
        );
        probes
    }

    /// Every probe exactly as the fill rule says: for contours that do not meet.
    fn assert_exact(&self) {
        assert!(self.reuses_vertices());
        for p in self.probes() {
            let inside = self.rule.is_inside(winding(&self.rings, p));
            assert_eq!(self.count(p), usize::from(inside), "{p:?} {:?}", self.rings);
        }
        let area = self.true_area2();
        assert!((self.area2() as f64 - area).abs() <= 1e-9 * area + 1e-6);
    }

    /// No probe twice, and as the fill rule says away from the edges.
    fn assert_sound(&self) {
        for p in self.probes() {
            let count = self.count(p);
            assert!(count <= 1, "{p:?} {count} {:?}", self.rings);
            if !is_near(&self.rings, p, 1.5) {
                let inside = self.rule.is_inside(winding(&self.rings, p));
                assert_eq!(count, usize::from(inside), "{p:?} {:?}", self.rings);
            }
        }
        let difference = (self.area2() as f64 - self.true_area2()).abs();
        // One unit along every edge.
        assert!(difference <= 2.0 * self.perimeter() + 2.0, "{difference}");
    }
}

fn star(n: usize, center: DVec2, radii: impl Fn(usize) -> f64) -> Vec<DVec2> {
    let at = |i: usize| {
        let a = i as f64 / n as f64 * core::f64::consts::TAU;
        center + v(a.cos(), a.sin()) * radii(i)
    };
    (0..n).map(at).collect()
}

fn rect(x0: f64, y0: f64, x1: f64, y1: f64) -> Vec<DVec2> {
    vec![v(x0, y0), v(x1, y0), v(x1, y1), v(x0, y1)]
}

const RULES: [FillRule; 2] = [FillRule::NonZero, FillRule::EvenOdd];

proptest! {
    #[test]
    fn barycentrics_agree(p in prop::array::uniform8(-100.0..100.0f64)) {
        let at = |i: usize| v(p[2 * i], p[2 * i + 1]);
        let t = Triangle::new([at(0), at(1), at(2)]);
        prop_assume!(t.signed_area().abs() > 1.0);
        let area = t.barycentrics(at(3)).unwrap();
        let distance = t.barycentrics_by_distance(at(3)).unwrap();
        for i in 0..3 {
            prop_assert!((area[i] - distance[i]).abs() <= 1e-9 * (1.0 + area[i].abs()));
            let corner = t.barycentrics(t.vertices[i]).unwrap();
            prop_assert_eq!(corner, [0, 1, 2].map(|k| f64::from(k == i)).map(|v| v + 0.0));
        }
        prop_assert!((area.iter().sum::<f64>() - 1.0).abs() < 1e-9);
        let back = t.vertices[0] * area[0] + t.vertices[1] * area[1] + t.vertices[2] * area[2];
        prop_assert!((back - at(3)).length() < 1e-8);
        let outside = area.iter().any(|&b| b < -1e-9);
        let inside = area.iter().all(|&b| b > 1e-9);
        prop_assert!(!(outside && t.contains(at(3))) && (!inside || t.contains(at(3))));
    }

    #[test]
    fn star_shaped_polygons_are_exact(
        r in prop::collection::vec(0.05..30.0f64, 3..60), x in -50.0..50.0f64, reverse in any::<bool>(),
    ) {
        let mut ring = star(r.len(), v(x, 20.0), |i| r[i]);
        if reverse {
            ring.reverse();
        }
        for rule in RULES {
            let result = Result::of(&[ring.clone()], rule);
            // Snapping may make thin spikes touch: then the trapezoids take over.
            if result.reuses_vertices() { result.assert_exact() } else { result.assert_sound() }
        }
    }

    #[test]
    fn nested_rings_are_exact(
        r in prop::collection::vec(0.0..1.0f64, 36..90),
        reverse in prop::array::uniform3(any::<bool>()), shear in -3.0..3.0f64, side in any::<bool>(),
    ) {
        // Three rings, each within a band of radii of its own: splits and merges in all orders.
        let parts = [&r[..12], &r[12..24], &r[24..]];
        let bands = [(22.0, 8.0), (12.0, 6.0), (1.0, 7.0)];
        let rings: Vec<Vec<DVec2>> = (0..3)
            .map(|k| {
                let (least, range) = bands[k];
                let mut ring = star(parts[k].len(), v(3.0, 4.0), |i| least + range * parts[k][i]);
                if reverse[k] {
                    ring.reverse();
                }
                let turned = |p: DVec2| if side { v(p.y, p.x) } else { p };
                ring.into_iter().map(|p| turned(v(p.x + shear * p.y, p.y))).collect()
            })
            .collect();
        for rule in RULES {
            let result = Result::of(&rings, rule);
            prop_assert!(result.reuses_vertices());
            result.assert_exact();
        }
    }

    #[test]
    fn coarse_random_polygons_are_sound(
        p in prop::collection::vec((-5..6i32, -5..6i32), 3..24), split in 1..24usize,
    ) {
        // On a coarse grid nearly all degeneracies come up: touching, overlapping, spikes.
        let points: Vec<DVec2> = p.iter().map(|&(x, y)| v(f64::from(x) / 4.0, f64::from(y) / 4.0)).collect();
        let (a, b) = points.split_at(split.min(points.len()));
        for rule in RULES {
            Result::of(&[a.to_vec(), b.to_vec()], rule).assert_sound();
        }
    }

    #[test]
    fn random_polygons_are_sound(p in prop::collection::vec((-40.0..40.0f64, -40.0..40.0f64), 3..24)) {
        let points: Vec<DVec2> = p.iter().map(|&(x, y)| v(x, y)).collect();
        for rule in RULES {
            Result::of(std::slice::from_ref(&points), rule).assert_sound();
        }
    }

    #[test]
    fn whole_pixels_move_the_triangles_and_change_none(
        p in prop::collection::vec((-2000..2000i32, -2000..2000i32), 3..12),
        x in -1000..1000i32, y in -1000..1000i32,
    ) {
        let points: Vec<DVec2> = p.iter().map(|&(x, y)| v(f64::from(x), f64::from(y)) / 256.0).collect();
        let step = v(f64::from(x), f64::from(y));
        let moved: Vec<DVec2> = points.iter().map(|&p| p + step).collect();
        for rule in RULES {
            let here = triangulate([&points[..]], rule);
            let there = triangulate([&moved[..]], rule);
            let expected: Vec<[DVec2; 3]> = here.iter().map(|t| t.map(|p| p + step)).collect();
            prop_assert_eq!(&there, &expected);
        }
    }

    #[test]
    fn the_order_of_vertices_does_not_matter(
        r in prop::collection::vec(1.0..30.0f64, 3..30), turn in 0..30usize,
    ) {
        let ring = star(r.len(), v(0.0, 0.0), |i| r[i]);
        let mut turned = ring.clone();
        turned.rotate_left(turn % ring.len());
        let (a, b) = (Result::of(&[ring], FillRule::NonZero), Result::of(&[turned], FillRule::NonZero));
        prop_assert_eq!(a.area2(), b.area2());
    }

    #[test]
    fn hostile_coordinates_are_survived(p in prop::collection::vec((any::<f64>(), any::<f64>()), 0..12)) {
        let points: Vec<DVec2> = p.iter().map(|&(x, y)| v(x, y)).collect();
        let scaled: Vec<DVec2> = points.iter().map(|p| (*p * 1e-290).clamp(v(-3e6, -3e6), v(3e6, 3e6))).collect();
        for rule in RULES {
            let _ = Result::of(&[points.clone(), scaled.clone()], rule);
        }
    }
}

#[test]
fn simple_polygons_of_all_kinds() {
    let comb: Vec<DVec2> = (0..40)
        .map(|i| v(f64::from(i), if i % 2 == 0 { 0.0 } else { 9.0 }))
        .chain([v(40.0, 12.0), v(-1.0, 12.0)])
        .collect();
    let spiral: Vec<DVec2> = {
        let at = |i: i32, r: f64| {
            let a = f64::from(i) * 0.3;
            v(a.cos(), a.sin()) * (r + f64::from(i))
        };
        (10..80).map(|i| at(i, 0.0)).chain((10..80).rev().map(|i| at(i, 5.0))).collect()
    };
    let collinear: Vec<DVec2> =
        [(0, 0), (2, 0), (4, 0), (8, 0), (8, 3), (8, 8), (4, 8), (0, 8), (0, 1)]
            .map(|(x, y)| v(f64::from(x), f64::from(y)))
            .to_vec();
    let duplicates: Vec<DVec2> = collinear.iter().flat_map(|&p| [p, p, p]).collect();
    let spike: Vec<DVec2> =
        [(0, 0), (4, 0), (9, 0), (4, 0), (4, 4), (2, 4), (2, 9), (2, 4), (0, 4)]
            .map(|(x, y)| v(f64::from(x), f64::from(y)))
            .to_vec();
    let staircase: Vec<DVec2> = (0..20)
        .flat_map(|i| [v(f64::from(i), f64::from(i)), v(f64::from(i + 1), f64::from(i))])
        .chain([v(0.0, 20.0)])
        .collect();
    for ring in [comb, spiral, collinear, duplicates, spike, staircase] {
        for reverse in [false, true] {
            // Also lying on its side, so that the sweep meets it another way.
            for turn in [|p: DVec2| p, |p: DVec2| v(p.y, p.x), |p: DVec2| v(p.x + p.y, p.y - p.x)] {
                let mut ring: Vec<DVec2> = ring.iter().map(|&p| turn(p)).collect();
                if reverse {
                    ring.reverse();
                }
                Result::of(&[ring.clone()], FillRule::NonZero).assert_exact();
                Result::of(&[ring], FillRule::EvenOdd).assert_exact();
            }
        }
    }
}

#[test]
fn holes_and_islands() {
    let mut hole = rect(2.0, 2.0, 8.0, 8.0);
    hole.reverse();
    let island = rect(4.0, 4.0, 6.0, 6.0);
    let rings = [rect(0.0, 0.0, 10.0, 10.0), hole, island, rect(20.0, 0.0, 21.0, 30.0)];
    for rule in RULES {
        let result = Result::of(&rings, rule);
        result.assert_exact();
        assert_eq!(result.area2(), 2 * 65536 * (100 - 36 + 4 + 30));
    }
    // The same way round: a hole for one rule only.
    let rings = [rect(0.0, 0.0, 10.0, 10.0), rect(2.0, 2.0, 8.0, 8.0)];
    assert_eq!(Result::of(&rings, FillRule::NonZero).area2(), 2 * 65536 * 100);
    assert_eq!(Result::of(&rings, FillRule::EvenOdd).area2(), 2 * 65536 * 64);
}

#[test]
fn self_intersections() {
    let bow_tie = vec![v(0.0, 0.0), v(8.0, 8.0), v(8.0, 0.0), v(0.0, 8.0)];
    let result = Result::of(&[bow_tie], FillRule::NonZero);
    result.assert_sound();
    assert_eq!(result.area2(), 2 * 65536 * 32);

    let corner = |i: usize| {
        let a = (i * 2 % 5) as f64 * core::f64::consts::TAU / 5.0;
        v(a.sin(), -a.cos()) * 20.0
    };
    let pentagram: Vec<DVec2> = (0..5).map(corner).collect();
    let solid = Result::of(std::slice::from_ref(&pentagram), FillRule::NonZero);
    let hollow = Result::of(&[pentagram], FillRule::EvenOdd);
    solid.assert_sound();
    hollow.assert_sound();
    assert_eq!((solid.count((0, 0)), hollow.count((0, 0))), (1, 0));

    // Two rectangles that overlap, and the same one twice.
    let two = [rect(0.0, 0.0, 4.0, 4.0), rect(2.0, 2.0, 6.0, 6.0)];
    assert_eq!(Result::of(&two, FillRule::NonZero).area2(), 2 * 65536 * 28);
    assert_eq!(Result::of(&two, FillRule::EvenOdd).area2(), 2 * 65536 * 24);
    let same = [rect(0.0, 0.0, 4.0, 4.0), rect(0.0, 0.0, 4.0, 4.0)];
    assert_eq!(Result::of(&same, FillRule::NonZero).area2(), 2 * 65536 * 16);
    assert_eq!(Result::of(&same, FillRule::EvenOdd).area2(), 0);
}

#[test]
fn nothing_to_fill() {
    let nan = vec![v(0.0, 0.0), v(f64::NAN, 1.0), v(1.0, 0.0)];
    let line = vec![v(0.0, 0.0), v(5.0, 5.0), v(2.0, 2.0), v(9.0, 9.0)];
    let tiny = rect(0.0, 0.0, 0.001, 0.001);
    for ring in [vec![], vec![v(1.0, 1.0)], rect(1.0, 1.0, 1.0, 9.0), nan, line, tiny] {
        assert!(Result::of(&[ring], FillRule::NonZero).triangles.is_empty());
    }
}

#[test]
fn far_away_is_clipped() {
    let huge = rect(-1e30, -1e30, 1e30, 1e30);
    let result = Result::of(&[huge], FillRule::NonZero);
    assert_eq!(result.triangles.len(), 2);
    assert_eq!(result.count((0, 0)), 1);
}

#[test]
fn large_polygons_are_quick() {
    let n = 10_000;
    let gear = star(n, v(5000.0, 5000.0), |i| if i % 2 == 0 { 4900.0 } else { 3000.0 });
    let comb: Vec<DVec2> = (0..n)
        .map(|i| v(i as f64, if i % 2 == 0 { 0.0 } else { 900.0 }))
        .chain([v(n as f64, 1000.0), v(-1.0, 1000.0)])
        .collect();
    let scribble: Vec<DVec2> = (0..1000u32)
        .map(|i| v(f64::from(i.wrapping_mul(2_654_435_761) >> 22), f64::from(i * 617 % 1000)))
        .collect();
    let start = Instant::now();
    let gear = triangulate([&gear[..]], FillRule::NonZero);
    assert_eq!(gear.len(), n - 2);
    let gear_time = start.elapsed();
    assert!(triangulate([&comb[..]], FillRule::EvenOdd).len() <= n);
    let comb_time = start.elapsed() - gear_time;
    let count = triangulate([&scribble[..]], FillRule::EvenOdd).len();
    let all = start.elapsed();
    println!(
        "gear {gear_time:?}, comb {comb_time:?}, scribble {count} in {:?}",
        all - gear_time - comb_time
    );
    // Generous: the machine may be busy.
    assert!(gear_time.as_secs() < 2 && comb_time.as_secs() < 2 && all.as_secs() < 30);
}

#[test]
fn the_checker_can_fail() {
    let ring = star(9, v(0.0, 0.0), |i| if i % 2 == 0 { 20.0 } else { 5.0 });
    let mut result = Result::of(&[ring], FillRule::NonZero);
    let wrong = |result: &Result| {
        let inside = |p| usize::from(result.rule.is_inside(winding(&result.rings, p)));
        result.probes().iter().any(|&p| result.count(p) != inside(p))
    };
    assert!(!wrong(&result));
    let area = result.area2();
    let gone = result.triangles.pop().unwrap();
    assert!(result.area2() < area && result.count(gone[0]) + result.count(gone[1]) < 3);
    result.triangles.push(gone);
    result.triangles.push(gone);
    assert!(wrong(&result));
}
