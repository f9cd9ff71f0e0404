use crate::common::{Desk, Picture, SHAPES, SQUARE};

#[test]
fn a_sheet_has_every_combination() {
    let desk = Desk::with("a.svg", SHAPES);
    desk.run("compare a.svg -o one.png --vary samples=1/16 --no-time").succeeded();
    let one = desk.picture("one.png");
    assert!(one.width > 2 * 200 && one.width < 2 * 200 + 60, "{}", one.width);
    assert!(one.height > 150 && one.height < 250, "{}", one.height);
    desk.run("compare a.svg -o two.png --vary pattern,samples=1/4/16 --no-time").succeeded();
    let two = desk.picture("two.png");
    assert!(two.width > 3 * 200 && two.height > 2 * 150);
    desk.run("compare a.svg -o two.png --vary pattern,samples=1/4/16 --no-time --columns 1")
        .succeeded();
    assert!(desk.picture("two.png").height > 6 * 150);
}

#[test]
fn the_pictures_on_it_are_those_of_render() {
    let desk = Desk::with("a.svg", SHAPES);
    desk.run(
        "compare a.svg -o sheet.png --vary samples=1/16 --no-time --crop 60,40,50,40 --scale 3",
    )
    .succeeded();
    let sheet = desk.picture("sheet.png");
    for (index, samples) in [1, 16].into_iter().enumerate() {
        let arguments = format!("render a.svg - --crop 60,40,50,40 --samples {samples}");
        let alone = Picture::decode(&desk.run(&arguments).succeeded().out);
        let left = 12 + index * (150 + 12);
        for (y, x) in (0..40).flat_map(|y| (0..50).map(move |x| (y, x))) {
            let [r, g, b, a] = alone.at(x, y);
            let over =
                |v: u8| (f64::from(v) * f64::from(a) / 255.0 + 255.0 - f64::from(a)).round() as i32;
            let found = sheet.at(left + 3 * x + 1, 12 + 3 * y + 1);
            for (v, found) in [r, g, b].into_iter().zip(found) {
                assert!((over(v) - i32::from(found)).abs() <= 1, "{samples} at {x},{y}");
            }
        }
    }
}

#[test]
fn without_times_a_sheet_repeats_itself() {
    let desk = Desk::with("a.svg", SQUARE);
    let sheet = || desk.run("compare a.svg -o - --no-time --vary samples,pixel").succeeded().out;
    assert!(sheet() == sheet());
    let timed = desk.run("compare a.svg -o - --vary samples=1").succeeded().out;
    assert!(timed != desk.run("compare a.svg -o - --vary samples=1 --no-time").succeeded().out);
}

#[test]
fn what_makes_no_sense_is_refused() {
    let desk = Desk::with("a.svg", SQUARE);
    desk.run("compare a.svg").misused("--output");
    desk.run("compare a.svg -o b.png --vary colour").misused("colour");
    desk.run("compare a.svg -o b.png --vary pixel=cubic").misused("cubic");
    desk.run("compare a.svg -o b.png --scale 0").misused("0");
    desk.run("compare a.svg -o b.png --crop 5,5,9,9").failed(2, "--crop", &[]);
    desk.run("compare none.svg -o b.png").failed(1, "none.svg: ", &[]);
    desk.run("compare a.svg -o a.svg").failed(1, "a.svg: ", &[]);
    assert_eq!(desk.names(), ["a.svg"]);
}
