//! How two pictures of one size differ.

use crate::picture::{Picture, Pixels, Tone};
use crate::progress::Steps;
use serde_json::{Value, json};
use std::fmt;

/// The scale of what is reported: white is 255, whatever the depth.
const WHITE: f64 = 255.0;

/// Differences are compared and reported in steps of this part of 255: a float's last bits would make
/// two codes that are 69 apart differ by a little more.
const STEP: f64 = 1.0 / 65_536.0;

/// Two pictures as they are seen, and as they are compared.
#[derive(Debug)]
pub(super) struct Seen<'a> {
    pub(super) pictures: [&'a Picture; 2],
    /// Whether both are turned into sRGB, because their numbers mean different things.
    convert: bool,
}

impl<'a> Seen<'a> {
    /// Two pictures of one size.
    pub(super) fn pair(a: &'a Picture, b: &'a Picture) -> Self {
        Self { pictures: [a, b], convert: a.tone != b.tone }
    }

    /// Pixel `i` of picture `which`: red, green and blue multiplied by alpha, and alpha, white being 1.
    pub(super) fn pixel(&self, which: usize, i: usize) -> [f32; 4] {
        let picture = self.pictures[which];
        let n = picture.channels.count();
        let at = |c: usize| picture.pixels.at(i * n + c);
        let gray = picture.channels.is_gray();
        let alpha = if picture.channels.has_alpha() { at(n - 1) } else { 1.0 };
        let color = if gray { [at(0); 3] } else { [at(0), at(1), at(2)] };
        let divisor = if picture.premultiplied && alpha > 0.0 { alpha } else { 1.0 };
        // Light that comes without alpha stays as it is.
        let factor = if picture.premultiplied && alpha <= 0.0 { 1.0 } else { alpha };
        let mut out = [alpha; 4];
        for (channel, (out, v)) in out.iter_mut().zip(color).enumerate() {
            let v = v / divisor;
            *out = if self.convert {
                Tone::Srgb.encode(channel, picture.tone.decode(channel, v))
            } else {
                v
            } * factor;
        }
        out
    }

    /// The largest difference of any channel in pixel `i`, of 255, and the weighted sum of the squares.
    /// What is no number differs from all that is, by everything.
    fn difference(&self, i: usize, weights: [f64; 4]) -> (f64, f64) {
        let (mut most, mut squares) = (0.0_f64, 0.0);
        let pixels = self.pixel(0, i).into_iter().zip(self.pixel(1, i));
        for ((a, b), weight) in pixels.zip(weights) {
            let d = WHITE * (f64::from(a) - f64::from(b)).abs();
            let same = a == b || (a.is_nan() && b.is_nan());
            let d = if same {
                0.0
            } else if d.is_nan() {
                f64::INFINITY
            } else {
                d
            };
            most = most.max(d);
            squares += if d > 0.0 { weight * d * d } else { 0.0 };
        }
        (most, squares)
    }

    /// Whether the numbers of a row are the same, and mean the same; most rows of most pairs.
    fn has_equal_rows(&self, y: usize) -> bool {
        let [a, b] = self.pictures;
        let n = a.channels.count() * a.width as usize;
        let row = y * n..(y + 1) * n;
        let alike = !self.convert
            && a.channels == b.channels
            && (a.premultiplied == b.premultiplied || !a.channels.has_alpha());
        alike
            && match (&a.pixels, &b.pixels) {
                (Pixels::U8(a), Pixels::U8(b)) => a[row.clone()] == b[row],
                (Pixels::U16(a), Pixels::U16(b)) => a[row.clone()] == b[row],
                (Pixels::F32(a), Pixels::F32(b)) => a[row.clone()] == b[row],
                _ => false,
            }
    }

    pub(super) fn width(&self) -> usize {
        self.pictures[0].width as usize
    }

    pub(super) fn height(&self) -> usize {
        self.pictures[0].height as usize
    }

    /// Whether both are turned into sRGB.
    pub(super) fn is_converted(&self) -> bool {
        self.convert
    }

    /// How much each channel counts: three equal ones of greys as one, alpha if there is any.
    fn weights(&self) -> [f64; 4] {
        let any = |f: fn(&Picture) -> bool| self.pictures.iter().any(|p| f(p));
        let color = if any(|p| !p.channels.is_gray()) { 1.0 } else { 1.0 / 3.0 };
        let alpha = if any(|p| p.channels.has_alpha()) { 1.0 } else { 0.0 };
        [color, color, color, alpha]
    }
}

/// What a comparison found.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Comparison {
    pub(super) width: usize,
    pub(super) height: usize,
    pub(super) tolerance: f64,
    /// Pixels that differ at all, and by more than the tolerance.
    pub(super) differing: usize,
    pub(super) beyond: usize,
    /// The largest difference of a channel, of 255, and the first pixel that has it.
    pub(super) largest: f64,
    pub(super) at: (usize, usize),
    /// Peak signal-to-noise ratio in decibels; infinite for equal pictures.
    pub(super) psnr: f64,
}

impl Comparison {
    /// Compares all pixels; a row is a step.
    pub(super) fn new(seen: &Seen<'_>, tolerance: f64, steps: &Steps) -> Self {
        let (width, height) = (seen.width(), seen.height());
        let mut found = Self {
            width,
            height,
            tolerance,
            differing: 0,
            beyond: 0,
            largest: 0.0,
            at: (0, 0),
            psnr: f64::INFINITY,
        };
        let weights = seen.weights();
        let mut sum = 0.0;
        for y in 0..height {
            // By rows, so that small squares are not lost in a large sum.
            let mut row = 0.0;
            let columns = if seen.has_equal_rows(y) { 0 } else { width };
            for x in 0..columns {
                let (most, squares) = seen.difference(y * width + x, weights);
                found.differing += usize::from(most > 0.0);
                let most = (most / STEP).round() * STEP;
                found.beyond += usize::from(most > tolerance);
                if most > found.largest {
                    (found.largest, found.at) = (most, (x, y));
                }
                row += squares;
            }
            sum += row;
            steps.add(1);
        }
        let numbers = weights.iter().sum::<f64>() * width as f64 * height as f64;
        let mean = sum / numbers;
        if mean > 0.0 {
            found.psnr = 10.0 * libm::log10(WHITE * WHITE / mean);
        }
        found
    }

    /// The report for programs; what is infinite is null.
    pub(super) fn json(&self, names: &[String; 2]) -> Value {
        let finite = |v: f64| v.is_finite().then_some(v);
        json!({
            "a": names[0],
            "b": names[1],
            "same": self.beyond == 0,
            "why": (self.beyond > 0).then_some("pixels"),
            "width": self.width,
            "height": self.height,
            "tolerance": self.tolerance,
            "psnr_db": finite(self.psnr),
            "max": finite(self.largest),
            "max_at": (self.differing > 0).then(|| json!({ "x": self.at.0, "y": self.at.1 })),
            "differing": self.differing,
            "beyond": self.beyond,
        })
    }
}

impl fmt::Display for Comparison {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if self.differing == 0 {
            return f.write_str("the pictures are equal");
        }
        let Self { largest, at: (x, y), differing, beyond, tolerance, psnr, .. } = self;
        let all = self.width * self.height;
        let share = 100.0 * *differing as f64 / all as f64;
        write!(
            f,
            "PSNR {psnr:.2} dB · largest difference {} of 255 at ({x}, {y}) · {differing} of {all} \
             pixels differ ({share:.2} %)",
            trimmed(*largest)
        )?;
        if *tolerance > 0.0 {
            write!(f, ", {beyond} by more than {tolerance}")?;
        }
        Ok(())
    }
}

/// A number with three decimals at most.
fn trimmed(value: f64) -> String {
    let text = format!("{value:.3}");
    text.trim_end_matches('0').trim_end_matches('.').to_owned()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::picture::{Channels, Depth, Format, Origin};

    fn picture(width: u32, channels: Channels, pixels: Pixels) -> Picture {
        let (format, depth) = (Format::Png, Depth::Eight);
        let origin = Origin { format, depth, orientation: 1, notes: Vec::new() };
        let height = pixels.len() as u32 / channels.count() as u32 / width;
        let (premultiplied, tone, icc) = (false, Tone::Srgb, None);
        Picture { width, height, channels, pixels, premultiplied, tone, icc, origin }
    }

    fn compared(a: &Picture, b: &Picture, tolerance: f64) -> Comparison {
        Comparison::new(&Seen::pair(a, b), tolerance, &Steps::new(true, 0))
    }

    #[test]
    fn steps_of_codes_are_whole_and_bounds_are_exact() {
        for step in [1_u8, 3, 69, 254] {
            let a = picture(3, Channels::Gray, Pixels::U8(vec![0, 0, 1, 9, 1, 2]));
            let b = picture(3, Channels::Gray, Pixels::U8(vec![0, 0, 1, 9, 1 + step, 2]));
            let found = compared(&a, &b, f64::from(step));
            assert_eq!((found.largest, found.at), (f64::from(step), (1, 1)));
            assert_eq!((found.differing, found.beyond), (1, 0));
            assert_eq!(compared(&a, &b, f64::from(step) - 0.01).beyond, 1);
        }
    }

    #[test]
    fn noise_of_one_code_is_48_decibels() {
        let a = picture(2, Channels::Rgb, Pixels::U8(vec![10; 12]));
        let b = picture(2, Channels::Rgb, Pixels::U8(vec![11; 12]));
        let found = compared(&a, &b, 0.0);
        assert!((found.psnr - 20.0 * 255.0_f64.log10()).abs() < 1e-4, "{}", found.psnr);
        // Greys are as many numbers as they are, whatever they are compared with.
        let c = picture(2, Channels::Gray, Pixels::U8(vec![11; 4]));
        assert!((compared(&a, &c, 0.0).psnr - found.psnr).abs() < 1e-9);
        assert_eq!(compared(&b, &c, 0.0).psnr, f64::INFINITY);
    }

    #[test]
    fn colours_that_nobody_sees_do_not_differ() {
        let a = picture(1, Channels::Rgba, Pixels::U8(vec![1, 2, 3, 0]));
        let b = picture(1, Channels::Rgba, Pixels::U8(vec![200, 100, 0, 0]));
        assert_eq!(compared(&a, &b, 0.0).differing, 0);
        let c = picture(1, Channels::Rgba, Pixels::U8(vec![0, 0, 0, 255]));
        assert_eq!(compared(&a, &c, 0.0).largest, 255.0);
    }

    #[test]
    fn what_is_no_number_differs_from_what_is() {
        let a = picture(1, Channels::Gray, Pixels::F32(vec![f32::NAN, 1.0]));
        let b = picture(1, Channels::Gray, Pixels::F32(vec![1.0, 1.0]));
        assert_eq!((compared(&a, &b, 1e9).beyond, compared(&a, &a, 0.0).differing), (1, 0));
    }
}
