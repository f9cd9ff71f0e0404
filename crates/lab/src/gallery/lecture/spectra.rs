//! Pictures and their frequencies.

use crate::gallery::ink::{enlarged, finish, grey, joined, part, plane};
use crate::gallery::{Drawn, GalleryError, Picture};
use crate::math::{exp, sin};
use crate::textures;
use scumble_pixel::{Image, WorkingSpace};
use scumble_sheet::{Cell, contact_sheet};
use scumble_signal::{
    Band, Border, Channel, Kernel, Shape, Spectrum, Tiling, Window, band_filter, convolve_separable,
};
use std::f64::consts::TAU;

/// The head of a portrait, in grey, at half its size.
pub(super) fn head(side: usize) -> Result<Image<f64>, GalleryError> {
    let portrait = textures::portrait();
    let colors = portrait.map(|&c| WorkingSpace::Srgb.import8(c));
    let whole = scumble_signal::plane(colors.view(), Channel::Luminance);
    let whole = whole.view().crop(192 - side, 200 - side, 2 * side, 2 * side);
    let kernel = Kernel::mitchell(2.0)?;
    let smooth = convolve_separable(whole, &kernel, &kernel, Border::Mirror);
    Ok(Image::from_fn(side, side, |x, y| smooth.row(2 * y)[2 * x])?)
}

fn spectrum(plane: &Image<f64>, window: Window, reference: Option<f64>, range: f64) -> Picture {
    let spectrum = Spectrum::new(plane.view(), window);
    grey(&spectrum.decibels(reference.unwrap_or_else(|| spectrum.peak()), range))
}

pub(super) fn pairs() -> Drawn {
    const N: usize = 128;
    let wave = |period: f64, x: f64| sin(TAU * x / period);
    let bell = |sx: f64, sy: f64| {
        move |x: f64, y: f64| {
            let (x, y) = ((x - 64.0) / sx, (y - 64.0) / sy);
            exp(-(x * x + y * y))
        }
    };
    let planes = [
        ("constant", Window::None, plane(N, N, |_, _| 0.5)?),
        ("sin 2πx/32", Window::None, plane(N, N, |x, _| 0.5 + 0.5 * wave(32.0, x))?),
        ("sin 2πx/16", Window::None, plane(N, N, |x, _| 0.5 + 0.5 * wave(16.0, x))?),
        ("sin 2πy/16", Window::None, plane(N, N, |_, y| 0.5 + 0.5 * wave(16.0, y))?),
        (
            "their product",
            Window::None,
            plane(N, N, |x, y| 0.5 + 0.5 * wave(32.0, x) * wave(16.0, y))?,
        ),
        ("exp(-r²/16²)", Window::None, plane(N, N, bell(16.0, 16.0))?),
        ("exp(-r²/32²)", Window::None, plane(N, N, bell(32.0, 32.0))?),
        ("exp(-x²/32²-y²/16²)", Window::None, plane(N, N, bell(32.0, 16.0))?),
        ("a picture", Window::Hann, head(N)?),
    ];
    let mut cells = Vec::new();
    for (name, window, plane) in planes {
        let whole = spectrum(&plane, window, None, 60.0);
        // Of all but the picture the middle, where their few points are.
        let shown = match window {
            Window::None => enlarged(&part(&whole, [N / 4, N / 4, N / 2, N / 2]), 2)?,
            Window::Hann => whole,
        };
        let pair = joined(&[grey(&plane), shown], false)?;
        cells.push(Cell::new(pair, [name]));
    }
    finish(contact_sheet(&cells, 3, 1))
}

pub(super) fn bands() -> Drawn {
    let head = head(184)?;
    let peak = Spectrum::new(head.view(), Window::Hann).peak();
    let bands = [
        (Band::LowPass(0.03), "up to 0.03"),
        (Band::BandPass(0.03, 0.08), "0.03 to 0.08"),
        (Band::BandPass(0.08, 0.2), "0.08 to 0.2"),
        (Band::HighPass(0.2), "above 0.2"),
    ];
    let mut cells = Vec::new();
    let pair = |plane: &Image<f64>, lift: f64, gain: f64, words: &str| {
        let shown = plane.map(|v| lift + gain * v);
        let spectrum = spectrum(plane, Window::Hann, Some(peak), 80.0);
        Ok::<_, GalleryError>(Cell::new(joined(&[grey(&shown), spectrum], true)?, [words]))
    };
    for (band, words) in bands {
        let filtered = band_filter(head.view(), band, Shape::Ideal, Tiling::Mirror)?;
        let low = matches!(band, Band::LowPass(_));
        // Small differences are shown twice as large.
        let (lift, gain) = if low { (0.0, 1.0) } else { (0.5, 2.0) };
        let words = if low { words.to_owned() } else { format!("{words}, ×2") };
        cells.push(pair(&filtered, lift, gain, &words)?);
    }
    cells.push(pair(&head, 0.0, 1.0, "all")?);
    finish(contact_sheet(&cells, 5, 1))
}

pub(super) fn boxes() -> Drawn {
    const N: usize = 184;
    let head = head(N)?;
    let kernels = [
        (Kernel::rectangle(3.0)?, "box, 3"),
        (Kernel::rectangle(9.0)?, "box, 9"),
        (Kernel::rectangle(27.0)?, "box, 27"),
        // A box of width w has a variance of (w² − 1)/12.
        (Kernel::gaussian((80.0_f64 / 12.0).sqrt())?, "Gaussian, σ 2.6"),
    ];
    let point = plane(N, N, |x, y| f64::from(u8::from(x == 92.0 && y == 92.0)))?;
    let mut cells = Vec::new();
    for (kernel, words) in kernels {
        let blurred = convolve_separable(head.view(), &kernel, &kernel, Border::Mirror);
        let itself = convolve_separable(point.view(), &kernel, &kernel, Border::Repeat);
        let pair = [grey(&blurred), spectrum(&itself, Window::None, None, 40.0)];
        cells.push(Cell::new(joined(&pair, true)?, [words]));
    }
    finish(contact_sheet(&cells, 4, 1))
}
