//! Textured surfaces as an eye would see them, for comparing filters: no rasterizer, one sample at the
//! centre of each pixel.

use crate::canvas::{Canvas, hex};
use crate::math::cos;
use crate::textures;
use scumble::pixel::Premul;
use scumble::texture::{Footprint, Sampler, Texture, TextureError, TextureOptions, Wrap};
use scumble_geometry::{DVec2, GeometryError, Homography};
use std::f64::consts::PI;

/// Columns of a view.
pub(crate) const WIDTH: usize = 256;
/// Rows of a view.
pub(crate) const HEIGHT: usize = 192;

/// Why a view could not be set up.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum ViewError {
    /// An image would not become a texture.
    #[error("a texture: {0}")]
    Texture(#[from] TextureError),
    /// A map could not be made of its points.
    #[error("a map: {0}")]
    Map(#[from] GeometryError),
}

/// What lies above a horizon.
const SKY: [f64; 3] = [191.0 / 255.0, 212.0 / 255.0, 224.0 / 255.0];

/// Textured surfaces, the last in front.
pub(crate) struct View {
    /// Where no surface is.
    pub(crate) background: [f64; 3],
    surfaces: Vec<Surface>,
}

/// A texture on a plane.
pub(crate) struct Surface {
    texture: Texture,
    /// From the screen to texels.
    map: Homography,
    /// Where on the screen it is, in its own texels: the corners of a rectangle.
    extent: [DVec2; 2],
}

impl View {
    /// The colours, row by row, by one filter.
    pub(crate) fn draw(&self, s: &Sampler) -> Vec<[f64; 3]> {
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

    /// Something of each pixel's footprint on the front surface there; `none` where there is none.
    pub(crate) fn each<T: Clone>(&self, none: T, f: impl Fn(&Texture, &Footprint) -> T) -> Vec<T> {
        let mut all = vec![none; WIDTH * HEIGHT];
        for surface in &self.surfaces {
            for (index, one) in all.iter_mut().enumerate() {
                let (x, y) = (index % WIDTH, index / WIDTH);
                let at = DVec2::new(x as f64 + 0.5, y as f64 + 0.5);
                let pixel = Footprint::at(&surface.map, at);
                let [low, high] = surface.extent;
                let p = DVec2::new(pixel.u, pixel.v);
                if p.clamp(low, high) == p {
                    *one = f(&surface.texture, &pixel);
                }
            }
        }
        all
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

/// A plane without end below a horizon: `horizon` is its row, `scale` the texels per pixel one
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

/// The plane of [`checker`], turned by some 45°, so that what pixels see lies aslant in the texture.
pub(crate) fn diagonal() -> Result<View, ViewError> {
    let Surface { texture, map, extent } = plane(squares()?, 24.5, 90.0, 1.0);
    Ok(View { background: SKY, surfaces: vec![Surface { texture, map: turned(&map), extent }] })
}

/// A map whose texture is turned by the angle of (0.72, 0.69), about 44°: not one at which rows of
/// squares repeat.
fn turned(map: &Homography) -> Homography {
    let (c, s) = (0.72, 0.69);
    let [u, v, w] = map.m;
    let row = |a: f64, b: f64| std::array::from_fn(|i| a * u[i] + b * v[i]);
    Homography::new([row(c, -s), row(s, c), w])
}

/// That of [`diagonal`] by an eye that is tilted sideways.
pub(crate) fn tilted() -> Result<View, ViewError> {
    let Surface { texture, map, extent } = plane(squares()?, 24.5, 90.0, 1.0);
    let (c, s) = (0.8, 0.6);
    let (middle, height) = (WIDTH as f64 / 2.0, 64.0);
    let roll = |[x, y, one]: [f64; 3]| {
        let shift =
            one + x * (middle - c * middle + s * height) + y * (height - s * middle - c * height);
        [c * x + s * y, c * y - s * x, shift]
    };
    let map = Homography::new(turned(&map).m.map(roll));
    Ok(View { background: SKY, surfaces: vec![Surface { texture, map, extent }] })
}

/// Rings as fine as texels can be, again and again to the horizon, aslant.
pub(crate) fn carpet() -> Result<View, ViewError> {
    let half = 128.0;
    let canvas = Canvas::paint(256, 256, 1, |x, y| {
        let (x, y) = (x - half, y - half);
        [0.5 + 0.42 * cos(PI * (x * x + y * y) / (2.0 * half)); 3]
    });
    let Surface { texture, map, extent } = plane(tiled(canvas)?, 16.5, 130.0, 1.0);
    Ok(View { background: SKY, surfaces: vec![Surface { texture, map: turned(&map), extent }] })
}

pub(crate) fn checker() -> Result<View, ViewError> {
    let surface = plane(squares()?, 24.5, 130.0, 1.0);
    Ok(View { background: SKY, surfaces: vec![surface] })
}

pub(crate) fn grazing() -> Result<View, ViewError> {
    let surface = plane(squares()?, 8.5, 30.0, 1.0);
    Ok(View { background: SKY, surfaces: vec![surface] })
}

pub(crate) fn rings() -> Result<View, ViewError> {
    let half = 512.0;
    let canvas = Canvas::paint(1024, 1024, 1, |x, y| {
        let (x, y) = (x - half, y - half);
        [0.5 + 0.5 * cos(PI * (x * x + y * y) / (2.0 * half)); 3]
    });
    let corners = [(60.0, 6.0), (196.0, 6.0), (250.0, 186.0), (6.0, 186.0)];
    let surface = quad(tiled(canvas)?, corners, [1.0, 1.0])?;
    Ok(View { background: [0.5; 3], surfaces: vec![surface] })
}

/// A chart of lines and letters on the ground: magnified near by, minified far off.
pub(crate) fn lettering() -> Result<View, ViewError> {
    let surface = plane(take(&mut textures::all(), "chart")?, 10.5, 66.0, 1.0);
    Ok(View { background: SKY, surfaces: vec![surface] })
}

/// One of the assets' textures.
fn take(drawn: &mut Vec<(&str, Canvas)>, name: &str) -> Result<Texture, TextureError> {
    let index = drawn.iter().position(|(n, _)| *n == name).unwrap_or_default();
    tiled(drawn.swap_remove(index).1)
}

pub(crate) fn room() -> Result<View, ViewError> {
    let mut drawn = textures::all();
    let mut texture = |name: &str| take(&mut drawn, name);
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
    Ok(View { background: hex(0xd8d2c4), surfaces })
}

pub(crate) fn boat() -> Result<View, ViewError> {
    let corners = [(30.0, -28.0), (252.0, 2.0), (222.0, 224.0), (0.0, 194.0)];
    let surface = quad(tiled(textures::emblem())?, corners, [1.0, 1.0])?;
    Ok(View { background: [1.0; 3], surfaces: vec![surface] })
}
