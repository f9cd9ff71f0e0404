//! The scenes of a comparison are read as they are meant, and what is wrong with one is said in a
//! line.

use lab::exchange::{Frame, parse_display_list, read};
use proptest::prelude::*;
use scumble::coverage::SamplePattern;
use scumble::scene::Command;
use scumble::{Settings, render_image};
use scumble_geometry::{Cap, FillRule, Join};
use scumble_pixel::Image;
use std::fs;
use std::path::Path;
use std::process::{Command as Process, Output};

fn picture(frame: &Frame) -> Image<[u8; 4]> {
    let mut settings = Settings::new(frame.width, frame.height);
    settings.pattern = SamplePattern::default();
    render_image(&frame.scene, &settings).expect("a small picture")
}

#[test]
fn a_display_list_keeps_its_rules_and_styles() {
    let text = "size 8 4\nbg 255 255 255 255\nf 0 0 255 255 eo\nM 0 0\nL 4 0\nL 4 4\nL 0 4\nZ\n\
                M 1 1\nL 3 1\nL 3 3\nL 1 3\nZ\n.\n\ns 255 0 0 128 2 2 1 3.5\nM 5 2\nC 5 2 7 2 7 2\n.\n";
    let frame = parse_display_list(text).unwrap();
    assert_eq!((frame.width, frame.height), (8, 4));
    let [Command::Fill(fill), Command::Stroke(stroke)] = &frame.scene.commands[..] else {
        panic!("{:?}", frame.scene.commands);
    };
    assert_eq!(fill.rule, FillRule::EvenOdd);
    let style = &stroke.style;
    assert_eq!((style.width, style.cap, style.join), (2.0, Cap::Square, Join::Round));
    assert_eq!(style.miter_limit, 3.5);
    let picture = picture(&frame);
    assert_eq!(picture.get(0, 0), Some(&[0, 0, 255, 255]));
    assert_eq!(picture.get(2, 2), Some(&[255, 255, 255, 255]), "the hole");
    assert_eq!(picture.get(4, 2), Some(&[255, 127, 127, 255]), "the square cap");
    assert_eq!(picture.get(4, 0), Some(&[255, 255, 255, 255]));
}

#[test]
fn what_is_wrong_with_a_display_list_is_said_with_its_line() {
    for (text, message) in [
        ("", "it has no size"),
        ("size 0 4", "line 1: the width is 0: whole numbers from 1 to 16384 are"),
        ("size 4", "line 1: 2 numbers belong here, not 1"),
        ("size 4 4\nM 0 0", "line 2: M outside a path"),
        ("size 4 4\nf 0 0 0 255 nz\nL 0 0", "line 3: a path begins with M"),
        ("size 4 4\nf 0 0 0 255 nz\nM 0 nan", "line 3: \"nan\" is not a number"),
        ("size 4 4\nf 0 0 0 255", "line 2: a fill ends with nz or eo"),
        ("f 0 0 0", "line 1: a paint begins with four numbers"),
        ("f 0 0 0 256 nz", "line 1: 256 is no component of a colour: 0 to 255 are"),
        ("s 0 0 0 255 1 3 0 4", "line 1: no cap 3: 0, 1 and 2 are"),
        ("s 0 0 0 255 1 0 9 4", "line 1: no join 9: 0, 1 and 2 are"),
        ("f 0 0 0 255 nz\nf 0 0 0 255 nz", "line 2: the path before has no end"),
        ("size 4 4\nf 0 0 0 255 nz", "the last path has no end"),
        (".", "line 1: no path to end"),
        ("q", "line 1: unknown step \"q\""),
    ] {
        assert_eq!(parse_display_list(text).unwrap_err(), message, "{text:?}");
    }
}

/// Writes a scene of triangles and returns the path of its JSON file.
fn mesh(folder: &Path, vertices: &[[f32; 10]], texture: bool) -> std::path::PathBuf {
    let bytes: Vec<u8> = vertices.as_flattened().iter().flat_map(|v| v.to_le_bytes()).collect();
    fs::write(folder.join("t.f32"), bytes).expect("writing");
    let texels = [[255, 0, 0, 255], [0, 255, 0, 255], [0, 0, 255, 255], [255, 255, 0, 255u8]];
    let (file, color) = (folder.join("t.png"), image::ColorType::Rgba8);
    image::save_buffer(file, texels.as_flattened(), 4, 1, color).expect("writing");
    let texture = if texture { "\"t.png\"" } else { "null" };
    let json = format!(
        r#"{{"width": 8, "height": 4, "clear": [0, 0, 0, 255], "vertices": "t.f32",
            "count": {}, "texture": {texture}, "wrap": "repeat"}}"#,
        vertices.len()
    );
    let path = folder.join("t.json");
    fs::write(&path, json).expect("writing");
    path
}

/// A vertex at (x, y, w) in clip space with a grey and a place along the texture.
fn vertex(x: f32, y: f32, w: f32, grey: f32, u: f32) -> [f32; 10] {
    [x, y, 0.0, w, grey, grey, grey, 1.0, u, 0.5]
}

#[test]
fn clip_space_has_its_y_upwards_and_divides_by_w() {
    let folder = tempfile::tempdir().unwrap();
    // The upper left half of the canvas; the lower left corner is twice as far away.
    let corners = [
        vertex(-1.0, 1.0, 1.0, 1.0, 0.0),
        vertex(1.0, 1.0, 1.0, 1.0, 0.0),
        vertex(-2.0, -2.0, 2.0, 0.0, 0.0),
    ];
    let picture = picture(&read(&mesh(folder.path(), &corners, false)).unwrap());
    assert_eq!(picture.get(7, 3), Some(&[0, 0, 0, 255]));
    // At the centre of pixel (0, 2), 5/8 of the way down, 1/w is 11/16 and grey/w is 3/8.
    let expected = (255.0f64 * 6.0 / 11.0).round() as u8;
    assert!(picture.get(0, 2).unwrap()[0].abs_diff(expected) <= 1, "{:?}", picture.get(0, 2));
    assert_eq!(picture.get(0, 2).unwrap()[0], picture.get(2, 2).unwrap()[0], "rows are alike");
}

#[test]
fn textures_repeat() {
    let folder = tempfile::tempdir().unwrap();
    let [a, b, c, d] = [(-1.0, 1.0, -1.0), (1.0, 1.0, 1.0), (1.0, -1.0, 1.0), (-1.0, -1.0, -1.0)]
        .map(|(x, y, u)| vertex(x, y, 1.0, 0.0, u));
    let picture = picture(&read(&mesh(folder.path(), &[a, b, c, a, c, d], true)).unwrap());
    for (y, x) in [(0, 0), (3, 1), (1, 2), (2, 3)] {
        assert_eq!(picture.get(x, y), picture.get(x + 4, y));
    }
    assert_ne!(picture.get(0, 0), picture.get(1, 0));
}

#[test]
fn what_lies_behind_the_eye_is_not_drawn() {
    let folder = tempfile::tempdir().unwrap();
    let corners =
        [(-1.0, 1.0), (1.0, 1.0), (-1.0, -1.0)].map(|(x, y)| vertex(x, y, -1.0, 1.0, 0.0));
    let picture = picture(&read(&mesh(folder.path(), &corners, false)).unwrap());
    assert!(picture.pixels().iter().all(|pixel| *pixel == [0, 0, 0, 255]));
}

fn bench(args: &[&str]) -> Output {
    Process::new(env!("CARGO_BIN_EXE_scene_bench")).args(args).output().expect("it starts")
}

#[test]
fn the_program_prints_its_line() {
    let folder = tempfile::tempdir().unwrap();
    let corners = [(-1.0, 1.0), (1.0, 1.0), (-1.0, -1.0)].map(|(x, y)| vertex(x, y, 1.0, 1.0, 0.0));
    let scene = mesh(folder.path(), &corners, true);
    let out = folder.path().join("out.png");
    let (scene, file) = (scene.to_str().unwrap(), out.to_str().unwrap());
    let done = bench(&[
        "--scene", scene, "--bench", "3", "--filter", "aniso16", "--msaa", "4", "--out", file,
    ]);
    assert!(done.status.success(), "{done:?}");
    let printed = String::from_utf8(done.stdout).unwrap();
    let words: Vec<&str> = printed.lines().next().unwrap().split(' ').collect();
    assert_eq!((words[0], words[3], words.len()), ("ms", "3", 4), "{printed}");
    assert_eq!(image::open(out).unwrap().to_rgba8().dimensions(), (8, 4));
}

#[test]
fn the_program_refuses_in_one_line() {
    let folder = tempfile::tempdir().unwrap();
    let refused = |name: &str, content: &[u8], message: &str| {
        let path = folder.path().join(name);
        fs::write(&path, content).unwrap();
        let done = bench(&["--scene", path.to_str().unwrap(), "--bench", "1"]);
        let error = String::from_utf8(done.stderr).unwrap();
        assert_eq!(done.status.code(), Some(1), "{name}: {error}");
        assert!(error.contains(message) && error.lines().count() == 1, "{name}: {error}");
    };
    refused("a.dl", b"size x 1", "a.dl: line 1: \"x\" is not a number");
    refused("a.dl", b"\xff", "a.dl: not UTF-8 text");
    refused("a.txt", b"", "a.txt: not a scene");
    refused("a.json", b"{", "a.json: EOF");
    refused("a.json", b"[]", "`clear` should be four numbers");
    let json = |rest: &str| {
        format!(r#"{{"width": 4, "height": 4, "clear": [0, 0, 0, 0], "vertices": "v.f32" {rest}}}"#)
    };
    let with = |rest: &str, message: &str| refused("a.json", json(rest).as_bytes(), message);
    with("", "`count` should be a whole number");
    with(r#", "count": 3, "wrap": "no""#, "`wrap` is \"no\"");
    with(r#", "count": 3, "texture": 1"#, "`texture` should be a file's name or null");
    with(r#", "count": 3"#, "v.f32: ");
    fs::write(folder.path().join("v.f32"), [0; 120]).unwrap();
    with(r#", "count": 18446744073709551615"#, "v.f32: ");
    with(r#", "count": 4"#, "v.f32: 4 vertices were announced, 120 bytes are there");
    with(r#", "count": 3, "texture": "a.json""#, "a.json: ");
    fs::write(folder.path().join("v.f32"), [0; 40]).unwrap();
    with(r#", "count": 1"#, "v.f32: 1 vertices are not whole triangles");
    fs::write(folder.path().join("v.f32"), [255; 120]).unwrap();
    with(r#", "count": 3"#, "v.f32: vertex 0 has a number that is not finite");
}

proptest! {
    #[test]
    fn no_text_makes_the_reader_panic(
        lines in prop::collection::vec("(size|bg|f|s|M|L|C|Z|\\.)( [0-9nze.-]{1,4}){0,8}", 0..12)
    ) {
        let _ = parse_display_list(&lines.join("\n"));
    }
}
