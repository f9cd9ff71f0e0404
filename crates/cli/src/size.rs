//! How large the canvas is, and which part of it is drawn.

use crate::args::{Crop, Size};
use crate::error::Failure;
use scumble::geometry::DVec2;
use scumble::scene::View;

/// Size of a course picture when nobody asks for another, in pixels.
const COURSE_SIZE: (f64, f64) = (800.0, 600.0);

/// The longest side that a PNG can have.
const MAX_SIDE: f64 = 2_147_483_647.0;

/// A scene's size that is this close above a whole number of pixels is meant to be that number:
/// it comes from a conversion of units.
const UNIT_ERROR: f64 = 1e-6;

/// The canvas and the part of it that becomes the picture.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Canvas {
    pub(crate) width: u32,
    pub(crate) height: u32,
    pub(crate) crop: Option<Crop>,
}

impl Canvas {
    /// The canvas for a scene, if the picture has at most `max_pixels`.
    pub(crate) fn new(view: &View, size: &Size, max_pixels: u64) -> Result<Self, Failure> {
        let (width, height) = sides(view, size)?;
        let canvas = Self { width, height, crop: size.crop };
        canvas.check(max_pixels)?;
        Ok(canvas)
    }

    /// Refuses a crop that is not in the canvas, and a picture of more than `max_pixels`.
    pub(crate) fn check(&self, max_pixels: u64) -> Result<(), Failure> {
        self.check_crop()?;
        let (w, h) = self.picture();
        let pixels = u64::from(w) * u64::from(h);
        if pixels > max_pixels {
            return Err(Failure::Limit(format!(
                "the picture would be {w} by {h}, {pixels} pixels; at most {max_pixels} are \
                 allowed (--max-pixels)"
            )));
        }
        Ok(())
    }

    /// Width and height of the picture.
    pub(crate) fn picture(&self) -> (u32, u32) {
        self.crop.map_or((self.width, self.height), |c| (c.width, c.height))
    }

    /// The view that keeps a scene at exactly its own size times the zoom where nobody asked for
    /// another: a canvas that was rounded up has a last column or row that the scene covers in part,
    /// instead of a scene that is stretched off its pixels.
    pub(crate) fn view(&self, view: View, size: &Size) -> View {
        match view {
            View::Fit { .. } if size.width.is_none() && size.height.is_none() => {
                let zoom = size.zoom.unwrap_or(1.0);
                let units = |pixels: u32| f64::from(pixels) / zoom;
                View::Fit { size: DVec2::new(units(self.width), units(self.height)) }
            }
            other => other,
        }
    }

    fn check_crop(&self) -> Result<(), Failure> {
        let Some(crop) = self.crop else { return Ok(()) };
        let inside =
            |at: u32, side: u32, all: u32| u64::from(at) + u64::from(side) <= u64::from(all);
        if inside(crop.x, crop.width, self.width) && inside(crop.y, crop.height, self.height) {
            return Ok(());
        }
        let Crop { x, y, width, height } = crop;
        Err(Failure::Usage(format!(
            "--crop {x},{y},{width},{height} reaches outside the canvas of {} by {} pixels",
            self.width, self.height
        )))
    }
}

/// Width and height of the canvas in pixels.
fn sides(view: &View, size: &Size) -> Result<(u32, u32), Failure> {
    let natural = match view {
        View::Fit { size } => (size.x, size.y),
        View::Course { .. } => COURSE_SIZE,
    };
    let zoom = size.zoom.unwrap_or(1.0);
    let aspect = natural.0 / natural.1;
    let (w, h, whole): (f64, f64, fn(f64) -> f64) = match (size.width, size.height) {
        (None, None) => (natural.0, natural.1, |v| (v - UNIT_ERROR).ceil()),
        (Some(w), None) => (f64::from(w), f64::from(w) / aspect, f64::round),
        (None, Some(h)) => (f64::from(h) * aspect, f64::from(h), f64::round),
        (Some(w), Some(h)) => (f64::from(w), f64::from(h), f64::round),
    };
    Ok((side(whole(w * zoom))?, side(whole(h * zoom))?))
}

/// A whole number of pixels from 1 up to what a PNG can hold.
fn side(pixels: f64) -> Result<u32, Failure> {
    if pixels.is_nan() {
        return Err(Failure::Failed("the scene has no size".to_owned()));
    }
    if pixels > MAX_SIDE {
        return Err(Failure::Limit(format!(
            "the canvas would be {pixels:.0} pixels long; a side has at most {MAX_SIDE:.0}"
        )));
    }
    // In range by the test above, and whole.
    Ok(pixels.max(1.0) as u32)
}

#[cfg(test)]
mod tests {
    use super::*;
    use scumble::geometry::DVec2;

    const EMPTY: Size = Size { width: None, height: None, zoom: None, crop: None };
    const ALL: u64 = u64::MAX;

    fn fit(w: f64, h: f64) -> View {
        View::Fit { size: DVec2::new(w, h) }
    }

    fn picture(view: &View, size: &Size) -> (u32, u32) {
        Canvas::new(view, size, ALL).unwrap().picture()
    }

    #[test]
    fn the_scene_says_its_size() {
        assert_eq!(picture(&fit(300.0, 200.0), &EMPTY), (300, 200));
        assert_eq!(picture(&fit(300.2, 0.3), &EMPTY), (301, 1));
        assert_eq!(picture(&fit(96.000_000_000_1, 10.0), &EMPTY), (96, 10));
        let course = View::Course { size: DVec2::new(10.0, 90.0) };
        assert_eq!(picture(&course, &EMPTY), (800, 600));
    }

    #[test]
    fn one_side_keeps_the_aspect_and_two_are_taken() {
        let scene = fit(300.0, 200.0);
        assert_eq!(picture(&scene, &Size { width: Some(150), ..EMPTY }), (150, 100));
        assert_eq!(picture(&scene, &Size { height: Some(50), ..EMPTY }), (75, 50));
        let both = Size { width: Some(7), height: Some(9), ..EMPTY };
        assert_eq!(picture(&scene, &both), (7, 9));
        assert_eq!(picture(&fit(10_000.0, 1.0), &Size { width: Some(10), ..EMPTY }), (10, 1));
        let course = View::Course { size: DVec2::new(10.0, 90.0) };
        assert_eq!(picture(&course, &Size { width: Some(400), ..EMPTY }), (400, 300));
    }

    #[test]
    fn a_fraction_of_a_pixel_does_not_stretch_the_scene() {
        let scene = fit(100.5, 40.0);
        for (size, scale) in [(EMPTY, 1.0), (Size { zoom: Some(2.5), ..EMPTY }, 2.5)] {
            let Ok(canvas) = Canvas::new(&scene, &size, 1 << 30) else { panic!("a canvas") };
            let map = canvas.view(scene, &size).transform(canvas.width, canvas.height);
            assert_eq!((map.a, map.d, map.e, map.f), (scale, scale, 0.0, 0.0));
        }
        let wide = Size { width: Some(201), ..EMPTY };
        let Ok(canvas) = Canvas::new(&scene, &wide, 1 << 30) else { panic!("a canvas") };
        assert_eq!(canvas.view(scene, &wide), scene);
    }

    #[test]
    fn zoom_multiplies_whatever_the_size_is() {
        let scene = fit(300.0, 200.0);
        assert_eq!(picture(&scene, &Size { zoom: Some(2.0), ..EMPTY }), (600, 400));
        assert_eq!(picture(&scene, &Size { zoom: Some(0.001), ..EMPTY }), (1, 1));
        let both = Size { width: Some(10), height: Some(20), zoom: Some(1.5), crop: None };
        assert_eq!(picture(&scene, &both), (15, 30));
    }

    #[test]
    fn the_limit_counts_the_pixels_that_are_drawn() {
        let scene = fit(1e6, 1e6);
        assert!(matches!(Canvas::new(&scene, &EMPTY, 1 << 30), Err(Failure::Limit(_))));
        let crop = Some(Crop { x: 5, y: 5, width: 10, height: 10 });
        let part = Canvas::new(&scene, &Size { crop, ..EMPTY }, 100).unwrap();
        assert_eq!((part.width, part.picture()), (1_000_000, (10, 10)));
        assert!(matches!(Canvas::new(&scene, &Size { crop, ..EMPTY }, 99), Err(Failure::Limit(_))));
    }

    #[test]
    fn sizes_beyond_a_png_are_a_limit() {
        assert!(matches!(Canvas::new(&fit(1e12, 1.0), &EMPTY, ALL), Err(Failure::Limit(_))));
        assert!(matches!(Canvas::new(&fit(1.0, 1e300), &EMPTY, ALL), Err(Failure::Limit(_))));
        assert!(matches!(Canvas::new(&fit(f64::NAN, 1.0), &EMPTY, ALL), Err(Failure::Failed(_))));
        let wide = Size { width: Some(i32::MAX as u32), zoom: Some(1e9), ..EMPTY };
        assert!(matches!(Canvas::new(&fit(1.0, 1.0), &wide, ALL), Err(Failure::Limit(_))));
    }

    #[test]
    fn a_crop_lies_in_the_canvas() {
        let crop = |x, y, width, height| Size { crop: Some(Crop { x, y, width, height }), ..EMPTY };
        let scene = fit(30.0, 20.0);
        assert_eq!(picture(&scene, &crop(29, 19, 1, 1)), (1, 1));
        for size in [crop(29, 0, 2, 1), crop(0, 20, 1, 1), crop(u32::MAX, 0, u32::MAX, 1)] {
            assert!(matches!(Canvas::new(&scene, &size, ALL), Err(Failure::Usage(_))));
        }
    }
}
