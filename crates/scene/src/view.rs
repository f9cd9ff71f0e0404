use scumble_geometry::{Affine, DVec2, Homography, Rect};

/// How a scene is placed on a canvas of pixels.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum View {
    /// The whole scene as large as the canvas allows, its proportions kept, centred to the whole
    /// pixel: edges that lie on pixels' borders stay on them.
    Fit {
        /// Size of the scene in scene units.
        size: DVec2,
    },
    /// The course's view: the larger side of the scene fills 1/1.2 of the smaller side of the
    /// canvas, centred, with a frame of black one-pixel lines around it.
    Course {
        /// Size of the scene in scene units.
        size: DVec2,
    },
}

/// The course leaves a margin around a scene: its span is the larger half-side times this.
const COURSE_MARGIN: f64 = 1.2;

/// A margin this little below a whole number of pixels was meant to be that number.
const ROUNDING: f64 = 1e-6;

impl View {
    /// Size of the scene in scene units.
    #[must_use]
    pub fn size(&self) -> DVec2 {
        match *self {
            Self::Fit { size } | Self::Course { size } => size,
        }
    }

    /// The map from scene units to pixels of a `width` × `height` canvas.
    #[must_use]
    pub fn transform(&self, width: u32, height: u32) -> Affine {
        let (w, h) = (f64::from(width), f64::from(height));
        match *self {
            Self::Fit { size } => {
                let s = (w / size.x).min(h / size.y);
                let offset =
                    |canvas: f64, scene: f64| ((canvas - scene * s) / 2.0 + ROUNDING).floor();
                Affine::new(s, 0.0, 0.0, s, offset(w, size.x), offset(h, size.y))
            }
            Self::Course { size } => {
                let side = w.min(h);
                let span = COURSE_MARGIN * size.x.max(size.y) / 2.0;
                let s = side / (2.0 * span);
                let offset =
                    |canvas: f64, scene: f64| (canvas - side) / 2.0 + (span - scene / 2.0) * s;
                Affine::new(s, 0.0, 0.0, s, offset(w, size.x), offset(h, size.y))
            }
        }
    }

    /// The same map, for numbers that must come out exactly where they can: the course's scale is
    /// a quotient, and here it is divided by last. A position that falls on a pixel's border then
    /// does so exactly, and a line along it has the pixels that the course's pictures give it.
    #[must_use]
    pub fn homography(&self, width: u32, height: u32) -> Homography {
        let Self::Course { size } = *self else {
            return self.transform(width, height).into();
        };
        let (w, h) = (f64::from(width), f64::from(height));
        let side = w.min(h);
        let span = COURSE_MARGIN * size.x.max(size.y) / 2.0;
        let offset = |canvas: f64, scene: f64| {
            side * (span - scene / 2.0) + (canvas - side) / 2.0 * (2.0 * span)
        };
        Homography::new([
            [side, 0.0, offset(w, size.x)],
            [0.0, side, offset(h, size.y)],
            [0.0, 0.0, 2.0 * span],
        ])
    }

    /// The ends of the four lines, in pixels, that frame the scene once everything is drawn.
    #[must_use]
    pub fn frame(&self, width: u32, height: u32) -> Option<[[DVec2; 2]; 4]> {
        let Self::Course { size } = *self else { return None };
        let view = self.transform(width, height);
        let scene = Rect::new(0.0, 0.0, size.x, size.y);
        let [tl, _, br, _] = scene.corners().map(|p| view.apply(p));
        let corner = |x, y| DVec2::new(x, y);
        let a = corner(tl.x - 1.0, tl.y + 1.0);
        let b = corner(br.x + 1.0, tl.y + 1.0);
        let c = corner(tl.x - 1.0, br.y - 1.0);
        let d = corner(br.x + 1.0, br.y - 1.0);
        Some([[a, b], [a, c], [d, b], [d, c]])
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const VIEWS: [View; 2] = [
        View::Fit { size: DVec2::new(800.0, 600.0) },
        View::Course { size: DVec2::new(800.0, 600.0) },
    ];

    #[test]
    fn both_forms_of_a_view_agree() {
        for view in VIEWS {
            for (width, height) in [(1024, 1024), (1, 7), (333, 100)] {
                let (affine, exact) =
                    (view.transform(width, height), view.homography(width, height));
                for p in [DVec2::ZERO, DVec2::new(800.0, 600.0), DVec2::new(-3.5, 1e4)] {
                    let d = exact.project(p).map(|q| (q - affine.apply(p)).length());
                    assert!(d.is_some_and(|d| d < 1e-9), "{view:?} {d:?}");
                }
            }
        }
    }

    #[test]
    fn the_margins_of_a_fitted_scene_are_whole_pixels() {
        let origin = |size: DVec2, w, h| View::Fit { size }.transform(w, h).apply(DVec2::ZERO);
        assert_eq!(origin(DVec2::new(100.5, 50.0), 101, 50), DVec2::ZERO);
        assert_eq!(origin(DVec2::new(100.0, 50.0), 100, 101), DVec2::new(0.0, 25.0));
        for side in 1..500 {
            // A scale whose rounding could take the scene a hair beyond the canvas.
            let size = DVec2::new(f64::from(side) * 1.1, f64::from(side) * 0.7);
            let o = origin(size, 777, 777);
            assert_eq!(o, DVec2::new(0.0, 141.0), "{side}");
        }
    }

    #[test]
    fn the_course_leaves_a_sixth_as_margin_and_frames_the_rest() {
        let view = VIEWS[1];
        let at = |x, y| view.homography(960, 1200).project(DVec2::new(x, y));
        // 800 of 960 units fill the width; the canvas is 240 pixels higher than wide.
        assert_eq!(at(0.0, 0.0), Some(DVec2::new(80.0, 120.0 + 180.0)));
        assert_eq!(at(800.0, 600.0), Some(DVec2::new(880.0, 120.0 + 780.0)));
        let frame = view.frame(960, 1200).map(|lines| lines[0][0]);
        assert_eq!(frame, Some(DVec2::new(79.0, 301.0)));
        assert_eq!(VIEWS[0].frame(960, 1200), None);
    }

    #[test]
    fn positions_on_a_border_between_pixels_are_exact() {
        // 16/15 pixels a unit: every 15 units a border.
        let map = VIEWS[1].homography(1024, 1024);
        for i in 0..50 {
            let p = map.project(DVec2::new(f64::from(15 * i) - 80.0, 0.0));
            assert_eq!(p.map(|p| p.x), Some(f64::from(16 * i)));
        }
    }
}
