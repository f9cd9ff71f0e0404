use scumble_geometry::{Affine, DVec2, Rect};

/// How a scene is placed on a canvas of pixels.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum View {
    /// The whole scene as large as the canvas allows, its proportions kept, centred.
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
                Affine::new(s, 0.0, 0.0, s, (w - size.x * s) / 2.0, (h - size.y * s) / 2.0)
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
