//! The face: each character as the strokes of a pen.

use scumble_geometry::{DVec2, Path};

/// Units of the glyphs to one of the text's size.
const EM: f64 = 20.0;
/// The baseline below a line's capitals, in units: their height.
pub(crate) const CAPITALS: f64 = 14.0;
/// Units between two characters.
const SPACING: f64 = 3.4;

/// The pen's width for a size of text.
pub(crate) fn pen(size: f64) -> f64 {
    // Thin enough for large letters, never so thin that small ones turn grey.
    (size * 0.082).max(1.1)
}

/// The width of a line of text in pixels, from the first stroke to the last.
#[must_use]
pub fn text_width(text: &str, size: f64) -> f64 {
    let advances: f64 = text.chars().map(|c| glyph(c).0 + SPACING).sum();
    (advances - SPACING).max(0.0) * size / EM
}

/// The strokes of a line of text whose baseline starts at a point.
pub(crate) fn strokes(text: &str, size: f64, at: DVec2) -> Path {
    let scale = size / EM;
    let mut path = Path::default();
    let mut x = 0.0;
    for c in text.chars() {
        let (width, marks) = glyph(c);
        let place = |gx: f64, gy: f64| at + DVec2::new(x + gx, gy - CAPITALS) * scale;
        draw(marks, place, &mut path);
        x += width + SPACING;
    }
    path
}

/// Adds strokes to a path. The marks are `M` (go to), `L` (line to) and `Q` (parabola by way of a
/// point to a point), each before its numbers.
fn draw(marks: &str, place: impl Fn(f64, f64) -> DVec2, path: &mut Path) {
    let mut rest = marks;
    while let Some(verb) = rest.chars().next() {
        rest = &rest[1..];
        let end = rest.find(['M', 'L', 'Q']).unwrap_or(rest.len());
        let numbers = rest[..end].split(' ').filter_map(|n| n.parse::<f64>().ok());
        let numbers: Vec<f64> = numbers.collect();
        rest = &rest[end..];
        match (verb, numbers.as_slice()) {
            ('M', [x, y]) => path.move_to(place(*x, *y)),
            ('L', [x, y]) => path.line_to(place(*x, *y)),
            ('Q', [cx, cy, x, y]) => path.quad_to(place(*cx, *cy), place(*x, *y)),
            _ => path,
        };
    }
}

/// The width of a character and its strokes.
fn glyph(c: char) -> (f64, &'static str) {
    let known = GLYPHS.iter().find(|glyph| glyph.0 == c);
    known.map_or(UNKNOWN, |&(_, width, marks)| (width, marks))
}

/// What stands for a character that is not in the table: an empty box.
const UNKNOWN: (f64, &str) = (7.0, "M0 0L7 0L7 14L0 14L0 0");

/// Characters with their widths and strokes, in units: capitals from 0 down to 14, small letters from
/// 4, and 18.5 below the line.
#[rustfmt::skip]
const GLYPHS: [(char, f64, &str); 100] = [
    (' ', 5.0, ""),
    ('!', 1.0, "M0.5 0L0.5 9.5M0.5 13.6L0.5 14"),
    ('"', 4.0, "M0.5 0L0.5 4M3.5 0L3.5 4"),
    ('#', 10.0, "M3.5 1L2 13M8.5 1L7 13M0.5 5L10 5M0 9L9.5 9"),
    ('$', 8.0, "M8 3.5Q7 1.5 4 1.5Q0.3 1.5 0.3 4.4Q0.3 6.5 4 7Q8 7.6 8 10Q8 12.8 4 12.8Q1 12.8 0 10.6M4 -0.8L4 15"),
    ('%', 11.0, "M10 0L1 14M2.5 0Q5 0 5 3Q5 6 2.5 6Q0 6 0 3Q0 0 2.5 0M8.5 8Q11 8 11 11Q11 14 8.5 14Q6 14 6 11Q6 8 8.5 8"),
    ('&', 10.0, "M10 14L2.5 4.6Q1.6 3.2 1.6 2.4Q1.6 0 4 0Q6.5 0 6.5 2.4Q6.5 4.4 3.5 6.2Q0 8.2 0 10.6Q0 14 3.8 14Q8.4 14 9.6 7.5"),
    ('\'', 1.0, "M0.5 0L0.5 4"),
    ('(', 3.5, "M3.5 -1Q0 2.5 0 7.4Q0 12.4 3.5 16"),
    (')', 3.5, "M0 -1Q3.5 2.5 3.5 7.4Q3.5 12.4 0 16"),
    ('*', 6.0, "M3 0.5L3 6.5M0.4 2L5.6 5M5.6 2L0.4 5"),
    ('+', 9.0, "M4.5 4L4.5 13M0 8.5L9 8.5"),
    (',', 2.0, "M1.5 13.4L1.5 14L0.3 16.5"),
    ('-', 6.0, "M0 8.5L6 8.5"),
    ('.', 1.0, "M0.5 13.6L0.5 14"),
    ('/', 7.0, "M7 -1L0 15.5"),
    ('0', 8.0, "M4 0Q8 0 8 7Q8 14 4 14Q0 14 0 7Q0 0 4 0"),
    ('1', 8.0, "M1.5 3L4.8 0L4.8 14"),
    ('2', 8.0, "M0.2 3.6Q0.2 0 4 0Q7.8 0 7.8 3.8Q7.8 6.4 4.4 9.6L0 14L8 14"),
    ('3', 8.0, "M0.4 2.6Q1 0 4 0Q7.6 0 7.6 3.4Q7.6 6.6 3.4 6.6Q8 6.6 8 10.2Q8 14 4 14Q0.6 14 0 11"),
    ('4', 8.0, "M6.2 14L6.2 0L0 10L8.4 10"),
    ('5', 8.0, "M7.3 0L1.2 0L0.6 6.4Q2 5.2 4 5.2Q8 5.2 8 9.6Q8 14 4 14Q0.8 14 0 11.4"),
    ('6', 8.0, "M7.3 1.9Q6.4 0 4.4 0Q0 0 0 8Q0 14 4 14Q8 14 8 9.8Q8 5.8 4.2 5.8Q0.6 5.8 0 9"),
    ('7', 8.0, "M0 0L8 0L3 14"),
    ('8', 8.0, "M4 0Q7.6 0 7.6 3.3Q7.6 6.6 4 6.6Q0.4 6.6 0.4 3.3Q0.4 0 4 0M4 6.6Q8 6.6 8 10.3Q8 14 4 14Q0 14 0 10.3Q0 6.6 4 6.6"),
    ('9', 8.0, "M0.7 12.1Q1.6 14 3.6 14Q8 14 8 6Q8 0 4 0Q0 0 0 4.2Q0 8.2 3.8 8.2Q7.4 8.2 8 5"),
    (':', 1.0, "M0.5 5.6L0.5 6M0.5 13.6L0.5 14"),
    (';', 2.0, "M1.5 5.6L1.5 6M1.5 13.4L1.5 14L0.3 16.5"),
    ('<', 8.0, "M8 4L0 8.5L8 13"),
    ('=', 9.0, "M0 6.5L9 6.5M0 10.5L9 10.5"),
    ('>', 8.0, "M0 4L8 8.5L0 13"),
    ('?', 7.0, "M0 3.2Q0.4 0 3.5 0Q7 0 7 3.4Q7 5.6 5 7Q3.5 8.2 3.5 10M3.5 13.6L3.5 14"),
    ('@', 13.0, "M9.2 9Q9.2 11 6.8 11Q4 11 4 7.5Q4 4 6.8 4Q9.2 4 9.2 6.5L9.2 9Q9.2 11 11 11Q13 11 13 7Q13 0 6.7 0Q0 0 0 7.3Q0 15 7 15Q9.5 15 11 14"),
    ('A', 10.0, "M0 14L5 0L10 14M1.8 9L8.2 9"),
    ('B', 8.5, "M0 0L0 14L4.5 14Q8.5 14 8.5 10.3Q8.5 6.6 4.5 6.6L0 6.6M0 0L4.2 0Q8 0 8 3.3Q8 6.6 4.2 6.6"),
    ('C', 9.5, "M9.5 3.2Q8.4 0 5.2 0Q0 0 0 7Q0 14 5.2 14Q8.4 14 9.5 10.8"),
    ('D', 9.5, "M0 0L0 14L4 14Q9.5 14 9.5 7Q9.5 0 4 0L0 0"),
    ('E', 7.5, "M7.5 0L0 0L0 14L7.5 14M0 6.6L6.5 6.6"),
    ('F', 7.5, "M7.5 0L0 0L0 14M0 6.6L6.5 6.6"),
    ('G', 10.0, "M9.5 3.2Q8.4 0 5.2 0Q0 0 0 7Q0 14 5.2 14Q8.5 14 10 11.6L10 7.5L5.8 7.5"),
    ('H', 9.0, "M0 0L0 14M9 0L9 14M0 6.6L9 6.6"),
    ('I', 1.0, "M0.5 0L0.5 14"),
    ('J', 6.0, "M6 0L6 10Q6 14 3 14Q0.5 14 0 11.5"),
    ('K', 8.5, "M0 0L0 14M8.2 0L0 8.6M3 5.6L8.5 14"),
    ('L', 7.0, "M0 0L0 14L7 14"),
    ('M', 11.0, "M0 14L0 0L5.5 9L11 0L11 14"),
    ('N', 9.0, "M0 14L0 0L9 14L9 0"),
    ('O', 11.0, "M5.5 0Q11 0 11 7Q11 14 5.5 14Q0 14 0 7Q0 0 5.5 0"),
    ('P', 8.0, "M0 14L0 0L4.2 0Q8 0 8 3.7Q8 7.4 4.2 7.4L0 7.4"),
    ('Q', 11.0, "M5.5 0Q11 0 11 7Q11 14 5.5 14Q0 14 0 7Q0 0 5.5 0M7 10.5L10.6 15"),
    ('R', 8.5, "M0 14L0 0L4.2 0Q8 0 8 3.7Q8 7.4 4.2 7.4L0 7.4M4.2 7.4L8.5 14"),
    ('S', 8.0, "M7.8 2.9Q7 0 4 0Q0.3 0 0.3 3.4Q0.3 6.1 4 6.8Q8 7.6 8 10.4Q8 14 4 14Q0.8 14 0 10.9"),
    ('T', 9.0, "M0 0L9 0M4.5 0L4.5 14"),
    ('U', 9.0, "M0 0L0 9Q0 14 4.5 14Q9 14 9 9L9 0"),
    ('V', 10.0, "M0 0L5 14L10 0"),
    ('W', 14.0, "M0 0L3.5 14L7 2L10.5 14L14 0"),
    ('X', 9.0, "M0 0L9 14M9 0L0 14"),
    ('Y', 9.0, "M0 0L4.5 7L9 0M4.5 7L4.5 14"),
    ('Z', 8.5, "M0 0L8.5 0L0 14L8.5 14"),
    ('[', 3.5, "M3.5 -1L0 -1L0 16L3.5 16"),
    ('\\', 7.0, "M0 -1L7 15.5"),
    (']', 3.5, "M0 -1L3.5 -1L3.5 16L0 16"),
    ('^', 8.0, "M0 6L4 0L8 6"),
    ('_', 8.0, "M0 16L8 16"),
    ('`', 3.0, "M0 0L3 3"),
    ('a', 7.5, "M7.5 4L7.5 14M7.5 7.4Q6.5 4 3.8 4Q0 4 0 9Q0 14 3.8 14Q6.5 14 7.5 10.6"),
    ('b', 7.5, "M0 0L0 14M0 7.4Q1 4 3.7 4Q7.5 4 7.5 9Q7.5 14 3.7 14Q1 14 0 10.6"),
    ('c', 6.8, "M6.8 6.2Q6 4 3.8 4Q0 4 0 9Q0 14 3.8 14Q6 14 6.8 11.8"),
    ('d', 7.5, "M7.5 0L7.5 14M7.5 7.4Q6.5 4 3.8 4Q0 4 0 9Q0 14 3.8 14Q6.5 14 7.5 10.6"),
    ('e', 7.5, "M0 9L7.5 9Q7.5 4 3.9 4Q0 4 0 9Q0 14 4 14Q6.3 14 7.2 12"),
    ('f', 4.8, "M4.8 0.2Q1.8 -0.6 1.8 3L1.8 14M0 4.5L4.4 4.5"),
    ('g', 7.5, "M7.5 4L7.5 14.5Q7.5 18.5 3.8 18.5Q1.4 18.5 0.5 17M7.5 7.4Q6.5 4 3.8 4Q0 4 0 9Q0 14 3.8 14Q6.5 14 7.5 10.6"),
    ('h', 7.0, "M0 0L0 14M0 8.4Q0.8 4 4 4Q7 4 7 8L7 14"),
    ('i', 1.0, "M0.5 4L0.5 14M0.5 0.2L0.5 0.6"),
    ('j', 3.0, "M2.5 4L2.5 15Q2.5 18.5 0 18.5M2.5 0.2L2.5 0.6"),
    ('k', 6.5, "M0 0L0 14M6.2 4L0 10M2.5 7.8L6.5 14"),
    ('l', 1.0, "M0.5 0L0.5 14"),
    ('m', 11.0, "M0 4L0 14M0 8.4Q0.6 4 3 4Q5.5 4 5.5 8L5.5 14M5.5 8.4Q6.1 4 8.5 4Q11 4 11 8L11 14"),
    ('n', 7.0, "M0 4L0 14M0 8.4Q0.8 4 4 4Q7 4 7 8L7 14"),
    ('o', 8.0, "M4 4Q8 4 8 9Q8 14 4 14Q0 14 0 9Q0 4 4 4"),
    ('p', 7.5, "M0 4L0 18.5M0 7.4Q1 4 3.7 4Q7.5 4 7.5 9Q7.5 14 3.7 14Q1 14 0 10.6"),
    ('q', 7.5, "M7.5 4L7.5 18.5M7.5 7.4Q6.5 4 3.8 4Q0 4 0 9Q0 14 3.8 14Q6.5 14 7.5 10.6"),
    ('r', 4.2, "M0 4L0 14M0 8.6Q0.6 4 4.2 4.2"),
    ('s', 6.5, "M6.3 6.2Q5.6 4 3.3 4Q0.4 4 0.4 6.4Q0.4 8.4 3.3 8.9Q6.5 9.5 6.5 11.6Q6.5 14 3.3 14Q0.8 14 0 11.8"),
    ('t', 4.8, "M1.8 0.8L1.8 11Q1.8 14.3 4.8 13.8M0 4.5L4.6 4.5"),
    ('u', 7.0, "M0 4L0 10Q0 14 3 14Q6.2 14 7 9.6M7 4L7 14"),
    ('v', 7.5, "M0 4L3.75 14L7.5 4"),
    ('w', 11.0, "M0 4L2.75 14L5.5 5L8.25 14L11 4"),
    ('x', 7.0, "M0 4L7 14M7 4L0 14"),
    ('y', 7.5, "M0 4L3.9 14M7.5 4L3.4 15.8Q2.5 18.5 0.3 18.4"),
    ('z', 6.5, "M0 4L6.5 4L0 14L6.5 14"),
    ('{', 4.5, "M4.5 -1Q2.2 -1 2.2 2L2.2 5Q2.2 7.5 0 7.5Q2.2 7.5 2.2 10L2.2 13Q2.2 16 4.5 16"),
    ('|', 1.0, "M0.5 -1L0.5 16"),
    ('}', 4.5, "M0 -1Q2.3 -1 2.3 2L2.3 5Q2.3 7.5 4.5 7.5Q2.3 7.5 2.3 10L2.3 13Q2.3 16 0 16"),
    ('~', 9.0, "M0 9.5Q1.5 6.5 4.5 8.5Q7.5 10.5 9 7.5"),
    ('×', 7.5, "M0 4.8L7.5 12.2M7.5 4.8L0 12.2"),
    ('°', 4.0, "M2 0Q4 0 4 2Q4 4 2 4Q0 4 0 2Q0 0 2 0"),
    ('σ', 8.5, "M8.5 4L4 4Q0 4 0 9Q0 14 4 14Q8 14 8 9Q8 5.5 5.5 4"),
    ('π', 9.0, "M0 4.8L9 4.8M2.6 4.8L2.1 14M6.7 4.8L6.7 11.5Q6.7 14.2 8.8 13.6"),
    ('²', 4.2, "M0.2 2.1Q0.2 0 2.1 0Q4 0 4 2Q4 3.4 2.3 5L0 7.2L4.2 7.2"),
];

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_character_of_ascii_is_there_and_in_its_box() {
        let unknown = glyph('\u{7f}').1;
        for c in ' '..='~' {
            let (width, marks) = glyph(c);
            assert!(marks != unknown, "{c:?}");
            let mut path = Path::default();
            draw(marks, DVec2::new, &mut path);
            let verbs = marks.matches(['M', 'L', 'Q']).count();
            assert_eq!(path.elements().len(), verbs, "{c:?}: every mark is drawn");
            if let Some(bounds) = path.bounds() {
                assert!(bounds.x0 >= -0.01 && bounds.x1 <= width + 0.41, "{c:?} {bounds:?}");
                assert!(bounds.y0 >= -1.01 && bounds.y1 <= 18.51, "{c:?} {bounds:?}");
            } else {
                assert_eq!(c, ' ');
            }
        }
    }

    #[test]
    fn no_two_characters_look_the_same() {
        let all: Vec<&str> = (' '..='~').map(|c| glyph(c).1).collect();
        for (i, a) in all.iter().enumerate() {
            // The stroke of I is that of l.
            let twins = all[..i].iter().filter(|b| *b == a).count();
            assert!(twins == 0 || *a == glyph('l').1, "{a}");
        }
    }

    #[test]
    fn width_is_that_of_the_strokes() {
        for text in ["Hmnz", "EWA, 16 samples", "NN"] {
            let bounds = strokes(text, 20.0, DVec2::ZERO).bounds().unwrap();
            let found = bounds.x1 - bounds.x0;
            assert!((found - text_width(text, 20.0)).abs() < 0.5, "{text} {found}");
            assert!(bounds.y0 >= -15.1 && bounds.y1 <= 4.6);
        }
        assert_eq!(text_width("", 20.0), 0.0);
        assert!(strokes("", 20.0, DVec2::ZERO).is_empty());
    }

    proptest::proptest! {
        #[test]
        fn any_text_is_drawn(text in ".{0,20}", size in 1.0..50.0_f64) {
            assert!(strokes(&text, size, DVec2::ZERO).is_finite());
            assert!(text_width(&text, size) >= 0.0);
        }
    }
}
