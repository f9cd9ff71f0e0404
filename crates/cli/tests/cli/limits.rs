use crate::common::{Desk, SQUARE, png_file, scene_of};

fn scene(width: &str, height: &str) -> String {
    format!(r#"<svg xmlns="http://www.w3.org/2000/svg" width="{width}" height="{height}"/>"#)
}

#[test]
fn a_canvas_beyond_all_measure_is_a_limit() {
    let desk = Desk::with("a.svg", scene("1000000", "1000000"));
    desk.run("render a.svg").failed(3, "", &["1000000 by 1000000", "--max-pixels"]);
    desk.put("b.svg", scene("1e30", "1"));
    let run = desk.run("render b.svg");
    assert!(matches!(run.code, Some(1 | 3)), "{}", run.err);
    desk.put("c.svg", SQUARE);
    desk.run("render c.svg -z 2147483647").failed(3, "", &[]);
    desk.run("render c.svg --max-pixels 79").failed(3, "", &["80", "--max-pixels"]);
    desk.run("render c.svg --max-pixels 80 -o out.png").succeeded();
    assert_eq!(desk.names(), ["a.svg", "b.svg", "c.svg", "out.png"]);
}

#[test]
fn an_image_that_unpacks_beyond_the_limit_is_refused_by_its_header() {
    let mut bomb = Vec::new();
    let mut writer = png::Encoder::new(&mut bomb, 60_000, 60_000).write_header().unwrap();
    writer.write_chunk(png::chunk::IDAT, &[0x78, 0x9c]).unwrap();
    drop(writer);
    let desk = Desk::with("bomb.png", bomb);
    desk.put("a.svg", scene_of("bomb.png"));
    desk.run("render a.svg").failed(3, "a.svg:2:", &["bomb.png"]);
    desk.put("small.png", png_file(40));
    desk.put("b.svg", scene_of("small.png"));
    desk.run("render b.svg --max-pixels 1599").failed(3, "b.svg:2:", &["small.png"]);
    desk.run("render b.svg --max-pixels 1600 -o b.png").succeeded();
}

#[test]
fn images_count_towards_the_memory() {
    let desk = Desk::with("a.svg", scene_of("large.png"));
    desk.put("large.png", png_file(1000));
    desk.run("render a.svg --max-memory 1M").failed(3, "a.svg", &[]);
    desk.run("render a.svg --max-memory 1G -o a.png").succeeded();
}

#[test]
fn a_text_that_is_too_long_is_not_read_to_its_end() {
    let desk = Desk::with("a.svg", format!("{SQUARE}<!--{}-->", "x".repeat(300_000)));
    desk.run("render a.svg --max-memory 2M").failed(3, "a.svg", &["--max-memory"]);
}

#[test]
fn a_device_without_end_is_cut_off() {
    if cfg!(target_os = "linux") {
        let desk = Desk::new();
        let run = desk.run("render /dev/zero -o a.png --max-memory 16M");
        run.failed(3, "/dev/zero", &["--max-memory"]);
    }
}
