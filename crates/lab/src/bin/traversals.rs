//! The ways of finding covered samples, side by side: whole frames of the map at 1, 4, 9 and 16
//! samples on one thread and on two, as a table in Markdown, in milliseconds.
//!
//! Every cell is the median over the rounds of the medians of its runs; in a round all cells come
//! once, so that a neighbour's load falls on all of them alike. `traversals [ROUNDS [PNG]]`.

use lab::map::{Canvas, HEIGHT, Map, WIDTH};
use lab::{driver, timing};
use scumble::coverage::{Order, SamplePattern, Traversal};
use scumble::scene::Scene;
use scumble::texture::{LevelMode, PixelFilter, Sampler};
use scumble::{ImageSink, Settings};
use std::convert::Infallible;
use std::error::Error;
use std::process::ExitCode;

const SAMPLES: [usize; 4] = [1, 4, 9, 16];
const THREADS: [usize; 2] = [1, 2];
/// Frames of a run.
const FRAMES: usize = 15;

/// One row of the table.
enum Way {
    Traversal(Map, Traversal),
    Driver(Scene, Sampler),
}

fn main() -> ExitCode {
    match run() {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("error: {error}");
            ExitCode::FAILURE
        }
    }
}

fn run() -> Result<(), Box<dyn Error>> {
    let mut args = std::env::args().skip(1);
    let rounds: usize = match args.next() {
        Some(word) => word.parse().map_err(|_| format!("{word:?} is no number of rounds"))?,
        None => 3,
    };
    let map = Map::new();
    let ways = ways(&map);
    let cells = ways.len() * THREADS.len() * SAMPLES.len();
    let mut times = vec![Vec::new(); cells];
    let mut canvas = Canvas::new();
    for _ in 0..rounds.max(1) {
        for (cell, times) in times.iter_mut().enumerate() {
            let (row, samples) = (cell / SAMPLES.len(), SAMPLES[cell % SAMPLES.len()]);
            let (way, threads) = (&ways[row / THREADS.len()].1, THREADS[row % THREADS.len()]);
            times.push(measure(way, samples, threads, &mut canvas)?);
        }
    }
    println!("| | threads | 1 sample | 4 | 9 | 16 |\n|---|---|---|---|---|---|");
    for (row, times) in times.chunks_mut(SAMPLES.len()).enumerate() {
        let (name, threads) = (ways[row / THREADS.len()].0, THREADS[row % THREADS.len()]);
        let medians: Vec<String> = times.iter_mut().map(|t| format!("{:.2}", median(t))).collect();
        println!("| {name} | {threads} | {} |", medians.join(" | "));
    }
    if let Some(path) = args.next() {
        map.draw(Traversal::Tiled, &SamplePattern::grid(16)?, 1, &mut canvas);
        let bytes = canvas.pixels().as_flattened();
        image::save_buffer(&path, bytes, WIDTH, HEIGHT, image::ColorType::Rgba8)?;
    }
    Ok(())
}

fn ways(map: &Map) -> Vec<(&'static str, Way)> {
    let nearest = Sampler::DEFAULT.with(PixelFilter::Nearest, LevelMode::Zero);
    let trilinear = Sampler::DEFAULT.with(PixelFilter::Bilinear, LevelMode::Linear);
    let by = |traversal| Way::Traversal(map.clone(), traversal);
    vec![
        ("nothing: clear and resolve", Way::Traversal(Map::blank(), Traversal::Tiled)),
        ("bounding box", by(Traversal::BoundingBox)),
        ("incremental, row by row", by(Traversal::Incremental(Order::RowMajor))),
        ("incremental, zig-zag", by(Traversal::Incremental(Order::ZigZag))),
        ("scanline", by(Traversal::Scanline)),
        ("tiled", by(Traversal::Tiled)),
        ("the driver, flat", Way::Driver(map.scene(false), nearest)),
        ("the driver, nearest texel", Way::Driver(map.scene(true), nearest)),
        ("the driver, trilinear", Way::Driver(map.scene(true), trilinear)),
        ("the driver, EWA", Way::Driver(map.scene(true), Sampler::DEFAULT)),
    ]
}

/// The median frame of one run.
fn measure(
    way: &Way,
    samples: usize,
    threads: usize,
    canvas: &mut Canvas,
) -> Result<f64, Box<dyn Error>> {
    let pattern = SamplePattern::grid(samples)?;
    match way {
        Way::Traversal(map, traversal) => {
            let [times] = timing::frames(FRAMES, || {
                let time = timing::clock(|| {
                    map.draw(*traversal, &pattern, threads, canvas);
                    Ok::<_, Infallible>(())
                })?;
                Ok::<_, Infallible>([time])
            })?;
            Ok(times.median)
        }
        Way::Driver(scene, sampler) => {
            let mut settings = Settings::new(WIDTH, HEIGHT);
            (settings.pattern, settings.sampler, settings.threads) = (pattern, *sampler, threads);
            let times = driver::measure(scene, &settings, FRAMES, &mut ImageSink::new())?;
            Ok(times.drawing.median)
        }
    }
}

fn median(times: &mut [f64]) -> f64 {
    times.sort_by(f64::total_cmp);
    times[times.len() / 2]
}
