use crate::common::{Desk, SQUARE, png_file, scene_of};
use std::fs;

#[test]
fn a_named_picture_is_replaced_every_time() {
    let desk = Desk::with("a.svg", SQUARE);
    for _ in 0..3 {
        desk.run("render a.svg -o b.png").succeeded();
        desk.run("render a.svg b.png").succeeded();
    }
    assert_eq!(desk.names(), ["a.svg", "b.png"]);
}

#[test]
fn a_picture_without_a_name_replaces_nothing_unasked() {
    let desk = Desk::with("scenes/a.svg", SQUARE);
    desk.run("render scenes/a.svg").succeeded();
    assert_eq!(desk.names(), ["a.png", "scenes"]);
    desk.run("render scenes/a.svg").failed(1, "a.png: ", &["--force"]);
    desk.run("render scenes/a.svg --force").succeeded();
}

#[test]
fn slips_of_the_finger_cost_nothing() {
    let desk = Desk::with("a.svg", SQUARE);
    desk.put("notes.txt", "a letter");
    desk.run("render a.svg a.svg").failed(1, "a.svg: ", &["it is what is read"]);
    desk.run("render a.svg notes.txt").failed(1, "notes.txt: ", &["not a picture"]);
    desk.run("render a.svg none/b.png").failed(1, "none: ", &["folder"]);
    assert_eq!(fs::read_to_string(desk.path("a.svg")).unwrap(), SQUARE);
    assert_eq!(fs::read_to_string(desk.path("notes.txt")).unwrap(), "a letter");
    desk.put("b.svg", scene_of("texture.png"));
    desk.put("texture.png", png_file(2));
    desk.run("render b.svg texture.png").failed(1, "texture.png: ", &["images"]);
    assert_eq!(fs::read(desk.path("texture.png")).unwrap(), png_file(2));
    desk.run("render a.svg notes.txt --force").succeeded();
    assert_eq!(desk.picture("notes.txt").width, 10);
}

#[test]
fn a_failure_leaves_the_old_picture() {
    let desk = Desk::with("a.svg", "<svg");
    desk.put("b.png", png_file(2));
    desk.run("render a.svg b.png").failed(1, "a.svg:", &[]);
    assert_eq!(fs::read(desk.path("b.png")).unwrap(), png_file(2));
    assert_eq!(desk.names(), ["a.svg", "b.png"]);
}

#[test]
fn a_reader_that_leaves_is_no_reason_to_panic() {
    let desk = Desk::with("a.svg", SQUARE);
    desk.run_unread("render a.svg - -w 3000").failed(1, "standard output: ", &[]);
}

#[cfg(target_os = "linux")]
#[test]
fn a_full_disk_is_a_failure() {
    let desk = Desk::with("a.svg", SQUARE);
    desk.run("render a.svg /dev/full").failed(1, "/dev/full: ", &["--force"]);
    desk.run("render a.svg /dev/full --force").failed(1, "/dev/full: ", &["space"]);
    desk.run("render a.svg /dev/null --force").succeeded();
}

#[cfg(unix)]
#[test]
fn an_interrupted_run_leaves_nothing() {
    use std::process::Command;
    use std::time::{Duration, Instant};
    for (signal, code) in [("INT", 130), ("TERM", 143)] {
        let desk = Desk::with("a.svg", SQUARE);
        let mut child = desk.command("render a.svg -o b.png -w 30000 -H 30000").spawn().unwrap();
        let since = Instant::now();
        while desk.names().len() < 2 {
            assert!(since.elapsed() < Duration::from_secs(60), "no temporary file appears");
            assert!(child.try_wait().unwrap().is_none(), "the run ended early");
            std::thread::sleep(Duration::from_millis(5));
        }
        assert!(!desk.path("b.png").exists(), "the run is not over");
        let id = child.id().to_string();
        let sent = Command::new("kill").args(["-s", signal, &id]).status();
        assert!(sent.is_ok_and(|s| s.success()));
        let output = child.wait_with_output().unwrap();
        let err = String::from_utf8(output.stderr).unwrap();
        assert_eq!((output.status.code(), err.as_str()), (Some(code), "scumble: interrupted\n"));
        assert_eq!(desk.names(), ["a.svg"]);
    }
}
