use crate::common::{Desk, Picture};
use serde_json::Value;

/// A PNG of RGB pixels.
fn rgb(width: u32, height: u32, pixel: impl Fn(u32, u32) -> [u8; 3]) -> Vec<u8> {
    let pixels = (0..height).flat_map(|y| (0..width).map(move |x| (x, y)));
    let pixels: Vec<u8> = pixels.flat_map(|(x, y)| pixel(x, y)).collect();
    let mut data = Vec::new();
    let mut encoder = png::Encoder::new(&mut data, width, height);
    encoder.set_color(png::ColorType::Rgb);
    let mut writer = encoder.write_header().expect("a header");
    writer.write_image_data(&pixels).expect("pixels");
    writer.finish().expect("an end");
    data
}

/// 60 × 40, each pixel another colour, and smooth.
fn ramp() -> Vec<u8> {
    rgb(60, 40, |x, y| [40 + 3 * x as u8, 30 + 4 * y as u8, 128])
}

const IDENTITY: &str = "--matrix 1,0,0,0,1,0,0,0,1";

fn near(a: [u8; 4], b: [u8; 4]) -> bool {
    a.iter().zip(b).all(|(a, b)| a.abs_diff(b) <= 2)
}

#[test]
fn the_identity_leaves_a_smooth_picture_alone() {
    let desk = Desk::with("a.png", ramp());
    desk.run(&format!("warp a.png b.png {IDENTITY} --border clamp")).succeeded();
    let (a, b) = (desk.picture("a.png"), desk.picture("b.png"));
    assert_eq!((b.width, b.height), (60, 40));
    assert!(a.pixels.iter().zip(&b.pixels).all(|(a, b)| near(*a, *b)));
}

#[test]
fn corners_go_where_they_are_sent() {
    let desk = Desk::with("a.png", ramp());
    let run = |more: &str| {
        let mut command = desk.command("warp a.png b.png --force");
        command.args(["--to", "10,5 130,5 130,85 10,85"]).args(more.split_whitespace());
        let output = command.output().expect("the command starts");
        assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
        desk.picture("b.png")
    };
    let whole = run("");
    assert_eq!((whole.width, whole.height), (130, 85));
    assert_eq!(whole.at(5, 40), [0; 4]);
    // Twice as large: output (70, 45) is the middle.
    assert!(near(whole.at(70, 45), [40 + 90, 30 + 80, 128, 255]), "{:?}", whole.at(70, 45));
    let part = run("--crop 20,10,50,30 -j 1");
    assert_eq!(part, Picture { width: 50, height: 30, ..whole.part(20, 10, 50, 30) });
    let sized = run("--size 200x90 --border #00f");
    assert_eq!((sized.width, sized.at(180, 80)), (200, [0, 0, 255, 255]));
}

#[test]
fn matrices_have_a_direction_and_an_origin() {
    // Black left of column 2, white from there on.
    let edge = rgb(4, 4, |x, _| if x < 2 { [0; 3] } else { [255; 3] });
    let desk = Desk::with("a.png", edge);
    let middle = |arguments: &str| {
        desk.run(&format!("warp a.png b.png --size 32x32 --border clamp --force {arguments}"))
            .succeeded();
        let row: Vec<u8> = (0..32).map(|x| desk.picture("b.png").at(x, 16)[0]).collect();
        // Where black becomes white, in the space between pixels.
        row.iter().filter(|v| **v < 188).count()
    };
    assert_eq!(middle("--matrix 8,0,0,0,8,0,0,0,1"), 16);
    assert_eq!(middle("--matrix 0.125,0,0,0,0.125,0,0,0,1 --inverse"), 16);
    // Known but for its scale, and that is negative.
    assert_eq!(middle("--matrix -8,0,0,0,-8,0,0,0,-1"), 16);
    // (x + ½)·8 − ½ from centre to centre would be 16; the matrix alone is less by 3½.
    let found = middle("--matrix 8,0,0,0,8,0,0,0,1 --pixel-origin center");
    assert!((12..=13).contains(&found), "{found}");
}

#[test]
fn a_page_comes_back_straight() {
    // A page of 300 by 200 with stripes, on grey, seen at an angle.
    let desk =
        Desk::with("page.png", rgb(300, 200, |x, _| [if x / 25 % 2 == 0 { 250 } else { 20 }; 3]));
    let points = "40,60 330,30 370,290 20,240";
    let warp = |arguments: [&str; 7]| {
        let output = desk.command("warp").args(arguments).output().expect("the command starts");
        assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    };
    warp(["page.png", "photo.png", "--to", points, "--size=400x300", "--border=gray", "-q"]);
    warp(["photo.png", "back.png", "--rectify", points, "--size=300x200", "-q", "-j1"]);
    let (page, back) = (desk.picture("page.png"), desk.picture("back.png"));
    for y in (10..190).step_by(20) {
        for x in (12..300).step_by(25) {
            assert!(page.at(x, y)[0].abs_diff(back.at(x, y)[0]) <= 3, "{x} {y}");
        }
    }
}

#[test]
fn a_page_has_its_own_shape_again() {
    // A sheet of A4 as a camera of 2100 pixels of focal length sees it from above at an angle.
    let desk = Desk::with("photo.png", rgb(2400, 1800, |_, _| [200; 3]));
    let corners = [(1084.30, 531.98), (1807.05, 633.40), (1478.99, 1654.60), (492.73, 1338.32)];
    let ratio = |off: f64, signs: [f64; 8]| {
        let points: Vec<String> = corners
            .iter()
            .zip(signs.as_chunks().0)
            .map(|((x, y), [a, b])| format!("{},{}", x + off * a, y + off * b))
            .collect();
        let mut command = desk.command("warp photo.png page.png --json --force");
        let output = command.args(["--rectify", &points.join(" ")]).output().expect("a run");
        let report: Value = serde_json::from_slice(&output.stdout).expect("JSON");
        let side = |name: &str| report[name].as_f64().expect("a number");
        side("height") / side("width")
    };
    let exact = f64::sqrt(2.0);
    let signs = [1.0, 1.0, -1.0, 1.0, -1.0, 1.0, 1.0, -1.0];
    assert!((ratio(0.0, signs) / exact - 1.0).abs() < 0.002);
    // Clicked two pixels off.
    for signs in [signs, signs.map(|s| -s), [1.0, -1.0, -1.0, -1.0, 1.0, -1.0, -1.0, -1.0]] {
        assert!((ratio(2.0, signs) / exact - 1.0).abs() < 0.015, "{}", ratio(2.0, signs));
    }
}

#[test]
fn depth_and_format_follow_the_name_and_the_words() {
    let desk = Desk::with("a.png", ramp());
    desk.run(&format!("warp a.png b.png {IDENTITY} --depth 16 --border clamp")).succeeded();
    let file = std::fs::read(desk.path("b.png")).expect("a picture");
    let reader = png::Decoder::new(std::io::Cursor::new(file)).read_info().expect("a PNG");
    let info = reader.info();
    assert_eq!((info.bit_depth, info.color_type), (png::BitDepth::Sixteen, png::ColorType::Rgb));
    desk.run(&format!("warp a.png c.jpg {IDENTITY} --border clamp")).succeeded();
    desk.run(&format!("warp a.png d.exr {IDENTITY} --depth float")).succeeded();
    desk.run(&format!("warp d.exr e.png {IDENTITY} --border clamp --depth 8")).succeeded();
    let (a, e) = (desk.picture("a.png"), desk.picture("e.png"));
    assert!(near(a.at(30, 20), e.at(30, 20)));
    let jpeg = desk.run(&format!("warp a.png f.jpg {IDENTITY}"));
    jpeg.failed(2, "JPEG has no alpha", &["--border"]);
    desk.run(&format!("warp a.png f.bmp {IDENTITY}")).failed(2, "f.bmp", &[".png"]);
    desk.run(&format!("warp a.png f.exr {IDENTITY} --depth 8")).failed(2, "OpenEXR", &["8-bit"]);
    assert_eq!(desk.names(), ["a.png", "b.png", "c.jpg", "d.exr", "e.png"]);
}

#[test]
fn standard_streams_are_pictures() {
    let desk = Desk::new();
    let run = desk.run_with_input(&format!("warp - - {IDENTITY} --border clamp"), &ramp());
    let picture = Picture::decode(&run.succeeded().out);
    assert_eq!((picture.width, picture.height), (60, 40));
}

#[test]
fn verify_says_how_exact_it_is() {
    let desk =
        Desk::with("a.png", rgb(90, 90, |x, y| [(x * x + 3 * y * y) as u8, x as u8, y as u8]));
    let arguments = "warp a.png b.png --matrix 0.5,0.1,0,-0.1,0.5,20,0,0,1 --space srgb --force";
    let told = desk.run(&format!("{arguments} --verify")).succeeded();
    let told = String::from_utf8(told.out).expect("words");
    assert!(told.contains("inside the picture: ") && told.contains(" dB, at worst "), "{told}");
    let report = desk.run(&format!("{arguments} --verify --json -j 1")).succeeded();
    let report: Value = serde_json::from_slice(&report.out).expect("JSON");
    let psnr = report["verify"]["inside"]["gaussian"]["psnr_db"].as_f64().expect("a number");
    assert!(psnr > 40.0, "{psnr}");
    assert!(told.contains(&format!("{psnr:.1} dB")), "{told} {psnr}");
    assert_eq!((report["threads"].as_u64(), report["width"].as_u64()), (Some(1), Some(54)));
    for time in ["decode_ms", "warp_ms", "encode_ms"] {
        assert!(report[time].as_f64().is_some_and(|ms| ms > 0.0), "{time}");
    }
}

#[test]
fn a_map_says_where_each_pixel_comes_from() {
    let desk = Desk::with("a.png", ramp());
    // Mirrored, and nothing in the first column.
    exr::prelude::write_rgb_file(desk.path("map.exr"), 60, 40, |x, y| {
        let column = if x == 0 { f32::NAN } else { 59.5 - x as f32 };
        (column, y as f32 + 0.5, 0.0_f32)
    })
    .expect("a map");
    desk.run("warp a.png b.png --map map.exr").succeeded();
    let (a, b) = (desk.picture("a.png"), desk.picture("b.png"));
    assert!(near(b.at(50, 20), a.at(9, 20)) && near(b.at(5, 30), a.at(54, 30)));
    assert_eq!(b.at(0, 20), [0; 4]);
    desk.run("warp a.png c.png --map map.exr --size 61x40").failed(
        2,
        "--size 61x40",
        &["60 by 40"],
    );
    desk.run("warp a.png c.png --map a.png").failed(1, "a.png", &["floats"]);
    desk.run("warp a.png c.png --map none.exr").failed(1, "none.exr: No such file", &[]);
    // The map is read, too, and may be what is piped.
    let map = std::fs::read(desk.path("map.exr")).expect("the map");
    desk.run("warp a.png map.exr --map map.exr").failed(1, "map.exr: it is what is read", &[]);
    assert!(map == std::fs::read(desk.path("map.exr")).expect("the map"));
    desk.run_with_input("warp a.png c.png --map -", &map).succeeded();
    assert_eq!(desk.picture("c.png"), b);
    desk.run_with_input("warp - c.png --map -", &map).failed(2, "only one", &["--map"]);
}

#[test]
fn a_maps_alpha_says_where_it_holds() {
    let desk = Desk::with("a.png", ramp());
    let map = |alpha: fn(usize) -> f32| {
        exr::prelude::write_rgba_file(desk.path("map.exr"), 60, 40, |x, y| {
            (x as f32 + 0.5, y as f32 + 0.5, 0.0_f32, alpha(x))
        })
        .expect("a map");
        desk.run("warp a.png b.png --map map.exr").succeeded();
        desk.picture("b.png")
    };
    let half = map(|x| if x < 30 { 1.0 } else { 0.25 });
    assert_eq!((half.at(20, 20)[3], half.at(40, 20)), (255, [0; 4]));
    // One that is empty, or none at all, says nothing.
    assert_eq!(map(|_| 0.0).at(40, 20)[3], 255);
    assert_eq!(map(|_| f32::NAN).at(40, 20)[3], 255);
}

#[test]
fn what_cannot_be_warped_is_told_in_a_line() {
    let desk = Desk::with("a.png", ramp());
    let quad = |way: &str, points: &str| {
        let output = desk.command("warp a.png b.png").args([way, points]).output();
        let output = output.expect("the command starts");
        let told = String::from_utf8(output.stderr).expect("words");
        assert_eq!(told.matches('\n').count(), 1, "{told}");
        (output.status.code(), told)
    };
    let crossed = "0,0 10,10 10,0 0,10";
    for way in ["--to", "--rectify"] {
        let (code, told) = quad(way, crossed);
        assert!(code == Some(2) && told.contains(way) && told.contains("not convex"), "{told}");
        let (code, told) = quad(way, "0,0 5,0 10,0 0,10");
        assert!(code == Some(2) && told.contains("on a line"), "{told}");
    }
    let (code, told) = quad("--rectify", "0,0 0,30 50,30 50,0");
    assert!(code == Some(2) && told.contains("counterclockwise"), "{told}");

    let fails = |arguments: &str, code: i32, start: &str, part: &str| {
        desk.run(&format!("warp a.png b.png {arguments}")).failed(code, start, &[part]);
    };
    fails("--matrix 1,2,3,2,4,6,0,0,1", 2, "--matrix", "singular");
    fails("--matrix 1,0,0,0,1,0,-0.05,0,1", 2, "", "--size");
    fails("--matrix 1,0,-900,0,1,0,0,0,1", 2, "", "--size");
    fails("--matrix 9999,0,0,0,9999,0,0,0,1", 3, "", "--max-pixels");
    fails("--matrix 1e9,0,0,0,1,0,0,0,1", 3, "", "at most");
    fails(&format!("{IDENTITY} --max-memory 1K"), 3, "a.png", "--max-memory");
    fails(&format!("{IDENTITY} --max-pixels 100"), 3, "a.png", "--max-pixels");
    fails(&format!("{IDENTITY} --crop 50,0,20,20"), 2, "--crop 50,0,20,20", "60 by 40");
    desk.run(&format!("warp none.png b.png {IDENTITY}")).failed(1, "none.png: No such file", &[]);
    desk.put("c.png", &ramp()[..100]);
    desk.run(&format!("warp c.png b.png {IDENTITY}")).failed(1, "c.png", &[]);
    desk.run(&format!("warp a.png - --json {IDENTITY}")).failed(2, "--json", &[]);
    assert_eq!(desk.names(), ["a.png", "c.png"]);
}

#[test]
fn wrong_words_are_a_usage_error() {
    let desk = Desk::with("a.png", ramp());
    desk.run("warp a.png b.png").misused("--rectify");
    desk.run(&format!("warp a.png b.png {IDENTITY} --map m.exr")).misused("cannot be used with");
    desk.run("warp a.png b.png --matrix 1,2,3").misused("nine");
    desk.run("warp a.png b.png --to 1,2,3,4").misused("eight");
    let from = desk.run(&format!("warp a.png b.png {IDENTITY} --from 1,2,3,4,5,6,7,9"));
    from.failed(2, "--from is for --to", &[]);
    let inverse = desk.run("warp a.png b.png --rectify 0,0,9,0,9,9,0,9 --inverse");
    inverse.failed(2, "--inverse is for --matrix", &[]);
    desk.run(&format!("warp a.png b.png {IDENTITY} --border sideways")).misused("mirror");
    desk.run(&format!("warp a.png b.png {IDENTITY} --size big")).misused("1280x720");
    desk.run(&format!("warp a.png b.png {IDENTITY} --depth 12")).misused("16");
    assert_eq!(desk.names(), ["a.png"]);
}
