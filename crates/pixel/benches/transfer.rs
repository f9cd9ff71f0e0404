//! Rows of pixels into and out of a working space, 1920 pixels at a time.
use criterion::{Criterion, Throughput, criterion_group, criterion_main};
use scumble_pixel::{Premul, WorkingSpace, srgb};
use std::hint::black_box;

const WIDTH: usize = 1920;

fn rows(c: &mut Criterion) {
    let codes: Vec<[u8; 4]> =
        (0..WIDTH).map(|i| [i as u8, (i / 3) as u8, (i * 7) as u8, 255]).collect();
    let mut group = c.benchmark_group("row");
    group.throughput(Throughput::Elements(WIDTH as u64));
    for space in [WorkingSpace::Srgb, WorkingSpace::Linear] {
        let mut premul = vec![Premul::TRANSPARENT; WIDTH];
        group.bench_function(format!("import {space:?}"), |b| {
            b.iter(|| space.import_row(black_box(&codes), black_box(&mut premul)));
        });
        let mut out = vec![[0; 4]; WIDTH];
        group.bench_function(format!("export {space:?}"), |b| {
            b.iter(|| space.export_row(black_box(&premul), black_box(&mut out)));
        });
    }
    let values: Vec<f32> = (0..WIDTH).map(|i| i as f32 / WIDTH as f32).collect();
    let mut out = values.clone();
    for (name, f) in [
        ("decode_slice", srgb::decode_slice as fn(&mut [f32])),
        ("encode_slice", srgb::encode_slice),
    ] {
        group.bench_function(name, |b| {
            b.iter(|| {
                out.copy_from_slice(black_box(&values));
                f(black_box(&mut out));
            });
        });
    }
    group.finish();
}

criterion_group!(benches, rows);
criterion_main!(benches);
