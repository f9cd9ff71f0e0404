use crate::common::{Desk, SQUARE, png_file, scene_of};

#[test]
fn wrong_arguments_are_a_usage_error() {
    let desk = Desk::with("a.svg", SQUARE);
    desk.run("").misused("Usage");
    desk.run("render").misused("SCENE");
    desk.run("paint a.svg").misused("paint");
    desk.run("render a.svg --samples 3").misused("1, 2, 4, 8, 9, 16");
    desk.run("render a.svg --pixel cubic").misused("nearest");
    desk.run("render a.svg -w 0").misused("at least one pixel");
    desk.run("render a.svg -z -1").misused("-1");
    desk.run("render a.svg --crop 1,2,3").misused("x,y,w,h");
    desk.run("render a.svg --background beige-ish").misused("CSS colour");
    desk.run("render a.svg --max-memory lots").misused("512M");
    desk.run("render a.svg b.png -o c.png").misused("cannot be used with");
    desk.run("completions cmd").misused("bash");
    assert_eq!(desk.names(), ["a.svg"]);
}

#[test]
fn arguments_that_the_scene_contradicts_are_a_usage_error_too() {
    let desk = Desk::with("a.svg", SQUARE);
    desk.run("render a.svg --crop 8,0,3,1").failed(2, "--crop 8,0,3,1", &["10 by 8"]);
    desk.run("render a.svg --samples 8 --pattern grid").failed(2, "--pattern grid", &[]);
    desk.run("render a.svg - --json").failed(2, "--json", &[]);
    assert_eq!(desk.names(), ["a.svg"]);
}

#[test]
fn what_cannot_be_read_is_named() {
    let desk = Desk::new();
    desk.run("render none.svg").failed(1, "none.svg: No such file", &[]);
    desk.run("render .").failed(1, ".: ", &[]);
    desk.run_with_input("render -", b"").failed(1, "<stdin>", &[]);
    assert!(desk.names().is_empty());
}

#[test]
fn malformed_text_is_told_with_its_place() {
    let desk = Desk::with("a.svg", "<svg xmlns=\"http://www.w3.org/2000/svg\">\n  <rect</svg>");
    desk.run("render a.svg").failed(1, "a.svg:2:", &[]);
    desk.put("b.svg", "not XML at all");
    desk.run("render b.svg").failed(1, "b.svg:1:1: ", &[]);
    desk.put("c.svg", "<html/>");
    desk.run("render c.svg").failed(1, "c.svg:1:", &["html"]);
    desk.put("picture.svg", png_file(2));
    desk.run("render picture.svg").failed(1, "picture.svg: it is a picture (PNG)", &[]);
    std::fs::remove_file(desk.path("picture.svg")).unwrap();
    desk.put("d.svg", [0x89, b'P', b'N', b'G', 0xff, 0xfe, 0, 1]);
    desk.run("render d.svg").failed(1, "d.svg", &[]);
    let run = desk.run_with_input("render - -", b"<svg><g></svg>");
    assert!(run.failed(1, "<stdin>:1:", &[]).out.is_empty());
    assert_eq!(desk.names(), ["a.svg", "b.svg", "c.svg", "d.svg"]);
}

#[test]
fn images_that_are_missing_corrupt_or_elsewhere_are_told_with_their_place() {
    let desk = Desk::with("scenes/a.svg", scene_of("../secret.png"));
    desk.put("secret.png", png_file(4));
    let refused = desk.run("render scenes/a.svg").failed(1, "scenes/a.svg:2:", &["../secret.png"]);
    assert!(refused.err.contains("--resources"), "{}", refused.err);
    desk.put("scenes/b.svg", scene_of("none.png"));
    desk.run("render scenes/b.svg").failed(1, "scenes/b.svg:2:", &["none.png", "not found"]);
    desk.put("scenes/corrupt.png", &png_file(4)[..40]);
    desk.put("scenes/c.svg", scene_of("corrupt.png"));
    desk.run("render scenes/c.svg").failed(1, "scenes/c.svg:2:", &["corrupt.png"]);
    desk.put("scenes/d.svg", scene_of("https://example.org/x.png"));
    desk.run("render scenes/d.svg").failed(1, "scenes/d.svg:2:", &["example.org"]);
    desk.put("scenes/e.svg", scene_of("/etc/hostname"));
    desk.run("render scenes/e.svg").failed(1, "scenes/e.svg:2:", &["absolute"]);
    desk.put("scenes/f.svg", scene_of("."));
    desk.run("render scenes/f.svg").failed(1, "scenes/f.svg:2:", &["regular file"]);
    assert_eq!(desk.names(), ["scenes", "secret.png"]);
}

#[cfg(unix)]
#[test]
fn a_pipe_in_an_images_place_does_not_hang_the_run() {
    let desk = Desk::with("a.svg", scene_of("pipe.png"));
    let made = std::process::Command::new("mkfifo").arg(desk.path("pipe.png")).status();
    assert!(made.is_ok_and(|s| s.success()), "mkfifo works");
    desk.run("render a.svg").failed(1, "a.svg:2:", &["regular file"]);
}

#[test]
fn a_scenes_words_cannot_command_the_terminal() {
    let desk = Desk::with("a.svg", scene_of("x&#10;y&#27;[2J.png"));
    let run = desk.run("render a.svg");
    assert_eq!(run.code, Some(1));
    assert!(!run.err.contains('\x1b'), "{:?}", run.err);
    assert_eq!(run.err.matches('\n').count(), 1);
}

#[test]
fn help_and_version_are_for_people() {
    let desk = Desk::new();
    for arguments in ["--help", "render --help", "render -h", "help render", "--version"] {
        let run = desk.run(arguments).succeeded();
        assert!(run.out.len() > 10, "{arguments}");
        assert!(run.out.is_ascii() || String::from_utf8(run.out).is_ok());
    }
    let help = String::from_utf8(desk.run("render --help").out).unwrap();
    for part in ["Size:", "Quality:", "Limits:", "Examples:", "default: 16; course: 1", "pixels"] {
        assert!(help.contains(part), "{part}");
    }
}

#[test]
fn every_shell_has_its_completions() {
    let desk = Desk::new();
    for shell in ["bash", "zsh", "fish", "elvish", "powershell"] {
        let run = desk.run(&format!("completions {shell}")).succeeded();
        let script = String::from_utf8(run.out).unwrap();
        assert!(script.contains("max-eccentricity"), "{shell}");
    }
}
