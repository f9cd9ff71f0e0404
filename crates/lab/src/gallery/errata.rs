//! The page of errata against what is computed: numbers that belong to no figure, and how the tests of
//! those that do belong to one look for theirs.

use crate::math::random;
use scumble::texture::{Texture, TextureOptions};
use scumble_geometry::Matrix2;
use scumble_pixel::Image;

const PAGE: &str = include_str!("../../../../docs/errata.md");

/// Asserts that the page has these words.
#[track_caller]
pub(super) fn says(words: &str) {
    assert!(PAGE.contains(words), "docs/errata.md does not say: {words}");
}

/// A number in −1…1.
pub(super) fn random_number(index: i64, seed: u32) -> f64 {
    2.0 * random(index, 0, seed) - 1.0
}

#[test]
fn a_pyramid_has_one_level_more_than_the_logarithm() {
    let image = Image::filled(64, 64, [9; 4]).unwrap();
    let levels = Texture::new(image.view(), &TextureOptions::default()).unwrap().level_count();
    says(&format!("64 texels have {levels}"));
}

#[test]
fn the_ratio_is_not_the_eccentricity() {
    let ratio: f64 = 30.0;
    says(&format!("at a ratio of 30 it is {:.4}", (1.0 - 1.0 / (ratio * ratio)).sqrt()));
}

#[test]
fn discriminants_of_near_circles_turn_negative() {
    const COUNT: i64 = 100_000;
    let mut negative = 0;
    for i in 0..COUNT {
        let a = (1.5 + 0.5 * random_number(i, 1)) as f32;
        let d = a * (1.0 + 2e-4 * random_number(i, 2)) as f32;
        let b = a * (1e-5 * random_number(i, 3)) as f32;
        negative += i64::from((a + d) * (a + d) - 4.0 * (a * d - b * b) < 0.0);
        assert!((a - d) * (a - d) + 4.0 * b * b >= 0.0);
    }
    says(&format!("negative for {:.0} %", 100.0 * negative as f64 / COUNT as f64));
}

/// The smaller singular value by the root of the quadratic that has the minus, in `f32`.
fn smaller_root(j: &Matrix2) -> f32 {
    let [a, b, c, d] = [j.a, j.b, j.c, j.d].map(|v| v as f32);
    let (p, q, r) = (a * a + b * b, a * c + b * d, c * c + d * d);
    let h = ((p - r) * (p - r) + 4.0 * q * q).sqrt();
    (((p + r) - h) / 2.0).max(0.0).sqrt()
}

#[test]
fn the_smaller_root_loses_its_digits() {
    for ratio in [300.0, 3000.0] {
        let mut errors: Vec<f64> = (0..10_001)
            .map(|i| {
                let (x, y) = (random_number(i, 4), random_number(i, 5));
                let length = (x * x + y * y).sqrt().max(1e-3);
                let (c, s) = (x / length, y / length);
                let j = Matrix2::new(ratio * c, -s, ratio * s, c);
                (f64::from(smaller_root(&j)) / j.axes().minor - 1.0).abs()
            })
            .collect();
        errors.sort_by(f64::total_cmp);
        let tenth = 100.0 * errors[errors.len() - errors.len() / 10];
        says(&format!("{tenth:.1} % at {ratio:.0} : 1"));
    }
}

#[test]
fn a_level_is_a_logarithm() {
    let (texels, width) = (8.0_f64, 1024.0);
    says(&format!("belongs on level {}", texels.log2()));
    says(&format!("gives {:.3}", texels / width));
}

#[test]
fn every_entry_shows_a_picture_or_a_number() {
    let rows = PAGE.lines().filter(|line| line.starts_with("| ") && !line.contains("| rather |"));
    let mut count = 0;
    for row in rows {
        let rather = row.split(" | ").nth(1).unwrap_or_default();
        let shown = row.contains("](gallery/") || row.contains("](numerics");
        let number = rather.contains(|c: char| c.is_ascii_digit());
        assert!(shown || number, "{row}");
        count += 1;
    }
    assert!(count > 30, "{count}");
}

#[test]
fn every_link_to_the_gallery_leads_to_a_heading() {
    let links = PAGE.split("](gallery/").skip(1).filter_map(|rest| rest.split(')').next());
    for (link, (file, anchor)) in links.filter_map(|link| Some((link, link.split_once('#')?))) {
        let page = super::PAGES.iter().find(|page| file == format!("{}.md", page.name));
        let page = page.unwrap_or_else(|| panic!("no page {file}"));
        let found = page.figures.iter().any(|figure| anchor_of(figure.title) == anchor);
        assert!(found, "{link}");
    }
}

/// The anchor that a forge makes of a heading: small letters, hyphens for spaces, and no other signs.
fn anchor_of(title: &str) -> String {
    let kept = |c: char| match c {
        ' ' => Some('-'),
        c if c.is_alphanumeric() || c == '-' || c == '_' => Some(c),
        _ => None,
    };
    title.to_lowercase().chars().filter_map(kept).collect()
}
