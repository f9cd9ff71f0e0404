//! Times whole frames of the workloads: `frames [NAME [SAMPLES [THREADS [RUNS]]]]`.
use scumble::coverage::SamplePattern;
use scumble::{Control, Settings, Sink, render};
use std::convert::Infallible;
use std::time::Instant;

struct Null;
impl Sink for Null {
    type Error = Infallible;
    fn start(&mut self, _: u32, _: u32) -> Result<(), Infallible> {
        Ok(())
    }
    fn rows(&mut self, _: u32, rows: &[[u8; 4]]) -> Result<(), Infallible> {
        std::hint::black_box(rows);
        Ok(())
    }
    fn finish(&mut self) -> Result<(), Infallible> {
        Ok(())
    }
}

fn main() {
    let args: Vec<String> = std::env::args().collect();
    let get = |i: usize, d: usize| args.get(i).and_then(|s| s.parse().ok()).unwrap_or(d);
    let scene = match args.get(1).map(String::as_str) {
        Some("small") => lab::workloads::small(),
        Some("large") => lab::workloads::large(),
        _ => lab::workloads::smooth(),
    };
    let mut settings = Settings::new(lab::workloads::WIDTH, lab::workloads::HEIGHT);
    settings.pattern = SamplePattern::standard(get(2, 1)).unwrap_or_default();
    settings.threads = get(3, 1);
    let mut ms: Vec<f64> = (0..get(4, 20))
        .map(|_| {
            let start = Instant::now();
            let _ = std::hint::black_box(render(&scene, &settings, &mut Null, &Control::default()));
            start.elapsed().as_secs_f64() * 1e3
        })
        .collect();
    ms.sort_by(f64::total_cmp);
    println!("ms {:.3} {:.3} {}", ms[ms.len() / 2], ms[0], ms.len());
}
