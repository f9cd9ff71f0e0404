use crate::common::{Desk, png_file, rgba_png};
use serde_json::Value;

/// Two pictures of 4 × 2 that differ by 7 in the green of (2, 1).
fn two() -> Desk {
    let mut pixels = [[10, 20, 30, 255]; 8];
    let desk = Desk::with("a.png", rgba_png(4, &pixels));
    pixels[6][1] += 7;
    desk.put("b.png", rgba_png(4, &pixels));
    desk
}

#[test]
fn equal_pictures_are_equal() {
    let desk = two();
    desk.put("c.png", std::fs::read(desk.path("a.png")).expect("a file"));
    assert_eq!(desk.run("diff a.png c.png").succeeded().out, b"the pictures are equal\n");
    assert_eq!(desk.run("diff a.png a.png --json").code, Some(0));
}

#[test]
fn pictures_that_differ_say_how_and_end_with_four() {
    let desk = two();
    let run = desk.run("diff a.png b.png");
    assert_eq!((run.code, run.err.as_str()), (Some(4), ""));
    let said = String::from_utf8(run.out).expect("text");
    assert!(said.contains("difference 7 of 255 at (2, 1) · 1 of 8 pixels"), "{said}");
    let run = desk.run("diff a.png b.png --json --tolerance 6.9");
    assert_eq!(run.code, Some(4));
    let value: Value = serde_json::from_slice(&run.out).expect("one object");
    assert_eq!(
        (&value["same"], &value["max"], &value["beyond"]),
        (&false.into(), &7.0.into(), &1.into())
    );
    assert_eq!((&value["max_at"]["x"], &value["max_at"]["y"]), (&2.into(), &1.into()));
}

#[test]
fn the_status_alone_will_do() {
    let desk = two();
    for (other, code) in [("a.png", 0), ("b.png", 4)] {
        let run = desk.run(&format!("diff a.png {other} --quiet"));
        assert_eq!((run.code, run.out.as_slice(), run.err.as_str()), (Some(code), &b""[..], ""));
    }
}

#[test]
fn the_tolerance_is_included() {
    let desk = two();
    assert_eq!(desk.run("diff a.png b.png --tolerance 7").succeeded().code, Some(0));
    desk.run("diff a.png b.png --tolerance -1").misused("not 0 or more");
    desk.run("diff a.png b.png --tolerance nan").misused("tolerance");
}

#[test]
fn the_triptych_shows_both_and_what_lies_between() {
    let desk = two();
    assert_eq!(desk.run("diff a.png b.png -o t.png").code, Some(4));
    let picture = desk.picture("t.png");
    assert_eq!((picture.width, picture.height), (4 * 3 + 16, 2));
    assert_eq!(picture.at(2, 1), [10, 20, 30, 255]);
    assert_eq!(picture.at(12, 0), [0, 0, 0, 255]);
    // 7 enlarged so that it is white.
    assert_eq!(picture.at(14, 1), [0, 255, 0, 255]);
    assert_eq!(picture.at(26, 1), [10, 27, 30, 255]);
    // On standard output nothing else is.
    let run = desk.run("diff a.png b.png -o -");
    assert_eq!(crate::common::Picture::decode(&run.out), picture);
    assert_eq!(desk.names(), ["a.png", "b.png", "t.png"]);
}

#[test]
fn other_sizes_differ_and_leave_no_triptych() {
    let desk = two();
    desk.put("small.png", png_file(2));
    let run = desk.run("diff a.png small.png -o t.png");
    assert_eq!((run.code, run.err.as_str()), (Some(4), ""));
    assert_eq!(run.out, "sizes differ: 4 × 2 and 2 × 2\n".as_bytes());
    let run = desk.run("diff a.png small.png --json");
    let value: Value = serde_json::from_slice(&run.out).expect("one object");
    assert_eq!((&value["same"], &value["why"]), (&false.into(), &"size".into()));
    assert!(!desk.path("t.png").exists());
    // Where a picture is awaited words would be none.
    let run = desk.run("diff a.png small.png -o -").failed(4, "sizes differ: ", &[]);
    assert!(run.out.is_empty());
}

#[test]
fn neither_picture_is_replaced_and_both_must_be_there() {
    let desk = two();
    desk.run("diff a.png b.png -o a.png").failed(1, "a.png: ", &["--force"]);
    desk.run("diff a.png b.png -o b.png").failed(1, "b.png: ", &["--force"]);
    desk.run("diff a.png b.png -o t.jpg").failed(2, "t.jpg: ", &["PNG"]);
    desk.run("diff a.png none.png").failed(1, "none.png: ", &[]);
    desk.run("diff - -").failed(2, "only one", &[]);
    desk.run("diff a.png").misused("<B>");
    let a = std::fs::read(desk.path("a.png")).expect("a file");
    assert_eq!(
        desk.run_with_input("diff - a.png", &a).succeeded().out,
        b"the pictures are equal\n"
    );
}
