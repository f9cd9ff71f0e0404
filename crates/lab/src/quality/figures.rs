//! The pictures: one scene by four filters, side by side.

use super::QualityError;
use super::methods::TRILINEAR;
use crate::canvas::{Canvas, hex};
use crate::math::cos;
use crate::textures;
use scumble::pixel::Premul;
use scumble::texture::{
    Kernel, LevelMode, Magnify, PixelFilter, Sampler, Texture, TextureError, TextureOptions, Wrap,
};
use scumble_geometry::{DVec2, GeometryError, Homography};
use std::f64::consts::PI;

/// A strip of four pictures.
pub(crate) struct Figure {
    /// The file's name without its ending.
    pub(crate) name: &'static str,
    pub(crate) title: &'static str,
    /// Which picture is which.
    pub(crate) order: &'static str,
    /// What to look at.
    pub(crate) look: &'static str,
    scene: fn() -> Result<Scene, QualityError>,
    samplers: [Sampler; 4],
}

/// Pixels of one picture.
const WIDTH: usize = 256;
const HEIGHT: usize = 192;
/// White between two.
const GAP: usize = 8;

const NONE: Sampler = Sampler::DEFAULT.with(PixelFilter::Nearest, LevelMode::Zero);
const FOUR: [Sampler; 4] = [NONE, TRILINEAR, Sampler::CLASSIC, Sampler::DEFAULT];
const IN_ORDER: &str = "From left to right: nearest texel, trilinear, `classic`, `default`.";

const fn ratio(max_eccentricity: f32) -> Sampler {
    Sampler { max_eccentricity, ..Sampler::DEFAULT }
}

/// The Gaussian cut at the pixel's radius of one, as Heckbert had it.
const CUT: Sampler =
    Sampler { kernel: Kernel::Gaussian, magnify: Magnify::None, ..Sampler::CLASSIC };

pub(crate) const FIGURES: [Figure; 6] = [
    Figure {
        name: "checker",
        title: "A checkerboard in perspective",
        order: IN_ORDER,
        look: "Look at the upper third. Without a filter the squares break up into false \
               patterns; trilinear turns grey first, because it takes the longer side of the \
               footprint for both; the ellipses keep the rows apart farther out, until those, \
               too, are finer than pixels.",
        scene: checker,
        samplers: FOUR,
    },
    Figure {
        name: "rings",
        title: "High frequencies",
        order: IN_ORDER,
        look: "Rings that get finer outwards, as fine as texels can be, several times down \
               and tilted. Only those about the middle are true. Nearest is full of false \
               ones; trilinear and `classic` keep faint ones beside the middle and below it; \
               `default` fades out with the least of them.",
        scene: rings,
        samplers: FOUR,
    },
    Figure {
        name: "room",
        title: "An ordinary view",
        order: IN_ORDER,
        look: "Look at the tiles at the far end and at the joints of the side wall: noise without a \
               filter, a smear with trilinear, and lines as far as there are pixels for them with \
               the ellipses.",
        scene: room,
        samplers: FOUR,
    },
    Figure {
        name: "magnified",
        title: "Isotropic magnification",
        order: IN_ORDER,
        look: "A picture of 32×32 texels, seven times up and turned. Nearest shows the texels, trilinear \
               (bilinear here) the lines between their centres, `classic` is sharp, with halos along \
               dark edges, and `default` soft and free of halos.",
        scene: boat,
        samplers: FOUR,
    },
    Figure {
        name: "clamp",
        title: "The bound on the axis ratio",
        order: "From left to right: `default` with the axis ratio bounded to 2, 8, 32 (its own), and 1024.",
        look: "Lower bounds widen the ellipse across, so the far part turns grey sooner, and \
               never alias. Between 32 and 1024 there is hardly a difference to see, even \
               here.",
        scene: grazing,
        samplers: [ratio(2.0), ratio(8.0), ratio(32.0), ratio(1024.0)],
    },
    Figure {
        name: "cut",
        title: "A Gaussian that is cut, magnified",
        order: "From left to right: the Gaussian cut at the radius of one (`classic` with the Gaussian \
                kernel and no filter of its own for magnification), `classic`, `default`, and `default` \
                with Catmull-Rom magnification.",
        look: "Look along the mast and the edge of the hull, enlarged. Where the ellipse is \
               no larger than a texel, texels come into it and leave it while they still have \
               weight: the mast is dotted and the edge ragged. A kernel that ends at zero, or \
               a Gaussian wide enough to do so nearly, shows none of it.",
        scene: boat,
        samplers: [
            CUT,
            Sampler::CLASSIC,
            Sampler::DEFAULT,
            Sampler { magnify: Magnify::CatmullRom, ..Sampler::DEFAULT },
        ],
    },
];

/// Every figure with its strip.
pub(crate) fn draw() -> Result<Vec<(&'static Figure, Canvas)>, QualityError> {
    FIGURES.iter().map(|figure| Ok((figure, strip(figure)?))).collect()
}

fn strip(figure: &Figure) -> Result<Canvas, QualityError> {
    let scene = (figure.scene)()?;
    let pictures = figure.samplers.map(|s| scene.draw(&s));
    let (width, height) = (4 * WIDTH + 3 * GAP, HEIGHT);
    Ok(Canvas::paint(width as u32, height as u32, 1, |x, y| {
        let (x, y) = (x as usize, y as usize);
        let (index, x) = (x / (WIDTH + GAP), x % (WIDTH + GAP));
        if x < WIDTH { pictures[index][y * WIDTH + x] } else { [1.0; 3] }
    }))
}

/// Textured surfaces, the last in front.
struct Scene {
    background: [f64; 3],
    surfaces: Vec<Surface>,
}

struct Surface {
    texture: Texture,
    /// From the screen to texels.
    map: Homography,
    /// Where on the screen it is, in its own texels: the corners of a rectangle.
    extent: [DVec2; 2],
}

impl Scene {
    fn draw(&self, s: &Sampler) -> Vec<[f64; 3]> {
        let mut picture = vec![self.background; WIDTH * HEIGHT];
        let mut row = [Premul::default(); WIDTH];
        for surface in &self.surfaces {
            for (y, pixels) in picture.chunks_mut(WIDTH).enumerate() {
                let start = DVec2::new(0.5, y as f64 + 0.5);
                surface.texture.sample_row(&surface.map, start, s, &mut row);
                for (x, (pixel, color)) in pixels.iter_mut().zip(&row).enumerate() {
                    let [low, high] = surface.extent;
                    let inside = |p: DVec2| p.clamp(low, high) == p;
                    let p = surface.map.project(start + DVec2::new(x as f64, 0.0));
                    if p.is_some_and(inside) {
                        *pixel = [0, 1, 2].map(|c| f64::from(color.0[c]));
                    }
                }
            }
        }
        picture
    }
}

/// A texture that repeats.
fn tiled(canvas: Canvas) -> Result<Texture, TextureError> {
    let options = TextureOptions { wrap: Wrap::Repeat, ..TextureOptions::default() };
    Texture::new(canvas.into_image().view(), &options)
}

/// A surface on the quad of the screen whose corners, clockwise from the texture's top left, are
/// given; the texture comes so many times across and down.
fn quad(
    texture: Texture,
    corners: [(f64, f64); 4],
    repeats: [f64; 2],
) -> Result<Surface, GeometryError> {
    let far = DVec2::new(texture.width() as f64 * repeats[0], texture.height() as f64 * repeats[1]);
    let zero = DVec2::new(0.0, 0.0);
    let inner = [zero, DVec2::new(far.x, 0.0), far, DVec2::new(0.0, far.y)];
    let map = Homography::from_points(corners.map(|(x, y)| DVec2::new(x, y)), inner)?;
    Ok(Surface { texture, map, extent: [zero, far] })
}

/// A plane without end below a horizon: `row` is the horizon's, `scale` the texels per pixel one
/// pixel-height of the eye below it.
fn plane(texture: Texture, horizon: f64, scale: f64, across: f64) -> Surface {
    let middle = WIDTH as f64 / 2.0;
    let map = Homography::new([
        [across * scale, 0.0, -across * scale * middle],
        [0.0, 0.0, scale * WIDTH as f64],
        [0.0, 1.0, -horizon],
    ]);
    let far = DVec2::new(1e9, 1e9);
    Surface { texture, map, extent: [-far, far] }
}

fn squares() -> Result<Texture, TextureError> {
    tiled(Canvas::paint(64, 64, 1, |x, y| {
        if (x < 32.0) == (y < 32.0) { hex(0xf4efe2) } else { hex(0x2b3440) }
    }))
}

fn checker() -> Result<Scene, QualityError> {
    let surface = plane(squares()?, 24.5, 130.0, 1.0);
    Ok(Scene { background: hex(0xbfd4e0), surfaces: vec![surface] })
}

fn grazing() -> Result<Scene, QualityError> {
    let surface = plane(squares()?, 8.5, 30.0, 1.0);
    Ok(Scene { background: hex(0xbfd4e0), surfaces: vec![surface] })
}

fn rings() -> Result<Scene, QualityError> {
    let half = 512.0;
    let canvas = Canvas::paint(1024, 1024, 1, |x, y| {
        let (x, y) = (x - half, y - half);
        [0.5 + 0.5 * cos(PI * (x * x + y * y) / (2.0 * half)); 3]
    });
    let corners = [(60.0, 6.0), (196.0, 6.0), (250.0, 186.0), (6.0, 186.0)];
    let surface = quad(tiled(canvas)?, corners, [1.0, 1.0])?;
    Ok(Scene { background: [0.5; 3], surfaces: vec![surface] })
}

fn room() -> Result<Scene, QualityError> {
    let mut drawn = textures::all();
    let mut texture = |name: &str| {
        let index = drawn.iter().position(|(n, _)| *n == name).unwrap_or_default();
        tiled(drawn.swap_remove(index).1)
    };
    let (left, right, top, bottom) = (112.0, 176.0, 40.0, 92.0);
    let floor = [(left, bottom), (right, bottom), (330.0, 192.0), (-70.0, 192.0)];
    let wall = [(-70.0, -110.0), (left, top), (left, bottom), (-70.0, 192.0)];
    let other = [(right, top), (330.0, -110.0), (330.0, 192.0), (right, bottom)];
    let end = [(left, top), (right, top), (right, bottom), (left, bottom)];
    let picture = [(200.0, 36.0), (240.0, 2.0), (240.0, 122.0), (200.0, 98.0)];
    let surfaces = vec![
        quad(texture("tile")?, floor, [6.0, 14.0])?,
        quad(texture("brick")?, wall, [7.0, 3.0])?,
        quad(texture("noise")?, other, [4.0, 2.0])?,
        quad(texture("chart")?, end, [1.0, 1.0])?,
        quad(texture("portrait")?, picture, [1.0, 1.0])?,
    ];
    Ok(Scene { background: hex(0xd8d2c4), surfaces })
}

fn boat() -> Result<Scene, QualityError> {
    let corners = [(30.0, -28.0), (252.0, 2.0), (222.0, 224.0), (0.0, 194.0)];
    let surface = quad(tiled(textures::emblem())?, corners, [1.0, 1.0])?;
    Ok(Scene { background: [1.0; 3], surfaces: vec![surface] })
}
