//! Tiled textures under footprints of many tiles: what is averaged must be all of them.

use scumble_geometry::{DVec2, Homography};
use scumble_pixel::{Image, Premul};
use scumble_texture::reference::{PixelShape, Reference};
use scumble_texture::{Footprint, Sampler, Texture, TextureOptions, Wrap};

/// A floor that runs to its horizon at y = 0 and across it: the footprints are long, thin and
/// askew, and near the horizon many tiles long.
fn floor() -> Homography {
    let k = 128.0 * 1088.0;
    Homography::new([[k / 640.0, 0.0, 0.0], [0.0, 0.0, k], [0.0, 1.0, 0.0]])
}

#[test]
fn a_tiled_floor_does_not_alias_near_its_horizon() {
    let tile = Image::from_fn(128, 128, |x, y| {
        if (x / 64 + y / 64) % 2 == 0 { [255; 4] } else { [0, 0, 0, 255] }
    });
    let Ok(tile) = tile else { panic!("a small image") };
    for wrap in [Wrap::Repeat, Wrap::Mirror] {
        let options = TextureOptions { wrap, ..TextureOptions::default() };
        let Ok(texture) = Texture::new(tile.view(), &options) else { panic!("a small texture") };
        let gaussian = PixelShape::Gaussian { sigma: 0.5 };
        let truth = Reference::new(&texture, gaussian).with_density(0.25, 16);
        for y in [20.5, 35.5, 60.5] {
            for x in [-370.5, -200.5, -40.5, 101.5] {
                let p = DVec2::new(x, y);
                let Premul(ours) = texture.sample(&Footprint::at(&floor(), p), &Sampler::default());
                let theirs = truth.sample(&floor(), p);
                let error = (f64::from(ours[0]) - theirs[0]).abs();
                assert!(error < 0.02, "{wrap:?} at {p}: {} and not {}", ours[0], theirs[0]);
            }
        }
    }
}
