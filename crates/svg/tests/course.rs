//! The course profile, rule by rule.

#![allow(clippy::unwrap_used, clippy::panic, reason = "tests")]

mod common;

use common::{course, course_text, names, read, warnings};
use scumble_geometry::DVec2;
use scumble_pixel::Straight;
use scumble_scene::{Command, ImageWrap, View};
use scumble_svg::{Profile, ProfileChoice};

const RED: Straight = Straight([1.0, 0.0, 0.0, 1.0]);

#[test]
fn the_profile_is_chosen_by_the_root_or_the_caller() {
    let of = |choice, root: &str| {
        read(
            choice,
            &format!("<svg xmlns:sc='https://scumble.rs/ns/1' width='1' height='1' {root}/>"),
        )
        .unwrap()
        .profile
    };
    assert_eq!(of(ProfileChoice::Auto, ""), Profile::Svg);
    assert_eq!(of(ProfileChoice::Auto, "sc:profile='course'"), Profile::Course);
    assert_eq!(of(ProfileChoice::Auto, "sc:profile='svg'"), Profile::Svg);
    assert_eq!(of(ProfileChoice::Auto, "profile='course'"), Profile::Svg);
    assert_eq!(of(ProfileChoice::Svg, "sc:profile='course'"), Profile::Svg);
    assert_eq!(of(ProfileChoice::Course, ""), Profile::Course);
    assert_eq!(of(ProfileChoice::Auto, "sc:profile='other'"), Profile::Svg);
}

#[test]
fn the_root_gives_size_and_background_and_nothing_else() {
    let text = "<svg width=' 272.5px' height='10cm' viewBox='0 0 1 1' transform='scale(2)'/>";
    let scene = read(ProfileChoice::Course, text).unwrap().scene;
    assert_eq!(scene.view, View::Course { size: DVec2::new(272.5, 10.0) });
    assert_eq!(scene.background, Some(Straight::WHITE));
}

#[test]
fn each_element_draws_what_it_says() {
    let of = |inside: &str| names(&course(inside));
    assert_eq!(of("<line x2='9' stroke='red'/>"), ["hairline"]);
    assert_eq!(of("<line x2='9'/>"), [""; 0]);
    assert_eq!(of("<line x2='9' stroke='none'/>"), [""; 0]);
    assert_eq!(of("<polyline points='1 2 3 4 5 6' fill='red' stroke='red'/>"), ["hairline"; 2]);
    assert_eq!(of("<polyline points='1 2 3 4 5 6' fill='red'/>"), [""; 0]);
    assert_eq!(of("<polygon points='1 2 3 4 5 6'/>"), ["fill"]);
    assert_eq!(of("<polygon points='1 2 3 4 5 6' fill='none'/>"), [""; 0]);
    let outlined = ["fill", "hairline", "hairline", "hairline"];
    assert_eq!(of("<polygon points='1 2 3 4 5 6' stroke='red'/>"), outlined);
    assert_eq!(of("<rect width='3' height='3'/>"), ["fill"]);
    let outlined = ["fill", "hairline", "hairline", "hairline", "hairline"];
    assert_eq!(of("<rect width='3' height='3' stroke='red' stroke-width='0'/>"), outlined);
    assert_eq!(of("<rect x='3'/>"), ["point"]);
    assert_eq!(of("<rect x='3' width='1'/>"), ["fill"]);
    assert_eq!(of("<image width='3' height='3' href='a.png'/>"), ["image"]);
    assert_eq!(
        of(
            "<image width='3' height='3' xlink:href='a.png' xmlns:xlink='http://www.w3.org/1999/xlink'/>"
        ),
        ["image"]
    );
    let colors = "1 0 0 1, 0 1 0 1, 0 0 9 .5";
    assert_eq!(of(&format!("<colortri points='0,0 1,0 0,1' colors='{colors}'/>")), ["gouraud"]);
    assert_eq!(of("<title/><desc/><metadata/><defs><rect/></defs><!-- c --> text"), [""; 0]);
}

#[test]
fn an_outline_goes_round_and_closes() {
    let parsed = course("<polygon points='0 0 4 0 4 3' fill='none' stroke='#ff0000'/>");
    let ends: Vec<_> = parsed
        .scene
        .commands
        .iter()
        .map(|c| match c {
            Command::Hairline(line) => (line.from.to_array(), line.to.to_array(), line.color),
            _ => panic!("{c:?}"),
        })
        .collect();
    let (a, b, c) = ([0.0, 0.0], [4.0, 0.0], [4.0, 3.0]);
    assert_eq!(ends, [(a, b, RED), (b, c, RED), (c, a, RED)]);
}

#[test]
fn colours() {
    let of = |attributes: &str| {
        let parsed = course(&format!("<rect width='3' height='3' {attributes}/>"));
        match &parsed.scene.commands[..] {
            [Command::Fill(fill)] => (fill.color.0, parsed.warnings.len()),
            other => panic!("{other:?}"),
        }
    };
    assert_eq!(of(""), ([0.0, 0.0, 0.0, 1.0], 0));
    assert_eq!(of("fill='#ff0000'"), ([1.0, 0.0, 0.0, 1.0], 0));
    assert_eq!(of("fill='#f00'"), ([1.0, 0.0, 0.0, 1.0], 0));
    assert_eq!(of("fill='ff0000'"), ([1.0, 0.0, 0.0, 1.0], 0));
    assert_eq!(of("fill='red' fill-opacity='0.25'"), ([1.0, 0.0, 0.0, 0.25], 0));
    assert_eq!(of("fill-opacity='7'"), ([0.0, 0.0, 0.0, 1.0], 0));
    assert_eq!(of("fill='nonsense'"), ([0.0, 0.0, 0.0, 1.0], 1));
}

#[test]
fn style_is_not_inherited_but_transforms_are() {
    let inside = "<g fill='red' stroke='red' transform='translate(10)'>\
        <rect width='1' height='1' transform='scale(2)'/></g>";
    match &course(inside).scene.commands[..] {
        [Command::Fill(fill)] => {
            assert_eq!(fill.color, Straight::BLACK);
            assert_eq!(fill.transform.project(DVec2::ONE), Some(DVec2::new(12.0, 2.0)));
        }
        other => panic!("{other:?}"),
    }
}

#[test]
fn texture_coordinates_are_aligned_to_texel_centres() {
    let inside = "<textri texid='t' points='0 0 1 0 0 1' uvs='0 0 1 0 0 1'/>\
        <texture texid='t' filename='a.png' sc:wrap='mirror'/>";
    let parsed = course(inside);
    // 4 × 2 texels: 0 is the middle of the first, 1 the middle of the last.
    let [Command::Textured(t)] = &parsed.scene.commands[..] else { panic!("{parsed:?}") };
    let uvs = t.uvs.map(|uv| uv.to_array());
    assert_eq!(uvs, [[0.125, 0.25], [0.875, 0.25], [0.125, 0.75]]);
    assert_eq!(parsed.scene.images[t.image.0].wrap, ImageWrap::Mirror);
    assert_eq!(
        parsed.scene.images[t.image.0].pixels.pixels()[..2],
        [[255, 0, 0, 255], [0, 0, 255, 128]]
    );
}

#[test]
fn a_texture_is_the_last_before_its_use() {
    let triangle = "<textri texid='t' points='0 0 1 0 0 1' uvs='0 0 1 0 0 1'/>";
    let texture = |wrap| format!("<texture texid='t' filename='a.png' sc:wrap='{wrap}'/>");
    let inside = [triangle, &texture("clamp"), triangle, &texture("repeat"), triangle].concat();
    let parsed = course(&inside);
    let wraps: Vec<_> = parsed
        .scene
        .commands
        .iter()
        .map(|c| match c {
            Command::Textured(t) => parsed.scene.images[t.image.0].wrap,
            _ => panic!("{c:?}"),
        })
        .collect();
    assert_eq!(wraps, [ImageWrap::Clamp, ImageWrap::Clamp, ImageWrap::Repeat]);
    assert_eq!(parsed.scene.images.len(), 2);
}

#[test]
fn what_is_ignored_is_named_once() {
    let parsed = course("\n <circle r='1'/>\n <path d=''/><circle r='2'/>\n <x:y xmlns:x='u'/>");
    assert_eq!(
        warnings(&parsed),
        [
            "2:2: `circle` is not drawn: the course's dialect has none (2 times)",
            "3:2: `path` is not drawn: the course's dialect has none",
        ]
    );
    let parsed = course("<polygon points='1 2 3 4 5 6 7'/><g transform='turn(3)'/>");
    assert_eq!(names(&parsed), ["fill"]);
    assert_eq!(parsed.warnings.len(), 2);
}

#[test]
fn perspective_is_ours_and_works_here_too() {
    let text = course_text(
        "<rect width='1' height='1' transform='matrix3d(1,0,0,1, 0,1,0,0, 0,0,1,0, 0,0,0,1)'/>",
    );
    let parsed = read(ProfileChoice::Course, &text).unwrap();
    let [Command::Fill(fill)] = &parsed.scene.commands[..] else { panic!("{parsed:?}") };
    assert_eq!(fill.transform.project(DVec2::ONE), Some(DVec2::new(0.5, 0.5)));
}
