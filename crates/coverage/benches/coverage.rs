//! Raster speed alone: set-up, traversal and a sink that writes one word per pixel.
//!
//! The workloads are those of a frame of 1920 × 1080: T3, 100,000 triangles of about 10 pixels; T4,
//! 1,000 of 50,000; T5, 10,000 of 500. Corners lie on the 1/256 grid, as in the peers' scenes.
#![allow(missing_docs, clippy::unwrap_used)]

use criterion::measurement::WallTime;
use criterion::{
    BatchSize, BenchmarkGroup, BenchmarkId, Criterion, criterion_group, criterion_main,
};
use scumble_coverage::*;
use std::hint::black_box;

const WIDTH: i32 = 1920;
const HEIGHT: i32 = 1080;
const FRAME: IntRect = IntRect::new(0, 0, WIDTH, HEIGHT);

/// One word per pixel: what a flat fill writes, and the count of samples on edges.
struct Paint {
    pixels: Vec<u32>,
    color: u32,
}

impl Paint {
    fn new() -> Self {
        Self { pixels: vec![0; (WIDTH * HEIGHT) as usize], color: 1 }
    }
}

impl Sink for Paint {
    #[inline]
    fn run(&mut self, y: i32, x0: i32, x1: i32) {
        let row = (y * WIDTH) as usize;
        self.pixels[row + x0 as usize..row + x1 as usize].fill(self.color);
    }
    #[inline]
    fn pixel(&mut self, x: i32, y: i32, mask: SampleMask) {
        self.pixels[(y * WIDTH + x) as usize] += mask.count();
    }
}

impl AreaSink for Paint {
    #[inline]
    fn run(&mut self, y: i32, x0: i32, x1: i32) {
        Sink::run(self, y, x0, x1);
    }
    #[inline]
    fn row(&mut self, y: i32, x0: i32, areas: &[f32]) {
        let first = (y * WIDTH + x0) as usize;
        for (pixel, area) in self.pixels[first..first + areas.len()].iter_mut().zip(areas) {
            *pixel += (area * 255.0) as u32;
        }
    }
    #[inline]
    fn pixel(&mut self, x: i32, y: i32, area: f32) {
        self.pixels[(y * WIDTH + x) as usize] += (area * 255.0) as u32;
    }
}

/// Looks at what it gets and writes nothing: what is left is the rasterizer.
#[derive(Default)]
struct Count(u64);

impl AreaSink for Count {
    #[inline]
    fn run(&mut self, _: i32, x0: i32, x1: i32) {
        self.0 += (x1 - x0) as u64;
    }
    #[inline]
    fn span(&mut self, _: i32, x0: i32, x1: i32, _: f32) {
        self.0 += (x1 - x0) as u64;
    }
    #[inline]
    fn row(&mut self, _: i32, _: i32, areas: &[f32]) {
        self.0 += areas.len() as u64 + u64::from(areas[0].to_bits());
    }
    #[inline]
    fn pixel(&mut self, _: i32, _: i32, area: f32) {
        self.0 += u64::from(area.to_bits());
    }
}

/// `n` triangles of about `area` pixels that lie within the frame.
fn triangles(n: usize, area: f64) -> Vec<[DVec2; 3]> {
    let mut state = 0x9E37_79B9_7F4A_7C15u64;
    let mut random = move || {
        state ^= state >> 12;
        state ^= state << 25;
        state ^= state >> 27;
        (state.wrapping_mul(0x2545_F491_4F6C_DD1D) >> 11) as f64 / (1u64 << 53) as f64
    };
    let one = |_| {
        let turn = random() * core::f64::consts::TAU;
        let mut corner = |k: f64| {
            let angle = turn + k * core::f64::consts::TAU / 3.0 + random() - 0.5;
            DVec2::new(angle.cos(), angle.sin())
        };
        let mut p = [corner(0.0), corner(1.0), corner(2.0)];
        let (u, v) = (p[1] - p[0], p[2] - p[0]);
        let scale = (area / (0.5 * (u.x * v.y - u.y * v.x).abs())).sqrt();
        p = p.map(|q| q * scale);
        let low = p[0].min(p[1]).min(p[2]);
        let room =
            DVec2::new(f64::from(WIDTH), f64::from(HEIGHT)) - (p[0].max(p[1]).max(p[2]) - low);
        let at = DVec2::new(random() * room.x, random() * room.y) - low;
        p.map(|q| ((q + at) * 256.0).round() / 256.0)
    };
    (0..n).map(one).collect()
}

fn shapes(points: &[[DVec2; 3]]) -> Vec<Shape> {
    points.iter().filter_map(|&p| Shape::triangle(p).unwrap()).collect()
}

/// By samples, by area, and by area without a picture.
fn each_way(group: &mut BenchmarkGroup<'_, WallTime>, name: &str, shapes: &[Shape], clip: IntRect) {
    let mut paint = Paint::new();
    let mut scratch = Scratch::new();
    for samples in [1, 4, 16] {
        let pattern = SamplePattern::standard(samples).unwrap();
        group.bench_function(BenchmarkId::new(name, samples), |b| {
            b.iter(|| {
                for s in shapes {
                    s.rasterize(clip, &pattern, &mut scratch, &mut paint);
                }
            });
        });
    }
    group.bench_function(BenchmarkId::new(name, "area"), |b| {
        b.iter(|| {
            for s in shapes {
                s.rasterize_area(clip, &mut scratch, &mut paint);
            }
        });
    });
    let mut count = Count::default();
    group.bench_function(BenchmarkId::new(name, "area, not painted"), |b| {
        b.iter(|| {
            for s in shapes {
                s.rasterize_area(clip, &mut scratch, &mut count);
            }
        });
    });
    black_box((&paint.pixels, count.0));
}

fn coverage(c: &mut Criterion) {
    let mut group = c.benchmark_group("coverage");
    group.sample_size(10);
    for (name, n, area) in [("T3", 100_000, 10.0), ("T4", 1000, 50_000.0), ("T5", 10_000, 500.0)] {
        let points = triangles(n, area);
        let shapes = shapes(&points);
        group.bench_function(BenchmarkId::new(name, "setup"), |b| {
            b.iter_batched(|| (), |()| black_box(self::shapes(&points)), BatchSize::PerIteration);
        });
        each_way(&mut group, name, &shapes, FRAME);
    }
    group.finish();
}

/// Each way of finding the samples, on T5.
fn traversal(c: &mut Criterion) {
    let mut group = c.benchmark_group("traversal");
    group.sample_size(10);
    let shapes = shapes(&triangles(10_000, 500.0));
    let ways = [
        ("tiled", Traversal::Tiled),
        ("scanline", Traversal::Scanline),
        ("bounding box", Traversal::BoundingBox),
        ("row-major", Traversal::Incremental(Order::RowMajor)),
        ("backtrack", Traversal::Incremental(Order::Backtrack)),
        ("zig-zag", Traversal::Incremental(Order::ZigZag)),
        ("Morton", Traversal::Incremental(Order::Morton)),
        ("Hilbert", Traversal::Incremental(Order::Hilbert)),
    ];
    let mut paint = Paint::new();
    let mut scratch = Scratch::new();
    for (name, way) in ways {
        for samples in [1, 4, 9, 16] {
            let pattern = SamplePattern::grid(samples).unwrap();
            group.bench_function(BenchmarkId::new(name, samples), |b| {
                b.iter(|| {
                    for s in &shapes {
                        s.rasterize_by(way, FRAME, &pattern, &mut scratch, &mut paint);
                    }
                });
            });
        }
    }
    group.finish();
}

/// 240 closed curves of 64 corners or more, as in a drawing of 900 × 900 pixels times `scale`: filled
/// or as strokes 3 pixels wide.
fn curves(scale: f64, stroked: bool) -> Vec<Shape> {
    let corners = (64.0 * scale.sqrt()) as u32;
    let centers = triangles(240, 10.0);
    let curve = |(i, p): (u32, &[DVec2; 3])| {
        let size = 10.0 + f64::from(i * i % 151);
        let ring = |out: f64| -> Vec<DVec2> {
            let corner = |k: u32| {
                let angle = f64::from(k) * core::f64::consts::TAU / f64::from(corners);
                let radius = size * (1.0 + 0.3 * (3.0 * angle).sin() + 0.1 * (7.0 * angle).cos());
                let turn = DVec2::new(angle.cos(), angle.sin());
                (p[0] * DVec2::new(0.47, 0.83) + turn * (radius + out)) * scale
            };
            (0..corners).map(corner).collect()
        };
        let rings = if stroked {
            vec![ring(1.5), ring(-1.5).into_iter().rev().collect()]
        } else {
            vec![ring(0.0)]
        };
        Shape::polygon(rings.iter().map(Vec::as_slice), FillRule::NonZero).unwrap()
    };
    (0u32..).zip(&centers).filter_map(curve).collect()
}

fn paths(c: &mut Criterion) {
    let mut group = c.benchmark_group("paths");
    group.sample_size(10);
    let small = IntRect::new(0, 0, 900, 900);
    each_way(&mut group, "900", &curves(1.0, false), small);
    each_way(&mut group, "900 stroked", &curves(1.0, true), small);
    each_way(&mut group, "1920", &curves(2.2, false), FRAME);
    group.finish();
}

criterion_group!(benches, coverage, traversal, paths);
criterion_main!(benches);
