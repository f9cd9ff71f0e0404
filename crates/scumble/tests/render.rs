//! What the driver promises, checked on small scenes whose pictures are known.

use proptest::prelude::*;
use scumble::coverage::SamplePattern;
use scumble::geometry::{Affine, DVec2, FillRule, Homography, IntRect, Path, Rect};
use scumble::pixel::{Image, Straight};
use scumble::scene::{
    Command, Fill, GouraudTriangle, ImageId, ImageQuad, ImageWrap, Point, Scene, SceneImage, View,
};
use scumble::{
    Antialias, Background, Control, ImageSink, RenderError, Settings, Sink, render, render_image,
};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, AtomicU32, Ordering};

const RED: Straight = Straight([1.0, 0.0, 0.0, 1.0]);
const BLUE: Straight = Straight([0.0, 0.0, 1.0, 1.0]);

fn scene(commands: Vec<Command>) -> Scene {
    Scene {
        view: View::Fit { size: DVec2::new(64.0, 48.0) },
        background: Some(Straight::WHITE),
        images: vec![checker()],
        commands,
    }
}

#[allow(clippy::unwrap_used)] // a helper of tests
fn checker() -> SceneImage {
    let pixels = (0..64).map(|i| if (i + i / 8) % 2 == 0 { [255; 4] } else { [0, 0, 0, 255] });
    SceneImage { pixels: Image::from_vec(8, 8, pixels.collect()).unwrap(), wrap: ImageWrap::Clamp }
}

fn rect(x0: f64, y0: f64, x1: f64, y1: f64, color: Straight) -> Command {
    Command::Fill(Fill {
        path: Arc::new(Path::rect(Rect::new(x0, y0, x1, y1))),
        rule: FillRule::NonZero,
        transform: Homography::IDENTITY,
        color,
    })
}

fn at(image: &Image<[u8; 4]>, x: usize, y: usize) -> [u8; 4] {
    image.row(y)[x]
}

#[test]
fn a_rectangle_covers_its_pixels_and_half_of_those_that_it_halves() {
    let picture =
        render_image(&scene(vec![rect(8.0, 8.0, 16.5, 16.0, RED)]), &Settings::new(64, 48))
            .unwrap();
    assert_eq!(at(&picture, 7, 8), [255; 4]);
    assert_eq!(at(&picture, 8, 8), [255, 0, 0, 255]);
    assert_eq!(at(&picture, 15, 15), [255, 0, 0, 255]);
    assert_eq!(at(&picture, 16, 12), [255, 128, 128, 255]);
    assert_eq!(at(&picture, 17, 12), [255; 4]);
    assert_eq!(at(&picture, 8, 16), [255; 4]);
}

#[test]
fn later_commands_lie_on_top() {
    let commands = vec![rect(0.0, 0.0, 9.0, 9.0, RED), rect(0.0, 0.0, 9.0, 9.0, BLUE)];
    let picture = render_image(&scene(commands), &Settings::new(64, 48)).unwrap();
    assert_eq!(at(&picture, 4, 4), [0, 0, 255, 255]);
}

#[test]
fn a_group_fades_as_one() {
    let commands = vec![
        Command::PushLayer { opacity: 0.5 },
        rect(0.0, 0.0, 20.0, 20.0, RED),
        rect(10.0, 0.0, 30.0, 20.0, BLUE),
        Command::PopLayer,
        rect(40.0, 0.0, 50.0, 20.0, RED),
    ];
    let picture = render_image(&scene(commands), &Settings::new(64, 48)).unwrap();
    assert_eq!(at(&picture, 5, 5), [255, 128, 128, 255]);
    // Where they overlap, the red below does not show through the blue.
    assert_eq!(at(&picture, 15, 5), [128, 128, 255, 255]);
    assert_eq!(at(&picture, 45, 5), [255, 0, 0, 255]);
}

#[test]
fn groups_nest() {
    let commands = vec![
        Command::PushLayer { opacity: 0.5 },
        Command::PushLayer { opacity: 0.5 },
        rect(0.0, 0.0, 20.0, 20.0, RED),
        Command::PopLayer,
        Command::PushLayer { opacity: 1.0 },
        rect(30.0, 0.0, 40.0, 20.0, RED),
        Command::PopLayer,
        Command::PopLayer,
    ];
    let picture = render_image(&scene(commands), &Settings::new(64, 48)).unwrap();
    assert_eq!(at(&picture, 5, 5), [255, 191, 191, 255]);
    assert_eq!(at(&picture, 35, 5), [255, 128, 128, 255]);
}

#[test]
fn an_image_drawn_texel_to_pixel_is_itself() {
    let quad = Command::Image(ImageQuad {
        image: ImageId(0),
        rect: Rect::new(4.0, 4.0, 12.0, 12.0),
        source: Rect::new(0.0, 0.0, 1.0, 1.0),
        pixelated: true,
        opacity: 1.0,
        transform: Homography::IDENTITY,
    });
    let picture = render_image(&scene(vec![quad]), &Settings::new(64, 48)).unwrap();
    for y in 0..8 {
        for x in 0..8 {
            assert_eq!(at(&picture, x + 4, y + 4), checker().pixels.row(y)[x], "({x}, {y})");
        }
    }
}

#[test]
fn a_point_is_the_whole_pixel_that_holds_it() {
    let point = Command::Point(Point {
        position: DVec2::new(10.9, 20.1),
        color: RED,
        transform: Homography::IDENTITY,
    });
    let picture = render_image(&scene(vec![point]), &Settings::new(64, 48)).unwrap();
    let red = picture.pixels().iter().filter(|&&p| p != [255; 4]).count();
    assert_eq!((at(&picture, 10, 20), red), ([255, 0, 0, 255], 1));
}

#[test]
fn nothing_but_a_background() {
    let mut settings = Settings::new(5, 3);
    settings.background = Background::Transparent;
    let picture = render_image(&scene(vec![]), &settings).unwrap();
    assert_eq!((picture.width(), picture.height()), (5, 3));
    assert!(picture.pixels().iter().all(|&p| p == [0; 4]));
}

#[test]
fn impossible_settings_are_refused() {
    let empty = scene(vec![]);
    let refuse = |settings: &Settings| render_image(&empty, settings).unwrap_err();
    assert!(matches!(refuse(&Settings::new(0, 5)), RenderError::Canvas { .. }));
    assert!(matches!(refuse(&Settings::new(5, u32::MAX)), RenderError::Canvas { .. }));
    let mut settings = Settings::new(5, 5);
    settings.crop = Some(IntRect::new(5, 0, 9, 9));
    assert!(matches!(refuse(&settings), RenderError::Crop { .. }));
    let mut settings = Settings::new(5, 5);
    settings.tile_size = 1000;
    assert!(matches!(refuse(&settings), RenderError::TileSize(1000)));
    let mut settings = Settings::new(5, 5);
    settings.max_memory = 10;
    assert!(matches!(refuse(&settings), RenderError::Memory { limit: 10, .. }));
}

#[test]
fn a_caller_can_watch_and_stop() {
    let seen = AtomicU32::new(0);
    let progress = |p: scumble::Progress| {
        assert!(p.rows_done > seen.swap(p.rows_done, Ordering::SeqCst));
        assert_eq!(p.rows, 300);
    };
    let control = Control { progress: Some(&progress), cancel: None };
    let settings = Settings::new(100, 300);
    render(&scene(vec![]), &settings, &mut ImageSink::new(), &control).unwrap();
    assert_eq!(seen.load(Ordering::SeqCst), 300);

    let cancel = AtomicBool::new(true);
    let control = Control { progress: None, cancel: Some(&cancel) };
    let outcome = render(&scene(vec![]), &settings, &mut ImageSink::new(), &control);
    assert!(matches!(outcome, Err(RenderError::Cancelled)));
}

/// A sink whose disk is full after the first band.
struct Full(u32);

impl Sink for Full {
    type Error = &'static str;

    fn start(&mut self, _: u32, _: u32) -> Result<(), Self::Error> {
        Ok(())
    }

    fn rows(&mut self, y: u32, _: &[[u8; 4]]) -> Result<(), Self::Error> {
        self.0 += 1;
        if y > 0 { Err("disk full") } else { Ok(()) }
    }

    fn finish(&mut self) -> Result<(), Self::Error> {
        Err("never reached")
    }
}

#[test]
fn a_failing_sink_ends_the_run() {
    let mut sink = Full(0);
    let outcome = render(&scene(vec![]), &Settings::new(100, 5000), &mut sink, &Control::default());
    assert!(matches!(outcome, Err(RenderError::Sink("disk full"))));
    assert_eq!(sink.0, 2);
}

/// A command of any kind somewhere on or off the canvas.
/// Enough commands for several parts, over one another in an order that shows.
fn crowd(colors: [Straight; 3]) -> Vec<Command> {
    let triangle = |i: u32| {
        let at = |k: u32, n: u32| f64::from(i * k % n) + f64::from(i % 16) / 16.0;
        let corner = DVec2::new(at(37, 60), at(23, 44));
        let points = [corner, corner + DVec2::new(at(3, 9), 1.0), corner + DVec2::new(2.0, 5.0)];
        let mut colors = colors;
        colors.rotate_left(i as usize % 3);
        colors[0].0[1] = (i % 101) as f32 / 100.0;
        Command::Gouraud(GouraudTriangle { points, colors, transform: Homography::IDENTITY })
    };
    (0..9000).map(triangle).collect()
}

#[test]
fn long_lists_are_one_list_on_any_number_of_threads() {
    let faded = |mut commands: Vec<Command>| {
        commands.insert(4000, Command::PushLayer { opacity: 0.7 });
        commands.insert(7000, Command::PopLayer);
        commands
    };
    let ramps = crowd([RED, BLUE, Straight::WHITE]);
    for commands in [crowd([RED; 3]), faded(ramps.clone()), ramps] {
        let scene = scene(commands);
        for samples in [1, 4, 8] {
            let settings = Settings {
                pattern: SamplePattern::standard(samples).unwrap(),
                tile_size: 16,
                threads: 1,
                ..Settings::new(64, 48)
            };
            let picture = render_image(&scene, &settings).unwrap();
            for threads in [2, 5] {
                let side_by_side = render_image(&scene, &Settings { threads, ..settings.clone() });
                assert!(side_by_side.unwrap() == picture, "{samples} samples, {threads} threads");
            }
        }
    }
}

fn any_command() -> impl Strategy<Value = Command> {
    let coordinate = -20.0..90.0f64;
    let point = (coordinate.clone(), coordinate).prop_map(|(x, y)| DVec2::new(x, y));
    let color = proptest::array::uniform4(0.0..=1.0f32).prop_map(Straight);
    let fill = (proptest::collection::vec(point.clone(), 3..7), color.clone(), any::<bool>())
        .prop_map(|(points, color, odd)| {
            Command::Fill(Fill {
                path: Arc::new(Path::polyline(points, true)),
                rule: if odd { FillRule::EvenOdd } else { FillRule::NonZero },
                transform: Homography::IDENTITY,
                color,
            })
        });
    let gouraud = (
        proptest::array::uniform3(point.clone()),
        proptest::array::uniform3(color),
        -0.01..0.01f64,
    )
        .prop_map(|(points, colors, tilt)| {
            Command::Gouraud(GouraudTriangle {
                points,
                colors,
                transform: Homography::new([[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [tilt, 0.0, 1.0]]),
            })
        });
    let image = (point.clone(), 0.2..4.0f64, 0.0..6.0f64, 0.0..=1.0f32, -0.02..0.02f64).prop_map(
        |(at, scale, turn, opacity, tilt)| {
            let (sin, cos) = turn.sin_cos();
            let place =
                Affine::new(cos * scale, sin * scale, -sin * scale, cos * scale, at.x, at.y);
            let tilt = Homography::new([[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [tilt, tilt, 1.0]]);
            Command::Image(ImageQuad {
                image: ImageId(0),
                rect: Rect::new(0.0, 0.0, 16.0, 16.0),
                source: Rect::new(0.0, 0.0, 1.0, 1.0),
                pixelated: false,
                opacity: if opacity > 0.5 { 1.0 } else { opacity },
                transform: tilt * Homography::from(place),
            })
        },
    );
    prop_oneof![4 => fill, 2 => gouraud, 2 => image]
}

/// Outlines of many edges, in one colour each.
fn any_rosettes() -> impl Strategy<Value = Vec<Command>> {
    let radii = proptest::collection::vec(1.0..60.0f64, 17..90);
    let color = proptest::array::uniform4(0.0..=1.0f32);
    let rosette = (radii, -20.0..320.0f64, -20.0..110.0f64, color, any::<[bool; 2]>());
    let command = rosette.prop_map(|(radii, x, y, mut color, [odd, opaque])| {
        color[3] = if opaque { 1.0 } else { color[3] };
        let step = std::f64::consts::TAU * 7.0 / radii.len() as f64;
        let corner = |(i, r): (usize, f64)| {
            let (sin, cos) = (step * i as f64).sin_cos();
            DVec2::new(x + 3.0 * r * cos, y + r * sin)
        };
        Command::Fill(Fill {
            path: Arc::new(Path::polyline(radii.into_iter().enumerate().map(corner), true)),
            rule: if odd { FillRule::EvenOdd } else { FillRule::NonZero },
            transform: Homography::IDENTITY,
            color: Straight(color),
        })
    });
    proptest::collection::vec(command, 1..8)
}

/// Commands with some of them in a group.
fn any_scene() -> impl Strategy<Value = Scene> {
    (proptest::collection::vec(any_command(), 1..12), 0usize..12, 0usize..12).prop_map(
        |(mut commands, a, b)| {
            let (a, b) = (a.min(b).min(commands.len()), a.max(b).min(commands.len()));
            commands.insert(b, Command::PopLayer);
            commands.insert(a, Command::PushLayer { opacity: 0.6 });
            scene(commands)
        },
    )
}

proptest! {
    #[test]
    fn tiles_and_threads_change_nothing(
        scene in any_scene(), samples in prop::sample::select(vec![1usize, 4, 16])
    ) {
        let mut settings = Settings::new(80, 60);
        settings.pattern = SamplePattern::standard(samples).unwrap();
        settings.threads = 1;
        let expected = render_image(&scene, &settings).unwrap();
        for (tile_size, threads) in [(8, 1), (16, 2), (256, 1)] {
            settings.tile_size = tile_size;
            settings.threads = threads;
            prop_assert!(render_image(&scene, &settings).unwrap() == expected);
        }
    }

    #[test]
    fn outlines_by_area_are_the_same_in_tiles_of_any_shape(
        mut commands in any_rosettes(), x in 0..290i32, y in 0..85i32,
    ) {
        let mut settings = Settings::new(300, 90);
        settings.antialias = Antialias::Area;
        settings.threads = 1;
        let drawing = |commands| Scene { view: View::Fit { size: DVec2::new(300.0, 90.0) }, ..scene(commands) };
        let wide = render_image(&drawing(commands.clone()), &settings).unwrap();
        for (tile_size, threads) in [(8, 2), (20, 1), (256, 3)] {
            let settings = Settings { tile_size, threads, ..settings.clone() };
            prop_assert!(render_image(&drawing(commands.clone()), &settings).unwrap() == wide);
        }
        let crop = Some(IntRect::new(x, y, x + 120, y + 40));
        let part = render_image(&drawing(commands.clone()), &Settings { crop, ..settings.clone() });
        for (row, part) in wide.view().crop(x as usize, y as usize, 120, 40).rows().zip(part.unwrap().view().rows()) {
            prop_assert_eq!(part, row);
        }
        // A colour that changes, in one corner, and all tiles are square.
        commands.push(Command::Gouraud(GouraudTriangle {
            points: [DVec2::ZERO, DVec2::X, DVec2::Y],
            colors: [RED, BLUE, RED],
            transform: Homography::IDENTITY,
        }));
        let square = render_image(&drawing(commands), &settings).unwrap();
        for y in 1..90 {
            prop_assert_eq!(square.row(y), wide.row(y));
        }
    }

    #[test]
    fn a_crop_is_a_part_of_the_whole(
        scene in any_scene(), x in 0..70i32, y in 0..50i32, w in 1..40i32, h in 1..40i32
    ) {
        let mut settings = Settings::new(80, 60);
        settings.threads = 1;
        let whole = render_image(&scene, &settings).unwrap();
        settings.crop = Some(IntRect::new(x, y, x + w, y + h));
        let part = render_image(&scene, &settings).unwrap();
        for row in 0..part.height() {
            let of_whole = &whole.row(row + y as usize)[x as usize..][..part.width()];
            prop_assert_eq!(part.row(row), of_whole);
        }
    }
}

#[test]
fn outlines_count_against_the_memory_limit() {
    let dense = (0..100_000).map(|i| DVec2::new(f64::from(i % 64), f64::from(i % 48)));
    let fill = Command::Fill(Fill {
        path: Arc::new(Path::polyline(dense, true)),
        rule: FillRule::EvenOdd,
        transform: Homography::IDENTITY,
        color: RED,
    });
    let mut settings = Settings::new(64, 48);
    settings.max_memory = 4 << 20;
    assert!(render_image(&scene(vec![]), &settings).is_ok());
    let refused = render_image(&scene(vec![fill]), &settings);
    assert!(matches!(refused, Err(RenderError::Memory { .. })));
}
