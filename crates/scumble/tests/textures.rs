//! Textures that are kept from picture to picture.
#![allow(missing_docs, clippy::unwrap_used)]

use scumble::geometry::{DVec2, Homography, Rect};
use scumble::pixel::{Image, WorkingSpace};
use scumble::scene::{Command, ImageId, ImageQuad, ImageWrap, Scene, SceneImage, View};
use scumble::texture::LevelMode;
use scumble::{Control, ImageSink, RenderError, Settings, Textures, render_image, render_with};

fn scene(side: usize) -> Scene {
    let pixels = (0..side * side).map(|i| [(i * 7) as u8, (i * 3) as u8, 9, 255]).collect();
    let quad = ImageQuad {
        image: ImageId(0),
        rect: Rect::new(1.0, 2.0, 9.0, 8.0),
        source: Rect::new(0.0, 0.0, 1.0, 1.0),
        pixelated: false,
        opacity: 1.0,
        transform: Homography::IDENTITY,
    };
    Scene {
        view: View::Fit { size: DVec2::new(10.0, 10.0) },
        background: None,
        images: vec![SceneImage {
            pixels: Image::from_vec(side, side, pixels).unwrap(),
            wrap: ImageWrap::Clamp,
        }],
        commands: vec![Command::Image(quad)],
    }
}

#[test]
fn kept_textures_give_the_same_picture() {
    let scene = scene(16);
    let textures = Textures::new(&scene, &Settings::new(10, 10)).unwrap();
    assert!(textures.memory() > 16 * 16);
    for side in [10, 25] {
        let settings = Settings::new(side, side);
        let mut sink = ImageSink::new();
        render_with(&scene, &textures, &settings, &mut sink, &Control::default()).unwrap();
        assert_eq!(sink.into_image(), render_image(&scene, &settings).unwrap());
    }
}

#[test]
fn textures_of_something_else_are_refused() {
    let (scene, settings) = (scene(16), Settings::new(10, 10));
    let textures = Textures::new(&scene, &settings).unwrap();
    let linear = Settings { space: WorkingSpace::Linear, ..settings.clone() };
    let mut zero = settings.clone();
    zero.sampler.level = LevelMode::Zero;
    let unused = Scene { commands: vec![], ..scene.clone() };
    let none = Textures::new(&unused, &settings).unwrap();
    let larger = self::scene(17);
    for (scene, textures, settings) in [
        (&scene, &textures, &linear),
        (&scene, &textures, &zero),
        (&larger, &textures, &settings),
        (&scene, &none, &settings),
    ] {
        let drawn =
            render_with(scene, textures, settings, &mut ImageSink::new(), &Control::default());
        assert!(matches!(drawn, Err(RenderError::Textures)));
    }
}
