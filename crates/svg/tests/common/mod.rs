//! What the tests share.
#![allow(dead_code, reason = "each test file uses its own part")]
#![allow(clippy::unwrap_used, clippy::panic, reason = "tests")]

use scumble_scene::Command;
use scumble_svg::{Options, Parsed, ProfileChoice, ResourceError, Resources, SvgError, parse};

/// A scene's folder with one picture, `a.png`: 4 × 2 texels, red and blue by turns.
pub(crate) struct OnePicture;

impl Resources for OnePicture {
    fn load(&self, href: &str) -> Result<Vec<u8>, ResourceError> {
        match href {
            "a.png" => Ok(png(4, 2)),
            "broken.png" => Ok(png(4, 2)[..60].to_vec()),
            "text.png" => Ok(b"this is no picture".to_vec()),
            "../secret.png" => Err(ResourceError::Refused("it is outside".into())),
            _ => Err(ResourceError::NotFound),
        }
    }
}

/// A PNG of this size, red and blue by turns.
pub(crate) fn png(width: u32, height: u32) -> Vec<u8> {
    let mut image = image::RgbaImage::new(width, height);
    for (x, y, pixel) in image.enumerate_pixels_mut() {
        *pixel = image::Rgba(if (x + y) % 2 == 0 { [255, 0, 0, 255] } else { [0, 0, 255, 128] });
    }
    let mut out = std::io::Cursor::new(Vec::new());
    image.write_to(&mut out, image::ImageFormat::Png).unwrap();
    out.into_inner()
}

/// Bytes as a base64 data URI.
pub(crate) fn data_uri(mime: &str, bytes: &[u8]) -> String {
    const DIGITS: &[u8; 64] = b"ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    let mut out = format!("data:{mime};base64,");
    for chunk in bytes.chunks(3) {
        let at = |i: usize| u32::from(chunk.get(i).copied().unwrap_or(0));
        let bits = at(0) << 16 | at(1) << 8 | at(2);
        for k in 0..4 {
            let digit = DIGITS[(bits >> (18 - 6 * k) & 63) as usize];
            out.push(if k <= chunk.len() { char::from(digit) } else { '=' });
        }
    }
    out
}

pub(crate) fn read(profile: ProfileChoice, text: &str) -> Result<Parsed, SvgError> {
    parse(text.as_bytes(), &Options::default().with_profile(profile).with_resources(&OnePicture))
}

/// Reads the inside of a course document of 100 × 50.
#[track_caller]
pub(crate) fn course(inside: &str) -> Parsed {
    read(ProfileChoice::Course, &course_text(inside)).unwrap()
}

pub(crate) fn course_text(inside: &str) -> String {
    format!("<svg width='100' height='50' xmlns:sc='https://scumble.rs/ns/1'>{inside}</svg>")
}

/// Reads the inside of an SVG document of 100 × 50.
#[track_caller]
pub(crate) fn svg(inside: &str) -> Parsed {
    read(ProfileChoice::Svg, &svg_text(inside)).unwrap()
}

pub(crate) fn svg_text(inside: &str) -> String {
    format!(
        "<svg xmlns='http://www.w3.org/2000/svg' xmlns:xlink='http://www.w3.org/1999/xlink' \
         xmlns:sc='https://scumble.rs/ns/1' width='100' height='50'>{inside}</svg>"
    )
}

/// The names of the commands, in order.
pub(crate) fn names(parsed: &Parsed) -> Vec<&'static str> {
    parsed
        .scene
        .commands
        .iter()
        .map(|command| match command {
            Command::PushLayer { .. } => "push",
            Command::PopLayer => "pop",
            Command::Fill(_) => "fill",
            Command::Stroke(_) => "stroke",
            Command::Gouraud(_) => "gouraud",
            Command::Textured(_) => "textured",
            Command::Image(_) => "image",
            Command::Hairline(_) => "hairline",
            Command::Point(_) => "point",
        })
        .collect()
}

/// The warnings as they display.
pub(crate) fn warnings(parsed: &Parsed) -> Vec<String> {
    parsed.warnings.iter().map(ToString::to_string).collect()
}
