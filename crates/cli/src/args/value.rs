//! Options that are numbers or colours: how they are read.
//!
//! Every reader takes the text of one argument and returns a sentence on what is wrong with it,
//! to which the parser adds which argument it was.

use clap::builder::{PossibleValuesParser, TypedValueParser};
use scumble::texture::{Kernel, Magnify, Sampler};
use std::num::ParseIntError;
use std::str::FromStr;

/// What to put under the scene.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Background {
    /// Nothing.
    Transparent,
    /// Red, green, blue and straight alpha, sRGB-encoded, in 0…1.
    Color([f32; 4]),
}

/// A part of the canvas, in pixels; `width` and `height` are at least 1.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Crop {
    pub(crate) x: u32,
    pub(crate) y: u32,
    pub(crate) width: u32,
    pub(crate) height: u32,
}

/// Numbers of samples that have a pattern.
const SAMPLE_COUNTS: [u32; 10] = [1, 2, 4, 8, 9, 16, 25, 36, 49, 64];

/// More threads than any machine has cores; a larger number is a slip of the finger.
const MAX_THREADS: usize = 4096;

/// The largest zoom: from one pixel to the longest side that a PNG can have.
const MAX_ZOOM: f64 = 2_147_483_647.0;

/// The name of one of the filters' presets.
pub(super) fn preset() -> impl TypedValueParser<Value = &'static str> {
    let names = Sampler::PRESETS.map(|(name, _)| name);
    PossibleValuesParser::new(names).try_map(move |word| {
        names.into_iter().find(|name| *name == word).ok_or("no preset of this name")
    })
}

/// The name of a kernel.
pub(super) fn kernel() -> impl TypedValueParser<Value = Kernel> {
    PossibleValuesParser::new(Kernel::ALL.map(Kernel::name)).try_map(|word| word.parse::<Kernel>())
}

/// The name of a way to magnify.
pub(super) fn magnify() -> impl TypedValueParser<Value = Magnify> {
    let names = Magnify::ALL.map(Magnify::name);
    PossibleValuesParser::new(names).try_map(|word| word.parse::<Magnify>())
}

/// A side of a picture in pixels, at least 1.
pub(super) fn length(text: &str) -> Result<u32, String> {
    match text.parse::<u32>() {
        Ok(0) => Err("a picture has at least one pixel".to_owned()),
        Ok(n) if n <= i32::MAX as u32 => Ok(n),
        Ok(_) => Err(format!("the longest side is {} pixels", i32::MAX)),
        Err(e) => Err(whole_number(&e)),
    }
}

/// A positive finite factor.
pub(super) fn zoom(text: &str) -> Result<f64, String> {
    let value: f64 = text.parse().map_err(|_| "not a number".to_owned())?;
    if value > 0.0 && value <= MAX_ZOOM {
        Ok(value)
    } else {
        Err("not a positive factor".to_owned())
    }
}

/// A ratio of axes that a sampler takes.
pub(super) fn ratio(text: &str) -> Result<f32, String> {
    let value: f32 = text.parse().map_err(|_| "not a number".to_owned())?;
    if (1.0..=1024.0).contains(&value) { Ok(value) } else { Err("not in 1…1024".to_owned()) }
}

/// A number of samples that has a pattern.
pub(super) fn samples(text: &str) -> Result<u32, String> {
    let value: u32 = text.parse().map_err(|e| whole_number(&e))?;
    if SAMPLE_COUNTS.contains(&value) {
        Ok(value)
    } else {
        Err("not one of 1, 2, 4, 8, 9, 16, 25, 36, 49, 64".to_owned())
    }
}

/// A difference that counts as none, of 255.
pub(super) fn tolerance(text: &str) -> Result<f64, String> {
    let value: f64 = text.parse().map_err(|_| "not a number".to_owned())?;
    if (0.0..f64::INFINITY).contains(&value) { Ok(value) } else { Err("not 0 or more".to_owned()) }
}

/// A threshold of alpha.
pub(super) fn threshold(text: &str) -> Result<f32, String> {
    let value: f32 = text.parse().map_err(|_| "not a number".to_owned())?;
    if value > 0.0 && value <= 1.0 { Ok(value) } else { Err("not above 0 and up to 1".to_owned()) }
}

/// A number of levels.
pub(super) fn levels(text: &str) -> Result<usize, String> {
    match text.parse::<usize>() {
        Ok(0) => Err("a picture has at least one level".to_owned()),
        Ok(n) => Ok(n),
        Err(e) => Err(whole_number(&e)),
    }
}

/// A number of threads, 0 for all.
pub(super) fn threads(text: &str) -> Result<usize, String> {
    let value: usize = text.parse().map_err(|e| whole_number(&e))?;
    if value <= MAX_THREADS { Ok(value) } else { Err(format!("at most {MAX_THREADS}")) }
}

/// `x,y,w,h` in pixels.
pub(super) fn crop(text: &str) -> Result<Crop, String> {
    let parts: Vec<&str> = text.split(',').map(str::trim).collect();
    let &[x, y, width, height] = parts.as_slice() else {
        return Err("not four numbers x,y,w,h".to_owned());
    };
    let offset = |s: &str| s.parse::<u32>().map_err(|e| format!("`{s}`: {}", whole_number(&e)));
    let side = |s: &str| length(s).map_err(|e| format!("`{s}`: {e}"));
    Ok(Crop { x: offset(x)?, y: offset(y)?, width: side(width)?, height: side(height)? })
}

/// A CSS colour, `none` or `transparent`.
pub(super) fn background(text: &str) -> Result<Background, String> {
    let text = text.trim();
    if text.eq_ignore_ascii_case("none") || text.eq_ignore_ascii_case("transparent") {
        return Ok(Background::Transparent);
    }
    let color = svgtypes::Color::from_str(text)
        .map_err(|_| "not a CSS colour (such as `white`, `#08f`) and not `none`".to_owned())?;
    let bytes = [color.red, color.green, color.blue, color.alpha];
    Ok(Background::Color(bytes.map(|v| f32::from(v) / 255.0)))
}

/// Bytes: a number with K, M, G or T for powers of 1024, `B` and `iB` allowed after it.
pub(super) fn bytes(text: &str) -> Result<u64, String> {
    let short = text.strip_suffix(['b', 'B']).unwrap_or(text);
    let short = short.strip_suffix(['i', 'I']).unwrap_or(short);
    scaled(short, 1024)
}

/// A number with K, M, G or T for powers of 1000.
pub(super) fn count(text: &str) -> Result<u64, String> {
    scaled(text, 1000)
}

/// A positive number, decimals allowed before a suffix, times the suffix's power of `base`.
fn scaled(text: &str, base: u64) -> Result<u64, String> {
    let power = match text.chars().last().map(|c| c.to_ascii_uppercase()) {
        Some('K') => 1,
        Some('M') => 2,
        Some('G') => 3,
        Some('T') => 4,
        _ => 0,
    };
    let unit = base.pow(power);
    let digits = if power == 0 { text } else { &text[..text.len() - 1] };
    let value = match digits.parse::<u64>() {
        Ok(n) => n.checked_mul(unit).ok_or("too large")?,
        Err(_) => fraction(digits, unit)?,
    };
    if value == 0 { Err("must be more than 0".to_owned()) } else { Ok(value) }
}

/// A decimal fraction such as `1.5` times `unit`, in whole numbers, rounded down.
fn fraction(digits: &str, unit: u64) -> Result<u64, String> {
    let wrong = || "not a number such as 4096, 512M or 1.5G".to_owned();
    let (whole, part) = digits.split_once('.').ok_or_else(wrong)?;
    // So few digits that nothing below overflows.
    let plain = |s: &str, most: usize| {
        (1..=most).contains(&s.len()) && s.bytes().all(|b| b.is_ascii_digit())
    };
    if !plain(whole, 12) || !plain(part, 9) {
        return Err(wrong());
    }
    let number = |s: &str| s.parse::<u128>().map_err(|_| wrong());
    let ten = 10_u128.pow(part.len() as u32);
    let total = (number(whole)? * ten + number(part)?) * u128::from(unit) / ten;
    u64::try_from(total).map_err(|_| "too large".to_owned())
}

/// What is wrong with a whole number, in a word.
fn whole_number(error: &ParseIntError) -> String {
    use std::num::IntErrorKind::{NegOverflow, PosOverflow};
    match error.kind() {
        PosOverflow | NegOverflow => "too large".to_owned(),
        _ => "not a whole number of 0 or more".to_owned(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bytes_are_powers_of_1024_and_counts_of_1000() {
        assert_eq!(bytes("4096"), Ok(4096));
        assert_eq!(bytes("512M"), Ok(512 << 20));
        assert_eq!(bytes("2g"), Ok(2 << 30));
        assert_eq!(bytes("2GiB"), Ok(2 << 30));
        assert_eq!(bytes("64KB"), Ok(64 << 10));
        assert_eq!(bytes("1.5K"), Ok(1536));
        assert_eq!(count("1.5K"), Ok(1500));
        assert_eq!(count("1G"), Ok(1_000_000_000));
    }

    #[test]
    fn sizes_that_make_no_sense_are_refused() {
        for text in
            ["", "0", "-1", "M", "1.5.5M", "1e9", "1,5M", "99999999999999999999", "1 M", "½"]
        {
            assert!(bytes(text).is_err(), "{text:?}");
            assert!(count(text).is_err(), "{text:?}");
        }
        assert_eq!(bytes("18446744073709551615K"), Err("too large".to_owned()));
        assert_eq!(count("999999999.9T"), Err("too large".to_owned()));
    }

    proptest::proptest! {
        #[test]
        fn whole_numbers_of_units_are_exact(n in 1_u64..1 << 30, part in 0_u64..1000) {
            assert_eq!(bytes(&format!("{n}M")), Ok(n << 20));
            assert_eq!(count(&format!("{n}.{part:03}K")), Ok(n * 1000 + part));
        }

        #[test]
        fn any_text_is_read_or_refused(text in "[-+0-9.,eKMGiB%# ½a-z]{0,24}") {
            let _ = (bytes(&text), count(&text), crop(&text), background(&text));
            let _ = (zoom(&text), ratio(&text), samples(&text), threads(&text), length(&text));
        }
    }

    #[test]
    fn a_crop_is_four_whole_numbers_with_a_size() {
        assert_eq!(crop("1, 2,3,4"), Ok(Crop { x: 1, y: 2, width: 3, height: 4 }));
        for text in ["", "1,2,3", "1,2,3,4,5", "1,2,0,4", "1,2,3,0", "-1,2,3,4", "a,b,c,d"] {
            assert!(crop(text).is_err(), "{text:?}");
        }
        assert!(crop("0,0,4294967296,1").is_err_and(|e| e.contains("too large")));
    }

    #[test]
    fn a_background_is_a_css_colour_or_none() {
        assert_eq!(background("none"), Ok(Background::Transparent));
        assert_eq!(background("white"), Ok(Background::Color([1.0; 4])));
        assert_eq!(background("#f00"), Ok(Background::Color([1.0, 0.0, 0.0, 1.0])));
        assert_eq!(background("#0000ff"), Ok(Background::Color([0.0, 0.0, 1.0, 1.0])));
        assert!(background("beige-ish").is_err());
        assert!(background("#ff").is_err());
        assert!(background("").is_err());
    }

    #[test]
    fn factors_are_positive_and_finite() {
        assert_eq!(zoom("0.5"), Ok(0.5));
        for text in ["0", "-1", "nan", "inf", "1e300", "x"] {
            assert!(zoom(text).is_err(), "{text:?}");
        }
        assert_eq!(ratio("1"), Ok(1.0));
        for text in ["0.99", "nan", "inf", "1e60", "x"] {
            assert!(ratio(text).is_err(), "{text:?}");
        }
    }

    #[test]
    fn counts_are_checked() {
        assert_eq!(samples("9"), Ok(9));
        assert!(samples("3").is_err());
        assert_eq!(threads("0"), Ok(0));
        assert!(threads("5000").is_err());
        assert_eq!(length("1"), Ok(1));
        assert!(length("0").is_err());
        assert!(length("2147483648").is_err());
    }
}
