//! The weights of the paper's kernels, and of ours.

use crate::gallery::Drawn;
use crate::gallery::ink::{BLUE, GREEN, PURPLE, RED, finish};
use crate::gallery::plot::Plot;
use crate::math::exp;
use scumble::texture::{Kernel, Sampler};
use scumble_geometry::{DVec2, Rect};
use scumble_sheet::{Anchor, Drawing, INK};

/// e^(−2x²), up to where it is cut.
fn gaussian(x: f64, radius: f64) -> f64 {
    if x.abs() > radius { 0.0 } else { exp(-2.0 * x * x) }
}

fn weight(kernel: Kernel, x: f64) -> f64 {
    f64::from(kernel.weight((x * x) as f32))
}

pub(super) fn plot() -> Drawn {
    let mut drawing = Drawing::new(900, 380);
    let frame = Rect::new(60.0, 26.0, 880.0, 340.0);
    let plot = Plot { frame, x: [-2.2, 2.2], y: [-0.12, 1.05] };
    plot.rules(&mut drawing, &[(0.0, "0"), (0.135, "0.135"), (0.5, "0.5"), (1.0, "1")]);
    let ticks = [(-2.0, "-2"), (-1.0, "-1"), (0.0, "0"), (1.0, "1"), (2.0, "2")];
    plot.ticks(&mut drawing, &ticks);
    plot.axes(&mut drawing, "");
    // The radius in σ, and σ is ½.
    let ours = 0.5 * f64::from(Sampler::DEFAULT.radius);
    plot.curve(&mut drawing, PURPLE, 4.0, |x| gaussian(x, ours));
    plot.curve(&mut drawing, GREEN, 2.0, |x| weight(Kernel::Triangle, x));
    plot.curve(&mut drawing, BLUE, 2.0, |x| weight(Kernel::Lanczos2, x));
    plot.curve(&mut drawing, RED, 2.0, |x| gaussian(x, 1.0));
    let entries = [
        (RED, "Gaussian cut at 1"),
        (PURPLE, "Gaussian cut at 1.54"),
        (GREEN, "triangle"),
        (BLUE, "Lanczos 2"),
    ];
    for (index, (color, words)) in entries.into_iter().enumerate() {
        let at = DVec2::new(660.0, 50.0 + 22.0 * index as f64);
        drawing.line([at, at + DVec2::new(26.0, 0.0)], 3.0, color);
        drawing.text(at + DVec2::new(36.0, 5.0), 14.0, Anchor::Start, words, INK);
    }
    finish(drawing)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::gallery::errata::says;

    #[test]
    fn the_variance_is_a_quarter() {
        let at = |k: i32| f64::from(k) * 1e-3;
        let moment = |power: i32| {
            (-5000..=5000).map(at).map(|x| x.powi(power) * gaussian(x, 9.0)).sum::<f64>()
        };
        let variance = moment(2) / moment(0);
        assert!((variance - 0.25).abs() < 1e-9, "{variance}");
        says("variance ¼, σ = ½");
        assert!((gaussian(1.0, 1.0) - 0.135).abs() < 5e-4);
    }
}
