//! What must not change a byte does not: the number of threads, the size of the tiles, the crop.
//! One test for each scene under `assets/scenes`.

use libtest_mimic::{Arguments, Failed, Trial};
use scumble::coverage::SamplePattern;
use scumble::geometry::IntRect;
use scumble::pixel::Image;
use scumble::scene::Scene;
use scumble::{Antialias, Settings, render_image};
use scumble_tests::{Case, load, scene_names};
use std::process::ExitCode;

/// Not multiples of any tile, so that the last tiles are cut both ways.
const WIDTH: u32 = 203;
const HEIGHT: u32 = 149;

fn main() -> ExitCode {
    let args = Arguments::from_args();
    let names = match scene_names() {
        Ok(names) => names,
        Err(error) => {
            eprintln!("{error}");
            return ExitCode::FAILURE;
        }
    };
    let trials = names
        .into_iter()
        .map(|name| Trial::test(name.clone(), move || check(&name).map_err(Failed::from)))
        .collect();
    libtest_mimic::run(&args, trials).exit_code()
}

fn check(name: &str) -> Result<(), String> {
    let case = Case::new(name, WIDTH, HEIGHT);
    let parsed = load(&case)?;
    let own = case.settings(parsed.profile)?;
    check_scene(&parsed.scene, &own)?;
    check_scene(&parsed.scene, &Settings { antialias: Antialias::Area, ..own.clone() })
        .map_err(|error| format!("by area: {error}"))?;
    if own.pattern.len() == 1 {
        let pattern = SamplePattern::standard(4).map_err(|e| e.to_string())?;
        check_scene(&parsed.scene, &Settings { pattern, ..own })?;
    }
    Ok(())
}

fn check_scene(scene: &Scene, settings: &Settings) -> Result<(), String> {
    let draw = |s: Settings| render_image(scene, &s).map_err(|e| e.to_string());
    let with = |threads, tile_size| Settings { threads, tile_size, ..settings.clone() };
    let whole = draw(with(1, 64))?;
    for (threads, tile_size) in [(2, 64), (1, 16), (2, 16), (1, 256), (2, 256), (2, 8)] {
        if draw(with(threads, tile_size))? != whole {
            return Err(format!("{threads} threads and tiles of {tile_size} differ"));
        }
    }
    // Across tile borders, off them, a single pixel, and over the edge of the canvas.
    let crops = [(37, 21, 120, 93), (64, 64, 64, 64), (101, 77, 1, 1), (150, 100, 400, 400)];
    for (x, y, width, height) in crops {
        let area = IntRect::new(x, y, x + width, y + height);
        let part = draw(Settings { crop: Some(area), ..with(2, 32) })?;
        if part != cut(&whole, area) {
            return Err(format!("the crop {x},{y},{width},{height} differs from that part"));
        }
    }
    Ok(())
}

/// The part of a picture that lies in `area`.
fn cut(whole: &Image<[u8; 4]>, area: IntRect) -> Image<[u8; 4]> {
    let canvas = IntRect::new(0, 0, whole.width() as i32, whole.height() as i32);
    let area = area.intersect(&canvas);
    let columns = area.x0 as usize..area.x1 as usize;
    let rows = area.y0 as usize..area.y1 as usize;
    let pixels = rows.flat_map(|y| whole.row(y)[columns.clone()].iter().copied()).collect();
    Image::from_vec(area.width() as usize, area.height() as usize, pixels)
        .expect("as many pixels as the area has")
}
