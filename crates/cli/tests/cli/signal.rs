use crate::common::{Desk, Picture};

/// Stripes of four pixels, 16 × 12, as the command itself draws them.
fn desk() -> Desk {
    let bars: String =
        (0..4).map(|i| format!("<rect x=\"{}\" width=\"2\" height=\"12\"/>", 4 * i)).collect();
    let scene = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"16\" height=\"12\">\
         <rect width=\"16\" height=\"12\" fill=\"#fff\"/>{bars}</svg>"
    );
    let desk = Desk::with("stripes.svg", scene);
    desk.run("render stripes.svg stripes.png").succeeded();
    desk
}

fn grey(picture: &Picture, x: usize, y: usize) -> u8 {
    let [r, g, b, a] = picture.at(x, y);
    assert!(r == g && g == b && a == 255, "{:?}", picture.at(x, y));
    r
}

#[test]
fn a_spectrum_has_its_points_where_they_belong() {
    let desk = desk();
    desk.run("spectrum stripes.png out.png --window none").succeeded();
    let spectrum = desk.picture("out.png");
    assert_eq!((spectrum.width, spectrum.height), (16, 12));
    // The mean in the middle, and four cycles to either side.
    assert_eq!(grey(&spectrum, 8, 6), 255);
    assert!(grey(&spectrum, 12, 6) > 200 && grey(&spectrum, 4, 6) > 200);
    let lit = spectrum.pixels.iter().filter(|p| p[0] > 0).count();
    assert_eq!(lit, 3, "nothing else");
    desk.run("spectrum stripes.png color.png --window none --channel color").succeeded();
    assert!(desk.picture("color.png") == spectrum);
}

#[test]
fn bands_take_the_stripes_or_leave_them() {
    let desk = desk();
    let before = desk.picture("stripes.png");
    let filtered = |arguments: &str| {
        desk.run(&format!("filter stripes.png out.png --border repeat {arguments}")).succeeded();
        desk.picture("out.png")
    };
    assert!(filtered("--low-pass 0.6") == before);
    let flat = filtered("--low-pass 0.1");
    assert!(flat.pixels.iter().all(|p| *p == [128, 128, 128, 255]));
    let flat = filtered("--band-pass 0.3,0.4");
    assert!(flat.pixels.iter().all(|p| *p == [128, 128, 128, 255]));
    assert!(filtered("--high-pass 0.1") == before);
    // Half of the contrast is left where a Gaussian has its cutoff.
    let soft = filtered("--low-pass 0.25 --gaussian");
    let (dark, light) = (grey(&soft, 0, 5), grey(&soft, 2, 5));
    assert_eq!((dark, light), (64, 191));
}

#[test]
fn kernels_convolve() {
    let desk = desk();
    let filtered = |arguments: &str| {
        desk.run(&format!("filter stripes.png out.png {arguments}")).succeeded();
        desk.picture("out.png")
    };
    let soft = filtered("--kernel box:3");
    assert_eq!((grey(&soft, 4, 5), grey(&soft, 6, 5)), (85, 170));
    assert!(filtered("--kernel matrix:1,1,1/1,1,1/1,1,1") == soft);
    let edges = filtered("--kernel matrix:1,0,-1 --border repeat");
    assert_eq!((grey(&edges, 0, 5), grey(&edges, 2, 5)), (0, 255));
    let more = filtered("--kernel matrix:1,0,-1 --offset 0.25 --border repeat");
    assert_eq!((grey(&more, 1, 5), grey(&more, 0, 5)), (255, 0));
    for kernel in ["gaussian:1.5", "triangle:2", "mitchell:2"] {
        assert!(filtered(&format!("--kernel {kernel}")) != desk.picture("stripes.png"));
    }
}

#[test]
fn pictures_go_through_pipes_and_spaces() {
    let desk = desk();
    let png = std::fs::read(desk.path("stripes.png")).unwrap();
    let out = desk.run_with_input("filter - - --low-pass 0 --space linear", &png).succeeded().out;
    assert!(Picture::decode(&out).pixels.iter().all(|p| *p == [188, 188, 188, 255]));
    let out = desk.run_with_input("spectrum - -", &png).succeeded().out;
    assert_eq!(Picture::decode(&out).height, 12);
}

#[test]
fn what_makes_no_sense_is_refused() {
    let desk = desk();
    let refused = |arguments: &str, words: &str| {
        let run = desk.run(&format!("filter stripes.png out.png {arguments}"));
        assert_eq!(run.code, Some(2), "{arguments}");
        assert!(run.err.contains(words), "{arguments}: {}", run.err);
    };
    refused("", "required");
    refused("--low-pass 0.1 --high-pass 0.2", "cannot be used");
    refused("--low-pass -1", "cycles per pixel");
    refused("--band-pass 0.4,0.2", "ends before it begins");
    refused("--kernel box:0", "size");
    refused("--kernel round:3", "box");
    refused("--kernel matrix:1,2/1", "rows");
    refused("--kernel matrix:1,2/3,4", "odd");
    refused("--low-pass 0.1 --border clamp", "mirror or repeat");
    let run = desk.run("spectrum stripes.png out.png --range 0");
    assert_eq!(run.code, Some(2));
    desk.run("filter none.png out.png --low-pass 0.1").failed(1, "none.png: ", &[]);
    desk.run("filter stripes.svg out.png --low-pass 0.1").failed(1, "stripes.svg: ", &[]);
    desk.run("filter stripes.png stripes.svg --low-pass 0.1").failed(1, "stripes.svg: ", &[]);
    desk.run("filter stripes.png out.png --low-pass 0.1 --max-memory 8K").failed(
        3,
        "stripes.png: ",
        &[],
    );
    assert!(!desk.names().contains(&"out.png".to_owned()));
}
