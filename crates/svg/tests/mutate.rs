//! Valid documents, damaged at random: whatever comes out, it is an answer.

#![allow(clippy::unwrap_used, reason = "tests")]

mod common;

use common::{OnePicture, read};
use proptest::prelude::*;
use scumble_scene::{Command, Scene};
use scumble_svg::{Limits, Options, ProfileChoice, parse};

const DOCUMENTS: [&str; 4] = [
    include_str!("documents/shapes.svg"),
    include_str!("documents/styles.svg"),
    include_str!("documents/perspective.svg"),
    include_str!("documents/course.svg"),
];

/// What a damaged place is replaced with: tokens that mean something somewhere.
const TOKENS: [&str; 40] = [
    "",
    " ",
    "<",
    ">",
    "/>",
    "\"",
    "'",
    "=",
    "&",
    "&lt;",
    "<g>",
    "</g>",
    "<!--",
    "-->",
    "<![CDATA[",
    "#",
    "url(#a)",
    "url(#c)",
    "%",
    "-",
    "nan",
    "1e30",
    "1e-30",
    "-1e38",
    "0",
    "999999999",
    "none",
    "inherit",
    "matrix3d(",
    ")",
    "perspective(1)",
    "rotateY(90deg)",
    ";",
    "{",
    "}",
    "!important",
    "é",
    "\0",
    "<use href='#a'/>",
    "transform",
];

/// Replaces `length` bytes at a relative place by a token, at character borders.
fn damage(text: &mut String, place: f64, length: usize, token: usize) {
    let border = |text: &str, mut i: usize| {
        i = i.min(text.len());
        while !text.is_char_boundary(i) {
            i -= 1;
        }
        i
    };
    let start = border(text, (place * text.len() as f64) as usize);
    let end = border(text, start + length).max(start);
    text.replace_range(start..end, TOKENS[token]);
}

/// What a reader guarantees.
fn check(scene: &Scene) {
    let mut depth = 0_usize;
    for command in &scene.commands {
        let map = match command {
            Command::PushLayer { opacity } => {
                assert!((0.0..=1.0).contains(opacity));
                depth += 1;
                continue;
            }
            Command::PopLayer => {
                depth = depth.checked_sub(1).unwrap();
                continue;
            }
            Command::Fill(c) => c.transform,
            Command::Stroke(c) => c.transform,
            Command::Gouraud(c) => c.transform,
            Command::Textured(c) => {
                assert!(c.image.0 < scene.images.len());
                c.transform
            }
            Command::Image(c) => {
                assert!(c.image.0 < scene.images.len() && !c.rect.is_empty());
                c.transform
            }
            Command::Hairline(c) => c.transform,
            Command::Point(c) => c.transform,
        };
        assert!(map.is_finite());
    }
    assert_eq!(depth, 0);
    let size = scene.view.size();
    assert!(size.is_finite() && size.x > 0.0 && size.y > 0.0);
    assert!(scene.images.iter().all(|i| i.pixels.width() > 0 && i.pixels.height() > 0));
}

#[test]
fn undamaged_documents_are_read_without_a_warning() {
    for document in DOCUMENTS {
        let parsed = read(ProfileChoice::Auto, document).unwrap();
        assert_eq!(parsed.warnings, []);
        assert!(parsed.scene.commands.len() > 5);
        check(&parsed.scene);
    }
}

fn arbitrary_damage() -> impl Strategy<Value = Vec<(f64, usize, usize)>> {
    prop::collection::vec((0.0..1.0, 0..12_usize, 0..TOKENS.len()), 1..6)
}

proptest! {
    #[test]
    fn damaged_documents_never_panic(
        document in 0..DOCUMENTS.len(),
        places in arbitrary_damage(),
    ) {
        let mut text = DOCUMENTS[document].to_owned();
        for (place, length, token) in places {
            damage(&mut text, place, length, token);
        }
        for profile in [ProfileChoice::Svg, ProfileChoice::Course] {
            if let Ok(parsed) = read(profile, &text) {
                check(&parsed.scene);
            }
        }
    }

    #[test]
    fn arbitrary_bytes_never_panic(bytes in prop::collection::vec(any::<u8>(), 0..200)) {
        let _ = parse(&bytes, &Options::default());
    }

    #[test]
    fn limits_hold_however_small(document in 0..DOCUMENTS.len(), elements in 0..40_usize, depth in 0..6_usize) {
        let mut limits = Limits::default();
        (limits.max_elements, limits.max_depth) = (elements, depth);
        let options = Options::default().with_resources(&OnePicture).with_limits(limits);
        for profile in [ProfileChoice::Svg, ProfileChoice::Course] {
            if let Err(e) = parse(DOCUMENTS[document].as_bytes(), &options.with_profile(profile)) {
                prop_assert!(e.is_limit(), "{}", e);
            }
        }
    }

    #[test]
    fn transforms_of_any_words(words in prop::collection::vec(0..TOKENS.len(), 0..8)) {
        let text: String = words.into_iter().map(|i| TOKENS[i]).collect();
        let escaped = text.replace('&', "&amp;").replace('<', "&lt;").replace('"', "&quot;").replace('\0', "");
        let document = format!(
            "<svg width=\"9\" height=\"9\"><g transform=\"{escaped}\" style=\"transform:{escaped}\"><rect width=\"1\" height=\"1\"/></g></svg>"
        );
        for profile in [ProfileChoice::Svg, ProfileChoice::Course] {
            check(&read(profile, &document).unwrap().scene);
        }
    }
}
