//! Pyramids, and every sampler over a ground plane that runs to its horizon.
//!
//! `ground` is 1280×720 from 2048², about 840,000 pixels inside the image, with axis ratios to 37.
//! `box loop` is the plain way to the same ellipses: every texel of the bounding box, its weight from a
//! table. `quad` is a plane that runs upright to its horizon and fills 1920×1080, 2048² repeated.

#![allow(missing_docs, reason = "criterion's macros make public items")]
#![allow(clippy::unwrap_used, reason = "a benchmark may fail")]

use criterion::{Criterion, Throughput, criterion_group, criterion_main};
use scumble_geometry::{DVec2, Homography};
use scumble_pixel::{Image, Premul, WorkingSpace};
use scumble_texture::{
    Decimation, Footprint, Kernel, LevelMode, Levels, Magnify, PixelFilter, Sampler, Simd, Texture,
    TextureOptions, Wrap,
};
use std::hint::black_box;

const N: usize = 2048;

#[path = "../tests/common/mod.rs"]
mod common;

/// A row of pixels inside the image: its start, and how many.
fn spans(map: &Homography) -> Vec<(DVec2, usize)> {
    let inside = |x: usize, y: usize| {
        let q = map.project(DVec2::new(x as f64 + 0.5, y as f64 + 0.5));
        q.is_some_and(|q| q.min_element() > 4.0 && q.max_element() < N as f64 - 4.0)
    };
    let row = |y: usize| {
        let first = (0..1280).find(|x| inside(*x, y))?;
        let count = (first..1280).take_while(|x| inside(*x, y)).count();
        Some((DVec2::new(first as f64 + 0.5, y as f64 + 0.5), count))
    };
    (0..720).filter_map(row).collect()
}

/// The ellipse of the default preset by its bounding box, in scalar code, with a table of weights.
fn box_loop(levels: &[Image<[f32; 4]>], f: &Footprint, table: &[f32]) -> [f32; 4] {
    let j = &f.jacobian;
    let (uu, vv) =
        (0.25 * (j.a * j.a + j.b * j.b) + 1.0 / 6.0, 0.25 * (j.c * j.c + j.d * j.d) + 1.0 / 6.0);
    let uv = 0.25 * (j.a * j.c + j.b * j.d);
    let minor = 0.5 * (uu + vv - f64::hypot(uu - vv, 2.0 * uv));
    let level = (0.5 * (minor / 0.36).log2()).max(0.0) as usize;
    let level = level.min(levels.len() - 1);
    let k = 0.5f64.powi(level as i32);
    let (uu, uv, vv) = ((uu * k * k) as f32, (uv * k * k) as f32, (vv * k * k) as f32);
    let view = &levels[level];
    let (x, y) = ((f.u * k - 0.5) as f32, (f.v * k - 0.5) as f32);
    let (width, height) = (3.08 * uu.sqrt(), 3.08 * vv.sqrt());
    let det = uu * vv - uv * uv;
    let (a, b, c) = (vv / det, -uv / det, uu / det);
    let mut sum = [0.0; 4];
    let mut total = 0.0;
    for row in (y - height).ceil() as i64..=(y + height).floor() as i64 {
        let texels = view.row(row.clamp(0, view.height() as i64 - 1) as usize);
        let dy = row as f32 - y;
        for column in (x - width).ceil() as i64..=(x + width).floor() as i64 {
            let dx = column as f32 - x;
            let r2 = a * dx * dx + 2.0 * b * dx * dy + c * dy * dy;
            let Some(weight) = table.get((r2 * (1024.0 / 9.4864)) as usize) else { continue };
            let texel = texels[column.clamp(0, view.width() as i64 - 1) as usize];
            total += weight;
            for (sum, t) in sum.iter_mut().zip(texel) {
                *sum += weight * t;
            }
        }
    }
    sum.map(|v| v / total)
}

fn ground(c: &mut Criterion) {
    let t = Texture::new(common::noise(N, N, 1).view(), &TextureOptions::default()).unwrap();
    let map = common::ground(N);
    let spans = spans(&map);
    let pixels: usize = spans.iter().map(|(_, n)| n).sum();
    let mut group = c.benchmark_group("texture/ground");
    group.throughput(Throughput::Elements(pixels as u64)).sample_size(10);
    let s = Sampler::DEFAULT;
    let mut out = vec![Premul::TRANSPARENT; 1280];
    for (name, sampler) in [
        ("nearest", s.with(PixelFilter::Nearest, LevelMode::Nearest)),
        ("bilinear", s.with(PixelFilter::Bilinear, LevelMode::Zero)),
        ("trilinear", s.with(PixelFilter::Bilinear, LevelMode::Linear)),
        ("fast", Sampler::FAST),
        ("default", Sampler::DEFAULT),
        ("high", Sampler::HIGH),
        ("square", Sampler { kernel: Kernel::Box, ..s }),
        ("default, Catmull-Rom", Sampler { magnify: Magnify::CatmullRom, ..s }),
        ("triangle", Sampler { kernel: Kernel::Triangle, ..s }),
        ("Lanczos 2", Sampler { kernel: Kernel::Lanczos2, ..s }),
    ] {
        group.bench_function(name, |b| {
            b.iter(|| {
                for (start, n) in &spans {
                    t.sample_row(&map, *start, &sampler, black_box(&mut out[..*n]));
                }
            });
        });
    }
    let plain = t.clone().with_simd(Simd::SCALAR);
    group.bench_function("default, scalar", |b| {
        b.iter(|| {
            for (start, n) in &spans {
                plain.sample_row(&map, *start, &s, black_box(&mut out[..*n]));
            }
        });
    });
    let table: Vec<f32> =
        (0..1024).map(|i| (-0.5 * 9.4864 * f64::from(i) / 1024.0).exp() as f32).collect();
    let levels: Vec<_> = (0..).map_while(|l| t.level(l)).collect();
    group.bench_function("box loop", |b| {
        b.iter(|| {
            for (start, n) in &spans {
                for i in 0..*n {
                    let f = Footprint::at(&map, DVec2::new(start.x + i as f64, start.y));
                    black_box(box_loop(&levels, &f, &table));
                }
            }
        });
    });
    group.finish();
}

/// A plane that fills 1920×1080 from its horizon at the top, upright, with so many texels per pixel
/// along the nearest row.
fn upright(density: f64) -> Homography {
    let depth = 0.02;
    let w = [0.0, 1.0 / 540.0, depth];
    let middle = N as f64 / 2.0;
    let across = [density, middle * w[1], middle * w[2] - 960.0 * density];
    Homography::new([across, [0.0, 0.0, 1026.0 * density], w])
}

/// One textured quad to the horizon, as a screen of pixels; and at four times the density.
fn quad(c: &mut Criterion) {
    let options = TextureOptions { wrap: Wrap::Repeat, ..Default::default() };
    let t = Texture::new(common::checker(N, 24).view(), &options).unwrap();
    let s = Sampler::DEFAULT;
    let mut out = vec![Premul::TRANSPARENT; 1920];
    for (name, density) in [("texture/quad 1080p", 1.0), ("texture/quad 1080p, dense", 4.0)] {
        let map = upright(density);
        let mut group = c.benchmark_group(name);
        group.throughput(Throughput::Elements(1920 * 1080)).sample_size(10);
        for (name, sampler) in [
            ("nearest", s.with(PixelFilter::Nearest, LevelMode::Nearest)),
            ("bilinear", s.with(PixelFilter::Bilinear, LevelMode::Nearest)),
            ("trilinear", s.with(PixelFilter::Bilinear, LevelMode::Linear)),
            ("fast", Sampler::FAST),
            ("default", Sampler::DEFAULT),
        ] {
            group.bench_function(name, |b| {
                b.iter(|| {
                    for y in 0..1080 {
                        let start = DVec2::new(0.5, f64::from(y) + 0.5);
                        t.sample_row(&map, start, &sampler, black_box(&mut out));
                    }
                });
            });
        }
        group.finish();
    }
}

fn pyramid(c: &mut Criterion) {
    const N: usize = 4096;
    let image: Image<[u8; 4]> = common::noise(N, N, 1);
    let mut group = c.benchmark_group("texture/pyramid 4096²");
    group.throughput(Throughput::Elements((N * N) as u64)).sample_size(10);
    for (name, decimation, space) in [
        ("box, encoded", Decimation::Box, WorkingSpace::Srgb),
        ("Kaiser, linear light", Decimation::Kaiser, WorkingSpace::Linear),
    ] {
        let options = TextureOptions { decimation, space, ..Default::default() };
        group.bench_function(name, |b| b.iter(|| Texture::new(image.view(), &options).unwrap()));
        // As programs make them that do not copy the image.
        let coarser = Levels::Range { first: 1, last: usize::MAX };
        let options = TextureOptions { levels: coarser, ..options };
        group.bench_function(format!("{name}, without the image"), |b| {
            b.iter(|| Texture::new(image.view(), &options).unwrap());
        });
        let options = TextureOptions { levels: Levels::All, ..options };
        let mut kept = Some(Texture::new(image.view(), &options).unwrap());
        group.bench_function(format!("{name}, in memory at hand"), |b| {
            b.iter(|| kept = kept.take().map(|t| t.renewed(image.view(), &options).unwrap()));
        });
    }
    group.finish();
}

criterion_group!(benches, ground, quad, pyramid);
criterion_main!(benches);
