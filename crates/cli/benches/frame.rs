//! Whole frames, on one thread: what sixteen samples cost beside one, and the workloads that
//! rasterizers are compared on.
//!
//! `cargo bench --bench frame`; add `-- ground`, `-- small` and so on for a part.
#![allow(missing_docs, clippy::unwrap_used)]

use criterion::{BenchmarkId, Criterion, criterion_group, criterion_main};
use lab::workloads;
use scumble::coverage::SamplePattern;
use scumble::scene::Scene;
use scumble::{Control, Settings, Sink, render};
use std::convert::Infallible;
use std::hint::black_box;
use std::path::{Path, PathBuf};

/// Takes the rows and lets them go: the frame is measured, not an encoder.
struct Screen;

impl Sink for Screen {
    type Error = Infallible;

    fn start(&mut self, _: u32, _: u32) -> Result<(), Infallible> {
        Ok(())
    }

    fn rows(&mut self, _: u32, rows: &[[u8; 4]]) -> Result<(), Infallible> {
        black_box(rows);
        Ok(())
    }

    fn finish(&mut self) -> Result<(), Infallible> {
        Ok(())
    }
}

/// The files beside a scene of our own.
struct Beside(PathBuf);

impl scumble_svg::Resources for Beside {
    fn load(&self, href: &str) -> Result<Vec<u8>, scumble_svg::ResourceError> {
        std::fs::read(self.0.join(href))
            .map_err(|error| scumble_svg::ResourceError::Other(error.to_string()))
    }
}

fn ground() -> Scene {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../assets/scenes");
    let text = std::fs::read(folder.join("ground.svg")).unwrap();
    let beside = Beside(folder);
    let options = scumble_svg::Options::default().with_resources(&beside);
    scumble_svg::parse(&text, &options).unwrap().scene
}

fn frames(c: &mut Criterion) {
    let (width, height) = (workloads::WIDTH, workloads::HEIGHT);
    let scenes: [(&str, Scene, u32, u32); 4] = [
        ("ground", ground(), 800, 600),
        ("small", workloads::small(), width, height),
        ("large", workloads::large(), width, height),
        ("smooth", workloads::smooth(), width, height),
    ];
    let mut group = c.benchmark_group("frame");
    group.sample_size(20);
    for (name, scene, width, height) in &scenes {
        for samples in [1, 4, 16] {
            let mut settings = Settings::new(*width, *height);
            settings.pattern = SamplePattern::standard(samples).unwrap();
            settings.threads = 1;
            group.bench_function(BenchmarkId::new(*name, samples), |b| {
                b.iter(|| render(scene, &settings, &mut Screen, &Control::default()));
            });
        }
    }
    group.finish();
}

criterion_group!(benches, frames);
criterion_main!(benches);
