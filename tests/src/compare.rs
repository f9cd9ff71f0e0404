use image::{Rgba, RgbaImage};

/// How two pictures of the same size differ.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Comparison {
    /// Pixels that are not the same in all four channels.
    pub count: usize,
    /// The largest difference of a channel, in levels of 255.
    pub max_difference: u8,
    /// The first pixel that differs, row by row from the top left.
    pub first: Option<(u32, u32)>,
}

/// Compares two pictures pixel by pixel; `None` if their sizes differ. What is wholly transparent
/// is compared like everything else: the bytes are promised, not only the look.
#[must_use]
pub fn compare(expected: &RgbaImage, actual: &RgbaImage) -> Option<Comparison> {
    if expected.dimensions() != actual.dimensions() {
        return None;
    }
    let mut result = Comparison::default();
    for ((x, y, a), b) in expected.enumerate_pixels().zip(actual.pixels()) {
        let difference = largest(*a, *b);
        if difference > 0 {
            result.count += 1;
            result.max_difference = result.max_difference.max(difference);
            result.first = result.first.or(Some((x, y)));
        }
    }
    Some(result)
}

fn largest(a: Rgba<u8>, b: Rgba<u8>) -> u8 {
    a.0.iter().zip(b.0).map(|(a, b)| a.abs_diff(b)).max().unwrap_or(0)
}

/// Expected, difference and actual, side by side with a gap. The difference is scaled so that the
/// largest of the picture is white; pictures of different sizes have none.
#[must_use]
pub fn triptych(expected: &RgbaImage, actual: &RgbaImage) -> RgbaImage {
    const GAP: u32 = 8;
    const MAT: Rgba<u8> = Rgba([96, 96, 96, 255]);
    let width = expected.width().max(actual.width());
    let height = expected.height().max(actual.height());
    let mut out = RgbaImage::from_pixel(3 * width + 2 * GAP, height, MAT);
    place(&mut out, expected, 0);
    if let Some(comparison) = compare(expected, actual) {
        place(&mut out, &difference(expected, actual, comparison.max_difference), width + GAP);
    }
    place(&mut out, actual, 2 * (width + GAP));
    out
}

fn place(out: &mut RgbaImage, picture: &RgbaImage, left: u32) {
    for (x, y, pixel) in picture.enumerate_pixels() {
        out.put_pixel(left + x, y, *pixel);
    }
}

fn difference(expected: &RgbaImage, actual: &RgbaImage, max: u8) -> RgbaImage {
    let gain = 255 / u32::from(max.max(1));
    RgbaImage::from_fn(expected.width(), expected.height(), |x, y| {
        let (a, b) = (*expected.get_pixel(x, y), *actual.get_pixel(x, y));
        let level = |i: usize| (u32::from(a.0[i].abs_diff(b.0[i])) * gain).min(255) as u8;
        // A difference of alpha alone shows as grey.
        let alpha = level(3);
        Rgba([level(0).max(alpha), level(1).max(alpha), level(2).max(alpha), 255])
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn grey() -> RgbaImage {
        RgbaImage::from_pixel(5, 4, Rgba([100, 100, 100, 255]))
    }

    #[test]
    fn equal_pictures_are_equal() {
        assert_eq!(compare(&grey(), &grey()), Some(Comparison::default()));
    }

    #[test]
    fn one_level_in_one_channel_of_one_pixel_is_seen() {
        for channel in 0..4 {
            let mut other = grey();
            other.get_pixel_mut(3, 2).0[channel] -= 1;
            let found = compare(&grey(), &other).unwrap();
            let expected = Comparison { count: 1, max_difference: 1, first: Some((3, 2)) };
            assert_eq!(found, expected);
            // In the middle panel it is white (or a pure primary), and alone.
            let picture = triptych(&grey(), &other);
            let middle = |x: u32, y: u32| picture.get_pixel(5 + 8 + x, y).0;
            assert_eq!(middle(3, 2)[channel.min(2)], 255);
            assert_eq!(middle(2, 2), [0, 0, 0, 255]);
        }
    }

    #[test]
    fn another_size_is_no_comparison_but_still_a_picture() {
        let small = RgbaImage::new(2, 2);
        assert_eq!(compare(&grey(), &small), None);
        assert_eq!(triptych(&grey(), &small).dimensions(), (3 * 5 + 16, 4));
    }
}
