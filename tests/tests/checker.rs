//! The checker of pictures can fail, and says what it should.

use image::{Rgba, RgbaImage};
use scumble_tests::{Golden, Mode};
use std::path::Path;

fn golden(name: &str) -> Golden {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("checker").join(name);
    let _ = std::fs::remove_dir_all(&folder);
    let name = name.to_owned();
    Golden { name, references: folder.join("golden"), results: folder.join("results") }
}

fn picture() -> RgbaImage {
    RgbaImage::from_fn(12, 9, |x, y| Rgba([(x * 20) as u8, (y * 25) as u8, 128, 255]))
}

fn report(golden: &Golden) -> serde_json::Value {
    let text = std::fs::read(golden.results.join(format!("{}.json", golden.name)));
    serde_json::from_slice(&text.expect("a report")).expect("JSON")
}

#[test]
fn a_new_picture_fails_until_it_is_blessed() {
    let golden = golden("new");
    let error = golden.judge(&picture(), Mode::Compare).expect_err("there is no reference");
    assert!(error.contains("there is no reference") && error.contains("bless new"), "{error}");
    assert_eq!(report(&golden)["status"], "missing");
    assert!(golden.results.join("new.actual.png").exists());
    assert!(!golden.references.join("new.png").exists(), "a reference never passes in silence");

    golden.judge(&picture(), Mode::Bless).expect("blessing");
    golden.judge(&picture(), Mode::Compare).expect("it is the reference now");
    assert_eq!(report(&golden)["status"], "equal");
}

#[test]
fn the_least_difference_fails_with_a_triptych_and_numbers() {
    let golden = golden("changed");
    golden.judge(&picture(), Mode::Bless).expect("blessing");
    let mut changed = picture();
    changed.get_pixel_mut(7, 3).0[1] += 1;
    let error = golden.judge(&changed, Mode::Compare).expect_err("one level of one pixel");
    assert!(error.contains("1 pixels differ, by up to 1 levels, first at (7, 3)"), "{error}");

    let report = report(&golden);
    assert_eq!(report["status"], "different");
    assert_eq!(report["count"], 1);
    assert_eq!(report["max_difference"], 1);
    assert_eq!(report["first"], serde_json::json!([7, 3]));
    let path = report["picture"].as_str().expect("a path");
    let triptych = image::open(path).expect("a picture").to_rgba8();
    assert_eq!(triptych.dimensions(), (3 * 12 + 16, 9));
    assert_eq!(triptych.get_pixel(12 + 8 + 7, 3).0, [0, 255, 0, 255]);
}

#[test]
fn another_size_fails() {
    let golden = golden("size");
    golden.judge(&picture(), Mode::Bless).expect("blessing");
    let error = golden.judge(&RgbaImage::new(9, 12), Mode::Compare).expect_err("the size");
    assert!(error.contains("the size is (9, 12), not (12, 9)"), "{error}");
}

#[test]
fn alpha_survives_the_reference() {
    let golden = golden("alpha");
    let clear = RgbaImage::from_pixel(3, 3, Rgba([10, 20, 30, 40]));
    golden.judge(&clear, Mode::Bless).expect("blessing");
    golden.judge(&clear, Mode::Compare).expect("the same");
    let opaque = RgbaImage::from_pixel(3, 3, Rgba([10, 20, 30, 255]));
    golden.judge(&opaque, Mode::Compare).expect_err("alpha counts");
}
