//! The whole renderer against brute force in `f64`: textured planes in perspective, where every
//! pixel's centre, Jacobian, ellipse and level must be right for the picture to be.

use scumble::geometry::{DVec2, Homography, Rect};
use scumble::pixel::{Image, Straight, WorkingSpace};
use scumble::scene::{
    Command, ImageId, ImageQuad, ImageWrap, Scene, SceneImage, TexturedTriangle, View,
};
use scumble::texture::reference::{PixelShape, Reference};
use scumble::texture::{Footprint, Sampler, Texture, TextureOptions, Wrap};
use scumble::{Settings, render_image};
use scumble_tests::texture;

const WIDTH: u32 = 64;
const HEIGHT: u32 = 48;
/// The pixel of the elliptical filter.
const PIXEL: PixelShape = PixelShape::Gaussian { sigma: 0.5 };

fn load(name: &str) -> Image<[u8; 4]> {
    let picture = texture(name).expect("a texture of the assets");
    let (width, height) = (picture.width() as usize, picture.height() as usize);
    let pixels = picture.pixels().map(|p| p.0).collect();
    Image::from_vec(width, height, pixels).expect("as many pixels as it says")
}

/// One command that covers the canvas, and the map from its uvs to pixels.
struct View3d {
    command: Command,
    to_pixels: Homography,
    wrap: ImageWrap,
}

/// The unit square sent to a quad that is larger than the canvas.
fn quad(corners: [(f64, f64); 4]) -> View3d {
    let corners = corners.map(|(x, y)| DVec2::new(x, y));
    let transform = Homography::unit_square_to_quad(corners).expect("a proper quad");
    let unit = Rect::new(0.0, 0.0, 1.0, 1.0);
    let command = Command::Image(ImageQuad {
        image: ImageId(0),
        rect: unit,
        source: unit,
        pixelated: false,
        opacity: 1.0,
        transform,
    });
    View3d { command, to_pixels: transform, wrap: ImageWrap::Clamp }
}

/// A triangle on a plane seen from height 1, from the lower edge of the canvas to far beyond its
/// horizon's neighbourhood; one texture per unit.
fn plane() -> View3d {
    let (focal, horizon) = (40.0, -8.0);
    let transform = Homography::new([
        [focal, f64::from(WIDTH) / 2.0, 0.0],
        [0.0, horizon, focal],
        [0.0, 1.0, 0.0],
    ]);
    let points = [(-40.0, 12.0), (40.0, 12.0), (0.0, -10.0)].map(|(x, y)| DVec2::new(x, y));
    let command = Command::Textured(TexturedTriangle {
        points,
        uvs: points,
        image: ImageId(0),
        opacity: 1.0,
        transform,
    });
    View3d { command, to_pixels: transform, wrap: ImageWrap::Repeat }
}

/// Peak signal to noise in dB over the canvas, red, green and blue together; one is the peak.
fn psnr(pixels: &Image<[u8; 4]>, view: &View3d, space: WorkingSpace) -> f64 {
    let scene = Scene {
        view: View::Fit { size: DVec2::new(f64::from(WIDTH), f64::from(HEIGHT)) },
        background: Some(Straight([1.0, 0.0, 1.0, 1.0])),
        images: vec![SceneImage { pixels: pixels.clone(), wrap: view.wrap }],
        commands: vec![view.command.clone()],
    };
    let settings =
        Settings { space, sampler: Sampler::DEFAULT, threads: 1, ..Settings::new(WIDTH, HEIGHT) };
    let picture = render_image(&scene, &settings).expect("a small picture");

    let wrap = if view.wrap == ImageWrap::Repeat { Wrap::Repeat } else { Wrap::Clamp };
    let options = TextureOptions { space, wrap, ..TextureOptions::default() };
    let texture = Texture::new(pixels.view(), &options).expect("a texture");
    let oracle = Reference::new(&texture, PIXEL).with_density(2.0, 16);
    let size = Homography::new([
        [pixels.width() as f64, 0.0, 0.0],
        [0.0, pixels.height() as f64, 0.0],
        [0.0, 0.0, 1.0],
    ]);
    let to_texels = size * view.to_pixels.inverse().expect("a plane seen from its side is none");

    let (mut sum, mut count) = (0.0, 0);
    // Every third column and row: the residues of 3 meet every phase of the tiles and blocks.
    for y in (0..HEIGHT).step_by(3) {
        for x in (0..WIDTH).step_by(3) {
            let centre = DVec2::new(f64::from(x) + 0.5, f64::from(y) + 0.5);
            let truth = oracle.sample(&to_texels, centre).map(|v| v as f32);
            let truth = space.export_straight(scumble::pixel::Premul(truth)).0;
            let found = picture.row(y as usize)[x as usize];
            for channel in 0..3 {
                let error = f64::from(truth[channel]) - f64::from(found[channel]) / 255.0;
                sum += error * error;
                count += 1;
            }
        }
    }
    -10.0 * (sum / f64::from(count)).log10()
}

/// Holds a view to its bounds, in dB for each texture; the first also in linear light.
fn hold(name: &str, view: &View3d, bounds: &[(&str, f64)]) {
    let spaces = [WorkingSpace::Srgb, WorkingSpace::Linear];
    for (index, &(texture, bound)) in bounds.iter().enumerate() {
        for space in &spaces[..if index == 0 { 2 } else { 1 }] {
            let found = psnr(&load(texture), view, *space);
            println!("{name} {texture} {space:?}: {found:.1} dB");
            assert!(found >= bound, "{name} {texture} {space:?}: {found:.1} dB < {bound}");
        }
    }
}

// The bounds are a decibel or two below what the default sampler reaches. Eight-bit output alone
// is 59 dB.

#[test]
fn a_keystone_agrees_with_brute_force() {
    let view = quad([(-3.0, -4.0), (66.0, -5.0), (120.0, 54.0), (-70.0, 58.0)]);
    hold("keystone", &view, &[("portrait", 53.0), ("noise", 56.0), ("chart", 48.0)]);
}

#[test]
fn a_tilted_and_turned_quad_agrees_with_brute_force() {
    let view = quad([(-40.0, 14.0), (34.0, -34.0), (126.0, 20.0), (20.0, 94.0)]);
    hold("turned", &view, &[("checker", 48.0), ("noise", 55.0), ("portrait", 55.0)]);
}

#[test]
fn a_plane_towards_its_horizon_agrees_with_brute_force() {
    hold("plane", &plane(), &[("tile", 48.0), ("noise", 51.0)]);
}

#[test]
fn far_off_a_tiled_plane_is_the_mean_of_its_tile() {
    // Where a pixel sees dozens of repeats along a slanted ellipse: every texel weighs the same.
    let tile = load("tile");
    let options = TextureOptions { wrap: Wrap::Repeat, ..TextureOptions::default() };
    let texture = Texture::new(tile.view(), &options).expect("a texture");
    let last = texture.level(texture.level_count() - 1).expect("the last level");
    let mean = last.row(0)[0];
    let view = plane();
    let size = Homography::new([[128.0, 0.0, 0.0], [0.0, 128.0, 0.0], [0.0, 0.0, 1.0]]);
    let to_texels = size * view.to_pixels.inverse().expect("it is seen");
    for y in [-7.5, -7.0, -6.0, -5.0] {
        for x in [0.5, 17.5, 32.5, 55.5, 63.5, 200.5] {
            let footprint = Footprint::at(&to_texels, DVec2::new(x, y));
            let found = texture.sample(&footprint, &Sampler::DEFAULT).0;
            for channel in 0..4 {
                let error = (found[channel] - mean[channel]).abs();
                assert!(error < 0.01, "at ({x}, {y}): {found:?}, not {mean:?}");
            }
        }
    }
}
