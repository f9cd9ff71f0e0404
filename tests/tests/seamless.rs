//! Slivers and needles: a picture of a mesh of them has no seams, and at 16 samples its coverage is
//! close to the exact area.

use scumble::coverage::{AreaSink, SamplePattern, Scratch, Shape};
use scumble::geometry::{DVec2, Homography, IntRect};
use scumble::pixel::Straight;
use scumble::scene::{Command, Fill, Scene, View};
use scumble::{Settings, render_image};
use scumble_svg::{Options, parse};
use scumble_tests::{samples_of, scenes_folder};

/// Neither a multiple of the scenes' size nor close to one: vertices fall anywhere in a pixel.
const SIDE: u32 = 611;
const CANVAS: IntRect = IntRect::new(0, 0, SIDE as i32, SIDE as i32);

/// The scene in black on white, without the frame that its view would draw, in the upper left of the
/// canvas: its lower and its right edge fall within pixels.
fn black(name: &str) -> (Scene, Homography) {
    let text = std::fs::read(scenes_folder().join(name)).expect("the scene is there");
    let mut scene = parse(&text, &Options::default()).expect("a scene").scene;
    scene.view = View::Fit { size: scene.view.size() * 1.1 };
    scene.background = Some(Straight::WHITE);
    for command in &mut scene.commands {
        if let Command::Fill(fill) = command {
            fill.color = Straight::BLACK;
        }
    }
    assert_eq!(fills(&scene).count(), scene.commands.len(), "{name}: polygons only");
    let view = scene.view.homography(SIDE, SIDE);
    (scene, view)
}

fn contours(fill: &Fill, view: &Homography) -> Vec<Vec<DVec2>> {
    let contours = fill.path.flatten(&(*view * fill.transform), 1.0);
    contours.iter().map(<[DVec2]>::to_vec).collect()
}

fn shape(fill: &Fill, view: &Homography) -> Option<Shape> {
    let contours = contours(fill, view);
    Shape::polygon(contours.iter().map(Vec::as_slice), fill.rule).expect("finite corners")
}

fn fills(scene: &Scene) -> impl Iterator<Item = &Fill> {
    scene.commands.iter().filter_map(|command| match command {
        Command::Fill(fill) => Some(fill),
        _ => None,
    })
}

/// The sum of the areas of shapes, pixel by pixel.
struct Areas(Vec<f64>);

impl Areas {
    fn new() -> Self {
        Self(vec![0.0; (SIDE * SIDE) as usize])
    }

    fn at(&mut self, x: i32, y: i32) -> &mut f64 {
        &mut self.0[y as usize * SIDE as usize + x as usize]
    }

    fn add(&mut self, shape: Option<&Shape>) {
        if let Some(shape) = shape {
            shape.rasterize_area(CANVAS, &mut Scratch::new(), self);
        }
    }
}

impl AreaSink for Areas {
    fn run(&mut self, y: i32, x0: i32, x1: i32) {
        (x0..x1).for_each(|x| *self.at(x, y) += 1.0);
    }

    fn pixel(&mut self, x: i32, y: i32, area: f32) {
        *self.at(x, y) += f64::from(area);
    }
}

fn sixteen() -> SamplePattern {
    SamplePattern::standard(16).expect("a standard pattern")
}

/// The parts of the pixels that the driver's picture shows black.
fn coverage(scene: &Scene) -> Vec<f64> {
    let mut settings = Settings::new(SIDE, SIDE);
    settings.pattern = sixteen();
    let picture = render_image(scene, &settings).expect("a picture");
    picture.pixels().iter().map(|pixel| 1.0 - f64::from(pixel[0]) / 255.0).collect()
}

const SCENES: [&str; 2] = ["degenerate_fan.svg", "degenerate_mesh.svg"];

/// How far the picture's coverage is from the areas in the mean: over the pixels that are covered in
/// part, and over all.
fn compare(name: &str, covered: &[f64], areas: &[f64]) -> (f64, f64) {
    let off = |(covered, area): (&f64, &f64)| (covered - area).abs();
    let pairs = || covered.iter().zip(areas);
    let partly = |&(_, area): &(&f64, &f64)| (1e-6..1.0 - 1e-6).contains(area);
    let count = pairs().filter(partly).count();
    let on_edges = pairs().filter(partly).map(off).sum::<f64>() / count as f64;
    let over_all = pairs().map(off).sum::<f64>() / areas.len() as f64;
    println!("{name}: {on_edges:.4} over {count} pixels covered in part, {over_all:.5} over all");
    (on_edges, over_all)
}

#[test]
fn no_background_shows_through_a_mesh() {
    for name in SCENES {
        let (scene, view) = black(name);
        let mut areas = Areas::new();
        fills(&scene).for_each(|fill| areas.add(shape(fill, &view).as_ref()));
        // Where the second fan lies over the first, the sum exceeds the pixel.
        areas.0.iter_mut().for_each(|area| *area = area.min(1.0));
        let inside = areas.0.iter().filter(|&&area| area > 0.999_99).count();
        assert!(inside > 300_000, "{name}: {inside} pixels are inside");
        let covered = coverage(&scene);
        for (at, (covered, area)) in covered.iter().zip(&areas.0).enumerate() {
            if *area > 0.999_99 || *area == 0.0 {
                assert_eq!(*covered, area.round(), "{name}: pixel {at}, area {area}");
            }
        }
        let (on_edges, over_all) = compare(name, &covered, &areas.0);
        assert!(over_all <= 0.02, "{name}: {over_all}");
        // The outline is upright and level there, and 16 columns and rows of samples see it.
        assert!(on_edges <= 1.0 / 16.0, "{name}: {on_edges}");
    }
}

#[test]
fn every_other_needle_covers_what_the_areas_add_up_to() {
    for name in SCENES {
        for odd in [0, 1] {
            let (mut scene, view) = black(name);
            // The first mesh of each scene alone: the rest lies over it or has no area.
            scene.commands.truncate(if name.contains("fan") { 360 } else { 392 });
            let pieces = scene.commands.into_iter().skip(odd).step_by(2).collect();
            scene.commands = pieces;
            let mut areas = Areas::new();
            fills(&scene).for_each(|fill| areas.add(shape(fill, &view).as_ref()));
            // Several edges cross most of these pixels, and each has an error of its own.
            let (on_edges, _) = compare(name, &coverage(&scene), &areas.0);
            assert!(on_edges <= 0.04, "{name}: {on_edges}");
        }
    }
}

/// Whether a segment meets the closed square of a pixel.
fn crosses(a: DVec2, b: DVec2, x: i32, y: i32) -> bool {
    let (low, high) = (DVec2::new(f64::from(x), f64::from(y)), DVec2::ONE);
    let (mut t0, mut t1) = (0.0f64, 1.0f64);
    for (from, step, near) in [(a.x, b.x - a.x, low.x), (a.y, b.y - a.y, low.y)] {
        let far = near + high.x;
        if step == 0.0 {
            if from < near || from > far {
                return false;
            }
        } else {
            let (p, q) = ((near - from) / step, (far - from) / step);
            (t0, t1) = (t0.max(p.min(q)), t1.min(p.max(q)));
        }
    }
    t0 <= t1
}

#[test]
fn where_one_edge_crosses_a_pixel_sixteen_samples_are_off_by_three_at_the_most() {
    let pattern = sixteen();
    let (mut looked, mut worst) = (0, 0.0f64);
    for name in SCENES {
        let (scene, view) = black(name);
        // Every eleventh will do, and they come in all directions.
        for fill in fills(&scene).step_by(11) {
            let Some(shape) = shape(fill, &view) else { continue };
            let owned = samples_of(Some(&shape), CANVAS, &pattern);
            let mut areas = Areas::new();
            areas.add(Some(&shape));
            let corners: Vec<DVec2> = contours(fill, &view)
                .concat()
                .iter()
                .map(|p| (*p * 256.0 + 0.5).floor() / 256.0)
                .collect();
            let bounds = shape.bounds();
            for y in bounds.y0..bounds.y1 {
                for x in bounds.x0..bounds.x1 {
                    let next = corners.iter().cycle().skip(1);
                    let edges = corners.iter().zip(next).filter(|(a, b)| crosses(**a, **b, x, y));
                    if edges.count() == 1 {
                        let samples = f64::from(owned.mask(x, y).count_ones());
                        let off = (samples / 16.0 - *areas.at(x, y)).abs();
                        worst = worst.max(off);
                        looked += 1;
                        assert!(off <= 3.0 / 16.0, "{name}: ({x}, {y}) is off by {off}");
                    }
                }
            }
        }
    }
    println!("{looked} pixels with one edge, off by {worst:.4} at the most");
    assert!(looked > 1000, "{looked} pixels");
}
