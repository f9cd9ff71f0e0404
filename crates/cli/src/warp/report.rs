//! What a run says of itself.

use super::way::Map;
use super::{Done, Job};
use crate::args::choice_name;
use crate::error::Failure;
use crate::report::milliseconds;
use scumble::warp::{Distance, Score, Verification, Warp};
use serde_json::{Value, json};
use std::io::Write;
use std::time::Duration;

/// Everything that a finished run can tell.
pub(super) struct Report<'a> {
    pub(super) job: &'a Job<'a>,
    pub(super) warp: &'a Warp<Map>,
    pub(super) decode: Duration,
    pub(super) done: &'a Done,
}

impl Report<'_> {
    /// Prints the report on standard output, on a line of its own.
    pub(super) fn print(&self) -> Result<(), Failure> {
        say(&self.json().to_string(), false)
    }

    fn json(&self) -> Value {
        let Self { job, warp, done, .. } = self;
        let (width, height) = job.canvas.picture();
        json!({
            "input": job.name,
            "output": job.target.name(),
            "width": width,
            "height": height,
            "canvas": { "width": job.canvas.width, "height": job.canvas.height },
            "quality": job.options.filter.quality,
            "kernel": warp.sampler.kernel.name(),
            "magnify": warp.sampler.magnify.name(),
            "space": choice_name(job.options.filter.space),
            "depth": done.depth.name(),
            "threads": done.threads,
            "decode_ms": milliseconds(self.decode),
            "warp_ms": milliseconds(done.warp),
            "encode_ms": milliseconds(done.encode),
            "warnings": job.picture.origin.notes,
            "verify": done.verification.as_ref().map(verification),
        })
    }
}

fn verification(v: &Verification) -> Value {
    json!({
        "inside": score(&v.inside),
        "edge": score(&v.edge),
        "empty_pixels": v.empty,
        "capped_pixels": v.capped,
    })
}

fn score(score: &Score) -> Value {
    json!({
        "pixels": score.pixels,
        "gaussian": distance(score, &score.gaussian),
        "box": distance(score, &score.square),
    })
}

/// `null` of no pixels; the PSNR of what is the same to the last bit is `null`, too.
fn distance(score: &Score, distance: &Distance) -> Option<Value> {
    let [x, y] = distance.at;
    let psnr = psnr(distance);
    (score.pixels > 0).then(|| {
        json!({
            "psnr_db": psnr.is_finite().then_some(psnr),
            "worst": { "difference": distance.worst, "x": x, "y": y },
        })
    })
}

/// Peak signal to noise ratio in decibels.
fn psnr(distance: &Distance) -> f64 {
    10.0 * (255.0 * 255.0 / distance.mean_square()).log10()
}

/// Says in words how far the result is off, on standard error if the other is the picture's.
pub(super) fn tell(v: &Verification, on_error: bool) -> Result<(), Failure> {
    let mut lines = vec![line("inside the picture", &v.inside), line("at its edge", &v.edge)];
    if v.capped > 0 {
        lines.push(format!(
            "verify: {} pixels see more texels than were counted for their truth",
            v.capped
        ));
    }
    lines.iter().try_for_each(|line| say(line, on_error))
}

fn line(place: &str, score: &Score) -> String {
    if score.pixels == 0 {
        return format!("verify: no pixels {place}");
    }
    let told = |d: &Distance| {
        let [x, y] = d.at;
        let psnr = psnr(d);
        if psnr.is_finite() {
            format!("{psnr:.1} dB, at worst {:.1} of 255 off, at {x},{y}", d.worst)
        } else {
            "no difference".to_owned()
        }
    };
    format!(
        "verify: {} pixels {place}: {} (Gaussian pixel); {} (square pixel)",
        score.pixels,
        told(&score.gaussian),
        told(&score.square)
    )
}

fn say(line: &str, on_error: bool) -> Result<(), Failure> {
    let write = |out: &mut dyn Write| writeln!(out, "{line}").and_then(|()| out.flush());
    let written = if on_error {
        write(&mut std::io::stderr().lock())
    } else {
        write(&mut std::io::stdout().lock())
    };
    written.map_err(|e| Failure::io("standard output", &e))
}
