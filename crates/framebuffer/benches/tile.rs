//! A 64×64 tile from reset to codes, at 1, 4 and 16 samples: what more samples cost.
use criterion::{Criterion, Throughput, criterion_group, criterion_main};
use scumble_framebuffer::{Tile, encode_row};
use scumble_pixel::{Premul, Straight, WorkingSpace};
use std::hint::black_box;

const SIDE: u32 = 64;
const LAYERS: u32 = 8;

/// Eight layers of five diagonal stripes, edges and interiors as a coverage kernel reports them.
/// At more than one sample two of the layers split the five edge pixels of each row.
fn draw(tile: &mut Tile, samples: u32, alpha: f32) {
    let runs: [Premul; 64] =
        core::array::from_fn(|i| Straight([i as f32 / 64.0, 0.3, 0.6, alpha]).premultiply());
    tile.reset(SIDE, SIDE, samples, Premul([1.0; 4]));
    for layer in 0..LAYERS {
        for y in 0..SIDE {
            for stripe in 0..5 {
                let x = (y + 13 * stripe) % SIDE;
                let mask = (0xff_u64 << (y % 9)) & 0xffff;
                if samples > 1 && layer % 4 == 3 {
                    tile.blend_masked(x, y, mask, runs[stripe as usize]);
                }
                tile.blend_run(x + 1, y, &runs[..11]);
            }
        }
    }
}

fn tiles(c: &mut Criterion) {
    let mut group = c.benchmark_group("tile");
    group.throughput(Throughput::Elements(u64::from(SIDE * SIDE)));
    let mut tile = Tile::new();
    let mut pixels = [Premul::TRANSPARENT; SIDE as usize];
    let mut codes = [[0; 4]; SIDE as usize];
    for samples in [1, 4, 16] {
        for alpha in [1.0, 0.5] {
            group.bench_function(
                format!("draw and encode, {samples} samples, alpha {alpha}"),
                |b| {
                    b.iter(|| {
                        draw(&mut tile, black_box(samples), black_box(alpha));
                        for y in 0..SIDE {
                            tile.resolve_row(y, &mut pixels);
                            encode_row(&pixels, WorkingSpace::Srgb, &mut codes);
                            black_box(&codes);
                        }
                    });
                },
            );
        }
        group.bench_function(format!("fill and resolve, {samples} samples"), |b| {
            b.iter(|| {
                tile.reset(SIDE, SIDE, black_box(samples), Premul([1.0; 4]));
                for block in 0..64 {
                    tile.fill_block(
                        block % 8 * 8,
                        block / 8 * 8,
                        8,
                        8,
                        Premul([0.5, 0.0, 0.0, 1.0]),
                    );
                }
                for y in 0..SIDE {
                    tile.resolve_row(y, &mut pixels);
                    black_box(&pixels);
                }
            });
        });
    }
    tile.reset(SIDE, SIDE, 16, Premul([1.0; 4]));
    for (x, y) in (0..SIDE).flat_map(|y| (0..SIDE).map(move |x| (x, y))) {
        tile.blend_masked(x, y, 0x0ff0, Premul([0.5, 0.0, 0.0, 1.0]));
    }
    group.bench_function("resolve, every pixel split, 16 samples", |b| {
        b.iter(|| (0..SIDE).for_each(|y| tile.resolve_row(y, black_box(&mut pixels))));
    });
    group.finish();
}

criterion_group!(benches, tiles);
criterion_main!(benches);
