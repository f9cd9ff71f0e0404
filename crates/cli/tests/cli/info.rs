use crate::common::{Desk, SHAPES, png_file};
use serde_json::Value;

fn json(run: crate::common::Run) -> Value {
    serde_json::from_slice(&run.succeeded().out).expect("one object")
}

#[test]
fn a_picture_is_described() {
    let desk = Desk::with("a.png", png_file(3));
    let said = String::from_utf8(desk.run("info a.png").succeeded().out).expect("text");
    assert!(said.starts_with("a.png: PNG, 3 × 3, 8-bit gray\n"), "{said}");
    let value = json(desk.run("info a.png --json"));
    assert_eq!(
        (&value["kind"], &value["format"], &value["bits"], &value["alpha"]),
        (&"picture".into(), &"PNG".into(), &8.into(), &"none".into())
    );
}

#[test]
fn a_scene_is_described_whatever_its_name() {
    let desk = Desk::with("a.png", SHAPES);
    let value = json(desk.run("info a.png --json"));
    assert_eq!((&value["kind"], &value["width"]), (&"scene".into(), &200.0.into()));
    assert_eq!(value["primitives"]["strokes"], 1);
    assert_eq!(value["primitives"]["fills"], 2);
}

#[test]
fn standard_input_is_read() {
    let desk = Desk::new();
    let said = desk.run_with_input("info -", &png_file(5)).succeeded().out;
    assert!(said.starts_with("<stdin>: PNG, 5 × 5".as_bytes()));
    let said = desk.run_with_input("info -", SHAPES.as_bytes()).succeeded().out;
    assert!(said.starts_with(b"<stdin>: scene"));
}

#[test]
fn what_cannot_be_read_is_an_error() {
    let png = png_file(3);
    let desk = Desk::with("cut.png", &png[..png.len() - 20]);
    desk.put("text.txt", "words");
    desk.put("bad.svg", "<svg");
    desk.put("empty", "");
    desk.run("info cut.png").failed(1, "cut.png: ", &[]);
    desk.run("info text.txt").failed(1, "text.txt: not a picture", &[]);
    desk.put("a.gif", "GIF89a\x01\0\x01\0\0\0\0;");
    desk.put("photo.jpg", b"\0\0\0\x1cftypheic\0\0\0\0mif1heic");
    desk.run("info a.gif").failed(1, "a.gif: GIF is not read; PNG, JPEG,", &[]);
    desk.run("info photo.jpg").failed(1, "photo.jpg: HEIC is not read; PNG, JPEG,", &[]);
    desk.run("diff bad.svg cut.png").failed(1, "bad.svg: text (perhaps a scene", &[]);
    desk.run("info bad.svg").failed(1, "bad.svg:1:", &[]);
    desk.run("info empty").failed(1, "empty: the file is empty", &[]);
    desk.run("info none").failed(1, "none: ", &[]);
    desk.run("info .").failed(1, ".: it is a folder", &[]);
    desk.run("info").misused("<FILE>");
}

#[test]
fn a_size_that_is_only_declared_takes_no_memory() {
    // A whole PNG header of 2³⁰ × 2³⁰ pixels, and nothing in it.
    let mut png = png_file(1);
    png[16..24].copy_from_slice(&[0x40, 0, 0, 0, 0x40, 0, 0, 0]);
    let crc = crc32(&png[12..29]);
    png[29..33].copy_from_slice(&crc.to_be_bytes());
    let desk = Desk::with("bomb.png", png);
    desk.run("info bomb.png").failed(3, "bomb.png: the picture is ", &["--max-pixels"]);
    let run = desk.run("info bomb.png --max-pixels 2000000000G");
    run.failed(3, "bomb.png: ", &["--max-memory"]);
    desk.run("info bomb.png --max-memory 60").failed(3, "bomb.png: ", &["--max-memory"]);
}

/// The checksum of PNG's chunks (ISO 3309), bit by bit.
fn crc32(data: &[u8]) -> u32 {
    !data.iter().fold(!0, |crc, byte| {
        (0..8)
            .fold(crc ^ u32::from(*byte), |c, _| c >> 1 ^ if c & 1 == 1 { 0xedb8_8320 } else { 0 })
    })
}
