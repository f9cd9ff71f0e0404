use crate::common::{Desk, Picture, SHAPES, SQUARE, png_file, scene_of};

const WHITE: [u8; 4] = [255; 4];
const RED: [u8; 4] = [255, 0, 0, 255];

#[test]
fn a_scene_becomes_a_picture() {
    let desk = Desk::with("a.svg", SQUARE);
    desk.run("render a.svg -o b.png").succeeded();
    assert_eq!(desk.names(), ["a.svg", "b.png"]);
    let picture = desk.picture("b.png");
    assert_eq!((picture.width, picture.height), (10, 8));
    for (i, &pixel) in picture.pixels.iter().enumerate() {
        let inside = (2..6).contains(&(i % 10)) && (1..5).contains(&(i / 10));
        assert_eq!(pixel, if inside { RED } else { WHITE }, "pixel {i}");
    }
}

#[test]
fn streams_work_at_both_ends() {
    let desk = Desk::with("a.svg", SQUARE);
    desk.run("render a.svg -o b.png").succeeded();
    let expected = std::fs::read(desk.path("b.png")).unwrap();
    assert!(desk.run("render a.svg -").succeeded().out == expected);
    assert_eq!(desk.run_with_input("render - -", SQUARE.as_bytes()).succeeded().out, expected);
    assert_eq!(desk.run_with_input("render -", SQUARE.as_bytes()).succeeded().out, expected);
    desk.run_with_input("render - -o c.png", SQUARE.as_bytes()).succeeded();
    assert_eq!(std::fs::read(desk.path("c.png")).unwrap(), expected);
}

#[test]
fn sizes_are_followed() {
    let desk = Desk::with("a.svg", SQUARE);
    for (arguments, size) in [
        ("", (10, 8)),
        ("-w 20", (20, 16)),
        ("-H 4", (5, 4)),
        ("-z 3", (30, 24)),
        ("-w 7 -H 9", (7, 9)),
        ("-w 20 -z 0.5", (10, 8)),
        ("--crop 1,1,3,2", (3, 2)),
        ("--profile course", (800, 600)),
    ] {
        let picture = Picture::decode(&desk.run(&format!("render a.svg - {arguments}")).out);
        assert_eq!((picture.width, picture.height), size, "{arguments}");
    }
}

#[test]
fn a_size_between_pixels_blurs_nothing() {
    let desk = Desk::with("a.svg", SQUARE.replacen("10", "10.5", 1));
    let picture = Picture::decode(&desk.run("render a.svg -").succeeded().out);
    assert_eq!((picture.width, picture.height), (11, 8));
    assert_eq!([1, 2, 5, 6].map(|x| picture.at(x, 1)), [WHITE, RED, RED, WHITE]);
}

#[test]
fn a_crop_is_that_part_of_the_whole() {
    let desk = Desk::with("a.svg", SHAPES);
    let render = |arguments: &str| {
        Picture::decode(&desk.run(&format!("render a.svg - -z 1.7 {arguments}")).succeeded().out)
    };
    let whole = render("");
    assert_eq!((whole.width, whole.height), (340, 255));
    for (x, y, width, height) in [(0, 0, 340, 255), (17, 33, 130, 101), (339, 254, 1, 1)] {
        let part = render(&format!("--crop {x},{y},{width},{height}"));
        assert!(part == whole.part(x, y, width, height), "{x},{y},{width},{height}");
    }
}

#[test]
fn threads_change_nothing() {
    let desk = Desk::with("a.svg", SHAPES);
    let one = desk.run("render a.svg - -j 1").succeeded().out;
    assert!(one == desk.run("render a.svg - -j 2").succeeded().out);
    assert!(one == desk.run("render a.svg - -j 7").succeeded().out);
}

#[test]
fn the_background_can_be_chosen() {
    let empty = r#"<svg xmlns="http://www.w3.org/2000/svg" width="2" height="2"/>"#;
    let desk = Desk::with("a.svg", empty);
    let corner = |arguments: &str| {
        Picture::decode(&desk.run(&format!("render a.svg - {arguments}")).succeeded().out).at(0, 0)
    };
    assert_eq!(corner("")[3], 0);
    assert_eq!(corner("--background none")[3], 0);
    assert_eq!(corner("--background tomato"), [0xff, 0x63, 0x47, 255]);
    assert_eq!(corner("--background #08f"), [0, 0x88, 255, 255]);
    assert_eq!(corner("--profile course"), [255; 4]);
}

#[test]
fn quality_options_reach_the_picture() {
    let desk = Desk::with("a.svg", SHAPES);
    let render = |arguments: &str| desk.run(&format!("render a.svg - {arguments}")).succeeded().out;
    let plain = render("");
    assert!(plain != render("--samples 1"));
    assert!(plain != render("--pattern grid"));
    assert!(plain != render("--space linear"));
    assert!(plain == render("--samples 16 --pattern standard --shade pixel --space srgb"));
}

#[test]
fn images_come_from_the_scenes_folder_or_an_allowed_one() {
    let desk = Desk::with("scenes/a.svg", scene_of("grey.png"));
    desk.put("scenes/grey.png", png_file(4));
    desk.put("scenes/b.svg", scene_of("../images/grey.png"));
    desk.put("images/grey.png", png_file(4));
    let grey = [128, 128, 128, 255];
    let run = desk.run("render scenes/a.svg -").succeeded();
    assert_eq!(Picture::decode(&run.out).at(3, 3), grey);
    let run = desk.run("render scenes/b.svg - --resources elsewhere --resources images");
    run.failed(1, "elsewhere: ", &[]);
    let run = desk.run("render scenes/b.svg - --resources images").succeeded();
    assert_eq!(Picture::decode(&run.out).at(3, 3), grey);
}

#[test]
fn a_scene_on_standard_input_starts_from_the_current_folder() {
    let desk = Desk::with("images/grey.png", png_file(4));
    let scene = scene_of("images/grey.png");
    let run = desk.run_with_input("render - -", scene.as_bytes()).succeeded();
    assert_eq!(Picture::decode(&run.out).at(3, 3), [128, 128, 128, 255]);
}
